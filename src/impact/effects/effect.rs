//! What an effect does to a drop.

use std::fmt::Debug;

use super::arrangement::Arrangement;

/// A moment of the motion.
#[derive(Clone, Copy, Debug)]
pub struct MotionState<'a> {
    /// Compression, m.
    pub x_m: f64,
    /// Its rate, m/s.
    pub v_m_s: f64,
    /// The effect's own states.
    pub own: &'a [f64],
}

/// A kink of a force: integration stops there and continues after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// At a compression, m.
    Compression(f64),
    /// At a speed, m/s.
    Speed(f64),
}

/// How far a drop went: an effect compares it with its range of validity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Speed at first touch, m/s.
    pub impact_speed_m_s: f64,
    /// Largest compression, m.
    pub deepest_m: f64,
    /// Whether the frame went up past x = 0 within the series.
    pub above_ground: bool,
    /// Length of the contact, s; `None` when it did not end.
    pub contact_s: Option<f64>,
    /// Compression at its end, m.
    pub released_at_m: Option<f64>,
    /// Stiffness of the base, N/m.
    pub stiffness_n_m: f64,
}

/// A physical effect.
pub trait Effect: Debug + Send + Sync {
    /// Force on the body, N, upwards.
    fn force_n(&self, _at: &MotionState) -> f64 {
        0.0
    }

    /// Force that resists a motion however slow it is, N: dry friction, of which [`Effect::force_n`] has none at rest.
    fn resists_slow_motion_n(&self) -> f64 {
        0.0
    }

    /// Rates of its own states, in the order of its record's `states`.
    fn rates(&self, _at: &MotionState, _rates: &mut [f64]) {}

    /// Energy that it has stored and could give back, J.
    fn stored_j(&self, _at: &MotionState) -> f64 {
        0.0
    }

    /// Where its force has kinks.
    fn thresholds(&self) -> Vec<Threshold> {
        Vec::new()
    }

    /// Why it does not hold in a drop that went so far; `None` where nothing speaks against it.
    fn outside(&self, _reach: &Reach) -> Option<String> {
        None
    }

    /// Changes how fall, contact and sensor act.
    fn arrange(&self, _arrangement: &mut Arrangement) {}
}
