//! From a logger's rate to one at which waves are compared.
//!
//! An impact of 15 ms has nothing to say above a few hundred hertz, and the trial covariance of hundreds of dependent readings
//! cannot be estimated. So the readings from the trigger on are averaged in blocks: each value is the mean over one kept step. The
//! trigger is found at the logger's own rate. Over all phases of the clock, the mean of a reading is the wave's mean over its own
//! step, so the mean of a block is the wave's mean over the kept step behind the moment at which the wave crosses the trigger. That
//! is what [`super::Expected`] predicts at every rate. Where a kept step is no whole number of readings, the readings at its ends
//! count in part.

/// Rate at which waves are compared where the logger is faster, Hz: the kept rate lies from here to just below twice it.
const COMPARED_HZ: f64 = 1000.0;
/// Relative difference of steps that are the same.
const SAME: f64 = 1e-3;

/// How readings are averaged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decimation {
    /// Time between readings of the logger, s.
    pub native_s: f64,
    /// Time between kept values, s.
    pub kept_s: f64,
}

impl Decimation {
    /// The time between kept values for loggers with these steps, s: the longest of each own multiple.
    pub fn common_step_s(native_s: impl IntoIterator<Item = f64>) -> f64 {
        let own = |native_s: f64| native_s * ((1.0 + SAME) / (COMPARED_HZ * native_s)).floor().max(1.0);
        native_s.into_iter().map(own).fold(0.0, f64::max)
    }

    /// Readings in a kept value; 1 leaves everything as it is.
    pub fn readings(&self) -> f64 {
        let ratio = self.kept_s / self.native_s;
        if (ratio / ratio.round() - 1.0).abs() < SAME { ratio.round() } else { ratio }
    }

    /// Kept values: so many before the trigger's reading, and all behind it. What lies before a record's begin is free fall.
    pub fn kept(&self, readings: &[f64], trigger: usize, before: usize) -> Vec<f64> {
        let width = self.readings();
        let mut sums = vec![0.0];
        sums.extend(readings.iter().scan(0.0, |sum, reading| {
            *sum += reading;
            Some(*sum)
        }));
        let total = |place: f64| {
            let place = place.max(0.0);
            let at = (place as usize).min(readings.len() - 1);
            let part = place - at as f64;
            // Within its step a reading rises as its neighbours do.
            let rise = 0.5 * (readings[(at + 1).min(readings.len() - 1)] - readings[at.saturating_sub(1)]);
            sums[at] + part * (readings[at] - 0.5 * (1.0 - part) * rise)
        };
        let begins = (0..).map(|i| trigger as f64 + width * (f64::from(i) - before as f64));
        let whole = begins.take_while(|begin| begin + width <= readings.len() as f64 + SAME);
        if width == 1.0 {
            return whole.map(|begin| if begin < 0.0 { 0.0 } else { readings[begin as usize] }).collect();
        }
        whole.map(|begin| (total(begin + width) - total(begin)) / width).collect()
    }
}

impl std::fmt::Display for Decimation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (native_hz, kept_hz, readings) = (1.0 / self.native_s, 1.0 / self.kept_s, self.readings());
        if readings == 1.0 {
            return write!(f, "{native_hz:.0} Hz, every reading");
        }
        write!(f, "{native_hz:.0} Hz, means of {readings:.1} readings at {kept_hz:.1} Hz; the model's wave goes through the same mean")
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
    fn analytic_means_over_the_kept_step() {
        let whole = Decimation { native_s: 0.5, kept_s: 1.0 };
        assert_eq!(whole.kept(&[1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 9.0], 2, 1), [1.5, 3.5, 6.0]);
        assert_eq!(whole.kept(&[4.0, 6.0], 0, 1), [0.0, 5.0]);
        let part = Decimation { native_s: 1.0, kept_s: 1.5 };
        // Half of a step whose mean is 6 and which rises by 3 has a mean of 5.25 first, and 6.75 then.
        assert_eq!(part.kept(&[3.0, 6.0, 9.0], 0, 0), [3.75, 8.25]);
        let same = Decimation { native_s: 1.0, kept_s: 1.0 };
        assert_eq!(same.kept(&[7.0, 8.0, 9.0], 1, 1), [7.0, 8.0, 9.0]);
    }

    #[test]
    fn analytic_means_of_all_phases_are_the_waves_over_a_kept_step() {
        // A ramp and its square: the mean over phases from the crossing of 3 on.
        let wave = |t_s: f64| if t_s > 0.0 { 4e3 * t_s + 1e5 * t_s * t_s } else { 0.0 };
        let crossed_s = (-4e3 + libm::sqrt(16e6 + 12e5)) / 2e5;
        let integral = |t_s: f64| 2e3 * t_s * t_s + 1e5 / 3.0 * t_s * t_s * t_s;
        for (native_hz, kept_s) in [(3200.0, 3.0 / 3200.0), (3200.0, 1e-3), (51_200.0, 51.0 / 51_200.0)] {
            let decimation = Decimation { native_s: 1.0 / native_hz, kept_s };
            let mut mean = [0.0; 6];
            for phase in 0..200 {
                let at = |i: i32| wave((f64::from(i) - 20.0 + (f64::from(phase) + 0.5) / 200.0) / native_hz);
                let readings: Vec<f64> = (0..20 + (0.01 * native_hz) as i32).map(at).collect();
                let trigger = readings.iter().position(|reading| *reading > 3.0).expect("crosses");
                mean.iter_mut().zip(decimation.kept(&readings, trigger, 0)).for_each(|(sum, value)| *sum += value / 200.0);
            }
            for (at, mean) in mean.iter().enumerate() {
                let begin_s = crossed_s + at as f64 * kept_s;
                let expected = (integral(begin_s + kept_s) - integral(begin_s)) / kept_s;
                assert!((mean - expected).abs() < 0.02 + 2e-3 * expected, "{native_hz} {at}: {mean} {expected}");
            }
        }
    }
}
