//! What a drop's lateral axes show of its feet.
//!
//! A foot that touches pushes the frame away from it: a spike of 1 to 2 ms along its diagonal. All four feet are read together as
//! spikes of one shape ([`SpikeShape`]), beginning with the largest within 2 ms of the trigger. Source: the CogniFly
//! drops; feet stand on the diagonals of the sensor's x and y. *When it is wrong:* two feet of one diagonal that touch within half a
//! millisecond cancel each other; sizes say how far to trust a time.

use std::f64::consts::FRAC_1_SQRT_2;

use super::simulation::FEET;
use super::spike::{Channel, Spike, SpikeShape};
use super::touches::{LAST_S, LegTouches, Touch};
use crate::impact::measured::Drop;

/// The first touch is looked for in so long a time behind the trigger, s.
const FIRST_S: f64 = 2e-3;
/// About the length of a spike, s.
const SPIKE_S: f64 = 1e-3;
/// Readings before the trigger that may show the first spike's begin, s.
const BEFORE_S: f64 = 2e-3;
/// Time between the readings that are compared with spikes, s; slower loggers keep their own.
const CHANNEL_STEP_S: f64 = 0.25e-3;
/// Part of the largest spike that one needs to be the first.
const BELIEVED: f64 = 0.3;

/// The spikes of the first foot and of the opposite one, and of the two beside.
pub(super) type FourSpikes = [[Spike; 2]; 2];

/// What a drop's lateral axes show.
pub(super) struct LateralReadings {
    /// The foot whose spike is the largest.
    first: usize,
    /// When the first spike seems to begin, s.
    begin_s: f64,
    direction_rad: f64,
    /// Toward the side to which the first foot pushes, and toward the one to which the next foot does.
    pub(super) channels: [Channel; 2],
}

impl LateralReadings {
    /// Of a drop; `None` where its lateral axes were not measured, or its record ends too soon.
    pub(super) fn of(drop: &Drop) -> Option<Self> {
        let (t_s, [x, y, _]) = drop.aligned_axes()?;
        let along = |sign: f64| x.iter().zip(&y).map(|(x, y)| FRAC_1_SQRT_2 * (x + sign * y)).collect();
        Self::of_diagonals(&t_s, [along(1.0), along(-1.0)])
    }

    /// Of readings along the two diagonals of the sensor's x and y.
    pub(super) fn of_diagonals(t_s: &[f64], diagonals_g: [Vec<f64>; 2]) -> Option<Self> {
        let at = |foot: usize, at: usize| toward(foot, [diagonals_g[0][at], diagonals_g[1][at]]);
        let start = t_s.partition_point(|t_s| *t_s < 1e-9);
        let first_end = t_s.partition_point(|t_s| *t_s < FIRST_S + SPIKE_S + 1e-9);
        if start >= first_end || *t_s.last()? < LAST_S {
            return None;
        }
        let (first, peak) =
            (0..FEET).flat_map(|foot| (start..first_end).map(move |at| (foot, at))).max_by(|a, b| at(a.0, a.1).total_cmp(&at(b.0, b.1)))?;
        let step_s = (t_s.last()? - t_s.first()?) / (t_s.len() as f64 - 1.0);
        let span = t_s.partition_point(|t_s| *t_s < -BEFORE_S)..t_s.partition_point(|t_s| *t_s < LAST_S + SPIKE_S);
        // Faster loggers are averaged: a shape with corners every half millisecond shows no more.
        let together = (CHANNEL_STEP_S / step_s).round().max(1.0) as usize;
        let blocks: Vec<std::ops::Range<usize>> = span.clone().step_by(together).map(|at| at..(at + together).min(span.end)).collect();
        let mean =
            |block: &std::ops::Range<usize>, value: &dyn Fn(usize) -> f64| block.clone().map(value).sum::<f64>() / block.len() as f64;
        let channel = |foot: usize| Channel {
            t_s: blocks.iter().map(|block| mean(block, &|at| t_s[at])).collect(),
            along_g: blocks.iter().map(|block| mean(block, &|place| at(foot, place))).collect(),
        };
        Some(Self {
            first,
            begin_s: t_s[peak] - 0.5 * SPIKE_S,
            direction_rad: direction_of_longest(start..first_end, &diagonals_g)?,
            channels: [channel(first), channel(beside(first)[0])],
        })
    }

    /// As the sum of spikes of one shape that explains them best.
    pub(super) fn read(&self, shape: &SpikeShape) -> FourSpikes {
        let span_s = [self.begin_s - SPIKE_S, LAST_S];
        [shape.read(&self.channels[0], span_s, Some(self.begin_s)), shape.read(&self.channels[1], span_s, None)]
    }

    /// What these spikes say of the feet.
    pub(super) fn touches(&self, [own, other]: &FourSpikes) -> LegTouches {
        let feet = [self.first, self.first ^ 1, beside(self.first)[0], beside(self.first)[1]];
        let spikes = [own[0], own[1], other[0], other[1]];
        let at = first_of(&spikes);
        let first_s = spikes[at].at_s;
        let touch = |at: usize| Touch { delay_s: (spikes[at].at_s - first_s).max(0.0), size_g: spikes[at].size_g };
        let mut beside = beside(at).map(touch);
        beside.sort_by(|a, b| a.delay_s.total_cmp(&b.delay_s));
        LegTouches { first: feet[at], first_size_g: spikes[at].size_g, direction_rad: self.direction_rad, opposite: touch(at ^ 1), beside }
    }
}

/// The foot that touched first: the earliest one, not the one with the largest spike. Where two touch nearly together, the times of
/// the wrong one's opposite foot are too short.
pub(super) fn first_of(spikes: &[Spike; FEET]) -> usize {
    let largest = spikes.iter().map(|spike| spike.size_g).fold(0.0, f64::max);
    let believed = |at: &usize| spikes[*at].size_g >= BELIEVED * largest;
    (0..FEET).filter(believed).min_by(|a, b| spikes[*a].at_s.total_cmp(&spikes[*b].at_s)).unwrap_or(0)
}

/// Angle to the sensor's x of the largest lateral reading. It is not taken from the largest reading along a diagonal: such a choice prefers
/// diagonals, also of noise that has no direction.
fn direction_of_longest(span: std::ops::Range<usize>, [one, other]: &[Vec<f64>; 2]) -> Option<f64> {
    let longest = span.max_by(|a, b| libm::hypot(one[*a], other[*a]).total_cmp(&libm::hypot(one[*b], other[*b])))?;
    Some(libm::atan2(one[longest] - other[longest], one[longest] + other[longest]))
}

/// The reading toward a foot's push, of those along the two diagonals.
fn toward(foot: usize, diagonals_g: [f64; 2]) -> f64 {
    let diagonal = diagonals_g[foot / 2];
    if foot.is_multiple_of(2) { diagonal } else { -diagonal }
}

/// The feet at the ends of the other diagonal.
pub(super) fn beside(foot: usize) -> [usize; 2] {
    let next = (foot + 2) % FEET;
    [next, next ^ 1]
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::*;
    use crate::impact::landing::evidence::is_along_a_diagonal;

    /// A third of all directions are within 15 degrees of a diagonal. By the largest reading along a diagonal it would be half of these.
    #[test]
    fn analytic_noise_without_a_direction_has_a_third_along_diagonals() {
        let mut rng = Pcg64::seed_from_u64(4);
        let t_s: Vec<f64> = (-200..300).map(|i| 1e-4 * f64::from(i)).collect();
        let sets = 600;
        let along = (0..sets)
            .filter(|_| {
                let mut noise = || -> Vec<f64> { t_s.iter().map(|_| StandardNormal.sample(&mut rng)).collect() };
                let readings = LateralReadings::of_diagonals(&t_s, [noise(), noise()]).expect("is long enough");
                is_along_a_diagonal(readings.direction_rad)
            })
            .count();
        // Within three standard deviations of a binomial with 600 directions.
        assert!((165..=235).contains(&along), "{along} of {sets}");
    }

    #[test]
    fn analytic_the_direction_is_that_of_the_longest_reading() {
        for (x, y) in [(3.0, 4.0), (-3.0, 4.0), (5.0, -0.1), (-2.0, -2.0_f64)] {
            let diagonals = [x + y, x - y].map(|along| vec![0.0, FRAC_1_SQRT_2 * along, 0.0]);
            let found = direction_of_longest(0..3, &diagonals).expect("there are three");
            assert!((found - libm::atan2(y, x)).abs() < 1e-12, "{x} {y}: {found}");
        }
    }
}
