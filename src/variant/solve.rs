//! A search for a better frame: some parameters vary, a measure is made small, and every rule and goal is kept.
//!
//! The optimiser is COBYLA (M. J. D. Powell 1994), which models objective and constraints by planes through the last points:
//! it needs no derivative, and a constraint is the tightest margin of a rule, which has kinks where another pair becomes the
//! tightest. What it cannot see it cannot avoid: a count of steps, or a frame that does not close, is a cliff. It finds a
//! minimum near its start, not the least of all. Every point that was looked at is a frame file's numbers as they are
//! written, to a thousandth; the best ones that keep everything are then held against every rule, the slow one included, and
//! only one that keeps them all is an answer.

use super::goal::Goal;
use super::measures::Evaluation;
use super::problem::{Aim, Binding, Problem, Solution, SolveError, Vary};
use super::search::{RULES, STEPS, Search, descend, ranked, scale};
use crate::checks::{Finding, Verdict};
use crate::frame::assembly::Design;
use crate::params::Frame;

/// How near its limit a scaled margin binds.
const BINDS: f64 = 0.03;
/// How many of the best are held against every rule.
const VERIFIED: usize = 12;
/// How many reasons are told why better frames are refused.
const REASONS: usize = 3;

/// Searches.
///
/// # Errors
/// When nothing varies, or no frame that was looked at keeps every limit.
pub fn solve(problem: &Problem) -> Result<Solution, SolveError> {
    if problem.vary.is_empty() {
        return Err(SolveError::Problem("nothing varies: name parameters with --vary".into()));
    }
    let before = Frame::resolve(problem.file).map_err(|refusal| SolveError::Problem(refusal.to_string()))?;
    let own: Vec<f64> = problem.vary.iter().map(|v| before.value(v.parameter.table, v.parameter.key).unwrap_or(v.bounds[0])).collect();
    let start = if problem.start.is_empty() { own.clone() } else { problem.start.clone() };
    let mut search = Search::new(problem);
    if let Aim::Measure(measure) = problem.aim {
        let first = Evaluation::quick(before, &mut search.workshop.borrow_mut()).map_err(|error| error.to_string());
        let first = first.and_then(|evaluation| problem.known(evaluation)).ok().and_then(|evaluation| measure.of(&evaluation));
        search.scale = first.filter(|value| value.abs() > 0.0).map_or(1.0, f64::abs);
    }
    descend(&search, &start, STEPS[0], problem.most / 2);
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
        let Ok(design) = Design::with(frame, &mut search.workshop.borrow_mut()) else { continue };
        let Ok(evaluation) = search.problem.known(Evaluation::of(design)) else { continue };
        let broken = broken(&evaluation, &search.problem.goals);
        if broken.is_empty() {
            let values: Vec<(Vary, f64, f64)> =
                search.problem.vary.iter().zip(own.iter().zip(best)).map(|(vary, (a, b))| (*vary, *a, *b)).collect();
            let binding = binding(&evaluation, search.problem, &values);
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
                (Some(margins), _) if point.aim < own && point.worst() < 0.0 => worst_of(margins, &search.problem.goals),
                _ => None,
            });
            reason.map(|reason| (distance(values), reason))
        })
        .collect();
    reasons.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
    let mut told: Vec<String> = Vec::new();
    for (_, reason) in reasons {
        if !told.contains(&reason) && told.len() < REASONS {
            told.push(reason);
        }
    }
    told
}

/// The rule or goal that is missed most.
fn worst_of(margins: &[f64], goals: &[Goal]) -> Option<String> {
    let (at, _) = margins.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    RULES
        .get(at)
        .map(|(rule, subject)| format!("breaks {rule} {subject}").trim_end().to_string())
        .or_else(|| goals.get(at - RULES.len()).map(|goal| format!("misses {}", goal.told())))
}

/// What a frame misses.
fn broken(evaluation: &Evaluation, goals: &[Goal]) -> Vec<String> {
    let findings = evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).map(|f| f.message.clone());
    let goals = goals.iter().filter(|goal| goal.measure.of(evaluation).is_none_or(|value| goal.margin(value) < 0.0));
    findings.chain(goals.map(|goal| format!("{} is {}", goal.told(), goal.measure.told(goal.measure.of(evaluation))))).collect()
}

/// Limits with hardly any room, and bounds that are reached.
fn binding(evaluation: &Evaluation, problem: &Problem, values: &[(Vary, f64, f64)]) -> Vec<Binding> {
    let mut found: Vec<(f64, Binding)> = Vec::new();
    for (rule, subject) in RULES {
        let fits = |f: &&Finding| f.rule == rule && f.subject.starts_with(subject) && f.verdict != Verdict::Note;
        let of = evaluation.findings.iter().filter(fits);
        // What is meant to be zero, as a shared volume is, has no room to begin with and holds nothing back.
        let real = of.filter(|f| f.limit.abs() / scale(&f.unit) > 2.0 * BINDS && !matches!(rule, "interference" | "battery_slide"));
        let tightest: Option<&Finding> = real.min_by(|a, b| (a.margin / scale(&a.unit)).total_cmp(&(b.margin / scale(&b.unit))));
        if let Some(f) = tightest.filter(|f| f.margin / scale(&f.unit) < BINDS) {
            let what = format!("{}: {}", f.rule, f.message);
            let binding = Binding { what, margin: f.margin, unit: f.unit.clone().into_owned() };
            if found.iter().all(|(_, known)| *known != binding) {
                found.push((f.margin / scale(&f.unit), binding));
            }
        }
    }
    for goal in &problem.goals {
        let margin = goal.measure.of(evaluation).map_or(0.0, |value| goal.margin(value));
        if margin / scale(goal.measure.unit) < BINDS {
            found.push((margin, Binding { what: goal.told(), margin, unit: goal.measure.unit.into() }));
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
