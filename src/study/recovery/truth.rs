//! What is hidden in the drops of a row: nothing, an effect at a stated strength, two, something outside of the catalogue, or landings that
//! are not level.

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::landing_truth::LandingTruth;
use super::noise_free::noncentrality;
use super::strength;
use crate::impact::effects::{Model, Spec, by_id};
use crate::impact::synthetic::{Hidden, Plan, ScatterLaw, TrialVariation};

/// Heights of the drops, m.
const HEIGHTS_M: [f64; 3] = [0.5, 1.0, 1.5];
/// Levels of noise: see [`Truths::plain`].
pub(super) const LEVELS: [f64; 2] = [1.0, 3.0];
/// The level at which a strength is what it is called.
const LEVEL_OF_STRENGTHS: usize = 2;

/// What is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// Nothing: k and c alone differ from the model that is diagnosed.
    Nothing,
    /// An effect of the catalogue.
    One(&'static Spec),
    /// Two, in the order of the catalogue.
    Two([&'static Spec; 2]),
    /// Something that the catalogue does not have.
    Outside(Hidden),
    /// Landings, in drops with lateral axes.
    Landing(LandingTruth),
}

impl Truth {
    /// Its name in the table.
    pub fn name(&self) -> String {
        match self {
            Self::Nothing => "nothing".into(),
            Self::One(spec) => spec.id.into(),
            Self::Two(_) => self.ids().join(" + "),
            Self::Outside(hidden) => hidden.name().into(),
            Self::Landing(landing) => landing.name(),
        }
    }

    /// Ids of its effects, in the order of the catalogue.
    pub fn ids(&self) -> Vec<&'static str> {
        match self {
            Self::Nothing | Self::Outside(_) | Self::Landing(_) => Vec::new(),
            Self::One(spec) => vec![spec.id],
            Self::Two(specs) => specs.map(|spec| spec.id).to_vec(),
        }
    }
}

/// Two random effects, in the order of the catalogue; none if the same effect is drawn twice.
pub(super) fn pair(all: &[&'static Spec], seed: u64) -> Option<[&'static Spec; 2]> {
    let mut rng = Pcg64::seed_from_u64(seed + 4242);
    let (a, b) = (rng.random_range(0..all.len()), rng.random_range(0..all.len()));
    (a != b).then(|| [all[a.min(b)], all[a.max(b)]])
}

/// An effect outside the catalogue: four kinds in turn, with random parameters.
pub(super) fn outside(seed: u64) -> Hidden {
    let mut rng = Pcg64::seed_from_u64(seed + 999);
    let strength = libm::exp(rng.random_range(0.0..1.5));
    match seed % 4 {
        0 => Hidden::TwoStage { x1_m: rng.random_range(0.004..0.010), stiffness_n_m: 6e3 * strength, loss: rng.random_range(0.6..0.95) },
        1 => Hidden::TwoModes {
            shares: [0.08 * strength, 0.08 * strength],
            f_hz: [rng.random_range(60.0..110.0), rng.random_range(150.0..300.0)],
            zeta: 0.04,
        },
        2 => Hidden::Wear { loss: 0.25 * strength },
        _ => Hidden::Snap { x1_m: rng.random_range(0.003..0.009), loss: (0.15 * strength).min(0.8) },
    }
}

/// Makes truths: on a base model, under a law of the scatter.
#[derive(Clone, Copy)]
pub(super) struct Truths<'a> {
    /// The model that is diagnosed.
    pub base: &'a Model,
    /// The law.
    pub law: ScatterLaw,
}

impl Truths<'_> {
    /// Drops in which nothing is hidden, k and c a little different for every seed. Level 1: 80 drops a height and noise of a half;
    /// level 2: 20 and a tenth; level 3: as 2, and k and c vary by a tenth from drop to drop.
    pub fn plain(&self, level: usize, seed: u64) -> Plan {
        let (drops, share) = if level == 1 { (80, 0.5) } else { (20, 0.1) };
        let varied = if level == 3 { 0.1 } else { 0.0 };
        let mut rng = Pcg64::seed_from_u64(seed ^ 0x5eed);
        let model = self.base.scaled([rng.random_range(0.8..1.25), rng.random_range(0.8..1.25)]);
        let variation = TrialVariation { share, law: self.law, correlation_s: 1.5e-3, stiffness: varied, damping: varied, tilt_deg: 0.0 };
        Plan {
            model,
            hidden: None,
            heights_m: HEIGHTS_M.to_vec(),
            drops,
            scatter: variation,
            noise_g: 0.17,
            counts_per_g: 8.877,
            rate_hz: 1000.0,
            stalls: None,
            landings: None,
            seed,
        }
    }

    /// Drops with an effect at a strength, its noncentrality at level 2; at level 3 the sensor tilts by 5° from drop to drop, too.
    /// `None` when the bounds of the effect do not allow it.
    pub fn one(&self, id: &str, seed: u64, strength: f64, level: usize) -> Option<Plan> {
        let own = |amount: f64, level: usize| {
            let mut plan = self.plain(level, 7919 * seed + 17);
            plan.model = with(&plan.model, id, amount, &mut Pcg64::seed_from_u64(seed * 31 + 5))?;
            plan.seed = seed * 977 + strength as u64;
            Some(plan)
        };
        let (mut low, mut high) = (1e-3_f64, 30.0_f64);
        for _ in 0..12 {
            let middle = (low * high).sqrt();
            let enough = own(middle, LEVEL_OF_STRENGTHS).is_none_or(|plan| noncentrality(&plan).is_none_or(|found| found > strength));
            if enough { high = middle } else { low = middle }
        }
        let reached = noncentrality(&own(low, LEVEL_OF_STRENGTHS)?)?;
        if reached < 0.7 * strength {
            return None;
        }
        let mut plan = own(low, level)?;
        if level == 3 {
            plan.scatter.tilt_deg = 5.0;
        }
        Some(plan)
    }

    /// Drops with two effects, each at a strength of its own; without tilt.
    pub fn two(&self, specs: [&'static Spec; 2], seed: u64, strength: f64, level: usize) -> Option<Plan> {
        let mut plan = self.one(specs[0].id, seed, strength, level)?;
        let second = self.one(specs[1].id, seed, strength, level)?;
        let added = second.model.effects.into_iter().find(|listed| listed.spec.id == specs[1].id)?;
        plan.model = plan.model.with(added.spec, &added.values, added.word);
        plan.scatter.tilt_deg = 0.0;
        Some(plan)
    }
}

/// An effect of the given amount, with its other parameters drawn at random.
fn with(model: &Model, id: &str, amount: f64, rng: &mut impl Rng) -> Option<Model> {
    let spec = by_id(id)?;
    let values = strength::values(id, model, amount, rng)?;
    // The library's least stiffness of a stop; the catalogue lets it vanish.
    let inside = (id != "bottoming" || values[1] >= 1e4)
        && spec.parameters.iter().zip(&values).all(|(parameter, value)| (parameter.min..=parameter.max).contains(value));
    inside.then(|| model.clone().with(spec, &values, 0))
}
