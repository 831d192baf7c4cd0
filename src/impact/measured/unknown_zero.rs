//! A sensor's zero that shows, and that records which begin too late cannot tell apart from the first touch.

use std::collections::BTreeMap;
use std::fmt;

use super::free_fall::lasting_s;
use super::impact::Impact;
use super::record::{DropSet, Record};
use super::session::{Session, mean_in_fall};
use super::spread::Spread;

/// Which axis points along the fall.
const AXIAL: usize = 2;
/// Before the trigger the ground may touch already, s: a choice.
const TOUCH_S: f64 = 0.004;
/// A record that begins so much of a fall before the trigger may hold the frame before it fell: a choice.
const WHOLE: f64 = 0.9;
/// Fewest samples before that, and fewest drops: a choice.
const FEWEST: usize = 3;
const FEWEST_DROPS: usize = 5;
/// Readings nearer to nothing are not told, g, and the drag of the air that a fall from a metre has beside them, g: the real frame's is 0.03 g.
const LEAST_G: f64 = 0.05;
const DRAG_G_M: f64 = 0.04;
/// Standard errors from which on a reading is not nothing.
const SURE: f64 = 4.0;

/// What a session reads before the impact, where its records begin too late for a zero.
///
/// *When it is wrong:* for a frame whose legs touch long before the sensor reads 3 g.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct UnknownZero {
    session: String,
    /// Median over its drops, g.
    reading_g: f64,
    drops: usize,
}

impl UnknownZero {
    /// Of every session that reads something before the impact, by name.
    pub fn all(set: &DropSet) -> Vec<Self> {
        let mut sessions: BTreeMap<String, Vec<&Record>> = BTreeMap::new();
        for record in set.records() {
            sessions.entry(Session::name_of(record)).or_default().push(record);
        }
        sessions.into_iter().filter_map(|(session, records)| Self::of(session, &records)).collect()
    }

    fn of(session: String, records: &[&Record]) -> Option<Self> {
        let hits: Vec<(&Record, Impact)> = records.iter().filter_map(|record| Some((*record, Impact::of(record)?))).collect();
        if hits.iter().any(|(record, impact)| mean_in_fall(record, impact, AXIAL).is_some()) {
            return None;
        }
        let spread = Spread::of(hits.iter().filter_map(|(record, impact)| before_touch_g(record, impact)))?;
        let height_m = hits.iter().map(|(record, _)| record.height_m).fold(0.0, f64::max);
        let (reading_g, error_g) = (spread.median, spread.median_error());
        let drag_g = if reading_g > 0.0 { DRAG_G_M * height_m } else { 0.0 };
        let is_told = spread.count >= FEWEST_DROPS && reading_g.abs() > (LEAST_G + drag_g).max(SURE * error_g);
        is_told.then_some(Self { session, reading_g, drops: spread.count })
    }
}

/// Mean reading along the axis before the ground may touch, g.
fn before_touch_g(record: &Record, impact: &Impact) -> Option<f64> {
    let readings = &record.accel_g[..impact.trigger.checked_sub(record.samples_in(TOUCH_S))?];
    let is_in_the_fall = record.t_s[impact.trigger] - record.t_s[0] < WHOLE * lasting_s(record.height_m);
    (is_in_the_fall && readings.len() >= FEWEST).then(|| readings.iter().sum::<f64>() / readings.len() as f64)
}

impl fmt::Display for UnknownZero {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { session, reading_g, drops } = self;
        write!(
            f,
            "{session}: the readings before the impact are {reading_g:.2} g (median of {drops} drops), where a falling sensor reads 0, and the \
             records begin too late to tell its zero: it stays in what is compared, and passes for an effect. Give --zero={reading_g:.2} for a \
             table, or record from before the release on"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// What is told of eight drops from a metre, recorded from so many ms before the touch on, with a zero.
    fn told(before_ms: u32, zero_g: f64) -> Vec<String> {
        let mut text = "trial,height_m,t_s,accel_g\n".to_string();
        for trial in 0..8_u32 {
            for ms in 0..before_ms + 60 {
                let since = (f64::from(ms) - f64::from(before_ms)) / 12.0;
                let impact_g = if (0.0..1.0).contains(&since) { 60.0 * libm::sin(since * std::f64::consts::PI) } else { 0.0 };
                let noise_g = 0.2 * (f64::from((ms * 7 + trial * 3) % 10) - 4.5) / 4.5;
                text += &format!("{trial},1,{},{}\n", f64::from(ms) * 1e-3, zero_g + impact_g + noise_g);
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
        UnknownZero::all(&set).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn planted_a_zero_of_short_records_is_told() {
        for zero_g in [0.2, -0.15] {
            let said = told(20, zero_g);
            assert!(said.len() == 1 && said[0].contains("1 m: the readings before the impact are"), "{said:?}");
            let stated: f64 = said[0].split("--zero=").nth(1).and_then(|rest| rest.split(' ').next()?.parse().ok()).expect("a number");
            assert!((stated - zero_g).abs() < 0.05, "{said:?}");
        }
        assert_eq!([told(20, 0.0), told(20, 0.03)], [Vec::<String>::new(), Vec::new()]);
        // Where the fall is long enough the zero is taken off.
        assert_eq!(told(200, 0.2), Vec::<String>::new());
        // Where the record begins with the touch nothing is known.
        assert_eq!(told(3, 0.2), Vec::<String>::new());
    }
}
