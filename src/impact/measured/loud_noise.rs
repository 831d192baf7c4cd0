//! Noise that passes the trigger by itself, before there is an impact.
//!
//! The trigger is a level of the magnitude of all axes. Where one of these is noisy, it lies somewhere in the fall, and what is measured from it on,
//! second hits and the clock among them, is that of noise.

use std::fmt;

use super::impact::TRIGGER_G;
use super::record::{DropSet, Record};
use super::spread::Spread;

/// So many deviations of noise are reached in a fall of some hundred readings.
const REACHED: f64 = 4.0;
/// The readings that are looked at end so long before the largest one, s, and begin so long before that.
const BEFORE_S: f64 = 0.02;
const LOOKED_AT_S: f64 = 0.15;
/// Fewest readings.
const FEWEST: usize = 20;

/// Records with such noise.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LoudNoise {
    records: usize,
    of: usize,
    /// Median deviation of the loudest axis, g.
    noise_g: f64,
    /// The axis that is the loudest in most records; none where there is one.
    axis: Option<char>,
}

impl LoudNoise {
    /// `None` where the noise of fewer than a tenth of the records is that loud.
    pub fn of(set: &DropSet) -> Option<Self> {
        let all: Vec<(usize, f64)> = set.records().filter_map(loudest).collect();
        let loud: Vec<(usize, f64)> = all.iter().copied().filter(|(_, noise_g)| REACHED * noise_g > TRIGGER_G).collect();
        if loud.is_empty() || 10 * loud.len() < all.len() {
            return None;
        }
        let axis = (0..3).max_by_key(|axis| loud.iter().filter(|(own, _)| own == axis).count())?;
        let has_axes = set.records().any(|record| record.axes_g.is_some());
        let noise_g = Spread::of(loud.iter().map(|(_, noise_g)| *noise_g))?.median;
        Some(Self { records: loud.len(), of: all.len(), noise_g, axis: has_axes.then(|| ['x', 'y', 'z'][axis]) })
    }
}

/// The axis with the largest deviation before the impact, and that deviation, g.
fn loudest(record: &Record) -> Option<(usize, f64)> {
    let largest = (0..record.len()).max_by(|a, b| record.size_g(*a).total_cmp(&record.size_g(*b)))?;
    let end = largest.checked_sub(record.samples_in(BEFORE_S))?;
    let span = end.saturating_sub(record.samples_in(LOOKED_AT_S))..end;
    if span.len() < FEWEST {
        return None;
    }
    let deviation = |readings: &[f64]| Spread::of(readings[span.clone()].iter().copied()).map(|spread| spread.deviation());
    match &record.axes_g {
        Some(axes) => (0..3).filter_map(|axis| Some((axis, deviation(&axes[axis])?))).max_by(|a, b| a.1.total_cmp(&b.1)),
        None => Some((0, deviation(&record.accel_g)?)),
    }
}

impl fmt::Display for LoudNoise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { records, of, noise_g, axis } = self;
        let (whose, remedy) = match axis {
            Some(axis) => (format!("noise of {noise_g:.2} g on the axis {axis}"), ", or leave that axis out with --columns"),
            None => (format!("noise of {noise_g:.2} g"), ""),
        };
        write!(
            f,
            "{records} of {of} drops have {whose} before the impact, which passes the trigger of {TRIGGER_G} g by itself: second hits and stalled clocks \
             that are told of them may be noise. Filter the readings at the logger{remedy}"
        )
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::super::{FileFormat, read_bytes};

    /// Drops with a pulse at 0.3 s whose axis y has so much noise.
    fn told(noise_g: f64) -> Option<String> {
        let mut rng = Pcg64::seed_from_u64(3);
        let mut text = String::from("trial,height_m,t_s,accel_g,x,y,z\n");
        for trial in 0..6 {
            for at in 0..400 {
                let t_s = 1e-3 * f64::from(at);
                let along_g = if (300..310).contains(&at) { 60.0 } else { 0.0 };
                let noise: f64 = StandardNormal.sample(&mut rng);
                text += &format!("{trial},0.5,{t_s},{along_g},0.01,{:.4},{along_g}\n", noise_g * noise);
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into())], &FileFormat::default()).expect("reads");
        set.notes.into_iter().find(|note| note.contains("passes the trigger"))
    }

    #[test]
    fn planted_noise_beyond_a_quarter_of_the_trigger_is_told_with_its_axis() {
        assert_eq!(told(0.3), None);
        let loud = told(1.2).expect("is told");
        assert!(loud.starts_with("6 of 6 drops have noise of 1.") && loud.contains("on the axis y"), "{loud}");
    }
}
