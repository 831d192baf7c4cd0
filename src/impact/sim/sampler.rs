//! What a logger makes of the sensor's output: samples at equal steps with a phase that nobody knows, rounded to the
//! converter's counts, within its range.

use crate::paper_logger::{COUNTS_PER_G, RANGE_G, STEP_MS};

/// A logger.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampler {
    /// Samples a second.
    pub rate_hz: f64,
    /// Time of the first sample that is not before first touch, s: from 0 to one step.
    pub phase_s: f64,
    /// Counts of the converter to one g.
    pub counts_per_g: f64,
    /// Largest reading, g.
    pub range_g: f64,
}

impl Sampler {
    /// The logger of the paper's drops.
    pub const LOGGER: Self = Self { rate_hz: 1e3 / STEP_MS, phase_s: 0.0, counts_per_g: COUNTS_PER_G, range_g: RANGE_G };

    /// Time of a sample, s from first touch; negative numbers lie in the fall.
    pub fn time_s(&self, sample: i32) -> f64 {
        self.phase_s + f64::from(sample) / self.rate_hz
    }

    /// A reading as the converter gives it, g.
    pub fn quantised_g(&self, reading_g: f64) -> f64 {
        let within = reading_g.clamp(-self.range_g, self.range_g);
        (within * self.counts_per_g).round() / self.counts_per_g
    }

    /// Samples of a wave that is given at equal steps from first touch, linear between them, for as long as it lasts.
    pub fn samples(&self, wave_g: &[f64], step_s: f64) -> Vec<(f64, f64)> {
        let mut samples = Vec::new();
        for sample in 0.. {
            let time_s = self.time_s(sample);
            let place = time_s / step_s;
            // A sample that falls on a point but for rounding is that point.
            let place = if (place - place.round()).abs() < 1e-9 { place.round() } else { place };
            let at = place.floor() as usize;
            let between = place - place.floor();
            let Some(&left) = wave_g.get(at) else { break };
            let right = match wave_g.get(at + 1) {
                Some(&right) => right,
                None if between == 0.0 => left,
                None => break,
            };
            samples.push((time_s, self.quantised_g(left + between * (right - left))));
        }
        samples
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_samples_of_a_ramp() {
        let ramp: Vec<f64> = (0..=1200).map(|i| 0.01 * f64::from(i)).collect();
        let sampler = Sampler { phase_s: 0.000_31, counts_per_g: 1e9, ..Sampler::LOGGER };
        let samples = sampler.samples(&ramp, 5e-5);
        assert_eq!(samples.len(), 60);
        for (time_s, reading_g) in samples {
            assert!((reading_g - 200.0 * time_s).abs() < 1e-8, "{time_s} {reading_g}");
        }
        assert_eq!(Sampler { phase_s: 0.0, ..sampler }.samples(&ramp, 5e-5).len(), 61);
    }

    #[test]
    fn analytic_rounding_and_range() {
        let logger = Sampler::LOGGER;
        assert_eq!(logger.quantised_g(0.05), 0.0);
        assert!((logger.quantised_g(0.1) - 1.0 / COUNTS_PER_G).abs() < 1e-15);
        assert!((logger.quantised_g(1e6) - 230.0).abs() < 0.5 / COUNTS_PER_G);
        for i in 0..1000 {
            let reading_g = 0.37 * f64::from(i) - 180.0;
            assert!((logger.quantised_g(reading_g) - reading_g).abs() <= 0.5 / COUNTS_PER_G + 1e-12);
        }
    }
}
