//! The list of effects. Every other table of effects is derived from it.

use super::spec::{Spec, Stage};
use super::*;

/// Every effect: the base's, then those that can come on top, in the order of composition.
pub const CATALOGUE: [&Spec; 19] = [
    &linear_spring::SPEC,
    &linear_damper::SPEC,
    &unilateral_contact::SPEC,
    &bottoming::SPEC,
    &cubic_stiffness::SPEC,
    &bilinear_stiffness::SPEC,
    &hunt_crossley_damping::SPEC,
    &coulomb_friction::SPEC,
    &maxwell_branch::SPEC,
    &quadratic_damping::SPEC,
    &preload::SPEC,
    &sensor_low_pass::SPEC,
    &sensor_saturation::SPEC,
    &sensor_gain::SPEC,
    &payload_mode::SPEC,
    &foot_stagger::SPEC,
    &drop_height_error::SPEC,
    &air_drag::SPEC,
    &frame_force_curve::SPEC,
];

/// An effect's record by its id, the base's among them.
pub fn by_id(id: &str) -> Option<&'static Spec> {
    CATALOGUE.into_iter().find(|spec| spec.id == id)
}

/// States of all effects of a list together.
pub const fn states(catalogue: &[&Spec]) -> usize {
    let (mut sum, mut at) = (0, 0);
    while at < catalogue.len() {
        sum += catalogue[at].states.len();
        at += 1;
    }
    sum
}

/// Effects of a list that do work on the body: forces, stops, and those that attach a mass.
pub const fn working(catalogue: &[&Spec]) -> usize {
    let (mut count, mut at) = (0, 0);
    while at < catalogue.len() {
        let spec = catalogue[at];
        count += (!matches!(spec.stage, Stage::Arrangement) || !spec.states.is_empty()) as usize;
        at += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_ids_and_keys_are_unique_and_bounds_hold_defaults() {
        let specs = CATALOGUE;
        for (at, spec) in specs.iter().enumerate() {
            assert!(specs[at + 1..].iter().all(|other| other.id != spec.id), "{}", spec.id);
            for parameter in spec.parameters {
                assert!(parameter.min < parameter.max && parameter.si > 0.0, "{} {}", spec.id, parameter.key);
                for value in [parameter.off, parameter.default].into_iter().flatten() {
                    assert!((parameter.min..=parameter.max).contains(&value), "{} {}", spec.id, parameter.key);
                }
            }
        }
    }

    #[test]
    fn regress_the_library_is_the_one_that_results_name() {
        let names: Vec<String> = CATALOGUE
            .iter()
            .map(|spec| format!("{}: {}", spec.id, spec.parameters.iter().map(|p| p.key).collect::<Vec<_>>().join(", ")))
            .collect();
        let expected = [
            "linear_spring: k",
            "linear_damper: c",
            "unilateral_contact: tension_factor",
            "bottoming: x_b_mm, k_b, lambda",
            "cubic_stiffness: k3",
            "bilinear_stiffness: x1_mm, k_bl",
            "hunt_crossley_damping: chi",
            "coulomb_friction: f_c_n",
            "maxwell_branch: k_m, tau_ms",
            "quadratic_damping: c2",
            "preload: f0_n",
            "sensor_low_pass: cutoff_hz",
            "sensor_saturation: limit_g",
            "sensor_gain: gain",
            "payload_mode: mu, f_hz, zeta",
            "foot_stagger: delta_mm",
            "drop_height_error: dh_m",
            "air_drag: beta",
            "frame_force_curve: share",
        ];
        assert_eq!(names, expected);
    }
}
