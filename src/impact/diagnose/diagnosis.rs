//! From measured drops to a verdict with its reasons.

use nalgebra::DMatrix;

use super::adequacy::Adequacy;
use super::alternative::{Alternative, alternatives};
use super::candidate::Candidate;
use super::clipping::Clipping;
use super::constancy::constancy;
use super::diagnosis_options::DiagnosisOptions;
use super::effect_estimate::{EffectEstimate, estimates};
use super::experiment::{Experiment, experiments};
use super::gaps::Gaps;
use super::observable::{Observable, observables};
use super::prepared_drops::PreparedDrops;
use super::ranked::{Ranked, ranking};
use super::residual_force::{ForceCell, residual_force};
use super::residual_map::{Point, ResidualMap, points, residual_map};
use super::search::{RARE, Search, SearchContext};
use super::trend::trend_p;
use super::verdict::{Evidence, Verdict, verdict};
use crate::impact::effects::Model;
use crate::impact::fit::Waves;

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
    /// Samples of the heights that no fit saw, with the predictions of base and chosen model.
    pub held_out_points: [Vec<Point>; 2],
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

/// Weight below which a set is not worth a mention.
const SLIGHT: f64 = 0.02;

impl Diagnosis {
    /// What a search found, put to the tests of acceptance.
    pub(super) fn of(
        prepared: &PreparedDrops,
        setting: &SearchContext,
        search: &Search,
        fitted: &Waves,
        held_out: Option<&Waves>,
        model: &Model,
        settings: &DiagnosisOptions,
    ) -> Option<Self> {
        let problem = setting.problem;
        let base = search.levels[0].candidates[0].clone();
        let trend = trend_p(fitted, &problem.sensitivity(&base.fitted)?, settings.seed)?;
        let nothing = search.levels[0].adequacy.p >= RARE && setting.may_be(&base);
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
        let (estimates, correlations) = estimates(problem, &chosen, &level.adequacy, prepared.clipping.as_ref())?;
        let gaps = |candidate: &Candidate| Gaps::of(problem, fitted, held_out, candidate);
        let (before, after) = (gaps(&base)?, gaps(&chosen)?);
        let (base_points, chosen_points) = (points(problem, fitted, base.model())?, points(problem, fitted, chosen.model())?);
        let unseen = |model: &Model| held_out.map_or(Some(Vec::new()), |waves| points(problem, waves, model));
        let held_out_points = [unseen(base.model())?, unseen(chosen.model())?];
        let larger = || search.levels.get(1).and_then(|level| level.candidates.iter().find(|other| other.ids() != chosen.ids()));
        let rival = alternatives.get(1).map(|alternative| &alternative.candidate).or_else(larger);
        let experiments = rival.map_or_else(Vec::new, |rival| experiments(problem, &prepared.trial_covariance, &chosen, rival));
        let residual_force = if verdict == Verdict::NoneSuffices { residual_force(&chosen_points, model.body.mass_kg) } else { Vec::new() };
        Some(Self {
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
            held_out_points,
            base_adequacy: search.levels[0].adequacy.clone(),
            adequacy: level.adequacy.clone(),
            trend_p: trend,
            observables: [Some(fitted), held_out].into_iter().flatten().flat_map(|waves| observables(waves, model)).collect(),
            clipping: prepared.clipping,
            residual_force,
            experiments,
            base,
            model_after: chosen.model().clone(),
            chosen,
        })
    }
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
