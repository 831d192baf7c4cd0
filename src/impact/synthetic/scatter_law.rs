//! How the readings of synthetic drops vary about their wave.
//!
//! A diagnosis estimates how drops vary. It must not depend on the law that they follow, so the generator has several.

use rand::{Rng, SeedableRng};
use rand_distr::{ChiSquared, Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::fine_wave::FINE_S;

/// A law of the coloured noise of the readings. Its standard deviation is `scatter.share` times the size that the law says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScatterLaw {
    /// The reading itself: where the wave passes zero, nothing varies.
    Proportional,
    /// The wave's magnitude smoothed over 3 ms to either side, with the same root mean square: it varies at zero, and after the wave's end.
    SmoothedEnvelope,
    /// The wave's root mean square, the same from first touch on.
    Additive,
    /// The reading, times a factor for each record after which the noise has Student's t distribution of 5 degrees of freedom.
    StudentT5,
    /// The reading, times a factor for each height, between a half and two.
    PerHeightLevel,
}

/// Degrees of freedom of Student's law.
const DEGREES: f64 = 5.0;
/// Time over which an envelope is smoothed, s.
const SMOOTHED_S: f64 = 3e-3;
/// Logarithm of the largest factor of a height.
const LEVEL: f64 = std::f64::consts::LN_2;

impl ScatterLaw {
    /// Words for the laws, in the order of [`Self::ALL`].
    pub const NAMES: [&str; 5] = ["proportional", "smoothed_envelope", "additive", "student_t5", "per_height_level"];
    /// Every law.
    pub const ALL: [Self; 5] = [Self::Proportional, Self::SmoothedEnvelope, Self::Additive, Self::StudentT5, Self::PerHeightLevel];

    /// Its word.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().zip(Self::NAMES).find(|(law, _)| **law == self).map_or("", |(_, name)| name)
    }

    /// What the noise of one record is multiplied by. A law without such a factor draws nothing.
    pub(super) fn factor(self, seed: u64, height_m: f64, rng: &mut impl Rng) -> f64 {
        match self {
            Self::Proportional | Self::SmoothedEnvelope | Self::Additive => 1.0,
            Self::StudentT5 => {
                // The variance of the quotient is DEGREES / (DEGREES - 2).
                let chi = ChiSquared::new(DEGREES).map_or(DEGREES, |law| law.sample(rng));
                ((DEGREES - 2.0) / chi).sqrt()
            }
            Self::PerHeightLevel => {
                let mut own = Pcg64::seed_from_u64(seed ^ height_m.to_bits());
                let normal: f64 = StandardNormal.sample(&mut own);
                libm::exp(LEVEL * (libm::erfc(-normal / std::f64::consts::SQRT_2) - 1.0))
            }
        }
    }

    /// The size of the noise at each point of a fine wave, g; `None` where it is the reading itself.
    pub(super) fn sizes_g(self, fine: &[f64]) -> Option<Vec<f64>> {
        let root_mean_square = |values: &[f64]| (values.iter().map(|value| value * value).sum::<f64>() / values.len().max(1) as f64).sqrt();
        let of_wave = root_mean_square(fine);
        match self {
            Self::Proportional | Self::StudentT5 | Self::PerHeightLevel => None,
            Self::Additive => Some(vec![of_wave; fine.len()]),
            Self::SmoothedEnvelope => {
                let kept = libm::exp(-FINE_S / SMOOTHED_S);
                let mut sizes: Vec<f64> = fine.iter().map(|reading| reading.abs()).collect();
                let smoothed = |state: &mut f64, size: &mut f64| {
                    *state = kept * *state + (1.0 - kept) * *size;
                    *size = *state;
                };
                let mut state = 0.0;
                sizes.iter_mut().for_each(|size| smoothed(&mut state, size));
                sizes.iter_mut().rev().for_each(|size| smoothed(&mut state, size));
                let factor = of_wave / root_mean_square(&sizes).max(1e-300);
                sizes.iter_mut().for_each(|size| *size *= factor);
                Some(sizes)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave() -> Vec<f64> {
        (0..800).map(|i| if i < 200 { 80.0 * libm::sin(std::f64::consts::PI * f64::from(i) / 200.0) } else { 0.0 }).collect()
    }

    #[test]
    fn analytic_sizes_have_the_root_mean_square_of_the_wave() {
        let square = |values: &[f64]| values.iter().map(|value| value * value).sum::<f64>();
        for law in [ScatterLaw::SmoothedEnvelope, ScatterLaw::Additive] {
            let sizes = law.sizes_g(&wave()).expect("has sizes");
            assert!((square(&sizes) / square(&wave()) - 1.0).abs() < 1e-9 && sizes[220] > 1.0, "{law:?}");
        }
        assert_eq!(ScatterLaw::StudentT5.sizes_g(&wave()), None);
    }

    #[test]
    fn analytic_factors_of_records_have_mean_square_one_and_heavy_tails_and_those_of_heights_are_fixed() {
        let mut rng = Pcg64::seed_from_u64(1);
        let factors: Vec<f64> = (0..20_000).map(|_| ScatterLaw::StudentT5.factor(1, 1.0, &mut rng)).collect();
        let moment = |power: i32| factors.iter().map(|factor| factor.powi(power)).sum::<f64>() / factors.len() as f64;
        // Kurtosis of Student's law is 9; a normal factor gives 3 times the mean fourth power.
        assert!((moment(2) - 1.0).abs() < 0.05 && moment(4) > 1.8, "{} {}", moment(2), moment(4));
        let level = |height_m: f64| ScatterLaw::PerHeightLevel.factor(7, height_m, &mut Pcg64::seed_from_u64(3));
        assert!(level(0.5) == level(0.5) && level(0.5) != level(1.0) && (0.5..=2.0).contains(&level(1.5)));
    }
}
