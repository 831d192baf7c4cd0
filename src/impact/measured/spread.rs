//! How values spread: count, quartiles, ends.

use serde::Serialize;

/// Of some values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// How many.
    pub count: usize,
    /// Least.
    pub min: f64,
    /// First quartile.
    pub q1: f64,
    /// Median.
    pub median: f64,
    /// Third quartile.
    pub q3: f64,
    /// Largest.
    pub max: f64,
}

/// How far apart the quartiles of a normal quantity lie, standard deviations.
pub const QUARTILES_APART: f64 = 1.349;

/// A quantile of sorted values, linear between the two that are nearest (type 7 of Hyndman and Fan, *Sample Quantiles in
/// Statistical Packages*, Am. Stat. 50, 1996); `None` when there is none.
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * sorted.len().checked_sub(1)? as f64;
    let (low, high) = (sorted[place.floor() as usize], sorted[place.ceil() as usize]);
    Some(low + (place - place.floor()) * (high - low))
}

impl Spread {
    /// Standard deviation of a normal quantity with these quartiles.
    pub fn deviation(&self) -> f64 {
        (self.q3 - self.q1) / QUARTILES_APART
    }

    /// Standard error of the median of a normal quantity: 1/(2 f √n), f its density there, which is √(π/2) of the mean's.
    pub fn median_error(&self) -> f64 {
        (std::f64::consts::FRAC_PI_2 / self.count as f64).sqrt() * self.deviation()
    }

    /// The middle share of values, from its lower end to its upper; `None` when there is none.
    pub fn middle(values: impl IntoIterator<Item = f64>, share: f64) -> Option<[f64; 2]> {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let outside = 0.5 * (1.0 - share);
        Some([quantile(&sorted, outside)?, quantile(&sorted, 1.0 - outside)?])
    }

    /// Of values; `None` when there is none.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = values.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let at = |share| quantile(&sorted, share);
        Some(Self { count: sorted.len(), min: at(0.0)?, q1: at(0.25)?, median: at(0.5)?, q3: at(0.75)?, max: at(1.0)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_quartiles() {
        let spread = Spread::of([4.0, 1.0, 3.0, 2.0]).expect("there are some");
        assert_eq!((spread.min, spread.q1, spread.median, spread.q3, spread.max), (1.0, 1.75, 2.5, 3.25, 4.0));
        assert_eq!(Spread::of([7.0]).map(|spread| [spread.q1, spread.median, spread.q3]), Some([7.0; 3]));
        assert_eq!(Spread::of([]), None);
    }
}
