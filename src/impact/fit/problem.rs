//! Mean waves compared with a model, in units of their own covariance.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::expected::Expected;
use super::free::Layout;
use super::least_squares::{Minimum, minimise};
use super::trial_covariance::Whitening;
use super::trigger_jitter::TriggerJitter;
use super::waves::{WaveGroup, Waves};
use crate::impact::effects::Model;

/// The mean wave of a height.
#[derive(Clone, Debug)]
pub struct MeanWave {
    /// Height, m.
    pub height_m: f64,
    /// Mean window, g.
    pub wave: Vec<f64>,
}

impl MeanWave {
    /// Of a group.
    pub fn of(group: &WaveGroup) -> Self {
        Self { height_m: group.height_m, wave: group.mean.clone() }
    }
}

/// Mean waves of some heights and their covariance.
#[derive(Clone, Debug)]
pub struct FitProblem {
    /// What a model has to predict.
    pub expected: Expected,
    /// A height each.
    pub means: Vec<MeanWave>,
    /// A height each.
    pub whitening: Whitening,
    /// Which heights are compared; the others are held out.
    pub chosen: Vec<usize>,
    /// The level at which readings are seen to pile up, g: `sensor_saturation` has it as its limit, which is then not fitted. A mean over drops
    /// that vary says less of a limit than readings that lie at it.
    pub seen_limit_g: Option<f64>,
}

/// A fit.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The model at its best, and what was free.
    pub layout: Layout,
    /// Where and how well.
    pub minimum: Minimum,
}

impl Fitted {
    /// The fitted model.
    pub fn model(&self) -> &Model {
        &self.layout.model
    }

    /// Sum of squares of the whitened residual.
    pub fn chi2(&self) -> f64 {
        self.minimum.sum
    }
}

impl FitProblem {
    /// All heights of measured waves.
    pub fn of(waves: &Waves, whitening: Whitening, spread: Arc<[f64]>) -> Self {
        let means = waves.groups.iter().map(MeanWave::of).collect();
        let expected = Expected { spread, ..Expected::plain(waves.step_s, waves.samples) };
        Self { expected, means, whitening, chosen: (0..waves.groups.len()).collect(), seen_limit_g: None }
    }

    /// The same where readings that vary move no trigger: what varies is in the waves that are predicted.
    #[must_use]
    pub fn without_trigger_jitter(self) -> Self {
        Self { expected: Expected { trigger_jitter: TriggerJitter::default(), ..self.expected }, ..self }
    }

    /// The same with some heights alone.
    #[must_use]
    pub fn at(&self, chosen: &[usize]) -> Self {
        Self { chosen: chosen.to_vec(), ..self.clone() }
    }

    /// Numbers compared.
    pub fn len(&self) -> usize {
        self.chosen.len() * self.expected.samples
    }

    /// Whether nothing is compared.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Predicted mean windows of the chosen heights, one below the other, g.
    pub fn prediction(&self, model: &Model) -> Option<DVector<f64>> {
        let system = self.expected.system(model);
        let mut all = Vec::with_capacity(self.len());
        for height in &self.chosen {
            let mean = &self.means[*height];
            all.extend(self.expected.window(&system, mean.height_m)?);
        }
        Some(DVector::from_vec(all))
    }

    /// Measured mean windows of the chosen heights, one below the other, g.
    pub fn measured(&self) -> DVector<f64> {
        DVector::from_iterator(self.len(), self.chosen.iter().flat_map(|height| self.means[*height].wave.iter().copied()))
    }

    /// Deviations in g to whitened deviations.
    pub fn whitened(&self, deviation: &DVector<f64>) -> DVector<f64> {
        let samples = self.expected.samples;
        let mut out = DVector::zeros(deviation.len());
        for (at, height) in self.chosen.iter().enumerate() {
            let part = self.whitening.height(*height) * deviation.rows(at * samples, samples);
            out.rows_mut(at * samples, samples).copy_from(&part);
        }
        out
    }

    /// Measured less predicted, whitened.
    pub fn residual(&self, model: &Model) -> Option<DVector<f64>> {
        Some(self.whitened(&(self.measured() - self.prediction(model)?)))
    }

    /// Fits what the layout leaves free, from its values on.
    pub fn fit(&self, layout: Layout, most_steps: usize) -> Option<Fitted> {
        let layout = match self.seen_limit_g {
            Some(level_g) => layout.with_seen_limit(level_g),
            None => layout,
        };
        let residual = |scaled: &[f64]| self.residual(&layout.model_at(scaled));
        let minimum = minimise(residual, &layout.values(), &layout.bounds(), &layout.steps(), most_steps)?;
        let model = layout.model_at(&minimum.at);
        Some(Fitted { layout: Layout { model, free: layout.free }, minimum })
    }

    /// Columns of predicted change, in g, for a unit of each free parameter on the fit's scale.
    pub fn sensitivity(&self, fitted: &Fitted) -> Option<DMatrix<f64>> {
        let (values, steps, bounds) = (fitted.layout.values(), fitted.layout.steps(), fitted.layout.bounds());
        let here = self.prediction(fitted.model())?;
        let mut columns = DMatrix::zeros(here.len(), values.len());
        for i in 0..values.len() {
            let mut moved = values.clone();
            let step = if moved[i] + steps[i] > bounds[i][1] { -steps[i] } else { steps[i] };
            moved[i] += step;
            columns.set_column(i, &((self.prediction(&fitted.layout.model_at(&moved))? - &here) / step));
        }
        Some(columns)
    }
}
