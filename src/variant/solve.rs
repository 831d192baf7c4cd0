//! A search for a better frame: some parameters vary, a measure is made small, and every rule and goal is kept.
//!
//! The optimiser is COBYLA (M. J. D. Powell 1994), which models objective and constraints by planes through the last points:
//! it needs no derivative, and a constraint is the tightest margin of a rule, which has kinks where another pair becomes the
//! tightest. What it cannot see it cannot avoid: a count of steps, or a frame that does not close, is a cliff. It finds a
//! minimum near its start, not the least of all. Every point that was looked at is a frame file's numbers as they are
//! written, to a thousandth; the best ones that keep everything are then held against every rule, the slow one included, and
//! only one that keeps them all is an answer.

use std::cell::RefCell;
use std::collections::BTreeMap;

use cobyla::{RhoBeg, StopTols};

use super::goal::Goal;
use super::measures::{Evaluation, Measure};
use crate::assembly::{Design, Workshop};
use crate::checks::{Finding, Verdict};
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile};

/// A parameter that may vary.
#[derive(Clone, Copy, Debug)]
pub struct Vary {
    /// Which.
    pub parameter: &'static Parameter,
    /// Least and most, within the parameter's bounds.
    pub bounds: [f64; 2],
}

impl Vary {
    /// Its key with its table.
    pub fn key(&self) -> String {
        format!("{}.{}", self.parameter.table, self.parameter.key)
    }

    fn at(&self, share: f64) -> f64 {
        let [least, most] = self.bounds;
        let value = least + share.clamp(0.0, 1.0) * (most - least);
        ((value * 1000.0).round() / 1000.0).clamp(least, most)
    }

    fn share(&self, value: f64) -> f64 {
        let [least, most] = self.bounds;
        if most > least { ((value - least) / (most - least)).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// What is made small.
#[derive(Clone)]
pub enum Aim {
    /// A measure.
    Measure(&'static Measure),
    /// The distance from these values, each in shares of its bounds.
    Near(Vec<f64>),
}

/// What to search for.
pub struct Problem<'a> {
    /// The frame that is changed.
    pub file: &'a FrameFile,
    /// What is made small.
    pub aim: Aim,
    /// What is kept besides the rules.
    pub goals: Vec<Goal>,
    /// What varies.
    pub vary: Vec<Vary>,
    /// Where the search begins; the frame's own values when empty.
    pub start: Vec<f64>,
    /// How many frames may be looked at.
    pub most: usize,
}

/// A limit that holds the answer back.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Which.
    pub what: String,
    /// How much room is left.
    pub margin: f64,
    /// Unit of the margin.
    pub unit: String,
}

/// An answer.
pub struct Solution {
    /// The frame.
    pub evaluation: Evaluation,
    /// What varied, before and after.
    pub values: Vec<(Vary, f64, f64)>,
    /// Limits that hold it back, the tightest first.
    pub binding: Vec<Binding>,
    /// How many frames were looked at.
    pub looked_at: usize,
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum SolveError {
    /// Nothing varies, or a goal or bound is impossible.
    #[error("{0}")]
    Problem(String),
    /// No frame keeps all limits.
    #[error("none of {looked_at} frames keeps every limit; the nearest misses these: {}", .missed.join("; "))]
    Infeasible {
        /// How many were looked at.
        looked_at: usize,
        /// What the nearest one misses.
        missed: Vec<String>,
    },
}

/// How near its limit a scaled margin binds.
const BINDS: f64 = 0.03;
/// How much of a margin is kept in reserve, scaled: what is solved to equality is then on the good side.
const RESERVE: f64 = 0.002;
/// How many of the best are held against every rule.
const VERIFIED: usize = 12;
/// First and last size of a step, in shares of the bounds.
const STEPS: [f64; 2] = [0.12, 0.001];

/// What is known of one set of values.
struct Point {
    aim: f64,
    /// Scaled margins: every rule's tightest, then the goals'; none when there is no such frame.
    margins: Option<Vec<f64>>,
}

impl Point {
    fn worst(&self) -> f64 {
        self.margins.as_ref().map_or(f64::NEG_INFINITY, |margins| margins.iter().copied().fold(f64::INFINITY, f64::min))
    }
}

/// Rules whose margins are constraints; the fold's slow one is left for the end.
const RULES: [&str; 13] = [
    "envelope",
    "mass_budget",
    "centre_of_mass",
    "propeller_clearance",
    "part_clearance",
    "socket_seating",
    "interference",
    "ground_clearance",
    "hinge_strain",
    "fold_sequence",
    "thinnest_wall",
    "battery_slide",
    "printer_bed",
];

/// What of a unit is as much as a millimetre.
fn scale(unit: &str) -> f64 {
    match unit {
        "g" => 10.0,
        "%" | "deg" => 20.0,
        "cm3" => 100.0,
        "" => 0.1,
        _ => 1.0,
    }
}

/// Margins beyond this say no more, scaled.
const FAR: f64 = 5.0;

struct Search<'a> {
    problem: &'a Problem<'a>,
    workshop: RefCell<Workshop>,
    points: RefCell<BTreeMap<Vec<u64>, Point>>,
    order: RefCell<Vec<Vec<f64>>>,
    scale: f64,
}

impl Search<'_> {
    fn frame(&self, values: &[f64]) -> Result<Frame, String> {
        let mut file = self.problem.file.clone();
        for (vary, value) in self.problem.vary.iter().zip(values) {
            file.set_number(&vary.key(), *value);
        }
        Frame::resolve(&file).map_err(|refusal| refusal.to_string())
    }

    fn values(&self, shares: &[f64]) -> Vec<f64> {
        self.problem.vary.iter().zip(shares).map(|(vary, share)| vary.at(*share)).collect()
    }

    /// Looks at a point, unless it was looked at before, and says something of it.
    fn of<T>(&self, values: &[f64], say: impl Fn(&Point) -> T) -> T {
        let key: Vec<u64> = values.iter().map(|value| value.to_bits()).collect();
        if !self.points.borrow().contains_key(&key) {
            let point = self.look(values);
            self.order.borrow_mut().push(values.to_vec());
            self.points.borrow_mut().insert(key.clone(), point);
        }
        say(&self.points.borrow()[&key])
    }

    fn look(&self, values: &[f64]) -> Point {
        let near = |from: &[f64]| {
            let part = |((vary, a), b): ((&Vary, &f64), &f64)| (vary.share(*a) - vary.share(*b)).powi(2);
            self.problem.vary.iter().zip(values).zip(from).map(part).sum::<f64>()
        };
        let frame = self.frame(values);
        let found = frame.ok().and_then(|frame| Evaluation::quick(frame, &mut self.workshop.borrow_mut()).ok());
        let Some(evaluation) = found else {
            return Point { aim: if let Aim::Near(from) = &self.problem.aim { near(from) } else { 1.0 }, margins: None };
        };
        let aim = match &self.problem.aim {
            Aim::Measure(measure) => measure.of(&evaluation).unwrap_or(f64::INFINITY) / self.scale,
            Aim::Near(from) => near(from),
        };
        Point { aim, margins: Some(margins(&evaluation, &self.problem.goals)) }
    }
}

fn margins(evaluation: &Evaluation, goals: &[Goal]) -> Vec<f64> {
    let rule = |rule: &&str| {
        let found = evaluation.findings.iter().filter(|f| f.rule == **rule && f.verdict != Verdict::Note);
        found.map(|f| f.margin / scale(&f.unit)).fold(FAR, f64::min).max(-FAR)
    };
    let goal = |goal: &Goal| {
        let margin = goal.measure.of(evaluation).map_or(-FAR, |value| goal.margin(value) / scale(goal.measure.unit));
        margin.clamp(-FAR, FAR)
    };
    RULES.iter().map(rule).chain(goals.iter().map(goal)).collect()
}

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
    let mut search =
        Search { problem, workshop: RefCell::new(Workshop::default()), points: RefCell::default(), order: RefCell::default(), scale: 1.0 };
    if let Aim::Measure(measure) = problem.aim {
        let first = Evaluation::quick(before, &mut search.workshop.borrow_mut()).ok().and_then(|e| measure.of(&e));
        search.scale = first.filter(|value| value.abs() > 0.0).map_or(1.0, f64::abs);
    }
    descend(&search, &start, STEPS[0], problem.most / 2);
    // A second descent, from the best so far with smaller steps: planes that straddle a kink mislead the first.
    let again = ranked(&search).into_iter().next().unwrap_or(start);
    let left = problem.most.saturating_sub(search.order.borrow().len());
    descend(&search, &again, 0.3 * STEPS[0], left);
    answer(&search, &own)
}

/// Follows COBYLA from a start.
fn descend(search: &Search, start: &[f64], step: f64, most: usize) {
    let problem = search.problem;
    if most == 0 {
        return;
    }
    let shares: Vec<f64> = problem.vary.iter().zip(start).map(|(vary, value)| vary.share(*value)).collect();
    let count = RULES.len() + problem.goals.len() + 1;
    let constraint = |at: usize| {
        Box::new(move |shares: &[f64], (): &mut ()| {
            search.of(&search.values(shares), |point| match &point.margins {
                None => {
                    if at == 0 {
                        -1.0
                    } else {
                        0.0
                    }
                }
                Some(_) if at == 0 => 1.0,
                Some(margins) => margins[at - 1] - RESERVE,
            })
        }) as Box<dyn Fn(&[f64], &mut ()) -> f64 + '_>
    };
    let constraints: Vec<_> = (0..count).map(constraint).collect();
    let objective = |shares: &[f64], (): &mut ()| search.of(&search.values(shares), |point| point.aim);
    let tolerances = StopTols { xtol_abs: vec![STEPS[1]; shares.len()], ..StopTols::default() };
    let bounds = vec![(0.0, 1.0); shares.len()];
    // However it ends, the points that it looked at are what counts.
    let _ = cobyla::minimize(objective, &shares, &bounds, &constraints, (), most, RhoBeg::All(step), Some(tolerances));
}

/// Points that were looked at: those that keep everything first, by their aim; then by what they miss.
fn ranked(search: &Search) -> Vec<Vec<f64>> {
    let mut all = search.order.borrow().clone();
    let key =
        |values: &Vec<f64>| search.of(values, |point| if point.worst() >= 0.0 { (0, point.aim, 0.0) } else { (1, 0.0, -point.worst()) });
    all.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
    });
    all
}

/// The best point that keeps every rule, the slow one included.
fn answer(search: &Search, own: &[f64]) -> Result<Solution, SolveError> {
    let ranked = ranked(search);
    let looked_at = ranked.len();
    let mut missed = Vec::new();
    for values in ranked.iter().take(VERIFIED) {
        let Ok(frame) = search.frame(values) else { continue };
        let Ok(design) = Design::with(frame, &mut search.workshop.borrow_mut()) else { continue };
        let evaluation = Evaluation::of(design);
        let broken = broken(&evaluation, &search.problem.goals);
        if broken.is_empty() {
            let values: Vec<(Vary, f64, f64)> =
                search.problem.vary.iter().zip(own.iter().zip(values)).map(|(vary, (a, b))| (*vary, *a, *b)).collect();
            let binding = binding(&evaluation, search.problem, &values);
            return Ok(Solution { evaluation, values, binding, looked_at });
        }
        if missed.is_empty() {
            missed = broken;
        }
    }
    Err(SolveError::Infeasible { looked_at, missed })
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
    for rule in RULES {
        let of = evaluation.findings.iter().filter(|f| f.rule == rule && f.verdict != Verdict::Note);
        // What is meant to be zero, as a shared volume is, has no room to begin with and holds nothing back.
        let real = of.filter(|f| f.limit.abs() / scale(&f.unit) > 2.0 * BINDS && !matches!(rule, "interference" | "battery_slide"));
        let tightest: Option<&Finding> = real.min_by(|a, b| (a.margin / scale(&a.unit)).total_cmp(&(b.margin / scale(&b.unit))));
        if let Some(f) = tightest.filter(|f| f.margin / scale(&f.unit) < BINDS) {
            let what = format!("{}: {}", f.rule, f.message);
            found.push((f.margin / scale(&f.unit), Binding { what, margin: f.margin, unit: f.unit.clone().into_owned() }));
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
