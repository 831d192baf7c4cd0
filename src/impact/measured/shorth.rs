//! Where most values lie, when up to half of them may lie anywhere else.

use super::spread::QUARTILES_APART;

/// The shortest half of some values: its middle, and the standard deviation of a normal quantity with such a half.
///
/// Source: F. R. Hampel et al., *Robust Statistics* (1986), the shorth; the middle half of a normal quantity is 1.349 standard
/// deviations long. *When it is wrong:* for fewer than eight values, and where two halves lie apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shorth {
    pub middle: f64,
    pub deviation: f64,
}

/// Fewest values.
const FEWEST: usize = 8;

impl Shorth {
    /// Of finite values; `None` for fewer than eight.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let half = sorted.len() / 2 + 1;
        if sorted.len() < FEWEST {
            return None;
        }
        let shortest = sorted.windows(half).min_by(|a, b| (a[half - 1] - a[0]).total_cmp(&(b[half - 1] - b[0])))?;
        let (low, high) = (shortest[0], shortest[half - 1]);
        Some(Self { middle: 0.5 * (low + high), deviation: (high - low) / QUARTILES_APART })
    }

    /// How many standard deviations a value lies above the middle; the deviation is at least `least`.
    pub fn above(&self, value: f64, least: f64) -> f64 {
        (value - self.middle) / self.deviation.max(least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_third_elsewhere_moves_nothing() {
        let even = (0..20).map(|i| 10.0 + 0.1 * f64::from(i));
        let shorth = Shorth::of(even.chain((0..9).map(|i| -300.0 + 37.0 * f64::from(i)))).expect("there are enough");
        assert!((10.0..12.0).contains(&shorth.middle) && shorth.deviation < 1.5, "{shorth:?}");
        assert!(shorth.above(-40.0, 0.0) < -20.0 && (shorth.above(shorth.middle + 3.0, 3.0) - 1.0).abs() < 1e-12);
        assert_eq!(Shorth::of([1.0; 7]), None);
    }
}
