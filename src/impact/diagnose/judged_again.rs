//! Drops looked at once more, with other estimates of how they vary.

use super::bootstrap::Bootstrap;
use super::candidate::{Candidate, joined};
use super::diagnosis::Diagnosis;
use super::diagnosis_options::DiagnosisOptions;
use super::prepared_drops::PreparedDrops;
use super::search::{RARE, Search, SearchContext};
use super::verdict::Verdict;
use crate::impact::effects::Model;
use crate::impact::fit::Waves;

/// Where nothing is named, or several effects together, or more than the model has already: the diagnosis with other estimates of how drops vary.
/// It counts where it explains the drops, and with fewer effects than were named. `None` elsewhere.
pub(super) fn judged_again(
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
        let setting = SearchContext { problem: &prepared.problem, bootstrap, catalogue: settings.catalogue, most, stage: &|_| () };
        let search = Search::run(&setting, model)?;
        let is_enough = search.levels.last()?.adequacy.p >= RARE;
        is_enough.then(|| Diagnosis::of(prepared, &setting, &search, fitted, held_out, model, settings))?
    };
    // The wave of spring and damper alone is not that of a model with effects, and drops seem to vary in another way around it.
    let around_given = || {
        let prepared = PreparedDrops::around(fitted, search.not_enough.as_ref()?.0.model())?;
        let bootstrap = Bootstrap::of(fitted, &prepared.trial_covariance, &prepared.covariance_model, settings.seed)?;
        let setting =
            SearchContext { problem: &prepared.problem, bootstrap: &bootstrap, catalogue: settings.catalogue, most: 1, stage: &|_| () };
        let search = Search::as_given(&setting, model)?;
        let mut again = Diagnosis::of(&prepared, &setting, &search, fitted, held_out, model, settings)?;
        again
            .reasons
            .push("how drops vary was estimated with the wave of the model as it was given, and not of its spring and damper alone".into());
        Some(again)
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
    around_given().or_else(around_best_single).or_else(alike)
}
