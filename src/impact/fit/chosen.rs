//! Which of the drops that were read a fit takes.

use super::decimation::Decimation;
use super::early_end::EarlyEnd;
use super::fit_error::FitError;
use super::left_out::LeftOut;
use super::waves::{AFTER_S, LEAST, Unusable, Waves, samples_from_trigger};
use crate::impact::effects::Channel;
use crate::impact::measured::{
    Drop, DropSet, Flag, FreeFallOffset, Hint, JudgedDrops, Record, Spread, TRIGGER_G, is_sampled_every, symptoms_and_heights, usual_step_s,
};

/// Mean steps of the drops of a height differ by less, as a share of them: half of what their waves may.
const ONE_STEP: f64 = 5e-3;

/// Which drops a fit takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Every drop with a whole impact, as the paper does.
    Every,
    /// Those that fell and hit once as a vertical drop can, and whose sensor was not at its end.
    Clean,
    /// Those that hit once: an impulse that no vertical drop has, or a saturated sensor, is evidence for an effect, not against the
    /// drop.
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
        if let Some(offset) = FreeFallOffset::all(set).into_iter().find(FreeFallOffset::is_gravity) {
            return Err(FitError::Gravity(offset));
        }
        let judged = JudgedDrops::of(set).groups;
        let impulses_kept = keep != Keep::Clean || judged.iter().any(|(_, drops)| most_impulses_impossible(drops));
        let unwanted = |flag: &Flag| match flag {
            Flag::ClockStall { .. } | Flag::DoubleHit { .. } => keep != Keep::Every,
            Flag::Impulse { .. } => !impulses_kept,
            Flag::Saturated { .. } => keep == Keep::Clean,
            flag => is_unusable(flag),
        };
        let (mut kept, mut left_out) = (Vec::new(), Vec::new());
        let mut saturated = 0;
        for (group, drops) in judged {
            let of_height = drops.iter().filter(|drop| is_saturated(drop)).count();
            saturated += of_height;
            // Where most drops are saturated, the others are the weakest ones: their mean is not that of the height.
            let weakest = (keep == Keep::Clean && 2 * of_height > drops.len()).then(|| {
                format!("{of_height} of {} drops from {} m are saturated, the others are the weakest", drops.len(), group.height_m)
            });
            let step_s = usual_step_s(drops.iter().map(|drop| drop.record));
            let alike = drops.iter().map(|drop| drop.record).filter(|record| step_s.is_some_and(|step_s| is_sampled_every(record, step_s)));
            let mean_step_s = Spread::of(alike.filter_map(Record::mean_step_s)).map(|spread| spread.median);
            for drop in drops {
                let reason = drop.flags.iter().find(|flag| unwanted(flag)).map(ToString::to_string).or_else(|| weakest.clone());
                let reason = reason.or_else(|| sampled_apart(drop.record, step_s?)).or_else(|| lasting_apart(drop.record, mean_step_s?));
                match reason.or_else(|| without_impact(channel, &drop)) {
                    Some(reason) => left_out.push(LeftOut::of(drop.record, reason)),
                    None => kept.push(drop),
                }
            }
        }
        let kept = long_enough(channel, kept, &mut left_out);
        if kept.is_empty() {
            let count = left_out.len();
            return Err(if keep == Keep::Clean && 2 * saturated > count {
                FitError::Saturated { count, saturated }
            } else {
                FitError::NoDrops { count, symptoms: symptoms_and_heights(set), first: left_out.into_iter().next() }
            });
        }
        Ok(Self { drops: kept, channel, left_out, impulses_kept })
    }

    /// The same drops, of which all axes were measured, as their magnitude takes.
    ///
    /// # Errors
    /// When a drop has one axis only, whose size would pass for the magnitude.
    pub fn of_all_axes(self) -> Result<Self, FitError> {
        let one_axis = self.drops.iter().filter(|drop| drop.record.axes_g.is_none()).count();
        if one_axis == 0 { Ok(self) } else { Err(FitError::OneAxis { one_axis, count: self.drops.len() }) }
    }

    /// A name for each drop that no other from its height has: its own, or with its file and number where several have the same one.
    fn names(&self) -> Vec<String> {
        let alike = |a: &Drop, b: &Drop| a.record.height_m == b.record.height_m && a.record.trial == b.record.trial;
        let name = |(at, drop): (usize, &Drop)| {
            let same: Vec<usize> = (0..self.drops.len()).filter(|other| alike(&self.drops[*other], drop)).collect();
            match same.iter().position(|other| *other == at) {
                Some(number) if same.len() > 1 => format!("{} of {} ({})", drop.record.trial, drop.record.source, number + 1),
                _ => drop.record.trial.clone(),
            }
        };
        self.drops.iter().enumerate().map(name).collect()
    }

    /// The drop behind each window of its waves, height by height.
    pub fn behind<'b>(&'b self, waves: &Waves) -> Vec<Vec<Option<&'b Drop<'a>>>> {
        let names = self.names();
        let named = |height_m: f64, name: &String| {
            self.drops.iter().zip(&names).find(|(drop, own)| drop.record.height_m == height_m && *own == name).map(|(drop, _)| drop)
        };
        waves.groups.iter().map(|group| group.trials.iter().map(|name| named(group.height_m, name)).collect()).collect()
    }

    /// The trigger-aligned drops.
    ///
    /// # Errors
    /// When they cannot be aligned, or are too few to estimate the trial covariance.
    pub fn waves(&self) -> Result<Waves, Unusable> {
        let drop = |(drop, trial): (&Drop, String)| super::waves::FittedDrop {
            trial,
            height_m: drop.record.height_m,
            t_s: drop.record.t_s.clone(),
            accel_g: self.series(drop),
        };
        let waves = Waves::of(&self.drops.iter().zip(self.names()).map(drop).collect::<Vec<_>>());
        waves.map_err(|unusable| match unusable {
            Unusable::TooFew { height_m, count, .. } => Unusable::TooFew { height_m, count, left_out: self.left_out_at(height_m) },
            other => other,
        })
    }

    /// How many drops of a height were left out, and why most of them were, in words; empty where none were.
    fn left_out_at(&self, height_m: f64) -> String {
        let reasons = LeftOut::by_reason(self.left_out.iter().filter(|left_out| left_out.height_m == height_m));
        let all: usize = reasons.values().sum();
        let most = reasons.into_iter().max_by_key(|(_, count)| *count);
        most.map_or(String::new(), |(reason, count)| {
            format!(", {all} were left out, {count} of them by {reason} (`flexframe measure` says more)")
        })
    }

    /// What of a drop is compared, less the zeros of its session, g.
    pub fn series(&self, drop: &Drop) -> Vec<f64> {
        compared(self.channel, drop)
    }

    /// The same as it was read, zeros and all, as the paper compares it, g.
    pub fn series_as_read(&self, record: &Record) -> Vec<f64> {
        match self.channel {
            Channel::Axial => record.accel_g.clone(),
            Channel::Magnitude => (0..record.len()).map(|sample| record.size_g(sample)).collect(),
        }
    }

    /// Where the comparison ends, if a few records end before the others.
    pub fn early_end(&self) -> Option<EarlyEnd> {
        let recorded = |drop: &Drop| {
            let trigger = self.series(drop).iter().position(|reading_g| reading_g.abs() > TRIGGER_G)?;
            let Record { trial, height_m, t_s, .. } = drop.record;
            Some((trial.clone(), *height_m, t_s.last()? - t_s[trigger]))
        };
        let step_s = Decimation::common_step_s(self.drops.iter().filter_map(|drop| drop.record.mean_step_s()));
        EarlyEnd::of(&self.drops.iter().filter_map(recorded).collect::<Vec<_>>(), AFTER_S, step_s)
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

/// What of a drop is compared, less the zeros of its session, g.
fn compared(channel: Channel, drop: &Drop) -> Vec<f64> {
    match channel {
        Channel::Axial => drop.axial_g(),
        Channel::Magnitude => drop.sizes_g(),
    }
}

/// Says of a drop that what is compared of it has no impact, as where an axis is dead and the others are not.
fn without_impact(channel: Channel, drop: &Drop) -> Option<String> {
    let hits = compared(channel, drop).iter().any(|reading_g| reading_g.abs() > TRIGGER_G);
    (!hits).then(|| format!("no impact in what is compared: nothing above {TRIGGER_G} g"))
}

/// Those that have as many samples from the trigger on as a comparison needs; the others are left out.
fn long_enough<'a>(channel: Channel, drops: Vec<Drop<'a>>, left_out: &mut Vec<LeftOut>) -> Vec<Drop<'a>> {
    let step_s = Decimation::common_step_s(drops.iter().filter_map(|drop| drop.record.mean_step_s()));
    let samples = |drop: &Drop| {
        let native_s = drop.record.mean_step_s().unwrap_or(step_s);
        samples_from_trigger(&compared(channel, drop), &Decimation { native_s, kept_s: step_s }).unwrap_or(0)
    };
    let (long, short): (Vec<Drop>, Vec<Drop>) = drops.into_iter().partition(|drop| samples(drop) >= LEAST);
    left_out.extend(short.iter().map(|drop| {
        let found = samples(drop);
        LeftOut::of(drop.record, format!("too short: {found} samples to compare from first touch on, {LEAST} are needed"))
    }));
    long
}

/// Says of a record that its samples are, on average, not as far apart as those of most drops of its height, s.
fn lasting_apart(record: &Record, of_height_s: f64) -> Option<String> {
    let own_s = record.mean_step_s()?;
    let differs = (own_s / of_height_s - 1.0).abs() > ONE_STEP;
    differs.then(|| {
        format!(
            "sampled every {:.4} ms on average, the drops of this height that are compared every {:.4} ms",
            1e3 * own_s,
            1e3 * of_height_s
        )
    })
}

/// Says of a record that its samples are not as far apart as those of most drops of its height, s.
fn sampled_apart(record: &Record, of_height_s: f64) -> Option<String> {
    let own_s = record.step_s()?;
    let differs = !is_sampled_every(record, of_height_s);
    differs.then(|| {
        format!("sampled every {:.4} ms, the drops of this height that are compared every {:.4} ms", 1e3 * own_s, 1e3 * of_height_s)
    })
}

fn is_saturated(drop: &Drop) -> bool {
    drop.flags.iter().any(|flag| matches!(flag, Flag::Saturated { .. }))
}

/// Of the drops that are not saturated: a clipped impulse is too small without any effect.
fn most_impulses_impossible(drops: &[Drop]) -> bool {
    let whole: Vec<&Drop> = drops.iter().filter(|drop| !is_saturated(drop)).collect();
    let impossible = whole.iter().filter(|drop| drop.flags.iter().any(|flag| matches!(flag, Flag::Impulse { .. }))).count();
    2 * impossible > whole.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::measured::{FileFormat, read_bytes};

    /// Five drops from half a metre as a table, trials 1 to 5, each a half sine of its own height.
    fn table(least_g: f64) -> Vec<u8> {
        table_at(1000.0, least_g)
    }

    /// The same at a sampling rate, Hz.
    fn table_at(rate_hz: f64, least_g: f64) -> Vec<u8> {
        let mut text = String::from("trial,height_m,t_s,accel_g\n");
        for trial in 1..=5 {
            for sample in 0..(0.5 * rate_hz) as u32 {
                let t_s = f64::from(sample) / rate_hz;
                let into_s = t_s - 0.419;
                let peak_g = least_g + f64::from(trial);
                let accel_g = match into_s {
                    _ if t_s < 0.1 => 1.0,
                    into_s if (0.0..0.01).contains(&into_s) => peak_g * libm::sin(std::f64::consts::PI * into_s / 0.01),
                    _ => 0.0,
                };
                text += &format!("{trial},0.5,{t_s:.6},{accel_g:.4}\n");
            }
        }
        text.into_bytes()
    }

    #[test]
    fn planted_half_of_the_drops_at_another_rate_are_left_out_with_the_reason() {
        let files = [("mon.csv".into(), table_at(500.0, 50.0)), ("tue.csv".into(), table(60.0))];
        let set = read_bytes(&files, &FileFormat::default()).expect("reads");
        let chosen = Chosen::of(&set, Channel::Axial, Keep::Every).expect("the faster ones can be used");
        assert_eq!((chosen.drops.len(), chosen.left_out.len()), (5, 5));
        assert!(
            chosen
                .left_out
                .iter()
                .all(|left| left.reason == "sampled every 2.0000 ms, the drops of this height that are compared every 1.0000 ms")
        );
        assert!(chosen.drops.iter().all(|drop| drop.record.source == "tue.csv"));
    }

    #[test]
    fn planted_drops_that_cannot_be_fitted_are_refused_with_the_reason_of_the_first() {
        let text = "trial,height_m,t_s,accel_g\na,0.5,0,0\na,0.5,0.001,0\n";
        let set = read_bytes(&[("a.csv".into(), text.into())], &FileFormat::default()).expect("reads");
        let said = Chosen::of(&set, Channel::Axial, Keep::Every).expect_err("nothing hit").to_string();
        assert!(
            said.starts_with("none of the 1 drops can be fitted; the first is `a`: no impact: nothing above 3 g; `flexframe measure`"),
            "{said}"
        );
    }

    /// Five drops of three axes, of which the one along the fall is dead in the third.
    #[test]
    fn planted_a_drop_whose_compared_axis_is_dead_is_left_out_alone() {
        let mut text = String::from("trial,height_m,t_s,accel_g,x,y\n");
        for trial in 1..=5 {
            for sample in 0..90 {
                let hit = (40..50).contains(&sample);
                let push_g = if hit { 45.0 * libm::sin(0.1 * std::f64::consts::PI * (f64::from(sample - 40) + 0.5)) } else { 0.0 };
                let along_g = if trial == 3 { 0.0 } else { push_g };
                text += &format!("{trial},0.5,{:.3},{along_g:.3},{:.3},0\n", f64::from(sample) * 1e-3, 0.2 * push_g);
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into())], &FileFormat::default()).expect("reads");
        let chosen = Chosen::of(&set, Channel::Axial, Keep::Evidence).expect("four are good");
        let left_out: Vec<(&str, &str)> = chosen.left_out.iter().map(|out| (&out.trial[..], &out.reason[..])).collect();
        assert_eq!(left_out, [("3", "no impact in what is compared: nothing above 3 g")]);
        assert_eq!(chosen.waves().expect("are aligned").count(), 4);
    }

    /// Two late samples move the mean step, and not the median one; the last record ends early.
    #[test]
    fn planted_a_record_that_lasts_too_long_or_ends_too_early_is_left_out_and_refuses_no_other() {
        let rows = |trial: u32, samples: u32, late: [u32; 2]| -> String {
            let row = |sample: u32| {
                let moved = late.iter().filter(|from| sample >= **from).count() as f64;
                let t_s = (f64::from(sample) + 0.45 * moved) / 440.0;
                let push_g = if (20..25).contains(&sample) {
                    45.0 * libm::sin(0.2 * std::f64::consts::PI * (f64::from(sample - 20) + 0.5))
                } else {
                    0.0
                };
                format!("{trial},0.5,{t_s:.6},{push_g:.3}\n")
            };
            (0..samples).map(row).collect()
        };
        let mut text: String = "trial,height_m,t_s,accel_g\n".into();
        text += &(1..=4).map(|trial| rows(trial, 60, [100, 100])).collect::<String>();
        text += &rows(5, 60, [3, 9]);
        text += &rows(6, 29, [100, 100]);
        let set = read_bytes(&[("a.csv".into(), text.into())], &FileFormat::default()).expect("reads");
        let chosen = Chosen::of(&set, Channel::Axial, Keep::Evidence).expect("four are good");
        let reasons: Vec<&str> = chosen.left_out.iter().map(|out| &out.reason[..]).collect();
        let [slow, short] = reasons[..] else { panic!("{reasons:?}") };
        assert!(slow.starts_with("sampled every 2.3074") && slow.contains("on average"), "{slow}");
        assert_eq!(short, "too short: 9 samples to compare from first touch on, 10 are needed");
        assert_eq!((chosen.waves().expect("are aligned").count(), chosen.early_end()), (4, None));
    }

    /// Each window has the drop that it is of, though drops of two sessions have the same numbers.
    #[test]
    fn analytic_drops_of_one_name_are_told_apart() {
        let set = read_bytes(&[("mon.csv".into(), table(50.0)), ("tue.csv".into(), table(60.0))], &FileFormat::default()).expect("reads");
        let chosen = Chosen::of(&set, Channel::Axial, Keep::Every).expect("can be used");
        let waves = chosen.waves().expect("are aligned");
        let behind = chosen.behind(&waves);
        assert_eq!(behind.iter().map(Vec::len).collect::<Vec<_>>(), [10]);
        let most = |readings: &[f64]| readings.iter().copied().fold(0.0, f64::max);
        for (window, drop) in waves.groups[0].windows.iter().zip(&behind[0]) {
            let drop = drop.expect("is one of them");
            assert_eq!(most(window), most(&drop.record.accel_g), "{} of {}", drop.record.trial, drop.record.source);
        }
    }
}
