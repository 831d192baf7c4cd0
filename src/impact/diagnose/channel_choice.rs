//! The channel in which drops can be compared with a model.

use super::observable::observables;
use crate::impact::effects::{Channel, Model};
use crate::impact::fit::{Chosen, FitError, Keep, Waves};
use crate::impact::measured::DropSet;

/// Which readings of the drops are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComparedAxes {
    /// The component along the frame's axis alone.
    Axial,
    /// The magnitude of all axes.
    Magnitude,
    /// The component along the frame's axis is compared with the model. The lateral axes are not, as no model here has them: what acts
    /// sideways is not derived. They show when each foot touches and how the sensor leans, which judges landings that are not level.
    All,
}

impl ComparedAxes {
    /// What is compared with the model.
    pub fn channel(self) -> Channel {
        match self {
            Self::Axial | Self::All => Channel::Axial,
            Self::Magnitude => Channel::Magnitude,
        }
    }

    /// Its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Axial => "axial",
            Self::Magnitude => "magnitude",
            Self::All => "all",
        }
    }
}

/// The drops in the channel that is compared.
#[derive(Debug)]
pub struct ChannelChoice<'a> {
    /// The drops.
    pub chosen: Chosen<'a>,
    /// Their mean waves.
    pub waves: Waves,
    /// The axes that can be used.
    pub axes: ComparedAxes,
    /// The channel that the model states.
    pub stated: Channel,
    /// Why this one is compared.
    pub reason: String,
}

impl<'a> ChannelChoice<'a> {
    /// Chooses the axes that the drops support, or takes those that are wanted. A magnitude whose impulse no vertical impact
    /// has contains sideways motion, so the axial component is taken where it was measured.
    ///
    /// # Errors
    /// When no drop can be used, or the magnitude is wanted of one that has one axis only.
    pub fn of(set: &'a DropSet, model: &Model, keep: Keep, wanted: Option<ComparedAxes>) -> Result<Self, FitError> {
        let stated = model.sensor.channel;
        let mut chosen = Chosen::of(set, wanted.map_or(stated, ComparedAxes::channel), keep)?;
        if wanted == Some(ComparedAxes::Magnitude) {
            chosen = chosen.of_all_axes()?;
        }
        let (axes, reason) = match wanted {
            Some(wanted) => (wanted, "as asked for".to_string()),
            None => supported(&chosen, model)?,
        };
        chosen.channel = axes.channel();
        let waves = chosen.waves()?;
        Ok(Self { chosen, waves, axes, stated, reason })
    }
}

/// The axes that drops support, and why.
fn supported(chosen: &Chosen, model: &Model) -> Result<(ComparedAxes, String), FitError> {
    if !chosen.has_lateral_axes() {
        return Ok((
            ComparedAxes::Axial,
            "the drops have one axis only, so that is compared; landings that are not level cannot be told from effects along it".into(),
        ));
    }
    if !chosen.has_all_axes() {
        return Ok((ComparedAxes::All, "some drops have one axis only, so the axial component is compared".into()));
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
            ComparedAxes::All,
            format!(
                "the magnitude's impulse is impossible for a vertical impact ({found}): it contains sideways motion, so the axial component is compared"
            ),
        )
    } else if model.sensor.channel == Channel::Magnitude {
        (
            ComparedAxes::Magnitude,
            "all axes were measured and the magnitude's impulse is possible: it is compared, as the model states".into(),
        )
    } else {
        (ComparedAxes::All, "all axes were measured; the axial component is compared, which is what the model predicts".into())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::measured::{FileFormat, read_bytes};

    /// Four drops from half a metre whose lateral axis reads so many times the axis, where it was measured.
    fn choice(lateral: Option<f64>, wanted: Option<ComparedAxes>) -> (ComparedAxes, Channel, String) {
        let mut text = format!("trial,height_m,t_s,accel_g{}\n", if lateral.is_some() { ",x,y,z" } else { "" });
        for trial in 0..4 {
            for i in 0..60 {
                let t_s = f64::from(i) * 1e-3;
                let since = (t_s - 0.012) / 0.012;
                // A half sine with the impulse of 1.3 v0.
                let axis = if (0.0..1.0).contains(&since) { 53.0 * libm::sin(since * std::f64::consts::PI) + 4.0 } else { 0.0 };
                text += &format!("{trial},0.5,{t_s},{axis}");
                text += &lateral.map_or(String::new(), |share| format!(",{},0,{axis}", share * axis));
                text += "\n";
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
        let model = Model::load("paper").expect("comes with the program");
        let found = ChannelChoice::of(&set, &model, Keep::Evidence, wanted).expect("can be used");
        (found.axes, found.chosen.channel, found.reason)
    }

    #[test]
    fn analytic_the_drops_decide_which_axes_are_used() {
        let (axes, channel, reason) = choice(None, None);
        assert_eq!((axes, channel), (ComparedAxes::Axial, Channel::Axial), "{reason}");
        // The paper's model states the magnitude, and a small lateral part leaves that possible.
        let (axes, channel, reason) = choice(Some(0.1), None);
        assert_eq!((axes, channel), (ComparedAxes::Magnitude, Channel::Magnitude), "{reason}");
        let (axes, channel, reason) = choice(Some(2.0), None);
        assert_eq!((axes, channel), (ComparedAxes::All, Channel::Axial), "{reason}");
        assert!(reason.contains("impossible"), "{reason}");
    }

    #[test]
    fn analytic_axes_that_are_asked_for_are_taken() {
        for axes in [ComparedAxes::Axial, ComparedAxes::Magnitude, ComparedAxes::All] {
            assert_eq!(choice(Some(2.0), Some(axes)), (axes, axes.channel(), "as asked for".into()));
        }
    }
}
