//! Unilateral contact: where F < 0 or x < 0 the ground's force is tension_factor times F.
//!
//! 1 is the bilateral base, which pulls as it pushes; 0 is a ground that lets go: after release the body flies and a
//! sensor reads exactly 0 g. Source: the ground cannot pull; the measured drops bounce.
//!
//! *When it is wrong:* legs without mass are let go at the moment when F = 0, still compressed, and spread in no time;
//! real legs have mass and ring. Values between 0 and 1 are a measure for a fit, not a ground.

use super::effect::{Arrangement, Effect, Parameter, Reach, Spec, Stage};

/// Compression at the release from which on it is told, m.
const LET_GO_M: f64 = 1e-3;

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "unilateral_contact",
    title: "unilateral contact",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "tension_factor",
        unit: "1",
        si: 1.0,
        min: 0.0,
        max: 1.0,
        off: Some(1.0),
        default: None,
        doc: "share of a pulling force that acts: 1 bilateral, 0 the ground lets go",
    }],
    choice: None,
    build: |values, _| Box::new(UnilateralContact { tension_factor: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct UnilateralContact {
    tension_factor: f64,
}

impl Effect for UnilateralContact {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.tension_factor = self.tension_factor;
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        if self.tension_factor > 0.0 {
            return Some(format!("a tension factor of {} is a measure for a fit: no ground pulls in part", self.tension_factor));
        }
        let x_m = reach.released_at_m.filter(|x_m| *x_m > LET_GO_M)?;
        Some(format!("the frame is let go while {:.1} mm compressed: legs with mass would spread and ring", x_m * 1e3))
    }
}
