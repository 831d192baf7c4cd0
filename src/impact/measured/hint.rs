//! What the impulse says of unit and sign of the readings.

use super::impact_speed_m_s;
use super::record::{DropSet, Record};
use super::spread::Spread;
use crate::units::GRAVITY_M_S2;

/// On either side of the largest reading the impulse is taken, s.
const AROUND_S: f64 = 0.015;
/// Fewest records.
const FEWEST: usize = 3;
/// Impulse over v0 of drops that rebound little or much.
const DROP: [f64; 2] = [0.7, 2.0];

/// Readings that are not proper acceleration along the axis in g.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Hint {
    /// Another unit.
    #[error("the readings look like m/s², not g: the impulse is {over_v0:.1} v0. Give --units m/s2")]
    MetresPerSecondSquared {
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
}

impl Hint {
    /// Of all records together; `None` where half of them can be drops as they are.
    pub fn of(set: &DropSet) -> Option<Self> {
        let impulses = Spread::of(set.records().filter_map(over_v0)).filter(|spread| spread.count >= FEWEST)?;
        let over_v0 = impulses.median;
        let like = |factor: f64| [impulses.q1, impulses.q3].into_iter().all(|value| (DROP[0]..=DROP[1]).contains(&(value / factor)));
        if like(GRAVITY_M_S2) {
            Some(Self::MetresPerSecondSquared { over_v0 })
        } else if like(-GRAVITY_M_S2) {
            Some(Self::InvertedMetresPerSecondSquared { over_v0 })
        } else {
            like(-1.0).then_some(Self::Inverted { over_v0 })
        }
    }
}

/// Impulse around the largest reading along the axis, over the impact speed. No trigger is asked: its level is in g.
fn over_v0(record: &Record) -> Option<f64> {
    let accel_g = &record.accel_g;
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
    fn planted_units_and_signs_are_seen() {
        let set = |factor: f64| {
            // Half a sine of 10 ms, 1.3 v0 of 1 m.
            let top_g = 1.3 * impact_speed_m_s(1.0) / GRAVITY_M_S2 * std::f64::consts::PI / 0.02;
            let record = |trial: usize| {
                let accel_g = (0..40).map(|at| {
                    factor
                        * top_g
                        * libm::sin(std::f64::consts::PI * f64::from(at - 10) / 10.0)
                        * f64::from(u8::from((10..20).contains(&at)))
                });
                Record {
                    trial: trial.to_string(),
                    height_m: 1.0,
                    frame: None,
                    session: None,
                    source: String::new(),
                    t_s: (0..40).map(|at| 1e-3 * f64::from(at)).collect(),
                    accel_g: accel_g.collect(),
                    axes_g: None,
                    columns: std::collections::BTreeMap::new(),
                    at_full_scale: 0,
                }
            };
            DropSet::of((0..5).map(record).collect(), Vec::new())
        };
        assert_eq!(Hint::of(&set(1.0)), None);
        assert!(matches!(Hint::of(&set(9.81)), Some(Hint::MetresPerSecondSquared { over_v0 }) if (12.0..14.0).contains(&over_v0)));
        assert!(matches!(Hint::of(&set(-0.85)), Some(Hint::Inverted { over_v0 }) if (-1.2..-1.0).contains(&over_v0)));
        assert!(matches!(Hint::of(&set(-9.81)), Some(Hint::InvertedMetresPerSecondSquared { .. })));
    }
}
