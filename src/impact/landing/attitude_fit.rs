//! How the sensor leans, from single drops: what their touches do not explain of the axis is compared with their lateral axes.
//!
//! Four legs that are alike land alike when a landing is mirrored, so what is left of the axis has no part that changes its sign with the
//! lateral readings. A sensor that leans shows one. Its lean is the one for which the readings, turned back, show none: the sum over drops of
//! lateral reading times rest is 0, in units of the rest's covariance. That covariance is of the readings turned back, too: where it is of those
//! that were read, forty drops let it explain what was picked up, and the estimates have half of the lean. Drops are aligned anew once they are
//! turned back. Means over the drops of a height are taken off: a hand that favours one foot shifts them as a lean does.
//!
//! *When it is wrong:* a leg that is stiffer than the others, or a sensor or a centre of mass beside the middle, leaves a part of that kind,
//! too.

use nalgebra::{DMatrix, DVector};

use super::observed::HeightLandings;
use super::sensor_attitude::SensorAttitude;
use crate::impact::fit::{Decimation, aligned_windows, inverse_root};

/// Angles.
pub const ANGLES: usize = 2;
/// What holds the covariance of few drops back, as a part of its mean variance: drops determine its small eigenvalues badly.
const RIDGE: f64 = 0.3;
/// Difference of the quotients that say how the score falls with the lean, rad: wide, as drops are aligned at whole readings.
const STEP_RAD: f64 = 0.05;
/// Beyond it, no lean of a sensor is meant, rad.
const LOST_RAD: f64 = 0.6;
/// Most steps of the search, and a step that ends it, rad.
const MOST_STEPS: usize = 30;
const SETTLED_RAD: f64 = 2e-4;

/// The drops of a height, with what their touches let expect.
#[derive(Clone, Debug)]
pub struct HeightReadings {
    decimation: Decimation,
    drops: Vec<DropReadings>,
}

#[derive(Clone, Debug)]
struct DropReadings {
    /// Along the sensor's x, y and axis, as recorded, g.
    axes: [Vec<f64>; 3],
    /// Window along the axis by the touches, g.
    predicted: DVector<f64>,
    /// Windows along x, y and axis as they are aligned without a lean, g.
    windows: [Vec<f64>; 3],
}

/// Drops of a height turned back by an attitude, less their mean over the drops, g: along x, along y, and what touches leave of the axis.
struct TurnedDrops([Vec<DVector<f64>>; 3]);

/// An attitude with the covariance of its angles.
#[derive(Clone, Debug)]
pub struct AttitudeFit {
    /// The angles.
    pub attitude: SensorAttitude,
    /// By how the drops differ, rad².
    pub covariance: DMatrix<f64>,
}

impl HeightReadings {
    /// Of drops and what their touches leave of each, g; `None` where one cannot be aligned.
    pub fn of(height: &HeightLandings, left: &[DVector<f64>]) -> Option<Self> {
        let drops = height.drops.iter().zip(left).map(|(drop, left)| {
            let axes = drop.axes.clone();
            let windows = aligned_windows(&height.decimation, left.len(), axes.each_ref().map(Vec::as_slice))?;
            Some(DropReadings { axes, predicted: DVector::from_column_slice(&drop.window) - left, windows })
        });
        Some(Self { decimation: height.decimation, drops: drops.collect::<Option<_>>()? })
    }

    /// Geometric mean of the variances that touches leave of readings turned back, along the axes of their covariance, g².
    pub fn variance_g2(&self, attitude: &SensorAttitude) -> Option<f64> {
        let root = self.turned(attitude).inverse_root()?;
        Some(libm::exp(-2.0 * root.diagonal().map(libm::log).sum() / root.nrows() as f64))
    }

    fn turned(&self, attitude: &SensorAttitude) -> TurnedDrops {
        let read = |drop: &DropReadings| {
            let axes = attitude.turned_back(drop.axes.each_ref().map(Vec::as_slice));
            let windows = aligned_windows(&self.decimation, drop.predicted.len(), axes.each_ref().map(Vec::as_slice));
            let [x, y, axis] = windows.unwrap_or_else(|| drop.windows.clone()).map(DVector::from_vec);
            [x, y, axis - &drop.predicted]
        };
        let read: Vec<[DVector<f64>; 3]> = self.drops.iter().map(read).collect();
        TurnedDrops([0, 1, 2].map(|at: usize| without_mean(read.iter().map(|one| one[at].clone()).collect())))
    }
}

impl TurnedDrops {
    /// Inverse of the lower root of the rest's covariance.
    fn inverse_root(&self) -> Option<DMatrix<f64>> {
        let Self([_, _, rests]) = self;
        let samples = rests.first()?.len();
        let sum = rests.iter().fold(DMatrix::zeros(samples, samples), |sum, rest| sum + rest * rest.transpose());
        let covariance = sum / rests.len() as f64;
        let level = covariance.trace() / samples as f64;
        inverse_root(&(covariance * (1.0 - RIDGE) + DMatrix::identity(samples, samples) * (RIDGE * level)))
    }

    /// Each drop's lateral readings times rest, along x and y, in units of a covariance.
    fn scores(&self, inverse_root: &DMatrix<f64>) -> Vec<DVector<f64>> {
        let Self([x, y, rests]) = self;
        let one = |((x, y), rest): ((&DVector<f64>, &DVector<f64>), &DVector<f64>)| {
            let weighed = inverse_root.tr_mul(&(inverse_root * rest));
            DVector::from_column_slice(&[x.dot(&weighed), y.dot(&weighed)])
        };
        x.iter().zip(y).zip(rests).map(one).collect()
    }
}

/// Columns less their mean.
fn without_mean(mut columns: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    if let Some(sum) = columns.iter().cloned().reduce(|sum, column| sum + column) {
        let mean = sum / columns.len() as f64;
        columns.iter_mut().for_each(|column| *column -= &mean);
    }
    columns
}

/// Each drop's score at an attitude, in units of the rest's covariance at another one.
fn scores(heights: &[&HeightReadings], at: &SensorAttitude, weighed_at: &SensorAttitude) -> Option<Vec<DVector<f64>>> {
    let mut all = Vec::new();
    for height in heights {
        let root = height.turned(weighed_at).inverse_root()?;
        all.extend(height.turned(at).scores(&root));
    }
    Some(all)
}

fn sum(scores: &[DVector<f64>]) -> DVector<f64> {
    scores.iter().fold(DVector::zeros(ANGLES), |sum, score| sum + score)
}

/// Sum of the squares of the drops' scores.
fn scatter(scores: &[DVector<f64>]) -> DMatrix<f64> {
    scores.iter().fold(DMatrix::zeros(ANGLES, ANGLES), |sum, score| sum + score * score.transpose())
}

fn moved(attitude: &SensorAttitude, by: &DVector<f64>) -> SensorAttitude {
    SensorAttitude { x_rad: attitude.x_rad + by[0], y_rad: attitude.y_rad + by[1] }
}

/// How the lean follows the score: inverse of how fast the score falls; `None` where it does not. The units are those at the attitude itself, or
/// follow it.
fn following(heights: &[&HeightReadings], attitude: &SensorAttitude, units_follow: bool) -> Option<DMatrix<f64>> {
    let mut fall = DMatrix::zeros(ANGLES, ANGLES);
    for angle in 0..ANGLES {
        let mut by = DVector::zeros(ANGLES);
        by[angle] = STEP_RAD;
        let at = |by: &DVector<f64>| {
            let moved = moved(attitude, by);
            Some(sum(&scores(heights, &moved, if units_follow { &moved } else { attitude })?))
        };
        fall.set_column(angle, &((at(&-&by)? - at(&by)?) / (2.0 * STEP_RAD)));
    }
    (fall.diagonal().min() > 0.0 && fall.determinant() > 0.0).then(|| fall.try_inverse()).flatten()
}

impl AttitudeFit {
    /// Of the drops of some heights; `None` where their lateral axes say too little.
    pub fn of(heights: &[&HeightReadings]) -> Option<Self> {
        let mut attitude = SensorAttitude::default();
        for _ in 0..MOST_STEPS {
            let step = following(heights, &attitude, false)? * sum(&scores(heights, &attitude, &attitude)?);
            attitude = moved(&attitude, &step);
            if attitude.lean_rad() > LOST_RAD {
                return None;
            }
            if step.norm() < SETTLED_RAD {
                break;
            }
        }
        let following = following(heights, &attitude, true)?;
        let covariance = &following * scatter(&scores(heights, &attitude, &attitude)?) * following.transpose();
        Some(Self { attitude, covariance })
    }

    /// The angles, rad.
    pub fn angles_rad(&self) -> DVector<f64> {
        DVector::from_column_slice(&[self.attitude.x_rad, self.attitude.y_rad])
    }
}

/// How far the drops are from showing no lean.
pub struct NoLean {
    scores: Vec<DVector<f64>>,
    inverse: DMatrix<f64>,
}

impl NoLean {
    /// Of the drops of some heights.
    pub fn of(heights: &[&HeightReadings]) -> Option<Self> {
        let none = SensorAttitude::default();
        let scores = scores(heights, &none, &none)?;
        Some(Self { inverse: scatter(&scores).try_inverse()?, scores })
    }

    /// The score of no lean, squared, in units of its own scatter: chi squared with two degrees of freedom where there is none. `mirrored` says of
    /// which drops the lateral readings change their sign.
    pub fn chi_squared(&self, mut mirrored: impl FnMut() -> bool) -> f64 {
        let signed = self.scores.iter().map(|score| if mirrored() { -score } else { score.clone() });
        let sum = signed.fold(DVector::zeros(ANGLES), |sum, score| sum + score);
        sum.dot(&(&self.inverse * &sum))
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64;

    use super::*;
    use crate::impact::fit::NORMAL_97_5;

    const SAMPLES: usize = 31;
    const BEFORE: usize = 10;
    const RECORDED: usize = BEFORE + SAMPLES + 6;

    /// Forty drops that push from the tenth reading on, as predicted but for a normal rest, with three lateral spikes an axis, read by a sensor
    /// that leans. The first spike comes with the begin and moves the trigger.
    fn drops(lean: SensorAttitude, seed: u64) -> HeightReadings {
        let mut rng = Pcg64::seed_from_u64(seed);
        let sensor = SensorAttitude { x_rad: -lean.x_rad, y_rad: -lean.y_rad };
        let decimation = Decimation { native_s: 1e-3, kept_s: 1e-3 };
        let wave = |at: f64| 60.0 * libm::sin(at.clamp(0.0, 20.0) / 20.0 * std::f64::consts::PI);
        // The mean over the clock's phase, from where the wave crosses 3 g on.
        let crossed = 20.0 / std::f64::consts::PI * libm::asin(3.0 / 60.0);
        let predicted = DVector::from_fn(SAMPLES, |at, _| {
            let mean = |from: f64| (0..100).map(|i| wave(from + f64::from(i) / 100.0)).sum::<f64>() / 100.0;
            if at == 0 { 0.0 } else { mean(crossed + at as f64 - 1.0) }
        });
        let one = |_| {
            let mut normal = |size: f64| size * <StandardNormal as Distribution<f64>>::sample(&StandardNormal, &mut rng);
            let sizes: [[f64; 3]; 2] = std::array::from_fn(|_| std::array::from_fn(|_| normal(40.0)));
            let rest: Vec<f64> = (0..RECORDED).map(|_| normal(1.0)).collect();
            let later = [rng.random_range(1.0..8.0), rng.random_range(4.0..14.0)];
            let phase: f64 = rng.random();
            let along = |of: &dyn Fn(f64) -> f64| (0..RECORDED).map(|at| of(at as f64 - BEFORE as f64 + phase)).collect::<Vec<f64>>();
            let spike = |since: f64| if (0.0..2.0).contains(&since) { libm::sin(since * std::f64::consts::FRAC_PI_2) } else { 0.0 };
            let [x, y] = sizes.map(|[a, b, c]| along(&|at| a * spike(at) + b * spike(at - later[0]) + c * spike(at - later[1])));
            let axis: Vec<f64> = along(&wave).iter().zip(&rest).map(|(wave, rest)| if *wave > 0.0 { wave + rest } else { 0.0 }).collect();
            let axes = sensor.turned_back([&x, &y, &axis]);
            let windows = aligned_windows(&decimation, SAMPLES, axes.each_ref().map(Vec::as_slice)).expect("it triggers");
            DropReadings { axes, predicted: predicted.clone(), windows }
        };
        HeightReadings { decimation, drops: (0..40).map(one).collect() }
    }

    #[test]
    fn analytic_a_lean_is_found_within_its_error() {
        let (mut inside, mut off) = (0, DVector::zeros(ANGLES));
        let lean = SensorAttitude { x_rad: 0.05, y_rad: -0.08 };
        for seed in 0..60 {
            let fit = AttitudeFit::of(&[&drops(lean, seed)]).expect("is determined");
            let away = fit.angles_rad() - DVector::from_column_slice(&[lean.x_rad, lean.y_rad]);
            inside += (0..ANGLES).filter(|at| away[*at].abs() < NORMAL_97_5 * fit.covariance[(*at, *at)].sqrt()).count();
            off += away / 60.0;
        }
        // A covariance of forty drops makes intervals wide rather than narrow.
        assert!(off.norm() < 0.005 && inside >= 108, "{off} {inside} of 120");
    }

    #[test]
    fn analytic_no_lean_is_chi_squared() {
        let none = |seed| NoLean::of(&[&drops(SensorAttitude::default(), seed)]).expect("drops").chi_squared(|| false);
        let all: Vec<f64> = (0..300).map(none).collect();
        let mean = all.iter().sum::<f64>() / 300.0;
        // Its mean is 2, and one in a hundred is above 9.2.
        assert!((1.6..2.4).contains(&mean) && all.iter().filter(|one| **one > 9.2).count() <= 8, "{mean}");
    }
}
