//! What of the bill's supplies no step tells of.

use super::mounting_plan::MountStep;

/// Lines of a bill that are used up, by their roles, that no step both lists and tells of by that name.
pub fn untold<'r>(roles: impl Iterator<Item = &'r str>, steps: &[&MountStep]) -> Vec<&'r str> {
    let tells = |step: &&&MountStep, role: &str| step.text.to_lowercase().contains(&role.replace('_', " "));
    let told = |role: &str| steps.iter().filter(|step| step.supplies.contains(&role)).any(|step| tells(&step, role));
    roles.filter(|role| !told(role)).collect()
}
