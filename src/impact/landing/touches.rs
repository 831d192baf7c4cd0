//! When each foot touches, read from the lateral axes of one drop.
//!
//! A foot that touches pushes the frame away from it: a spike of 1 to 2 ms along its diagonal. The largest reading along each
//! direction is that foot's touch. Its time is the centroid of the spike. Source: the CogniFly drops; feet stand on the diagonals of
//! the sensor's x and y. *When it is wrong:* a rebound of one foot's spike is taken for the opposite foot where that one hardly
//! shows; sizes say how far to trust a time.

use std::f64::consts::FRAC_1_SQRT_2;

use super::simulation::FEET;
use crate::impact::measured::Drop;

/// The first touch is looked for in so long a time behind the trigger, s.
const FIRST_S: f64 = 2e-3;
/// The others in so long, s.
pub(super) const LAST_S: f64 = 15e-3;
/// Half the length of a spike, s.
const SPIKE_S: f64 = 1e-3;

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
    /// Reads a drop; `None` where the lateral axes were not measured, or the record ends too soon.
    pub fn of(drop: &Drop) -> Option<Self> {
        let (t_s, [x, y, _]) = drop.aligned_axes()?;
        let along = [0, 1, 2, 3].map(|foot| x.iter().zip(&y).map(|(x, y)| toward(foot, *x, *y)).collect::<Vec<f64>>());
        let start = t_s.partition_point(|t_s| *t_s < 1e-9);
        let end = |length_s: f64| t_s.partition_point(|t_s| *t_s < length_s + 1e-9);
        let (first_end, last_end) = (end(FIRST_S + SPIKE_S), end(LAST_S));
        if start >= first_end || *t_s.last()? < LAST_S {
            return None;
        }
        let largest = |foot: usize, until: usize| (start..until).max_by(|a, b| along[foot][*a].total_cmp(&along[foot][*b]));
        let firsts: Vec<(usize, usize)> = (0..FEET).filter_map(|foot| Some((foot, largest(foot, first_end)?))).collect();
        let (first, peak) = *firsts.iter().max_by(|a, b| along[a.0][a.1].total_cmp(&along[b.0][b.1]))?;
        let first_s = centroid_s(&t_s, &along[first], peak, start);
        let touch = |foot: usize| {
            let at = largest(foot, last_end)?;
            let delay_s = (centroid_s(&t_s, &along[foot], at, start) - first_s).max(0.0);
            Some(Touch { delay_s, size_g: along[foot][at].max(0.0) })
        };
        let mut beside = [touch((first + 2) % FEET)?, touch(((first + 2) % FEET) ^ 1)?];
        beside.sort_by(|a, b| a.delay_s.total_cmp(&b.delay_s));
        Some(Self {
            first,
            first_size_g: along[first][peak].max(0.0),
            direction_rad: libm::atan2(y[peak], x[peak]),
            opposite: touch(first ^ 1)?,
            beside,
        })
    }

    /// The least of the four spikes, g.
    pub fn least_size_g(&self) -> f64 {
        self.beside.iter().map(|touch| touch.size_g).fold(self.first_size_g.min(self.opposite.size_g), f64::min)
    }

    /// Delays of the opposite foot and of those beside, s.
    pub fn delays_s(&self) -> [f64; 3] {
        [self.opposite.delay_s, self.beside[0].delay_s, self.beside[1].delay_s]
    }
}

/// The reading along the direction in which a foot's touch pushes.
fn toward(foot: usize, x: f64, y: f64) -> f64 {
    let diagonal = if foot < 2 { x + y } else { x - y };
    FRAC_1_SQRT_2 * if foot.is_multiple_of(2) { diagonal } else { -diagonal }
}

/// Centroid of what is positive of a spike.
fn centroid_s(t_s: &[f64], along: &[f64], peak: usize, start: usize) -> f64 {
    let near = |at: &usize| (t_s[*at] - t_s[peak]).abs() <= SPIKE_S * (1.0 + 1e-6) + 1e-9;
    let (mut weighted, mut sum) = (0.0, 0.0);
    for at in (start..t_s.len()).skip_while(|at| t_s[*at] < t_s[peak] - 2.0 * SPIKE_S).take_while(|at| *at <= peak || near(at)).filter(near)
    {
        let weight = along[at].max(0.0);
        weighted += weight * t_s[at];
        sum += weight;
    }
    if sum > 0.0 { weighted / sum } else { t_s[peak] }
}
