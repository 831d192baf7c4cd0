//! Whether anything is in the way while a step moves: the printed meshes, all along the motion that is shown.
//!
//! A step is looked at in places at most [`STEP_MM`] apart. Two pieces that are apart stay so until they have moved by
//! their distance, so most places are passed over: boxes around their facets tell it. Where boxes of facets meet, the mesh kernel
//! measures the volume in common; what a press fit means is allowed. What is joined slides along one bore and is measured in
//! some places only. The two sides of one part's hinge are no
//! pair: that their notch's faces press is the preload. Each is flat and rigid here; the bent web is part of neither.

use std::collections::BTreeSet;

use nalgebra::Isometry3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::member::Member;
use super::piece::{Piece, pieces};
use super::rules::Done;
use super::sequence::{FoldSequence, inputs};
use super::task::{FoldMotion, Task};
use super::timeline::{Moment, moment};
use crate::frame::assembly::Design;
use crate::memo::Key;

/// Farthest that anything moves between two places, mm.
pub const STEP_MM: f64 = 1.0;
/// Most places of a step.
const MOST_PLACES: usize = 400;
/// Places by which the length of a way is reported.
const COARSE: usize = 16;
/// What is joined is compared this often along a way: it slides in one bore.
pub const FITS_A_WAY: f64 = 4.0;
/// Pieces that move by less to each other do not move, mm.
const STILL_MM: f64 = 1e-6;

/// Two bodies that share more than is meant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Meeting {
    /// The bodies.
    pub bodies: [String; 2],
    /// Where on the step's way it is worst, 0 to 1.
    pub at: f64,
    /// Volume in common there, mm³.
    pub shared_mm3: f64,
    /// What may be, mm³.
    pub allowed_mm3: f64,
}

/// What a step's motion meets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// Places that the way was cut into.
    pub places: usize,
    /// Pairs of pieces that move to each other.
    pub pairs: usize,
    /// Comparisons of two meshes.
    pub comparisons: usize,
    /// Most that two bodies share beyond what is meant by their press fit, mm³.
    pub beyond_mm3: f64,
    /// Who meets, worst first.
    pub meetings: Vec<Meeting>,
}

/// What each step of a design's fold meets.
pub fn sweeps(design: &Design, fold: &FoldSequence) -> Vec<Sweep> {
    let pieces = pieces(design, &fold.module);
    let order = fold.order();
    let inputs = inputs(&design.frame, &design.skeleton);
    let step = |at| {
        let sweeper = Sweeper { design, fold, pieces: &pieces, order: &order, at, inputs };
        let there = sweeper.there();
        let read = (inputs, &order[..=at], there.iter().map(|piece| piece.inputs()).collect::<Vec<_>>());
        Sweep::clone(&design.memo.get("step of the fold", order[at].title(), &read, || sweeper.sweep(&there)))
    };
    (0..order.len()).map(step).collect()
}

struct Sweeper<'a> {
    design: &'a Design,
    fold: &'a FoldSequence,
    pieces: &'a [Piece],
    order: &'a [Task],
    at: usize,
    /// What the motions follow from.
    inputs: Key,
}

/// What was found of a pair.
#[derive(Clone, Serialize, Deserialize)]
struct Found {
    comparisons: usize,
    worst: Option<Meeting>,
}

impl Sweeper<'_> {
    fn sweep(&self, there: &[&Piece]) -> Sweep {
        let task = self.order[self.at];
        let ways = self.ways(there);
        let places = ways.first().map_or(0, Vec::len);
        let mut pairs = Vec::new();
        for (i, a) in there.iter().enumerate() {
            for (j, b) in there.iter().enumerate().skip(i + 1) {
                // The modules are one, turned or mirrored, and so is the hub: of two modules' pieces one may be taken from those that
                // stand for all.
                let hub = [a, b].iter().any(|p| p.member == Some(Member::Hub));
                let of_one = [a, b].iter().any(|p| self.is_representative(p.module));
                let stands_for_all = of_one || (!hub && a.module.is_none() != b.module.is_none());
                if a.name != b.name && stands_for_all {
                    pairs.push(if a.is_rod() { (j, i) } else { (i, j) });
                }
            }
        }
        let found: Vec<Found> =
            pairs.par_iter().filter_map(|&(i, j)| self.kept(task, [there[i], there[j]], [&ways[i], &ways[j]])).collect();
        let mut meetings: Vec<Meeting> = found.iter().filter_map(|f| f.worst.clone()).collect();
        let beyond_mm3 = meetings.iter().map(|m| m.shared_mm3 - m.allowed_mm3).fold(0.0, f64::max);
        meetings.retain(|m| m.shared_mm3 > m.allowed_mm3);
        meetings.sort_by(|a, b| (b.shared_mm3 - b.allowed_mm3).total_cmp(&(a.shared_mm3 - a.allowed_mm3)));
        Sweep { places, pairs: found.len(), comparisons: found.iter().map(|f| f.comparisons).sum(), beyond_mm3, meetings }
    }

    /// Whether what holds for a module holds for all.
    fn is_representative(&self, module: Option<usize>) -> bool {
        module.is_some_and(|module| self.fold.module.modules.representatives().contains(&module))
    }

    /// The pieces that are joined to something, or are now; beside the hub those that hang on it, as the rest lies apart.
    fn there(&self) -> Vec<&Piece> {
        let done = &self.order[..=self.at];
        let members: BTreeSet<Member> =
            done.iter().flat_map(|t| t.contacts().into_iter().chain(t.lever())).flat_map(|(a, b)| [a, b]).collect();
        let whole = members.contains(&Member::Hub);
        let members: BTreeSet<Member> = if whole {
            let rules = self.fold.rules(&self.design.frame, &self.design.skeleton);
            let on_hub = rules.component(Member::Hub, &done.iter().copied().collect());
            members.intersection(&on_hub).copied().collect()
        } else {
            members
        };
        let is_there = |p: &&Piece| match p.module {
            Some(_) => (whole || self.is_representative(p.module)) && p.member.is_some_and(|m| members.contains(&m)),
            None => whole,
        };
        self.pieces.iter().filter(is_there).collect()
    }

    /// Where each piece stands at each place.
    fn ways(&self, there: &[&Piece]) -> Vec<Vec<Isometry3<f64>>> {
        let rules = self.fold.rules(&self.design.frame, &self.design.skeleton);
        let (task, done): (Task, Done) = (self.order[self.at], self.order[..self.at].iter().copied().collect());
        let moments = |count: usize| -> Vec<Moment> {
            (0..=count).map(|i| moment(&rules, self.order, &done, (task, i as f64 / count as f64))).collect()
        };
        let along = |moments: &[Moment], piece: &Piece| moments.iter().map(|m| piece.pose(m, &self.fold.module)).collect::<Vec<_>>();
        let coarse = moments(COARSE);
        let length = |piece: &&Piece| travelled_mm(piece, &along(&coarse, piece), None).last().copied().unwrap_or(0.0);
        let longest = there.iter().map(length).fold(0.0, f64::max);
        let fine = moments(((longest / STEP_MM).ceil() as usize).clamp(COARSE, MOST_PLACES));
        there.iter().map(|piece| along(&fine, piece)).collect()
    }

    fn kept(&self, task: Task, [a, b]: [&Piece; 2], ways: [&Vec<Isometry3<f64>>; 2]) -> Option<Found> {
        let read = (self.inputs, &self.order[..=self.at], ways[0].len(), a.inputs(), b.inputs());
        let name = || format!("{}: {} and {}", task.title(), a.name, b.name);
        let is_worth = |found: &Option<Found>| found.as_ref().is_some_and(|found| found.comparisons > 0);
        Option::clone(&self.design.memo.get_worth("pair of pieces", &name(), &read, || self.pair(task, [a, b], ways), is_worth))
    }

    /// How two pieces get along; none when they do not move to each other.
    fn pair(&self, task: Task, [a, b]: [&Piece; 2], ways: [&Vec<Isometry3<f64>>; 2]) -> Option<Found> {
        let travelled = travelled_mm(b, ways[1], Some(ways[0]));
        let (last, way_mm) = (travelled.len() - 1, *travelled.last()?);
        if way_mm < STILL_MM {
            return None;
        }
        // A leg of the fork is squeezed flat on its way through the knee: only where it ends is it itself.
        let squeezed = task.motion() == FoldMotion::Slide && task.contacts() == [(Member::Knee, Member::Fork)];
        let joined = a.joins(b);
        let allowed_mm3 = a.meant_mm3(b, self.design);
        let mut found = Found { comparisons: 0, worst: None };
        let mut k = if squeezed { last } else { 0 };
        loop {
            let relative = ways[0][k].inverse() * ways[1][k];
            let mut free_mm = a.boxes().apart_mm(b.boxes(), &relative);
            if free_mm <= 0.0 {
                let shared_mm3 = a.shared_mm3(b, &relative);
                found.comparisons += 1;
                if shared_mm3 > 0.0 {
                    let at = k as f64 / last as f64;
                    let here = Meeting { bodies: [a.name.clone(), b.name.clone()], at, shared_mm3, allowed_mm3 };
                    found.worst = found.worst.filter(|worst| worst.shared_mm3 >= shared_mm3).or(Some(here));
                }
                free_mm = if joined { way_mm / FITS_A_WAY } else { 0.0 };
            }
            if k == last {
                return Some(found);
            }
            let passed = |next: &usize| travelled[*next] - travelled[k] >= free_mm;
            k = (k + 1..last).find(passed).unwrap_or(last);
        }
    }
}

/// How far a piece has moved at each place at most, seen from another or from the frame, mm: no point of a body moves
/// farther than the farthest corner of the box around it.
fn travelled_mm(piece: &Piece, way: &[Isometry3<f64>], seen_from: Option<&[Isometry3<f64>]>) -> Vec<f64> {
    let Some(corners) = piece.boxes().bounds().map(|bounds| bounds.corners()) else { return vec![0.0; way.len()] };
    let at = |k: usize| {
        let pose = seen_from.map_or(way[k], |other| other[k].inverse() * way[k]);
        corners.map(|corner| pose * corner)
    };
    let (mut sum, mut before) = (0.0, at(0));
    let mut travelled = vec![0.0];
    for k in 1..way.len() {
        let here = at(k);
        sum += before.iter().zip(&here).map(|(p, q)| (q - p).norm_squared()).fold(0.0, f64::max).sqrt();
        travelled.push(sum);
        before = here;
    }
    travelled
}
