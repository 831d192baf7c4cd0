//! The amount of an effect in a truth.

use crate::impact::effects::{CATALOGUE, Model, Spec, candidates};
use rand::{Rng, RngExt};

/// The effects whose recovery is looked at: those that a model without a frame's curve may have.
pub fn recorded(model: &Model) -> Vec<&'static Spec> {
    candidates(&CATALOGUE, model)
}

/// Values of an effect of the given amount, with its other parameters drawn at random; `None` for an effect without a line here.
pub fn values(id: &str, model: &Model, amount: f64, rng: &mut impl Rng) -> Option<Vec<f64>> {
    let side = if rng.random_bool(0.4) { -1.0 } else { 1.0 };
    let one = |value: f64| vec![value];
    Some(match id {
        "unilateral_contact" => one(1.0 - amount),
        "bottoming" => vec![rng.random_range(5.0..14.0), 1e4 + 4e6 * amount, 0.3],
        "cubic_stiffness" => one(side * 5e6 * amount),
        "bilinear_stiffness" => vec![rng.random_range(4.0..14.0), side * 3e3 * amount],
        "hunt_crossley_damping" => one(side * 1.5e3 * amount),
        "coulomb_friction" => one(20.0 * amount),
        "maxwell_branch" => vec![8e3 * amount, libm::exp(rng.random_range(-0.7..2.3))],
        "quadratic_damping" => one(side * 5.0 * amount),
        "preload" => one(20.0 * amount),
        "sensor_low_pass" => one(model.sensor.cutoff_hz * libm::exp(side * 0.5 * amount)),
        "sensor_saturation" => one(250.0 * libm::exp(-amount)),
        "sensor_gain" => one(1.0 + side * 0.15 * amount),
        "payload_mode" => vec![0.15 * amount, libm::exp(rng.random_range(4.0..5.8)), 0.05],
        "foot_stagger" => one(4.0 * amount),
        "drop_height_error" => one(side * 0.12 * amount),
        "air_drag" => one(0.2 * amount),
        _ => return None,
    })
}
