//! What an effect is: a catalogue entry, and what it does to a drop.

use std::fmt::Debug;

use super::{Fall, Feet, Payload, Sensor, Softening};

/// A parameter of an effect, in the unit of model files and results.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Key in a model file.
    pub key: &'static str,
    /// Unit of its value there.
    pub unit: &'static str,
    /// One such unit in SI.
    pub si: f64,
    /// Least.
    pub min: f64,
    /// Most.
    pub max: f64,
    /// The value that switches the effect off; `None` where it does not depend on this parameter.
    pub off: Option<f64>,
    /// What holds when a model file leaves it out, and what a fit keeps unless told otherwise; `None`: it must be stated.
    pub default: Option<f64>,
    /// What it is.
    pub doc: &'static str,
}

/// A choice between words.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// Key in a model file.
    pub key: &'static str,
    /// The words; the first holds when none is stated.
    pub words: &'static [&'static str],
}

/// Where an effect acts in the order of composition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// A force in the sum.
    Force,
    /// A force on top, after the tension factor; never pulls.
    Stop,
    /// Changes how fall, contact or sensor act.
    Arrangement,
}

/// An effect's entry in the catalogue.
#[derive(Debug)]
pub struct Spec {
    /// Its id in model files and results.
    pub id: &'static str,
    /// Its name in words.
    pub title: &'static str,
    /// Where it acts.
    pub stage: Stage,
    /// Its parameters, in the order of the values that `build` takes.
    pub parameters: &'static [Parameter],
    /// A choice that is no number.
    pub choice: Option<Choice>,
    /// Makes the effect from values in SI and the index of the chosen word.
    pub build: fn(&[f64], usize) -> Box<dyn Effect>,
}

impl Spec {
    /// Whether values in the file's units switch the effect off.
    pub fn is_off(&self, values: &[f64]) -> bool {
        self.parameters.iter().zip(values).any(|(parameter, value)| parameter.off == Some(*value))
    }
}

/// A moment of the motion.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// Compression, m.
    pub x_m: f64,
    /// Its rate, m/s.
    pub v_m_s: f64,
    /// The effect's own states.
    pub own: &'a [f64],
}

/// Where a force has a kink: integration stops there and goes on behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// At a compression, m.
    Compression(f64),
    /// At a speed, m/s.
    Speed(f64),
}

/// How far a drop went: what an effect is held against to say whether it still holds.
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
    pub softening: Option<Softening>,
    /// A payload on a spring of its own.
    pub payload: Option<Payload>,
    /// What the sensor makes of it.
    pub sensor: Sensor,
}

/// A physical effect.
pub trait Effect: Debug + Send + Sync {
    /// How many states of its own it has; they begin at zero.
    fn own_states(&self) -> usize {
        0
    }

    /// Force on the body, N, upwards.
    fn force_n(&self, _at: &Motion) -> f64 {
        0.0
    }

    /// Rates of its own states.
    fn rates(&self, _at: &Motion, _rates: &mut [f64]) {}

    /// Energy that it holds and could give back, J.
    fn stored_j(&self, _at: &Motion) -> f64 {
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
