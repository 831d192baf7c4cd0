//! A frame that cannot be designed, as a refusal of its file.

use super::design::DesignError;
use crate::frame::skeleton::closing_lengths;
use crate::params::refusal::{Reason, Refusal};
use crate::params::{Frame, FrameFile, parameters};

impl DesignError {
    /// The refusal of the file that states the frame, with the place that drives the error most.
    pub fn refusal(&self, file: &FrameFile) -> Refusal {
        let message = self.to_string();
        match self {
            Self::Closure(closure) => {
                // The lengths close together or not at all: what the nearest file states is what was changed.
                let keys = [closure.key(), "rods.arm_rod_length_mm", "rods.cage_rod_length_mm", "rods.strut_rod_length_mm"];
                let depth = |key: &&str| file.entries.get(*key).map_or(usize::MAX, |entry| entry.depth);
                let nearest = keys.into_iter().min_by_key(depth).unwrap_or(keys[0]);
                // Lengths that follow from a target size are not for the file to state.
                let stated = Frame::resolve(file).ok().filter(|frame| frame.target.is_none());
                let closing = stated.map_or_else(Vec::new, |frame| closing_lengths(&frame));
                let each: Vec<String> = closing.iter().map(|(key, length_mm)| format!("{key} = {length_mm}")).collect();
                let remedy = if each.is_empty() {
                    closure.remedy()
                } else {
                    format!("it closes with {}; other limits were not looked at", each.join(", or with "))
                };
                file.refuse(nearest, Reason::Impossible { message, remedy })
            }
            Self::Relation(broken) => file.refuse(broken.key, Reason::clone(&broken.reason)),
            Self::Target { .. } => {
                let remedy = "choose another width, height or strut_tilt_deg".into();
                file.refuse("target.width_mm", Reason::Impossible { message, remedy })
            }
            Self::Part { part, .. } => {
                let mut drivers: Vec<(usize, String)> = parameters()
                    .filter(|p| p.drives.contains(part))
                    .filter_map(|p| {
                        let key = format!("{}.{}", p.table, p.key);
                        file.entries.get(&key).map(|entry| (entry.depth, key))
                    })
                    .collect();
                drivers.sort();
                let nearest = drivers.first().map_or(String::new(), |(_, key)| key.clone());
                let own: Vec<&str> = drivers.iter().filter(|(depth, _)| *depth == 0).map(|(_, key)| key.as_str()).collect();
                let remedy = match own[..] {
                    [] => format!("its parameters contradict each other; `flexframe params` lists those that drive {part}"),
                    _ => format!("change one of those that this file sets for it: {}", own.join(", ")),
                };
                file.refuse(&nearest, Reason::Impossible { message, remedy })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::assembly::Design;

    /// The lengths of a target size are those that its relations are held against, not those of the base.
    #[test]
    fn planted_a_target_size_is_judged_by_the_lengths_that_follow_from_it() {
        let design = |text: &str| {
            let file = FrameFile::parse("own.toml", &format!("base = \"cognifly\"\n{text}")).expect("reads");
            let frame = Frame::resolve(&file).expect("is resolved, as its lengths are not known yet");
            Design::new(frame).map(|_| ()).map_err(|error| error.refusal(&file).to_string())
        };
        let wide = "target.width_mm = 300\ntarget.height_mm = 130\ntarget.strut_tilt_deg = 22\n";
        assert_eq!(design(&format!("{wide}motor_mount.motor_position_mm = 105\n")), Ok(()));
        let narrow = design("target.width_mm = 169\ntarget.height_mm = 100\ntarget.strut_tilt_deg = 22\n");
        assert!(narrow.is_err_and(|told| told.contains("the way left between motor mount and fork")));
        let long = design(&format!("{wide}rods.cage_side_ratio = 1.12\n"));
        assert!(long.is_err_and(|told| told.contains("the reach of the computer's holes")));
    }
}
