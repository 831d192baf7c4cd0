//! How many drops an experiment needs, from simulated experiments.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::impact::fit::WaveGroup;

/// Numbers of drops that are tried.
pub const COUNTS: [usize; 14] = [4, 6, 8, 10, 12, 15, 20, 25, 30, 40, 60, 80, 120, 200];
/// Simulated experiments.
pub const SIMULATED: usize = 1000;
/// Part of them that has to succeed.
pub const POWER: f64 = 0.9;
/// A difference counts with a p-value below this.
const SIGNIFICANT: f64 = 0.01;

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
    let mut session =
        |count: usize, shift: f64| -> Vec<f64> { (0..count).map(|_| records[rng.random_range(0..records.len())] + shift).collect() };
    let mut seen = |count: usize| welch_p(&session(count, 0.0), &session(count, size)) < SIGNIFICANT;
    let share = |count: &usize| (0..SIMULATED).filter(|_| seen(*count)).count() as f64 / SIMULATED as f64;
    let mut share = share;
    COUNTS.into_iter().find(|count| share(count) >= POWER)
}

/// p-value of a difference of two means whose variances are estimated and need not be equal (B. L. Welch, *Biometrika* 34, 1947). 0 where neither
/// varies.
fn welch_p(a: &[f64], b: &[f64]) -> f64 {
    let of = |values: &[f64]| {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        (mean, values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0) / count, count - 1.0)
    };
    let ((mean_a, of_a, free_a), (mean_b, of_b, free_b)) = (of(a), of(b));
    let freedom = (of_a + of_b).powi(2) / (of_a * of_a / free_a + of_b * of_b / free_b);
    let t = (mean_b - mean_a).abs() / (of_a + of_b).sqrt();
    StudentsT::new(0.0, 1.0, freedom).map_or(0.0, |law| 2.0 * law.sf(t))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_without_a_difference_one_in_a_hundred_is_seen() {
        let mut rng = Pcg64::seed_from_u64(7);
        for count in [4, 20] {
            let mut normal = || -> Vec<f64> { (0..count).map(|_| StandardNormal.sample(&mut rng)).collect() };
            let seen = (0..20_000).filter(|_| welch_p(&normal(), &normal()) < SIGNIFICANT).count();
            assert!((130..250).contains(&seen), "{seen} of 20,000 with {count} drops");
        }
    }
    use crate::impact::fit::Decimation;
    use rand_distr::{Distribution, StandardNormal};

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
