//! Where a fit of an effect begins, and what its residual would look like there.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::impact::effects::{Model, SENSOR_SATURATION, Spec, candidates};
use crate::impact::fit::FitProblem;

/// An effect at some values.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Its record.
    pub spec: &'static Spec,
    /// Index of the chosen word.
    pub word: usize,
    /// Values in the units of model files.
    pub values: Vec<f64>,
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

/// The starts of every effect of a list that a model does not hold yet; of a limit that is seen, that one alone.
fn starts(catalogue: &[&'static Spec], model: &Model, seen_limit_g: Option<f64>) -> Vec<Start> {
    let listed = |spec: &Spec| model.effects.iter().any(|listed| listed.spec.id == spec.id);
    let mut all = Vec::new();
    for spec in candidates(catalogue, model).into_iter().filter(|spec| !listed(spec)) {
        let words = spec.choice.map_or(1, |choice| choice.words.len());
        for word in 0..words {
            let tried = match seen_limit_g {
                Some(level_g) if spec.id == SENSOR_SATURATION.id => vec![vec![level_g]],
                _ => (spec.starts)(&model.known()),
            };
            all.extend(tried.into_iter().map(|values| Start { spec, word, values }));
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
    /// The effects of a list on top of a model.
    pub fn on(problem: &FitProblem, model: &Model, catalogue: &[&'static Spec]) -> Option<Self> {
        let here = problem.prediction(model)?;
        let tried: Vec<(Start, DVector<f64>)> = starts(catalogue, model, problem.seen_limit_g)
            .into_par_iter()
            .filter_map(|start| Some((start.clone(), problem.prediction(&start.on(model))? - &here)))
            .collect();
        let columns: Vec<DVector<f64>> = tried.iter().map(|(_, column)| column.clone()).collect();
        Some(Self { starts: tried.into_iter().map(|(start, _)| start).collect(), columns: DMatrix::from_columns(&columns) })
    }
}
