//! How touch times are read where spikes overlap.
//!
//! Each slope's landing is given the spikes and the rest of some measured drops ([`TouchPattern`]), and its touch times are read as those of
//! the measured drops were. Which drops these are follows from the place of the slope: neighbouring slopes have different ones, so that all are read
//! evenly, and the order in which drops were made changes nothing. Drops that were drawn at random moved the turning rate by a twentieth. Short times come out longer than they are, and a tenth of all are off by milliseconds: without this, slopes of 0.15
//! rad/s came out a sixth too large.
//!
//! *When it is wrong:* where sizes of spikes depend on the slope.

use nalgebra::DVector;
use rayon::prelude::*;

use super::table::{LandingTable, NEVER_S};
use super::touch_pattern::TouchPattern;
use super::touches::LegTouches;

/// Readings of each slope's landing.
pub const READINGS: usize = 8;
/// Slopes less frequent than this are read as they are.
const INFREQUENT: f64 = 1e-7;
/// The golden section: places that are so far apart come out most evenly.
const GOLDEN: f64 = 0.618_033_988_749_895;
/// Standard deviations of a normal law to its median deviation.
const DEVIATIONS: f64 = 1.4826;

/// A landing as it was read: its touches, and the delays that it had, s.
type Reading = (LegTouches, [f64; 3]);

/// Errors of the touch times of one height's landings.
#[derive(Clone, Debug)]
pub struct TouchErrors {
    /// How landings are read, by the table's points: touches whose delays are those read. None of a reading without touches.
    readings: Vec<[Option<Reading>; READINGS]>,
    /// Standard deviation of a delay that was read, by the median deviation, s.
    pub deviation_s: f64,
}

impl TouchErrors {
    /// Reads the landings of a table, as frequent as `weights` says, like the drops of a height, whose patterns these are.
    pub fn of(patterns: &[&TouchPattern], table: &LandingTable, weights: &DVector<f64>) -> Option<Self> {
        let mut sorted = patterns.to_vec();
        sorted.sort_by(|a, b| a.in_order(b));
        let ways = 2 * sorted.len();
        let stride = even_stride(ways);
        let read = |place: usize, delays_s: &[f64; 3]| -> Option<Reading> {
            let way = place * stride % ways;
            Some((sorted[way / 2].read(*delays_s, way % 2 == 1)?, *delays_s))
        };
        let is_frequent = |delays_s: &[f64; 3], weight: f64| weight >= INFREQUENT && delays_s.iter().all(|delay_s| *delay_s < NEVER_S);
        let landings: Vec<(&[f64; 3], f64)> = table.delays_s.iter().zip(weights.iter().copied()).collect();
        let readings_of = |(point, (delays_s, weight)): (usize, &(&[f64; 3], f64))| -> [Option<Reading>; READINGS] {
            let exact = (LegTouches::exact(**delays_s), **delays_s);
            if is_frequent(delays_s, *weight) {
                std::array::from_fn(|reading| read(point * READINGS + reading, delays_s))
            } else {
                [Some(exact); READINGS]
            }
        };
        let readings: Vec<_> = landings.par_iter().enumerate().map(readings_of).collect();
        let mut sizes: Vec<(f64, f64)> = Vec::new();
        for ((delays_s, weight), readings) in
            landings.iter().zip(&readings).filter(|((delays_s, weight), _)| is_frequent(delays_s, *weight))
        {
            for (touches, _) in readings.iter().flatten().filter(|(touches, _)| touches.all_seen()) {
                sizes.extend(touches.delays_s().iter().zip(*delays_s).map(|(read_s, true_s)| ((read_s - true_s).abs(), *weight)));
            }
        }
        sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let half = 0.5 * sizes.iter().map(|(_, weight)| weight).sum::<f64>();
        let mut before = 0.0;
        let median = sizes.iter().find(|(_, weight)| {
            before += weight;
            before >= half
        })?;
        Some(Self { readings, deviation_s: DEVIATIONS * median.0 })
    }

    /// Delays of the opposite foot as they would be read of a table's point, s.
    pub fn read_s(&self, point: usize, opposite_s: f64) -> impl Iterator<Item = f64> {
        let seen = self.readings[point].iter().flatten().filter(|(touches, _)| touches.all_seen());
        seen.map(move |(touches, was_s)| (opposite_s + touches.opposite.delay_s - was_s[0]).max(0.0))
    }

    /// Touches of a table's point as they are read in one of its readings, if it has these delays now, s; `None` where none are seen.
    pub fn touches(&self, point: usize, delays_s: [f64; 3], reading: usize) -> Option<LegTouches> {
        let (touches, was_s) = self.readings[point][reading]?;
        Some(touches.later_by(std::array::from_fn(|foot| delays_s[foot] - was_s[foot])))
    }
}

/// A stride through so many places that reaches each of them, and spreads any few that follow each other: the one nearest to the golden section that
/// has no divisor in common with their number.
fn even_stride(places: usize) -> usize {
    let has_common_divisor = |stride: usize| {
        let (mut a, mut b) = (places, stride);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a > 1
    };
    let off = |stride: &usize| (*stride as f64 - GOLDEN * places as f64).abs();
    (1..=places).filter(|stride| !has_common_divisor(*stride)).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_stride_reaches_every_place_and_spreads_the_next() {
        for places in 1..200 {
            let stride = even_stride(places);
            let mut reached: Vec<usize> = (0..places).map(|step| step * stride % places).collect();
            if places > 20 {
                let mut few: Vec<usize> = reached[..8].to_vec();
                few.sort_unstable();
                let gaps = few.windows(2).map(|pair| pair[1] - pair[0]).chain([few[0] + places - few[7]]);
                assert!(gaps.max().is_some_and(|gap| 3 * gap < places), "{places}: {few:?}");
            }
            reached.sort_unstable();
            assert!(reached.into_iter().eq(0..places), "{places}");
        }
    }
}
