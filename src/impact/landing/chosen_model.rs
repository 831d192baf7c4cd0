//! The model of landings that single drops pay for: more parts than legs and turning slopes only where they explain enough.

use std::sync::Arc;

use super::drop_weights::DropWeights;
use super::fitting::{LandingFit, LandingProblem, ModelParts};
use super::gaps::held_out_gaps;
use super::landing_evidence::LandingEvidence;
use super::observed::{HeightLandings, ObservedLandings};
use super::reading_error::likeliest_read_s;
use super::refused_effect::RefusedEffect;
use super::touch_adequacy::TouchAdequacy;
use crate::impact::fit::Waves;

/// p-value of what touches leave of single drops below which more effects are tried.
const DOUBTED: f64 = 0.05;

/// A model's parts, and its fit.
pub struct ChosenModel {
    /// Touches of the fitted heights, with how such landings are read.
    pub touches: ObservedLandings,
    /// What it has.
    pub parts: ModelParts,
    /// What the readings of drops weigh.
    pub weights: Arc<DropWeights>,
    /// The fit.
    pub fit: LandingFit,
    /// What explains the fitted heights better, and is left out all the same.
    pub refused: Option<RefusedEffect>,
}

impl ChosenModel {
    /// Begins with a plain problem; heights that no fit sees come with their touches. `None` where no fit is possible.
    pub fn of(plain: &LandingProblem, evidence: &LandingEvidence, held: Option<&(&Waves, ObservedLandings)>) -> Option<Self> {
        // How touches are read depends on the landings, and little on whether these are those of the last fit.
        let rough = plain.fitted(None)?;
        let as_read = |fit: &LandingFit| {
            let tables = plain.tables(&fit.legs, &fit.slopes)?;
            let observed = plain.observed.with_errors(&tables, &fit.slopes);
            let heights: Vec<&HeightLandings> = plain.waves.chosen.iter().map(|height| &observed.heights[*height]).collect();
            let read_s = likeliest_read_s(&heights, &tables, plain.parts.at_release)?;
            Some(observed.read_no_better(read_s))
        };
        let of_rough = as_read(&rough)?;
        let (without, first) = LandingProblem { observed: &of_rough, ..plain.clone() }.fitted_with_release_if_it_pays(&rough)?;
        let rubbing = without.fitted_with_friction_if_it_pays(&first);
        let touches = rubbing.as_ref().and_then(|(_, fit)| as_read(fit)).unwrap_or_else(|| of_rough.clone());
        let (rigid, first) = match rubbing {
            Some((rubbing, fit)) => LandingProblem { observed: &touches, ..rubbing }.fitted_with_release_if_it_pays(&fit)?,
            None => (without, first),
        };
        // More is looked for where single drops seem to miss something.
        let adequacy = TouchAdequacy::of(&rigid, &first, evidence.fitted.step_s, evidence.seed)?;
        let more = if adequacy.p < DOUBTED { rigid.fitted_with_feet_or_mount_if_they_pay(&first) } else { None };
        // How far single drops of heights that no fit saw lie from what their touches predict, g.
        let unseen_g = |problem: &LandingProblem, fit: &LandingFit| {
            let (waves, unseen) = held?;
            Some(held_out_gaps(problem, evidence.fitted, fit, waves, unseen, evidence.seed)?.0.given_touches.records_g)
        };
        let refused = more.as_ref().and_then(|(problem, fit)| RefusedEffect::of([(problem, fit), (&rigid, &first)], unseen_g));
        let (problem, fit) = more.filter(|_| refused.is_none()).unwrap_or((rigid, first));
        // What a model leaves that lacks an effect varies as that effect does: parts are chosen with all readings alike, and numbers fitted with weights by the
        // model that was chosen.
        let (problem, fit) = problem.weighed_again(&fit)?;
        Some(Self { parts: problem.parts, weights: problem.weights.clone(), touches, fit, refused })
    }
}
