//! Mass of the feet, or a mount of the sensor, that explains the fitted drops better and is left out all the same.

use super::fitting::{LandingFit, LandingProblem};
use super::foot_mode::FOOT_MODE;
use super::sensor_mount::MOUNT_LOW_PASS;
use crate::impact::diagnose::UNSTEADY;

/// An effect that is left out.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct RefusedEffect {
    /// Which.
    pub id: &'static str,
    /// Why.
    #[serde(flatten)]
    pub reason: Reason,
}

/// Why an effect is left out.
#[derive(Clone, Copy, Debug, serde::Serialize)]
#[serde(untagged)]
pub enum Reason {
    /// Single drops of heights that no fit saw are predicted worse.
    Unseen {
        /// Root mean square of what is left of them, given their touches, with the effect, g.
        with_g: f64,
        /// The same without it, g.
        without_g: f64,
    },
    /// Its numbers, or those of friction beside it, differ from height to height.
    Unsteady {
        /// p-value of one set of numbers for all heights.
        steady_p: f64,
    },
}

impl RefusedEffect {
    /// Of fits with an effect and without it, by how far single drops of heights that no fit saw lie from their predictions, g, where there
    /// are such, and by the heights that were fitted; `None` where it is kept.
    pub fn of<'a>(
        [with, without]: [(&LandingProblem<'a>, &LandingFit); 2],
        unseen_g: impl Fn(&LandingProblem<'a>, &LandingFit) -> Option<f64>,
    ) -> Option<Self> {
        let id = if with.0.parts.heavy_feet { FOOT_MODE } else { MOUNT_LOW_PASS };
        let unseen = unseen_g(with.0, with.1).zip(unseen_g(without.0, without.1));
        let worse = unseen.filter(|(with_g, without_g)| with_g > without_g);
        let worse = worse.map(|(with_g, without_g)| Reason::Unseen { with_g, without_g });
        let unsteady = || with.0.effects_steady_p(with.1).filter(|p| *p < UNSTEADY).map(|steady_p| Reason::Unsteady { steady_p });
        Some(Self { id, reason: worse.or_else(unsteady)? })
    }

    /// In a sentence.
    pub fn sentence(&self) -> String {
        let id = self.id;
        match self.reason {
            Reason::Unseen { with_g, without_g } => format!(
                "{id} explains more of the fitted drops, but single drops from heights that no fit saw are predicted within {with_g:.1} g with \
                 it, and within {without_g:.1} g without it: it is left out"
            ),
            Reason::Unsteady { steady_p } => format!(
                "{id} explains more of the fitted drops, but its numbers differ from height to height (p = {steady_p:.1e}): it is left out"
            ),
        }
    }
}
