//! From a logger's rate to one at which waves are compared, the same for records and for a model's wave.
//!
//! An impact of 15 ms has nothing to say above a few hundred hertz, and the trial covariance of hundreds of dependent readings
//! cannot be estimated. So readings are averaged in blocks, and one value a block is kept: a moving mean of `taps` readings, kept
//! every so many. Where the rates of groups are no multiples of each other, the value is interpolated linearly between two blocks. A
//! model's wave is put through the same mean, and through the interpolation's mean over all phases: a triangle of one native step on
//! either side.

/// Time between the points of a predicted wave, s.
pub(super) const FINE_S: f64 = 5e-5;
/// Rate at which waves are compared where the logger is faster, Hz: the kept rate lies from here to just below twice it.
const COMPARED_HZ: f64 = 1000.0;
/// Relative difference of steps that are the same.
const SAME: f64 = 1e-3;
/// From here on the mean is taken as an integral.
const MANY: usize = 8;

/// How readings are averaged and thinned out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decimation {
    /// Readings in a mean; 1 leaves everything as it is.
    pub taps: usize,
    /// Time between readings of the logger, s.
    pub native_s: f64,
    /// Time between kept means, s.
    pub kept_s: f64,
}

impl Decimation {
    /// The time between kept values for loggers with these steps, s: the longest of each own multiple.
    pub fn common_step_s(native_s: impl IntoIterator<Item = f64>) -> f64 {
        let own = |native_s: f64| native_s * ((1.0 + SAME) / (COMPARED_HZ * native_s)).floor().max(1.0);
        native_s.into_iter().map(own).fold(0.0, f64::max)
    }

    /// From a logger's step to the kept one.
    pub fn new(native_s: f64, kept_s: f64) -> Self {
        Self { taps: (kept_s / native_s).round().max(1.0) as usize, native_s, kept_s }
    }

    /// Everything stays as it is.
    pub fn none(step_s: f64) -> Self {
        Self::new(step_s, step_s)
    }

    /// Whether values are interpolated between blocks.
    fn interpolates(&self) -> bool {
        (self.kept_s / (self.taps as f64 * self.native_s) - 1.0).abs() > SAME
    }

    /// Readings as they are kept.
    pub fn kept(&self, readings: &[f64]) -> Vec<f64> {
        if self.taps == 1 && !self.interpolates() {
            return readings.to_vec();
        }
        let mut sums = vec![0.0];
        sums.extend(readings.iter().scan(0.0, |sum, reading| {
            *sum += reading;
            Some(*sum)
        }));
        let mean = |last: usize| (sums[last + 1] - sums[last + 1 - self.taps]) / self.taps as f64;
        let stride = if self.interpolates() { self.kept_s / self.native_s } else { self.taps as f64 };
        let places =
            (0..).map(|i| (self.taps - 1) as f64 + stride * f64::from(i)).take_while(|place| *place <= readings.len() as f64 - 1.0);
        let value = |place: f64| {
            let (left, part) = (place as usize, place.fract());
            if part < 1e-9 { mean(left) } else { (1.0 - part) * mean(left) + part * mean((left + 1).min(readings.len() - 1)) }
        };
        places.map(value).collect()
    }

    /// How much later a kept value is stamped than the middle of what it is a mean of, s.
    pub fn delay_s(&self) -> f64 {
        0.5 * (self.taps - 1) as f64 * self.native_s
    }

    /// A wave, at steps of 0.05 ms from first touch on, as it is kept.
    pub(super) fn of_wave(&self, mut fine: Vec<f64>) -> Vec<f64> {
        if self.taps > 1 {
            fine = self.mean(&fine);
        }
        if self.interpolates() {
            // Three points with the triangle's variance.
            let side = |at: usize, by: f64| between(&fine, at as f64 * FINE_S + by * self.native_s);
            fine = (0..fine.len()).map(|at| fine[at] * 10.0 / 12.0 + (side(at, -1.0) + side(at, 1.0)) / 12.0).collect();
        }
        fine
    }

    fn mean(&self, fine: &[f64]) -> Vec<f64> {
        let (taps, native_s) = (self.taps as f64, self.native_s);
        let times = (0..fine.len()).map(|at| at as f64 * FINE_S);
        if self.taps < MANY {
            return times.map(|t_s| (0..self.taps).map(|tap| between(fine, t_s - tap as f64 * native_s)).sum::<f64>() / taps).collect();
        }
        let mut integral = vec![0.0; fine.len()];
        for at in 1..fine.len() {
            integral[at] = integral[at - 1] + 0.5 * (fine[at - 1] + fine[at]) * FINE_S;
        }
        let total = |t_s: f64| {
            let place = (t_s / FINE_S).clamp(0.0, fine.len() as f64 - 1.0);
            let at = (place as usize).min(fine.len() - 2);
            let part = place - at as f64;
            integral[at] + FINE_S * part * (fine[at] + 0.5 * part * (fine[at + 1] - fine[at]))
        };
        times.map(|t_s| (total(t_s + 0.5 * native_s) - total(t_s - (taps - 0.5) * native_s)) / (taps * native_s)).collect()
    }
}

/// A wave between its points; zero before first touch.
fn between(fine: &[f64], t_s: f64) -> f64 {
    if t_s <= 0.0 {
        return 0.0;
    }
    let place = t_s / FINE_S;
    let at = (place as usize).min(fine.len() - 2);
    fine[at] + (place - at as f64).min(1.0) * (fine[at + 1] - fine[at])
}

impl std::fmt::Display for Decimation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (native_hz, kept_hz) = (1.0 / self.native_s, 1.0 / self.kept_s);
        match self.taps {
            1 if !self.interpolates() => write!(f, "{native_hz:.0} Hz, as recorded"),
            taps => write!(
                f,
                "{native_hz:.0} Hz, moving mean of {taps} readings, kept at {kept_hz:.1} Hz; the model's wave goes through the same"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_steps_that_are_kept() {
        let near = |native_hz: &[f64], kept_hz: f64| {
            let step_s = Decimation::common_step_s(native_hz.iter().map(|hz| 1.0 / hz));
            assert!((step_s * kept_hz - 1.0).abs() < 1e-9, "{native_hz:?}: {step_s}");
        };
        near(&[400.0], 400.0);
        near(&[1000.0], 1000.0);
        near(&[1900.0], 1900.0);
        near(&[3200.0], 3200.0 / 3.0);
        near(&[51_200.0], 51_200.0 / 51.0);
        near(&[1000.0, 3200.0], 1000.0);
        near(&[500.0, 10_000.0], 500.0);
    }

    #[test]
    fn analytic_records_and_waves_are_put_through_the_same_mean() {
        // Half a sine of 12 ms, sampled from its begin on.
        let wave = |t_s: f64| if (0.0..0.012).contains(&t_s) { 90.0 * libm::sin(std::f64::consts::PI * t_s / 0.012) } else { 0.0 };
        let fine: Vec<f64> = (0..700).map(|at| wave(f64::from(at) * FINE_S)).collect();
        for (native_hz, kept_s) in [(1000.0, 1e-3), (3200.0, 3.0 / 3200.0), (10_000.0, 1e-3), (51_200.0, 51.0 / 51_200.0), (3200.0, 1e-3)] {
            let decimation = Decimation::new(1.0 / native_hz, kept_s);
            let readings: Vec<f64> = (0..(0.03 * native_hz) as usize).map(|at| wave(at as f64 / native_hz)).collect();
            let (kept, expected) = (decimation.kept(&readings), decimation.of_wave(fine.clone()));
            assert!(kept.len() >= 28, "{decimation}");
            for (at, kept) in kept.iter().enumerate() {
                let t_s = (decimation.taps - 1) as f64 / native_hz + at as f64 * kept_s;
                let off = (kept - between(&expected, t_s)).abs();
                // Interpolation differs from phase to phase: its mean is meant.
                assert!(off < if decimation.interpolates() { 1.5 } else { 0.3 }, "{decimation}, {t_s}: {off}");
            }
        }
    }
}
