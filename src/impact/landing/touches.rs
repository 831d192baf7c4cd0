//! When each foot touches, read from the lateral axes of one drop.
//!
//! A foot that touches pushes the frame away from it: a spike of 1 to 2 ms along its diagonal. All four feet are read together as
//! spikes of one shape ([`SpikeShape`]), beginning with the largest within 2 ms of the trigger. Source: the CogniFly
//! drops; feet stand on the diagonals of the sensor's x and y. *When it is wrong:* two feet of one diagonal that touch within half a
//! millisecond cancel each other; sizes say how far to trust a time.

use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

use rayon::prelude::*;

use super::simulation::FEET;
use super::spike::{Channel, Spike, SpikeShape};
use crate::impact::measured::Drop;

/// The first touch is looked for in so long a time behind the trigger, s.
const FIRST_S: f64 = 2e-3;
/// The others in so long, s.
pub(super) const LAST_S: f64 = 15e-3;
/// About the length of a spike, s.
const SPIKE_S: f64 = 1e-3;
/// Readings before the trigger that may show the first spike's begin, s.
const BEFORE_S: f64 = 2e-3;
/// Time between the readings that are compared with spikes, s; slower loggers keep their own.
const CHANNEL_STEP_S: f64 = 0.25e-3;
/// Part of the largest spike that one needs to be the first.
const BELIEVED: f64 = 0.3;
/// The least spike of a touch that is believed, g.
const SEEN_G: f64 = 20.0;
/// How often touches and shape are found in turn.
const ROUNDS: usize = 5;

/// One foot's touch.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Touch {
    /// Behind that of the first foot, s.
    pub delay_s: f64,
    /// Height of its spike, g.
    pub size_g: f64,
}

/// The touches of a drop.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct LegTouches {
    /// Which foot was first, at the positive and negative end of the first diagonal, then of the second.
    pub first: usize,
    /// Of the first spike, g.
    pub first_size_g: f64,
    /// Direction of the first spike from the sensor's x, rad.
    pub direction_rad: f64,
    /// The foot opposite to the first.
    pub opposite: Touch,
    /// The two beside it, the earlier one first.
    pub beside: [Touch; 2],
}

impl LegTouches {
    /// The least of the four spikes, g.
    pub fn least_size_g(&self) -> f64 {
        self.beside.iter().map(|touch| touch.size_g).fold(self.first_size_g.min(self.opposite.size_g), f64::min)
    }

    /// Whether the touch of each foot was seen.
    pub fn all_seen(&self) -> bool {
        self.least_size_g() >= SEEN_G
    }

    /// Delays of the opposite foot and of those beside, s.
    pub fn delays_s(&self) -> [f64; 3] {
        [self.opposite.delay_s, self.beside[0].delay_s, self.beside[1].delay_s]
    }
}

/// Drops with their touches.
pub struct ReadDrops {
    /// Those of each; `None` for a drop whose lateral axes were not measured, or whose record ends too soon.
    pub each: Vec<Option<(LegTouches, TouchPattern)>>,
}

impl ReadDrops {
    /// Reads drops together, as they show one shape of spike.
    pub fn of(drops: &[Option<&Drop>]) -> Self {
        let lateral: Vec<Option<LateralReadings>> = drops.iter().map(|drop| drop.and_then(LateralReadings::of)).collect();
        let read = |shape: &SpikeShape| -> Vec<Option<FourSpikes>> {
            lateral.par_iter().map(|one| one.as_ref().map(|one| one.read(shape))).collect()
        };
        let mut shape = SpikeShape::first();
        for _ in 0..ROUNDS {
            let spikes = read(&shape);
            let known = lateral.iter().flatten().zip(spikes.iter().flatten());
            let channels: Vec<(Channel, [Spike; 2])> = known.flat_map(|(one, spikes)| one.channels.iter().cloned().zip(*spikes)).collect();
            match SpikeShape::of(&channels) {
                Some(next) => shape = next,
                None => break,
            }
        }
        let spikes = read(&shape);
        let shape = Arc::new(shape);
        let both = |(one, spikes): (&Option<LateralReadings>, Option<FourSpikes>)| {
            let (one, spikes) = (one.as_ref()?, spikes?);
            Some((one.touches(&spikes), TouchPattern::of(one, &spikes, &shape)))
        };
        Self { each: lateral.iter().zip(spikes).map(both).collect() }
    }
}

/// What a drop's lateral axes show beside when its feet touched: sizes of the spikes, and what is no spike.
///
/// With it, drops with other touches can be read as this one was: so the error of reading is known where spikes overlap.
#[derive(Clone, Debug)]
pub struct TouchPattern {
    shape: Arc<SpikeShape>,
    t_s: Vec<f64>,
    /// Along the two diagonals, g.
    rest_g: [Vec<f64>; 2],
    /// When the first foot touches, s.
    first_s: f64,
    /// Which foot is first.
    first: usize,
    /// By foot, g.
    sizes_g: [f64; FEET],
}

impl TouchPattern {
    fn of(lateral: &LateralReadings, spikes: &FourSpikes, shape: &Arc<SpikeShape>) -> Self {
        let all = [spikes[0][0], spikes[0][1], spikes[1][0], spikes[1][1]];
        let first = first_of(&all);
        let [own, other] = &lateral.channels;
        let rest = |channel: &Channel, spikes: &[Spike; 2]| -> Vec<f64> {
            let readings = channel.t_s.iter().zip(&channel.along_g);
            readings.map(|(t_s, along_g)| along_g - shape.sum_at(spikes, *t_s)).collect()
        };
        Self {
            shape: shape.clone(),
            t_s: own.t_s.clone(),
            rest_g: [rest(own, &spikes[0]), rest(other, &spikes[1])],
            first_s: all[first].at_s,
            first,
            sizes_g: all.map(|spike| spike.size_g),
        }
    }

    /// What would have been read of this drop, had its feet touched with other delays: of the opposite foot, and of those beside, the earlier one
    /// first, or the other one where `swapped`.
    pub fn read(&self, [opposite_s, mut early_s, mut late_s]: [f64; 3], swapped: bool) -> Option<LegTouches> {
        if swapped {
            std::mem::swap(&mut early_s, &mut late_s);
        }
        let mut spikes = self.sizes_g.map(|size_g| Spike { at_s: self.first_s, size_g });
        spikes[self.first ^ 1].at_s += opposite_s;
        beside(self.first).into_iter().zip([early_s, late_s]).for_each(|(foot, delay_s)| spikes[foot].at_s += delay_s);
        let along = |diagonal: usize| -> Vec<f64> {
            let pair = [spikes[2 * diagonal], spikes[2 * diagonal + 1]];
            self.t_s.iter().zip(&self.rest_g[diagonal]).map(|(t_s, rest_g)| rest_g + self.shape.sum_at(&pair, *t_s)).collect()
        };
        let lateral = LateralReadings::of_diagonals(&self.t_s, [along(0), along(1)])?;
        Some(lateral.touches(&lateral.read(&self.shape)))
    }
}

/// The foot that touched first: the earliest one, not the one with the largest spike. Where two touch nearly together, the times of
/// the wrong one's opposite foot are too short.
fn first_of(spikes: &[Spike; FEET]) -> usize {
    let largest = spikes.iter().map(|spike| spike.size_g).fold(0.0, f64::max);
    let believed = |at: &usize| spikes[*at].size_g >= BELIEVED * largest;
    (0..FEET).filter(believed).min_by(|a, b| spikes[*a].at_s.total_cmp(&spikes[*b].at_s)).unwrap_or(0)
}

/// The reading toward a foot's push, of those along the two diagonals.
fn toward(foot: usize, diagonals_g: [f64; 2]) -> f64 {
    let diagonal = diagonals_g[foot / 2];
    if foot.is_multiple_of(2) { diagonal } else { -diagonal }
}

/// The spikes of the first foot and of the opposite one, and of the two beside.
type FourSpikes = [[Spike; 2]; 2];

/// What a drop's lateral axes show.
struct LateralReadings {
    first: usize,
    /// When the first spike seems to begin, s.
    begin_s: f64,
    direction_rad: f64,
    /// Toward the side to which the first foot pushes, and toward the one to which the next foot does.
    channels: [Channel; 2],
}

impl LateralReadings {
    fn of(drop: &Drop) -> Option<Self> {
        let (t_s, [x, y, _]) = drop.aligned_axes()?;
        let along = |sign: f64| x.iter().zip(&y).map(|(x, y)| FRAC_1_SQRT_2 * (x + sign * y)).collect();
        Self::of_diagonals(&t_s, [along(1.0), along(-1.0)])
    }

    fn of_diagonals(t_s: &[f64], diagonals_g: [Vec<f64>; 2]) -> Option<Self> {
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
        let [a, b] = [diagonals_g[0][peak], diagonals_g[1][peak]];
        Some(Self {
            first,
            begin_s: t_s[peak] - 0.5 * SPIKE_S,
            direction_rad: libm::atan2(a - b, a + b),
            channels: [channel(first), channel(beside(first)[0])],
        })
    }

    fn read(&self, shape: &SpikeShape) -> FourSpikes {
        let span_s = [self.begin_s - SPIKE_S, LAST_S];
        [shape.read(&self.channels[0], span_s, Some(self.begin_s)), shape.read(&self.channels[1], span_s, None)]
    }

    fn touches(&self, [own, other]: &FourSpikes) -> LegTouches {
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

/// The feet at the ends of the other diagonal.
fn beside(foot: usize) -> [usize; 2] {
    let next = (foot + 2) % FEET;
    [next, next ^ 1]
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::*;
    use crate::impact::measured::{FileFormat, JudgedDrops, read_bytes};

    /// A spike that no shape here has: a triangle of 1.2 ms, and a rebound of a third that is twice as long.
    fn spike(since_s: f64) -> f64 {
        let triangle = |place: f64| (1.0 - (2.0 * place - 1.0).abs()).max(0.0);
        triangle(since_s / 1.2e-3) - 0.33 * triangle((since_s - 1.2e-3) / 2.4e-3)
    }

    /// A table of drops whose feet touch at these times, the first at +x +y, then opposite, then those beside.
    fn table(drops: &[[f64; 4]]) -> String {
        let mut rng = Pcg64::seed_from_u64(5);
        let mut text = String::from("trial,height_m,t_s,accel_g,x,y\n");
        for (trial, times) in drops.iter().enumerate() {
            let phase: f64 = rng.random();
            let sizes: [f64; 4] = std::array::from_fn(|_| rng.random_range(50.0..90.0));
            for i in 0..50 {
                let t_s = (f64::from(i) - 12.0 + phase) * 1e-3;
                let each: [f64; 4] = std::array::from_fn(|foot| sizes[foot] * spike(t_s - times[foot]));
                let (a, b) = (each[0] - each[1], each[2] - each[3]);
                let noise: [f64; 2] = std::array::from_fn(|_| StandardNormal.sample(&mut rng));
                let [x, y] = [a + b + noise[0], a - b + noise[1]].map(|reading| FRAC_1_SQRT_2 * reading);
                let axial = if (0.0..0.012).contains(&t_s) { 60.0 * libm::sin(t_s / 0.012 * std::f64::consts::PI) + 4.0 } else { 0.0 };
                text += &format!("{trial},1,{},{axial},{x},{y}\n", f64::from(i) * 1e-3);
            }
        }
        text
    }

    /// Half of the times are within 0.6 ms, at a reading a millisecond. A tenth is off by some milliseconds: where two feet touch within half a
    /// millisecond the second may be taken for the first, and its opposite foot is then another.
    #[test]
    fn regress_half_of_the_touches_are_read_though_their_spikes_overlap() {
        let mut rng = Pcg64::seed_from_u64(3);
        let drops: Vec<[f64; 4]> = (0..60)
            .map(|_| {
                let near = rng.random_range(0.2e-3..2.5e-3);
                let far = near + rng.random_range(0.2e-3..2.5e-3);
                [0.0, near + far, near, far]
            })
            .collect();
        let set = read_bytes(&[("a.csv".into(), table(&drops).into_bytes())], &FileFormat::default()).expect("reads");
        let judged = JudgedDrops::of(&set).groups;
        let all: Vec<Option<&Drop>> = judged[0].1.iter().map(Some).collect();
        let read = ReadDrops::of(&all).each;
        let off: Vec<f64> =
            read.iter().zip(&drops).map(|(read, truth)| read.as_ref().expect("has touches").0.opposite.delay_s - truth[1]).collect();
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        let mut sizes: Vec<f64> = off.iter().map(|off| off.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        assert!(mean.abs() < 1e-3 && sizes[30] < 0.6e-3, "{mean} {} {}", sizes[30], sizes[54]);
    }
}
