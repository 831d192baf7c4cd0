//! Points of a search: each is a frame, looked at once.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use cobyla::{RhoBeg, StopTols};

use super::goal::Goal;
use super::measures::Evaluation;
use super::problem::{Aim, SearchProblem, Vary};
use crate::checks::{Cost, Finding, Rule, Verdict};
use crate::frame::assembly::Design;
use crate::memo::Memo;
use crate::params::Frame;

/// How much of a margin is kept in reserve, scaled: what is solved to equality is then on the good side.
const RESERVE: f64 = 0.002;
/// First and last size of a step, in shares of the bounds.
pub(super) const STEPS: [f64; 2] = [0.05, 0.001];

/// What is known of one set of values.
pub(super) struct Point {
    /// What is made small; less is better.
    pub aim: f64,
    /// Scaled margins: every rule's tightest, then the goals'; none when there is no such frame.
    pub margins: Option<Vec<f64>>,
    /// Sum of the violated margins, scaled; zero when everything is kept.
    pub violated: f64,
    /// Why there is no such frame.
    pub why: Option<String>,
}

impl Point {
    /// The tightest margin; minus infinity where there is no frame.
    pub fn worst(&self) -> f64 {
        self.margins.as_ref().map_or(f64::NEG_INFINITY, |margins| margins.iter().copied().fold(f64::INFINITY, f64::min))
    }
}

/// A constraint of a search: the tightest finding of a rule whose subjects begin with these words.
#[derive(Clone, Copy)]
pub(super) struct Constraint {
    /// The rule.
    pub rule: &'static Rule,
    /// How the subjects begin.
    pub subject: &'static str,
}

impl Constraint {
    /// Those of all rules that a search keeps on every frame.
    fn of_all(rules: &[&'static Rule]) -> Vec<Self> {
        rules.iter().flat_map(|rule| rule.constraints().iter().map(|subject| Self { rule, subject })).collect()
    }

    /// Whether a finding is one of its own. Notes never are.
    pub fn concerns(&self, finding: &Finding) -> bool {
        finding.rule == self.rule.id && finding.subject.starts_with(self.subject) && finding.verdict != Verdict::Note
    }
}

/// What of a unit is as much as a millimetre.
pub(super) fn scale(unit: &str) -> f64 {
    match unit {
        "g" => 10.0,
        "%" | "deg" => 20.0,
        "cm3" => 100.0,
        "" => 0.1,
        _ => 1.0,
    }
}

/// Margins beyond this say no more, scaled; far enough that the planes through the first points are not flat.
const FAR: f64 = 50.0;

/// How far values of which there is no frame miss every constraint, scaled: farther than a frame that is much too large, or
/// they would look better than it.
const NO_FRAME: f64 = 20.0;

/// Sum of violated margins where there is no frame: more than a frame that misses a dozen limits by far.
const NOWHERE: f64 = 12.0 * FAR;

/// Points that were looked at, and how to look at another.
pub(super) struct Search<'a> {
    /// What is asked for.
    pub problem: &'a SearchProblem<'a>,
    /// The rules.
    pub rules: &'a [&'static Rule],
    /// What of the rules is kept on every frame.
    pub constraints: Vec<Constraint>,
    /// Parts that were made.
    pub memo: Arc<Memo>,
    points: RefCell<BTreeMap<Vec<u64>, Point>>,
    /// Values that were looked at, in order.
    pub order: RefCell<Vec<Vec<f64>>>,
    /// The measure of the frame itself, by which the aim is divided.
    pub scale: f64,
}

impl<'a> Search<'a> {
    /// Nothing was looked at yet.
    pub fn new(problem: &'a SearchProblem<'a>, rules: &'a [&'static Rule]) -> Self {
        let (constraints, memo) = (Constraint::of_all(rules), Arc::default());
        Self { problem, rules, constraints, memo, points: RefCell::default(), order: RefCell::default(), scale: 1.0 }
    }

    /// The frame with these values.
    pub fn frame(&self, values: &[f64]) -> Result<Frame, String> {
        let mut file = self.problem.file.clone();
        for (vary, value) in self.problem.vary.iter().zip(values) {
            file.set_number(&vary.key(), *value);
        }
        Frame::resolve(&file).map_err(|refusal| refusal.to_string())
    }

    /// Whether one of the points keeps everything.
    pub fn found(&self) -> bool {
        self.points.borrow().values().any(|point| point.violated == 0.0)
    }

    /// The values at these shares of their bounds.
    pub fn values(&self, shares: &[f64]) -> Vec<f64> {
        self.problem.vary.iter().zip(shares).map(|(vary, share)| vary.at(*share)).collect()
    }

    /// Looks at a point, unless it was looked at before, and says something of it.
    pub fn of<T>(&self, values: &[f64], say: impl Fn(&Point) -> T) -> T {
        let key: Vec<u64> = values.iter().map(|value| value.to_bits()).collect();
        if !self.points.borrow().contains_key(&key) {
            let point = self.look(values);
            self.order.borrow_mut().push(values.to_vec());
            self.points.borrow_mut().insert(key.clone(), point);
        }
        say(&self.points.borrow()[&key])
    }

    /// A frame by the rules that are quick to check.
    pub fn quick(&self, frame: Frame) -> Result<Evaluation, String> {
        let design = Design::with(frame, &self.memo).map_err(|error| error.to_string())?;
        Ok(Evaluation::by(self.rules, Cost::Quick, design))
    }

    fn look(&self, values: &[f64]) -> Point {
        let near = |from: &[f64]| {
            let part = |((vary, a), b): ((&Vary, &f64), &f64)| (vary.share(*a) - vary.share(*b)).powi(2);
            self.problem.vary.iter().zip(values).zip(from).map(part).sum::<f64>()
        };
        let evaluation = match self.frame(values).and_then(|frame| self.quick(frame)).and_then(|evaluation| self.problem.known(evaluation))
        {
            Ok(evaluation) => evaluation,
            Err(why) => {
                let aim = if let Aim::Near(from) = &self.problem.aim { near(from) } else { 1.0 };
                return Point { aim, margins: None, violated: NOWHERE, why: Some(why) };
            }
        };
        let aim = match &self.problem.aim {
            Aim::Measure(measure) => measure.of(&evaluation).unwrap_or(f64::INFINITY) / self.scale,
            Aim::Near(from) => near(from),
        };
        let margins = margins(&evaluation, &self.constraints, &self.problem.goals);
        let violated = margins.iter().map(|margin| (-margin).max(0.0)).sum();
        Point { aim, margins: Some(margins), violated, why: None }
    }
}

fn margins(evaluation: &Evaluation, constraints: &[Constraint], goals: &[Goal]) -> Vec<f64> {
    let tightest = |constraint: &Constraint| {
        let found = evaluation.findings.iter().filter(|finding| constraint.concerns(finding));
        found.map(|f| f.margin / scale(&f.unit)).fold(FAR, f64::min).max(-FAR)
    };
    let goal = |goal: &Goal| {
        let margin = goal.measure.of(evaluation).map_or(-FAR, |value| goal.margin(value) / scale(goal.measure.unit));
        margin.clamp(-FAR, FAR)
    };
    constraints.iter().map(tightest).chain(goals.iter().map(goal)).collect()
}

/// Follows COBYLA from a start.
pub(super) fn descend(search: &Search, start: &[f64], step: f64, most: usize) {
    let problem = search.problem;
    if most == 0 {
        return;
    }
    let shares: Vec<f64> = problem.vary.iter().zip(start).map(|(vary, value)| vary.share(*value)).collect();
    let count = search.constraints.len() + problem.goals.len() + 1;
    let constraint = |at: usize| {
        Box::new(move |shares: &[f64], (): &mut ()| {
            search.of(&search.values(shares), |point| match &point.margins {
                None => -NO_FRAME,
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

/// Points that were looked at: those that keep everything first, by their aim; then by the sum of what they miss.
pub(super) fn ranked(search: &Search) -> Vec<Vec<f64>> {
    let mut all = search.order.borrow().clone();
    let key =
        |values: &Vec<f64>| search.of(values, |point| if point.worst() >= 0.0 { (0, point.aim, 0.0) } else { (1, 0.0, point.violated) });
    all.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2))
    });
    all
}
