//! A diagnosis as it is asked for: the model, the drops as read, the heights held out.

use super::compared::Compared;
use super::separating_experiment::SeparatingExperiment;
use crate::figures::decimals;
use crate::impact::body::Feet;
use crate::impact::diagnose;
use crate::impact::diagnose::{
    ChannelChoice, ComparedAxes, Covariate, CovariateEffect, Diagnosis, DiagnosisError, DiagnosisOptions, FrameMode, FreeFallReading,
    Stage, StaticComparison, Verdict, confounded,
};
use crate::impact::effects::{self, AIR_DRAG, Channel, DROP_HEIGHT_ERROR, Model};
use crate::impact::fit::{FitError, Keep, Waves};
use crate::impact::landing::{LandingAssessment, LandingEvidence, ObservedLandings, SEEN_G, TouchEvidence, UnjudgedLandings};
use crate::impact::measured::{DropSet, Fall, FreeFallOffset, Session, StaticTest, is_same_m, symptoms};

/// Most effects on top of spring and damper.
pub const MOST_EFFECTS: usize = 3;

/// What is to be diagnosed.
#[derive(Debug)]
pub struct DiagnosisRequest<'a> {
    /// The model; its k and c are starting values.
    pub model: Model,
    /// The drops.
    pub drops: &'a DropSet,
    /// The axes that are used, instead of those that the drops support.
    pub axes: Option<ComparedAxes>,
    /// Heights that no fit sees, m.
    pub hold_out_heights_m: &'a [f64],
    /// A static test of the same frame, compared with each model and not fitted.
    pub static_test: Option<&'a StaticTest>,
    /// Columns of the drops that may explain how drops of one height vary, besides their order, their session and their touches.
    pub covariates: &'a [String],
    /// Most effects on top of spring and damper, 1 to 3.
    pub max_effects: usize,
    /// Of the simulated data.
    pub seed: u64,
}

/// The model that drops are compared with where none is named: `paper`, or with lateral axes `paper-corrected`. The magnitude, which `paper` states,
/// contains sideways motion, and landings that are not level are judged beside the axis only.
pub fn usual_model(drops: &DropSet) -> &'static str {
    if drops.records().any(|record| record.axes_g.is_some()) { "paper-corrected" } else { "paper" }
}

/// Why there is no diagnosis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RequestError {
    /// Fewer than one effect, or more than [`MOST_EFFECTS`].
    #[error("--max-effects {0} is out of bounds: give 1 to {MOST_EFFECTS}")]
    MostEffects(usize),
    /// The drops cannot be compared with the model.
    #[error(transparent)]
    Drops(#[from] FitError),
    /// Lateral axes that cannot be used.
    #[error("--channel all: {why}; `--channel axial` compares the axis alone")]
    AllAxes {
        /// What is in the way.
        why: &'static str,
    },
    /// A height that no drop has.
    #[error("--hold-out-heights {height_m}: there is no drop from there, only from {} m", .known.join(", "))]
    NoSuchHeight {
        /// The height, m.
        height_m: f64,
        /// The heights there are, m.
        known: Vec<String>,
    },
    /// A column that no drop has.
    #[error(
        "--covariate {name}: no drop has such a column; name a column of the drops' table, or a .csv file with the columns trial and {name}"
    )]
    NoSuchColumn {
        /// Its name.
        name: String,
    },
    /// Every height is held out.
    #[error("--hold-out-heights leaves no height to fit")]
    NothingToFit,
    /// No fit is possible.
    #[error(transparent)]
    Diagnosis(#[from] DiagnosisError),
}

/// Readings so much beyond a sensor's stated limit are not its, g.
const ABOVE_LIMIT_G: f64 = 3.0;

/// What the drops need so that touches can be read.
const TOUCHES_NEED: &str = "the feet's touches need eight drops a height whose lateral axes go on for 15 ms from first touch";

impl DiagnosisRequest<'_> {
    /// Whether what is asked for can be, as far as that is known without the drops.
    ///
    /// # Errors
    /// When the number of effects is out of bounds.
    pub fn bounds(max_effects: usize) -> Result<(), RequestError> {
        if (1..=MOST_EFFECTS).contains(&max_effects) { Ok(()) } else { Err(RequestError::MostEffects(max_effects)) }
    }

    /// The diagnosis, and the record of what was compared; `stage` is called with each stage that begins.
    ///
    /// # Errors
    /// [`RequestError`] when the drops or the heights do not allow one.
    pub fn diagnosed(mut self, stage: &(dyn Fn(Stage) + Sync)) -> Result<(Diagnosis, Compared), RequestError> {
        Self::bounds(self.max_effects)?;
        let known = |name: &&String| self.drops.records().any(|record| record.columns.contains_key(*name));
        if let Some(name) = self.covariates.iter().find(|name| !known(name)) {
            return Err(RequestError::NoSuchColumn { name: name.clone() });
        }
        let choice = ChannelChoice::of(self.drops, &self.model, Keep::Evidence, self.axes)?;
        let observed = self.observed(&choice)?;
        self.model.sensor.channel = choice.chosen.channel;
        let waves = &choice.waves;
        let held = |height_m: f64| self.hold_out_heights_m.iter().any(|out| is_same_m(*out, height_m));
        let unknown = |out: &&f64| waves.groups.iter().all(|group| !is_same_m(group.height_m, **out));
        if let Some(height_m) = self.hold_out_heights_m.iter().copied().find(|out| unknown(&out)) {
            let known = waves.groups.iter().map(|group| group.height_m.to_string()).collect();
            return Err(RequestError::NoSuchHeight { height_m, known });
        }
        let (fitted, held_out) = (waves.only(|height_m| !held(height_m)), waves.only(held));
        if fitted.groups.is_empty() {
            return Err(RequestError::NothingToFit);
        }
        let settings = DiagnosisOptions::new(self.max_effects, self.seed);
        let held_out = (!held_out.groups.is_empty()).then_some(&held_out);
        let (found, landing) = rayon::join(
            || diagnose::watched(&fitted, held_out, &self.model, &settings, stage),
            || observed.as_ref().and_then(|observed| self.landing(observed, &fitted, held_out)),
        );
        let mut found = found?;
        let mut compared = self.compared(&choice);
        if let Some(reason) = self.contradiction_by_falls(&found, &compared.falls) {
            found.reasons.push(reason);
            if found.verdict != Verdict::NothingMissing {
                found.verdict = Verdict::NoneSuffices;
            }
        }
        compared.landing = landing.map(|landing| landing.beside(&found));
        compared.lateral_axes = self.lateral(&choice, observed.as_ref(), compared.landing.is_some());
        if choice.axes == ComparedAxes::All && compared.landing.is_none() {
            compared.channel = ComparedAxes::Axial.word();
        }
        if let Some(landing) = &compared.landing {
            (found.verdict, found.reasons) = landing.verdict(&found);
            if landing.decides() {
                landing.decide(&mut found);
            }
        } else if self.model.body.feet == Some(Feet::Rectangle) && observed.is_some() {
            found.reasons.push("the frame is longer than wide (rods.cage_side_ratio): landings that are not level were not judged".into());
        } else if let Some(observed) = &observed {
            self.warn_of_unjudged_landings(observed, &mut found);
        }
        self.warn_of_the_records(waves, &compared.falls, &mut found);
        compared.covariates = self.explained(&choice, &fitted, compared.landing.as_ref());
        compared.confounding = confounded(&choice.chosen, self.covariates);
        compared.separating = SeparatingExperiment::of(&compared.confounding, &fitted, &found, compared.landing.as_ref(), self.seed);
        compared.frame_mode = self.model.frame_mode.map(|mode| FrameMode::of(mode, &found));
        compared.static_test = self.static_test.map(|test| beside_a_static_test(test, &found, compared.landing.as_ref()));
        Ok((found, compared))
    }

    /// Landings that are not level, where touches of the feet were seen.
    fn landing(&self, observed: &ObservedLandings, fitted: &Waves, held_out: Option<&Waves>) -> Option<UnjudgedLandings> {
        UnjudgedLandings::of(&LandingEvidence { fitted, held_out, observed, model: &self.model, seed: self.seed })
    }

    /// Says where first touches show that landings were not level, though they could not be judged. What is named along the vertical may stand
    /// for them, so it is one of several explanations.
    fn warn_of_unjudged_landings(&self, observed: &ObservedLandings, found: &mut Diagnosis) {
        let evidence = TouchEvidence::of(observed, self.seed);
        if !evidence.shows_one_foot_first() {
            return;
        }
        let TouchEvidence { first_seen, first_along_diagonals_p: p, .. } = evidence;
        found.reasons.push(format!(
            "landings were not level, and could not be judged: of {first_seen} first touches so many point along a diagonal, where the feet are, \
             that p = {p:.1e}. Effects along the vertical, and k and c with them, may stand for these landings; a logger of 1 kHz or more tells"
        ));
        if found.verdict == Verdict::Named {
            found.verdict = Verdict::Ambiguous;
        }
    }

    /// Says what of the records themselves contradicts what is named: their unit, zero and time stamps, copies, falls that are not those of their
    /// heights, and readings beyond the sensor's limit.
    fn warn_of_the_records(&self, waves: &Waves, falls: &[Fall], found: &mut Diagnosis) {
        found.reasons.extend(symptoms(self.drops));
        found.reasons.extend(beyond_limit(waves, self.model.sensor.limit_g));
        let fallen = self.fall_of(found);
        let explained = |fall: &&Fall| fall.agrees() || fall.lasted(fallen.duration_s(fall.height_m));
        if let Some(fall) = falls.iter().find(|fall| !explained(fall)) {
            let reason = format!(
                "the fall from {} m lasted {:.0} ± {:.0} ms, which is that from {:.2} m: what is found rests on heights that were not those stated. \
                 Correct the heights, or tell why the release was not free",
                fall.height_m,
                1e3 * fall.fall_s,
                1e3 * fall.error_s,
                fall.fallen_m()
            );
            found.reasons.insert(0, reason);
            if found.verdict == Verdict::Named {
                found.verdict = Verdict::NoneSuffices;
            }
        }
    }

    /// How the frame falls by what was found, and by the model where nothing was found of that.
    fn fall_of(&self, found: &Diagnosis) -> effects::Fall {
        let own = self.model.arrangement().fall;
        let of = |effect: &str| found.estimates.iter().find(|one| one.effect == effect).map(|one| one.value);
        effects::Fall { extra_m: of(DROP_HEIGHT_ERROR.id).unwrap_or(own.extra_m), drag_1_m: of(AIR_DRAG.id).unwrap_or(own.drag_1_m) }
    }

    /// What the recorded falls say against an error of the drop heights or a drag that was found; nothing where they agree with it, or neither was
    /// found.
    fn contradiction_by_falls(&self, found: &Diagnosis, falls: &[Fall]) -> Option<String> {
        let of_fall = |effect: &str| [DROP_HEIGHT_ERROR.id, AIR_DRAG.id].contains(&effect);
        let named = found.estimates.iter().find(|one| of_fall(one.effect) && found.verdict != Verdict::NothingMissing)?;
        let fallen = self.fall_of(found);
        let fall = falls.iter().find(|fall| !fall.lasted(fallen.duration_s(fall.height_m)))?;
        Some(format!(
            "{} of {} contradicts the recorded falls: from {} m they lasted {:.0} ± {:.0} ms, not {:.0} ms",
            named.effect,
            decimals(named.value, 2),
            fall.height_m,
            1e3 * fall.fall_s,
            1e3 * fall.error_s,
            1e3 * fallen.duration_s(fall.height_m)
        ))
    }

    /// What the lateral axes are used for, or why they are not; nothing where there are none.
    fn lateral(&self, choice: &ChannelChoice, observed: Option<&ObservedLandings>, judged: bool) -> Option<String> {
        let not_judged = "landings that are not level were not judged, and the lateral axes are not used:";
        match (choice.axes, observed) {
            (ComparedAxes::All, Some(_)) if judged => Some(
                "the lateral axes show when each foot touches and how the sensor leans, which judges landings that are not level".into(),
            ),
            (ComparedAxes::All, Some(observed)) => {
                let TouchEvidence { seen, drops, .. } = TouchEvidence::of(observed, self.seed);
                Some(format!(
                    "{not_judged} the touch of each foot shows in {seen} of {drops} drops; it does not show where landings are level, \
                     where a logger is slower than some 1 kHz, or where the lateral readings of a touch stay below {SEEN_G} g"
                ))
            }
            (ComparedAxes::All, None) => Some(format!("{not_judged} {TOUCHES_NEED}")),
            (ComparedAxes::Magnitude, _) if choice.chosen.has_lateral_axes() => Some(format!(
                "{not_judged} the model states the magnitude, and touches are judged beside the axis; `--model paper-corrected` does so"
            )),
            _ => None,
        }
    }

    /// Touches of the feet, where all axes are used and touches can be read; an error where that was asked for and cannot be.
    fn observed(&self, choice: &ChannelChoice) -> Result<Option<ObservedLandings>, RequestError> {
        if choice.axes != ComparedAxes::All {
            return Ok(None);
        }
        let observed = ObservedLandings::of(&choice.chosen, &choice.waves, self.hold_out_heights_m);
        let why = if choice.chosen.has_lateral_axes() { TOUCHES_NEED } else { "the drops have no lateral axes (columns x, y, z)" };
        if observed.is_none() && self.axes.is_some() { Err(RequestError::AllAxes { why }) } else { Ok(observed) }
    }

    /// What explains how drops of one fitted height vary.
    fn explained(&self, choice: &ChannelChoice, fitted: &Waves, landing: Option<&LandingAssessment>) -> Vec<CovariateEffect> {
        let session = Covariate::of_texts("session", fitted, &choice.chosen, |record| Some(Session::name_of(record)));
        let column = |name: &String| Covariate::of_texts(name, fitted, &choice.chosen, |record| record.column(name).map(String::from));
        let touched = landing.into_iter().flat_map(|landing| landing.covariates.iter().cloned());
        let all = touched.chain([Covariate::trial(fitted), session]).chain(self.covariates.iter().map(column));
        all.map(|covariate| covariate.explains(fitted, self.seed)).collect()
    }

    /// The record of what was compared.
    fn compared(&self, choice: &ChannelChoice) -> Compared {
        let chosen = &choice.chosen;
        Compared {
            channel: choice.axes.word(),
            stated_channel: word(choice.stated),
            channel_reason: choice.reason.clone(),
            lateral_axes: None,
            own_effects: self.model.acting().map(|(spec, _)| spec.id).collect(),
            drops: choice.waves.groups.iter().map(|group| (group.height_m, group.windows.len())).collect(),
            sampling: choice.waves.groups.iter().map(|group| (group.height_m, group.decimation)).collect(),
            early_end: chosen.early_end(),
            left_out: chosen.left_out.clone(),
            free_fall: if choice.axes == ComparedAxes::Magnitude { Vec::new() } else { FreeFallReading::all(chosen) },
            held_out_heights_m: self.hold_out_heights_m.to_vec(),
            seed: self.seed,
            falls: if FreeFallOffset::all(self.drops).is_empty() { Fall::of(self.drops) } else { Vec::new() },
            static_test: None,
            frame_mode: None,
            landing: None,
            covariates: Vec::new(),
            confounding: Vec::new(),
            separating: None,
        }
    }
}

/// A static test beside the models of a diagnosis, and beside the legs of landings that are not level.
fn beside_a_static_test(test: &StaticTest, found: &Diagnosis, landing: Option<&LandingAssessment>) -> StaticComparison {
    let along_the_vertical = StaticComparison::of(test, found);
    match landing {
        Some(landing) => {
            let legs = landing.level(found.base.model());
            along_the_vertical.beside(test, landing.ids().join(" + "), &legs, landing.decides())
        }
        None => along_the_vertical,
    }
}

/// Says that readings lie beyond the limit of the model's sensor, which then cannot be theirs.
fn beyond_limit(waves: &Waves, limit_g: f64) -> Option<String> {
    let beyond = |window: &&Vec<f64>| window.iter().any(|reading| reading.abs() > limit_g + ABOVE_LIMIT_G);
    let windows = || waves.groups.iter().flat_map(|group| &group.windows);
    let (count, all) = (windows().filter(beyond).count(), windows().count());
    let largest_g = windows().flatten().map(|reading| reading.abs()).fold(0.0, f64::max);
    (count > 0).then(|| {
        format!(
            "{count} of {all} drops read more than the {limit_g} g at which the model's sensor ends, up to {largest_g:.0} g: state its limit \
             (limit_g of the model's sensor), or what is found stands for that"
        )
    })
}

fn word(channel: Channel) -> &'static str {
    match channel {
        Channel::Axial => "axial",
        Channel::Magnitude => "magnitude",
    }
}
