//! The channel in which drops can be compared with a model.

use super::observable::observables;
use crate::impact::effects::{Channel, Model};
use crate::impact::fit::{Chosen, FitError, Keep, Waves};
use crate::impact::measured::DropSet;

/// The drops in the channel that is compared.
#[derive(Debug)]
pub struct ChannelChoice<'a> {
    /// The drops.
    pub chosen: Chosen<'a>,
    /// Their mean waves.
    pub waves: Waves,
    /// The channel that the model states.
    pub stated: Channel,
    /// Why another is compared.
    pub reason: Option<String>,
}

impl<'a> ChannelChoice<'a> {
    /// Chooses. A magnitude whose impulse no vertical impact has contains sideways motion, so the axial component is taken
    /// where it was measured.
    ///
    /// # Errors
    /// When no drop can be used.
    pub fn of(set: &'a DropSet, model: &Model) -> Result<Self, FitError> {
        let stated = model.sensor.channel;
        let mut chosen = Chosen::of(set, stated, Keep::Evidence)?;
        let mut reason = None;
        if stated == Channel::Magnitude && chosen.lacks_axes() {
            reason = Some("the drops have one axis only, so that is compared".to_string());
            chosen.channel = Channel::Axial;
        } else if stated == Channel::Magnitude {
            let impossible: Vec<String> = observables(&chosen.waves()?, model)
                .iter()
                .filter(|one| one.impossible)
                .map(|one| format!("{:.2} ± {:.2} v0 at {} m, at most {:.2}", one.impulse_over_v0, one.error, one.height_m, one.most))
                .collect();
            if !impossible.is_empty() {
                reason = Some(format!(
                    "the magnitude's impulse is impossible for a vertical impact ({}): it contains sideways motion, so the axial component is compared",
                    impossible.join("; ")
                ));
                chosen.channel = Channel::Axial;
            }
        }
        let waves = chosen.waves()?;
        Ok(Self { chosen, waves, stated, reason })
    }
}
