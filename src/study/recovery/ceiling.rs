//! The upper bound of accuracy: the share of right names for an ideal observer who knows everything except the realised trial variation.
//!
//! The judge of one seed knows its truths (every effect and strength, all parameters but k and c), what each reads without
//! noise, and the covariance of the mean waves, and weighs them by Bayes' rule, all equally likely; k and c have an even
//! prior and are integrated out along their tangent at the best fit. It says nothing where the drops are as likely
//! as those of a null, at the level at which 5 % of nulls alarm. No rule that looks at mean waves has more names right on these
//! truths. What it does not see: how single records vary about their mean; [`ObserverShare::in_covariance`] says how much that would add
//! for somebody who knows its law.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::covariance::{covariances, exact};
use super::setting::Recovery;
use super::truth::Truths;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Layout, inverse_root};
use crate::impact::synthetic::{Plan, ScatterLaw};

/// Replicates that alarm.
const ALARMS: f64 = 0.05;
/// Draws of the trial variation a truth.
const DRAWS: usize = 400;
/// The same for the null.
const NULL_DRAWS: usize = 4000;
/// Noncentrality beyond which an effect is detectable.
pub(super) const DETECTABLE: f64 = 30.0;

/// A truth of the set.
struct Hypothesis {
    id: &'static str,
    strength: f64,
    plan: Plan,
    /// Noncentrality.
    noncentrality: f64,
}

impl Hypothesis {
    fn is_detectable(&self) -> bool {
        self.noncentrality > DETECTABLE
    }
}

/// A hypothesis as seen from a truth: its k and c refitted to the truth's mean waves.
struct Seen {
    /// Whitened difference of the means.
    residual: DVector<f64>,
    /// Orthonormal basis of the change with k and c.
    tangent: DMatrix<f64>,
    /// Half the logarithm of how much k and c are worth.
    worth: f64,
    /// With the refitted k and c.
    model: Model,
}

impl Seen {
    fn of(problem: &FitProblem, model: &Model, gain: f64) -> Option<Self> {
        let fitted = problem.fit(Layout::named(model.clone(), &["k", "c"])?, 12)?;
        let (model, jacobian) = (fitted.model().clone(), fitted.minimum.jacobian);
        let normal = jacobian.transpose() * &jacobian;
        let root = normal.cholesky()?;
        let worth = root.l().diagonal().iter().map(|one| libm::log(*one)).sum();
        let tangent = root.l().solve_lower_triangular(&jacobian.transpose())?.transpose();
        Some(Self { residual: fitted.minimum.residual * gain.sqrt(), tangent, worth, model })
    }

    /// Logarithm of the likelihood, but for what is common to all.
    fn weight(&self, noise: &DVector<f64>) -> f64 {
        let all = &self.residual + noise;
        -0.5 * (all.norm_squared() - self.tangent.tr_mul(&all).norm_squared()) - self.worth
    }
}

/// What the drops of one truth look like to the judge: every hypothesis, the null first.
fn seen(truth: &Plan, hypotheses: &[&Model], gain: f64) -> Option<Vec<Seen>> {
    let problem = exact(truth)?;
    hypotheses.iter().map(|model| Seen::of(&problem, model, gain)).collect()
}

/// What the trial covariance of single records tells from the null in addition, in units of noncentrality: twice the divergence of Wishart
/// densities (S. Kullback, *Information Theory and Statistics*, chapter 9) for somebody who knows the covariance's law.
fn in_covariance(truth: &Plan, null: &Model) -> Option<f64> {
    let null_covariances = covariances(&Plan { model: null.clone(), ..truth.clone() })?;
    let one = |(own, null): (&DMatrix<f64>, &DMatrix<f64>)| {
        let inverse = inverse_root(null)?;
        let white = &inverse * own * inverse.transpose();
        let spread: f64 = white.symmetric_eigenvalues().iter().map(|one| one - 1.0 - libm::log(*one)).sum();
        Some((truth.drops - 1) as f64 * spread)
    };
    covariances(truth)?.iter().zip(&null_covariances).map(one).sum()
}

/// What the judge says.
struct Judged {
    /// The best-supported effect.
    id: &'static str,
    /// Logarithm of its weight over that of the null.
    over_null: f64,
    /// The effect with the largest posterior probability, given that it is detectable.
    detectable: &'static str,
}

fn judged(seen: &[Seen], truths: &[Hypothesis], rng: &mut Pcg64) -> Judged {
    let noise = DVector::from_fn(seen[0].residual.len(), |_, _| StandardNormal.sample(rng));
    let weights: Vec<f64> = seen.iter().map(|one| one.weight(&noise)).collect();
    let most = weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let best = |of: &dyn Fn(&Hypothesis) -> bool| {
        let mut by_id: BTreeMap<&'static str, f64> = BTreeMap::new();
        for (truth, weight) in truths.iter().zip(&weights[1..]).filter(|(truth, _)| of(truth)) {
            *by_id.entry(truth.id).or_default() += libm::exp(weight - most);
        }
        by_id.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(("", 0.0))
    };
    let (id, sum) = best(&|_| true);
    Judged { id, over_null: libm::log(sum.max(1e-300)) + most - weights[0], detectable: best(&Hypothesis::is_detectable).0 }
}

/// The judge of one seed, at one level of noise.
pub(super) struct Judge {
    truths: Vec<Hypothesis>,
    null: Model,
    /// Logarithm of the weight over the null that a name needs.
    needed: f64,
    gain: f64,
}

/// Shares of draws of one truth.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObserverShare {
    /// Named, and rightly.
    pub right: f64,
    /// First in the ranking, alarm or not.
    pub first: f64,
    /// First among the detectable truths, where it is one.
    pub detectable: Option<f64>,
    /// What the trial covariance of single records would tell from the null in addition, noncentrality.
    pub in_covariance: f64,
}

impl Judge {
    /// The judge of a seed; `None` where the null cannot be fitted, or noise is not in proportion to the reading.
    pub fn of(recovery: &Recovery, level: usize, law: ScatterLaw, seed: u64) -> Option<Self> {
        if law != ScatterLaw::Proportional {
            return None;
        }
        let makes = Truths { base: &recovery.base, law };
        let null = makes.plain(level, 7919 * seed + 17);
        let truths = truths(recovery, makes, level, seed, &null.model);
        let gain = recovery.ceiling_gain;
        let of_null = seen(&null, &hypotheses(&null.model, &truths), gain)?;
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut over: Vec<f64> = (0..NULL_DRAWS).map(|_| judged(&of_null, &truths, &mut rng).over_null).collect();
        over.sort_by(f64::total_cmp);
        let needed = over[((1.0 - ALARMS) * NULL_DRAWS as f64) as usize];
        Some(Self { truths, null: null.model, needed, gain })
    }

    /// How often it would be right on a truth.
    pub fn share(&self, id: &str, strength: f64) -> Option<ObserverShare> {
        let truth = self.truths.iter().find(|truth| truth.id == id && truth.strength == strength)?;
        let seen = seen(&truth.plan, &hypotheses(&self.null, &self.truths), self.gain)?;
        let mut rng = Pcg64::seed_from_u64(truth.plan.seed);
        let in_covariance = in_covariance(&truth.plan, &seen[0].model)?;
        let mut counts = [0_usize; 3];
        for _ in 0..DRAWS {
            let judged = judged(&seen, &self.truths, &mut rng);
            let is_first = judged.id == truth.id;
            let found = [is_first && judged.over_null > self.needed, is_first, judged.detectable == truth.id];
            counts.iter_mut().zip(found).for_each(|(count, good)| *count += usize::from(good));
        }
        let [right, first, detectable] = counts.map(|count| count as f64 / DRAWS as f64);
        Some(ObserverShare { right, first, detectable: truth.is_detectable().then_some(detectable), in_covariance })
    }
}

/// The null first.
fn hypotheses<'a>(null: &'a Model, truths: &'a [Hypothesis]) -> Vec<&'a Model> {
    std::iter::once(null).chain(truths.iter().map(|truth| &truth.plan.model)).collect()
}

fn truths(recovery: &Recovery, makes: Truths, level: usize, seed: u64, null: &Model) -> Vec<Hypothesis> {
    let of_spec = |id: &'static str| recovery.strengths.iter().map(move |strength| (id, *strength));
    let all: Vec<(&'static str, f64)> = recovery.effects.iter().flat_map(|spec| of_spec(spec.id)).collect();
    let one = |(id, strength): (&'static str, f64)| {
        let plan = makes.one(id, seed, strength, level)?;
        let noncentrality = Seen::of(&exact(&plan)?, null, 1.0)?.residual.norm_squared();
        Some(Hypothesis { id, strength, plan, noncentrality })
    };
    all.into_par_iter().filter_map(one).collect()
}
