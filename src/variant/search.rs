//! Points of a search: each is a frame, looked at once.

use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::ops::ControlFlow;

use rayon::prelude::*;

use super::aim::Aim;
use super::constraint::{Constraint, margins, scale};
use super::goal::Goal;
use super::measures::{Evaluation, Measure};
use super::point::Point;
use super::problem::{SearchProblem, SearchProgress};
use super::sketch::Known;
use crate::checks::{Cost, Rule};
use crate::frame::assembly::Design;
use crate::frame::skeleton::Skeleton;
use crate::params::Frame;

/// Frames that are designed side by side: between such groups somebody may end the search. As many on every machine, as what ends it by how many
/// were looked at would find another frame with other groups.
pub(super) const AT_ONCE: usize = 8;
/// How a point is looked at.
struct Look<'a> {
    problem: &'a SearchProblem<'a>,
    rules: &'a [&'static Rule],
    constraints: Vec<Constraint>,
    aim: Aim,
    scales: Vec<f64>,
    /// What frames are sketched by; none where each is designed.
    sketched_by: Option<Known>,
    /// The passes that designed frames are asked by.
    dearest: Cost,
}

/// Points that were looked at, and how to look at others.
pub(super) struct Search<'a> {
    look: Look<'a>,
    points: RefCell<BTreeMap<Vec<u64>, Point>>,
    order: RefCell<Vec<Vec<f64>>>,
    ended: Cell<bool>,
}

impl<'a> Search<'a> {
    /// Nothing was looked at yet.
    pub fn new(problem: &'a SearchProblem<'a>, rules: &'a [&'static Rule]) -> Self {
        let look = Look {
            problem,
            rules,
            constraints: Constraint::of_all(rules),
            aim: Aim::Near(Vec::new()),
            scales: Vec::new(),
            sketched_by: None,
            dearest: Cost::Quick,
        };
        let mut search = Self { look, points: RefCell::default(), order: RefCell::default(), ended: Cell::new(false) };
        search.aim_at(problem.aim.clone());
        search
    }

    /// The same search that has looked at nothing yet, with another problem's count of frames and follower.
    fn again<'b>(&self, problem: &'b SearchProblem<'b>) -> Search<'b>
    where
        'a: 'b,
    {
        let Look { rules, aim, scales, .. } = &self.look;
        let mut search = Search::new(problem, rules);
        search.look.scales = scales.clone();
        search.look.aim = aim.clone();
        search
    }

    /// The same search, with another problem's count of frames and follower, that looks at sketches by a known frame.
    pub fn of_sketches<'b>(&self, problem: &'b SearchProblem<'b>, known: Known) -> Search<'b>
    where
        'a: 'b,
    {
        let mut search = self.again(problem);
        search.look.sketched_by = Some(known);
        search
    }

    /// The same search, with another problem's count of frames and follower, that asks every frame by every rule, those too that are otherwise
    /// asked at the end.
    pub fn asking_all_rules<'b>(&self, problem: &'b SearchProblem<'b>) -> Search<'b>
    where
        'a: 'b,
    {
        let mut search = self.again(problem);
        search.look.dearest = Cost::Slow;
        search
            .look
            .constraints
            .extend(self.look.rules.iter().filter(|rule| rule.is_asked_at_the_end()).map(|rule| Constraint { rule, subject: "" }));
        search
    }

    /// What these values' frame says of others near it; none where there is no frame.
    pub fn sketched_by(&self, values: &[f64]) -> Option<Known> {
        self.look.frame(values).ok().and_then(|frame| self.known_of(frame))
    }

    /// What a frame says of others near it; none where it cannot be designed.
    pub fn known_of(&self, frame: Frame) -> Option<Known> {
        let evaluation = self.look.evaluated(frame, Cost::Quick).ok()?;
        Some(Known::of(evaluation, self.look.rules))
    }

    /// Makes something else small from now on, of the same measures once points were looked at.
    pub fn aim_at(&mut self, aim: Aim) {
        if self.order.get_mut().is_empty() {
            self.look.scales = vec![1.0; aim.measures().len()];
        }
        self.look.aim = aim;
        for point in self.points.get_mut().values_mut().filter(|point| point.margins.is_some()) {
            point.aim = self.look.aim.of(&point.measures, &self.look.scales, point.aim);
        }
    }

    /// What is made small.
    pub fn aim(&self) -> &Aim {
        &self.look.aim
    }

    /// What is asked for.
    pub fn problem(&self) -> &'a SearchProblem<'a> {
        self.look.problem
    }

    /// What of the rules is kept on every frame.
    pub fn constraints(&self) -> &[Constraint] {
        &self.look.constraints
    }

    /// The aim's measures are shares of those of a frame from now on.
    pub fn scale_by(&mut self, frame: Frame) {
        if self.look.scales.is_empty() {
            return;
        }
        if let Ok(evaluation) = self.look.evaluated(frame, Cost::Quick) {
            // A share of next to nothing is no share: it would weigh more than a limit that is missed.
            let value = |measure: &Measure| measure.of(&evaluation).map_or(1.0, |value| value.abs().max(scale(measure.unit)));
            self.look.scales = self.look.aim.measures().into_iter().map(value).collect();
        }
    }

    /// What the aim's measures are shares of.
    pub fn scales(&self) -> &[f64] {
        &self.look.scales
    }

    /// The values at these shares of their bounds.
    pub fn values(&self, shares: &[f64]) -> Vec<f64> {
        self.problem().vary.iter().zip(shares).map(|(vary, share)| vary.at(*share)).collect()
    }

    /// The shares of their bounds at which these values lie.
    pub fn shares(&self, values: &[f64]) -> Vec<f64> {
        self.problem().vary.iter().zip(values).map(|(vary, value)| vary.share(*value)).collect()
    }

    /// How many frames were looked at.
    pub fn looked_at(&self) -> usize {
        self.order.borrow().len()
    }

    /// How many more may be; none once somebody ended the search.
    pub fn left(&self) -> usize {
        if self.ended.get() { 0 } else { self.problem().most.saturating_sub(self.looked_at()) }
    }

    /// Ends the search.
    pub fn end(&self) {
        self.ended.set(true);
    }

    /// Whether somebody ended the search.
    pub fn is_ended(&self) -> bool {
        self.ended.get()
    }

    /// What is known of these values; they have to have been looked at.
    pub fn point_of(&self, values: &[f64]) -> Option<Point> {
        self.points.borrow().get(&key(values)).cloned()
    }

    /// Looks at points side by side, as far as they are new and frames are left. Values of which the skeleton alone says that
    /// there is no frame cost nothing.
    pub fn look_at(&self, wanted: &[Vec<f64>]) {
        let mut fresh: Vec<&Vec<f64>> = Vec::new();
        for values in wanted {
            if self.point_of(values).is_some() || fresh.contains(&values) {
                continue;
            }
            match self.look.closes(values) {
                Err(why) => {
                    self.points.borrow_mut().insert(key(values), Point::none(self.look.distance(values), why));
                }
                Ok(()) => fresh.push(values),
            }
        }
        for group in fresh[..fresh.len().min(self.left())].chunks(AT_ONCE) {
            if self.is_ended() {
                return;
            }
            let look = &self.look;
            let points: Vec<Point> = group.par_iter().map(|values| look.at(values)).collect();
            for (values, point) in group.iter().zip(points) {
                self.order.borrow_mut().push((*values).clone());
                self.points.borrow_mut().insert(key(values), point);
            }
            self.tell();
        }
    }

    /// Says where the search is, and hears whether it may go on.
    fn tell(&self) {
        if (self.problem().follows)(&self.progress()) == ControlFlow::Break(()) {
            self.end();
        }
    }

    /// Where the search is.
    pub fn progress(&self) -> SearchProgress {
        let best = ranked(self).into_iter().next().and_then(|values| self.point_of(&values));
        let missed = best.as_ref().and_then(|point| worst_of(point.margins.as_ref()?, self));
        let told = |point: Point| point.measures.first().map_or(point.aim, |share| share * self.look.scales[0]);
        let best = best.filter(|point| point.violated == 0.0).map(told);
        SearchProgress { looked_at: self.looked_at(), most: self.problem().most, best, missed }
    }

    /// The frame with these values, evaluated by the rules up to a cost.
    ///
    /// # Errors
    /// When there is no such frame, in words.
    pub fn evaluated(&self, values: &[f64], dearest: Cost) -> Result<Evaluation, String> {
        self.look.evaluated(self.look.frame(values)?, dearest)
    }

    /// The same of several, side by side.
    pub fn evaluated_each(&self, all: &[Vec<f64>], dearest: Cost) -> Vec<Result<Evaluation, String>> {
        let look = &self.look;
        all.par_iter().map(|values| look.evaluated(look.frame(values)?, dearest)).collect()
    }

    /// Whether a point keeps everything.
    pub fn found(&self) -> bool {
        self.points.borrow().values().any(|point| point.violated == 0.0)
    }

    /// Values of which the skeleton says that there is no frame, and why.
    pub fn without_frame(&self) -> Vec<(Vec<f64>, String)> {
        let points = self.points.borrow();
        let none =
            points.iter().filter_map(|(key, point)| Some((key.iter().map(|bits| f64::from_bits(*bits)).collect(), point.why.clone()?)));
        none.collect()
    }

    /// All values that were looked at, in order.
    pub fn order(&self) -> Vec<Vec<f64>> {
        self.order.borrow().clone()
    }
}

fn key(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

impl Look<'_> {
    fn frame(&self, values: &[f64]) -> Result<Frame, String> {
        let mut file = self.problem.file.clone();
        for (vary, value) in self.problem.vary.iter().zip(values) {
            file.set_number(&vary.key(), *value);
        }
        Frame::resolve(&file).map_err(|refusal| refusal.to_string())
    }

    /// Whether there is a skeleton with these values.
    fn closes(&self, values: &[f64]) -> Result<(), String> {
        let frame = self.frame(values)?;
        // The rods of a frame of a wanted size are computed later.
        if frame.target.is_some() { Ok(()) } else { Skeleton::new(&frame).map(|_| ()).map_err(|error| error.to_string()) }
    }

    fn evaluated(&self, frame: Frame, dearest: Cost) -> Result<Evaluation, String> {
        if let Some(known) = &self.sketched_by {
            return known.sketch(frame, self.rules, &self.problem.memo).map_err(|error| error.to_string());
        }
        let design = Design::with(frame, &self.problem.memo).map_err(|error| error.to_string())?;
        self.problem.with_mechanics(Evaluation::by(self.rules, dearest, design))
    }

    /// The squared distance from the values that are to be near; zero where none are.
    fn distance(&self, values: &[f64]) -> f64 {
        if let Aim::Near(from) = &self.aim { self.problem.distance(values, from) } else { 0.0 }
    }

    fn at(&self, values: &[f64]) -> Point {
        let evaluation = match self.frame(values).and_then(|frame| self.evaluated(frame, self.dearest)) {
            Ok(evaluation) => evaluation,
            Err(why) => return Point::none(self.distance(values), why),
        };
        let measures = self.aim.shares(&evaluation, &self.scales);
        if let Some((measure, _)) = self.aim.measures().into_iter().zip(&measures).find(|(_, share)| !share.is_finite()) {
            return Point::none(self.distance(values), format!("the frame has no `{}`", measure.name));
        }
        let aim = self.aim.of(&measures, &self.scales, self.distance(values));
        let margins = margins(&evaluation, &self.constraints, &self.problem.goals);
        let violated = margins.iter().map(|margin| (-margin).max(0.0)).sum();
        Point { aim, measures, margins: Some(margins), violated, why: None }
    }
}

/// The rule or goal that is missed most; none when none is.
pub(super) fn worst_of(margins: &[f64], search: &Search) -> Option<String> {
    let (at, least) = margins.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    let (constraints, goals) = (search.constraints(), &search.problem().goals);
    let constraint = |constraint: &Constraint| format!("{} {}", constraint.rule.id, constraint.subject).trim_end().to_string();
    if *least >= 0.0 {
        return None;
    }
    constraints.get(at).map(constraint).or_else(|| goals.get(at - constraints.len()).map(Goal::reported))
}

/// Points that were looked at: those that keep everything first, by their aim; then by the sum of what they miss.
pub(super) fn ranked(search: &Search) -> Vec<Vec<f64>> {
    let mut all: Vec<(Vec<f64>, Point)> =
        search.order().into_iter().filter_map(|values| search.point_of(&values).map(|point| (values, point))).collect();
    all.sort_by(|(_, a), (_, b)| a.order(b));
    all.into_iter().map(|(values, _)| values).collect()
}
