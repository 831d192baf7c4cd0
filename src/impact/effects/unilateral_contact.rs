//! Unilateral contact: where F < 0 or x < 0 the ground's force is tension_factor times F.
//!
//! 1 is the bilateral base, which pulls as it pushes; 0 is a ground that never pulls: after release the body flies and a
//! sensor reads exactly 0 g. Source: the ground cannot pull; the measured drops bounce.
//!
//! *When it is wrong:* legs without mass are released at the moment when F = 0, still compressed, and spread in no time;
//! real legs have mass and ring. Values between 0 and 1 are meaningful in a fit only.

use super::arrangement::Arrangement;
use super::effect::{Effect, Reach};
use super::generator::Generator;
use super::parameter::{Parameter, Scale};
use super::spec::{Availability, Spec, Stage, singles};

/// Compression at the release from which on a warning is given, m.
const RELEASED_M: f64 = 1e-3;

/// Its record.
pub const SPEC: Spec = Spec {
    id: "unilateral_contact",
    title: "unilateral contact",
    stage: Stage::Arrangement,
    availability: Availability::Any,
    parameters: &[Parameter {
        key: "tension_factor",
        unit: "1",
        si: 1.0,
        min: 0.0,
        max: 1.0,
        off: Some(1.0),
        default: None,
        scale: Scale::Fraction,
        doc: "share of a pulling force that acts: 1 bilateral, 0 the ground never pulls",
    }],
    choice: None,
    states: &[],
    starts: |_| singles(&[0.0, 0.5]),
    build: |inputs| Box::new(UnilateralContact { tension_factor: inputs.values[0] }),
    generator: Generator::Conditions(|drop, values, _| drop.tension_factor = values[0]),
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
            return Some(format!("a tension factor of {} is only meaningful in a fit: real ground never pulls", self.tension_factor));
        }
        let x_m = reach.released_at_m.filter(|x_m| *x_m > RELEASED_M)?;
        Some(format!("the frame is released while {:.1} mm compressed: legs with mass would spread and ring", x_m * 1e3))
    }
}
