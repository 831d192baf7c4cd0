//! A drop's lateral axes with other touches.

use std::cmp::Ordering;
use std::sync::Arc;

use super::lateral_readings::{FourSpikes, LateralReadings, beside, first_of};
use super::simulation::FEET;
use super::spike::{Channel, Spike, SpikeShape};
use super::touches::LegTouches;

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
    /// Of readings as the sum of these spikes and a rest.
    pub(super) fn of(lateral: &LateralReadings, spikes: &FourSpikes, shape: &Arc<SpikeShape>) -> Self {
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

    /// An order of patterns that depends on nothing but what was measured.
    pub fn in_order(&self, other: &Self) -> Ordering {
        let numbers = |pattern: &Self| [pattern.first_s].into_iter().chain(pattern.sizes_g).collect::<Vec<_>>();
        let each = numbers(self).into_iter().zip(numbers(other)).map(|(a, b)| a.total_cmp(&b));
        each.fold(Ordering::Equal, Ordering::then)
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
