//! Where a fit of an effect begins, and what its residual would look like there.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::impact::effects::{Model, Spec, candidates};
use crate::impact::fit::Problem;

/// An effect at some values.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Its entry in the catalogue.
    pub spec: &'static Spec,
    /// Index of the chosen word.
    pub word: usize,
    /// Values in the units of model files.
    pub values: Vec<f64>,
}

impl PartialEq for Spec {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

impl Start {
    /// A model with the effect on top.
    pub fn on(&self, model: &Model) -> Model {
        model.clone().with(self.spec, &self.values, self.word)
    }

    /// The effect with `factor` times as much of it, within bounds; as it is where no parameter says how much.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let mut scaled = self.clone();
        let parameters = self.spec.parameters.iter().zip(&mut scaled.values);
        for (parameter, value) in parameters {
            if let Some(off) = parameter.off {
                *value = (off + factor * (*value - off)).clamp(parameter.min, parameter.max);
            }
        }
        scaled
    }
}

/// Every product of the values of a first and a second parameter.
fn products(first: &[f64], second: &[f64], rest: &[f64]) -> Vec<Vec<f64>> {
    first.iter().flat_map(|a| second.iter().map(move |b| [&[*a, *b], rest].concat())).collect()
}

/// A payload's frequencies. Two waves that ring out within 20 ms are out of step when they differ by more than 25 Hz, and a fit
/// from there ends in a minimum of its own.
const FREQUENCIES_HZ: [f64; 16] =
    [45.0, 58.0, 72.0, 88.0, 105.0, 124.0, 144.0, 166.0, 189.0, 214.0, 240.0, 268.0, 298.0, 330.0, 365.0, 410.0];

/// Values to start from, over the bounds of the library and dense enough for a fit to find its way from the nearest.
fn values(spec: &Spec, model: &Model) -> Vec<Vec<f64>> {
    let single = |list: &[f64]| list.iter().map(|value| vec![*value]).collect();
    match spec.id {
        "unilateral_contact" => single(&[0.0, 0.5]),
        "bottoming" => products(&[3.0, 5.0, 8.0, 11.0, 14.0, 18.0, 23.0], &[2e5, 2e6, 1.5e7], &[0.3]),
        "cubic_stiffness" => single(&[-5e6, 4e6, 4e7]),
        "bilinear_stiffness" => products(&[2.0, 5.0, 8.0, 12.0, 16.0, 22.0, 30.0], &[-3e3, 3e3, 2e4], &[]),
        "hunt_crossley_damping" => single(&[-1.5e3, 1e3, 6e3]),
        "coulomb_friction" => single(&[3.0, 15.0, 45.0]),
        "maxwell_branch" => products(&[1e3, 8e3, 2.5e4], &[0.4, 1.0, 2.5, 6.0, 15.0], &[]),
        "quadratic_damping" => single(&[-4.0, 3.0, 20.0]),
        "preload" => single(&[3.0, 15.0, 60.0]),
        "sensor_low_pass" => {
            single(&[0.4, 0.75, 0.93, 1.07, 1.35, 2.5, 6.0].map(|factor| (model.sensor.cutoff_hz * factor).clamp(20.0, 2000.0)))
        }
        "sensor_saturation" => single(&[15.0, 25.0, 35.0, 50.0, 70.0, 95.0, 130.0, 180.0]),
        "sensor_gain" => single(&[0.85, 1.15]),
        "payload_mode" => {
            let own = model.frame_mode.map(|[mu, f_hz]| vec![mu, f_hz, 0.05]);
            products(&[0.05, 0.2], &FREQUENCIES_HZ, &[0.05]).into_iter().chain(own).collect()
        }
        "foot_stagger" => single(&[1.0, 4.0, 10.0]),
        "drop_height_error" => single(&[-0.1, 0.1]),
        "air_drag" => single(&[0.05, 0.3]),
        "frame_force_curve" => single(&[0.3, 1.0]),
        _ => Vec::new(),
    }
}

/// The starts of every effect that a model does not hold yet.
pub fn starts(model: &Model) -> Vec<Start> {
    let listed = |spec: &Spec| model.effects.iter().any(|listed| listed.spec.id == spec.id);
    let mut all = Vec::new();
    for spec in candidates(model).into_iter().filter(|spec| !listed(spec)) {
        let words = spec.choice.map_or(1, |choice| choice.words.len());
        for word in 0..words {
            all.extend(values(spec, model).into_iter().map(|values| Start { spec, word, values }));
        }
    }
    all
}

/// Starts with what each would change in the predicted mean waves.
#[derive(Clone, Debug)]
pub struct Dictionary {
    /// The starts, one a column.
    pub starts: Vec<Start>,
    /// Changes of the mean waves, g.
    pub columns: DMatrix<f64>,
}

impl Dictionary {
    /// On top of a model.
    pub fn on(problem: &Problem, model: &Model) -> Option<Self> {
        let here = problem.prediction(model)?;
        let tried: Vec<(Start, DVector<f64>)> = starts(model)
            .into_par_iter()
            .filter_map(|start| Some((start.clone(), problem.prediction(&start.on(model))? - &here)))
            .collect();
        let columns: Vec<DVector<f64>> = tried.iter().map(|(_, column)| column.clone()).collect();
        Some(Self { starts: tried.into_iter().map(|(start, _)| start).collect(), columns: DMatrix::from_columns(&columns) })
    }
}
