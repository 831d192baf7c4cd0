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
use crate::impact::wide_registers::{Loops, with_wide_registers};

/// Corners of the shape a second.
const PER_S: f64 = 2000.0;
/// Corners of the shape, the first and the last of which are 0.
const CORNERS: usize = 14;
/// What holds corners back that no reading shows, as a part of the mean diagonal of the normal equations.
const RIDGE: f64 = 1e-3;
/// What holds the sizes of two spikes back that cancel each other.
const SIZE_RIDGE: f64 = 0.03;
/// Steps in which times are looked for, s: over all times, and around the best.
const SEARCH_S: [f64; 2] = [0.25e-3, 0.05e-3];
/// Pairs whose gains differ by a smaller part explain as much, and the first one is taken: one spike alone does so with a second one of size 0
/// at any time, and rounding must not choose among those.
const ALIKE: f64 = 1e-9;
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
        let place = since_s * PER_S;
        if !(0.0..(CORNERS - 1) as f64).contains(&place) {
            return 0.0;
        }
        let left = place as usize;
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
                    let place = (t_s - spike.at_s) * PER_S;
                    if !(0.0..(CORNERS - 1) as f64).contains(&place) {
                        continue;
                    }
                    let left = place as usize;
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
        let (along, against) = (Columns::of(self, channel, along_s), Columns::of(self, channel, against_s));
        let ridge = SIZE_RIDGE * along.own.iter().copied().fold(0.0, f64::max).max(1e-12);
        let Some(pair) = with_wide_registers(Pairs { along: &along, against: &against, ridge }) else { return [Spike::default(); 2] };
        let (one, other) = (pair.along, pair.against);
        // The second one points the other way.
        let sizes =
            not_negative([along.own[one] + ridge, against.own[other] + ridge], -pair.product, [along.with[one], -against.with[other]]);
        [Spike { at_s: along_s[one], size_g: sizes[0] }, Spike { at_s: against_s[other], size_g: sizes[1] }]
    }
}

/// Spikes of size 1 that begin at different times: their readings, a row a sample, and products with themselves and with what was read.
struct Columns {
    rows: Vec<Vec<f64>>,
    own: Vec<f64>,
    with: Vec<f64>,
}

impl Columns {
    fn of(shape: &SpikeShape, channel: &Channel, begins_s: &[f64]) -> Self {
        let row = |t_s: &f64| begins_s.iter().map(|begin_s| shape.at(t_s - begin_s)).collect::<Vec<f64>>();
        let rows: Vec<Vec<f64>> = channel.t_s.iter().map(row).collect();
        let (mut own, mut with) = (vec![0.0; begins_s.len()], vec![0.0; begins_s.len()]);
        for (row, along_g) in rows.iter().zip(&channel.along_g) {
            for (at, height) in row.iter().enumerate() {
                own[at] += height * height;
                with[at] += height * along_g;
            }
        }
        Self { rows, own, with }
    }
}

/// All pairs of a spike along a channel and one against it.
struct Pairs<'a> {
    along: &'a Columns,
    against: &'a Columns,
    ridge: f64,
}

/// A pair of spikes and the product of their columns.
struct Pair {
    along: usize,
    against: usize,
    product: f64,
}

impl Loops for Pairs<'_> {
    type Output = Option<Pair>;

    /// The pair that explains most.
    #[inline(always)]
    fn run(self) -> Option<Pair> {
        let Self { along, against, ridge } = self;
        let count = against.own.len();
        let squares: Vec<f64> = against.own.iter().map(|own| own + ridge).collect();
        let alone: Vec<f64> = against.with.iter().zip(&squares).map(|(with, square)| square_of_positive(-with) / square).collect();
        let (mut products, mut gains) = (vec![0.0; count], vec![0.0; count]);
        let mut best = (f64::NEG_INFINITY, None);
        for (one, (own, with)) in along.own.iter().zip(&along.with).enumerate() {
            products.fill(0.0);
            for (row, others) in along.rows.iter().zip(&against.rows).filter(|(row, _)| row[one] != 0.0) {
                for (product, other) in products.iter_mut().zip(others) {
                    *product += row[one] * other;
                }
            }
            let square = own + ridge;
            let alone_g = square_of_positive(*with) / square;
            for other in 0..count {
                let (shared, against_g) = (-products[other], -against.with[other]);
                let whole = square * squares[other] - shared * shared;
                let (x, y) = (squares[other] * with - shared * against_g, square * against_g - shared * with);
                let both = (with * x + against_g * y) / whole;
                let single = if alone_g > alone[other] { alone_g } else { alone[other] };
                gains[other] = if x.min(y) >= 0.0 { both } else { single };
            }
            for (other, gain) in gains.iter().enumerate() {
                if *gain > best.0 * (1.0 + ALIKE) {
                    best = (*gain, Some(Pair { along: one, against: other, product: products[other] }));
                }
            }
        }
        best.1
    }
}

/// The square of a number, 0 of a negative one.
#[inline(always)]
fn square_of_positive(value: f64) -> f64 {
    let positive = if value > 0.0 { value } else { 0.0 };
    positive * positive
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

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// No pair of begins explains more, with the sizes that are best for it; in wide registers and in narrow ones it is the same pair.
        #[test]
        fn analytic_the_best_pair_is_the_best_of_all(
            along_g in prop::collection::vec(-20.0_f64..20.0, 16),
            along_s in prop::collection::vec(0.0_f64..0.014, 1..12),
            against_s in prop::collection::vec(0.0_f64..0.02, 1..12),
        ) {
            let (shape, t_s) = (SpikeShape::first(), (0..along_g.len()).map(|at| 1e-3 * at as f64).collect());
            let channel = Channel { t_s, along_g };
            let (along, against) = (Columns::of(&shape, &channel, &along_s), Columns::of(&shape, &channel, &against_s));
            let ridge = 0.05;
            let pair = || Pairs { along: &along, against: &against, ridge };
            let product = |one: usize, other: usize| along.rows.iter().zip(&against.rows).map(|(a, b)| a[one] * b[other]).sum::<f64>();
            let gain = |one: usize, other: usize| {
                let with = [along.with[one], -against.with[other]];
                let sizes = not_negative([along.own[one] + ridge, against.own[other] + ridge], -product(one, other), with);
                sizes[0] * with[0] + sizes[1] * with[1]
            };
            let most = (0..along_s.len()).flat_map(|one| (0..against_s.len()).map(move |other| (one, other))).map(|(one, other)| gain(one, other));
            let most = most.fold(0.0, f64::max);
            let [wide, narrow] = [with_wide_registers(pair()), pair().run()].map(|pair| pair.expect("there are some"));
            prop_assert!(gain(wide.along, wide.against) >= most * (1.0 - 1e-8));
            prop_assert_eq!((wide.along, wide.against, wide.product), (narrow.along, narrow.against, narrow.product));
        }
    }
}
