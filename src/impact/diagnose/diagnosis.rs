//! From measured drops to a verdict with its reasons.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::adequacy::Adequacy;
use super::bootstrap::Bootstrap;
use super::candidate::Candidate;
use super::clipping::Clipping;
use super::constancy::{Constancy, constancy};
use super::experiment::{Experiment, experiments};
use super::gap::{Gap, gap, left_out_heights, left_out_trials};
use super::observable::{Observable, observables};
use super::prepared_drops::PreparedDrops;
use super::residual_force::{ForceCell, residual_force};
use super::residual_map::{Point, ResidualMap, points, residual_map};
use super::search::{RARE, Search, SearchContext};
use super::stage::Stage;
use super::trend::trend_p;
use crate::impact::effects::{CATALOGUE, Model, Spec, candidates};
use crate::impact::fit::{FitProblem, Waves, inverse};

/// What was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// One set of effects is supported, and enough.
    Named,
    /// Several sets are enough, and the drops cannot distinguish them.
    Ambiguous,
    /// No set of effects explains the drops.
    NoneSuffices,
    /// The base model explains the drops.
    NothingMissing,
}

impl Verdict {
    /// As in files.
    pub fn id(self) -> &'static str {
        match self {
            Self::Named => "named",
            Self::Ambiguous => "ambiguous",
            Self::NoneSuffices => "none_suffices",
            Self::NothingMissing => "nothing_missing",
        }
    }
}

/// A parameter with its interval.
#[derive(Clone, Debug, serde::Serialize)]
pub struct EffectEstimate {
    /// Effect's id.
    #[serde(skip)]
    pub effect: &'static str,
    /// Key.
    #[serde(skip)]
    pub key: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Value.
    pub value: f64,
    /// Calibrated 95 % interval.
    pub ci95: [f64; 2],
    /// Whether it lies at a bound.
    pub at_bound: bool,
}

/// A set of effects with the weight that the drops give it.
#[derive(Clone, Debug)]
pub struct Alternative {
    /// The set.
    pub candidate: Candidate,
    /// Its weight among the sets of its size, 0 to 1.
    pub weight: f64,
}

/// A candidate that was looked at.
#[derive(Clone, Debug)]
pub struct Ranked {
    /// Ids, joined by ` + `.
    pub id: String,
    /// Sum of squares and price of the parameters; lower is better.
    pub score: f64,
    /// Gap at each height when fitted to the others, g.
    pub left_out_g: Option<f64>,
    /// Parameters by height, where that was looked at.
    pub constancy: Option<Constancy>,
    /// Why it was not chosen.
    pub reason_rejected: Option<String>,
}

/// Gaps of a model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gaps {
    /// At the fitted heights.
    pub fitted: Gap,
    /// At the held-out heights, or at each height fitted to the others.
    pub held_out: Gap,
    /// To every second drop, fitted to the others.
    pub trials: Gap,
}

/// Everything that was found.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// The verdict.
    pub verdict: Verdict,
    /// Why, in a sentence or two.
    pub reasons: Vec<String>,
    /// The base model, refitted.
    pub base: Candidate,
    /// The best-supported model.
    pub chosen: Candidate,
    /// The model after, as a file of a model has it: the chosen one, or a level landing where landings that are not level decide.
    pub model_after: Model,
    /// Its effects, largest contribution first, with what each takes off the sum of squares.
    pub contributions: Vec<(&'static str, f64)>,
    /// Its parameters, spring and damper first.
    pub estimates: Vec<EffectEstimate>,
    /// Correlations of the estimates.
    pub correlations: DMatrix<f64>,
    /// Sets that are nearly as good.
    pub alternatives: Vec<Alternative>,
    /// All that was fitted.
    pub ranking: Vec<Ranked>,
    /// Of the base.
    pub before: Gaps,
    /// Of the chosen model.
    pub after: Gaps,
    /// Whether the held-out gaps are those of heights named for it.
    pub heights_held_out: bool,
    /// The residual of the base.
    pub residual_map: ResidualMap,
    /// Samples with the base's prediction.
    pub base_points: Vec<Point>,
    /// Samples with the chosen model's prediction.
    pub chosen_points: Vec<Point>,
    /// p-values of the base's residual.
    pub base_adequacy: Adequacy,
    /// p-values of the chosen model's residual.
    pub adequacy: Adequacy,
    /// p-value of the trend over trials.
    pub trend_p: f64,
    /// Observations without a model.
    pub observables: Vec<Observable>,
    /// Clipping of the readings.
    pub clipping: Option<Clipping>,
    /// The residual over displacement and speed, when no effect suffices.
    pub residual_force: Vec<ForceCell>,
    /// Most decisive first.
    pub experiments: Vec<Experiment>,
}

/// How to look.
#[derive(Clone, Copy, Debug)]
pub struct DiagnosisOptions {
    /// Most effects on top of the base.
    pub most_effects: usize,
    /// Of everything that is drawn.
    pub seed: u64,
    /// The effects that are tried on top of the base.
    pub catalogue: &'static [&'static Spec],
}

impl DiagnosisOptions {
    /// With every effect of the catalogue.
    pub fn new(most_effects: usize, seed: u64) -> Self {
        Self { most_effects, seed, catalogue: &CATALOGUE }
    }
}

/// Why there is no diagnosis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DiagnosisError {
    /// The simulation of the base model diverges at the start values, or the trial covariance is degenerate.
    #[error("the base model cannot be fitted to these drops: the fits diverge, or the readings do not vary between drops")]
    NoFit,
}

/// Clipping this near to the model's own limit is that limit, g.
const NEAR_LIMIT_G: f64 = 3.0;
/// Weight below which a set is not worth a mention.
const SLIGHT: f64 = 0.02;
/// Weight that a set needs for its name, by its number of effects.
const SUPPORT: [f64; 3] = [0.7, 0.7, 0.95];
/// p-value below which a trend over trials is significant.
const TREND: f64 = 0.002;
/// p-value below which parameters are not the same at all heights.
pub const UNSTEADY: f64 = 1e-4;
/// Sets whose parameters are looked at height by height.
const LOOKED_AT: usize = 6;

/// Diagnoses the drops of `fitted`; `held_out` are drops of heights that no fit sees.
///
/// # Errors
/// [`DiagnosisError`] when no fit is possible.
pub fn diagnose(fitted: &Waves, held_out: Option<&Waves>, model: &Model, settings: &DiagnosisOptions) -> Result<Diagnosis, DiagnosisError> {
    watched(fitted, held_out, model, settings, &|_| ())
}

/// The same; `stage` is called with each stage that begins.
///
/// # Errors
/// [`DiagnosisError`] when no fit is possible.
pub fn watched(
    fitted: &Waves,
    held_out: Option<&Waves>,
    model: &Model,
    settings: &DiagnosisOptions,
    stage: &(dyn Fn(Stage) + Sync),
) -> Result<Diagnosis, DiagnosisError> {
    run(fitted, held_out, model, settings, stage).ok_or(DiagnosisError::NoFit)
}

fn run(
    fitted: &Waves,
    held_out: Option<&Waves>,
    model: &Model,
    settings: &DiagnosisOptions,
    stage: &(dyn Fn(Stage) + Sync),
) -> Option<Diagnosis> {
    stage(Stage::TrialCovariance);
    let prepared = PreparedDrops::of(fitted, model)?;
    stage(Stage::Bootstrap);
    let bootstrap = Bootstrap::of(fitted, &prepared.trial_covariance, &prepared.covariance_model, settings.seed)?;
    let setting = SearchContext {
        problem: &prepared.problem,
        bootstrap: &bootstrap,
        limit_seen: limit_seen(&prepared, model),
        catalogue: settings.catalogue,
        most: settings.most_effects,
        stage,
    };
    let search = Search::run(&setting, model)?;
    stage(Stage::Acceptance);
    let found = accepted(&prepared, &setting, &search, fitted, held_out, model, settings)?;
    let again = judged_again(&found, &prepared, &setting, &search, (fitted, held_out), model, settings);
    Some(again.unwrap_or(found))
}

/// Whether readings clip below the model's own limit.
fn limit_seen(prepared: &PreparedDrops, model: &Model) -> bool {
    prepared.clipping.is_some_and(|flat| flat.level_g < model.sensor.limit_g - NEAR_LIMIT_G)
}

/// Where nothing is named, or several effects together: the diagnosis with other estimates of how drops vary. It counts where it explains
/// the drops, and with fewer effects than were named. `None` elsewhere.
fn judged_again(
    found: &Diagnosis,
    prepared: &PreparedDrops,
    setting: &SearchContext,
    search: &Search,
    (fitted, held_out): (&Waves, Option<&Waves>),
    model: &Model,
    settings: &DiagnosisOptions,
) -> Option<Diagnosis> {
    let is_open = matches!(found.verdict, Verdict::NoneSuffices | Verdict::Ambiguous);
    let with = |prepared: &PreparedDrops, bootstrap: &Bootstrap, most: usize| {
        let limit_seen = limit_seen(prepared, model);
        let setting =
            SearchContext { problem: &prepared.problem, bootstrap, limit_seen, catalogue: settings.catalogue, most, stage: &|_| () };
        let search = Search::run(&setting, model)?;
        let is_enough = search.levels.last()?.adequacy.p >= RARE;
        is_enough.then(|| accepted(prepared, &setting, &search, fitted, held_out, model, settings))?
    };
    let around_best_single = || {
        let best = search.levels.get(1).filter(|level| is_open && level.adequacy.p < RARE)?.candidates.first()?;
        let prepared = PreparedDrops::around(fitted, best.model())?;
        let bootstrap = Bootstrap::of(fitted, &prepared.trial_covariance, &prepared.covariance_model, settings.seed)?;
        let mut again = with(&prepared, &bootstrap, 1).filter(|again| again.verdict == Verdict::Named)?;
        again.reasons.push(format!(
            "how drops vary was estimated with the wave of {}: in units of how they vary around the wave of the base model, no set was named",
            joined(best)
        ));
        Some(again)
    };
    let alike = || {
        let fewer = found.chosen.ids().len().saturating_sub(1);
        let most = match found.verdict {
            Verdict::NoneSuffices | Verdict::Ambiguous => settings.most_effects,
            Verdict::Named if fewer > 0 => fewer,
            Verdict::Named | Verdict::NothingMissing => return None,
        };
        let best = search.levels.last()?.candidates.first()?;
        let prepared = prepared.alike()?;
        // One fit tells whether the search is worth its time.
        Candidate::best(&prepared.problem, [best.model().clone()]).filter(|alike| alike.score < best.score)?;
        let explained = |again: &Diagnosis| matches!(again.verdict, Verdict::Named | Verdict::NothingMissing);
        let mut again = with(&prepared, setting.bootstrap, most).filter(explained)?;
        again.reasons.push("the drops seem to differ in stiffness or damping, but are explained better where they do not".into());
        Some(again)
    };
    around_best_single().or_else(alike)
}

/// What a search found, put to the tests of acceptance.
fn accepted(
    prepared: &PreparedDrops,
    setting: &SearchContext,
    search: &Search,
    fitted: &Waves,
    held_out: Option<&Waves>,
    model: &Model,
    settings: &DiagnosisOptions,
) -> Option<Diagnosis> {
    let (problem, limit_seen) = (setting.problem, setting.limit_seen);
    let base = search.levels[0].candidates[0].clone();
    let trend = trend_p(fitted, &problem.sensitivity(&base.fitted)?, settings.seed)?;
    let nothing = search.levels[0].adequacy.p >= RARE && !limit_seen;
    let level = if nothing { &search.levels[0] } else { search.levels.last()? };
    let chosen = level.candidates[0].clone();
    let able: Vec<Candidate> = level.candidates.iter().filter(|one| nothing || setting.may_be(one)).cloned().collect();
    let alternatives = alternatives(&able);
    let ranking = ranking(setting, fitted, search, &chosen, nothing);
    let steady = constancy(problem, &chosen);
    let (verdict, reasons) = verdict(&Evidence {
        nothing,
        adequacy: &level.adequacy,
        chosen: &chosen,
        alternatives: &alternatives,
        steady: steady.as_ref(),
        trend,
        not_enough: search.not_enough.as_ref(),
    });
    let (estimates, correlations) = estimates(&chosen, &level.adequacy)?;
    let gaps = |candidate: &Candidate| gaps(problem, fitted, held_out, candidate);
    let (before, after) = (gaps(&base)?, gaps(&chosen)?);
    let (base_points, chosen_points) = (points(problem, fitted, base.model())?, points(problem, fitted, chosen.model())?);
    let larger = || search.levels.get(1).and_then(|level| level.candidates.first());
    let rival = alternatives.get(1).map(|alternative| &alternative.candidate).or_else(larger);
    let experiments = rival.map_or_else(Vec::new, |rival| experiments(problem, &prepared.trial_covariance, &chosen, rival));
    let residual_force = if verdict == Verdict::NoneSuffices { residual_force(&chosen_points, model.body.mass_kg) } else { Vec::new() };
    Some(Diagnosis {
        verdict,
        reasons,
        contributions: if nothing { Vec::new() } else { contributions(search, &chosen) },
        estimates,
        correlations,
        alternatives: alternatives.into_iter().filter(|alternative| alternative.weight >= SLIGHT).collect(),
        ranking,
        before,
        after,
        heights_held_out: held_out.is_some(),
        residual_map: residual_map(&base_points)?,
        base_points,
        chosen_points,
        base_adequacy: search.levels[0].adequacy.clone(),
        adequacy: level.adequacy.clone(),
        trend_p: trend,
        observables: observables(fitted, model),
        clipping: prepared.clipping,
        residual_force,
        experiments,
        base,
        model_after: chosen.model().clone(),
        chosen,
    })
}

/// The gaps of a candidate at the fitted heights, the held-out ones and between trials.
fn gaps(problem: &FitProblem, fitted: &Waves, held_out: Option<&Waves>, candidate: &Candidate) -> Option<Gaps> {
    Some(Gaps {
        fitted: gap(problem, fitted, candidate.model())?,
        held_out: match held_out {
            Some(waves) => gap(problem, waves, candidate.model())?,
            None if fitted.groups.len() > 1 => left_out_heights(problem, fitted, candidate)?,
            None => Gap::UNKNOWN,
        },
        trials: left_out_trials(problem, fitted, candidate)?,
    })
}

/// What a verdict rests on.
struct Evidence<'a> {
    nothing: bool,
    adequacy: &'a Adequacy,
    chosen: &'a Candidate,
    alternatives: &'a [Alternative],
    steady: Option<&'a Constancy>,
    trend: f64,
    not_enough: Option<&'a (Candidate, f64)>,
}

/// Verdict and reasons, that of the model's own effects among them.
fn verdict(evidence: &Evidence) -> (Verdict, Vec<String>) {
    let (verdict, mut reasons) = verdict_of_search(evidence);
    if let Some((given, p)) = evidence.not_enough {
        reasons.push(format!(
            "the model's own {} leaves more than trial variation (p = {p:.3}): effects were looked for on its spring, damper and sensor alone",
            joined(given)
        ));
    }
    (verdict, reasons)
}

/// The same of the search alone, whatever effects the model had.
fn verdict_of_search(evidence: &Evidence) -> (Verdict, Vec<String>) {
    let Evidence { nothing, adequacy, chosen, alternatives, steady, trend, .. } = evidence;
    let mut reasons = Vec::new();
    if *trend < TREND {
        reasons.push(format!(
            "the drops show a trend over trials (p = {trend:.3}), such as wear or loosening; no effect of the catalogue describes it"
        ));
    }
    if *nothing {
        let model = if chosen.ids().is_empty() { "the base model".into() } else { format!("the model with its own {}", joined(chosen)) };
        reasons.push(format!("the residual of {model} is within trial variation (p = {:.3})", adequacy.p));
        return (if *trend < TREND { Verdict::NoneSuffices } else { Verdict::NothingMissing }, reasons);
    }
    if adequacy.p < RARE {
        reasons.push(format!(
            "no set of effects explains the drops: the best, {}, leaves more than trial variation (p = {:.3})",
            joined(chosen),
            adequacy.p
        ));
    }
    if let Some(steady) = steady.filter(|steady| steady.p < UNSTEADY) {
        reasons.push(format!("the parameters of {} are not the same at all heights (p = {:.1e})", joined(chosen), steady.p));
    }
    for (free, _) in implausible(chosen) {
        reasons.push(format!("{free} ended at its bound"));
    }
    if !reasons.is_empty() {
        return (Verdict::NoneSuffices, reasons);
    }
    let weight = alternatives.first().map_or(0.0, |best| best.weight);
    let needed = SUPPORT[(chosen.ids().len().max(1) - 1).min(SUPPORT.len() - 1)];
    if weight < needed {
        let others: Vec<String> =
            alternatives.iter().skip(1).take(3).map(|other| format!("{} ({:.2})", joined(&other.candidate), other.weight)).collect();
        reasons.push(format!(
            "{} explains the drops, but other sets explain them nearly as well: weight {weight:.2}, {}",
            joined(chosen),
            others.join(", ")
        ));
        return (Verdict::Ambiguous, reasons);
    }
    reasons.push(format!(
        "{} explains the drops (p = {:.3}); no other set explains them as well (weight {weight:.2})",
        joined(chosen),
        adequacy.p
    ));
    (Verdict::Named, reasons)
}

/// Parameters on top of the base at a bound that is not their own 'off' nor the end of a physical range.
fn implausible(candidate: &Candidate) -> Vec<(String, usize)> {
    let free = candidate.fitted.layout.free.iter().zip(&candidate.fitted.minimum.at_bound).enumerate().skip(2);
    free.filter(|(_, (free, at_bound))| **at_bound && !free.has_physical_bounds())
        .map(|(i, (free, _))| (format!("{} of {}", free.key(), free.spec.id), i))
        .collect()
}

/// Ids with ` + ` between.
pub fn joined(candidate: &Candidate) -> String {
    let ids = candidate.ids();
    if ids.is_empty() { "the base model".into() } else { ids.join(" + ") }
}

fn alternatives(candidates: &[Candidate]) -> Vec<Alternative> {
    let best = candidates.first().map_or(0.0, |best| best.score);
    let each: Vec<f64> = candidates.iter().map(|candidate| libm::exp(0.5 * (best - candidate.score))).collect();
    let sum: f64 = each.iter().sum();
    candidates.iter().zip(each).map(|(candidate, weight)| Alternative { candidate: candidate.clone(), weight: weight / sum }).collect()
}

/// What each effect takes off: the sum of squares of the set without it, less that of the set.
fn contributions(search: &Search, chosen: &Candidate) -> Vec<(&'static str, f64)> {
    let ids = chosen.ids();
    let without = |out: &str| {
        let rest: Vec<&str> = ids.iter().copied().filter(|id| *id != out).collect();
        let known = search.levels.iter().flat_map(|level| &level.candidates).find(|candidate| candidate.ids() == rest);
        known.map_or(0.0, |known| known.fitted.chi2() - chosen.fitted.chi2())
    };
    let mut all: Vec<(&'static str, f64)> = ids.iter().map(|id| (*id, without(id))).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    all
}

fn estimates(chosen: &Candidate, adequacy: &Adequacy) -> Option<(Vec<EffectEstimate>, DMatrix<f64>)> {
    let minimum = &chosen.fitted.minimum;
    let covariance = inverse(&(minimum.jacobian.transpose() * &minimum.jacobian))?;
    let sd: Vec<f64> = covariance.diagonal().iter().map(|variance| variance.max(1e-300).sqrt()).collect();
    let correlations = DMatrix::from_fn(sd.len(), sd.len(), |i, j| covariance[(i, j)] / (sd[i] * sd[j]));
    let one = |(i, free): (usize, &crate::impact::fit::Free)| {
        let half = adequacy.ratio95.get(i).copied().unwrap_or(1.96) * sd[i];
        EffectEstimate {
            effect: free.spec.id,
            key: free.key(),
            unit: free.spec.parameters[free.at].unit,
            value: free.outward(minimum.at[i]),
            ci95: [free.outward(minimum.at[i] - half), free.outward(minimum.at[i] + half)],
            at_bound: minimum.at_bound[i],
        }
    };
    Some((chosen.fitted.layout.free.iter().enumerate().map(one).collect(), correlations))
}

fn ranking(setting: &SearchContext, waves: &Waves, search: &Search, chosen: &Candidate, nothing: bool) -> Vec<Ranked> {
    let problem = setting.problem;
    let looked_at: Vec<(usize, &Candidate)> = search.levels.iter().skip(1).flat_map(|level| level.candidates.iter().enumerate()).collect();
    let one = |(at, candidate): (usize, &Candidate)| {
        let close = at < LOOKED_AT;
        let constancy = close.then(|| constancy(problem, candidate)).flatten();
        let left_out_g =
            (close && problem.chosen.len() > 1).then(|| left_out_heights(problem, waves, candidate)).flatten().map(|gap| gap.net_g);
        let reason_rejected = (nothing || candidate.ids() != chosen.ids()).then(|| reason(candidate, chosen, constancy.as_ref(), nothing));
        Ranked { id: joined(candidate), score: candidate.score, left_out_g, constancy, reason_rejected }
    };
    let mut all: Vec<Ranked> = looked_at.into_par_iter().map(one).collect();
    all.sort_by(|a, b| a.score.total_cmp(&b.score));
    for spec in candidates(setting.catalogue, chosen.model())
        .iter()
        .filter(|spec| search.levels.get(1).is_some_and(|level| level.candidates.iter().all(|one| one.ids() != [spec.id])))
    {
        all.push(Ranked {
            id: spec.id.into(),
            score: f64::INFINITY,
            left_out_g: None,
            constancy: None,
            reason_rejected: Some("the simulation diverges in every fit".into()),
        });
    }
    all
}

fn reason(candidate: &Candidate, chosen: &Candidate, steady: Option<&Constancy>, nothing: bool) -> String {
    if nothing {
        return "nothing is missing: the improvement is within trial variation".into();
    }
    if let Some((parameter, _)) = implausible(candidate).first() {
        return format!("{parameter} at its bound");
    }
    if let Some(steady) = steady.filter(|steady| steady.p < UNSTEADY) {
        let moved: Vec<String> = steady
            .parameters
            .iter()
            .map(|by| {
                let values: Vec<String> = by.values.iter().map(|(_, value, _)| format!("{value:.4}")).collect();
                let slope = by.slope.map_or(String::new(), |slope| format!(", slope {slope:.2} over impact speed"));
                format!("{} {}{slope}", by.key, values.join(" / "))
            })
            .collect();
        return format!("not the same at all heights (p = {:.1e}): {}", steady.p, moved.join("; "));
    }
    let higher = candidate.score - chosen.score;
    let score = format!("score {:.1} {}", higher.abs(), if higher < 0.0 { "lower" } else { "higher" });
    if candidate.ids().len() < chosen.ids().len() { format!("residual exceeds trial variation; {score}") } else { score }
}
