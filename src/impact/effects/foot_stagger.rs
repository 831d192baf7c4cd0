//! Foot stagger: four feet touch one after the other, F = Σ ¼ [k (x - d_i) + c v] over those that have touched,
//! d_i = δ i/3 for i = 0 … 3, in place of the base spring and damper.
//!
//! Source: a frame that lands tilted. A foot that has touched stays linked, as in the bilateral base. It stores
//! Σ k (x - d_i)²/8.
//!
//! *When it is wrong:* a tilted body also turns, which takes energy out of the fall; feet are taken evenly spaced.

use super::effect::{Arrangement, Effect, Parameter, Reach, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "foot_stagger",
    title: "foot stagger",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "delta_mm",
        unit: "mm",
        si: 1e-3,
        min: 0.0,
        max: 20.0,
        off: Some(0.0),
        default: None,
        doc: "from the first foot's touch to the last's",
    }],
    choice: None,
    build: |values, _| Box::new(FootStagger { spread_m: values[0] }),
};

#[derive(Clone, Copy, Debug)]
struct FootStagger {
    spread_m: f64,
}

impl Effect for FootStagger {
    fn arrange(&self, arrangement: &mut Arrangement) {
        arrangement.feet = Some(Feet { at_m: [0.0, 1.0, 2.0, 3.0].map(|i| self.spread_m * i / 3.0) });
    }

    fn outside(&self, reach: &Reach) -> Option<String> {
        (reach.deepest_m < self.spread_m).then(|| {
            format!(
                "{:.1} mm do not bring the last foot down at {:.1} mm: a body tilted so far turns",
                reach.deepest_m * 1e3,
                self.spread_m * 1e3
            )
        })
    }
}

/// Feet and the compressions at which they touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feet {
    /// Lowest first, m.
    pub at_m: [f64; 4],
}

impl Feet {
    /// What the feet that have touched leave of the compression, in mean over four, m.
    pub fn mean_compression_m(&self, x_m: f64, touched: usize) -> f64 {
        self.at_m[..touched].iter().map(|at| 0.25 * (x_m - at)).sum()
    }

    /// The same of its square, m².
    pub fn mean_square_m2(&self, x_m: f64, touched: usize) -> f64 {
        self.at_m[..touched].iter().map(|at| 0.25 * (x_m - at) * (x_m - at)).sum()
    }
}
