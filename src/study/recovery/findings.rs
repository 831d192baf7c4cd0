//! What comes out of a row of hidden effects: the diagnosis beside its truth.

use super::ceiling::ObserverShare;
use super::landing_truth::LandingTruth;
use super::noise_free::{catalogue, clean, noncentrality, ranked_with_known_covariance, waves};
use super::setting::{Case, Recovery};
use super::truth::{Truth, Truths};
use crate::impact::diagnose::{Diagnosis, DiagnosisOptions, Verdict, diagnose};
use crate::impact::effects::{Channel, Model};
use crate::impact::fit::{Chosen, Expected, Keep};
use crate::impact::landing::{COULOMB_FRICTION, LandingAssessment, LandingEvidence, ObservedLandings, UnjudgedLandings};
use crate::impact::measured::{self, FileFormat};
use crate::impact::synthetic::{Hidden, Plan, records, table};

/// The height at which models are compared with the truth and that no drop is made from, m.
const HELD_OUT_M: f64 = 2.0;
/// Parameters that have an estimate in the table: k, c, and those of a single hidden effect.
pub(super) const PARAMETERS: usize = 5;
/// Those of landings: k, c, and what takes the place of an effect's.
pub(super) const LANDING_KEYS: [&str; PARAMETERS] = ["k", "c", "inertia_kg_m2", "sigma_r_rad_s", "sigma_0_rad"];

/// What a row asks for; each takes time of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asks {
    /// The drops and their diagnosis.
    Diagnosis,
    /// The distance of base and diagnosis from the truth at a height without drops.
    HeldOut,
    /// The strength of the truth at its own level of noise.
    Noncentrality,
    /// What the catalogue leaves of a truth without noise.
    Left,
    /// The ideal observer's share.
    Ceiling,
    /// The ranking with the generator's covariance.
    KnownCovariance,
    /// Landings, judged in drops with lateral axes.
    Landings,
}

/// A parameter of the truth beside its estimate: the truth, the estimate and its 95 % interval.
pub(super) type Estimate = [Option<f64>; 4];

/// What came out of a row.
pub(super) struct Findings<'a> {
    pub case: &'a Case,
    pub diagnosis: Option<Diagnosis>,
    /// Where the row has lateral axes in which touches were seen.
    pub landing: Option<LandingAssessment>,
    pub estimates: [Estimate; PARAMETERS],
    pub held_out_g: [Option<f64>; 2],
    pub noncentrality: Option<f64>,
    /// The least that one of a pair leaves alone.
    pub left_alone: Option<f64>,
    /// What the best set leaves that is not the truth.
    pub left_rival: Option<f64>,
    pub ceiling: Option<ObserverShare>,
    pub with_known_covariance: Option<&'static str>,
}

/// The drops of a case; or why there are none.
fn plan(recovery: &Recovery, case: &Case) -> Result<Plan, String> {
    let truths = Truths { base: &recovery.base, law: case.law };
    let strength = case.strength.unwrap_or(0.0);
    let plan = match case.truth {
        Truth::Nothing => Some(truths.plain(case.level, 1000 + case.seed)),
        Truth::One(spec) => truths.one(spec.id, case.seed, strength, case.level),
        Truth::Two(specs) => truths.two(specs, case.seed, strength, case.level),
        Truth::Outside(hidden) => Some(Plan { hidden: Some(hidden), ..truths.plain(case.level, 5000 + case.seed) }),
        Truth::Landing(landing) => Some(landing.plan(truths.plain(case.level, case.seed), case.seed)),
    };
    plan.ok_or_else(|| format!("within its bounds {} does not reach the strength {strength}", case.truth.name()))
}

impl Recovery {
    /// The drops of a row, as `flexframe synthesize` makes them.
    ///
    /// # Errors
    /// When the bounds of an effect do not allow its strength.
    pub fn drops(&self, row: usize) -> Result<Plan, String> {
        plan(self, &self.cases[row])
    }
}

impl<'a> Findings<'a> {
    /// Looks at a row as far as it is asked.
    ///
    /// # Errors
    /// When the drops cannot be made or compared, in words.
    pub fn of(recovery: &Recovery, case: &'a Case, asked: &[Asks]) -> Result<Self, String> {
        let plan = plan(recovery, case)?;
        let asks = |what: Asks| asked.contains(&what);
        if let Truth::Landing(truth) = case.truth {
            return Self::of_landings(recovery, case, &plan, truth);
        }
        let diagnosis = (asks(Asks::Diagnosis) || asks(Asks::HeldOut)).then(|| diagnosed(recovery, &plan)).transpose()?;
        let held_out_g = match &diagnosis {
            Some(diagnosis) if asks(Asks::HeldOut) => held_out_g(&plan, diagnosis),
            _ => [None; 2],
        };
        let is_one = matches!(case.truth, Truth::One(_));
        let [left_alone, left_rival] = if asks(Asks::Left) { left(case, &plan, &recovery.base) } else { [None; 2] };
        Ok(Self {
            case,
            estimates: diagnosis.as_ref().map_or([[None; 4]; PARAMETERS], |diagnosis| estimates(case, &plan, diagnosis)),
            held_out_g,
            noncentrality: (is_one && asks(Asks::Noncentrality)).then(|| noncentrality(&plan)).flatten(),
            left_alone,
            left_rival,
            ceiling: None,
            with_known_covariance: (is_one && asks(Asks::KnownCovariance))
                .then(|| ranked_with_known_covariance(&plan, &recovery.base))
                .flatten(),
            diagnosis,
            landing: None,
        })
    }

    /// Looks at a row whose drops have lateral axes: from two heights, with the highest one held out.
    fn of_landings(recovery: &Recovery, case: &'a Case, plan: &Plan, truth: LandingTruth) -> Result<Self, String> {
        let model = LandingTruth::diagnosed(plan);
        let text = table(&records(plan));
        let set = measured::read_bytes(&[("drops.csv".into(), text.into_bytes())], &FileFormat::default()).map_err(|e| e.to_string())?;
        let chosen = Chosen::of(&set, Channel::Axial, Keep::Evidence).map_err(|error| error.to_string())?;
        let waves = chosen.waves().map_err(|error| error.to_string())?;
        let highest_m = plan.heights_m.iter().copied().fold(0.0, f64::max);
        let (fitted, held_out) = (waves.only(|height_m| height_m < highest_m), waves.only(|height_m| height_m >= highest_m));
        let options = DiagnosisOptions::new(recovery.most_effects, plan.seed);
        let mut diagnosis = diagnose(&fitted, Some(&held_out), &model, &options).map_err(|error| error.to_string())?;
        let observed = ObservedLandings::of(&chosen, &waves, &[highest_m]);
        let landing = observed.as_ref().and_then(|observed| {
            let evidence = LandingEvidence { fitted: &fitted, held_out: Some(&held_out), observed, model: &model, seed: plan.seed };
            Some(UnjudgedLandings::of(&evidence)?.beside(&diagnosis))
        });
        if let Some(landing) = &landing {
            (diagnosis.verdict, diagnosis.reasons) = landing.verdict(&diagnosis);
        }
        Ok(Self {
            case,
            estimates: landing.as_ref().filter(|_| truth.is_sloped()).map_or([[None; 4]; PARAMETERS], |found| of_legs(plan, found)),
            landing,
            held_out_g: [None; 2],
            noncentrality: None,
            left_alone: None,
            left_rival: None,
            ceiling: None,
            with_known_covariance: None,
            diagnosis: Some(diagnosis),
        })
    }

    /// Whether landings that are not level are the verdict; none of rows without lateral axes.
    pub fn names_landings(&self) -> Option<bool> {
        matches!(self.case.truth, Truth::Landing(_)).then(|| self.landing.as_ref().is_some_and(LandingAssessment::decides))
    }

    /// Dry friction of legs beside landings that are not level, as it is and as it was found, N; none of rows without such landings.
    pub fn friction(&self) -> Option<Estimate> {
        let Truth::Landing(truth) = self.case.truth else { return None };
        let found = self.landing.as_ref()?.estimates.iter().find(|one| one.effect == COULOMB_FRICTION);
        let figures = found.map_or([None; 3], |one| [one.value, one.ci95[0], one.ci95[1]].map(Some));
        let [value, least, most] = figures;
        truth.is_sloped().then_some([Some(truth.friction_n()), value, least, most])
    }

    /// The effects that were named, the largest contribution first; none where nothing is missing.
    pub fn named(&self) -> Vec<&'static str> {
        let diagnosis = self.diagnosis.iter().filter(|diagnosis| diagnosis.verdict != Verdict::NothingMissing);
        diagnosis.flat_map(|diagnosis| &diagnosis.contributions).map(|one| one.0).collect()
    }

    /// Whether the diagnosis is right: the effect named first, both and no other in the set, no name for a stranger, no alarm.
    pub fn is_right(&self) -> Option<bool> {
        let diagnosis = self.diagnosis.as_ref()?;
        Some(match self.case.truth {
            Truth::Nothing => diagnosis.verdict == Verdict::NothingMissing,
            Truth::One(spec) => self.named().first() == Some(&spec.id),
            Truth::Two(_) => diagnosis.chosen.ids() == self.case.truth.ids(),
            Truth::Outside(_) => matches!(diagnosis.verdict, Verdict::NoneSuffices | Verdict::Ambiguous),
            Truth::Landing(truth) => {
                let rubs = self.landing.as_ref().is_some_and(LandingAssessment::rubs);
                let heavy_feet = self.landing.as_ref().is_some_and(|landing| landing.fit.legs.feet.is_some());
                let same = rubs == truth.rubs() && heavy_feet == truth.has_heavy_feet();
                self.names_landings()? == truth.is_sloped() && (!truth.is_sloped() || same)
            }
        })
    }

    /// The first of the ranking of single effects, whatever the verdict.
    pub fn first(&self) -> Option<&str> {
        self.diagnosis.as_ref()?.ranking.iter().map(|one| one.id.as_str()).find(|id| !id.contains('+'))
    }

    /// The place of the truth in the ranking of sets of its size, from 1; none where it was not tried.
    pub fn rank(&self) -> Option<usize> {
        let (size, name) = (self.case.truth.ids().len(), self.case.truth.name());
        let of_size = self.diagnosis.as_ref()?.ranking.iter().filter(|one| one.id.split(" + ").count() == size);
        of_size.map(|one| &one.id).position(|id| *id == name).filter(|_| size > 0).map(|at| at + 1)
    }
}

fn diagnosed(recovery: &Recovery, plan: &Plan) -> Result<Diagnosis, String> {
    let waves = waves(plan).ok_or("the synthetic drops cannot be aligned at their triggers")?;
    let options = DiagnosisOptions::new(recovery.most_effects, plan.seed);
    diagnose(&waves, None, &recovery.base, &options).map_err(|error| error.to_string())
}

/// Distances of the base and of the diagnosed model from the noise-free mean wave at a height without drops, root mean square, g.
fn held_out_g(plan: &Plan, diagnosis: &Diagnosis) -> [Option<f64>; 2] {
    let expected = Expected::plain(1e-3, 31);
    let truth = expected.mean_over_phases(&clean(plan, HELD_OUT_M));
    let held_out_distance = |model: &Model| {
        let predicted = expected.window(&expected.system(model), HELD_OUT_M)?;
        let squares: f64 = truth.iter().zip(&predicted).map(|(a, b)| (a - b) * (a - b)).sum();
        Some((squares / truth.len() as f64).sqrt())
    };
    [held_out_distance(diagnosis.base.model()), held_out_distance(diagnosis.chosen.model())]
}

/// The truth's parameters, with their estimates where the diagnosis has the truth's effects and no other.
fn estimates(case: &Case, plan: &Plan, diagnosis: &Diagnosis) -> [Estimate; PARAMETERS] {
    let is_truth = diagnosis.chosen.ids() == case.truth.ids() && !matches!(case.truth, Truth::Outside(_));
    let base = plan.model.effects.iter().filter(|listed| listed.spec.is_base());
    let own = plan.model.effects.iter().filter(|listed| matches!(case.truth, Truth::One(spec) if spec == listed.spec));
    let keys = base.chain(own).flat_map(|listed| listed.spec.parameters.iter().map(|parameter| (listed.spec.id, parameter.key)));
    let mut all = [[None; 4]; PARAMETERS];
    for (place, (effect, key)) in all.iter_mut().zip(keys) {
        place[0] = plan.model.value(effect, key);
        let found = diagnosis.estimates.iter().find(|one| is_truth && one.effect == effect && one.key == key);
        if let Some(one) = found {
            (place[1], place[2], place[3]) = (Some(one.value), Some(one.ci95[0]), Some(one.ci95[1]));
        }
    }
    all
}

/// Legs and slopes of the truth beside those that were found, in the order of [`LANDING_KEYS`].
fn of_legs(plan: &Plan, found: &LandingAssessment) -> [Estimate; PARAMETERS] {
    let truth = |key: &str| {
        let landings = plan.landings.as_ref();
        match key {
            "inertia_kg_m2" => landings.map(|landings| landings.inertia_kg_m2),
            "sigma_r_rad_s" => landings.map(|landings| landings.rate_rad_s),
            "sigma_0_rad" => landings.map(|landings| landings.at_release_rad),
            "k" => plan.model.value("linear_spring", "k"),
            _ => plan.model.value("linear_damper", "c"),
        }
    };
    LANDING_KEYS.map(|key| {
        let one = found.estimates.iter().find(|one| one.key == key);
        [truth(key), one.map(|one| one.value), one.map(|one| one.ci95[0]), one.map(|one| one.ci95[1])]
    })
}

/// What is left of a truth without noise: by each effect of a pair alone, the least of it; and by the best set of one or two effects
/// that is not the truth. Wear is not in the mean of drops, so nothing is known of it.
fn left(case: &Case, plan: &Plan, base: &Model) -> [Option<f64>; 2] {
    if matches!(case.truth, Truth::Nothing | Truth::One(_) | Truth::Landing(_) | Truth::Outside(Hidden::Wear { .. })) {
        return [None; 2];
    }
    let Some(search) = catalogue(plan, base) else { return [None; 2] };
    let ids = case.truth.ids();
    let all = || search.levels.iter().flat_map(|level| &level.candidates);
    let alone = |id: &&'static str| all().find(|one| one.ids() == [*id]).map(|one| one.fitted.chi2());
    let least_alone = ids.iter().filter_map(alone).reduce(f64::min);
    if ids.is_empty() {
        return [None, all().map(|one| one.fitted.chi2()).reduce(f64::min)];
    }
    let others = all().filter(|one| !one.ids().is_empty() && one.ids() != ids);
    let rival = others.min_by(|a, b| a.score.total_cmp(&b.score));
    [least_alone, rival.map(|one| one.fitted.chi2())]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::landing::GATES;
    use crate::params::ImpactFile;
    use crate::params::files::Memory;
    use crate::study::recovery::setting;

    #[test]
    fn planted_rows_of_landings_are_named_where_they_slope_and_not_where_they_are_level() {
        let plan = "kind = \"recovery\"\nrates_rad_s = [0.25]\nmost_effects = 1\n[seeds]\nsloped = [6104, 6105]\nlevel = [6104, 6105]\n";
        let file = ImpactFile::parse("s.toml", plan).expect("is TOML");
        let recovery = setting(&file, &Memory::default()).expect("is a plan");
        let found = |at: usize| Findings::of(&recovery, &recovery.cases[at], &[Asks::Landings]).expect("drops that can be diagnosed");
        let sloped = found(0);
        let tests: Vec<&str> = sloped.landing.iter().flat_map(|landing| &landing.gates).map(|gate| gate.id).collect();
        assert_eq!(tests, GATES);
        assert_eq!(sloped.names_landings(), Some(true), "{:?}", sloped.landing.map(|landing| landing.gates));
        let [truth, value, least, most] = sloped.estimates[3].map(|figure| figure.expect("a turning rate"));
        assert!(truth == 0.25 && least < truth && truth < most && (0.8..1.2).contains(&(value / truth)), "{value} ({least} to {most})");
        for level in 1..5 {
            let found = found(level);
            assert_eq!((found.names_landings(), found.is_right()), (Some(false), Some(true)), "{}", found.case.truth.name());
        }
    }
}
