//! The effect `landing_tilt`, put to the tests that a named effect has to pass.

use nalgebra::DMatrix;

use super::LANDING_TILT;
use super::attitude_assessment::AttitudeAssessment;
use super::chosen_model::ChosenModel;
use super::evidence::TouchEvidence;
use super::fitting::{LandingFit, LandingProblem};
use super::foot_mode::FOOT_MODE;
use super::gaps::{LandingGaps, Window, as_read, gaps_of_one_height, held_out_ci95_g, held_out_gaps, held_out_peaks, left_out_gaps};
use super::gate::Gate;
use super::height_peaks::HeightPeaks;
use super::landing_evidence::LandingEvidence;
use super::landing_scatter::LandingScatter;
use super::legged_body::{COULOMB_FRICTION, LeggedBody};
use super::observed::{HeightLandings, ObservedLandings};
use super::population::Population;
use super::posterior::given_touches;
use super::read_delays::ReadDelays;
use super::refused_effect::RefusedEffect;
use super::sensor_attitude::ATTITUDE_SENSOR;
use super::sensor_mount::MOUNT_LOW_PASS;
use super::shown::{HeightSpread, ShownDrop};
use super::table::LandingTable;
use super::touch_adequacy::TouchAdequacy;
use super::touch_power::drops_to_tell;
use super::touches::LegTouches;
use super::uncertainty::FitUncertainty;
use crate::impact::diagnose::{Adequacy, Covariate, Diagnosis, EffectEstimate, LinearisedFit, PreparedDrops, RARE, Verdict, joined, judge};
use crate::impact::fit::{FitProblem, Waves};

/// Legs and slopes that may be the true ones, by which the gap to other heights has its interval.
const DRAWN: usize = 80;

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

/// An experiment in one session that tells a slope that grows with the fall from one that does not.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct SeparatingDrops {
    /// From these heights, m.
    pub heights_m: [f64; 2],
    /// So many each; `None` where more than two hundred are needed.
    pub drops: Option<usize>,
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
    /// The spread of slopes height by height.
    pub heights: Vec<SlopesAtHeight>,
    /// Gaps.
    pub gaps: LandingGaps,
    /// p-value of the touch times of all heights under one pair of numbers for the slopes; 1 of one height.
    pub slopes_steady_p: f64,
    /// p-value of the numbers of friction, feet and mount being those of every height, where there are such.
    pub effects_steady_p: Option<f64>,
    /// What explains the fitted heights better, and those that no fit saw worse.
    pub refused: Option<RefusedEffect>,
    /// p-values of what the population leaves of the mean waves.
    pub adequacy: Adequacy,
    /// What touches leave of single drops of the fitted heights.
    pub given_touches: TouchAdequacy,
    /// p-value of how single records spread, under the population.
    pub spread_p: f64,
    /// What the touches may explain of the variation between drops.
    pub covariates: Vec<Covariate>,
    /// What would tell whether slopes grow with the fall.
    pub separating: Option<SeparatingDrops>,
    /// How readings and touch times of the fitted heights spread.
    pub spreads: Vec<HeightSpread>,
    /// Peaks of all heights beside those of the landings, heights that no fit saw last.
    pub peaks: Vec<HeightPeaks>,
    /// One drop from the highest fitted height.
    pub shown: Option<ShownDrop>,
    /// How the sensor leans. Where that is named, everything else here is of the readings turned back.
    pub attitude: AttitudeAssessment,
    /// The tests.
    pub gates: Vec<Gate>,
    /// Mean windows: height, measured, predicted by the population, g.
    pub windows: Vec<Window>,
    /// The same of heights that no fit saw.
    pub held_out_windows: Vec<Window>,
    /// Time between their samples, s.
    pub step_s: f64,
    /// Delays of the opposite foot and of those beside of every drop whose feet were all seen, s, by height, m.
    pub touches: Vec<(f64, Vec<[f64; 3]>)>,
    /// Whether it is the verdict.
    pub(super) decides: bool,
}

impl LandingAssessment {
    /// Fits readings as they are, with an attitude that is known, or with that which they show. Its tests are still to be made.
    pub(super) fn fitted(evidence: &LandingEvidence, known: Option<AttitudeAssessment>) -> Option<Self> {
        let touches = evidence.observed.of_heights(evidence.fitted);
        let prepared = PreparedDrops::of(evidence.fitted, evidence.model)?;
        // Nearly all that varies from drop to drop is of the slopes, and each predicted landing has its own.
        let waves = prepared.problem.without_trigger_jitter();
        let plain = LandingProblem::plain(LeggedBody::of(evidence.model)?, evidence.model, &waves, &touches);
        let held = evidence.held_out.map(|waves| (waves, evidence.observed.of_heights(waves)));
        let ChosenModel { touches: fitted_touches, parts, weights, fit, refused } = ChosenModel::of(&plain, evidence, held.as_ref())?;
        let chosen = LandingProblem { observed: &fitted_touches, weights, ..plain.with(parts) };
        let PopulationFit { fit, waves: whitened, adequacy, given_touches, uncertainty, spread_p } =
            PopulationFit::of(evidence, &chosen, fit)?;
        let problem = chosen.at(&whitened);
        let predicted = problem.mean_windows(&fit.legs, &fit.slopes)?;
        let touched = TouchEvidence::of(evidence.observed, evidence.seed);
        let (gaps, held_out_windows) = match &held {
            Some((waves, touches)) => held_out_gaps(&problem, evidence.fitted, &fit, waves, touches, evidence.seed)?,
            None if evidence.fitted.groups.len() < 2 => (gaps_of_one_height(&problem, evidence.fitted, &fit)?, Vec::new()),
            None => (left_out_gaps(&problem, evidence.fitted, &fit, evidence.seed)?, Vec::new()),
        };
        let may_be = uncertainty.drawn(&problem, &fit, DRAWN, evidence.seed)?;
        let held_out_ci95_g = held.as_ref().and_then(|(waves, _)| held_out_ci95_g(&problem, waves, &may_be));
        let gaps = LandingGaps { held_out_ci95_g, ..gaps };
        let estimates = uncertainty.estimates(&problem, &fit)?;
        let (slopes_steady_p, effects_steady_p) = (problem.slopes_steady_p(&fit)?, problem.effects_steady_p(&fit));
        let tables = problem.tables(&fit.legs, &fit.slopes)?;
        let attitude = match known {
            Some(known) => known,
            None => {
                let read = |(waves, touches): &(&Waves, ObservedLandings)| as_read(&problem, &fit, waves, touches);
                let held = match &held {
                    Some(held) => Some(read(held)?),
                    None => None,
                };
                AttitudeAssessment::of(&problem, &tables, &fit, held.as_ref(), evidence.seed)?
            }
        };
        let covariates = covariates(evidence.fitted, &fitted_touches, &tables, &fit);
        let separating = separating(&problem, evidence.observed, &fit, evidence.seed);
        let shown = fitted_touches.heights.last().zip(tables.last()).and_then(|(height, table)| ShownDrop::of(height, table, &fit));
        let heights = slopes_by_height(&fitted_touches, &tables, &fit)?;
        let spreads = fitted_touches.heights.iter().zip(tables.iter()).map(|(height, table)| HeightSpread::of(height, table, &fit.slopes));
        let spreads = spreads.collect();
        let mut peaks: Vec<HeightPeaks> =
            fitted_touches.heights.iter().zip(tables.iter()).filter_map(|(height, table)| HeightPeaks::of(height, table)).collect();
        if let Some((waves, touches)) = &held {
            peaks.extend(held_out_peaks(&problem, &fit, waves, touches)?);
        }
        let samples = waves.expected.samples;
        let windows = evidence
            .fitted
            .groups
            .iter()
            .enumerate()
            .map(|(at, group)| (group.height_m, group.mean.clone(), predicted.as_slice()[at * samples..(at + 1) * samples].to_vec()));
        let windows = windows.collect();
        let touches =
            evidence.observed.heights.iter().map(|height| (height.height_m, height.seen().map(|drop| drop.touches.delays_s()).collect()));
        Some(Self {
            evidence: touched,
            fit,
            estimates,
            heights,
            gaps,
            slopes_steady_p,
            effects_steady_p,
            refused,
            adequacy,
            given_touches,
            spread_p,
            covariates,
            separating,
            spreads,
            peaks,
            shown,
            attitude,
            gates: Vec::new(),
            windows,
            held_out_windows,
            step_s: evidence.fitted.step_s,
            touches: touches.collect(),
            decides: false,
        })
    }

    /// Whether every test was passed.
    pub fn named(&self) -> bool {
        self.gates.iter().all(|gate| gate.passed)
    }

    /// The effects: slopes; friction of the legs, mass of the feet, a mount and a lean of the sensor where single drops show them.
    pub fn ids(&self) -> Vec<&'static str> {
        let mount = self.fit.legs.mount.map(|_| MOUNT_LOW_PASS);
        let attitude = self.attitude.named().map(|_| ATTITUDE_SENSOR);
        let friction = self.rubs().then_some(COULOMB_FRICTION);
        let feet = self.fit.legs.feet.map(|_| FOOT_MODE);
        [LANDING_TILT].into_iter().chain(friction).chain(feet).chain(mount).chain(attitude).collect()
    }

    /// Whether the legs have dry friction.
    pub fn rubs(&self) -> bool {
        self.fit.legs.friction_n > 0.0
    }

    /// Whether it is what the drops miss: something is missing, and every test was passed. One of them is that no set of effects along the
    /// vertical comes nearer to heights that no fit saw.
    pub fn decides(&self) -> bool {
        self.decides
    }

    /// Whether touches show landings on one foot first, and the verdict is another one: their gap stands beside that of the best vertical set.
    pub fn stands_beside(&self) -> bool {
        self.evidence.feet_in_one_plane() && !self.decides
    }

    /// What the diagnosis says with this beside the effects along the vertical: verdict and reasons.
    pub fn verdict(&self, diagnosis: &Diagnosis) -> (Verdict, Vec<String>) {
        let mut reasons = diagnosis.reasons.clone();
        if self.decides {
            let effects = self.ids().join(" + ");
            reasons = self.gates.iter().map(|gate| format!("{effects}: {}", gate.found)).collect();
            return (Verdict::Named, reasons);
        }
        if self.stands_beside() {
            reasons.push(format!("{LANDING_TILT}: {}", self.gates[0].found));
            let failed = self.gates.iter().filter(|gate| !gate.passed);
            reasons.extend(failed.map(|gate| format!("{LANDING_TILT} is not named by the test `{}`: {}", gate.id, gate.found)));
            reasons.extend(self.refused.iter().map(RefusedEffect::sentence));
            if diagnosis.verdict == Verdict::Named && self.touches_tell_drops() {
                reasons.push(format!(
                    "single drops depend on their touches, which {} does not explain: it is not named",
                    joined(&diagnosis.chosen)
                ));
                return (Verdict::Ambiguous, reasons);
            }
        }
        if self.evidence.is_turned() {
            reasons.push(format!(
                "{LANDING_TILT}: the first touch points along x or y, and along a diagonal in {:.0} % of the drops only (p = {:.1e}). Where x and \
                 y of the sensor point along the legs, turn them back by 45 degrees (`--turn 45`): x then points to the front and y to the left",
                1e2 * self.evidence.along_diagonals,
                self.evidence.along_axes_p
            ));
        }
        (diagnosis.verdict, reasons)
    }

    /// Whether single drops of heights that no fit saw are predicted from their touches: better than by the mean of their own height, and
    /// better than with the touches of other drops.
    pub(super) fn touches_tell_drops(&self) -> bool {
        self.gaps.dealt_p <= RARE && self.gaps.given_touches.records_g < self.gaps.held_out.template_g
    }
}

fn slopes_by_height(observed: &ObservedLandings, tables: &[LandingTable], fit: &LandingFit) -> Option<Vec<SlopesAtHeight>> {
    let one = |(height, table): (&HeightLandings, &LandingTable)| {
        let [_, (opposite_s, error_s), _] = height.opposite_quartiles_s()?;
        let weights = Population::of(table, &fit.slopes);
        let [predicted_s] = ReadDelays::of(table, height.errors.as_ref()).quantiles_s(weights.weights(), [0.5]);
        Some(SlopesAtHeight { height_m: height.height_m, opposite_s, predicted_s, error_s })
    };
    observed.heights.iter().zip(tables).map(one).collect()
}

/// A population, and how it stands to the mean waves.
struct PopulationFit {
    fit: LandingFit,
    waves: FitProblem,
    adequacy: Adequacy,
    given_touches: TouchAdequacy,
    uncertainty: FitUncertainty,
    spread_p: f64,
}

impl PopulationFit {
    /// Of a fit, whose mean waves are judged in units of the scatter that it explains itself.
    fn of(evidence: &LandingEvidence, first: &LandingProblem, fit: LandingFit) -> Option<Self> {
        let scatter = LandingScatter::of(evidence.fitted, first, &fit)?;
        let waves = scatter.problem(first.waves);
        let problem = first.at(&waves);
        let jacobian = problem.sensitivity(&fit)?;
        let samples = waves.expected.samples;
        let seen = LinearisedFit { effects: DMatrix::zeros(jacobian.nrows(), 0), jacobian, samples };
        let bootstrap = scatter.bootstrap(&problem, &fit, evidence.seed)?;
        let left = waves.measured() - problem.mean_windows(&fit.legs, &fit.slopes)?;
        let adequacy = judge(&left, &seen, &bootstrap)?;
        let uncertainty = FitUncertainty::of(&problem, &fit, evidence.seed)?;
        let spread_p = scatter.spread_p(&problem, &fit, &uncertainty, evidence.fitted, evidence.seed)?;
        let given_touches = TouchAdequacy::of(&problem, &fit, evidence.fitted.step_s, evidence.seed)?;
        Some(Self { fit, waves, adequacy, given_touches, uncertainty, spread_p })
    }
}

/// Touch times and slope of each drop of the fitted heights.
fn covariates(fitted: &Waves, observed: &ObservedLandings, tables: &[LandingTable], fit: &LandingFit) -> Vec<Covariate> {
    let mut times = Vec::new();
    let mut slopes = Vec::new();
    for ((group, height), table) in fitted.groups.iter().zip(&observed.heights).zip(tables) {
        let (population, read_s) = (Population::of(table, &fit.slopes), height.read_s());
        let read: Vec<Option<&LegTouches>> =
            group.trials.iter().map(|trial| height.drops.iter().find(|drop| drop.trial == *trial).map(|drop| &drop.touches)).collect();
        times.push(read.iter().map(|touches| touches.map(|touches| touches.delays_s().to_vec())).collect());
        slopes
            .push(read.iter().map(|touches| touches.map(|touches| vec![given_touches(&population, touches, read_s).slope_rad])).collect());
    }
    vec![Covariate { id: "leg_times".into(), values: times }, Covariate { id: "landing_slope".into(), values: slopes }]
}

/// The lowest and the highest height of all drops, and how many from each would tell whether slopes grow with the fall.
fn separating(problem: &LandingProblem, observed: &ObservedLandings, fit: &LandingFit, seed: u64) -> Option<SeparatingDrops> {
    let heights_m = [observed.heights.first()?.height_m, observed.heights.last()?.height_m];
    let table = |height_m: f64| LandingTable::of(&problem.body, &fit.legs, &fit.slopes, problem.model, &problem.waves.expected, height_m);
    let (low, high) = (table(heights_m[0])?, table(heights_m[1])?);
    Some(SeparatingDrops { heights_m, drops: drops_to_tell([&low, &high], &fit.slopes, problem.observed.read_s(), seed) })
}
