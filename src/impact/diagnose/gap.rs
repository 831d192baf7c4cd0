//! How far a model's mean wave lies from the measured one, without the part that is trial variation.

use nalgebra::DVector;

use super::candidate::Candidate;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Layout, MeanWave, Waves};

/// A gap in g.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Gap {
    /// Root of the mean over samples of (mean wave - model)² - SE², not below zero.
    pub net_g: f64,
    /// The same without taking SE² out.
    pub raw_g: f64,
    /// Root of the mean of SE², the standard error of the mean wave.
    pub floor_g: f64,
    /// Root mean square of single records against the model.
    pub records_g: f64,
    /// The same against their own mean wave: no curve of height alone does better.
    pub template_g: f64,
}

impl Gap {
    /// One that nobody could compute, as that to other heights where there are none.
    pub const UNKNOWN: Self = Self { net_g: f64::NAN, raw_g: f64::NAN, floor_g: f64::NAN, records_g: f64::NAN, template_g: f64::NAN };
}

/// Steps of a refit that begins where all heights ended.
const STEPS: usize = 8;

/// Sums over samples.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    square: f64,
    error: f64,
    scatter: f64,
    count: f64,
}

impl Sums {
    fn add(&mut self, measured: &[f64], predicted: &[f64], errors: &[f64], drops: usize) {
        for ((measured, predicted), error) in measured.iter().zip(predicted).zip(errors) {
            self.square += (measured - predicted) * (measured - predicted);
            self.error += error * error;
            self.scatter += error * error * (drops as f64 - 1.0);
            self.count += 1.0;
        }
    }

    fn gap(self) -> Gap {
        let (square, error) = (self.square / self.count, self.error / self.count);
        let scatter = self.scatter / self.count;
        Gap {
            net_g: (square - error).max(0.0).sqrt(),
            raw_g: square.sqrt(),
            floor_g: error.sqrt(),
            records_g: (square + scatter).sqrt(),
            template_g: scatter.sqrt(),
        }
    }
}

impl Gap {
    /// Of mean windows and what is predicted for them, with the standard errors of the means and the number of their records.
    pub fn between<'a>(means: impl IntoIterator<Item = (&'a [f64], &'a [f64], &'a [f64], usize)>) -> Self {
        let mut sums = Sums::default();
        for (measured, predicted, errors, drops) in means {
            sums.add(measured, predicted, errors, drops);
        }
        if sums.count > 0.0 { sums.gap() } else { Self::UNKNOWN }
    }
}

/// The gap of a model at all heights of measured waves.
pub fn gap(problem: &FitProblem, waves: &Waves, model: &Model) -> Option<Gap> {
    let mut sums = Sums::default();
    let system = problem.expected.system(model);
    for group in &waves.groups {
        sums.add(&group.mean, &problem.expected.window(&system, group.height_m)?, &errors(group), group.windows.len());
    }
    (sums.count > 0.0).then(|| sums.gap())
}

/// The gap at each height of a model that was refitted to the others.
pub fn left_out_heights(problem: &FitProblem, waves: &Waves, candidate: &Candidate) -> Option<Gap> {
    let all = problem.chosen.clone();
    let mut sums = Sums::default();
    for out in &all {
        let others: Vec<usize> = all.iter().copied().filter(|height| height != out).collect();
        let refitted = problem.at(&others).fit(Layout::clone(&candidate.fitted.layout), STEPS)?;
        let predicted = problem.at(&[*out]).prediction(refitted.model())?;
        sums.add(&waves.groups[*out].mean, predicted.as_slice(), &errors(&waves.groups[*out]), waves.groups[*out].windows.len());
    }
    Some(sums.gap())
}

/// The gap to every second drop of a model that was refitted to the others.
pub fn left_out_trials(problem: &FitProblem, waves: &Waves, candidate: &Candidate) -> Option<Gap> {
    let mut sums = Sums::default();
    for out in 0..2 {
        let halves = |keep: bool| waves.half(|drop| (drop % 2 == out) == keep);
        let (fitted, judged) = (halves(false), halves(true));
        let means = fitted.groups.iter().map(MeanWave::of).collect();
        let half = FitProblem { means, ..problem.clone() };
        let refitted = half.fit(Layout::clone(&candidate.fitted.layout), STEPS)?;
        let predicted: DVector<f64> = half.prediction(refitted.model())?;
        for (at, group) in judged.groups.iter().enumerate() {
            sums.add(&group.mean, &predicted.as_slice()[at * waves.samples..(at + 1) * waves.samples], &errors(group), group.windows.len());
        }
    }
    Some(sums.gap())
}

/// Standard error of a group's mean wave, g.
pub fn errors(group: &crate::impact::fit::WaveGroup) -> Vec<f64> {
    let count = group.windows.len() as f64;
    let square = |i: usize| group.windows.iter().map(|window| (window[i] - group.mean[i]) * (window[i] - group.mean[i])).sum::<f64>();
    (0..group.mean.len()).map(|i| (square(i) / ((count - 1.0).max(1.0) * count)).sqrt()).collect()
}
