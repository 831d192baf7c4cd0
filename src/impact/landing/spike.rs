//! The shape of the spike that a foot's touch makes sideways, as the drops show it.
//!
//! Spikes of feet that touch shortly after each other overlap, and each leaves a rebound that looks like the opposite foot's touch. The
//! largest reading along a direction then is no foot's touch. So a record is read as a sum of four spikes of one shape, along and against
//! the two diagonals, each with a time and a size. The shape is not assumed: it is the one that explains all records best, by least squares
//! for the shape given the touches, and for the touches given the shape, in turn.
//!
//! *When it is wrong:* where feet's spikes differ in more than size, or the frame rings on long after a touch.

use nalgebra::{DMatrix, DVector};

use crate::impact::fit::inverse;

/// Distance between the shape's corners, s.
const STEP_S: f64 = 0.5e-3;
/// Corners of the shape, the first and the last of which are 0.
const CORNERS: usize = 14;
/// What holds corners back that no reading shows, as a part of the mean diagonal of the normal equations.
const RIDGE: f64 = 1e-3;
/// What holds the sizes of two spikes back that cancel each other.
const SIZE_RIDGE: f64 = 0.03;
/// Steps in which times are looked for, s: over all times, and around the best.
const SEARCH_S: [f64; 2] = [0.25e-3, 0.05e-3];
/// The first spike is looked for on either side of where it seems to begin, s.
const AROUND_S: f64 = 1e-3;

/// A spike from the touch on, in units of its largest reading; straight between corners every half millisecond, 0 before and behind them.
#[derive(Clone, Debug, PartialEq)]
pub struct SpikeShape {
    corners: Vec<f64>,
}

/// A spike's begin, s, and its height, g.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spike {
    /// When the foot touches.
    pub at_s: f64,
    /// How high the largest reading would be.
    pub size_g: f64,
}

/// Readings along one diagonal: the sum of a spike along it and one against it.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Times, s.
    pub t_s: Vec<f64>,
    /// Readings, g.
    pub along_g: Vec<f64>,
}

impl SpikeShape {
    /// Half a sine of 1.5 ms: a begin for [`Self::of`].
    pub fn first() -> Self {
        let sine = |corner: usize| libm::sin(std::f64::consts::PI * corner as f64 / 3.0).max(0.0) * f64::from(u8::from(corner < 3));
        Self { corners: (0..CORNERS).map(sine).collect() }
    }

    /// Height at a time from the touch on, of 1.
    fn at(&self, since_s: f64) -> f64 {
        let place = since_s / STEP_S;
        if !(0.0..(CORNERS - 1) as f64).contains(&place) {
            return 0.0;
        }
        let left = place.floor() as usize;
        self.corners[left] + (place - left as f64) * (self.corners[left + 1] - self.corners[left])
    }

    /// Readings of a spike along a channel and of one against it, g.
    pub fn sum_at(&self, [along, against]: &[Spike; 2], t_s: f64) -> f64 {
        along.size_g * self.at(t_s - along.at_s) - against.size_g * self.at(t_s - against.at_s)
    }

    /// The shape that explains channels best, whose spikes are known; `None` where they do not determine it.
    pub fn of(channels: &[(Channel, [Spike; 2])]) -> Option<Self> {
        let free = CORNERS - 2;
        let mut normal = DMatrix::zeros(free, free);
        let mut right = DVector::zeros(free);
        for (channel, spikes) in channels {
            for (t_s, along_g) in channel.t_s.iter().zip(&channel.along_g) {
                let mut row = DVector::zeros(free);
                for (spike, sign) in spikes.iter().zip([1.0, -1.0]) {
                    let place = (t_s - spike.at_s) / STEP_S;
                    if !(0.0..(CORNERS - 1) as f64).contains(&place) {
                        continue;
                    }
                    let left = place.floor() as usize;
                    for (corner, weight) in [(left, 1.0 - (place - left as f64)), (left + 1, place - left as f64)] {
                        if (1..=free).contains(&corner) {
                            row[corner - 1] += sign * spike.size_g * weight;
                        }
                    }
                }
                normal += &row * row.transpose();
                right += row * *along_g;
            }
        }
        let mean = normal.trace() / free as f64;
        let solved = inverse(&(normal + DMatrix::identity(free, free) * (RIDGE * mean)))? * right;
        let peak = solved.max();
        if peak.is_nan() || peak <= 0.0 {
            return None;
        }
        let inner = solved.iter().map(|corner| corner / peak);
        Some(Self { corners: std::iter::once(0.0).chain(inner).chain([0.0]).collect() })
    }

    /// The two spikes of a channel: one along it that begins near `near_s` where that is given, and one against it. Both begin between the
    /// ends of a span, s.
    pub fn read(&self, channel: &Channel, span_s: [f64; 2], near_s: Option<f64>) -> [Spike; 2] {
        let grid = |from_s: f64, to_s: f64, step_s: f64| {
            let count = ((to_s - from_s) / step_s).round().max(0.0) as usize;
            (0..=count).map(move |at| from_s + step_s * at as f64).collect::<Vec<f64>>()
        };
        let [from_s, to_s] = span_s;
        let first = near_s.map_or(span_s, |near_s| [near_s - AROUND_S, near_s + AROUND_S]);
        let coarse = self.best(channel, &grid(first[0], first[1], SEARCH_S[0]), &grid(from_s, to_s, SEARCH_S[0]));
        let around = |spike: &Spike| grid(spike.at_s - SEARCH_S[0], spike.at_s + SEARCH_S[0], SEARCH_S[1]);
        self.best(channel, &around(&coarse[0]), &around(&coarse[1]))
    }

    /// The best pair of begins.
    fn best(&self, channel: &Channel, along_s: &[f64], against_s: &[f64]) -> [Spike; 2] {
        let column = |at_s: &f64| channel.t_s.iter().map(|t_s| self.at(t_s - at_s)).collect::<Vec<f64>>();
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let columns = |times: &[f64]| {
            let of = |at_s: &f64| {
                let column = column(at_s);
                let (own, with) = (product(&column, &column), product(&column, &channel.along_g));
                (*at_s, column, own, with)
            };
            times.iter().map(of).collect::<Vec<_>>()
        };
        let (along, against) = (columns(along_s), columns(against_s));
        let ridge = SIZE_RIDGE * along.iter().map(|one| one.2).fold(0.0, f64::max).max(1e-12);
        // A row a sample, so that the products with all columns are summed side by side.
        let rows: Vec<Vec<f64>> =
            (0..channel.t_s.len()).map(|sample| against.iter().map(|(_, column, ..)| column[sample]).collect()).collect();
        let mut best = (f64::NEG_INFINITY, [Spike::default(); 2]);
        for (a_s, a, a_own, a_with) in &along {
            let mut products = vec![0.0; against.len()];
            for (height, row) in a.iter().zip(&rows).filter(|(height, _)| **height != 0.0) {
                products.iter_mut().zip(row).for_each(|(sum, other)| *sum += height * other);
            }
            for ((b_s, _, b_own, b_with), product) in against.iter().zip(products) {
                // The second one points the other way.
                let (shared, b_with) = (-product, -b_with);
                let sizes = not_negative([a_own + ridge, b_own + ridge], shared, [*a_with, b_with]);
                let gain = sizes[0] * a_with + sizes[1] * b_with;
                if gain > best.0 {
                    best = (gain, [Spike { at_s: *a_s, size_g: sizes[0] }, Spike { at_s: *b_s, size_g: sizes[1] }]);
                }
            }
        }
        best.1
    }
}

/// Minimises p x² + q y² + 2 s x y - 2 (u x + v y) over x, y ≥ 0.
fn not_negative([p, q]: [f64; 2], s: f64, [u, v]: [f64; 2]) -> [f64; 2] {
    let whole = p * q - s * s;
    let both = [(q * u - s * v) / whole, (p * v - s * u) / whole];
    if both[0] >= 0.0 && both[1] >= 0.0 {
        return both;
    }
    let alone = [(u / p).max(0.0), (v / q).max(0.0)];
    if alone[0] * u >= alone[1] * v { [alone[0], 0.0] } else { [0.0, alone[1]] }
}
