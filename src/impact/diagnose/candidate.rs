//! Sets of effects, fitted.

use nalgebra::DVector;

use super::dictionary::{Dictionary, Start};
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Fitted, Free, Layout, inverse};

/// What a free parameter has to earn, in the sum of squares.
pub const PRICE: f64 = 5.0;
/// What parameters with a default have to earn beyond that: a default is what is known of them.
pub(super) const EARNS: f64 = 6.0;
/// Starts tried for each effect.
const TRIES: usize = 4;
/// Steps of a fit from a start.
const STEPS: usize = 14;
/// Springs from which the best sets are fitted again, over the fitted one.
const SPRINGS: [f64; 2] = [0.35, 2.5];
/// Further steps of a set that is carried on: at a place that is no minimum, what the set leaves would be taken for what its parameters can do.
const MORE_STEPS: usize = 80;

/// A model with effects on top of the base, fitted.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The fit.
    pub fitted: Fitted,
    /// Sum of squares and price of the parameters.
    pub score: f64,
}

impl Candidate {
    fn of(fitted: Fitted) -> Self {
        let on_top = fitted.layout.free.len() - 2;
        let score = fitted.chi2() + PRICE * on_top as f64;
        Self { fitted, score }
    }

    /// The fitted model.
    pub fn model(&self) -> &Model {
        self.fitted.model()
    }

    /// Ids of the effects on top of the base, in the catalogue's order.
    pub fn ids(&self) -> Vec<&'static str> {
        let on_top = self.model().effects.iter().filter(|listed| !listed.spec.is_base());
        on_top.map(|listed| listed.spec.id).collect()
    }

    /// Parameters at a bound where no estimate may end, in words. Of the base it is stiffness: without it, effects have taken its place.
    pub fn implausible(&self) -> Vec<String> {
        let minimum = &self.fitted.minimum;
        let free = self.fitted.layout.free.iter().zip(minimum.at_bound.iter().zip(&minimum.at)).enumerate();
        let may_end = |at: usize, free: &Free, value: f64| at == 1 || at > 1 && free.may_end_at(value);
        free.filter(|(place, (free, (at_bound, at)))| **at_bound && !may_end(*place, free, **at))
            .map(|(_, (free, _))| format!("{} of {}", free.key(), free.spec.id))
            .collect()
    }

    /// The score with what parameters have to earn that have a default.
    pub(super) fn worth(&self) -> f64 {
        let defaults = self.fitted.layout.free.iter().filter(|free| free.spec.parameters[free.at].default.is_some());
        self.score + EARNS * defaults.count() as f64
    }

    /// Fits a model from each of several starts and keeps the best.
    pub fn best(problem: &FitProblem, models: impl IntoIterator<Item = Model>) -> Option<Self> {
        let fits = models.into_iter().filter_map(|model| problem.fit(Layout::of_set(model), STEPS).map(Self::of));
        fits.min_by(|a, b| a.worth().total_cmp(&b.worth()))
    }

    /// The same at its minimum, where a fit from a start ended before it.
    #[must_use]
    pub fn settled(self, problem: &FitProblem) -> Self {
        if self.fitted.minimum.settled {
            return self;
        }
        problem.fit(self.fitted.layout.clone(), MORE_STEPS).map_or(self, Self::of)
    }

    /// The best of this and of fits from softer and stiffer springs: a force that sets in at a compression leaves a minimum on each side of it.
    #[must_use]
    pub fn restarted(self, problem: &FitProblem) -> Self {
        let again = Self::best(problem, SPRINGS.map(|factor| self.model().scaled([factor, 1.0])));
        match again.map(|again| again.settled(problem)) {
            Some(again) if again.score < self.score => again,
            _ => self,
        }
    }

    /// The same with parameters free that otherwise keep their default (a stop's damping, a payload's), where that earns
    /// more than its price.
    #[must_use]
    pub fn freed(self, problem: &FitProblem) -> Self {
        let layout = Layout::whole(self.model().clone());
        if layout.free.len() == self.fitted.layout.free.len() {
            return self;
        }
        match problem.fit(layout, MORE_STEPS).map(Self::of) {
            Some(freed) if freed.score < self.score - EARNS => freed,
            _ => self,
        }
    }

    /// The same with each default that is free at its value again, where being free does not earn more than its price: it may have in a smaller set.
    #[must_use]
    pub fn held(self, problem: &FitProblem) -> Self {
        let mut best = self;
        for free in best.fitted.layout.free.clone() {
            let Some(default) = free.spec.parameters[free.at].default else { continue };
            let mut layout = best.fitted.layout.clone();
            layout.free.retain(|one| one.spec.id != free.spec.id || one.at != free.at);
            for listed in layout.model.effects.iter_mut().filter(|listed| listed.spec.id == free.spec.id) {
                listed.values[free.at] = default;
            }
            match problem.fit(layout, MORE_STEPS).map(Self::of) {
                Some(held) if held.worth() <= best.worth() => best = held,
                _ => {}
            }
        }
        best
    }

    /// A model with the effects that it has already; `None` where it has none, or cannot be fitted.
    pub fn given(problem: &FitProblem, model: &Model) -> Option<Self> {
        let has_effects = model.effects.iter().any(|listed| !listed.spec.is_base());
        has_effects.then(|| Self::best(problem, [model.clone()]))?.map(|given| given.settled(problem))
    }

    /// The base model on its own.
    pub fn base(problem: &FitProblem, model: &Model) -> Option<Self> {
        let [k, c] = model.stiffness_and_damping();
        let with = |k: f64, c: f64| Model {
            name: model.name.clone(),
            frame_curve: model.frame_curve.clone(),
            frame_mode: model.frame_mode,
            ..Model::base(model.body.clone(), model.sensor, k, c)
        };
        Self::best(problem, [with(k, c), with(k, 0.4 * c), with(0.5 * k, 1.5 * c), with(2.0 * k, 0.7 * c)])
            .map(|base| base.settled(problem))
    }
}

/// A start on a fitted model, with the sum of squares that a linear fit from there promises.
#[derive(Clone, Debug)]
pub struct Promise {
    /// The start, with the amount of it from the linear fit.
    pub start: Start,
    /// Promised sum of squares, with what free defaults have to earn.
    pub sum: f64,
}

/// What every start of a dictionary promises, best first.
pub fn promises(problem: &FitProblem, fitted: &Fitted, dictionary: &Dictionary) -> Option<Vec<Promise>> {
    let jacobian = &fitted.minimum.jacobian;
    let inverse = inverse(&(jacobian.transpose() * jacobian))?;
    let left = |column: DVector<f64>| &column - jacobian * (&inverse * (jacobian.transpose() * &column));
    let residual = left(fitted.minimum.residual.clone());
    let whole = residual.norm_squared();
    let mut all: Vec<Promise> = Vec::new();
    for (start, column) in dictionary.starts.iter().zip(dictionary.columns.column_iter()) {
        let change = left(problem.whitened(&column.into_owned()));
        let (along, length) = (residual.dot(&change), change.norm_squared());
        let scalable = start.spec.parameters.iter().any(|parameter| parameter.off.is_some());
        let factor = if length <= 0.0 || !scalable { 1.0 } else { (along / length).clamp(0.05, 3.0) };
        let sum = whole - 2.0 * factor * along + factor * factor * length;
        // What a default that is free has to earn.
        let freed = start
            .spec
            .parameters
            .iter()
            .zip(&start.values)
            .filter(|(parameter, value)| parameter.default.is_some_and(|own| own != **value));
        let sum = sum + (PRICE + EARNS) * freed.count() as f64;
        all.push(Promise { start: start.scaled(factor), sum });
    }
    all.sort_by(|a, b| a.sum.total_cmp(&b.sum));
    Some(all)
}

/// The most promising starts of one effect.
pub fn tries<'a>(promises: &'a [Promise], id: &str) -> Vec<&'a Start> {
    let own: Vec<&Start> = promises.iter().map(|promise| &promise.start).filter(|start| start.spec.id == id).collect();
    let count = if own.first().is_some_and(|start| start.values.len() > 1) { TRIES } else { 2 };
    own.into_iter().take(count).collect()
}

/// Ids with ` + ` between.
pub fn joined(candidate: &Candidate) -> String {
    let ids = candidate.ids();
    if ids.is_empty() { "the base model".into() } else { ids.join(" + ") }
}
