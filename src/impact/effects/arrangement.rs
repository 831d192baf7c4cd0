//! How fall, contact and sensor are arranged: the data that effects without a force of their own change.

use std::sync::Arc;

use super::fall::Fall;
use super::frame_curve::FrameCurve;
use super::sensor::Sensor;

/// How fall, contact and sensor are arranged.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrangement {
    /// The way down.
    pub fall: Fall,
    /// What the ground's force is multiplied by where it would pull, or where the frame has left it.
    pub tension_factor: f64,
    /// Feet that touch one after the other.
    pub feet: Option<Feet>,
    /// A frame's curve in the spring's place.
    pub spring_curve: Option<SpringCurve>,
    /// A mass on a spring of its own.
    pub attached: Option<AttachedMass>,
    /// The sensor.
    pub sensor: Sensor,
}

impl Arrangement {
    /// Without any effect.
    pub fn plain(sensor: Sensor) -> Self {
        Self { fall: Fall::default(), tension_factor: 1.0, feet: None, spring_curve: None, attached: None, sensor }
    }
}

/// Feet and the compressions at which they touch; each carries a quarter of the base's spring and damper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Feet {
    /// Lowest first, m.
    pub at_m: [f64; 4],
}

impl Feet {
    /// Compression of the feet that have touched, in mean over four, m.
    pub fn mean_compression_m(&self, x_m: f64, touched: usize) -> f64 {
        self.at_m[..touched].iter().map(|at| 0.25 * (x_m - at)).sum()
    }

    /// The same of its square, m².
    pub fn mean_square_m2(&self, x_m: f64, touched: usize) -> f64 {
        self.at_m[..touched].iter().map(|at| 0.25 * (x_m - at) * (x_m - at)).sum()
    }
}

/// A mass on the frame with a spring and a damper of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttachedMass {
    /// Id of the effect that attaches it.
    pub effect: &'static str,
    /// Its share of the whole mass.
    pub share: f64,
    /// Stiffness over its mass, 1/s².
    pub stiffness_1_s2: f64,
    /// Damping over its mass, 1/s.
    pub damping_1_s: f64,
}

impl AttachedMass {
    /// The states that it adds.
    pub const STATES: [&str; 2] = ["lag behind the frame, m", "its rate, m/s"];

    /// Proper acceleration of the mass, m/s²: what pushes it up, over its mass.
    pub fn proper_m_s2(&self, lag_m: f64, lag_rate_m_s: f64) -> f64 {
        self.stiffness_1_s2 * lag_m + self.damping_1_s * lag_rate_m_s
    }
}

/// The base's spring with a share of a frame's static curve in it.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringCurve {
    /// Share s.
    pub share: f64,
    /// The curve.
    pub curve: Arc<FrameCurve>,
}

impl SpringCurve {
    /// What stands in the place of x, m.
    pub fn compression_m(&self, x_m: f64) -> f64 {
        x_m + self.share * (self.curve.at(x_m)[0] - x_m)
    }

    /// What stands in the place of x², m².
    pub fn square_m2(&self, x_m: f64) -> f64 {
        x_m * x_m + self.share * (2.0 * self.curve.at(x_m)[1] - x_m * x_m)
    }
}
