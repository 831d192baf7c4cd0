//! The print factor of a material from weighed parts.
//!
//! Each part's ratio, weighed over volume times density, is the material's factor, off by what this part is printed
//! fuller or emptier (scatter, the same share for every part) and by the scale's last digit (less for a heavy part). The
//! factor is the mean weighted by both, the scatter is found by the method of Paule and Mandel (1982, J. Res. NBS 87, 377), the
//! interval is that of Hartung and Knapp (2001, doi.org/10.1002/sim.1009), never narrower than the scatter asks for.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// A weighed part beside its solid, of one reading or of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// On the scale, g.
    pub weighed_g: f64,
    /// Volume times density, g.
    pub solid_g: f64,
    /// The scale's last digit, g; of several readings, the root of the sum of their squares.
    pub resolution_g: f64,
}

impl Ratio {
    /// All readings of one part as one: what this part is printed fuller or emptier by is in each of them, so they are no several parts.
    pub fn joined(readings: &[Self]) -> Self {
        let sum = |of: fn(&Self) -> f64| readings.iter().map(of).sum();
        let squares: f64 = sum(|ratio| ratio.resolution_g * ratio.resolution_g);
        Self { weighed_g: sum(|ratio| ratio.weighed_g), solid_g: sum(|ratio| ratio.solid_g), resolution_g: squares.sqrt() }
    }

    /// Weighed over solid.
    pub fn value(&self) -> f64 {
        self.weighed_g / self.solid_g
    }

    /// Variance of the ratio by rounding to the last digit.
    fn variance(&self) -> f64 {
        (self.resolution_g / self.solid_g).powi(2) / 12.0
    }
}

/// Mass of what is printed over volume times density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrintFactor {
    /// The factor.
    pub value: f64,
    /// Where it lies with 95 %; `None` for a single part, which says nothing about scatter.
    pub interval: Option<[f64; 2]>,
    /// Standard deviation from part to part beyond the scale's rounding.
    pub scatter: f64,
    /// Parts that were weighed.
    pub parts: usize,
}

impl PrintFactor {
    /// Of at least one part, each once; `None` without.
    pub fn fit(ratios: &[Ratio]) -> Option<Self> {
        let parts = ratios.len();
        if parts < 2 {
            let value = ratios.first()?.value();
            return Some(Self { value, interval: None, scatter: 0.0, parts });
        }
        let freedom = (parts - 1) as f64;
        let between = between(ratios, freedom);
        let Weighted { mean, weight, squares } = Weighted::of(ratios, between);
        let error = ((squares / freedom).max(1.0) / weight).sqrt();
        let half = student(freedom) * error;
        Some(Self { value: mean, interval: Some([mean - half, mean + half]), scatter: between.sqrt(), parts })
    }
}

/// A weighted mean.
struct Weighted {
    mean: f64,
    /// All weights together.
    weight: f64,
    /// Squares of what is off, weighted.
    squares: f64,
}

impl Weighted {
    fn of(ratios: &[Ratio], between: f64) -> Self {
        let weights = || ratios.iter().map(|ratio| (ratio.value(), 1.0 / (ratio.variance() + between)));
        let weight: f64 = weights().map(|(_, w)| w).sum();
        let mean = weights().map(|(value, w)| w * value).sum::<f64>() / weight;
        let squares = weights().map(|(value, w)| w * (value - mean).powi(2)).sum();
        Self { mean, weight, squares }
    }
}

/// The variance from part to part with which the squares are as many as they should be; 0 where rounding explains them.
fn between(ratios: &[Ratio], freedom: f64) -> f64 {
    let squares = |between: f64| Weighted::of(ratios, between).squares;
    let [mut low, mut high] = [0.0, 1.0];
    if squares(low) <= freedom {
        return 0.0;
    }
    while squares(high) > freedom {
        high *= 4.0;
    }
    // The squares fall with the variance; 60 halvings leave nothing of the bracket.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if squares(middle) > freedom { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Student's t at 97.5 %.
fn student(freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |t| t.inverse_cdf(0.975))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, Normal, Uniform};

    use super::*;

    fn exact(weighed_g: f64, solid_g: f64) -> Ratio {
        Ratio { weighed_g, solid_g, resolution_g: 1e-9 }
    }

    #[test]
    fn analytic_equal_scatter_is_the_mean_with_students_interval() {
        let found = PrintFactor::fit(&[exact(0.9, 1.0), exact(2.0, 2.0), exact(3.3, 3.0)]).expect("fits");
        // Mean 1, standard deviation 0.1, t of two degrees of freedom 4.3027.
        assert!((found.value - 1.0).abs() < 1e-9 && (found.scatter - 0.1).abs() < 1e-9, "{found:?}");
        let [low, high] = found.interval.expect("has one");
        assert!((high - 1.0 - 4.302_653 * 0.1 / 3f64.sqrt()).abs() < 1e-6 && (low + high - 2.0).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn analytic_a_coarse_scale_counts_little_for_light_parts() {
        let light = Ratio { weighed_g: 1.0, solid_g: 1.0, resolution_g: 1.0 };
        let heavy = Ratio { weighed_g: 90.0, solid_g: 100.0, resolution_g: 1.0 };
        let found = PrintFactor::fit(&[light, heavy, heavy]).expect("fits");
        assert!((found.value - 0.9).abs() < 1e-3, "{found:?}");
        assert_eq!(PrintFactor::fit(&[]), None);
        assert_eq!(PrintFactor::fit(&[heavy]).and_then(|one| one.interval), None);
    }

    #[test]
    fn planted_factors_lie_within_their_intervals() {
        let mut rng = rand_pcg::Pcg64::seed_from_u64(6);
        let scatter = Normal::new(0.0, 0.02).expect("is one");
        let sizes = Uniform::new(0.8, 6.0).expect("is one");
        let rounded = |mass: f64| (mass / 0.1).round() * 0.1;
        let mut covered = 0;
        for _ in 0..2000 {
            // Other parts each time: which way a given mass is rounded is no chance.
            let ratios = [(); 6].map(|()| {
                let solid_g = sizes.sample(&mut rng);
                Ratio { weighed_g: rounded(solid_g * (0.93 + scatter.sample(&mut rng))), solid_g, resolution_g: 0.1 }
            });
            let [low, high] = PrintFactor::fit(&ratios).and_then(|found| found.interval).expect("fits");
            covered += i32::from((low..=high).contains(&0.93));
        }
        assert!((1860..=1980).contains(&covered), "{covered} of 2000");
    }
}
