//! Drag of the air in the falls of a frame, as its sensor reads it.
//!
//! A falling sensor reads zero plus the drag over the weight, β v²/g with v = g t: β g t², t from the release on. Each fall says β by a line through its
//! readings over t², whatever the sensor's zero is; the falls' middle one is taken, weighted by how sure each is. Where it is not surely above 0, it is
//! taken as 0. *When it is wrong:* a zero that drifts within a fall as t² does passes for drag.

use super::free_fall::lasting_s;
use super::impact::Impact;
use super::record::Record;
use super::spread::Spread;
use crate::units::GRAVITY_M_S2;

/// Drag over mass beyond which no body of this size and mass is, 1/m: that of the effect `air_drag`.
const MOST_1_M: f64 = 0.2;
/// Standard errors from which on drag is not nothing: a choice.
const SURE: f64 = 3.0;
/// Fewest falls whose scatter says how sure they are: a choice.
const FEWEST: usize = 5;
/// Shortest part of a fall that says where zero is, s: more than twice as long as what is compared, as an error of zero stands in all of that.
const LEAST_S: f64 = 0.08;

/// What falls read of drag.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FallDrag {
    /// Drag over mass, 1/m.
    beta_1_m: f64,
}

/// A fall's readings along the axis over the square of the time from release.
struct Line {
    /// Mean reading, g.
    mean_g: f64,
    /// Mean of t², s².
    mean_s2: f64,
    /// Drag over mass by its slope, 1/m.
    beta_1_m: f64,
    /// One over the slope's variance, in units of the noise's.
    weight: f64,
}

impl Line {
    /// Of a record; `None` for a fall that is too short.
    fn of(record: &Record, impact: &Impact) -> Option<Self> {
        let falling = impact.behind_release().filter(|falling| falling.len() >= record.samples_in(LEAST_S))?;
        let readings = &record.accel_g[falling.clone()];
        let release_s = record.t_s[impact.trigger] - lasting_s(record.height_m);
        let squares: Vec<f64> = record.t_s[falling].iter().map(|t_s| (t_s - release_s).max(0.0).powi(2)).collect();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let (mean_g, mean_s2) = (mean(readings), mean(&squares));
        let weight = squares.iter().map(|square| (square - mean_s2).powi(2)).sum::<f64>();
        let along = squares.iter().zip(readings).map(|(square, reading)| (square - mean_s2) * (reading - mean_g)).sum::<f64>();
        (weight > 0.0).then(|| Self { mean_g, mean_s2, beta_1_m: along / weight / GRAVITY_M_S2, weight })
    }
}

impl FallDrag {
    /// Of the falls of one frame; nothing where none is long enough.
    pub(super) fn of<'a>(falls: impl Iterator<Item = (&'a Record, &'a Impact)>) -> Self {
        let mut lines: Vec<Line> = falls.filter_map(|(record, impact)| Line::of(record, impact)).collect();
        lines.sort_by(|a, b| a.beta_1_m.total_cmp(&b.beta_1_m));
        let all: f64 = lines.iter().map(|line| line.weight).sum();
        let mut below = 0.0;
        let middle = lines.iter().find(|line| {
            below += line.weight;
            2.0 * below >= all
        });
        let error_1_m = Spread::of(lines.iter().map(|line| line.beta_1_m)).map_or(0.0, |spread| spread.median_error());
        let sure = |line: &&Line| lines.len() >= FEWEST && line.beta_1_m > SURE * error_1_m;
        Self { beta_1_m: middle.filter(sure).map_or(0.0, |line| line.beta_1_m.min(MOST_1_M)) }
    }

    /// The mean reading of a fall along the axis without what drag adds, g.
    pub(super) fn zero_g(self, record: &Record, impact: &Impact) -> Option<f64> {
        Line::of(record, impact).map(|line| line.mean_g - self.beta_1_m * GRAVITY_M_S2 * line.mean_s2)
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::*;

    /// Falls from some heights, m, with a zero, drag and noise, read each millisecond, and a hit at their end.
    fn falls(heights_m: &[f64], count: usize, zero_g: f64, beta_1_m: f64, noise_g: f64) -> Vec<(Record, Impact)> {
        let mut rng = Pcg64::seed_from_u64(5);
        let mut of = |height_m: f64| {
            let fall_s = (2.0 * height_m / GRAVITY_M_S2).sqrt();
            let reading = |ms: u32, noise: f64| match f64::from(ms) * 1e-3 - 0.2 {
                t_s if t_s < 0.0 => 1.0 + zero_g,
                t_s if t_s < fall_s => zero_g + beta_1_m * GRAVITY_M_S2 * t_s * t_s + noise_g * noise,
                t_s if t_s < fall_s + 0.01 => 80.0,
                _ => zero_g,
            };
            let accel_g: Vec<f64> = (0..900).map(|ms| reading(ms, StandardNormal.sample(&mut rng))).collect();
            let record = Record {
                trial: "1".into(),
                height_m,
                frame: None,
                session: None,
                source: "falls".into(),
                t_s: (0..900).map(|ms| f64::from(ms) * 1e-3).collect(),
                accel_g,
                axes_g: None,
                columns: std::collections::BTreeMap::new(),
                at_full_scale: Vec::new(),
            };
            let impact = Impact::of(&record).expect("hits");
            (record, impact)
        };
        heights_m.iter().flat_map(|height_m| (0..count).map(|_| *height_m).collect::<Vec<_>>()).map(&mut of).collect()
    }

    fn drag(falls: &[(Record, Impact)]) -> FallDrag {
        FallDrag::of(falls.iter().map(|(record, impact)| (record, impact)))
    }

    /// Drag and zero are told apart, at one height, too.
    #[test]
    fn analytic_drag_is_no_zero() {
        for heights_m in [&[1.0][..], &[0.5, 1.0, 1.5]] {
            let falls = falls(heights_m, 5, -0.15, 0.04, 0.0);
            let drag = drag(&falls);
            assert!((drag.beta_1_m - 0.04).abs() < 1e-3, "{drag:?}");
            for (record, impact) in &falls {
                let zero_g = drag.zero_g(record, impact).expect("falls long enough");
                assert!((zero_g + 0.15).abs() < 1e-3, "{zero_g}");
            }
        }
    }

    #[test]
    fn planted_with_noise_zeros_of_a_few_drops_are_near() {
        let falls = falls(&[0.5, 1.0, 1.5], 6, 0.08, 0.038, 0.17);
        let drag = drag(&falls);
        assert!((drag.beta_1_m - 0.038).abs() < 0.012, "{drag:?}");
        let zeros: Vec<f64> = falls.iter().filter_map(|(record, impact)| drag.zero_g(record, impact)).collect();
        assert!((zeros.iter().sum::<f64>() / zeros.len() as f64 - 0.08).abs() < 0.01, "{zeros:?}");
    }

    /// A zero that sinks during falls is no drag that pulls.
    #[test]
    fn analytic_drag_only_brakes() {
        let falls = falls(&[1.0], 6, 0.3, -0.05, 0.0);
        assert_eq!(drag(&falls).beta_1_m, 0.0);
        assert_eq!(drag(&[]), FallDrag::default());
    }

    /// The last hundredth of a second of a fall hardly tells drag and zero apart.
    #[test]
    fn planted_records_that_begin_shortly_before_the_hit_show_neither() {
        let cut = |(record, _): (Record, Impact)| {
            let begin = record.accel_g.iter().position(|reading| *reading > 40.0).expect("hits") - 12;
            let record = Record { t_s: record.t_s[begin..].to_vec(), accel_g: record.accel_g[begin..].to_vec(), ..record };
            let impact = Impact::of(&record).expect("hits");
            (record, impact)
        };
        let falls: Vec<(Record, Impact)> = falls(&[1.0], 8, 0.1, 0.04, 0.17).into_iter().map(cut).collect();
        assert_eq!(drag(&falls), FallDrag::default());
        assert!(falls.iter().all(|(record, impact)| drag(&falls).zero_g(record, impact).is_none()));
    }
}
