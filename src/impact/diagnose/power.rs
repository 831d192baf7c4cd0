//! How many drops an experiment needs, from simulated experiments.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::impact::fit::WaveGroup;

/// Numbers of drops that are tried.
pub const COUNTS: [usize; 14] = [4, 6, 8, 10, 12, 15, 20, 25, 30, 40, 60, 80, 120, 200];
/// Simulated experiments.
pub const SIMULATED: usize = 1000;
/// Part of them that has to succeed.
pub const POWER: f64 = 0.9;
/// A difference counts beyond so many standard errors: one in a hundred without a difference.
const CRITICAL: f64 = 2.576;

/// Fewest drops in each of two sessions from one height that show a difference of their mean waves, g, in nine of ten experiments.
///
/// Whole records are drawn with replacement, those of one session with the difference on top, and the means compared along it.
pub fn drops_to_see(group: &WaveGroup, difference_g: &[f64], seed: u64) -> Option<usize> {
    let size = difference_g.iter().map(|shift| shift * shift).sum::<f64>().sqrt();
    if size <= 0.0 || group.windows.len() < 2 {
        return None;
    }
    let along = |window: &Vec<f64>| window.iter().zip(&group.mean).zip(difference_g).map(|((w, m), d)| (w - m) * d / size).sum::<f64>();
    let records: Vec<f64> = group.windows.iter().map(along).collect();
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut session = |count: usize| {
        let drawn: Vec<f64> = (0..count).map(|_| records[rng.random_range(0..records.len())]).collect();
        let mean = drawn.iter().sum::<f64>() / count as f64;
        let variance = drawn.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count as f64 - 1.0);
        (mean, variance / count as f64)
    };
    let mut seen = |count: usize| {
        let ((a, a_var), (b, b_var)) = (session(count), session(count));
        (b + size - a).abs() > CRITICAL * (a_var + b_var).sqrt()
    };
    let share = |count: &usize| (0..SIMULATED).filter(|_| seen(*count)).count() as f64 / SIMULATED as f64;
    let mut share = share;
    COUNTS.into_iter().find(|count| share(count) >= POWER)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::fit::Decimation;

    #[test]
    fn analytic_a_difference_needs_the_drops_of_a_test_of_two_means() {
        // Even values of variance 1 and a difference of one standard deviation: 2 (2.576 + 1.282)² = 30 drops a session.
        let windows: Vec<Vec<f64>> = (0..401).map(|i| vec![(f64::from(i) - 200.0) / 200.0 * 3.0_f64.sqrt()]).collect();
        let decimation = Decimation { native_s: 1e-3, kept_s: 1e-3 };
        let group = WaveGroup { height_m: 1.0, decimation, trials: Vec::new(), mean: vec![0.0], windows };
        assert!([25, 30, 40].contains(&drops_to_see(&group, &[1.0], 1).expect("some suffice")));
        assert_eq!(drops_to_see(&group, &[0.0], 1), None);
        assert_eq!(drops_to_see(&group, &[10.0], 1), Some(4));
    }
}
