//! What nobody reaches: the share of names that are right when the judge is told everything but the trial variation that happened.
//!
//! The judge of one seed knows its truths (every effect and strength, all parameters but k and c), what each reads without
//! noise, and the covariance of the mean waves, and weighs them by Bayes' rule, all equally likely; k and c have an even
//! prior and are integrated out along their tangent at the best fit. It says nothing where the drops are as likely
//! as those of a null, at the level at which 5 % of nulls alarm. No rule that looks at mean waves has more names right on these
//! truths. What it does not see: how single records vary about their mean; a line a truth says how much that would add
//! for somebody who knows its law.

use std::collections::BTreeMap;

use flexframe::impact::effects::Model;
use flexframe::impact::fit::{FitProblem, Layout, inverse_root};
use flexframe::impact::synthetic::Plan;
use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::covariance::{covariances, exact};
use crate::strength::recorded;
use crate::truth::{DETECTABLE, STRENGTHS, at_strength, base, plan};

/// Replicates that alarm.
const ALARMS: f64 = 0.05;
/// Draws of the trial variation a truth.
const DRAWS: usize = 400;
/// The same for the null.
const NULL_DRAWS: usize = 4000;

/// A truth of the set.
struct Truth {
    id: &'static str,
    /// Index of its strength.
    at: usize,
    plan: Plan,
    /// Noncentrality.
    apart: f64,
}

impl Truth {
    fn detectable(&self) -> bool {
        self.apart > DETECTABLE
    }
}

/// A hypothesis as seen from a truth: its k and c refitted to the truth's mean waves.
struct Seen {
    /// Whitened difference of the means.
    apart: DVector<f64>,
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
        Some(Self { apart: fitted.minimum.residual * gain.sqrt(), tangent, worth, model })
    }

    /// Logarithm of the likelihood, but for what is common to all.
    fn weight(&self, noise: &DVector<f64>) -> f64 {
        let all = &self.apart + noise;
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
    let nulls = covariances(&Plan { model: null.clone(), ..truth.clone() })?;
    let one = |(own, null): (&DMatrix<f64>, &DMatrix<f64>)| {
        let inverse = inverse_root(null)?;
        let white = &inverse * own * inverse.transpose();
        let spread: f64 = white.symmetric_eigenvalues().iter().map(|one| one - 1.0 - libm::log(*one)).sum();
        Some((truth.drops - 1) as f64 * spread)
    };
    covariances(truth)?.iter().zip(&nulls).map(one).sum()
}

/// What the judge says.
struct Judged {
    /// The best-supported effect.
    id: &'static str,
    /// Logarithm of its weight over that of the null.
    over_null: f64,
    /// The best-supported effect for somebody who is told as well that it is detectable.
    detectable: &'static str,
}

fn judged(seen: &[Seen], truths: &[Truth], rng: &mut Pcg64) -> Judged {
    let noise = DVector::from_fn(seen[0].apart.len(), |_, _| StandardNormal.sample(rng));
    let weights: Vec<f64> = seen.iter().map(|one| one.weight(&noise)).collect();
    let most = weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let best = |of: &dyn Fn(&Truth) -> bool| {
        let mut by_id: BTreeMap<&'static str, f64> = BTreeMap::new();
        for (truth, weight) in truths.iter().zip(&weights[1..]).filter(|(truth, _)| of(truth)) {
            *by_id.entry(truth.id).or_default() += libm::exp(weight - most);
        }
        by_id.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or(("", 0.0))
    };
    let (id, sum) = best(&|_| true);
    Judged { id, over_null: libm::log(sum.max(1e-300)) + most - weights[0], detectable: best(&Truth::detectable).0 }
}

#[derive(Default)]
struct Sums {
    right: [f64; STRENGTHS.len()],
    all: [f64; STRENGTHS.len()],
    /// Without the null: first in the ranking.
    first: [f64; STRENGTHS.len()],
    detectable: [f64; 3],
    by_id: BTreeMap<&'static str, [f64; 2]>,
}

/// Prints the ceiling of some seeds at a level.
///
/// `gain` multiplies what the mean waves tell, as somebody might know who reads more than means.
pub fn ceiling(level: usize, from: u64, to: u64, gain: f64) {
    let mut sums = Sums::default();
    for seed in from..to {
        let truths = truths(level, seed);
        let null = plan(level, 7919 * seed + 17);
        let hypotheses: Vec<&Model> = std::iter::once(&null.model).chain(truths.iter().map(|truth| &truth.plan.model)).collect();
        let Some(of_null) = seen(&null, &hypotheses, gain) else { continue };
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut over: Vec<f64> = (0..NULL_DRAWS).map(|_| judged(&of_null, &truths, &mut rng).over_null).collect();
        over.sort_by(f64::total_cmp);
        let needed = over[((1.0 - ALARMS) * NULL_DRAWS as f64) as usize];
        let shares: Vec<Option<Share>> =
            truths.par_iter().map(|truth| Share::of(truth, &truths, &seen(&truth.plan, &hypotheses, gain)?, needed)).collect();
        for (truth, share) in truths.iter().zip(shares) {
            let Some(share) = share else { continue };
            let Share { right, first, detectable, in_covariance } = share;
            let (id, strength, apart) = (truth.id, STRENGTHS[truth.at], truth.apart);
            println!(
                "{id} {strength} seed {seed}: noncentrality {apart:.0}, in the trial covariance {in_covariance:.0}, right {right:.3}, first {first:.3}, told detectable {detectable:.3}"
            );
            sums.add(truth, &share);
        }
    }
    sums.print(level);
}

fn truths(level: usize, seed: u64) -> Vec<Truth> {
    let all: Vec<(&'static str, usize)> =
        recorded(&base()).into_iter().flat_map(|spec| (0..STRENGTHS.len()).map(|at| (spec.id, at))).collect();
    let null = plan(level, 7919 * seed + 17).model;
    let one = |(id, at): (&'static str, usize)| {
        let plan = at_strength(id, seed, STRENGTHS[at], level)?;
        let apart = Seen::of(&exact(&plan)?, &null, 1.0)?.apart.norm_squared();
        Some(Truth { id, at, plan, apart })
    };
    all.into_par_iter().filter_map(one).collect()
}

/// Shares of draws of one truth.
struct Share {
    /// Named, and rightly.
    right: f64,
    /// First in the ranking, alarm or not.
    first: f64,
    /// First among the detectable truths.
    detectable: f64,
    /// What the trial covariance of single records would tell from the null in addition, noncentrality.
    in_covariance: f64,
}

impl Share {
    fn of(truth: &Truth, truths: &[Truth], seen: &[Seen], needed: f64) -> Option<Self> {
        let mut rng = Pcg64::seed_from_u64(truth.plan.seed);
        let mut share = Self { right: 0.0, first: 0.0, detectable: 0.0, in_covariance: in_covariance(&truth.plan, &seen[0].model)? };
        let one = |good: bool| f64::from(u8::from(good)) / DRAWS as f64;
        for _ in 0..DRAWS {
            let judged = judged(seen, truths, &mut rng);
            share.first += one(judged.id == truth.id);
            share.right += one(judged.id == truth.id && judged.over_null > needed);
            share.detectable += one(judged.detectable == truth.id);
        }
        Some(share)
    }
}

impl Sums {
    fn add(&mut self, truth: &Truth, share: &Share) {
        self.right[truth.at] += share.right;
        self.first[truth.at] += share.first;
        self.all[truth.at] += 1.0;
        if truth.detectable() {
            let own = self.by_id.entry(truth.id).or_default();
            (own[0], own[1]) = (own[0] + share.detectable, own[1] + 1.0);
            self.detectable = [self.detectable[0] + share.right, self.detectable[1] + share.detectable, self.detectable[2] + 1.0];
        }
    }

    fn print(&self, level: usize) {
        let sum = |of: &[f64]| of.iter().sum::<f64>();
        let ratios = |of: &[f64; STRENGTHS.len()]| std::array::from_fn::<f64, { STRENGTHS.len() }, _>(|at| of[at] / self.all[at]);
        for (id, [right, all]) in &self.by_id {
            println!("CEILING level {level}: detectable {id} {right:.1}/{all}");
        }
        println!(
            "CEILING level {level}: of all {:.3}, four stronger {:.3}",
            sum(&self.right) / sum(&self.all),
            sum(&self.right[1..]) / sum(&self.all[1..])
        );
        println!("CEILING level {level}: first in the ranking of all {:.3}", sum(&self.first) / sum(&self.all));
        println!("CEILING level {level}: by strength {:.3?}, first {:.3?}", ratios(&self.right), ratios(&self.first));
        println!(
            "CEILING level {level}: of {} detectable {:.3}, told that it is detectable {:.3}",
            self.detectable[2],
            self.detectable[0] / self.detectable[2],
            self.detectable[1] / self.detectable[2]
        );
    }
}
