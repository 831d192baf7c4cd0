//! A diagnosis from the drops on.

use super::bootstrap::Bootstrap;
use super::diagnosis::Diagnosis;
use super::diagnosis_options::DiagnosisOptions;
use super::judged_again::judged_again;
use super::prepared_drops::PreparedDrops;
use super::search::{Search, SearchContext};
use super::stage::Stage;
use crate::impact::effects::Model;
use crate::impact::fit::Waves;

/// Why there is no diagnosis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DiagnosisError {
    /// The simulation of the base model diverges at the start values, or the trial covariance is degenerate.
    #[error("the base model cannot be fitted to these drops: the fits diverge, or the readings do not vary between drops")]
    NoFit,
}

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
        catalogue: settings.catalogue,
        most: settings.most_effects,
        stage,
    };
    let search = Search::run(&setting, model)?;
    stage(Stage::Acceptance);
    let found = Diagnosis::of(&prepared, &setting, &search, fitted, held_out, model, settings)?;
    let again = judged_again(&found, &prepared, &setting, &search, (fitted, held_out), model, settings);
    Some(again.unwrap_or(found))
}
