//! Drop-height error: the body falls from h + dh.
//!
//! Source: a hand that lets go late, a ruler read from another point. A height that would be below zero is zero.
//!
//! *When it is wrong:* one dh for all drops is a bias; the variation of single drops is not.

use super::arrangement::Arrangement;
use super::effect::Effect;
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Its record.
pub const SPEC: Spec = Spec {
    id: "drop_height_error",
    title: "drop-height error",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "dh_m",
        unit: "m",
        si: 1.0,
        min: -0.4,
        max: 0.4,
        off: Some(0.0),
        default: None,
        scale: Scale::Linear,
        doc: "error of the stated height",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[-0.1, 0.1]),
    build: |inputs| Box::new(DropHeightError { extra_m: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.extra_m = values[0]),
};

#[derive(Clone, Copy, Debug)]
struct DropHeightError {
    extra_m: f64,
}

impl Effect for DropHeightError {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.fall.extra_m = self.extra_m;
    }
}
