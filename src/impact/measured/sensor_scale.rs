//! A sensor whose readings are all too small or too large, by what a drop must have.
//!
//! Over the impact speed, the impulse is 1 and the restitution. The flight to the second hit tells the restitution without the readings, so
//! that the two tell the scale together; where no flight is seen, a drop has at least 1 and at the most 2.

use std::collections::BTreeMap;
use std::fmt;

use super::flag::{Flag, flags, impulse_over_v0};
use super::free_fall::lasting_s;
use super::impact::Impact;
use super::record::{DropSet, Record};
use super::session::Session;
use super::spread::Spread;

/// Fewest drops that say something.
const FEWEST: usize = 4;
/// Scales that are let be: a flight begins later than the impact's window, and ends with a frame that has turned. Those of the paper's frames are 0.9 to 1.2.
const LET_BE: [f64; 2] = [0.75, 1.35];
/// Falls that differ from those of the heights by more than this share, as of wrong heights or wrong time stamps, say nothing of the scale.
const OTHER_FALL: f64 = 0.1;
/// What nearly all drops of a session have at least, where flights are not seen: 1, with room for slopes and for what comes behind the window.
const LEAST_OVER_V0: f64 = 0.85;
/// How far the magnitude while a frame is held may be from the scale, as a factor.
const HELD: f64 = 1.25;

/// The scale of a session's readings, where it is not near 1.
///
/// *When it is wrong:* where heights are wrong, too, and no fall is recorded that says so.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SensorScale {
    session: String,
    drops: usize,
    /// Median impulse over v0.
    over_v0: f64,
    evidence: Evidence,
}

/// What says that the impulse is not that of a drop.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Evidence {
    /// Median of 1 and the restitution by the flight, and of the readings' scale by both.
    Flight { one_and_restitution: f64, scale: f64 },
    /// It is less than any drop has.
    Least,
    /// It is more than any drop has over v0.
    Most { most: f64 },
}

impl SensorScale {
    /// Of every session whose readings are off, by name.
    pub fn all(set: &DropSet) -> Vec<Self> {
        let impacts: Vec<(&Record, Option<Impact>)> = set.records().map(|record| (record, Impact::of(record))).collect();
        let mut drops: BTreeMap<String, Vec<(&Record, &Impact)>> = BTreeMap::new();
        for (record, impact) in &impacts {
            let whole = impact.as_ref().filter(|impact| !is_saturated(record, impact));
            drops.entry(Session::name_of(record)).or_default().extend(whole.map(|impact| (*record, impact)));
        }
        let sessions = Session::all(impacts.iter().map(|(record, impact)| (*record, impact)));
        sessions.into_iter().filter_map(|session| Self::of(&session, drops.get(&session.name)?)).collect()
    }

    fn of(session: &Session, drops: &[(&Record, &Impact)]) -> Option<Self> {
        let over_v0 = |(record, impact): &(&Record, &Impact)| impact.impulse_over_v0(record.height_m);
        let one_and_restitution = |(record, impact): &(&Record, &Impact)| Some(1.0 + impact.restitution_by_flight(record.height_m)?);
        let impulses = Spread::of(drops.iter().map(over_v0)).filter(|spread| spread.count >= FEWEST)?;
        let fall = |(record, impact): &(&Record, &Impact)| Some(impact.fall_s? / lasting_s(record.height_m));
        let falls = Spread::of(drops.iter().filter_map(fall));
        if falls.is_some_and(|falls| (falls.median - 1.0).abs() > OTHER_FALL) {
            return None;
        }
        let scales = Spread::of(drops.iter().filter_map(|drop| Some(over_v0(drop) / one_and_restitution(drop)?)));
        let most = drops.iter().map(|(record, _)| *impulse_over_v0(record.height_m).end()).fold(0.0, f64::max);
        let evidence = match scales.filter(|spread| spread.count >= FEWEST) {
            Some(scales) => {
                // A frame that is caught, or hits something, has a short flight, and looks as if its readings were too large.
                let is_off = scales.q3 < LET_BE[0] || (scales.q1 > LET_BE[1] && impulses.q1 > most);
                let by_flight = Spread::of(drops.iter().filter_map(one_and_restitution)).filter(|_| is_off)?;
                Evidence::Flight { one_and_restitution: by_flight.median, scale: scales.median }
            }
            None => match impulses {
                _ if impulses.q3 < LEAST_OVER_V0 => Evidence::Least,
                _ if impulses.q1 > most => Evidence::Most { most },
                _ => return None,
            },
        };
        let is_held_alike = session.held_g.is_none_or(|held| evidence.agrees_with(held.median));
        // One axis reads 1 g at the most while the frame is held.
        let along = Spread::of(drops.iter().filter_map(|(record, impact)| held_along_g(record, impact)));
        let is_possible = along.is_none_or(|along| along.median < HELD * evidence.scale());
        (is_held_alike && is_possible).then(|| Self {
            session: session.name.clone(),
            drops: impulses.count,
            over_v0: impulses.median,
            evidence,
        })
    }
}

/// Whether a reading stands at an end of the sensor, or the top of the impact is cut off.
fn is_saturated(record: &Record, impact: &Impact) -> bool {
    flags(record, Some(impact), Vec::new()).iter().any(|flag| matches!(flag, Flag::Saturated { .. }))
}

/// Mean reading along the axis before the fall, g.
fn held_along_g(record: &Record, impact: &Impact) -> Option<f64> {
    let held = &record.accel_g[impact.held(record)?];
    Some(held.iter().sum::<f64>().abs() / held.len() as f64)
}

impl Evidence {
    /// The scale at the most.
    fn scale(&self) -> f64 {
        match self {
            Self::Flight { scale, .. } => *scale,
            Self::Least => 1.0 / HELD,
            Self::Most { .. } => f64::INFINITY,
        }
    }

    /// Whether a frame that is held, which feels 1 g, reads as this says.
    fn agrees_with(&self, held_g: f64) -> bool {
        match self {
            Self::Flight { scale, .. } => (1.0 / HELD..HELD).contains(&(held_g / scale)),
            Self::Least => held_g < 1.0 / HELD,
            Self::Most { .. } => held_g > HELD,
        }
    }
}

impl fmt::Display for SensorScale {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { session, drops, over_v0, evidence } = self;
        write!(f, "{session}: the impulse is {over_v0:.2} v0 (median of {drops} drops), ")?;
        match evidence {
            Evidence::Flight { one_and_restitution, scale } => write!(
                f,
                "and by the flight to the second hit it is {one_and_restitution:.2} v0: the readings are {scale:.2} of what they should be"
            ),
            Evidence::Least => write!(f, "and a drop has 1 v0 at least: the readings are too small"),
            Evidence::Most { most } => write!(f, "and a drop has {most:.2} v0 at the most: the readings are too large"),
        }?;
        write!(f, ", or the heights are wrong. Check the scale: --units N/g for a table, --counts-per-g for files of the logger")
    }
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, impact_speed_m_s, read_bytes};
    use crate::units::GRAVITY_M_S2;

    /// What is told of six drops from half a metre that rebound with a part of their speed, with readings of a scale, recorded for so long, ms.
    /// Before they fall they are held for 0.15 s, where that is recorded.
    fn told(restitution: f64, scale: f64, held: bool, length_ms: u32) -> Vec<String> {
        let touch_ms = 150 + 319;
        let begin_ms = if held { 0 } else { touch_ms - 40 };
        let v0 = impact_speed_m_s(0.5);
        let peak_g = (1.0 + restitution) * v0 * std::f64::consts::PI / (2.0 * 0.012 * GRAVITY_M_S2);
        let hit = |since_ms: f64| if (0.0..12.0).contains(&since_ms) { libm::sin(since_ms / 12.0 * std::f64::consts::PI) } else { 0.0 };
        let mut text = "trial,height_m,t_s,accel_g,x,y\n".to_string();
        for trial in 0..6_u32 {
            for ms in begin_ms..length_ms {
                let since_ms = f64::from(ms) - f64::from(touch_ms);
                let flight_ms = 12.0 + 2e3 * restitution * v0 / GRAVITY_M_S2;
                let held_g = f64::from(u8::from(ms < 150));
                let reads_g =
                    held_g + peak_g * (hit(since_ms) + restitution * hit(since_ms - flight_ms)) + 0.01 * f64::from((ms + trial) % 3);
                text += &format!("{trial},0.5,{},{},0,0\n", f64::from(ms) * 1e-3, scale * reads_g);
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
        set.notes.into_iter().filter(|note| note.contains("the impulse is")).collect()
    }

    #[test]
    fn planted_readings_of_another_scale_are_told_by_the_flight() {
        let length_ms = 1100;
        for (restitution, held) in [(0.3, true), (0.5, false), (0.8, false)] {
            assert_eq!(told(restitution, 1.0, held, length_ms), Vec::<String>::new());
            for scale in [0.5, 2.0] {
                let said = told(restitution, scale, held, length_ms).join("; ");
                let stated: f64 =
                    said.split("the readings are ").nth(1).and_then(|rest| rest.split(' ').next()?.parse().ok()).unwrap_or(f64::NAN);
                assert!((stated / scale - 1.0).abs() < 0.1, "{restitution}, {scale}: {said}");
            }
        }
    }

    #[test]
    fn planted_readings_of_another_scale_are_told_by_what_any_drop_has() {
        // The records end before the second hit.
        assert_eq!(told(0.3, 1.0, false, 540), Vec::<String>::new());
        assert!(told(0.3, 0.5, false, 540).join("; ").contains("1 v0 at least: the readings are too small"));
        assert!(told(0.3, 2.0, false, 540).join("; ").contains("2.08 v0 at the most: the readings are too large"));
    }
}
