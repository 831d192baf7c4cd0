//! What a drop's own touch times say of its slope, and of its wave.

use nalgebra::DVector;

use super::bell::Bell;
use super::population::Population;
use super::table::LandingTable;
use super::touches::{LAST_S, LegTouches};
use crate::impact::wide_registers::{Loops, with_wide_registers};

/// Times that belong to no touch lie evenly within this, s: touches are looked for as long.
const STRAY_S: f64 = LAST_S;
/// A spike of this size is as often a stray as not, g.
const STRAY_G: f64 = 15.0;
/// Part of the largest spikes that are strays.
const LEAST_STRAY: f64 = 0.05;

/// A drop's landing by its touches.
#[derive(Clone, Debug)]
pub struct SlopeEstimate {
    /// Expected slope, rad.
    pub slope_rad: f64,
    /// Its standard deviation, rad.
    pub deviation_rad: f64,
    /// Expected angle of the slope to the nearest diagonal, rad.
    pub direction_rad: f64,
    /// Expected window, g.
    pub window: DVector<f64>,
}

/// The expected landing of a drop from its touch times, which were read with a standard deviation of `read_s`, slopes being distributed as
/// in a population.
pub fn given_touches(population: &Population, touches: &LegTouches, read_s: f64) -> SlopeEstimate {
    let table = population.table();
    let (weights, sum) = weights_given_touches(population, touches, read_s);
    let (mut slope_rad, mut square, mut direction_rad) = (0.0, 0.0, 0.0);
    for (point, weight) in table.points.iter().zip(weights.iter()) {
        slope_rad += weight * point.slope_rad / sum;
        square += weight * point.slope_rad * point.slope_rad / sum;
        direction_rad += weight * point.direction_rad / sum;
    }
    let window = table.window(weights.iter().copied()) / sum;
    SlopeEstimate { slope_rad, deviation_rad: (square - slope_rad * slope_rad).max(0.0).sqrt(), direction_rad, window }
}

/// The window of [`given_touches`] alone, g: what fits compare.
pub fn window_given_touches(population: &Population, touches: &LegTouches, read_s: f64) -> DVector<f64> {
    let (weights, sum) = weights_given_touches(population, touches, read_s);
    population.table().window(weights.iter().copied()) / sum
}

/// How probable each of a table's landings is, and the sum of all; where touches contradict every landing, as in the population.
fn weights_given_touches(population: &Population, touches: &LegTouches, read_s: f64) -> (DVector<f64>, f64) {
    let mut weights = population.weights().clone();
    let sum = weigh(&mut weights, population.table(), touches, read_s);
    if sum > 0.0 { (weights, sum) } else { (population.weights().clone(), 1.0) }
}

/// The likelihood of touch times at each of a table's landings, 1/s³: each foot's time was read with a normal error of `read_s`, or belongs to no
/// touch. A foot that touches later than is looked for has no other time than one of those.
pub fn likelihoods(table: &LandingTable, touches: &LegTouches, read_s: f64) -> DVector<f64> {
    let mut weights = DVector::from_element(table.delays_s.len(), 1.0);
    weigh(&mut weights, table, touches, read_s);
    weights
}

/// Multiplies weights of a table's landings by the likelihood of touch times; their sum afterwards.
fn weigh(weights: &mut DVector<f64>, table: &LandingTable, touches: &LegTouches, read_s: f64) -> f64 {
    let seen = [touches.opposite, touches.beside[0], touches.beside[1]];
    let stray = seen.map(|touch| libm::exp(-touch.size_g / STRAY_G).clamp(LEAST_STRAY, 1.0));
    let per_s = 1.0 / read_s;
    let height = per_s / (2.0 * std::f64::consts::PI).sqrt();
    with_wide_registers(Weighing {
        weights: weights.as_mut_slice(),
        delays_s: &table.delays_s,
        seen_s: seen.map(|touch| touch.delay_s),
        per_s,
        strays_1_s: stray.map(|stray| stray / STRAY_S),
        heights_1_s: stray.map(|stray| (1.0 - stray) * height),
    })
}

/// Weights of landings that are multiplied by the likelihood of touch times.
struct Weighing<'a> {
    weights: &'a mut [f64],
    delays_s: &'a [[f64; 3]],
    seen_s: [f64; 3],
    /// One over the standard deviation of a time that was read.
    per_s: f64,
    /// Density of times that belong to no touch, and the largest one of those that do.
    strays_1_s: [f64; 3],
    heights_1_s: [f64; 3],
}

impl Weighing<'_> {
    #[inline(always)]
    fn likelihood(&self, bell: Bell, delays_s: &[f64; 3]) -> f64 {
        let mut product = 1.0;
        for (foot, delay_s) in delays_s.iter().enumerate() {
            let off = (self.seen_s[foot] - delay_s) * self.per_s;
            let read_1_s = self.strays_1_s[foot] + self.heights_1_s[foot] * bell.at(off);
            product *= if *delay_s > STRAY_S { STRAY_S.recip() } else { read_1_s };
        }
        product
    }
}

/// Sums that are added to in turn, so that none waits for the one before.
const SUMS: usize = 4;

impl Loops for Weighing<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let bell = Bell::new();
        let mut sums = [0.0; SUMS];
        let count = self.weights.len().min(self.delays_s.len());
        for at in 0..count {
            let weight = self.weights[at] * self.likelihood(bell, &self.delays_s[at]);
            self.weights[at] = weight;
            sums[at % SUMS] += weight;
        }
        sums.iter().sum()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Written down once more, with the curve itself; in wide registers and in narrow ones it has the same bits.
        #[test]
        fn analytic_weights_are_multiplied_by_the_likelihood_of_each_touch(
            landings in prop::collection::vec((0.0_f64..1.0, prop::array::uniform3(0.0_f64..0.02)), 1..40),
            seen_s in prop::array::uniform3(0.0_f64..0.015),
            stray in prop::array::uniform3(0.05_f64..1.0),
        ) {
            let (read_s, delays_s) = (4e-4, landings.iter().map(|(_, delays_s)| *delays_s).collect::<Vec<_>>());
            let before: Vec<f64> = landings.iter().map(|(weight, _)| *weight).collect();
            let height_1_s = 1.0 / (read_s * (2.0 * std::f64::consts::PI).sqrt());
            let [mut wide, mut narrow] = [before.clone(), before.clone()];
            let weighing = |weights| Weighing {
                weights,
                delays_s: &delays_s,
                seen_s,
                per_s: 1.0 / read_s,
                strays_1_s: stray.map(|stray| stray / STRAY_S),
                heights_1_s: stray.map(|stray| (1.0 - stray) * height_1_s),
            };
            let [sum, narrow_sum] = [with_wide_registers(weighing(&mut wide)), weighing(&mut narrow).run()];
            prop_assert_eq!((sum, &wide), (narrow_sum, &narrow));
            for ((weight, delays_s), found) in landings.iter().zip(&wide) {
                let each = |foot: usize| {
                    if delays_s[foot] > STRAY_S {
                        return 1.0 / STRAY_S;
                    }
                    let off = (seen_s[foot] - delays_s[foot]) / read_s;
                    stray[foot] / STRAY_S + (1.0 - stray[foot]) * height_1_s * libm::exp(-0.5 * off * off)
                };
                let expected = weight * each(0) * each(1) * each(2);
                prop_assert!((found - expected).abs() <= 1e-3 * expected, "{found} {expected}");
            }
            prop_assert!((sum - wide.iter().sum::<f64>()).abs() <= 1e-12 * sum);
        }
    }
}
