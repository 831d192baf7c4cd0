//! Planes through points of a search: what a small change of the values does to the aim and to every margin.
//!
//! A margin is linear in the values but for kinks, where another pair becomes the tightest, and jumps. Planes by differences are
//! made once for each region and corrected by every further point (C. G. Broyden, A class of methods for solving nonlinear
//! simultaneous equations, 1965). The best step within a box is a small linear programme, or one with the distance as its aim;
//! COBYLA solves it on the planes, without looking at a frame.

use cobyla::{RhoBeg, StopTols};
use nalgebra::{DMatrix, DVector};

use super::aim::Aim;
use super::point::Point;
use super::search::Search;

/// How much of a margin is kept in reserve, scaled: what is solved to equality is then on the good side.
const RESERVE: f64 = 0.002;
/// Planes that differ by less in the whole box are the same, scaled.
const SAME: f64 = 1e-9;
/// What a unit of a violated margin costs, in units of the aim: more than any aim gains by it.
const PRICE: f64 = 10.0;
/// Steps of COBYLA on the planes, in shares of the box, first and last, and the most of them.
const STEPS: [f64; 2] = [0.5, 1e-4];
const MOST: usize = 3000;

/// Which way differences are taken from a point, where there is a frame.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// Where there is more room.
    First,
    /// The other way.
    Other,
}

/// The aim and the margins around a point, to first order.
pub(super) struct Planes {
    /// The values at which they touch.
    here: Vec<f64>,
    /// What is known there.
    point: Point,
    margins: Vec<f64>,
    /// How the aim's measures, first, and the margins change, a row each, with the shares, a column each.
    slopes: DMatrix<f64>,
}

impl Planes {
    /// Planes at values that were looked at, by differences over this share of the bounds; none where there is no frame. They touch the
    /// best of the points that they are made of. A margin with a kink there has another slope on its other side.
    pub fn at(search: &Search, values: &[f64], reach: f64, way: Way) -> Option<Self> {
        let point = search.point_of(values)?;
        let margins = point.margins.clone()?;
        let slopes = DMatrix::zeros(point.measures.len() + margins.len(), values.len());
        let mut planes = Self { here: values.to_vec(), point, margins, slopes };
        let sides = |at: usize| {
            let [first, other] = search.problem().vary[at].beside(values, at, reach);
            if way == Way::First { [first, other] } else { [other, first] }
        };
        let beside: Vec<[Vec<f64>; 2]> = (0..values.len()).map(sides).collect();
        search.look_at(&beside.iter().map(|[first, _]| first.clone()).collect::<Vec<_>>());
        let there = |values: &Vec<f64>| search.point_of(values).is_some_and(|point| point.margins.is_some());
        // Where there is no frame on one side there may be one on the other.
        search.look_at(&beside.iter().filter(|[first, _]| !there(first)).map(|[_, other]| other.clone()).collect::<Vec<_>>());
        let made_of: Vec<&Vec<f64>> = beside.iter().filter_map(|sides| sides.iter().find(|values| there(values))).collect();
        made_of.iter().for_each(|values| planes.learn(search, values));
        planes.move_to_better(search, made_of);
        Some(planes)
    }

    /// Corrects the planes by values that were looked at, along the way to them.
    pub fn learn(&mut self, search: &Search, values: &[f64]) {
        let Some(Point { measures, margins: Some(margins), .. }) = search.point_of(values) else { return };
        let way = self.way(search, values);
        let length = way.norm_squared();
        if length == 0.0 {
            return;
        }
        let [there, here] = [(&measures, &margins), (&self.point.measures, &self.margins)].map(|(a, b)| a.iter().chain(b));
        let changed = there.zip(here).map(|(there, here)| there - here);
        let missed = DVector::from_iterator(self.slopes.nrows(), changed) - &self.slopes * &way;
        self.slopes += missed * way.transpose() / length;
    }

    /// Moves to the best of these values if it is better than where the planes touch; says which it is then.
    pub fn move_to_better<'v>(&mut self, search: &Search, among: impl IntoIterator<Item = &'v Vec<f64>>) -> Option<&'v Vec<f64>> {
        let known = among.into_iter().filter_map(|values| Some((values, search.point_of(values)?)));
        let (values, point) = known.filter(|(_, point)| point.better_than(&self.point)).min_by(|(_, a), (_, b)| a.order(b))?;
        self.margins = point.margins.clone()?;
        (self.here, self.point) = (values.clone(), point);
        Some(values)
    }

    /// The values at which they touch.
    pub fn here(&self) -> &[f64] {
        &self.here
    }

    /// What is known there.
    pub fn point(&self) -> &Point {
        &self.point
    }

    fn way(&self, search: &Search, values: &[f64]) -> DVector<f64> {
        DVector::from_vec(search.shares(values)) - DVector::from_vec(search.shares(&self.here))
    }

    /// The values that are best by the planes, no farther from the centre than a share of the bounds in each.
    pub fn best_within(&self, search: &Search, radius: f64) -> Vec<f64> {
        let (count, centre) = (self.here.len(), search.shares(&self.here));
        let tight = self.tight(radius);
        // What is violated may stay so at a price, each by itself, lest one of them pays for all others.
        let violated: Vec<usize> = tight.iter().copied().filter(|&at| self.margins[at] < RESERVE).collect();
        let slack = |at: usize| count + violated.iter().position(|&other| other == at).unwrap_or(violated.len());
        let bounds: Vec<(f64, f64)> = centre
            .iter()
            .map(|share| ((-share / radius).max(-1.0), ((1.0 - share) / radius).min(1.0)))
            .chain(violated.iter().map(|&at| (0.0, 2.0 * (RESERVE - self.margins[at]))).chain([(0.0, f64::from(u8::MAX))]))
            .collect();
        let mut start = vec![0.0; count];
        start.extend(violated.iter().map(|&at| RESERVE - self.margins[at]));
        start.push(0.0);
        let kept: Vec<_> = tight
            .iter()
            .map(|&at| move |x: &[f64], (): &mut ()| self.margin(at, &x[..count], radius) - RESERVE + x[slack(at)])
            .map(|constraint| Box::new(constraint) as Box<dyn Fn(&[f64], &mut ()) -> f64 + '_>)
            .collect();
        let at =
            |step: &[f64]| -> Vec<f64> { centre.iter().zip(step).map(|(share, part)| (share + part * radius).clamp(0.0, 1.0)).collect() };
        let price =
            |x: &[f64], (): &mut ()| self.aim(search, &at(&x[..count]), &x[..count], radius) + PRICE * x[count..].iter().sum::<f64>();
        let tolerances = StopTols { xtol_abs: vec![STEPS[1]; start.len()], ..StopTols::default() };
        // However it ends, its last point is as good as any that planes can name: the frame there decides.
        let step = match cobyla::minimize(price, &start, &bounds, &kept, (), MOST, RhoBeg::All(STEPS[0]), Some(tolerances)) {
            Ok((_, step, _)) | Err((_, step, _)) => step,
        };
        search.values(&at(&step[..count]))
    }

    /// The margins that a step within the box can bring below what is kept in reserve, each once, and those that are below it where a step can
    /// change them: with two planes that are the same, as of a limit and a goal of the same value, the solver has been seen to go round for ever.
    fn tight(&self, radius: f64) -> Vec<usize> {
        let slopes = |at: usize| self.slopes.row(self.point.measures.len() + at);
        let steepness = |at: usize| slopes(at).iter().map(|slope| slope.abs()).sum::<f64>();
        let same = |a: usize, b: usize| {
            let off =
                (self.margins[a] - self.margins[b]).abs() + radius * (slopes(a) - slopes(b)).iter().map(|slope| slope.abs()).sum::<f64>();
            off < SAME
        };
        let mut tight: Vec<usize> = Vec::new();
        for at in 0..self.margins.len() {
            let is_tight = steepness(at) > 0.0 && self.margins[at] - radius * steepness(at) < RESERVE;
            if is_tight && tight.iter().all(|&other| !same(other, at)) {
                tight.push(at);
            }
        }
        tight
    }

    fn row(&self, row: usize, step: &[f64], radius: f64) -> f64 {
        radius * self.slopes.row(row).iter().zip(step).map(|(slope, part)| slope * part).sum::<f64>()
    }

    fn margin(&self, at: usize, step: &[f64], radius: f64) -> f64 {
        self.margins[at] + self.row(self.point.measures.len() + at, step, radius)
    }

    /// The aim after a step that leads to these shares.
    fn aim(&self, search: &Search, to: &[f64], step: &[f64], radius: f64) -> f64 {
        let shares: Vec<f64> = self.point.measures.iter().enumerate().map(|(row, share)| share + self.row(row, step, radius)).collect();
        let distance = match search.aim() {
            Aim::Near(from) => search.shares(from).iter().zip(to).map(|(from, to)| (to - from).powi(2)).sum(),
            _ => 0.0,
        };
        search.aim().of(&shares, search.scales(), distance)
    }
}
