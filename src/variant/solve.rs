//! A search for a better frame: some parameters vary, a measure is made small, and every rule and goal is kept.
//!
//! The optimiser is COBYLA (M. J. D. Powell 1994), which models objective and constraints by planes through the last points:
//! it needs no derivative, and a constraint is the tightest margin of a rule, which has kinks where another pair becomes the
//! tightest. What it cannot see it cannot avoid: a count of steps, or a frame that does not close, is a cliff. It finds a
//! minimum near its start, not the least of all. Every point that was looked at is a frame file's numbers as they are
//! written, to a thousandth; the best ones that keep everything are then checked against every rule, the slow one included, and
//! only one that keeps them all is an answer.

use super::feasible::find;
use super::goal::Goal;
use super::measures::Evaluation;
use super::problem::{Aim, Binding, SearchProblem, Solution, SolveError, Vary};
use super::search::{STEPS, Search, descend, ranked, scale};
use crate::checks::{CATALOGUE, Cost, Finding, Rule, Verdict};
use crate::frame::assembly::Design;
use crate::params::Frame;

/// How near its limit a scaled margin binds.
const BINDS: f64 = 0.03;
/// How many of the best are checked against every rule.
const VERIFIED: usize = 12;
/// How many reasons are reported why better frames are refused.
const REASONS: usize = 3;

/// Searches.
///
/// # Errors
/// When nothing varies, or no frame that was looked at keeps every limit.
pub fn solve(problem: &SearchProblem) -> Result<Solution, SolveError> {
    solve_by(problem, &CATALOGUE)
}

/// Searches for a frame that keeps these rules.
pub(super) fn solve_by(problem: &SearchProblem, rules: &[&'static Rule]) -> Result<Solution, SolveError> {
    if problem.vary.is_empty() {
        return Err(SolveError::Problem("nothing varies: name parameters with --vary".into()));
    }
    let before = Frame::resolve(problem.file).map_err(|refusal| SolveError::Problem(refusal.to_string()))?;
    let own: Vec<f64> = problem.vary.iter().map(|v| before.value(v.parameter.table, v.parameter.key).unwrap_or(v.bounds[0])).collect();
    let start = if problem.start.is_empty() { own.clone() } else { problem.start.clone() };
    let mut search = Search::new(problem, rules);
    if let Aim::Measure(measure) = problem.aim {
        let first =
            search.quick(before).and_then(|evaluation| problem.known(evaluation)).ok().and_then(|evaluation| measure.of(&evaluation));
        search.scale = first.filter(|value| value.abs() > 0.0).map_or(1.0, f64::abs);
    }
    find(&search, &start, problem.most / 2);
    let start = ranked(&search).into_iter().next().unwrap_or(start);
    let left = problem.most.saturating_sub(search.order.borrow().len());
    descend(&search, &start, STEPS[0], left.min(problem.most / 2));
    // A second descent, from the best so far with smaller steps: planes that straddle a kink mislead the first.
    let again = ranked(&search).into_iter().next().unwrap_or(start);
    let left = problem.most.saturating_sub(search.order.borrow().len());
    descend(&search, &again, 0.3 * STEPS[0], left);
    answer(&search, &own)
}

/// The best point that keeps every rule, the slow one included.
fn answer(search: &Search, own: &[f64]) -> Result<Solution, SolveError> {
    let ranked = ranked(search);
    let looked_at = ranked.len();
    let mut missed = Vec::new();
    for best in ranked.iter().take(VERIFIED) {
        let Ok(frame) = search.frame(best) else { continue };
        let Ok(design) = Design::with(frame, &search.memo) else { continue };
        let Ok(evaluation) = search.problem.known(Evaluation::by(search.rules, Cost::Slow, design)) else { continue };
        let broken = broken(&evaluation, &search.problem.goals);
        if broken.is_empty() {
            let values: Vec<(Vary, f64, f64)> =
                search.problem.vary.iter().zip(own.iter().zip(best)).map(|(vary, (a, b))| (*vary, *a, *b)).collect();
            let binding = binding(&evaluation, search, &values);
            let refused = refused(search, best);
            return Ok(Solution { evaluation, values, binding, refused, looked_at });
        }
        if missed.is_empty() {
            missed = broken;
        }
    }
    Err(SolveError::Infeasible { looked_at, missed })
}

/// What is wrong with the nearest frames that would be better, or of which nothing is known but that there is none.
fn refused(search: &Search, best: &[f64]) -> Vec<String> {
    let own = search.of(best, |point| point.aim);
    let distance = |values: &[f64]| -> f64 {
        let shares = search.problem.vary.iter().zip(values.iter().zip(best));
        shares.map(|(vary, (a, b))| (vary.share(*a) - vary.share(*b)).powi(2)).sum()
    };
    let order = search.order.borrow().clone();
    let mut reasons: Vec<(f64, String)> = order
        .iter()
        .filter_map(|values| {
            let reason = search.of(values, |point| match (&point.margins, &point.why) {
                (None, why) => why.clone(),
                (Some(margins), _) if point.aim < own && point.worst() < 0.0 => worst_of(margins, search),
                _ => None,
            });
            reason.map(|reason| (distance(values), reason))
        })
        .collect();
    reasons.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    let mut reported: Vec<String> = Vec::new();
    for (_, reason) in reasons {
        if !reported.contains(&reason) && reported.len() < REASONS {
            reported.push(reason);
        }
    }
    reported
}

/// The rule or goal that is missed most.
fn worst_of(margins: &[f64], search: &Search) -> Option<String> {
    let (at, _) = margins.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    let (constraints, goals) = (&search.constraints, &search.problem.goals);
    constraints
        .get(at)
        .map(|constraint| format!("breaks {} {}", constraint.rule.id, constraint.subject).trim_end().to_string())
        .or_else(|| goals.get(at - constraints.len()).map(|goal| format!("misses {}", goal.reported())))
}

/// What a frame misses.
fn broken(evaluation: &Evaluation, goals: &[Goal]) -> Vec<String> {
    let findings = evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).map(|f| f.message.clone());
    let goals = goals.iter().filter(|goal| goal.measure.of(evaluation).is_none_or(|value| goal.margin(value) < 0.0));
    findings.chain(goals.map(|goal| format!("{} is {}", goal.reported(), goal.measure.reported(goal.measure.of(evaluation))))).collect()
}

/// Limits with hardly any room, and bounds that are reached.
fn binding(evaluation: &Evaluation, search: &Search, values: &[(Vary, f64, f64)]) -> Vec<Binding> {
    let mut found: Vec<(f64, Binding)> = Vec::new();
    for constraint in search.constraints.iter().filter(|constraint| constraint.rule.binds()) {
        let of = evaluation.findings.iter().filter(|finding| constraint.concerns(finding));
        // What is meant to be zero has no room to begin with and limits nothing.
        let real = of.filter(|f| f.limit.abs() / scale(&f.unit) > 2.0 * BINDS);
        let tightest: Option<&Finding> = real.min_by(|a, b| (a.margin / scale(&a.unit)).total_cmp(&(b.margin / scale(&b.unit))));
        if let Some(f) = tightest.filter(|f| f.margin / scale(&f.unit) < BINDS) {
            let what = format!("{}: {}", f.rule, f.message);
            let binding = Binding { what, margin: f.margin, unit: f.unit.clone().into_owned() };
            if found.iter().all(|(_, known)| *known != binding) {
                found.push((f.margin / scale(&f.unit), binding));
            }
        }
    }
    for goal in &search.problem.goals {
        let margin = goal.measure.of(evaluation).map_or(0.0, |value| goal.margin(value));
        if margin / scale(goal.measure.unit) < BINDS {
            found.push((margin, Binding { what: goal.reported(), margin, unit: goal.measure.unit.into() }));
        }
    }
    for (vary, _, value) in values {
        let [least, most] = vary.bounds;
        for (bound, margin, sign) in [(least, value - least, ">="), (most, most - value, "<=")] {
            if margin < 0.005 * (most - least) {
                let what = format!("{} {sign} {bound}", vary.key());
                found.push((margin, Binding { what, margin, unit: vary.parameter.unit().into() }));
            }
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, binding)| binding).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{TOY, TOY_MM};
    use crate::params::{FrameFile, parameters};
    use crate::variant::measure;

    #[test]
    fn planted_a_search_keeps_a_rule_that_it_does_not_name() {
        let rules: Vec<&'static Rule> = CATALOGUE.into_iter().chain([&TOY]).collect();
        let file = FrameFile::load("cognifly").expect("a preset");
        let frame = Frame::resolve(&file).expect("is one");
        let rod = parameters().find(|p| p.key == "cage_rod_length_mm").expect("a parameter");
        let aim = Aim::Measure(measure("envelope.width").expect("a measure"));
        let vary = vec![Vary::around(rod, &frame, 0.05)];
        let problem = SearchProblem { file: &file, aim, goals: Vec::new(), vary, start: Vec::new(), most: 14, mechanics: None };
        let solution = solve_by(&problem, &rules).unwrap_or_else(|error| panic!("{error}"));
        let (_, before, after) = solution.values[0];
        // A limit in mm counts as kept when it is missed by no more than a length may be mismeasured, 0.005 mm.
        assert!(after < before && (TOY_MM - 0.005..TOY_MM + 0.5).contains(&after), "{after}");
        assert!(solution.binding.iter().any(|binding| binding.what.starts_with("toy: ")), "{:?}", solution.binding);
    }
}
