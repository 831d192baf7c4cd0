//! Where the free fall begins in a record: where the frame was let go.
//!
//! A frame that is held feels 1 g, one that falls nothing but noise: back from the impact the fall begins where the mean magnitude over some
//! readings, without one that stands alone, is above a level between the two. Where noise or a zero of the sensor reach that level by themselves, the mean of the axes is taken
//! instead, and compared with what they read in the last of the fall: of so many readings that noise does not reach the level.
//!
//! *When it is wrong:* where the fall is shorter than what its readings are taken from, and for noise of more than some 0.5 g on each axis or
//! hum of more than 0.4 g.

use std::ops::Range;

use super::record::Record;
use super::spread::Spread;

/// Above this mean magnitude, or difference of the axes' mean from that in the fall, a frame is held, g: a choice between 1 g and the 0.3 g of
/// noise that the real frame's sensor reads in the fall.
pub(super) const HELD_G: f64 = 0.6;
/// A reading so many times as large as any other beside it is none of a hand.
const ALONE: f64 = 3.0;
/// Time over which a mean is taken, s, and the fewest readings of it.
const MEAN_S: f64 = 0.005;
const FEWEST: usize = 5;
/// The end of the fall, from which zero and noise are taken, s: a fall from 2 cm is as long.
const END_S: f64 = 0.06;
/// Deviations of a mean that stay below the level where noise is let be.
const DEVIATIONS: f64 = 5.0;
/// Noise of the axes' mean that is let be, g: a fifth of the level.
const QUIET_G: f64 = 0.12;
/// Most readings of a mean, as a multiple of the fewest.
const MOST: usize = 10;

/// The first sample of a fall that ends before a sample, and whether its begin is in the record.
pub(super) fn fall_begin(record: &Record, end: usize) -> (usize, bool) {
    let fewest = record.samples_in(MEAN_S).max(FEWEST);
    if end < fewest {
        return (0, false);
    }
    let last = end.saturating_sub(record.samples_in(END_S).max(fewest))..end;
    let sizes: Vec<f64> = last.clone().map(|sample| record.size_g(sample)).collect();
    let usual_g = median(sizes.iter().copied());
    if usual_g + DEVIATIONS * deviation(&sizes, usual_g) / (fewest as f64).sqrt() < HELD_G {
        by_size(record, end, fewest)
    } else {
        by_axes(record, last, fewest)
    }
}

/// By the mean magnitude.
fn by_size(record: &Record, end: usize, count: usize) -> (usize, bool) {
    let mut begin = end;
    while begin >= count {
        if is_held((begin - count..begin).map(|sample| record.size_g(sample))) {
            return (begin, true);
        }
        begin -= 1;
    }
    (0, false)
}

/// Whether the mean of some magnitudes is that of a held frame, without one that stands alone.
fn is_held(sizes: impl Iterator<Item = f64>) -> bool {
    let (mut sum, mut count, mut largest, mut second) = (0.0, 0.0, 0.0_f64, 0.0_f64);
    for size in sizes {
        (sum, count) = (sum + size, count + 1.0);
        second = second.max(size.min(largest));
        largest = largest.max(size);
    }
    let is_alone = largest > ALONE * second;
    sum > HELD_G * count && (!is_alone || sum - largest > HELD_G * (count - 1.0))
}

/// By the mean of the axes, which in these last samples of the fall read their zeros and noise.
fn by_axes(record: &Record, last: Range<usize>, fewest: usize) -> (usize, bool) {
    let axes: Vec<&[f64]> = match &record.axes_g {
        Some(axes) => axes.iter().map(Vec::as_slice).collect(),
        None => vec![&record.accel_g],
    };
    let end = last.end;
    let zeros_g: Vec<f64> = axes.iter().map(|axis| median(axis[last.clone()].iter().copied())).collect();
    let noises_g = axes.iter().zip(&zeros_g).map(|(axis, zero_g)| deviation(&axis[last.clone()], *zero_g));
    let share = noises_g.map(|noise_g| noise_g * noise_g).sum::<f64>().sqrt() / QUIET_G;
    let count = ((share * share).ceil() as usize).clamp(fewest, MOST * fewest).min(end);
    let mut sums: Vec<f64> = axes.iter().map(|axis| axis[end - count..end].iter().sum()).collect();
    let mut begin = end;
    while begin >= count {
        let off = |(sum, zero_g): (&f64, &f64)| (sum / count as f64 - zero_g).powi(2);
        if sums.iter().zip(&zeros_g).map(off).sum::<f64>() > HELD_G * HELD_G {
            // The level is reached where that share of the readings is of the held frame: of more than a few, as much earlier.
            return (begin - ((1.0 - HELD_G) * (count - fewest) as f64) as usize, true);
        }
        begin -= 1;
        if begin >= count {
            sums.iter_mut().zip(&axes).for_each(|(sum, axis)| *sum += axis[begin - count] - axis[begin]);
        }
    }
    (0, false)
}

/// Standard deviation by the middle deviation: of a bell curve half of the readings lie within 0.6745 of it. A touch, or the hand's last, does not move it.
fn deviation(readings: &[f64], middle: f64) -> f64 {
    median(readings.iter().map(|reading| (reading - middle).abs())) / 0.6745
}

/// The middle of some values, of which there are a few at least.
fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    Spread::of(values).map_or(f64::NAN, |spread| spread.median)
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// A record of three axes at 1 kHz: held for 300 ms, a fall of 400 ms, an impact; with noise on each axis, its zero, and hum of 50 Hz.
    fn record(seed: u64, noise_g: f64, zero_g: f64, hum_g: f64) -> Record {
        use rand::{RngExt, SeedableRng};
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
        let mut bell = || (0..12).map(|_| random.random_range(0.0..1.0_f64)).sum::<f64>() - 6.0;
        let mut text = "trial,height_m,t_s,accel_g,x,y,z\n".to_string();
        for ms in 0..760_u32 {
            let along = if ms < 300 { 1.0 } else { 0.0 };
            let hit = if (700..712).contains(&ms) { 60.0 * libm::sin(f64::from(ms - 700) / 12.0 * std::f64::consts::PI) } else { 0.0 };
            let hum = hum_g * libm::sin(f64::from(ms) * 0.1 * std::f64::consts::PI);
            let [x, y, z] = [0.0, 0.0, along + hit].map(|true_g| true_g + zero_g + hum + noise_g * bell());
            text += &format!("1,0.8,{},{z},{x},{y},{z}\n", f64::from(ms) * 1e-3);
        }
        let set = read_bytes(&[("a.csv".into(), text.into_bytes())], &FileFormat::default()).expect("reads");
        set.records().next().expect("is one").clone()
    }

    #[test]
    fn planted_the_begin_of_a_fall_is_found_beside_noise_zeros_and_hum() {
        for seed in 0..20 {
            for (noise_g, zero_g, hum_g) in
                [(0.0, 0.0, 0.0), (0.17, 0.0, 0.0), (0.17, 0.28, 0.0), (0.17, 0.0, 0.2), (0.3, 0.1, 0.0), (0.45, 0.0, 0.0)]
            {
                let (begin, seen) = fall_begin(&record(seed, noise_g, zero_g, hum_g), 696);
                let off = begin as f64 - 300.0;
                assert!(seen && off.abs() <= if noise_g > 0.2 { 14.0 } else { 4.0 }, "{noise_g} {zero_g} {hum_g}: {begin} {seen}");
            }
        }
    }

    #[test]
    fn analytic_a_record_that_begins_in_its_fall_has_no_begin_of_it() {
        let mut late = record(1, 0.17, 0.1, 0.0);
        late.t_s.drain(..310);
        late.accel_g.drain(..310);
        late.axes_g.as_mut().expect("has three axes").iter_mut().for_each(|axis| drop(axis.drain(..310)));
        assert_eq!(fall_begin(&late, 386), (0, false));
        assert_eq!(fall_begin(&late, 3), (0, false));
    }
}
