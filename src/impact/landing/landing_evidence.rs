//! The drops by which landings that are not level are judged.

use super::observed::ObservedLandings;
use crate::impact::effects::Model;
use crate::impact::fit::Waves;

/// What is judged.
#[derive(Clone, Copy)]
pub struct LandingEvidence<'a> {
    /// The drops that were fitted.
    pub fitted: &'a Waves,
    /// Drops of heights that no fit sees.
    pub held_out: Option<&'a Waves>,
    /// Touches of all of them.
    pub observed: &'a ObservedLandings,
    /// The base model: body, fall and sensor.
    pub model: &'a Model,
    /// Of everything that is drawn.
    pub seed: u64,
}
