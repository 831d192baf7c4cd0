//! A diagnosis in which landings that are not level are what the drops miss: all that it says of the model after is then of them.

use nalgebra::DMatrix;

use super::assessment::LandingAssessment;
use super::gaps::Window;
use super::legged_body::{COULOMB_FRICTION, Legs};
use crate::impact::diagnose::{Diagnosis, EffectEstimate, Gap, Gaps, Point, joined};
use crate::impact::effects::{LINEAR_DAMPER, LINEAR_SPRING, Model, Spec, by_id};

impl LandingAssessment {
    /// Puts the landings in the place of the best set along the vertical, which stays among the ranked ones. What is only known of that set,
    /// the experiment that tells it from others and the force that it leaves, goes.
    pub fn decide(&self, diagnosis: &mut Diagnosis) {
        let instead = format!("{} explains single drops and held-out heights, too", self.ids().join(" + "));
        let best = joined(&diagnosis.chosen);
        diagnosis.ranking.iter_mut().filter(|one| one.id == best).for_each(|one| one.reason_rejected = Some(instead.clone()));
        diagnosis.contributions.clear();
        diagnosis.estimates = self.estimates.iter().map(named_as_the_base).collect();
        diagnosis.correlations = DMatrix::zeros(0, 0);
        diagnosis.after = Gaps { fitted: self.gaps.fitted, held_out: self.gaps.held_out, trials: Gap::UNKNOWN };
        diagnosis.adequacy = self.adequacy.clone();
        diagnosis.residual_force.clear();
        diagnosis.experiments.clear();
        diagnosis.model_after = self.level(diagnosis.base.model());
        diagnosis.chosen_points = points(&diagnosis.base_points, &self.windows);
        diagnosis.held_out_points[1] = points(&diagnosis.held_out_points[0], &self.held_out_windows);
    }

    /// The base model with these legs, as much of them as a model file may state: a level landing of theirs.
    pub fn level(&self, base: &Model) -> Model {
        level(base, &self.fit.legs)
    }
}

/// The samples with what the landings predict in mean.
fn points(base: &[Point], windows: &[Window]) -> Vec<Point> {
    let predicted = |height_m: f64| windows.iter().find(|(of_m, ..)| *of_m == height_m).map(|(.., predicted)| predicted);
    let mut points = base.to_vec();
    for same in points.chunk_by_mut(|a, b| a.height_m == b.height_m) {
        let Some(predicted) = predicted(same[0].height_m) else { continue };
        same.iter_mut().zip(predicted).for_each(|(point, model_g)| point.model_g = *model_g);
    }
    points
}

/// Spring and damper are those of the base model.
fn named_as_the_base(estimate: &EffectEstimate) -> EffectEstimate {
    let effect = match estimate.key {
        "k" => LINEAR_SPRING.id,
        "c" => LINEAR_DAMPER.id,
        _ => estimate.effect,
    };
    EffectEstimate { effect, ..estimate.clone() }
}

/// The base model with the stiffness, the damping and the friction of these legs, as much of it as a model file may state: a level landing of
/// theirs.
fn level(base: &Model, legs: &Legs) -> Model {
    let word = |spec: &Spec| base.effects.iter().find(|listed| listed.spec.id == spec.id).map_or(0, |listed| listed.word);
    let [spring, damper] = [&LINEAR_SPRING, &LINEAR_DAMPER].map(word);
    let level = base.clone().with(&LINEAR_SPRING, &[legs.stiffness_n_m], spring).with(&LINEAR_DAMPER, &[legs.damping_n_s_m], damper);
    match by_id(COULOMB_FRICTION) {
        Some(friction) if legs.friction_n > 0.0 => {
            let most_n = friction.parameters.iter().map(|parameter| parameter.max).fold(f64::INFINITY, f64::min);
            level.with(friction, &[legs.friction_n.min(most_n)], word(friction))
        }
        _ => level,
    }
}
