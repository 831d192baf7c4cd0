//! A period of stalls that shows across records, such as that of a flash memory's sectors.
//!
//! Behind a stall a logger catches up: samples follow each other faster than they are stamped, and the sensor's noise is then
//! correlated from sample to sample. The correlation is averaged over all records at each sample of the file, and folded with every
//! period. *When it is wrong:* where records do not begin at the begin of a period, where the noise is white down to the faster
//! rate, and for fewer than three periods a record. No period is found there.

use std::ops::Range;

use super::record::Record;
use super::spread::{QUARTILES_APART, Spread};

/// Cells into which a record is divided at most.
const CELLS: usize = 2000;
/// Mean that is taken off a reading, samples.
const SMOOTHED: usize = 7;
/// Readings further than this from their mean, in units of the noise, are no noise.
const NOISY: f64 = 4.0;
/// Least noise, g.
const LEAST_NOISE_G: f64 = 0.06;
/// Samples on either side that must be quiet, too.
const AROUND: usize = 4;
/// A magnitude above this is of a hit, g, and what is so near to it rings, s: at the same place of records that were begun alike.
const HIT_G: f64 = 2.0;
const RINGS_S: f64 = 0.02;
/// Standard errors by which the correlation rises far from hits, too.
const RISE_FAR: f64 = 5.0;
/// Cells over which the baseline's median is taken, on either side.
const BASELINE: usize = 200;
/// Shortest period, cells, steps between periods, cells, and the fewest periods in a record.
const SHORTEST: f64 = 60.0;
const STEP: f64 = 0.2;
const FEWEST_PERIODS: f64 = 3.0;
/// Cells of a bin of the folded correlation.
const BIN: f64 = 8.0;
/// Shortest stretch, cells.
const SHORTEST_STRETCH: f64 = 20.0;
/// How far the correlation rises in the stall, in standard errors, and over the median of all periods.
const RISE: f64 = 8.0;
const RISE_OVER_MEDIAN: f64 = 1.3;
/// Standard errors by which it rises in each single period, for the fewest of them.
const RISE_OF_ONE: f64 = 2.0;

/// Where the clock stalls, period by period.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ClockPeriod {
    /// Length, samples of the file.
    pub samples: f64,
    /// Begin of the stretch in which the clock catches up, samples from the begin of a period.
    pub begin: f64,
    /// Length of that stretch, samples.
    pub stretch: f64,
    /// How far the noise's lag-1 correlation rises there, in standard errors.
    pub rise: f64,
}

impl ClockPeriod {
    /// Where a sample lies from the begin of a stretch on; negative in the half of the period before it.
    pub fn from_begin(&self, sample: usize) -> f64 {
        let behind = (sample as f64 - self.begin).rem_euclid(self.samples);
        let before = 0.5 * (self.samples - self.stretch);
        if behind > self.samples - before { behind - self.samples } else { behind }
    }

    /// The period that records show together; `None` when they show none.
    pub fn of(records: &[&Record]) -> Option<Self> {
        let longest = records.iter().map(|record| record.len()).max()?;
        let cell = longest.div_ceil(CELLS);
        let pooled = Pooled::of(records, longest, cell, |_, _| true);
        let cells = longest as f64 / cell as f64;
        let scanned = ((cells / FEWEST_PERIODS - SHORTEST) / STEP).max(0.0) as usize;
        let all: Vec<Self> = (0..scanned).filter_map(|at| pooled.folded(SHORTEST + STEP * at as f64)).collect();
        let mut rises: Vec<f64> = all.iter().map(|period| period.rise).collect();
        rises.sort_by(f64::total_cmp);
        let needed = RISE.max(RISE_OVER_MEDIAN * rises.get(rises.len() / 2)?);
        let best = all.into_iter().filter(|period| pooled.rises_in_each(period)).max_by(|a, b| a.rise.total_cmp(&b.rise))?;
        if best.rise < needed {
            return None;
        }
        // Hits of records that were begun alike, and what rings behind them, lie at the same samples, and may look like a period.
        let far = Pooled::of(records, longest, cell, Hits::are_far);
        let cell = cell as f64;
        (far.rise_in(&best) > RISE_FAR).then_some(Self {
            samples: best.samples * cell,
            begin: best.begin * cell,
            stretch: best.stretch * cell,
            ..best
        })
    }
}

/// The lag-1 correlation above its baseline, cell by cell, and its weight.
struct Pooled {
    excess: Vec<f64>,
    weight: Vec<f64>,
    /// How far the sums of neighbouring cells vary, in the standard errors of white noise: more than 1 where a filter makes noise smooth.
    error: f64,
}

impl Pooled {
    /// Of the samples that are asked for.
    fn of(records: &[&Record], longest: usize, cell: usize, is_asked: impl Fn(&Hits, usize) -> bool) -> Self {
        let count = longest.div_ceil(cell);
        let (mut product, mut weight) = (vec![0.0; count], vec![0.0; count]);
        for record in records {
            let hits = Hits::of(record);
            for axis in record.axes() {
                pool(axis, |at| is_asked(&hits, at), cell, &mut product, &mut weight);
            }
        }
        let mean: Vec<f64> = product.iter().zip(&weight).map(|(sum, weight)| if *weight > 0.0 { sum / weight } else { 0.0 }).collect();
        let excess = (0..count)
            .map(|at| {
                let mut around: Vec<f64> = mean[at.saturating_sub(BASELINE)..(at + BASELINE + 1).min(count)].to_vec();
                let middle = around.len() / 2;
                mean[at] - *around.select_nth_unstable_by(middle, f64::total_cmp).1
            })
            .collect();
        let white = Self { excess, weight, error: 1.0 };
        let length = BIN as usize;
        let blocks = (0..count / length).map(|block| white.rise(block * length..(block + 1) * length));
        // By the lower half of them: where a clock stalls the correlation rises.
        let error = Spread::of(blocks).map_or(1.0, |blocks| (2.0 * (blocks.median - blocks.q1) / QUARTILES_APART).max(1.0));
        Self { error, ..white }
    }

    /// How far the correlation rises in some cells, in standard errors.
    fn rise(&self, cells: Range<usize>) -> f64 {
        let (sum, weight) = self.sums(cells);
        sum / weight.max(1.0).sqrt() / self.error
    }

    /// Sum of the excess and of the weights from a cell to another.
    fn sums(&self, cells: impl Iterator<Item = usize>) -> (f64, f64) {
        cells.fold((0.0, 0.0), |(sum, weight), at| (sum + self.excess[at] * self.weight[at], weight + self.weight[at]))
    }

    /// The stretch of a period in which the correlation rises most.
    fn folded(&self, period: f64) -> Option<ClockPeriod> {
        let bins = (period / BIN).round().max(8.0) as usize;
        let (mut sums, mut weights) = (vec![0.0; bins], vec![0.0; bins]);
        for (at, (excess, weight)) in self.excess.iter().zip(&self.weight).enumerate() {
            let bin = ((at as f64).rem_euclid(period) / period * bins as f64) as usize % bins;
            sums[bin] += excess * weight;
            weights[bin] += weight;
        }
        let width = period / bins as f64;
        let mut best: Option<ClockPeriod> = None;
        for begin in 0..bins {
            let (mut sum, mut weight) = (0.0, 0.0);
            for length in 1..=bins / 2 {
                let bin = (begin + length - 1) % bins;
                sum += sums[bin];
                weight += weights[bin];
                let rise = sum / f64::max(weight, 1.0).sqrt() / self.error;
                if length as f64 * width >= SHORTEST_STRETCH && best.is_none_or(|best| rise > best.rise) {
                    best = Some(ClockPeriod { samples: period, begin: begin as f64 * width, stretch: length as f64 * width, rise });
                }
            }
        }
        best
    }

    /// The stretches of a period in the record.
    fn stretches(&self, period: &ClockPeriod) -> impl Iterator<Item = Range<usize>> {
        let (count, stretch) = (self.excess.len(), period.stretch);
        let begins = (0..).map({
            let period = *period;
            move |turn| period.begin + f64::from(turn) * period.samples
        });
        let whole = begins.take_while(move |begin| begin + stretch <= count as f64);
        whole.map(move |begin| begin as usize..((begin + stretch) as usize).min(count))
    }

    /// How far the correlation rises in all stretches of a period together, in standard errors.
    fn rise_in(&self, period: &ClockPeriod) -> f64 {
        let sums = self.stretches(period).map(|cells| self.sums(cells));
        let (sum, weight) = sums.fold((0.0, 0.0), |(sum, weight), own| (sum + own.0, weight + own.1));
        sum / f64::max(weight, 1.0).sqrt() / self.error
    }

    /// Whether the correlation rises in most of the single periods, too.
    fn rises_in_each(&self, period: &ClockPeriod) -> bool {
        let rises: Vec<bool> = self.stretches(period).map(|cells| self.rise(cells) > RISE_OF_ONE).collect();
        let rising = rises.iter().filter(|rises| **rises).count();
        rising >= 3 && 4 * rising >= 3 * rises.len()
    }
}

/// Where a record has hits.
struct Hits {
    /// How many readings up to a sample are of hits; 0 before the first.
    until: Vec<usize>,
    /// Samples on either side that may ring.
    around: usize,
}

impl Hits {
    fn of(record: &Record) -> Self {
        let mut count = 0;
        let counted = (0..record.len()).map(|sample| {
            count += usize::from(record.size_g(sample) > HIT_G);
            count
        });
        Self { until: std::iter::once(0).chain(counted).collect(), around: record.samples_in(RINGS_S) }
    }

    fn are_far(&self, sample: usize) -> bool {
        let last = self.until.len() - 1;
        self.until[(sample + self.around + 1).min(last)] == self.until[sample.saturating_sub(self.around)]
    }
}

/// Adds an axis' products of neighbouring noise over its variance, where it is quiet.
fn pool(axis: &[f64], is_asked: impl Fn(usize) -> bool, cell: usize, product: &mut [f64], weight: &mut [f64]) {
    let count = axis.len();
    if count < 4 * SMOOTHED {
        return;
    }
    let half = SMOOTHED / 2;
    let mut curved: Vec<f64> = axis.windows(3).map(|three| (three[2] - 2.0 * three[1] + three[0]).abs()).collect();
    let middle = curved.len() / 2;
    // The second difference of white noise has six times its variance.
    let noise_g = (1.4826 * *curved.select_nth_unstable_by(middle, f64::total_cmp).1 / 6f64.sqrt()).max(LEAST_NOISE_G);
    let noise: Vec<f64> = (0..count)
        .map(|at| {
            let around = &axis[at.saturating_sub(half)..(at + half + 1).min(count)];
            axis[at] - around.iter().sum::<f64>() / around.len() as f64
        })
        .collect();
    let mut louder = 0;
    let loud: Vec<usize> = noise
        .iter()
        .map(|reading| {
            louder += usize::from(reading.abs() > NOISY * noise_g);
            louder
        })
        .collect();
    let quiet = |at: usize| loud[at + 1 + AROUND] == loud[at - AROUND - 1];
    let variance = noise_g * noise_g;
    for at in AROUND + 1..count - AROUND - 2 {
        if quiet(at) && is_asked(at) {
            product[at / cell] += noise[at] * noise[at + 1] / variance;
            weight[at / cell] += 0.5 * (noise[at] * noise[at] + noise[at + 1] * noise[at + 1]) / variance;
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::super::{FileFormat, read_bytes};
    use super::*;

    /// Samples of a hit with what rings behind it.
    const LONG: u32 = 120;

    /// Twelve records of two seconds at 1 kHz that were begun alike: every 600 samples something hits and rings.
    fn records() -> Vec<Record> {
        let mut rng = Pcg64::seed_from_u64(5);
        let mut text = String::from("trial,height_m,t_s,accel_g\n");
        for trial in 0..12 {
            for at in 0..2000_u32 {
                let white: f64 = StandardNormal.sample(&mut rng);
                let rings = libm::sin(0.1 * std::f64::consts::PI * f64::from(at));
                let reads_g = match (at + 300) % 600 {
                    within if within < LONG && within % 20 == 0 => 6.0,
                    within if within < LONG => rings + 0.1 * white,
                    _ => 0.1 * white,
                };
                text += &format!("{trial},0.5,{},{reads_g:.5}\n", f64::from(at) * 1e-3);
            }
        }
        let set = read_bytes(&[("a.csv".into(), text.into())], &FileFormat::default()).expect("reads");
        set.records().cloned().collect()
    }

    #[test]
    fn planted_hits_at_the_same_samples_of_all_records_are_no_period() {
        let records = records();
        let records: Vec<&Record> = records.iter().collect();
        let hits = ClockPeriod { samples: 600.0, begin: 300.0, stretch: f64::from(LONG), rise: 0.0 };
        let rise = Pooled::of(&records, 2000, 1, |_, _| true).rise_in(&hits);
        let period = ClockPeriod::of(&records);
        assert!(rise > RISE && period.is_none(), "{period:?} {rise}");
    }
}
