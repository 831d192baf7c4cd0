//! Trigger jitter: the variation of single readings moves the sample at which a record crosses the trigger, and so the mean of
//! trigger-aligned records.
//!
//! Where readings vary by half of themselves, one in fifty of the first large ones falls below the trigger, and its record is
//! aligned a step too late. Just below the crossing, some records are early. The computation follows the probability that no
//! sample was beyond the trigger yet, with the mean and variance of the readings under that condition, sample by sample: an
//! assumed normal density (P. S. Maybeck, *Stochastic Models, Estimation, and Control*, vol. 2 (1982), chapter 12). At the trigger
//! a tenth of the shift is left, behind it a third.
//!
//! *When it is wrong:* where the variation is not in proportion to the wave, and where white noise comes near the trigger.

use super::fine_wave::FineWave;
use super::normal_table::NormalTable;
use super::waves::BEFORE;
use crate::impact::measured::TRIGGER_G;
use crate::impact::wide_registers::{Loops, with_wide_registers};

/// Correlation times of coloured noise, s.
pub(super) const TIMES_S: [f64; 6] = [0.3e-3, 0.7e-3, 1.5e-3, 3e-3, 7e-3, 20e-3];
/// Relative variation of readings below which the change of a mean cannot be seen.
const SLIGHT: f64 = 0.15;
/// Phases of the clock in a step, each with its weight: the points of Gauss and Legendre (M. Abramowitz and I. A. Stegun, *Handbook of Mathematical
/// Functions* (1964), table 25.4, n = 12), from the middle of the step outward. Where the first sample behind the crossing is large, the share of records
/// that miss the trigger changes within a tenth of a step: twenty even phases were off by up to 0.4 g there, these are by 0.15 g.
const PHASES: [[f64; 2]; 6] = [
    [0.125_233_408_511_469, 0.249_147_045_813_403],
    [0.367_831_498_998_180, 0.233_492_536_538_355],
    [0.587_317_954_286_617, 0.203_167_426_723_066],
    [0.769_902_674_194_305, 0.160_078_328_543_346],
    [0.904_117_256_370_475, 0.106_939_325_995_318],
    [0.981_560_634_246_719, 0.047_175_336_386_512],
];
/// Samples from the crossing on of which one is beyond the trigger.
const LATEST: usize = 6;
/// Probability that is not followed.
const NEVER: f64 = 1e-7;

/// Variation of single readings in proportion to the wave: variance of the factor, by its correlation time; the last part is
/// one factor a record.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TriggerJitter {
    /// Variances, no unit.
    pub by_time: [f64; TIMES_S.len() + 1],
}

/// Correlation of the factor between a sample of a window and each that follows; 0 where it moves nothing.
#[derive(Clone, Debug)]
pub struct Lags(Vec<f64>);

impl TriggerJitter {
    fn variance(&self) -> f64 {
        self.by_time.iter().sum()
    }

    /// Whether it moves a mean.
    pub fn moves(&self) -> bool {
        self.variance() > SLIGHT * SLIGHT
    }

    /// Correlation of the factor over the time between samples of a window.
    pub fn lags(&self, step_s: f64, samples: usize) -> Lags {
        if !self.moves() {
            return Lags(vec![0.0; samples]);
        }
        let (long, variance) = (self.by_time[TIMES_S.len()], self.variance());
        let a_step = TIMES_S.map(|own_s| libm::exp(-step_s / own_s));
        let mut left: [f64; TIMES_S.len()] = std::array::from_fn(|at| self.by_time[at]);
        let mut kept = Vec::with_capacity(samples);
        for _ in 0..samples {
            kept.push((left.iter().sum::<f64>() + long) / variance);
            left.iter_mut().zip(a_step).for_each(|(left, a_step)| *left *= a_step);
        }
        Lags(kept)
    }

    /// The correction of a mean window without variation, g.
    pub fn shift(&self, fine: &FineWave, step_s: f64, lags: &Lags) -> Vec<f64> {
        with_wide_registers(Shifting { jitter: self, fine, step_s, lags })
    }

    /// The same over phases of the clock, parts of a step, each with its share.
    #[inline(always)]
    fn shift_over(&self, phases: impl Iterator<Item = [f64; 2]>, fine: &FineWave, step_s: f64, Lags(kept): &Lags) -> Vec<f64> {
        let samples = kept.len();
        let first = (fine.crossing_s / step_s).ceil() as usize + 1;
        let (mut sum, mut wave) = (vec![0.0; samples], vec![0.0; first + LATEST + samples]);
        let normal = NormalTable::new();
        for [part, share] in phases {
            fine.read(|i| fine.crossing_s + step_s * (part + i as f64 - first as f64), &mut wave);
            Record { wave: &wave, kept, sd: self.variance().sqrt(), normal }.aligned(first, share, &mut sum);
            sum.iter_mut().zip(&wave[first - BEFORE..]).for_each(|(sum, reading)| *sum -= share * reading);
        }
        sum
    }
}

/// The correction of a mean window over all phases.
struct Shifting<'a> {
    jitter: &'a TriggerJitter,
    fine: &'a FineWave<'a>,
    step_s: f64,
    lags: &'a Lags,
}

impl Loops for Shifting<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run(self) -> Vec<f64> {
        let each = PHASES.into_iter().flat_map(|[place, weight]| [-place, place].map(|place| [0.5 * (1.0 + place), 0.5 * weight]));
        self.jitter.shift_over(each, self.fine, self.step_s, self.lags)
    }
}

/// Samples of one phase.
struct Record<'a> {
    wave: &'a [f64],
    kept: &'a [f64],
    sd: f64,
    normal: NormalTable,
}

impl Record<'_> {
    /// Adds a share of the mean window over the variation; `crossing` is the first sample that is beyond the trigger without it.
    #[inline(always)]
    fn aligned(&self, crossing: usize, share: f64, sum: &mut [f64]) {
        let (mut open, mut mean, mut variance, mut before) = (1.0, 0.0, 1.0, 0.0);
        for at in BEFORE..=crossing + LATEST {
            mean *= self.kept[1];
            variance = 1.0 - self.kept[1] * self.kept[1] * (1.0 - variance);
            let along = self.sd * self.wave[at].abs() * variance.sqrt();
            let missed = Missed::of(self.normal, self.wave[at].abs() * (1.0 + self.sd * mean), along);
            let last = at == crossing + LATEST;
            let hit = if last { open } else { open * (1.0 - missed.probability) };
            if hit > NEVER {
                let factor = if last { mean } else { mean - variance.sqrt() * missed.first / (1.0 - missed.probability) };
                let (early, late) = sum.split_at_mut(BEFORE);
                let along = self.sd * factor;
                let weight = share * hit;
                early[BEFORE - 1] += weight * before;
                for ((sum, reading), kept) in late.iter_mut().zip(&self.wave[at..]).zip(self.kept) {
                    *sum += weight * reading * (1.0 + along * kept);
                }
            }
            open -= hit;
            if open < NEVER {
                break;
            }
            let moved = missed.first / missed.probability;
            before = self.wave[at] * (1.0 + self.sd * (mean + variance.sqrt() * moved));
            mean += variance.sqrt() * moved;
            variance *= (1.0 + missed.second / missed.probability - moved * moved).clamp(0.0, 1.0);
        }
    }
}

/// A reading that stays within the trigger: its probability, and moments of its deviation over the part where it does.
struct Missed {
    probability: f64,
    first: f64,
    second: f64,
}

impl Missed {
    #[inline(always)]
    fn of(normal: NormalTable, mean_g: f64, sd_g: f64) -> Self {
        if sd_g <= 1e-9 {
            return Self { probability: f64::from(u8::from(mean_g <= TRIGGER_G)), first: 0.0, second: 0.0 };
        }
        let (low, high) = ((-TRIGGER_G - mean_g) / sd_g, (TRIGGER_G - mean_g) / sd_g);
        let ([at_low, below_low], [at_high, below_high]) = (normal.at(low), normal.at(high));
        Self { probability: below_high - below_low, first: at_low - at_high, second: low * at_low - high * at_high }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fine_wave::FINE_S;
    use super::*;

    #[test]
    fn analytic_wide_registers_give_the_bits_of_narrow_ones() {
        let wave: Vec<f64> = (0..700).map(|at| 90.0 * libm::sin(f64::from(at) * FINE_S / 9e-3).max(-0.1)).collect();
        let (fine, mut jitter) = (FineWave::of(&wave), TriggerJitter::default());
        jitter.by_time = [0.02, 0.03, 0.05, 0.01, 0.02, 0.01, 0.06];
        let lags = jitter.lags(1e-3, 30);
        let shifting = || Shifting { jitter: &jitter, fine: &fine, step_s: 1e-3, lags: &lags };
        let [wide, narrow] = [with_wide_registers(shifting()), shifting().run()];
        assert!(wide.iter().any(|shift| shift.abs() > 0.1) && wide == narrow, "{wide:?}");
    }

    /// Half sines of different steepness, whose readings vary by a third and by two thirds of themselves: within 0.15 g, where mean waves
    /// are known to grams.
    #[test]
    fn analytic_twelve_phases_say_what_four_hundred_say() {
        let even = || (0..400).map(|phase| [(f64::from(phase) + 0.5) / 400.0, 1.0 / 400.0]);
        for (peak_g, lasts_s) in [(40.0, 12e-3), (100.0, 10e-3), (150.0, 6e-3)] {
            let wave: Vec<f64> =
                (0..700).map(|at| peak_g * libm::sin((f64::from(at) * FINE_S / lasts_s).min(1.0) * std::f64::consts::PI)).collect();
            let fine = FineWave::of(&wave);
            for variance in [0.1, 0.4] {
                let mut jitter = TriggerJitter::default();
                (jitter.by_time[0], jitter.by_time[TIMES_S.len()]) = (0.7 * variance, 0.3 * variance);
                let lags = jitter.lags(1e-3, 30);
                let (all, few) = (jitter.shift_over(even(), &fine, 1e-3, &lags), jitter.shift(&fine, 1e-3, &lags));
                let most = all.iter().map(|all| all.abs()).fold(0.0, f64::max);
                let off = all.iter().zip(&few).map(|(all, few)| (all - few).abs()).fold(0.0, f64::max);
                assert!(most > 0.1 && off < 0.15, "{peak_g} g, {variance}: {off} of {most} g");
            }
        }
    }
}
