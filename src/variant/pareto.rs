//! A Pareto front: frames of which none is better than another in every goal.
//!
//! Descents make each goal small by itself, then sums of the goals by weights between; a sum finds no point in a hollow of the
//! front, but every frame that was looked at on the way is a candidate. The front is what is left of them when those that another
//! beats, and those that violate a rule, are taken out. It is a set of known frames: nothing is said of what lies between.

use super::aim::{Aim, direction};
use super::descent::{REGION, descend};
use super::ended::Ended;
use super::feasible::find;
use super::goal::broken;
use super::measures::{Evaluation, Measure};
use super::problem::{SearchProblem, SolveError, Vary};
use super::search::{Search, ranked};
use super::solve::{ended, start_values};
use crate::checks::{CATALOGUE, Cost};
use crate::params::Frame;

/// Number of points of the front that are checked by every rule and reported.
const MOST: usize = 16;

/// A frame on the front.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontPoint {
    /// What varied, in the order of the problem.
    pub values: Vec<f64>,
    /// The goals, in their order.
    pub goals: Vec<f64>,
}

/// A front.
pub struct Front {
    /// The goals.
    pub goals: Vec<&'static Measure>,
    /// What varied.
    pub vary: Vec<Vary>,
    /// The frames, by the first goal.
    pub points: Vec<FrontPoint>,
    /// How many frames were looked at.
    pub looked_at: usize,
    /// Why the search ended.
    pub ended: Ended,
}

/// Searches for the front of two or three goals. The problem's aim is not asked.
///
/// # Errors
/// When the frame is refused, or no frame that was looked at keeps every limit.
pub fn front(problem: &SearchProblem, goals: &[&'static Measure]) -> Result<Front, SolveError> {
    let before = Frame::resolve(problem.file).map_err(|refusal| SolveError::Problem(refusal.to_string()))?;
    problem.can_vary(&before)?;
    let start = start_values(&problem.vary, &before);
    let mut search = Search::new(problem, &CATALOGUE);
    search.aim_at(weighted(goals, &vec![1.0; goals.len()]));
    search.scale_by(before);
    find(&search, &start);
    let alone: Vec<Vec<f64>> =
        (0..goals.len()).map(|goal| (0..goals.len()).map(|at| if at == goal { 1.0 } else { 0.02 }).collect()).collect();
    let between = between(goals.len());
    let count = alone.len() + between.len();
    for (at, weights) in alone.iter().chain(&between).enumerate() {
        // A goal counts by how much of it there is to gain, once that is known.
        let spans = if at < alone.len() { vec![1.0; goals.len()] } else { spans(&search) };
        let weights: Vec<f64> = weights.iter().zip(spans).map(|(weight, span)| weight / span).collect();
        search.aim_at(weighted(goals, &weights));
        let Some(best) = ranked(&search).into_iter().next() else { break };
        descend(&search, &best, REGION, search.left() / (count - at), false);
    }
    let (points, missed) = verified(&search, goals);
    let (looked_at, ended) = (search.looked_at(), ended(&search));
    if points.is_empty() {
        return Err(SolveError::Infeasible { looked_at, ended, nearest: "the one that misses least".into(), missed });
    }
    Ok(Front { goals: goals.to_vec(), vary: problem.vary.clone(), points, looked_at, ended })
}

fn weighted(goals: &[&'static Measure], weights: &[f64]) -> Aim {
    Aim::Least(goals.iter().zip(weights).map(|(goal, weight)| (*goal, weight * direction(goal))).collect())
}

/// Weights between the goals: thirds of the way for two, the middles and the centre for three.
fn between(goals: usize) -> Vec<Vec<f64>> {
    match goals {
        2 => [0.75, 0.5, 0.25].map(|share| vec![share, 1.0 - share]).to_vec(),
        _ => vec![vec![0.5, 0.5, 0.02], vec![0.5, 0.02, 0.5], vec![0.02, 0.5, 0.5], vec![0.34, 0.33, 0.33]],
    }
}

/// How far each goal reaches among the frames that no other beats.
fn spans(search: &Search) -> Vec<f64> {
    let kept = undominated(search);
    let column = |at: usize| kept.iter().map(move |(_, goals)| goals[at]);
    let span = |at: usize| column(at).fold(f64::NEG_INFINITY, f64::max) - column(at).fold(f64::INFINITY, f64::min);
    (0..search.scales().len()).map(|at| if kept.is_empty() { 1.0 } else { span(at).max(1e-4) }).collect()
}

/// Values and goals, less is better in each, of the frames that keep the quick rules and that no other beats.
fn undominated(search: &Search) -> Vec<(Vec<f64>, Vec<f64>)> {
    let Aim::Least(terms) = search.aim() else { return Vec::new() };
    let signed =
        |shares: &[f64]| -> Vec<f64> { shares.iter().zip(terms).map(|(share, (measure, _))| share * direction(measure)).collect() };
    let kept: Vec<(Vec<f64>, Vec<f64>)> = search
        .order()
        .into_iter()
        .filter_map(|values| search.known(&values).filter(|point| point.violated == 0.0).map(|point| (values, signed(&point.measures))))
        .collect();
    let beats = |a: &[f64], b: &[f64]| a != b && a.iter().zip(b).all(|(a, b)| a <= b);
    kept.iter().filter(|(_, goals)| !kept.iter().any(|(_, other)| beats(other, goals))).cloned().collect()
}

/// The frames of the front that keep every rule, by the first goal, at most so many, spread over its length; and what the first
/// one that does not misses.
fn verified(search: &Search, goals: &[&'static Measure]) -> (Vec<FrontPoint>, Vec<String>) {
    let mut kept = undominated(search);
    kept.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    kept.dedup_by(|(_, a), (_, b)| a == b);
    let picked: Vec<usize> = (0..kept.len().min(MOST)).map(|at| at * (kept.len() - 1) / (kept.len().min(MOST) - 1).max(1)).collect();
    let (mut points, mut missed) = (Vec::new(), Vec::new());
    for (values, _) in picked.into_iter().map(|at| kept[at].clone()) {
        let Ok(evaluation) = search.evaluated(&values, Cost::Slow) else { continue };
        let breaks = broken(&evaluation, &search.problem().goals);
        if breaks.is_empty() {
            points.push(FrontPoint { values, goals: of(goals, &evaluation) });
        } else if missed.is_empty() {
            missed = breaks;
        }
    }
    if points.is_empty() && missed.is_empty() {
        let nearest = ranked(search).into_iter().next().and_then(|values| search.evaluated(&values, Cost::Slow).ok());
        missed = nearest.map(|evaluation| broken(&evaluation, &search.problem().goals)).unwrap_or_default();
    }
    (points, missed)
}

fn of(goals: &[&'static Measure], evaluation: &Evaluation) -> Vec<f64> {
    goals.iter().map(|goal| goal.of(evaluation).unwrap_or(f64::NAN)).collect()
}
