//! The plan of a study of hidden effects as typed, and what is wrong with it.

use super::landing_truth::LandingTruth;
use super::measure::{RECOVERY_MEASURES, RecoveryMeasure};
use super::setting::{Case, Recovery};
use super::strength::recorded;
use super::truth::{LEVELS, Truth, outside, pair};
use crate::impact::effects::{CATALOGUE, Model, Spec};
use crate::impact::synthetic::ScatterLaw;
use crate::params::files::Files;
use crate::params::refusal::Refusal;
use crate::params::{ImpactFile, LoadError};
use crate::study::plan_keys::{KINDS, PlanKey, Takes, each_once, impossible, named, only_known, plan_key, whole, wholes};
use crate::study::sampling::MOST_ROWS;

/// The model that is diagnosed.
const BASE: &str = "paper";
/// Bounds of a seed: numbers that are made from it stay whole.
const SEED: [f64; 2] = [0.0, 1e9];
/// Bounds of a strength: what a noncentrality may be called.
const STRENGTH: [f64; 2] = [1.0, 1e5];
/// Strengths of single effects when a plan does not say.
const STRENGTHS: [f64; 5] = [5.0, 19.0, 71.0, 266.0, 1000.0];
/// Strength of each effect of a pair when a plan does not say.
const PAIR_STRENGTH: f64 = 400.0;
/// Effects that a diagnosis tries when a plan does not say.
const MOST_EFFECTS: usize = 3;
/// Standard deviations of the turning rate at release when a plan does not say, and their bounds, rad/s.
const RATES_RAD_S: [f64; 3] = [0.15, 0.25, 0.4];
const RATE_RAD_S: [f64; 2] = [0.001, 3.0];
/// Bounds of the ideal observer's gain.
const CEILING_GAIN: [f64; 2] = [1.0, 100.0];

/// Keys of the seeds, in the order in which rows are made.
const SEEDS: [PlanKey; 9] = [
    plan_key("seeds.nothing", Takes::Seeds(SEED), "Drops without a hidden effect."),
    plan_key("seeds.one", Takes::Seeds(SEED), "Drops with one effect."),
    plan_key("seeds.two", Takes::Seeds(SEED), "Drops with two effects."),
    plan_key("seeds.outside", Takes::Seeds(SEED), "Drops with an effect outside the catalogue."),
    plan_key("seeds.sloped", Takes::Seeds(SEED), "Landings that slope."),
    plan_key("seeds.sloped_with_friction", Takes::Seeds(SEED), "Landings that slope on legs with dry friction."),
    plan_key("seeds.sloped_on_heavy_feet", Takes::Seeds(SEED), "The same, on feet with mass of their own."),
    plan_key("seeds.sloped_on_rough_ground", Takes::Seeds(SEED), "Landings that slope on legs with dry friction, on ground with friction."),
    plan_key("seeds.level", Takes::Seeds(SEED), "Level landings that could be taken for those that slope."),
];
/// Keys beside those of the seeds.
const OTHERS: [PlanKey; 11] = [
    plan_key("kind", Takes::Word(&KINDS), "What the rows are."),
    plan_key("levels", Takes::Wholes(LEVELS), "Levels of noise."),
    plan_key("laws", Takes::Names(|| ScatterLaw::NAMES.map(String::from).to_vec()), "Laws of the scatter."),
    plan_key("strengths", Takes::Numbers(STRENGTH, "1"), "Noncentralities of single effects at level 2."),
    plan_key("pair_strength", Takes::Number(STRENGTH, "1"), "Noncentrality of each effect of a pair."),
    plan_key("effects", Takes::Names(effect_names), "The effects that are hidden."),
    plan_key("rates_rad_s", Takes::Numbers(RATE_RAD_S, "rad/s"), "Standard deviations of the turning rate at release."),
    plan_key("most_effects", Takes::Whole([1.0, MOST_EFFECTS as f64]), "Most effects of a diagnosis."),
    plan_key("ceiling_gain", Takes::Number(CEILING_GAIN, "1"), "Factor on the noncentralities of the ideal observer."),
    plan_key("measures", Takes::Names(measure_names), "The columns."),
    plan_key("description", Takes::Text, "One line about the plan."),
];

/// Keys of a plan of hidden effects.
pub fn plan_keys() -> impl Iterator<Item = PlanKey> {
    OTHERS.into_iter().chain(SEEDS)
}

/// Reads what a plan says of its rows.
///
/// # Errors
/// What it says that cannot be.
pub(in crate::study) fn setting(file: &ImpactFile, files: &dyn Files) -> Result<Recovery, LoadError> {
    let known: Vec<PlanKey> = plan_keys().collect();
    only_known(file, &known, &[])?;
    let base = Model::load_from(BASE, files)?;
    let effects = effects(file, &base)?;
    let strengths = if file.entries.contains_key("strengths") { file.numbers("strengths", STRENGTH, "1")? } else { STRENGTHS.to_vec() };
    each_once(file, "strengths", &strengths)?;
    let mut recovery = Recovery {
        base,
        cases: Vec::new(),
        effects,
        strengths,
        most_effects: whole(file, "most_effects", [1.0, MOST_EFFECTS as f64])?.unwrap_or(MOST_EFFECTS),
        ceiling_gain: file.number("ceiling_gain", CEILING_GAIN, "1")?.unwrap_or(1.0),
    };
    recovery.cases = cases(file, &recovery)?;
    Ok(recovery)
}

/// The columns.
///
/// # Errors
/// When one does not exist.
pub(in crate::study) fn columns(file: &ImpactFile) -> Result<Vec<&'static RecoveryMeasure>, Refusal> {
    let Some(names) = file.texts("measures")? else {
        return Ok(RECOVERY_MEASURES.iter().filter(|measure| measure.is_usual()).collect());
    };
    let known = measure_names();
    let mut columns: Vec<&'static RecoveryMeasure> = Vec::new();
    for name in names {
        let found = RECOVERY_MEASURES.iter().find(|measure| measure.name == name);
        let found = named(file, "measures", "measure", &name, found, &known)?;
        if columns.iter().all(|other| other.name != found.name) {
            columns.push(found);
        }
    }
    Ok(columns)
}

fn measure_names() -> Vec<String> {
    RECOVERY_MEASURES.iter().map(|measure| measure.name.to_string()).collect()
}

/// The effects that may be hidden in drops of any model.
fn effect_names() -> Vec<String> {
    CATALOGUE.iter().filter(|spec| !spec.takes_frame_curve()).map(|spec| spec.id.to_string()).collect()
}

/// The effects that may be hidden alone or in pairs, in the order of the catalogue, in which a diagnosis names sets, too.
fn effects(file: &ImpactFile, base: &Model) -> Result<Vec<&'static Spec>, Refusal> {
    let all = recorded(base);
    let known: Vec<String> = all.iter().map(|spec| spec.id.to_string()).collect();
    let Some(names) = file.texts("effects")? else { return Ok(all) };
    for name in &names {
        named(file, "effects", "effect", name, known.iter().find(|id| *id == name), &known)?;
    }
    Ok(all.into_iter().filter(|spec| names.iter().any(|name| name == spec.id)).collect())
}

fn laws(file: &ImpactFile) -> Result<Vec<ScatterLaw>, Refusal> {
    let Some(names) = file.texts("laws")? else { return Ok(vec![ScatterLaw::Proportional]) };
    each_once(file, "laws", &names)?;
    let known = ScatterLaw::NAMES.map(String::from);
    let one = |name: &String| {
        let found = known.iter().position(|known| known == name).map(|at| ScatterLaw::ALL[at]);
        named(file, "laws", "law", name, found, &known)
    };
    names.iter().map(one).collect()
}

/// The seeds of one kind of truth; none where the plan has no such truths.
fn seeds(file: &ImpactFile, key: &str) -> Result<std::ops::Range<u64>, Refusal> {
    match wholes(file, key, SEED)?.as_deref() {
        None => Ok(0..0),
        Some([first, end]) if first < end => Ok(*first as u64..*end as u64),
        Some(_) => {
            let message = format!("`{key}` is no range of seeds");
            Err(file.refuse(key, impossible(message, "give [FIRST, END], such as [500, 503] for 500, 501 and 502".into())))
        }
    }
}

/// The rows, seed by seed: those of one seed follow each other, as some of their figures have steps in common.
fn cases(file: &ImpactFile, recovery: &Recovery) -> Result<Vec<Case>, Refusal> {
    let levels = wholes(file, "levels", LEVELS)?.unwrap_or_else(|| vec![2]);
    each_once(file, "levels", &levels)?;
    let laws = laws(file)?;
    let pair_strength = file.number("pair_strength", STRENGTH, "1")?.unwrap_or(PAIR_STRENGTH);
    let rates =
        if file.entries.contains_key("rates_rad_s") { file.numbers("rates_rad_s", RATE_RAD_S, "rad/s")? } else { RATES_RAD_S.to_vec() };
    each_once(file, "rates_rad_s", &rates)?;
    let [nothing, one, two, outsiders, sloped, rubbing, heavy, rough, level_ones] = SEEDS.map(|known| seeds(file, known.key));
    let (nothing, one, two, outsiders) = (nothing?, one?, two?, outsiders?);
    let (sloped, rubbing, heavy, rough, level_ones) = (sloped?, rubbing?, heavy?, rough?, level_ones?);
    let singles = || recovery.effects.iter().flat_map(|spec| recovery.strengths.iter().map(move |strength| (*spec, *strength)));
    let count = |seeds: &std::ops::Range<u64>| (seeds.end - seeds.start) as usize;
    let effects = count(&nothing) + count(&one) * singles().count() + count(&two) + count(&outsiders);
    let a_level = effects
        + (count(&sloped) + count(&rubbing) + count(&heavy) + count(&rough)) * rates.len()
        + count(&level_ones) * LandingTruth::LEVEL.len();
    if a_level == 0 || a_level * levels.len() * laws.len() > MOST_ROWS {
        let message = format!("the plan has {} rows", a_level * levels.len() * laws.len());
        let remedy = format!("state between one and {MOST_ROWS} by {}", SEEDS.map(|known| known.key).join(", "));
        return Err(file.refuse("seeds", impossible(message, remedy)));
    }
    let mut cases = Vec::new();
    for (level, law) in levels.iter().flat_map(|level| laws.iter().map(move |law| (*level, *law))) {
        let case = |truth: Truth, strength: Option<f64>, seed: u64| Case { level, law, truth, strength, seed };
        cases.extend(nothing.clone().map(|seed| case(Truth::Nothing, None, seed)));
        cases.extend(one.clone().flat_map(|seed| singles().map(move |(spec, strength)| case(Truth::One(spec), Some(strength), seed))));
        cases.extend(two.clone().filter_map(|seed| Some(case(Truth::Two(pair(&recovery.effects, seed)?), Some(pair_strength), seed))));
        cases.extend(outsiders.clone().map(|seed| case(Truth::Outside(outside(seed)), None, seed)));
        let kinds: [(_, fn(f64) -> _); 4] = [
            (&sloped, LandingTruth::Sloped),
            (&rubbing, LandingTruth::SlopedWithFriction),
            (&heavy, LandingTruth::SlopedOnHeavyFeet),
            (&rough, LandingTruth::SlopedOnRoughGround),
        ];
        for (seeds, landing) in kinds {
            let rates = |seed| rates.iter().map(move |rate| case(Truth::Landing(landing(*rate)), None, seed));
            cases.extend(seeds.clone().flat_map(rates));
        }
        cases.extend(level_ones.clone().flat_map(|seed| LandingTruth::LEVEL.map(|landing| case(Truth::Landing(landing), None, seed))));
    }
    if cases.is_empty() {
        let remedy = "name at least two effects for sets of two, or state seeds of another kind".into();
        return Err(file.refuse("seeds", impossible("the plan has no rows".into(), remedy)));
    }
    Ok(cases)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::files::Memory;

    #[test]
    fn analytic_landings_have_a_row_for_each_seed_and_rate_or_kind() {
        let plan =
            "kind = \"recovery\"\nrates_rad_s = [0.2, 0.3]\n[seeds]\nsloped = [1, 4]\nsloped_with_friction = [4, 5]\nlevel = [7, 9]\n";
        let file = ImpactFile::parse("s.toml", plan).expect("is TOML");
        let recovery = setting(&file, &Memory::default()).expect("is a plan");
        let names: Vec<String> = recovery.cases.iter().map(|case| format!("{} {}", case.seed, case.truth.name())).collect();
        assert_eq!(names.len(), 3 * 2 + 2 + 2 * 4);
        assert_eq!(names[6..8], ["4 landing_tilt 0.2 rad/s, coulomb_friction", "4 landing_tilt 0.3 rad/s, coulomb_friction"]);
        assert_eq!(names[..2], ["1 landing_tilt 0.2 rad/s", "1 landing_tilt 0.3 rad/s"]);
        assert_eq!(names[12..], ["8 level", "8 level, ringing", "8 level, payload_mode", "8 level, stalls"]);
    }

    #[test]
    fn planted_pairs_of_one_effect_are_no_rows() {
        let plan = "kind = \"recovery\"\neffects = [\"preload\"]\n[seeds]\ntwo = [0, 5]\n";
        let file = ImpactFile::parse("s.toml", plan).expect("is TOML");
        let refused = setting(&file, &Memory::default()).err().expect("has no rows");
        assert!(refused.to_string().contains("the plan has no rows"), "{refused}");
    }

    /// A set of two is named as a diagnosis names it, whatever the order in the plan.
    #[test]
    fn regress_pairs_are_in_the_order_of_the_catalogue() {
        let plan = "kind = \"recovery\"\neffects = [\"preload\", \"cubic_stiffness\"]\n[seeds]\none = [1, 2]\ntwo = [1, 40]\n";
        let file = ImpactFile::parse("s.toml", plan).expect("is TOML");
        let recovery = setting(&file, &Memory::default()).expect("is a plan");
        let names: Vec<String> = recovery.cases.iter().map(|case| case.truth.name()).collect();
        assert_eq!(names[..2], ["cubic_stiffness", "cubic_stiffness"], "one seed, two effects, five strengths");
        let pairs: Vec<&String> = names.iter().filter(|name| name.contains('+')).collect();
        assert!((10..39).contains(&pairs.len()) && pairs.iter().all(|name| *name == "cubic_stiffness + preload"), "{pairs:?}");
    }
}
