//! How far the numbers of a population's fit may be from those that are true: by which drops were measured, and by what the method itself is
//! off.

use nalgebra::DVector;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::LANDING_TILT;
use super::fit_step::{FitStep, SLOPES};
use super::fitting::{LandingFit, LandingProblem};
use super::foot_mode::FOOT_MODE;
use super::legged_body::{COULOMB_FRICTION, Legs, Slopes};
use super::parameter::{Parameter, ParameterKind};
use super::sensor_mount::MOUNT_LOW_PASS;
use super::touched_slopes::{SlopeNumber, TouchLikelihood};
use crate::impact::diagnose::EffectEstimate;
use crate::impact::measured::Spread;

/// Resampled sets of drops.
const RESAMPLED: usize = 400;

/// Changes of a fit's numbers, on its scale, with drops that are drawn with replacement.
#[derive(Clone, Debug)]
pub struct FitUncertainty {
    changes: Vec<DVector<f64>>,
}

impl FitUncertainty {
    /// By one step of the fit for each set of drawn drops; `None` where the fit is degenerate.
    pub fn of(problem: &LandingProblem, fit: &LandingFit, seed: u64) -> Option<Self> {
        let (drops, touches) = (problem.drops_at_fit(fit)?, problem.touch_scores(fit)?);
        let step = FitStep::of(&fit.at_bound, &drops.jacobian, &touches)?;
        let mut rng = Pcg64::seed_from_u64(seed);
        let drawn = |_| step.by(&change_by_drawing(problem, &drops.residual, &mut rng));
        Some(Self { changes: (0..RESAMPLED).map(drawn).collect() })
    }

    /// The parameters with 95 % intervals.
    ///
    /// A number of the slopes that is zero has the interval that the touch times allow, and the other one reaches as far down as they allow beside it: what
    /// turns on the way is hardly told from what sloped at release. Wrong where the fit is far from linear within the interval, or a height has few drops.
    pub fn estimates(&self, problem: &LandingProblem, fit: &LandingFit) -> Option<Vec<EffectEstimate>> {
        let parameters = problem.parameters();
        let first_slope = parameters.len() - SLOPES;
        let mut estimates = Vec::with_capacity(parameters.len());
        for (at, parameter) in parameters.into_iter().enumerate() {
            let effect = match parameter.kind {
                ParameterKind::Friction => COULOMB_FRICTION,
                ParameterKind::Feet => FOOT_MODE,
                ParameterKind::Mount => MOUNT_LOW_PASS,
                ParameterKind::Leg | ParameterKind::Slope => LANDING_TILT,
            };
            let (scaled, value) = (fit.scaled[at], parameter.outward(fit.scaled[at]));
            let spread = Spread::middle(self.changes.iter().map(|change| change[at]), 0.95).unwrap_or([0.0; 2]);
            let [mut low, mut high] = Parameter::with_method(spread, parameter.method_at(scaled, problem.parts.rubbing))
                .map(|change| parameter.outward(scaled + change).clamp(parameter.bounds[0], parameter.bounds[1]));
            if parameter.kind == ParameterKind::Slope && fit.slopes.has_none() {
                let (tables, number) = (problem.tables(&fit.legs, &fit.slopes)?, SlopeNumber::ALL[at - first_slope]);
                let likelihood = TouchLikelihood::of(&problem.heights(), &tables)?;
                [low, high] = if value == 0.0 { [low, likelihood.most(number)] } else { [low.min(likelihood.least(number, value)), high] };
            }
            // Slopes may well be none.
            let at_bound = fit.at_bound[at] && (parameter.kind != ParameterKind::Slope || value > 0.5 * parameter.bounds[1]);
            estimates.push(EffectEstimate { effect, key: parameter.key, unit: parameter.unit, value, ci95: [low, high], at_bound });
        }
        Some(estimates)
    }

    /// Legs and slopes that may be the true ones: a number of them, as frequent as they are likely. Beside slopes at release that may be the true ones
    /// landings turn less on the way. `None` where a landing is lost.
    pub fn drawn(&self, problem: &LandingProblem, fit: &LandingFit, count: usize, seed: u64) -> Option<Vec<(Legs, Slopes)>> {
        let mut rng = Pcg64::new(u128::from(seed), 3);
        let beside = if fit.slopes.at_release_rad == 0.0 { problem.likely_slopes(fit)? } else { Vec::new() };
        let mut chosen = Pcg64::new(u128::from(seed), 5);
        let beside_release = |(legs, slopes): (Legs, Slopes)| (legs, released(&beside, slopes, &mut chosen));
        let (parameters, bounds) = (problem.parameters(), problem.bounds());
        let one = |change: &DVector<f64>| {
            let number = |(at, scaled): (usize, &f64)| {
                let normal: f64 = StandardNormal.sample(&mut rng);
                let off = parameters[at].method_at(*scaled, problem.parts.rubbing) * normal;
                (scaled + change[at] + off).clamp(bounds[at][0], bounds[at][1])
            };
            problem.meaning(&fit.scaled.iter().enumerate().map(number).collect::<Vec<f64>>())
        };
        Some(self.changes.iter().take(count).map(one).map(beside_release).collect())
    }
}

/// Slopes with a slope at release that is drawn as it is likely, and a turning rate that is less by as much as the likeliest one beside it is.
fn released(beside: &[(Slopes, f64)], slopes: Slopes, rng: &mut Pcg64) -> Slopes {
    let Some((none, _)) = beside.first().filter(|(none, _)| none.rate_rad_s > 0.0) else { return slopes };
    let all: f64 = beside.iter().map(|(_, weight)| weight).sum();
    let mut left = rng.random_range(0.0..all);
    let place = beside.iter().position(|(_, weight)| {
        left -= weight;
        left <= 0.0
    });
    let (drawn, _) = beside[place.unwrap_or(0)];
    let share = drawn.rate_rad_s / none.rate_rad_s;
    Slopes { rate_rad_s: share * slopes.rate_rad_s, at_release_rad: drawn.at_release_rad }
}

/// How what is left of the drops, and how often each drop's touch times count, changes when drops are drawn with replacement.
fn change_by_drawing(problem: &LandingProblem, left: &DVector<f64>, rng: &mut Pcg64) -> DVector<f64> {
    let samples = problem.waves.expected.samples;
    let mut weights = Vec::new();
    for here in problem.heights() {
        let mut times = vec![-1.0; here.drops.len()];
        (0..here.drops.len()).for_each(|_| times[rng.random_range(0..here.drops.len())] += 1.0);
        weights.extend(times);
    }
    let drops = left.iter().enumerate().map(|(row, left)| weights[row / samples] * left);
    DVector::from_iterator(left.len() + weights.len(), drops.chain(weights.iter().copied()))
}
