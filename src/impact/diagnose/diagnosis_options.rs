//! How drops are diagnosed.

use crate::impact::effects::{CATALOGUE, Spec};

/// How to look.
#[derive(Clone, Copy, Debug)]
pub struct DiagnosisOptions {
    /// Most effects on top of the base.
    pub most_effects: usize,
    /// Of everything that is drawn.
    pub seed: u64,
    /// The effects that are tried on top of the base.
    pub catalogue: &'static [&'static Spec],
}

impl DiagnosisOptions {
    /// With every effect of the catalogue.
    pub fn new(most_effects: usize, seed: u64) -> Self {
        Self { most_effects, seed, catalogue: &CATALOGUE }
    }
}
