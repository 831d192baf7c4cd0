//! Every effect there is.

use super::effect::Spec;
use super::*;

/// The base model's effects.
pub const BASE: [&Spec; 2] = [&linear_spring::SPEC, &linear_damper::SPEC];

/// The effects that can come on top, in the order of the library.
pub const CATALOGUE: [&Spec; 16] = [
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
];

/// The effects that need to know a frame: a model without its curve cannot have them.
pub const OF_FRAME: [&Spec; 1] = [&frame_force_curve::SPEC];

/// Every effect, the base's first.
pub fn every() -> impl Iterator<Item = &'static Spec> {
    BASE.into_iter().chain(CATALOGUE).chain(OF_FRAME)
}

/// The effects that can come on top of a model.
pub fn candidates(model: &Model) -> Vec<&'static Spec> {
    let of_frame = OF_FRAME.into_iter().filter(|_| model.frame_curve.is_some());
    CATALOGUE.into_iter().chain(of_frame).collect()
}

/// An effect's entry by its id, the base's among them.
pub fn by_id(id: &str) -> Option<&'static Spec> {
    every().find(|spec| spec.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_ids_and_keys_are_unique_and_bounds_hold_defaults() {
        let specs: Vec<&Spec> = every().collect();
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
        ];
        assert_eq!(names, expected);
    }
}
