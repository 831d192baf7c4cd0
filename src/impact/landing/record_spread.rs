//! Whether single records spread as those of the population do: their peaks, their impulses, and when half of the impulse has come.
//!
//! Mean waves alone can be met by a population whose records are wrong, as legs that are too stiff with slopes that are too steep have the
//! mean of softer ones. Each of the three numbers is compared by the largest distance of two distributions (Kolmogorov and Smirnov), height
//! by height; the largest of all is judged by that of simulated sets of as many records.

/// Numbers of a record.
pub const NUMBERS: usize = 3;

/// Records of each height, and three numbers of each.
pub type SpreadNumbers = Vec<Vec<[f64; NUMBERS]>>;

/// Peak, sum, and place at which half of the sum has come, of the readings of a window.
pub fn numbers(window: impl Iterator<Item = f64> + Clone) -> [f64; NUMBERS] {
    let peak = window.clone().fold(0.0, f64::max);
    let sum: f64 = window.clone().sum();
    let (mut come, mut place) = (0.0, 0.0);
    for reading in window {
        if come + reading >= 0.5 * sum {
            place += (0.5 * sum - come) / reading.max(1e-300);
            break;
        }
        come += reading;
        place += 1.0;
    }
    [peak, sum, place]
}

/// p-value of measured records among simulated sets of the same heights.
pub fn spread_p(measured: &SpreadNumbers, simulated: &[SpreadNumbers]) -> f64 {
    let cases = || (0..measured.len()).flat_map(|height| (0..NUMBERS).map(move |number| (height, number)));
    let all: Vec<Vec<f64>> = cases()
        .map(|(height, number)| sorted(simulated.iter().flat_map(|set| set[height].iter().map(move |record| record[number]))))
        .collect();
    let largest = |set: &SpreadNumbers| {
        let distance = |((height, number), all): ((usize, usize), &Vec<f64>)| {
            let own = sorted(set[height].iter().map(|record| record[number]));
            distance(&own, all) * (own.len() as f64).sqrt()
        };
        cases().zip(&all).map(distance).fold(0.0, f64::max)
    };
    let found = largest(measured);
    let as_far = simulated.iter().filter(|set| largest(set) >= found).count();
    (as_far + 1) as f64 / (simulated.len() + 1) as f64
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Largest distance between the distributions of sorted values.
fn distance(own: &[f64], all: &[f64]) -> f64 {
    let (count, many) = (own.len() as f64, all.len() as f64);
    let off = |(at, value): (usize, &f64)| {
        let (below, up_to) = (all.partition_point(|other| other < value) as f64, all.partition_point(|other| other <= value) as f64);
        f64::max((at as f64 + 1.0) / count - below / many, up_to / many - at as f64 / count)
    };
    own.iter().enumerate().map(off).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    use super::*;

    #[test]
    fn analytic_numbers_of_a_window() {
        assert_eq!(numbers([0.0, 2.0, 4.0, 2.0].into_iter()), [4.0, 8.0, 2.5]);
    }

    #[test]
    fn analytic_wider_records_are_seen_and_equal_ones_are_not() {
        let mut rng = Pcg64::seed_from_u64(1);
        let mut set = |width: f64| -> SpreadNumbers {
            (0..2).map(|_| (0..50).map(|_| [width * (rng.random::<f64>() - 0.5), rng.random(), rng.random()]).collect()).collect()
        };
        let simulated: Vec<SpreadNumbers> = (0..99).map(|_| set(1.0)).collect();
        assert!(spread_p(&set(2.5), &simulated) <= 0.01);
        assert!(spread_p(&set(1.0), &simulated) > 0.05);
    }
}
