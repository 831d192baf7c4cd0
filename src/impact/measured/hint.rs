//! What the impulse says of unit, sign and axis of the readings, and of the unit of the heights.

use super::flag::RATES_HZ;
use super::impact_speed_m_s;
use super::record::{DropSet, Record};
use super::seen_fall;
use super::spread::Spread;
use crate::figures::significant;
use crate::units::GRAVITY_M_S2;

/// On either side of the largest reading the impulse is taken, s.
const AROUND_S: f64 = 0.015;
/// Fewest records.
const FEWEST: usize = 3;
/// Impulse over v0 of drops that rebound little or much.
const DROP: [f64; 2] = [0.7, 2.0];
/// Impulse over v0 of an axis across the fall, at the most.
const ACROSS: f64 = 0.35;
/// Impulse over v0 of an axis without readings, at the most.
const NOTHING: f64 = 1e-4;
/// Share of a pulse's readings above half its height that lies at its top, from which on it is cut off there; half a sine has 0.2.
const CUT_OFF: f64 = 0.5;
/// From here on heights may be centimetres, m; and v0 of one read as metres over that of the height.
const TALL_M: f64 = 5.0;
const CENTIMETRES_V0: f64 = 0.1;

/// Significant digits of a time between samples.
const STEP_DIGITS: usize = 3;
/// As it is stated, Hz; what is accepted is a little less.
const LEAST_RATE_HZ: f64 = 400.0;
/// An impulse over v0 that is not that of another unit.
const LARGE: f64 = 20.0;

/// Readings that are not proper acceleration along the axis in g.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Hint {
    /// Another unit.
    #[error("the readings look like m/s², not g: the impulse is {over_v0:.1} v0. Give --units m/s2")]
    MetresPerSecondSquared {
        /// Median impulse over the impact speed.
        over_v0: f64,
    },
    /// A smaller unit.
    #[error(
        "the readings look like mg, not g: the impulse is {over_v0:.0} v0. Give --units mg, or --units N/g where they are counts, N of them a g"
    )]
    MilliG {
        /// Median impulse over the impact speed.
        over_v0: f64,
    },
    /// The other unit and the other direction.
    #[error(
        "the readings look like m/s², not g, and the axis is inverted: the impulse is {over_v0:.1} v0. Give --units m/s2 and --columns a=-NAME"
    )]
    InvertedMetresPerSecondSquared {
        /// Median impulse over the impact speed.
        over_v0: f64,
    },
    /// The other direction.
    #[error(
        "the axis is inverted: the impulse is {over_v0:.2} v0. Give --columns a=-NAME for a table, or --counts-per-g with a minus before the third number"
    )]
    Inverted {
        /// Median impulse over the impact speed.
        over_v0: f64,
    },
    /// Another axis.
    #[error(
        "the axis carries no impulse ({size:.2} v0) and {axis} carries {of_axis:.2} v0: the axes are exchanged. Give --columns a={sign}{axis},{axis}=z,z={sign}{axis}, with the table's own names, and accel_g in place of z where it has no column z",
        size = .over_v0.abs(),
        sign = if *.of_axis < 0.0 { "-" } else { "" }
    )]
    Exchanged {
        /// Median impulse along the axis over the impact speed.
        over_v0: f64,
        /// x or y.
        axis: char,
        /// Its median impulse over the impact speed.
        of_axis: f64,
    },
    /// Far less than a drop has.
    #[error(
        "the readings are too small, or the heights too large: the impulse is {over_v0:.2} v0, that of a drop {} to {} v0. Check --units (leave out m/s2 where the readings are in g) and the logger's scale",
        DROP[0], DROP[1]
    )]
    TooSmall {
        /// Median impulse along the axis over the impact speed.
        over_v0: f64,
    },
    /// Far more than a drop has, in no unit that is known.
    #[error(
        "the readings are too large: the impulse is {over_v0:.0} v0, that of a drop {} to {} v0. Readings in counts take --units N/g, where N \
         counts are a g",
        DROP[0], DROP[1]
    )]
    TooLarge {
        /// Median impulse along the axis over the impact speed.
        over_v0: f64,
    },
    /// Times in another unit.
    #[error("the times look like {unit}, not s: samples are {} s apart. Give --units {unit}", significant(*.step_s, STEP_DIGITS))]
    Times {
        /// ms or us.
        unit: &'static str,
        /// Median time between samples as it was read, s.
        step_s: f64,
    },
    /// Too few samples a second, by times that agree with the falls.
    #[error(
        "the drops are sampled at {} Hz, and a wave is compared with a model from {:.0} Hz on: use a faster sensor, or a faster setting of \
         this one. Where the time stamps are wrong, --rate HZ replaces them",
        significant(1.0 / *.step_s, STEP_DIGITS),
        LEAST_RATE_HZ
    )]
    Slow {
        /// Median time between samples, s.
        step_s: f64,
    },
    /// Heights in another unit.
    #[error("the heights look like cm, not m: from {height_m} m the impulse is {over_v0:.2} v0. Give --units cm")]
    Centimetres {
        /// Least height as it was read, m.
        height_m: f64,
        /// Median impulse over the impact speed.
        over_v0: f64,
    },
}

impl Hint {
    /// Of all records together; `None` where half of them can be drops as they are.
    pub fn of(set: &DropSet) -> Option<Self> {
        if let Some(times) = Self::times(set) {
            return Some(times);
        }
        let along = |record: &Record| over_v0(record, &record.accel_g);
        let impulses = Spread::of(set.records().filter_map(along)).filter(|spread| spread.count >= FEWEST)?;
        let over_v0 = impulses.median;
        let like = |factor: f64| is_like(&impulses, factor);
        let height_m = set.groups.iter().map(|group| group.height_m).fold(f64::INFINITY, f64::min);
        if like(GRAVITY_M_S2) {
            Some(Self::MetresPerSecondSquared { over_v0 })
        } else if like(1e3) {
            Some(Self::MilliG { over_v0 })
        } else if like(-GRAVITY_M_S2) {
            Some(Self::InvertedMetresPerSecondSquared { over_v0 })
        } else if like(-1.0) {
            Some(Self::Inverted { over_v0 })
        } else if height_m >= TALL_M && like(CENTIMETRES_V0) {
            Some(Self::Centimetres { height_m, over_v0 })
        } else if impulses.q1.abs().max(impulses.q3.abs()) <= ACROSS {
            Self::exchanged(set, over_v0).or_else(|| Self::too_small(set, over_v0))
        } else {
            let is_large = impulses.q1.abs().min(impulses.q3.abs()) > LARGE;
            is_large.then_some(Self::TooLarge { over_v0 })
        }
    }

    /// Times in which a wave cannot be compared: of a smaller unit, where a logger has its rate and falls last as they do in it, or of few
    /// samples.
    fn times(set: &DropSet) -> Option<Self> {
        let step_s = Spread::of(set.records().filter_map(Record::step_s)).filter(|steps| steps.count >= FEWEST)?.median;
        let is_rate = |factor: f64| RATES_HZ.contains(&(1.0 / (step_s * factor)));
        if is_rate(1.0) {
            return None;
        }
        let units = [("ms", 1e-3), ("us", 1e-6)].into_iter();
        let unit = units.filter(|(_, factor)| is_rate(*factor)).find(|(_, factor)| seen_fall::is_nearer(set, *factor));
        match unit {
            Some((unit, _)) => Some(Self::Times { unit, step_s }),
            None => (1.0 / step_s < *RATES_HZ.start()).then_some(Self::Slow { step_s }),
        }
    }

    /// Far less than a drop has along every axis. A sensor that is cut off at its full scale shows little, too: its drops are left alone.
    fn too_small(set: &DropSet, over_v0_along: f64) -> Option<Self> {
        let lateral = |axis: usize| {
            let of_axis = |record: &Record| over_v0(record, record.axes_g.as_ref().map(|axes| &axes[axis][..])?);
            Spread::of(set.records().filter_map(of_axis)).map_or(0.0, |spread| spread.median.abs())
        };
        let cut_off = 2 * set.records().filter(|record| is_cut_off(record)).count() >= set.records().count();
        let too_small = over_v0_along.abs() > NOTHING && lateral(0).max(lateral(1)) <= ACROSS && !cut_off;
        too_small.then_some(Self::TooSmall { over_v0: over_v0_along })
    }

    /// The one lateral axis that has the impulse of a drop, in most records.
    fn exchanged(set: &DropSet, along_v0: f64) -> Option<Self> {
        let impulses = |axis: usize| {
            let of_axis = |record: &Record| over_v0(record, record.axes_g.as_ref().map(|axes| &axes[axis][..])?);
            Spread::of(set.records().filter_map(of_axis)).filter(|spread| spread.count >= FEWEST)
        };
        let drops = |(axis, letter)| impulses(axis).filter(|spread| is_like(spread, 1.0) || is_like(spread, -1.0)).zip(Some(letter));
        let mut found = [(0, 'x'), (1, 'y')].into_iter().filter_map(drops);
        let (spread, axis) = found.next()?;
        found.next().is_none().then_some(Self::Exchanged { over_v0: along_v0, axis, of_axis: spread.median })
    }
}

/// Whether half of some impulses are so many times those of drops.
fn is_like(impulses: &Spread, factor: f64) -> bool {
    [impulses.q1, impulses.q3].into_iter().all(|value| (DROP[0]..=DROP[1]).contains(&(value / factor)))
}

/// Whether most of what lies above half of a record's largest reading lies within a fiftieth of it.
fn is_cut_off(record: &Record) -> bool {
    let top = record.accel_g.iter().fold(0.0, |top: f64, reading| top.max(reading.abs()));
    let above = |share: f64| record.accel_g.iter().filter(|reading| reading.abs() > share * top).count() as f64;
    !record.at_full_scale.is_empty() || above(0.98) >= CUT_OFF * above(0.5).max(4.0)
}

/// Impulse around the largest reading of an axis, over the impact speed. No trigger is asked: its level is in g.
fn over_v0(record: &Record, accel_g: &[f64]) -> Option<f64> {
    let peak = (0..record.len()).max_by(|a, b| accel_g[*a].abs().total_cmp(&accel_g[*b].abs()))?;
    let around = record.samples_in(AROUND_S);
    let (from, to) = (peak.saturating_sub(around), (peak + around).min(record.len() - 1));
    let step = |at: usize| 0.5 * (accel_g[at] + accel_g[at + 1]) * (record.t_s[at + 1] - record.t_s[at]);
    let impulse_m_s = GRAVITY_M_S2 * (from..to).map(step).sum::<f64>();
    Some(impulse_m_s / impact_speed_m_s(record.height_m))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_units_signs_and_axes_are_seen() {
        let of = |factor: f64, height_m: f64, lateral: Option<[f64; 2]>| {
            // Half a sine of 10 ms, 1.3 v0 of 1 m.
            let top_g = 1.3 * impact_speed_m_s(1.0) / GRAVITY_M_S2 * std::f64::consts::PI / 0.02;
            let record = |trial: usize| {
                let readings = |factor: f64| -> Vec<f64> {
                    let pulse =
                        |at: i32| if (10..20).contains(&at) { libm::sin(std::f64::consts::PI * f64::from(at - 10) / 10.0) } else { 0.0 };
                    (0..40).map(|at| factor * top_g * pulse(at)).collect()
                };
                Record {
                    trial: trial.to_string(),
                    height_m,
                    frame: None,
                    session: None,
                    source: String::new(),
                    t_s: (0..40).map(|at| 1e-3 * f64::from(at)).collect(),
                    accel_g: readings(factor),
                    axes_g: lateral.map(|[x, y]| [readings(x), readings(y), readings(factor)]),
                    columns: std::collections::BTreeMap::new(),
                    at_full_scale: Vec::new(),
                }
            };
            DropSet::of((0..5).map(record).collect(), Vec::new())
        };
        let set = |factor: f64| of(factor, 1.0, None);
        assert_eq!(Hint::of(&set(1.0)), None);
        assert!(matches!(Hint::of(&set(9.81)), Some(Hint::MetresPerSecondSquared { over_v0 }) if (12.0..14.0).contains(&over_v0)));
        assert!(matches!(Hint::of(&set(1000.0)), Some(Hint::MilliG { .. })));
        assert!(matches!(Hint::of(&set(-0.85)), Some(Hint::Inverted { over_v0 }) if (-1.2..-1.0).contains(&over_v0)));
        assert!(matches!(Hint::of(&set(-9.81)), Some(Hint::InvertedMetresPerSecondSquared { .. })));
        assert!(matches!(Hint::of(&set(1.0 / 9.81)), Some(Hint::TooSmall { over_v0 }) if (0.12..0.14).contains(&over_v0)));
        assert_eq!(Hint::of(&set(0.0)), None);
        assert!(matches!(Hint::of(&of(1.0, 100.0, None)), Some(Hint::Centimetres { height_m: 100.0, over_v0 }) if over_v0 < 0.15));
        for (factor, unit) in [(1e3, "ms"), (1e6, "us")] {
            let mut late = set(1.0);
            let records = late.groups.iter_mut().flat_map(|group| &mut group.records);
            records.for_each(|record| record.t_s.iter_mut().for_each(|t_s| *t_s *= factor));
            assert!(matches!(Hint::of(&late), Some(Hint::Times { unit: found, .. }) if found == unit));
        }
        assert!(matches!(Hint::of(&set(2048.0)), Some(Hint::TooLarge { over_v0 }) if over_v0 > 2000.0));
        let axes = |along: f64, x: f64, y: f64| Hint::of(&of(along, 1.0, Some([x, y]))).map(|hint| hint.to_string());
        assert_eq!([axes(1.0, 0.0, 0.1), axes(0.0, 0.1, 0.2), axes(0.0, 1.0, 1.0), axes(0.8, 0.8, 0.0)], [None, None, None, None]);
        let said = axes(0.0, 0.1, -1.0).expect("y has the impulse");
        assert!(said.contains("y carries -1.29 v0") && said.contains("--columns a=-y,y=z,z=-y"), "{said}");
    }
}
