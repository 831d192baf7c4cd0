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
    /// Why this one is compared.
    pub reason: String,
}

impl<'a> ChannelChoice<'a> {
    /// Chooses the channel that the drops support, or takes the one that is wanted. A magnitude whose impulse no vertical impact
    /// has contains sideways motion, so the axial component is taken where it was measured.
    ///
    /// # Errors
    /// When no drop can be used.
    pub fn of(set: &'a DropSet, model: &Model, keep: Keep, wanted: Option<Channel>) -> Result<Self, FitError> {
        let stated = model.sensor.channel;
        let mut chosen = Chosen::of(set, wanted.unwrap_or(stated), keep)?;
        let (channel, reason) = match wanted {
            Some(wanted) => (wanted, "as asked for".to_string()),
            None => supported(&chosen, model)?,
        };
        chosen.channel = channel;
        let waves = chosen.waves()?;
        Ok(Self { chosen, waves, stated, reason })
    }
}

/// The channel that drops support, and why.
fn supported(chosen: &Chosen, model: &Model) -> Result<(Channel, String), FitError> {
    if !chosen.has_all_axes() {
        return Ok((Channel::Axial, "the drops have one axis only, so that is compared".into()));
    }
    let magnitude = Chosen { channel: Channel::Magnitude, ..chosen.clone() };
    let impossible: Vec<String> = observables(&magnitude.waves()?, model)
        .iter()
        .filter(|one| one.impossible)
        .map(|one| format!("{:.2} ± {:.2} v0 at {} m, at most {:.2}", one.impulse_over_v0, one.error, one.height_m, one.most))
        .collect();
    Ok(if !impossible.is_empty() {
        let found = impossible.join("; ");
        (
            Channel::Axial,
            format!(
                "the magnitude's impulse is impossible for a vertical impact ({found}): it contains sideways motion, so the axial component is compared"
            ),
        )
    } else if model.sensor.channel == Channel::Magnitude {
        (Channel::Magnitude, "all axes were measured and the magnitude's impulse is possible: it is compared, as the model states".into())
    } else {
        (Channel::Axial, "all axes were measured; the axial component is compared, which is what the model predicts".into())
    })
}
