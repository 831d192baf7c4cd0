//! Falls that records show, in whatever units their readings and times are.

use super::free_fall::lasting_s;
use super::impact::{Impact, WINDOW_S};
use super::record::{DropSet, Record};
use super::spread::Spread;
use crate::units::GRAVITY_M_S2;

/// g in a unit of readings: g, m/s2, mg.
const UNITS_G: [f64; 3] = [1.0, 1.0 / GRAVITY_M_S2, 1e-3];
/// Fewest samples of a fall.
const FEWEST_SAMPLES: usize = 5;
/// Fewest falls that say something.
const FEWEST: usize = 3;

/// Whether falls last as their heights say rather in a unit of so many seconds than in seconds. Where no fall is seen: whether records in that
/// unit are long enough for an impact.
pub(super) fn is_nearer(set: &DropSet, unit_s: f64) -> bool {
    let ratios = UNITS_G.into_iter().find_map(|unit_g| {
        let ratio = |record: &Record| Some(fall_s(record, unit_g)? / lasting_s(record.height_m));
        Spread::of(set.records().filter_map(ratio)).filter(|spread| spread.count >= FEWEST)
    });
    match ratios {
        Some(ratios) => (ratios.median * unit_s).ln().abs() < ratios.median.ln().abs(),
        None => lasts_s(set).is_some_and(|lasts_s| lasts_s * unit_s > WINDOW_S),
    }
}

/// From release to first touch as it was read, s, with readings in a unit of so many g.
fn fall_s(record: &Record, unit_g: f64) -> Option<f64> {
    let scaled = |readings: &Vec<f64>| readings.iter().map(|reading| unit_g * reading).collect::<Vec<_>>();
    let in_g = Record {
        accel_g: scaled(&record.accel_g),
        axes_g: record.axes_g.as_ref().map(|axes| [0, 1, 2].map(|axis| scaled(&axes[axis]))),
        ..record.clone()
    };
    let impact = Impact::of(&in_g)?;
    impact.fall_s.filter(|_| impact.falling.len() >= FEWEST_SAMPLES)
}

/// Median length of the records as it was read, s.
fn lasts_s(set: &DropSet) -> Option<f64> {
    Spread::of(set.records().filter_map(|record| Some(record.t_s.last()? - record.t_s.first()?))).map(|spread| spread.median)
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, Hint, read_bytes};
    use super::*;

    /// Four drops from half a metre, held for 0.1 s and read until 0.2 s after the hit; times and readings in units of so many s and g.
    fn set(rate_hz: f64, unit_s: f64, unit_g: f64, held: bool) -> DropSet {
        let fall_s = lasting_s(0.5);
        let begin_s = if held { 0.0 } else { 0.15 };
        let mut text = String::from("trial,height_m,t_s,accel_g\n");
        for trial in 0..4 {
            for at in 0..((0.3 + fall_s - begin_s) * rate_hz) as u32 {
                let t_s = begin_s + f64::from(at) / rate_hz;
                let angle = (t_s - 0.1 - fall_s) / 0.02 * std::f64::consts::PI;
                let reads_g = match t_s {
                    _ if (0.0..std::f64::consts::PI).contains(&angle) => 32.0 * libm::sin(angle) + 0.01 * f64::from(trial),
                    _ if (0.1..0.12 + fall_s).contains(&t_s) => 0.02,
                    _ => 1.0,
                };
                text += &format!("{trial},0.5,{:.9},{:.6}\n", (t_s - begin_s) / unit_s, reads_g / unit_g);
            }
        }
        read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads")
    }

    #[test]
    fn planted_slow_sensors_are_told_from_times_in_another_unit() {
        for unit_g in UNITS_G {
            for rate_hz in [200.0, 100.0, 50.0] {
                for held in [true, false] {
                    let said = Hint::of(&set(rate_hz, 1.0, unit_g, held)).expect("is too slow").to_string();
                    assert!(said.starts_with(&format!("the drops are sampled at {rate_hz}")) && !said.contains("--units"), "{said}");
                }
            }
            for (unit_s, told) in [(1e-3, "ms"), (1e-6, "us")] {
                for held in [true, false] {
                    let said = Hint::of(&set(1000.0, unit_s, unit_g, held)).expect("is another unit").to_string();
                    assert!(said.ends_with(&format!("Give --units {told}")), "{held}: {said}");
                }
            }
        }
        let said = Hint::of(&set(1000.0, 1e-3, 1.0, true)).expect("is another unit").to_string();
        assert_eq!(said, "the times look like ms, not s: samples are 1.00 s apart. Give --units ms");
    }
}
