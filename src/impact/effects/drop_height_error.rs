//! Drop-height error: the body falls from h + dh.
//!
//! Source: a hand that lets go late, a ruler read from another point. A height that would be below zero is zero.
//!
//! *When it is wrong:* one dh for all drops is a bias; the scatter of single drops is no dh.

use super::effect::{Arrangement, Effect, Parameter, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "drop_height_error",
    title: "drop-height error",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "dh_m",
        unit: "m",
        si: 1.0,
        min: -0.4,
        max: 0.4,
        off: Some(0.0),
        default: None,
        doc: "height that is not in the stated one",
    }],
    choice: None,
    build: |values, _| Box::new(DropHeightError { extra_m: values[0] }),
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
