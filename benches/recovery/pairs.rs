//! Two effects at once: is the set found exactly, and could it be.

use flexframe::impact::diagnose::Search;
use flexframe::impact::effects::CATALOGUE;
use flexframe::impact::synthetic::Plan;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::case::diagnosed;
use crate::truth::{DETECTABLE, at_strength, catalogue};

/// Strength of each at the middle level.
const STRENGTH: f64 = 400.0;

/// A pair by chance, in the order of the catalogue; `None` where it is no pair or the bounds do not allow it.
fn pair(level: usize, seed: u64) -> Option<(Plan, [&'static str; 2])> {
    let mut rng = Pcg64::seed_from_u64(seed + 4242);
    let (a, b) = (rng.random_range(0..CATALOGUE.len()), rng.random_range(0..CATALOGUE.len()));
    if a == b {
        return None;
    }
    let mut plan = at_strength(CATALOGUE[a].id, seed, STRENGTH, level)?;
    let second = at_strength(CATALOGUE[b].id, seed, STRENGTH, level)?;
    let added = second.model.effects.into_iter().find(|listed| listed.spec.id == CATALOGUE[b].id)?;
    plan.model = plan.model.with(added.spec, &added.values, added.word);
    plan.scatter.tilt_deg = 0.0;
    Some((plan, [CATALOGUE[a.min(b)].id, CATALOGUE[a.max(b)].id]))
}

/// What each of the two leaves alone, and what the nearest other set leaves with its name, all without noise.
fn apart(search: &Search, truth: [&'static str; 2]) -> ([f64; 2], f64, String) {
    let all = || search.levels.iter().flat_map(|level| &level.candidates);
    let alone = |id: &str| all().find(|one| one.ids() == [id]).map_or(f64::INFINITY, |one| one.fitted.chi2());
    let others = all().filter(|one| !one.ids().is_empty() && one.ids() != truth);
    let rival = others.min_by(|a, b| a.score.total_cmp(&b.score));
    (truth.map(alone), rival.map_or(f64::INFINITY, |one| one.fitted.chi2()), rival.map_or(String::new(), |one| one.ids().join(" + ")))
}

/// Ten pairs a seed.
pub fn pairs(level: usize, from: u64, to: u64) {
    let (mut exact, mut second, mut distinct) = ([0; 2], [0; 2], [0; 2]);
    for seed in 10 * from..10 * to {
        let Some((plan, truth)) = pair(level, seed) else { continue };
        let Some((alone, left, rival)) = catalogue(&plan).map(|search| apart(&search, truth)) else { continue };
        let case = diagnosed(&plan);
        let good = case.set() == truth;
        let count = |sum: &mut [usize; 2], counts: bool| {
            if counts {
                *sum = [sum[0] + usize::from(good), sum[1] + 1];
            }
        };
        count(&mut exact, true);
        count(&mut second, alone.iter().all(|left| *left > DETECTABLE));
        count(&mut distinct, left > DETECTABLE);
        let word = if good { "ok " } else { "BAD" };
        println!("{word} pair {seed} {truth:?}: alone {:.0} {:.0}, {rival} leaves {left:.1}: {}", alone[0], alone[1], case.line());
    }
    println!("PAIRS level {level}: {}/{} exact", exact[0], exact[1]);
    println!("PAIRS level {level}: {}/{} of those where each alone leaves more than 30", second[0], second[1]);
    println!("PAIRS level {level}: {}/{} of those from which every other set is more than 30 away", distinct[0], distinct[1]);
}
