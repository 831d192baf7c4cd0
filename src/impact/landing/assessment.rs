//! The effect `landing_tilt`, put to the tests that a named effect has to pass.

use nalgebra::DMatrix;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::LANDING_TILT;
use super::covariate::{Covariate, CovariateEffect};
use super::evidence::TouchEvidence;
use super::fitting::{LandingFit, LandingProblem};
use super::gaps::{LandingGaps, held_out_gaps, left_out_gaps};
use super::gate::Gate;
use super::landing_scatter::LandingScatter;
use super::legged_body::LeggedBody;
use super::observed::{HeightLandings, ObservedLandings};
use super::population::Population;
use super::posterior::given_touches;
use super::table::LandingTable;
use crate::impact::diagnose::{Diagnosis, EffectEstimate, LinearisedFit, PreparedDrops, RARE, UNSTEADY, Verdict, joined, judge};
use crate::impact::effects::Model;
use crate::impact::fit::Waves;

/// A height with the spread of slopes that its touch times show.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct SlopesAtHeight {
    /// Height, m.
    pub height_m: f64,
    /// Median time to the opposite foot, measured, s.
    pub opposite_s: f64,
    /// The same of the fitted population, s.
    pub predicted_s: f64,
    /// Standard error of the measured one, s.
    pub error_s: f64,
}

/// Everything that was found.
#[derive(Clone, Debug)]
pub struct LandingAssessment {
    /// What the touch times show without a model.
    pub evidence: TouchEvidence,
    /// The population.
    pub fit: LandingFit,
    /// Its parameters.
    pub estimates: Vec<EffectEstimate>,
    /// The legs, fitted to single drops with their touches.
    pub by_drops: LandingFit,
    /// The spread of slopes height by height.
    pub heights: Vec<SlopesAtHeight>,
    /// Gaps.
    pub gaps: LandingGaps,
    /// p-value of what the population leaves of the mean waves.
    pub lack_of_fit_p: f64,
    /// What explains the variation between drops.
    pub covariates: Vec<CovariateEffect>,
    /// The tests.
    pub gates: Vec<Gate>,
    /// Mean windows: height, measured, predicted by the population, g.
    pub windows: Vec<(f64, Vec<f64>, Vec<f64>)>,
    /// Time between their samples, s.
    pub step_s: f64,
    /// Delays of the opposite foot and of those beside of every drop whose feet were all seen, s, by height, m.
    pub touches: Vec<(f64, Vec<[f64; 3]>)>,
    /// Whether it is the verdict.
    decides: bool,
}

/// What is judged.
pub struct LandingEvidence<'a> {
    /// The drops that were fitted.
    pub fitted: &'a Waves,
    /// Drops of heights that no fit sees.
    pub held_out: Option<&'a Waves>,
    /// Touches of all of them.
    pub observed: &'a ObservedLandings,
    /// The base model: body, fall and sensor.
    pub model: &'a Model,
    /// What the diagnosis of the vertical found.
    pub diagnosis: &'a Diagnosis,
    /// Of everything that is drawn.
    pub seed: u64,
}

impl LandingAssessment {
    /// Judges; `None` where no fit is possible.
    pub fn of(evidence: &LandingEvidence) -> Option<Self> {
        let heights_of = |waves: &Waves| {
            let same = |height_m: f64| waves.groups.iter().any(|group| group.height_m == height_m);
            evidence.observed.only(same)
        };
        let fitted_touches = heights_of(evidence.fitted);
        let prepared = PreparedDrops::of(evidence.fitted, evidence.model)?;
        let level = LandingProblem {
            body: LeggedBody::of(evidence.model),
            model: evidence.model,
            waves: &prepared.problem,
            observed: &fitted_touches,
        };
        let first = level.fitted(None)?;
        let scatter = LandingScatter::of(evidence.fitted, &level, &first)?;
        let waves = scatter.problem(&prepared.problem);
        let problem = level.at(&waves);
        let fit = problem.fitted(Some(&first))?;
        let by_drops = problem.fitted_to_drops(&fit, None)?;
        let predicted = problem.mean_windows(&fit.legs, &fit.slopes)?;
        let touched = TouchEvidence::of(evidence.observed, evidence.seed);
        let jacobian = problem.sensitivity(&fit)?;
        let seen = LinearisedFit { effects: DMatrix::zeros(jacobian.nrows(), 0), jacobian, samples: prepared.problem.expected.samples };
        let bootstrap = scatter.bootstrap(&problem, &fit, evidence.seed)?;
        let lack_of_fit_p = judge(&(prepared.problem.measured() - &predicted), &seen, &bootstrap)?.p;
        let held = evidence.held_out.map(|waves| (waves, heights_of(waves)));
        let gaps = match &held {
            Some((waves, touches)) => held_out_gaps(&problem, evidence.fitted, &fit, &by_drops, waves, touches, evidence.seed)?,
            None => left_out_gaps(&problem, evidence.fitted, &fit, &by_drops, evidence.seed)?,
        };
        let estimates = problem.estimates(&fit, evidence.seed)?;
        let tables = problem.tables(&by_drops.legs)?;
        let covariates = covariates(&fitted_touches, &tables, &fit, evidence.seed);
        let heights = slopes_by_height(&fitted_touches, &problem.tables(&fit.legs)?, &fit)?;
        let samples = prepared.problem.expected.samples;
        let windows = evidence
            .fitted
            .groups
            .iter()
            .enumerate()
            .map(|(at, group)| (group.height_m, group.mean.clone(), predicted.as_slice()[at * samples..(at + 1) * samples].to_vec()));
        let windows = windows.collect();
        let touches =
            evidence.observed.heights.iter().map(|height| (height.height_m, height.seen().map(|drop| drop.touches.delays_s()).collect()));
        let mut all = Self {
            evidence: touched,
            fit,
            estimates,
            by_drops,
            heights,
            gaps,
            lack_of_fit_p,
            covariates,
            gates: Vec::new(),
            windows,
            step_s: evidence.fitted.step_s,
            touches: touches.collect(),
            decides: false,
        };
        all.gates = all.gates(evidence.diagnosis);
        all.decides = all.named() && matches!(evidence.diagnosis.verdict, Verdict::NoneSuffices | Verdict::Ambiguous);
        Some(all)
    }

    /// Whether every test was passed.
    pub fn named(&self) -> bool {
        self.gates.iter().all(|gate| gate.passed)
    }

    /// Whether it is what the drops miss: every test was passed, and no effect along the vertical is named.
    pub fn decides(&self) -> bool {
        self.decides
    }

    /// What the diagnosis says with this beside the effects along the vertical: verdict and reasons.
    pub fn verdict(&self, diagnosis: &Diagnosis) -> (Verdict, Vec<String>) {
        let mut reasons = diagnosis.reasons.clone();
        if self.decides {
            reasons = self.gates.iter().map(|gate| format!("{LANDING_TILT}: {}", gate.found)).collect();
            return (Verdict::Named, reasons);
        }
        if self.evidence.feet_in_one_plane() {
            reasons.push(format!("{LANDING_TILT}: {}", self.gates[0].found));
            let failed = self.gates.iter().filter(|gate| !gate.passed);
            reasons.extend(failed.map(|gate| format!("{LANDING_TILT} is not named by the test `{}`: {}", gate.id, gate.found)));
        }
        (diagnosis.verdict, reasons)
    }

    fn gates(&self, diagnosis: &Diagnosis) -> Vec<Gate> {
        let (touched, gaps) = (&self.evidence, &self.gaps);
        let (base, best) = (diagnosis.before.held_out.net_g, diagnosis.after.held_out.net_g);
        let steady_p = self.steady_p();
        let at_bound: Vec<&str> = self.estimates.iter().filter(|estimate| estimate.at_bound).map(|estimate| estimate.key).collect();
        let gate = |id: &'static str, passed: bool, found: String| Gate { id, passed, found };
        vec![
            gate(
                "touches",
                touched.feet_in_one_plane(),
                format!(
                    "{} of {} drops show the touch of each foot; the first lies along a diagonal in {:.0} % (p = {:.1e}), and the times are \
                     those of feet in one plane within {:.2} ms, permuted {:.2} ms (p = {:.3})",
                    touched.seen,
                    touched.drops,
                    1e2 * touched.along_diagonals,
                    touched.along_diagonals_p,
                    1e3 * touched.deviation_s,
                    1e3 * touched.permuted_deviation_s,
                    touched.plane_p
                ),
            ),
            gate(
                "held_out",
                gaps.held_out.net_g < base.min(best),
                format!(
                    "the gap to heights that no fit saw is {:.2} g with random slopes, {base:.2} g without, {best:.2} g with {} instead",
                    gaps.held_out.net_g,
                    joined(&diagnosis.chosen)
                ),
            ),
            gate(
                "drops",
                gaps.dealt_p <= RARE && gaps.given_touches.records_g < gaps.held_out.template_g,
                format!(
                    "single drops are predicted from their touches within {:.1} g, {:.1} g by the mean of their own height, {:.1} g with \
                     touches of other drops (p = {:.3})",
                    gaps.given_touches.records_g, gaps.held_out.template_g, gaps.dealt_g, gaps.dealt_p
                ),
            ),
            gate(
                "constant",
                steady_p >= UNSTEADY,
                format!("one turning rate for all heights leaves the touch times within their errors (p = {steady_p:.1e})"),
            ),
            gate(
                "plausible",
                at_bound.is_empty(),
                if at_bound.is_empty() {
                    "no parameter ended at its bound".into()
                } else {
                    format!("{} ended at its bound", at_bound.join(", "))
                },
            ),
            gate(
                "enough",
                self.lack_of_fit_p >= RARE,
                format!("what it leaves of the mean waves has p = {:.3} under trial variation", self.lack_of_fit_p),
            ),
        ]
    }

    /// p-value of the median touch times by height under one pair of numbers for the slopes.
    fn steady_p(&self) -> f64 {
        let sum: f64 = self.heights.iter().map(|height| ((height.opposite_s - height.predicted_s) / height.error_s).powi(2)).sum();
        let freedom = (self.heights.len() as f64 - 1.0).max(1.0);
        ChiSquared::new(freedom).map_or(1.0, |law| law.sf(sum))
    }
}

fn slopes_by_height(observed: &ObservedLandings, tables: &[LandingTable], fit: &LandingFit) -> Option<Vec<SlopesAtHeight>> {
    let one = |(height, table): (&HeightLandings, &LandingTable)| {
        let [_, (opposite_s, error_s), _] = height.opposite_quartiles_s()?;
        let predicted_s = Population::of(table, &fit.slopes).opposite_delay_s(0.5);
        Some(SlopesAtHeight { height_m: height.height_m, opposite_s, predicted_s, error_s })
    };
    observed.heights.iter().zip(tables).map(one).collect()
}

/// Touch times, slope and order of the drops.
fn covariates(observed: &ObservedLandings, tables: &[LandingTable], fit: &LandingFit, seed: u64) -> Vec<CovariateEffect> {
    let windows: Vec<Vec<&[f64]>> =
        observed.heights.iter().map(|height| height.drops.iter().map(|drop| &drop.window[..]).collect()).collect();
    let times = observed.heights.iter().map(|height| height.drops.iter().map(|drop| drop.touches.delays_s().to_vec()).collect()).collect();
    let slope = |(height, table): (&HeightLandings, &LandingTable)| {
        let population = Population::of(table, &fit.slopes);
        height.drops.iter().map(|drop| vec![given_touches(table, &population, &drop.touches).slope_rad]).collect()
    };
    let slopes = observed.heights.iter().zip(tables).map(slope).collect();
    let order = observed.heights.iter().map(|height| (0..height.drops.len()).map(|at| vec![at as f64]).collect()).collect();
    [("leg_times", times), ("landing_slope", slopes), ("trial", order)]
        .into_iter()
        .map(|(id, values)| Covariate { id: id.into(), values }.explains(&windows, seed))
        .collect()
}
