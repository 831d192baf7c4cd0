//! How far landings as simulated lie from drops that no fit saw.

use nalgebra::DVector;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use super::fitting::{LandingFit, LandingProblem};
use super::height_peaks::HeightPeaks;
use super::legged_body::{Legs, Slopes};
use super::observed::{ObservedLanding, ObservedLandings};
use super::population::Population;
use super::posterior::window_given_touches;
use super::touched_slopes::TouchLikelihood;
use crate::impact::diagnose::{Gap, errors};
use crate::impact::fit::{FitProblem, MeanWave, WaveGroup, Waves};
use crate::impact::measured::Spread;

/// Permutations of the touches among the drops of a height.
const PERMUTED: usize = 199;

/// How far landings as simulated lie from the drops.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct LandingGaps {
    /// Mean waves of random slopes, at the fitted heights.
    pub fitted: Gap,
    /// The same at held-out heights, or at each height, fitted to the others.
    pub held_out: Gap,
    /// 95 % interval of the gap at heights that were named for it, by how well the fitted heights tell legs and slopes, g.
    pub held_out_ci95_g: Option<[f64; 2]>,
    /// The same with the slopes that the touch times of the predicted height itself show: what is left without releases that differ from height
    /// to height.
    pub own_slopes: Gap,
    /// Single drops there, each predicted from its own touches.
    pub given_touches: Gap,
    /// Root mean square of the same when touches are dealt to other drops of the height, median, g.
    pub dealt_g: f64,
    /// p-value of the single drops' error under dealing.
    pub dealt_p: f64,
}

/// Mean windows of a height that no fit saw, and its drops given their touches.
struct Unseen {
    group: WaveGroup,
    predicted: Vec<f64>,
    own_slopes: Vec<f64>,
    left: Vec<DVector<f64>>,
    dealt: Vec<f64>,
}

impl Unseen {
    /// Of one height of a problem.
    fn of(
        problem: &LandingProblem,
        group: &WaveGroup,
        height: usize,
        fit: &LandingFit,
        likely: &[(Slopes, f64)],
        seed: u64,
    ) -> Option<Self> {
        let at = problem.waves.at(&[height]);
        let own = problem.at(&at);
        let tables = own.tables(&fit.legs, &fit.slopes)?;
        let population = Population::likely(&tables[0], likely);
        let predicted = population.mean_window().as_slice().to_vec();
        let left = own.left_by_drops(height, &population);
        let landings = &problem.observed.heights[height];
        let touched = TouchLikelihood::of(&[landings], &tables)?.slopes(problem.parts.at_release);
        let own_slopes = Population::of(&tables[0], &touched.slopes).mean_window().as_slice().to_vec();
        let (drops, read_s) = (&landings.drops, landings.read_s());
        let waves: Vec<DVector<f64>> = drops.iter().map(|drop| window_given_touches(&population, &drop.touches, read_s)).collect();
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut order: Vec<usize> = (0..drops.len()).collect();
        let dealt = (0..PERMUTED).map(|_| {
            order.shuffle(&mut rng);
            let one = |(drop, from): (&ObservedLanding, &usize)| (DVector::from_column_slice(&drop.window) - &waves[*from]).norm_squared();
            drops.iter().zip(&order).map(one).sum::<f64>()
        });
        let dealt = dealt.collect();
        Some(Self { group: group.clone(), predicted, own_slopes, left, dealt })
    }
}

fn gaps_of(unseen: &[Unseen], fitted: Gap) -> LandingGaps {
    let means: Vec<Vec<f64>> = unseen.iter().map(|one| errors(&one.group)).collect();
    let of_means = |predicted: fn(&Unseen) -> &[f64]| {
        Gap::between(
            unseen.iter().zip(&means).map(|(one, errors)| (&one.group.mean[..], predicted(one), &errors[..], one.group.windows.len())),
        )
    };
    let (held_out, own_slopes) = (of_means(|one| &one.predicted), of_means(|one| &one.own_slopes));
    let groups: Vec<WaveGroup> = unseen.iter().map(residual_group).collect();
    let left_errors: Vec<Vec<f64>> = groups.iter().map(errors).collect();
    let zeros = vec![0.0; groups.first().map_or(0, |group| group.mean.len())];
    let given_touches = Gap::between(
        groups.iter().zip(&left_errors).map(|(group, errors)| (&group.mean[..], &zeros[..], &errors[..], group.windows.len())),
    );
    let sum: f64 = unseen.iter().flat_map(|one| &one.left).map(DVector::norm_squared).sum();
    let count: usize = unseen.iter().flat_map(|one| &one.left).map(DVector::len).sum();
    let mut dealt: Vec<f64> = (0..PERMUTED).map(|at| unseen.iter().map(|one| one.dealt[at]).sum()).collect();
    dealt.sort_by(f64::total_cmp);
    let as_small = dealt.partition_point(|other| *other <= sum);
    LandingGaps {
        fitted,
        held_out,
        held_out_ci95_g: None,
        own_slopes,
        given_touches,
        dealt_g: (dealt[PERMUTED / 2] / count.max(1) as f64).sqrt(),
        dealt_p: (as_small + 1) as f64 / (PERMUTED + 1) as f64,
    }
}

/// What is left of each drop, as a group of its own.
fn residual_group(one: &Unseen) -> WaveGroup {
    let windows: Vec<Vec<f64>> = one.left.iter().map(|left| left.as_slice().to_vec()).collect();
    let count = windows.len().max(1) as f64;
    let samples = one.predicted.len();
    let mean = (0..samples).map(|i| windows.iter().map(|window| window[i]).sum::<f64>() / count).collect();
    WaveGroup { trials: one.group.trials.clone(), windows, mean, ..one.group }
}

fn fitted_gap(problem: &LandingProblem, waves: &Waves, fit: &LandingFit) -> Option<Gap> {
    let predicted = problem.mean_windows(&fit.legs, &fit.slopes)?;
    let samples = problem.waves.expected.samples;
    let each: Vec<Vec<f64>> = waves.groups.iter().map(errors).collect();
    let parts = waves.groups.iter().zip(&each).enumerate().map(|(at, (group, errors))| {
        (&group.mean[..], &predicted.as_slice()[at * samples..(at + 1) * samples], &errors[..], group.windows.len())
    });
    Some(Gap::between(parts))
}

/// Of drops from one height: there is no other that could be predicted.
pub(super) fn gaps_of_one_height(problem: &LandingProblem, waves: &Waves, fit: &LandingFit) -> Option<LandingGaps> {
    let fitted = fitted_gap(problem, waves, fit)?;
    Some(LandingGaps {
        fitted,
        held_out: Gap::UNKNOWN,
        held_out_ci95_g: None,
        own_slopes: Gap::UNKNOWN,
        given_touches: Gap::UNKNOWN,
        dealt_g: f64::NAN,
        dealt_p: 1.0,
    })
}

/// A height, m, with its mean wave and the predicted one, g.
pub type Window = (f64, Vec<f64>, Vec<f64>);

/// At heights that were named for it, with their waves.
pub fn held_out_gaps(
    problem: &LandingProblem,
    fitted: &Waves,
    fit: &LandingFit,
    held: &Waves,
    touches: &ObservedLandings,
    seed: u64,
) -> Option<(LandingGaps, Vec<Window>)> {
    let waves = waves_of(problem, held);
    let touches = as_read(problem, fit, held, touches)?;
    let other = LandingProblem { waves: &waves, observed: &touches, ..problem.clone() };
    let likely = problem.likely_slopes(fit)?;
    let unseen: Option<Vec<Unseen>> =
        held.groups.iter().enumerate().map(|(height, group)| Unseen::of(&other, group, height, fit, &likely, seed)).collect();
    let unseen = unseen?;
    let windows = unseen.iter().map(|one| (one.group.height_m, one.group.mean.clone(), one.predicted.clone())).collect();
    Some((gaps_of(&unseen, fitted_gap(problem, fitted, fit)?), windows))
}

/// Touches of heights that no fit saw, with how they are read there.
pub fn as_read(problem: &LandingProblem, fit: &LandingFit, held: &Waves, touches: &ObservedLandings) -> Option<ObservedLandings> {
    let waves = waves_of(problem, held);
    let unread = LandingProblem { waves: &waves, observed: touches, ..problem.clone() };
    let errors = touches.with_errors(&unread.tables(&fit.legs, &fit.slopes)?, &fit.slopes);
    Some(errors.read_no_better(problem.observed.least_read_s()))
}

/// Peaks of heights that no fit saw, beside those of landings of the fitted legs there.
pub fn held_out_peaks(problem: &LandingProblem, fit: &LandingFit, held: &Waves, touches: &ObservedLandings) -> Option<Vec<HeightPeaks>> {
    let waves = waves_of(problem, held);
    let tables = problem.at(&waves).tables(&fit.legs, &fit.slopes)?;
    Some(touches.heights.iter().zip(tables.iter()).filter_map(|(height, table)| HeightPeaks::of(height, table)).collect())
}

/// Waves of other heights than the fitted ones; whitening is of these, and not asked for.
fn waves_of(problem: &LandingProblem, held: &Waves) -> FitProblem {
    FitProblem { means: held.groups.iter().map(MeanWave::of).collect(), chosen: (0..held.groups.len()).collect(), ..problem.waves.clone() }
}

/// The middle 95 % of the gaps that legs and slopes leave which may be the true ones, g; `None` where a landing is lost.
pub fn held_out_ci95_g(problem: &LandingProblem, held: &Waves, may_be: &[(Legs, Slopes)]) -> Option<[f64; 2]> {
    let waves = waves_of(problem, held);
    let there = problem.at(&waves);
    let means: Vec<Vec<f64>> = held.groups.iter().map(errors).collect();
    let samples = waves.expected.samples;
    let gap = |(legs, slopes): &(Legs, Slopes)| {
        let predicted = there.mean_windows(legs, slopes)?;
        let each = held.groups.iter().zip(&means).zip(predicted.as_slice().chunks(samples));
        let between = Gap::between(each.map(|((group, errors), predicted)| (&group.mean[..], predicted, &errors[..], group.windows.len())));
        Some(between.net_g)
    };
    Spread::middle(may_be.iter().map(gap).collect::<Option<Vec<f64>>>()?, 0.95)
}

/// At each height, fitted to the others.
pub fn left_out_gaps(problem: &LandingProblem, fitted: &Waves, fit: &LandingFit, seed: u64) -> Option<LandingGaps> {
    let all = problem.waves.chosen.clone();
    let mut unseen = Vec::new();
    for out in &all {
        let others: Vec<usize> = all.iter().copied().filter(|height| height != out).collect();
        let waves = problem.waves.at(if others.is_empty() { &all } else { &others });
        let of_others = problem.at(&waves);
        let refit = if others.is_empty() { fit.clone() } else { of_others.fitted(Some(fit))? };
        unseen.push(Unseen::of(problem, &fitted.groups[*out], *out, &refit, &of_others.likely_slopes(&refit)?, seed)?);
    }
    Some(gaps_of(&unseen, fitted_gap(problem, fitted, fit)?))
}
