//! Which of the drops that were read a fit takes.

use super::waves::{Unusable, Waves};
use crate::impact::effects::Channel;
use crate::impact::measured::{Drop, DropSet, Flag, Hint, JudgedDrops, Record};

/// Why there is nothing to fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// Drops of several frames.
    #[error("these are drops of {} frames: {}; a fit is of one, name its folders alone", .frames.len(), .frames.join(", "))]
    Frames {
        /// Their names.
        frames: Vec<String>,
    },
    /// Readings that are not what the model predicts.
    #[error(transparent)]
    Readings(#[from] Hint),
    /// All left out.
    #[error("none of the {count} drops can be fitted; `flexframe measure` says why")]
    NoDrops {
        /// How many there were.
        count: usize,
    },
    /// Mean waves need more.
    #[error(transparent)]
    Unusable(#[from] Unusable),
    /// A name that the model does not have.
    #[error("the model has no parameter `{key}`; it has {known}")]
    NoParameter {
        /// The name.
        key: String,
        /// Those there are.
        known: String,
    },
    /// A trial covariance that cannot be inverted.
    #[error("the trial covariance is singular: give more drops a height")]
    Singular,
    /// The simulation diverges at the starting values.
    #[error("the simulation diverges at the starting values: change k and c in the model file")]
    Diverges,
}

/// A drop that is not used.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct LeftOut {
    /// Its name.
    pub trial: String,
    /// What is wrong with it.
    pub reason: String,
}

/// Which drops a fit takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Every drop with a whole impact, as the paper does.
    Every,
    /// Those that fell and hit once as a vertical drop can.
    Clean,
    /// Those that hit once: an impulse that no vertical drop has is evidence for an effect, not against the drop.
    Evidence,
}

/// Drops for a fit.
#[derive(Clone, Debug)]
pub struct Chosen<'a> {
    /// By height, as they were read.
    pub drops: Vec<Drop<'a>>,
    /// What they are compared by.
    pub channel: Channel,
    /// The others.
    pub left_out: Vec<LeftOut>,
    /// Whether impossible impulses were kept: where most drops have one, they are systematic.
    pub impulses_kept: bool,
}

/// Flags that no objective can do without.
fn is_unusable(flag: &Flag) -> bool {
    matches!(flag, Flag::NoImpact | Flag::TooShort { .. } | Flag::Rate { .. } | Flag::Gap { .. })
}

impl<'a> Chosen<'a> {
    /// Chooses.
    ///
    /// # Errors
    /// When none is left, the drops are of several frames, or their unit or sign is another.
    pub fn of(set: &'a DropSet, channel: Channel, keep: Keep) -> Result<Self, FitError> {
        let frames = set.frames();
        if frames.len() > 1 {
            let frames = frames.into_iter().map(|frame| frame.unwrap_or("without a name").to_string()).collect();
            return Err(FitError::Frames { frames });
        }
        if let Some(hint) = Hint::of(set) {
            return Err(hint.into());
        }
        let judged = JudgedDrops::of(set).groups;
        let impulses_kept = keep != Keep::Clean || judged.iter().any(|(_, drops)| most_impulses_impossible(drops));
        let unwanted = |flag: &Flag| match flag {
            Flag::ClockStall { .. } | Flag::DoubleHit { .. } => keep != Keep::Every,
            Flag::Impulse { .. } => !impulses_kept,
            Flag::Saturated { .. } => false,
            flag => is_unusable(flag),
        };
        let (mut kept, mut left_out) = (Vec::new(), Vec::new());
        for drop in judged.into_iter().flat_map(|(_, drops)| drops) {
            match drop.flags.iter().find(|flag| unwanted(flag)) {
                Some(flag) => left_out.push(LeftOut { trial: drop.record.trial.clone(), reason: flag.to_string() }),
                None => kept.push(drop),
            }
        }
        if kept.is_empty() {
            return Err(FitError::NoDrops { count: left_out.len() });
        }
        Ok(Self { drops: kept, channel, left_out, impulses_kept })
    }

    /// The trigger-aligned drops.
    ///
    /// # Errors
    /// When they cannot be aligned, or are too few to estimate the trial covariance.
    pub fn waves(&self) -> Result<Waves, Unusable> {
        let drop = |drop: &Drop| super::waves::FittedDrop {
            trial: drop.record.trial.clone(),
            height_m: drop.record.height_m,
            t_s: drop.record.t_s.clone(),
            accel_g: self.series(drop.record),
        };
        Waves::of(&self.drops.iter().map(drop).collect::<Vec<_>>())
    }

    /// What of a record is compared, g.
    pub fn series(&self, record: &Record) -> Vec<f64> {
        match self.channel {
            Channel::Axial => record.accel_g.clone(),
            Channel::Magnitude => (0..record.len()).map(|sample| record.size_g(sample)).collect(),
        }
    }

    /// Whether all axes of some drop were measured.
    pub fn has_lateral_axes(&self) -> bool {
        self.drops.iter().any(|drop| drop.record.axes_g.is_some())
    }

    /// Whether all axes of every drop were measured.
    pub fn has_all_axes(&self) -> bool {
        self.drops.iter().all(|drop| drop.record.axes_g.is_some())
    }
}

fn most_impulses_impossible(drops: &[Drop]) -> bool {
    let impossible = drops.iter().filter(|drop| drop.flags.iter().any(|flag| matches!(flag, Flag::Impulse { .. }))).count();
    2 * impossible > drops.len()
}
