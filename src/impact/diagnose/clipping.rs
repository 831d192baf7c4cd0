//! Clipping: readings that pile up at one level, a limit that can be seen without a fit.

use crate::impact::fit::{WaveGroup, Waves, normal_below, normal_density};
use crate::impact::measured::Spread;

/// A limit, and the variation of single readings below it.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Clipping {
    /// The level, g.
    pub level_g: f64,
    /// Readings at it.
    pub readings: usize,
    /// Standard deviation of a reading at it, g: of the sensor at rest.
    #[serde(skip)]
    pub noise_g: f64,
}

/// Half width of the level in units of the noise.
const HALF_WIDTH: f64 = 3.0;
/// Noise that is believed at least, g: half of a count of the paper's logger.
const LEAST_NOISE_G: f64 = 0.06;
/// Readings at the level at least.
const FEWEST: usize = 8;
/// How many times denser the level is than the readings just below it.
const DENSER: f64 = 4.0;
/// Lowest mean over the level at which readings say how they vary.
const LOWEST: f64 = 0.15;
/// Share of the clock's phase in the variance of readings from which a wave is steep. Steps of the mean are too small where it is clipped.
const STEEP: f64 = 0.1;
/// Readings of a sample that are not clipped, at least, and their share.
const FEWEST_BELOW: usize = 4;
const LEAST_BELOW: f64 = 0.25;
/// Rounds of an estimate beside clipped readings: with three quarters clipped, a hundred leave less than a hundredth.
const ROUNDS: usize = 100;

/// Finds the level at which readings pile up, when there is one: nothing lies above it, and it is far denser than what
/// lies below. Wrong where a wave itself is flat at its top and the drops do not vary.
pub fn clipping(waves: &Waves) -> Option<Clipping> {
    let mut all: Vec<f64> = waves.groups.iter().flat_map(|group| group.windows.iter().flatten().copied()).collect();
    all.sort_by(f64::total_cmp);
    let noise_g = waves.noise_g.max(LEAST_NOISE_G);
    let half = HALF_WIDTH * noise_g;
    let top = *all.last()?;
    let within = |low: f64, high: f64| all.partition_point(|reading| *reading <= high) - all.partition_point(|reading| *reading < low);
    let readings = within(top - 2.0 * half, top);
    let below = within(top - 6.0 * half, top - 2.0 * half) as f64 / 2.0;
    if readings < FEWEST || (readings as f64) < DENSER * (below + 1.0) {
        return None;
    }
    // The mean of those around the median, as readings are counts and their median is one, too.
    let median = Spread::of(all[all.len() - readings..].iter().copied())?.median;
    let at_level = all.iter().filter(|reading| (**reading - median).abs() <= half);
    let level_g = at_level.clone().sum::<f64>() / at_level.count() as f64;
    Some(Clipping { level_g, readings, noise_g })
}

impl Clipping {
    /// Standard error of the level, g: that of a mean of the readings at it, and half of a count.
    pub fn error_g(&self) -> f64 {
        libm::hypot(self.noise_g / (self.readings as f64).sqrt(), LEAST_NOISE_G)
    }

    /// Relative standard deviation of single readings, a sample each, of all heights together. Clipped readings count as censored. Samples at which
    /// the clock's phase moves readings have that of the nearest others: there they are spread over a step of the wave, not around it.
    pub fn spread(&self, waves: &Waves) -> Vec<f64> {
        let of = |sample: usize| {
            let squares: Vec<f64> = waves.groups.iter().filter_map(|group| self.relative_variance(group, sample)).collect();
            (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
        };
        let known: Vec<Option<f64>> = (0..waves.samples).map(of).collect();
        let nearest = |sample: usize| {
            let there = (0..known.len()).filter_map(|at| known[at].map(|spread| (at.abs_diff(sample), spread)));
            there.min_by_key(|(away, _)| *away).map_or(0.0, |(_, spread)| spread)
        };
        let filled: Vec<f64> = (0..known.len()).map(nearest).collect();
        let last = filled.len() - 1;
        (0..=last).map(|at| (filled[at.saturating_sub(1)] + 2.0 * filled[at] + filled[(at + 1).min(last)]) / 4.0).collect()
    }

    /// Variance of a height's readings at a sample over their squared mean; `None` where the wave is low or steep, or too few are not clipped.
    fn relative_variance(&self, group: &WaveGroup, sample: usize) -> Option<f64> {
        let readings: Vec<f64> = group.windows.iter().map(|window| window[sample]).collect();
        let (mean, variance) = censored(&readings, self.level_g - HALF_WIDTH * self.noise_g)?;
        let around = &group.mean[sample.saturating_sub(1)..(sample + 2).min(group.mean.len())];
        let rise = around.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        let of_phase = rise * rise / 12.0;
        (mean > LOWEST * self.level_g && of_phase < STEEP * variance).then(|| (variance - of_phase) / (mean * mean))
    }
}

/// Mean and variance of normal readings of which those above a level are only known to be there; `None` where too few lie below it.
///
/// By expectation and maximisation (A. P. Dempster, N. M. Laird, D. B. Rubin, J. R. Stat. Soc. B 39 (1977) 1).
fn censored(readings: &[f64], level: f64) -> Option<(f64, f64)> {
    let below: Vec<f64> = readings.iter().copied().filter(|reading| *reading < level).collect();
    let (count, above) = (readings.len() as f64, (readings.len() - below.len()) as f64);
    if below.len() < FEWEST_BELOW || (below.len() as f64) < LEAST_BELOW * count {
        return None;
    }
    let square = |mean: f64| below.iter().map(|reading| (reading - mean) * (reading - mean)).sum::<f64>();
    let sum: f64 = below.iter().sum();
    let mut mean = (sum + above * level) / count;
    let mut variance = (square(mean) + above * (level - mean) * (level - mean)) / count;
    for _ in 0..ROUNDS {
        let sd = variance.sqrt().max(1e-9);
        let z = (level - mean) / sd;
        let hazard = normal_density(z) / normal_below(-z).max(1e-300);
        let (expected, left) = (mean + sd * hazard, variance * (1.0 + z * hazard - hazard * hazard).max(0.0));
        mean = (sum + above * expected) / count;
        variance = (square(mean) + above * (left + (expected - mean) * (expected - mean))) / count;
    }
    Some((mean, variance * count / (count - 1.0)))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, Normal};
    use rand_pcg::Pcg64;

    use super::censored;

    /// Of 4000 readings mean and deviation are known to some 1.6 and 1.1 hundredths of the deviation, and less where half of them are cut.
    #[test]
    fn planted_cut_readings_keep_their_mean_and_variance() {
        let mut random = Pcg64::seed_from_u64(4);
        let law = Normal::new(50.0, 6.0).expect("a law");
        let readings: Vec<f64> = (0..4000).map(|_| law.sample(&mut random)).collect();
        for level in [1000.0, 56.0, 50.0, 47.0] {
            let cut: Vec<f64> = readings.iter().map(|reading| reading.min(level)).collect();
            let (mean, variance) = censored(&cut, level - 1e-6).expect("enough lie below");
            assert!((mean - 50.0).abs() < 0.5 && (variance.sqrt() - 6.0).abs() < 0.5, "{level} g: {mean}, {}", variance.sqrt());
        }
        assert_eq!(censored(&[47.0; 20], 46.0), None);
    }
}
