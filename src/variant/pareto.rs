//! A Pareto front: frames of which none is better than another in every goal.
//!
//! Each goal by itself is made small as [`super::solve`] does it, then sums of the goals by weights between; a sum finds no point in a hollow
//! of the front, but every frame that was looked at on the way is a candidate. The front is what is left of them when those that another
//! beats, and those that violate a rule, are taken out: what a rule refuses beats none. It is a set of known frames: nothing is said of what lies
//! between.

use super::aim::Aim;
use super::approach::approach;
use super::ended::Ended;
use super::feasible::find;
use super::goal::broken;
use super::improve::{REGIONS, settle};
use super::measures::{Evaluation, Measure, beats, resolved};
use super::problem::{SearchProblem, SolveError, Vary};
use super::search::{Search, ranked};
use super::solve::{ended, solve_by, start_values};
use crate::checks::{CATALOGUE, Cost, Rule};
use crate::params::Frame;

/// Number of points of the front that are checked by every rule and reported.
const MOST: usize = 16;
/// Number of frames of which it is asked whether they keep every rule.
const VERIFIED: usize = 4 * MOST;

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
    let mut found = front_by(&problem.in_catalogue_order(), goals, &CATALOGUE)?;
    let order: Vec<usize> = problem.vary.iter().filter_map(|vary| found.vary.iter().position(|own| own.key() == vary.key())).collect();
    for point in &mut found.points {
        point.values = order.iter().map(|at| point.values[*at]).collect();
    }
    Ok(Front { vary: problem.vary.clone(), ..found })
}

/// Searches for the front of frames that keep these rules.
fn front_by(problem: &SearchProblem, goals: &[&'static Measure], rules: &[&'static Rule]) -> Result<Front, SolveError> {
    let before = Frame::resolve(problem.file).map_err(|refusal| SolveError::Problem(refusal.to_string()))?;
    problem.can_vary(&before)?;
    let ends = Ends::of(problem, goals, rules)?;
    let follows = problem.followed_from(ends.looked_at);
    let rest = SearchProblem { most: problem.most.saturating_sub(ends.looked_at), follows: &follows, ..problem.clone() };
    let start = start_values(&problem.vary, &before);
    let mut search = Search::new(&rest, rules);
    search.aim_at(weighted(goals, &vec![1.0; goals.len()]));
    search.scale_by(before);
    search.look_at(&ends.values);
    if ends.is_stopped {
        search.end();
    }
    find(&search, &start);
    let between = between(goals.len());
    for (at, weights) in between.iter().enumerate() {
        // A goal counts by how much of it there is to gain.
        let weights: Vec<f64> = weights.iter().zip(spans(&search)).map(|(weight, span)| weight / span).collect();
        search.aim_at(weighted(goals, &weights));
        let end = search.looked_at() + search.left() / (between.len() - at);
        let Some(best) = ranked(&search).into_iter().next() else { break };
        approach(&search, search.sketched_by(&best), &best);
        settle(&search, end.saturating_sub(search.looked_at()), &REGIONS);
    }
    let (points, missed) = verified(&search, goals);
    let (looked_at, ended) = (ends.looked_at + search.looked_at(), ended(&search));
    if points.is_empty() {
        return Err(SolveError::Infeasible { looked_at, ended, nearest: "the one that misses least".into(), missed });
    }
    Ok(Front { goals: goals.to_vec(), vary: problem.vary.clone(), points, looked_at, ended })
}

/// What is the best of each goal by itself.
struct Ends {
    values: Vec<Vec<f64>>,
    looked_at: usize,
    /// Whether somebody ended the search.
    is_stopped: bool,
}

impl Ends {
    /// Found with half of the frames. A goal by itself may have no answer, where others have one.
    fn of(problem: &SearchProblem, goals: &[&'static Measure], rules: &[&'static Rule]) -> Result<Self, SolveError> {
        let mut ends = Self { values: Vec::new(), looked_at: 0, is_stopped: false };
        let most = problem.most / (2 * goals.len()).max(1);
        for goal in goals {
            if ends.is_stopped {
                break;
            }
            let follows = problem.followed_from(ends.looked_at);
            let alone = SearchProblem { aim: Aim::Least(vec![(*goal, goal.better.sign())]), most, follows: &follows, ..problem.clone() };
            let (looked_at, ended) = match solve_by(&alone, rules) {
                Ok(solution) => {
                    ends.values.push(solution.values.iter().map(|(.., value)| *value).collect());
                    (solution.looked_at, solution.ended)
                }
                Err(SolveError::Infeasible { looked_at, ended, .. }) => (looked_at, ended),
                Err(error) => return Err(error),
            };
            ends.looked_at += looked_at;
            ends.is_stopped = ended == Ended::Stopped;
        }
        Ok(ends)
    }
}

fn weighted(goals: &[&'static Measure], weights: &[f64]) -> Aim {
    Aim::Least(goals.iter().zip(weights).map(|(goal, weight)| (*goal, weight * goal.better.sign())).collect())
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
    let kept = undominated(search, &[]);
    let column = |at: usize| kept.iter().map(move |(_, goals)| goals[at]);
    let span = |at: usize| column(at).fold(f64::NEG_INFINITY, f64::max) - column(at).fold(f64::INFINITY, f64::min);
    (0..search.scales().len()).map(|at| if kept.is_empty() { 1.0 } else { span(at).max(1e-4) }).collect()
}

/// A frame's values and its goals, less is better in each.
type Signed = (Vec<f64>, Vec<f64>);

/// The frames that keep the quick rules and that no other beats, without those that are refused.
fn undominated(search: &Search, refused: &[Vec<f64>]) -> Vec<Signed> {
    let Aim::Least(terms) = search.aim() else { return Vec::new() };
    let signed =
        |shares: &[f64]| -> Vec<f64> { shares.iter().zip(terms).map(|(share, (measure, _))| share * measure.better.sign()).collect() };
    let kept: Vec<Signed> = search
        .order()
        .into_iter()
        .filter(|values| !refused.contains(values))
        .filter_map(|values| search.point_of(&values).filter(|point| point.violated == 0.0).map(|point| (values, signed(&point.measures))))
        .collect();
    kept.iter().filter(|(_, goals)| !kept.iter().any(|(_, other)| beats(other, goals))).cloned().collect()
}

/// Those of them that are reported: at most so many, by the first goal, spread over the front's length.
fn picked(mut kept: Vec<Signed>) -> Vec<Vec<f64>> {
    kept.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    kept.dedup_by(|(_, a), (_, b)| a.iter().zip(b.iter()).all(|(a, b)| resolved(*a) == resolved(*b)));
    let count = kept.len().min(MOST);
    (0..count).map(|at| kept[at * (kept.len() - 1) / (count - 1).max(1)].0.clone()).collect()
}

/// The frames of the front that keep every rule, and what the first one that does not misses. What a rule refuses at the end leaves its place to
/// the frames that it beat.
fn verified(search: &Search, goals: &[&'static Measure]) -> (Vec<FrontPoint>, Vec<String>) {
    let (mut points, mut refused, mut missed): (Vec<FrontPoint>, Vec<Vec<f64>>, Vec<String>) = Default::default();
    loop {
        let wanted = picked(undominated(search, &refused));
        let fresh: Vec<Vec<f64>> = wanted.iter().filter(|values| points.iter().all(|point| point.values != **values)).cloned().collect();
        if fresh.is_empty() || points.len() + refused.len() >= VERIFIED {
            points.retain(|point| wanted.contains(&point.values));
            points.sort_by_key(|point| wanted.iter().position(|values| *values == point.values));
            break;
        }
        for (values, evaluation) in fresh.iter().zip(search.evaluated_each(&fresh, Cost::Slow)) {
            let breaks = evaluation.as_ref().map(|evaluation| broken(evaluation, &search.problem().goals)).unwrap_or_default();
            match evaluation {
                Ok(evaluation) if breaks.is_empty() => points.push(FrontPoint { values: values.clone(), goals: of(goals, &evaluation) }),
                _ => {
                    refused.push(values.clone());
                    missed = if missed.is_empty() { breaks } else { missed };
                }
            }
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

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::sync::Arc;

    use super::*;
    use crate::checks::planted::{SLOW_TOY, TOY_MM};
    use crate::params::{FrameFile, parameters};
    use crate::variant::measure;

    /// What a rule refuses at the end beats nothing: the front goes on to the narrowest frames that keep it.
    #[test]
    fn planted_a_front_reaches_the_limit_of_a_rule_that_is_asked_at_the_end() {
        let rules: Vec<&'static Rule> = CATALOGUE.into_iter().chain([&SLOW_TOY]).collect();
        let file = FrameFile::load("cognifly").expect("a preset");
        let frame = Frame::resolve(&file).expect("is one");
        let rod = parameters().find(|p| p.key == "cage_rod_length_mm").expect("a parameter");
        let goals = ["envelope.width", "clearance.propeller"].map(|name| measure(name).expect("a measure"));
        let problem = SearchProblem {
            file: &file,
            aim: Aim::least(goals[0]),
            goals: Vec::new(),
            vary: vec![Vary::around(rod, &frame, 0.05)],
            start: Vec::new(),
            most: 48,
            follows: &|_| ControlFlow::Continue(()),
            mechanics: None,
            memo: Arc::default(),
        };
        let front = front_by(&problem, &goals, &rules).unwrap_or_else(|error| panic!("{error}"));
        let rods_mm: Vec<f64> = front.points.iter().map(|point| point.values[0]).collect();
        assert!(rods_mm.iter().all(|mm| *mm >= TOY_MM - 0.005), "{rods_mm:?}");
        // The least of a goal by itself is an end of it.
        assert!(rods_mm[0] < TOY_MM + 0.5 && front.looked_at <= 48 + 8, "{rods_mm:?} {}", front.looked_at);
        let rising = |at: usize| front.points.windows(2).all(|pair| pair[0].goals[at] < pair[1].goals[at]);
        assert!(rising(0) && rising(1), "{:?}", front.points);
    }

    #[test]
    fn analytic_a_problem_is_the_same_in_whatever_order_its_numbers_are_asked_for() {
        let file = FrameFile::load("cognifly").expect("a preset");
        let frame = Frame::resolve(&file).expect("is one");
        let vary = |key: &str| Vary::around(parameters().find(|p| p.key == key).expect("a parameter"), &frame, 0.05);
        let problem = |keys: [&str; 3], from: [f64; 3]| SearchProblem {
            file: &file,
            aim: Aim::Near(from.to_vec()),
            goals: Vec::new(),
            vary: keys.map(vary).to_vec(),
            start: from.to_vec(),
            most: 1,
            follows: &|_| ControlFlow::Continue(()),
            mechanics: None,
            memo: Arc::default(),
        };
        let told = |problem: &SearchProblem| {
            let keys: Vec<String> = problem.vary.iter().map(Vary::key).collect();
            let Aim::Near(from) = &problem.aim else { panic!("another aim") };
            (keys, problem.start.clone(), from.clone())
        };
        let one = problem(["motor_position_mm", "cage_rod_length_mm", "arm_rod_length_mm"], [3.0, 1.0, 2.0]);
        let other = problem(["arm_rod_length_mm", "motor_position_mm", "cage_rod_length_mm"], [2.0, 3.0, 1.0]);
        assert_eq!(told(&one.in_catalogue_order()), told(&other.in_catalogue_order()));
        assert_eq!(one.in_catalogue_order().start, [1.0, 2.0, 3.0]);
        assert_eq!(other.place_of(&one.vary[0]), Some(1));
    }
}
