//! A search for a better frame: some parameters vary, a measure is made small, and every rule and goal is kept.
//!
//! Aim and margins are modelled by planes ([`super::planes`]) in a region that shrinks where they fail: no derivative is needed,
//! and a constraint is the tightest margin of a rule, which has kinks where another pair becomes the tightest. What planes cannot
//! see they cannot avoid: a count of steps, or a frame that does not close, is a cliff. Each descent finds a minimum near its
//! start, so several begin, as far as frames are left; the least of all is not proven. All of this happens on sketches first
//! ([`super::sketch`]), and on frames where these do not end with one that keeps everything. Every point that was looked at is a frame
//! file's numbers as they are written, to a thousandth; the best ones that keep everything are then checked against every rule,
//! the slow one included, and only one that keeps them all is an answer. Where the slow rules refuse the best, the search goes on with the frames
//! that are left, and asks each by every rule. What they still refuse is taken back toward the frame that it began with ([`super::retreat`]).

use super::aim::Aim;
use super::approach::approach;
use super::binding::{binding, moved_words, not_designed, refused};
use super::ended::Ended;
use super::feasible::find;
use super::goal::broken;
use super::improve::{REGIONS, improve, settle};
use super::measures::Evaluation;
use super::point::Point;
use super::problem::{SearchProblem, Solution, SolveError, Vary};
use super::retreat::retreated;
use super::search::{Search, ranked};
use crate::checks::{CATALOGUE, Cost, Rule};
use crate::params::Frame;

/// How many of the best are checked against every rule.
const VERIFIED: usize = 12;
/// How many of the best are looked at again by every rule, where the search goes on with all of them.
const KNOWN: usize = 4;
/// Searches.
///
/// # Errors
/// When the frame is refused, or no frame that was looked at keeps every limit.
pub fn solve(problem: &SearchProblem) -> Result<Solution, SolveError> {
    let mut solution = solve_by(&problem.in_catalogue_order(), &CATALOGUE)?;
    solution.values.sort_by_key(|(vary, ..)| problem.place_of(vary));
    Ok(solution)
}

/// Searches for a frame that keeps these rules.
pub(super) fn solve_by(problem: &SearchProblem, rules: &[&'static Rule]) -> Result<Solution, SolveError> {
    let before = Frame::resolve(problem.file).map_err(|refusal| SolveError::Problem(refusal.to_string()))?;
    problem.can_vary(&before)?;
    let own = own_values(&problem.vary, &before);
    let start = if problem.start.is_empty() { start_values(&problem.vary, &before) } else { problem.start.clone() };
    let mut search = Search::new(problem, rules);
    search.scale_by(before.clone());
    if start == own {
        search.look_at(std::slice::from_ref(&start));
    }
    let is_settled = approach(&search, search.known_of(before), &start);
    find(&search, &start);
    match search.aim() {
        // What has to be near a frame is, after one descent.
        Aim::Near(_) if is_settled => {}
        _ if is_settled => settle(&search, search.left(), &REGIONS),
        _ => improve(&search, search.left()),
    }
    let answered = match answer(&search, &own) {
        // Few frames were designed, and the slow rules refuse them.
        Err(SolveError::Infeasible { .. }) if is_settled && search.left() > 0 => {
            improve(&search, search.left());
            answer(&search, &own)
        }
        answered => answered,
    };
    let refused = is_refused_at_the_end(&search, &answered);
    let answered =
        if refused && search.left() > 0 { asking_all_rules(&search, answered.as_ref().ok(), &own, &start).or(answered) } else { answered };
    if refused && !matches!(search.aim(), Aim::Near(_)) { retreating(&search, answered, &own, &start) } else { answered }
}

/// The answer, or a better one between the frame that the search began with and its best.
fn retreating(search: &Search, answered: Result<Solution, SolveError>, own: &[f64], start: &[f64]) -> Result<Solution, SolveError> {
    let Some(best) = ranked(search).into_iter().next() else { return answered };
    let (retreated, more) = retreated(search, start, &best);
    let Some(solution) = retreated.and_then(|values| solution(search, own, &values)) else { return answered };
    let looked_at = answered.as_ref().map_or(search.looked_at(), |answered| answered.looked_at) + more;
    let value = |solution: &Solution| search.problem().value(&solution.evaluation);
    match answered {
        Ok(answered) if value(&answered) <= value(&solution) => Ok(Solution { looked_at, ..answered }),
        _ => Ok(Solution { looked_at, ..solution }),
    }
}

/// Whether the best frame by the rules that are asked of each is none by those that are asked at the end.
fn is_refused_at_the_end(search: &Search, answered: &Result<Solution, SolveError>) -> bool {
    let best = ranked(search).into_iter().next().filter(|_| search.found());
    best.is_some() && best != answered.as_ref().ok().map(values_of)
}

/// The values of what varied.
fn values_of(solution: &Solution) -> Vec<f64> {
    solution.values.iter().map(|(.., value)| *value).collect()
}

/// Searches with the frames that are left, each asked by every rule: what refused the best ones is then seen before it is reached. What is
/// answered already is looked at first, so that no worse frame is the answer.
fn asking_all_rules(search: &Search, answered: Option<&Solution>, own: &[f64], start: &[f64]) -> Result<Solution, SolveError> {
    let before = search.looked_at();
    let follows = search.problem().followed_from(before);
    let rest = SearchProblem { most: search.left(), follows: &follows, ..search.problem().clone() };
    let all_rules = search.asking_all_rules(&rest);
    let best = ranked(search).into_iter().take(KNOWN);
    let known: Vec<Vec<f64>> = answered.map(values_of).into_iter().chain(best).chain([start.to_vec()]).collect();
    all_rules.look_at(&known);
    find(&all_rules, start);
    improve(&all_rules, all_rules.left());
    let mut solution = answer(&all_rules, own)?;
    solution.looked_at += before;
    Ok(solution)
}

/// The frame's own values of what varies.
pub(super) fn own_values(vary: &[Vary], frame: &Frame) -> Vec<f64> {
    vary.iter().map(|v| frame.value(v.parameter.table, v.parameter.key).unwrap_or(v.bounds[0])).collect()
}

/// The same within the bounds: a frame outside of them is no answer.
pub(super) fn start_values(vary: &[Vary], frame: &Frame) -> Vec<f64> {
    own_values(vary, frame).into_iter().zip(vary).map(|(value, vary)| value.clamp(vary.bounds[0], vary.bounds[1])).collect()
}

/// What is known of a problem's frame as it is, and whether somebody ended the search with it.
pub(super) fn before(problem: &SearchProblem) -> Result<(Point, bool), String> {
    let frame = Frame::resolve(problem.file).map_err(|refusal| refusal.to_string())?;
    let (own, search) = (own_values(&problem.vary, &frame), Search::new(problem, &CATALOGUE));
    search.look_at(std::slice::from_ref(&own));
    let point = search.point_of(&own).ok_or_else(|| "no frame is left to look at".to_owned())?;
    Ok((point, search.is_ended()))
}

/// Why a search ended.
pub(super) fn ended(search: &Search) -> Ended {
    match (search.is_ended(), search.left()) {
        (true, _) => Ended::Stopped,
        (false, 0) => Ended::Spent,
        (false, _) => Ended::Converged,
    }
}

/// The best point that keeps every rule, the slow one included.
fn answer(search: &Search, own: &[f64]) -> Result<Solution, SolveError> {
    let ranked = ranked(search);
    let (mut missed, mut nearest) = (Vec::new(), String::from("which could not be designed"));
    for best in ranked.iter().take(VERIFIED) {
        let Ok(evaluation) = search.evaluated(best, Cost::Slow) else { continue };
        let broken = broken(&evaluation, &search.problem().goals);
        if broken.is_empty() {
            return Ok(solution_of(search, own, best, evaluation));
        }
        if missed.is_empty() {
            missed = broken;
            nearest = moved_words(search, own, best);
        }
    }
    if missed.is_empty() {
        missed.extend(not_designed(search, own));
    }
    Err(SolveError::Infeasible { looked_at: ranked.len(), ended: ended(search), nearest, missed })
}

/// A point that keeps everything, as the answer; none where there is no such frame.
fn solution(search: &Search, own: &[f64], values: &[f64]) -> Option<Solution> {
    Some(solution_of(search, own, values, search.evaluated(values, Cost::Slow).ok()?))
}

fn solution_of(search: &Search, own: &[f64], best: &[f64], evaluation: Evaluation) -> Solution {
    let values: Vec<(Vary, f64, f64)> =
        search.problem().vary.iter().zip(own.iter().zip(best)).map(|(vary, (a, b))| (*vary, *a, *b)).collect();
    let (binding, refused) = (binding(&evaluation, search, &values), refused(search, best));
    Solution { evaluation, values, binding, refused, looked_at: search.looked_at(), ended: ended(search) }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::sync::Arc;

    use super::*;
    use crate::checks::planted::{SLOW_TOY, TOY, TOY_MM};
    use crate::params::{FrameFile, parameters};
    use crate::variant::{Aim, measure};

    /// Asks something of the search for the narrowest frame that keeps all rules and one more.
    fn narrowest<T>(toy: &'static Rule, most: usize, ask: impl FnOnce(&SearchProblem, &[&'static Rule]) -> T) -> T {
        let rules: Vec<&'static Rule> = CATALOGUE.into_iter().chain([toy]).collect();
        let file = FrameFile::load("cognifly").expect("a preset");
        let frame = Frame::resolve(&file).expect("is one");
        let rod = parameters().find(|p| p.key == "cage_rod_length_mm").expect("a parameter");
        let aim = Aim::least(measure("envelope.width").expect("a measure"));
        let vary = vec![Vary::around(rod, &frame, 0.05)];
        let problem = SearchProblem {
            file: &file,
            aim,
            goals: Vec::new(),
            vary,
            start: Vec::new(),
            most,
            follows: &|_| ControlFlow::Continue(()),
            mechanics: None,
            memo: Arc::default(),
        };
        ask(&problem, &rules)
    }

    fn solved(toy: &'static Rule, most: usize) -> Solution {
        narrowest(toy, most, |problem, rules| solve_by(problem, rules).unwrap_or_else(|error| panic!("{error}")))
    }

    #[test]
    fn planted_a_search_keeps_a_rule_that_it_does_not_name() {
        let solution = solved(&TOY, 14);
        let (_, before, after) = solution.values[0];
        // A limit in mm counts as kept when it is missed by no more than a length may be mismeasured, 0.005 mm.
        assert!(after < before && (TOY_MM - 0.005..TOY_MM + 0.5).contains(&after), "{after}");
        assert!(solution.binding.iter().any(|binding| binding.what.starts_with("toy: ")), "{:?}", solution.binding);
    }

    /// What a rule refuses that is asked at the end is not where the search ends.
    #[test]
    fn planted_a_search_goes_on_where_a_rule_at_its_end_refuses_the_best() {
        let solution = solved(&SLOW_TOY, 24);
        let (_, before, after) = solution.values[0];
        assert!(after < before && (TOY_MM - 0.005..TOY_MM + 0.5).contains(&after), "{before} to {after}, {} frames", solution.looked_at);
        assert!(solution.looked_at <= 24 && solution.refused.iter().any(|why| why.contains("slow_toy")), "{:?}", solution.refused);
    }

    /// The best dozen are refused by what is asked at the end, and no frame is left to try others.
    #[test]
    fn planted_a_search_that_began_with_a_sound_frame_has_an_answer() {
        narrowest(&SLOW_TOY, 14, |problem, rules| {
            let frame = Frame::resolve(problem.file).expect("is one");
            let own = own_values(&problem.vary, &frame);
            let mut search = Search::new(problem, rules);
            search.scale_by(frame);
            search.look_at(std::slice::from_ref(&own));
            search.look_at(&(0..13).map(|at| vec![186.0 + 0.2 * f64::from(at)]).collect::<Vec<_>>());
            let answered = answer(&search, &own);
            assert!(matches!(answered, Err(SolveError::Infeasible { .. })) && search.left() == 0);
            let solution = retreating(&search, answered, &own, &own).unwrap_or_else(|error| panic!("{error}"));
            let (_, before, after) = solution.values[0];
            assert!(after < before && after > TOY_MM - 0.005, "{before} to {after}");
            assert_eq!(solution.looked_at, 14 + 4);
        });
    }

    /// The best frames are refused by what is asked at the end, and the frames that are left are too few to reach the answered one again.
    #[test]
    fn planted_a_search_that_goes_on_gives_no_worse_frame_than_it_had() {
        let went_on = narrowest(&SLOW_TOY, 11, |problem, rules| {
            let frame = Frame::resolve(problem.file).expect("is one");
            let own = own_values(&problem.vary, &frame);
            let mut search = Search::new(problem, rules);
            search.scale_by(frame);
            let shorter = [188.0, 188.2, 188.4, 188.6, TOY_MM + 0.5].map(|mm| vec![mm]);
            search.look_at(std::slice::from_ref(&own));
            search.look_at(&shorter);
            let answered = answer(&search, &own);
            assert!(is_refused_at_the_end(&search, &answered));
            asking_all_rules(&search, answered.as_ref().ok(), &own, &own).expect("has one")
        });
        let (_, before, after) = went_on.values[0];
        assert!((TOY_MM - 0.005..=TOY_MM + 0.5).contains(&after), "{before} to {after}");
    }
}
