//! Stiffness, damping, inertia and the spread of slopes, from drops.
//!
//! Each is fitted to what tells it, in turn: the spread of slopes to the touch times ([`TouchLikelihood`]), the legs to single drops, each with
//! the landing that its own touch times show. Mean waves are predicted, not fitted. They depend on the few steepest landings: legs that were
//! fitted to the means of forty records a height came out a third off, where single drops give them within a twentieth.
//!
//! *When it is wrong:* legs that are not alike, or whose springs and dampers are not linear; slopes at release so small that the touch times
//! do not pay for them count as turning.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::descent::Descent;
use super::drop_weights::DropWeights;
use super::fit_step::SLOPES;
use super::foot_mode::FootMode;
use super::kept_tables::{KeptTables, TableKey};
use super::legged_body::{LeggedBody, Legs, Slopes};
use super::observed::{HeightLandings, ObservedLanding, ObservedLandings};
use super::parameter::{LEGS, PARAMETERS, Parameter, ParameterKind};
use super::population::Population;
use super::posterior::window_given_touches;
use super::sensor_mount::SensorMount;
use super::table::LandingTable;
use super::touched_slopes::TouchLikelihood;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Minimum, at_bounds, minimise, minimise_until};

/// Most steps of the legs' fit.
const MOST_STEPS: usize = 25;
/// Most turns in which slopes and legs are fitted.
pub const MOST_TURNS: usize = 5;
/// Fall of the sum of squares below which a step is the last: far below the price of a parameter, which decides among fits.
const SETTLED_SUM: f64 = 1e-3;
/// The same of fits from several begins, of which one goes on.
pub const ROUGH_SUM: f64 = 0.5;
/// A turn that moves the legs by less, in steps of difference quotients, is the last.
const SETTLED: f64 = 0.5;

/// What a model of landings has beside legs of a spring and a damper, and slopes that grow while they fall.
#[derive(Clone, Copy, Debug, Default)]
pub struct ModelParts {
    /// Whether the legs have dry friction.
    pub rubbing: bool,
    /// Whether the feet have mass of their own.
    pub heavy_feet: bool,
    /// Whether the sensor has a mount that gives way.
    pub mounted: bool,
    /// Whether landings may slope at release, not only by turning while they fall.
    pub at_release: bool,
}

/// What is compared with what.
#[derive(Clone, Debug)]
pub struct LandingProblem<'a> {
    /// What lands.
    pub body: LeggedBody,
    /// Fall and sensor.
    pub model: &'a Model,
    /// Mean waves with their covariance.
    pub waves: &'a FitProblem,
    /// Touches, the same heights.
    pub observed: &'a ObservedLandings,
    /// What it has beside legs and turning slopes.
    pub parts: ModelParts,
    /// Landings that were simulated, of this body and model.
    pub(super) kept: Arc<KeptTables>,
    /// What the readings of drops weigh.
    pub(super) weights: Arc<DropWeights>,
}

/// A fit.
#[derive(Clone, Debug)]
pub struct LandingFit {
    /// The legs.
    pub legs: Legs,
    /// The slopes.
    pub slopes: Slopes,
    /// On the scale of the fit.
    pub(super) scaled: Vec<f64>,
    /// Which of them ended at a bound.
    pub(super) at_bound: Vec<bool>,
    /// Sum of squares of what it leaves of the drops, weighed.
    pub(super) sum: f64,
}

impl<'a> LandingProblem<'a> {
    /// Landings on legs of a spring and a damper, of which nothing else is asked.
    pub fn plain(body: LeggedBody, model: &'a Model, waves: &'a FitProblem, observed: &'a ObservedLandings) -> Self {
        let weights = Arc::new(DropWeights::alike(waves));
        Self { body, model, waves, observed, parts: ModelParts::default(), kept: Arc::default(), weights }
    }
}

impl LandingProblem<'_> {
    /// What numbers on the scale of the fit mean.
    pub fn meaning(&self, scaled: &[f64]) -> (Legs, Slopes) {
        let values: Vec<f64> = self.parameters().iter().zip(scaled).map(|(parameter, scaled)| parameter.outward(*scaled)).collect();
        let (legs, slopes) = values.split_at(values.len() - SLOPES);
        let (own, more) = legs.split_at(LEGS);
        let (friction, more) = more.split_at(usize::from(self.parts.rubbing));
        let (feet, mount) = more.split_at(if self.parts.heavy_feet { 3 } else { 0 });
        let legs = Legs {
            stiffness_n_m: own[0],
            damping_n_s_m: own[1],
            inertia_kg_m2: own[2],
            friction_n: friction.first().copied().unwrap_or(0.0),
            feet: if let [share, f_hz, zeta] = *feet { Some(FootMode { share, f_hz, zeta }) } else { None },
            mount: if let [f_hz, zeta] = *mount { Some(SensorMount { f_hz, zeta }) } else { None },
        };
        (legs, Slopes { rate_rad_s: slopes[0], at_release_rad: slopes[1] })
    }

    /// What is fitted, in its order.
    pub fn parameters(&self) -> Vec<&'static Parameter> {
        let fitted = |parameter: &&Parameter| match parameter.kind {
            ParameterKind::Friction => self.parts.rubbing,
            ParameterKind::Feet => self.parts.heavy_feet,
            ParameterKind::Mount => self.parts.mounted,
            ParameterKind::Leg | ParameterKind::Slope => true,
        };
        PARAMETERS.iter().filter(fitted).collect()
    }

    /// Bounds on the scale of the fit.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.parameters().iter().map(|parameter| parameter.bounds.map(|bound| parameter.inward(bound))).collect()
    }

    fn steps(&self) -> Vec<f64> {
        self.parameters().iter().map(|parameter| parameter.step).collect()
    }

    /// The landings of the chosen heights, of a population whose slopes spread so.
    pub fn tables(&self, legs: &Legs, slopes: &Slopes) -> Option<Arc<Vec<LandingTable>>> {
        let expected = &self.waves.expected;
        let heights_m: Vec<f64> = self.waves.chosen.iter().map(|height| self.waves.means[*height].height_m).collect();
        let descents = heights_m.iter().map(|height_m| Descent::of(self.model, slopes, *height_m)).collect();
        let key = TableKey { legs: *legs, descents, expected: expected.clone() };
        let table = |height_m: f64| LandingTable::of(&self.body, legs, slopes, self.model, expected, height_m);
        self.kept.of(key, || heights_m.into_iter().map(table).collect())
    }

    /// The same with other parts.
    #[must_use]
    pub fn with(&self, parts: ModelParts) -> Self {
        Self { parts, ..self.clone() }
    }

    /// The same with drops' readings weighed by what a fit leaves of them; `None` where a landing is lost.
    pub fn weighed_by(&self, fit: &LandingFit) -> Option<Self> {
        let tables = self.tables(&fit.legs, &fit.slopes)?;
        let chosen = self.waves.chosen.iter().zip(tables.iter());
        let left = chosen.map(|(height, table)| (*height, self.left_by_drops(*height, &Population::of(table, &fit.slopes))));
        let weights = DropWeights::of(self.waves, &left.collect::<Vec<_>>())?;
        Some(Self { weights: Arc::new(weights), ..self.clone() })
    }

    /// The same, and the fit that goes on from there.
    pub fn weighed_again(&self, fit: &LandingFit) -> Option<(Self, LandingFit)> {
        let weighed = self.weighed_by(fit)?;
        let fit = weighed.fitted(Some(fit))?;
        Some((weighed, fit))
    }

    /// The same at some heights alone.
    #[must_use]
    pub fn at<'b>(&'b self, waves: &'b FitProblem) -> LandingProblem<'b> {
        LandingProblem { waves, ..self.clone() }
    }

    /// The chosen heights' drops.
    pub fn heights(&self) -> Vec<&HeightLandings> {
        self.waves.chosen.iter().map(|height| &self.observed.heights[*height]).collect()
    }

    /// Mean windows of the chosen heights, one below the other, g.
    pub fn mean_windows(&self, legs: &Legs, slopes: &Slopes) -> Option<DVector<f64>> {
        let tables = self.tables(legs, slopes)?;
        let parts: Vec<f64> =
            tables.iter().flat_map(|table| Population::of(table, slopes).mean_window().iter().copied().collect::<Vec<_>>()).collect();
        Some(DVector::from_vec(parts))
    }

    /// Fits a population, from another fit's end where there is one.
    pub fn fitted(&self, from: Option<&LandingFit>) -> Option<LandingFit> {
        let plain = || self.parameters().iter().map(|parameter| parameter.inward(parameter.start)).collect();
        self.fitted_from(from.map_or_else(plain, |fit: &LandingFit| fit.scaled.clone()), MOST_TURNS, SETTLED_SUM)
    }

    /// A population that was not fitted, as the end of a fit: tests compare what is known with what is found.
    pub fn ended_at(&self, legs: Legs, slopes: Slopes) -> LandingFit {
        let mount = legs.mount.iter().flat_map(|mount| [mount.f_hz, mount.zeta]);
        let of_legs = [legs.stiffness_n_m, legs.damping_n_s_m, legs.inertia_kg_m2].into_iter();
        let feet = legs.feet.iter().flat_map(|feet| [feet.share, feet.f_hz, feet.zeta]);
        let values = of_legs
            .chain(self.parts.rubbing.then_some(legs.friction_n))
            .chain(feet)
            .chain(mount)
            .chain([slopes.rate_rad_s, slopes.at_release_rad]);
        let scaled: Vec<f64> = self.parameters().iter().zip(values).map(|(parameter, value)| parameter.inward(value)).collect();
        let at_bound = at_bounds(&scaled, &self.bounds());
        LandingFit { legs, slopes, scaled, at_bound, sum: f64::NAN }
    }

    /// Slopes and legs in turn, until the legs stay; in a turn until a step lowers the sum of squares by less than `enough`.
    pub(super) fn fitted_from(&self, mut scaled: Vec<f64>, most_turns: usize, enough: f64) -> Option<LandingFit> {
        let (bounds, steps) = (self.bounds(), self.steps());
        let legs = bounds.len() - SLOPES;
        let mut best = None;
        for _ in 0..most_turns {
            scaled = self.with_touched_slopes(&scaled)?;
            let slopes = scaled[legs..].to_vec();
            let left = |moved: &[f64]| self.left_of_drops(&[moved, &slopes].concat());
            let found = minimise_until(enough, left, &scaled[..legs], &bounds[..legs], &steps[..legs], MOST_STEPS)?;
            let moved = found.at.iter().zip(&scaled).zip(&steps).map(|((to, from), step)| ((to - from) / step).abs()).fold(0.0, f64::max);
            scaled[..legs].copy_from_slice(&found.at);
            best = Some(found);
            if moved < SETTLED {
                break;
            }
        }
        let Minimum { sum, .. } = best?;
        let scaled = self.with_touched_slopes(&scaled)?;
        let (legs, slopes) = self.meaning(&scaled);
        let at_bound = at_bounds(&scaled, &bounds);
        Some(LandingFit { legs, slopes, scaled, at_bound, sum })
    }

    /// The same legs with the slopes that the touch times show.
    fn with_touched_slopes(&self, scaled: &[f64]) -> Option<Vec<f64>> {
        let (legs, slopes) = self.meaning(scaled);
        let tables = self.tables(&legs, &slopes)?;
        let Slopes { rate_rad_s, at_release_rad } = TouchLikelihood::of(&self.heights(), &tables)?.slopes(self.parts.at_release).slopes;
        Some([&scaled[..scaled.len() - SLOPES], &[rate_rad_s, at_release_rad]].concat())
    }

    /// Slopes that may be those of a fit's drops, and how likely they are: beside each slope at release the likeliest turning rate. What a height has that no fit
    /// saw is the mean over all of them; where nothing is known of slopes at release the likeliest population has none, the steepest of all landings from
    /// higher up. `None` where a landing is lost.
    pub fn likely_slopes(&self, fit: &LandingFit) -> Option<Vec<(Slopes, f64)>> {
        if fit.slopes.at_release_rad > 0.0 {
            return Some(vec![(fit.slopes, 1.0)]);
        }
        let tables = self.tables(&fit.legs, &fit.slopes)?;
        Some(TouchLikelihood::of(&self.heights(), &tables)?.beside_slopes_at_release())
    }

    /// What the predictions from their touches leave of all drops, one below the other, weighed.
    fn left_of_drops(&self, scaled: &[f64]) -> Option<DVector<f64>> {
        let (legs, slopes) = self.meaning(scaled);
        let tables = self.tables(&legs, &slopes)?;
        let mut all = Vec::new();
        for (height, table) in self.waves.chosen.iter().zip(tables.iter()) {
            let left = self.left_by_drops(*height, &Population::of(table, &slopes));
            all.extend(left.iter().flat_map(|left| self.weights.weighed(*height, left).as_slice().to_vec()));
        }
        Some(DVector::from_vec(all))
    }

    /// What the prediction from their touches leaves of the drops of a height, g.
    pub fn left_by_drops(&self, height: usize, population: &Population) -> Vec<DVector<f64>> {
        let height = &self.observed.heights[height];
        let expected = |drop: &ObservedLanding| window_given_touches(population, &drop.touches, height.read_s());
        height.drops.par_iter().map(|drop| DVector::from_column_slice(&drop.window) - expected(drop)).collect()
    }

    /// Change of the predicted mean windows, g, with each parameter on the scale of the fit.
    pub fn sensitivity(&self, fit: &LandingFit) -> Option<DMatrix<f64>> {
        let mean_windows = |scaled: &[f64]| {
            let (legs, slopes) = self.meaning(scaled);
            Some(-self.mean_windows(&legs, &slopes)?)
        };
        Some(self.looked_at(mean_windows, fit)?.jacobian)
    }

    /// A residual and its difference quotients at a fit.
    fn looked_at(&self, residual: impl Fn(&[f64]) -> Option<DVector<f64>>, fit: &LandingFit) -> Option<Minimum> {
        minimise(residual, &fit.scaled, &self.bounds(), &self.steps(), 0)
    }

    /// What the predictions from their touches leave of all drops, and how it changes with each parameter, at a fit.
    pub fn drops_at_fit(&self, fit: &LandingFit) -> Option<Minimum> {
        self.looked_at(|scaled| self.left_of_drops(scaled), fit)
    }

    /// How the logarithm of the likelihood of each drop's touch times changes with each parameter, on the scale of the fit.
    pub fn touch_scores(&self, fit: &LandingFit) -> Option<DMatrix<f64>> {
        let unlikely = |scaled: &[f64]| {
            let (legs, slopes) = self.meaning(scaled);
            Some(-TouchLikelihood::of(&self.heights(), &self.tables(&legs, &slopes)?)?.of_drops(&slopes))
        };
        Some(self.looked_at(unlikely, fit)?.jacobian)
    }
}
