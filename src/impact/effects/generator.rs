//! How the generator of synthetic drops acts for an effect.
//!
//! The generator (`crate::impact::synthetic`) is what a diagnosis is tested on, so it must share no equation with the
//! simulation. Each effect's record states the generator's formula beside the simulation's, because a record in two
//! places is how a term is forgotten. The two are written separately: the generator's formula is a plain function of x, v
//! and the values as they stand in the model file, calls nothing of the effect, and is composed and integrated by the
//! generator's own code. A test compares the waves of both for every effect, so that an error in either shows.

/// A moment of the generator's motion.
#[derive(Clone, Copy, Debug)]
pub struct GeneratorState {
    /// Compression, m.
    pub x: f64,
    /// Its rate, m/s.
    pub v: f64,
    /// The force of an effect that is a state, N.
    pub q: f64,
}

/// A mass on a spring and damper of its own.
#[derive(Clone, Copy, Debug)]
pub struct Rider {
    /// Share of the whole mass.
    pub share: f64,
    /// Frequency on a frame that is held, Hz.
    pub f_hz: f64,
    /// Damping ratio.
    pub zeta: f64,
}

/// Numbers of the generator's drop that effects change.
#[derive(Clone, Debug)]
pub struct Conditions {
    /// Stiffness of the base, N/m.
    pub stiffness_n_m: f64,
    /// Damping of the base, N s/m.
    pub damping_n_s_m: f64,
    /// Factor of a force that would pull.
    pub tension_factor: f64,
    /// Compression from the first foot's touch to the last's, m.
    pub stagger_m: f64,
    /// Share of the frame's static curve in the spring.
    pub curve_share: f64,
    /// Masses on the frame.
    pub riders: Vec<Rider>,
    /// Whether the sensor is on the first of them.
    pub on_rider: bool,
    /// Error of the stated height, m.
    pub extra_m: f64,
    /// Drag over mass in the fall, 1/m.
    pub drag_1_m: f64,
    /// Cutoff of the sensor, Hz.
    pub cutoff_hz: f64,
    /// Its gain.
    pub gain: f64,
    /// Its largest reading, g.
    pub limit_g: f64,
}

/// How the generator acts for an effect. Values are those of the model file, in its units.
#[derive(Clone, Copy, Debug)]
pub enum Generator {
    /// A force in the sum, N.
    Force(fn(GeneratorState, &[f64]) -> f64),
    /// A force in the sum that is a state: its rate, N/s.
    Branch(fn(GeneratorState, &[f64]) -> f64),
    /// A force on top of the sum that never pulls, N.
    Stop(fn(GeneratorState, &[f64]) -> f64),
    /// Numbers of the drop; the last argument is the index of the chosen word.
    Conditions(fn(&mut Conditions, &[f64], usize)),
}
