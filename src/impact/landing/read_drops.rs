//! Touches of drops that are read together.

use std::sync::Arc;

use rayon::prelude::*;

use super::lateral_readings::{FourSpikes, LateralReadings};
use super::spike::{Channel, Spike, SpikeShape};
use super::touch_pattern::TouchPattern;
use super::touches::LegTouches;
use crate::impact::measured::Drop;

/// How often touches and shape are found in turn.
const ROUNDS: usize = 5;

/// Drops with their touches.
pub struct ReadDrops {
    /// Those of each; `None` for a drop whose lateral axes were not measured, or whose record ends too soon.
    pub each: Vec<Option<(LegTouches, TouchPattern)>>,
}

impl ReadDrops {
    /// Reads drops together, as they show one shape of spike. Of drops that nothing may be learned from the shape is not.
    pub fn of(drops: &[Option<&Drop>], is_seen: impl Fn(&Drop) -> bool) -> Self {
        let seen: Vec<bool> = drops.iter().map(|drop| drop.is_some_and(&is_seen)).collect();
        let lateral: Vec<Option<LateralReadings>> = drops.iter().map(|drop| drop.and_then(LateralReadings::of)).collect();
        let read = |shape: &SpikeShape| -> Vec<Option<FourSpikes>> {
            lateral.par_iter().map(|one| one.as_ref().map(|one| one.read(shape))).collect()
        };
        let mut shape = SpikeShape::first();
        for _ in 0..ROUNDS {
            let spikes = read(&shape);
            let known = lateral
                .iter()
                .zip(&spikes)
                .zip(&seen)
                .filter_map(|((one, spikes), seen)| one.as_ref().zip(spikes.as_ref()).filter(|_| *seen));
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

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use std::f64::consts::FRAC_1_SQRT_2;

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

    /// So many drops whose second and third foot touch within some milliseconds: when, and how they are read.
    fn read(count: usize) -> Vec<([f64; 4], (LegTouches, TouchPattern))> {
        let mut rng = Pcg64::seed_from_u64(3);
        let drops: Vec<[f64; 4]> = (0..count)
            .map(|_| {
                let near = rng.random_range(0.2e-3..2.5e-3);
                let far = near + rng.random_range(0.2e-3..2.5e-3);
                [0.0, near + far, near, far]
            })
            .collect();
        let set = read_bytes(&[("a.csv".into(), table(&drops).into_bytes())], &FileFormat::default()).expect("reads");
        let judged = JudgedDrops::of(&set).groups;
        let all: Vec<Option<&Drop>> = judged[0].1.iter().map(Some).collect();
        let read = ReadDrops::of(&all, |_| true).each.into_iter().map(|read| read.expect("has touches"));
        drops.into_iter().zip(read).collect()
    }

    /// Half of the times are within 0.6 ms, at a reading a millisecond. A tenth is off by some milliseconds: where two feet touch within half a
    /// millisecond the second may be taken for the first, and its opposite foot is then another. With sixty drops the median is between 0.45 and 0.7 ms,
    /// by the drops.
    #[test]
    fn regress_half_of_the_touches_are_read_though_their_spikes_overlap() {
        let off: Vec<f64> = read(600).iter().map(|(truth, (read, _))| read.opposite.delay_s - truth[1]).collect();
        let mean = off.iter().sum::<f64>() / off.len() as f64;
        let mut sizes: Vec<f64> = off.iter().map(|off| off.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        assert!(mean.abs() < 1e-3 && sizes[300] < 0.6e-3, "{mean} {} {}", sizes[300], sizes[540]);
    }

    /// Spikes and rest together are the drop itself. Drops in which a foot that is not believed came first are left out: its delay is cut at 0.
    #[test]
    fn analytic_a_pattern_with_its_own_touches_is_read_as_its_drop() {
        let mut compared = 0;
        for (_, (touches, pattern)) in read(60) {
            let delays = touches.delays_s();
            if delays.iter().any(|delay_s| *delay_s <= 0.0) {
                continue;
            }
            compared += 1;
            let again = [false, true].map(|swapped| pattern.read(delays, swapped).expect("is read").delays_s());
            let near = |read: &[f64; 3]| read.iter().zip(&delays).all(|(read_s, delay_s)| (read_s - delay_s).abs() < 1e-9);
            assert!(again.iter().any(near), "{delays:?}: {again:?}");
        }
        assert!(compared > 40, "{compared} of 60");
    }
}
