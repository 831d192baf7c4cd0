//! What of a part is printed over air.
//!
//! A layer reaches over the one below by its height times the tangent of the angle that needs no support; what lies
//! farther out hangs. What hangs in layers one upon another is one place: the top of a lying bore is a bridge from side to
//! side, not a row of strips.

use super::chords::{self, Laid};
use super::layers::Layers;
use super::process::Process;
use crate::solid::{Mesh, MeshSolid, Region};

/// A place that hangs.
#[derive(Clone)]
pub struct Hanging {
    /// In plan, print axes.
    pub plan: Region,
    /// Layer by layer: the height of its underside, mm, and what of it hangs over the one below.
    pub layers: Vec<(f64, Region)>,
    /// Its area in plan, mm².
    pub area_mm2: f64,
    /// Height of its lowest and highest layer's underside, mm.
    pub heights_mm: [f64; 2],
    /// Whether it begins with a piece that touches nothing below.
    pub island: bool,
    /// How far its farthest corner is from what it rests on, mm; endless for one that rests on nothing. Where most of it rests at both ends, how far
    /// what does not.
    pub reach_mm: f64,
    /// Longest line across it from one support to another, mm.
    pub span_mm: f64,
    /// Whether lines of one direction rest at both ends over nearly all of it.
    pub bridged: bool,
}

/// A place to which layers are still added.
struct Open {
    plan: Region,
    layers: Vec<(usize, Region)>,
    /// What was below it, near it.
    under: Region,
    first: usize,
    last: usize,
    island: bool,
}

/// Pieces that are apart by no more than this touch, mm.
const TOUCH_MM: f64 = 0.02;
/// Of what a place rests on, this much around it is looked at, mm.
const AROUND_MM: f64 = 0.5;
/// Pieces smaller than this are left out, mm².
const LEAST_MM2: f64 = 1e-3;
/// Share of a bridge that may hang loose: its rounded corners.
const LOOSE_SHARE: f64 = 0.15;
/// Of what hangs, so much may be loose for the rest to be a bridge beside it: of less nothing rests at both ends.
const MOST_LOOSE: f64 = 0.98;

/// Every place of a part that hangs and is wider than a line; solid and mesh are the same.
pub(super) fn of(solid: &MeshSolid, mesh: &Mesh, process: &Process) -> Vec<Hanging> {
    let layers = Layers::hanging_over(solid, mesh, process.layer_mm, process.overhang.sin());
    let sizes = Sizes { line_mm: process.line_mm, step_mm: process.layer_mm * process.overhang.tan() };
    places(&layers, sizes)
}

/// Sizes by which it is judged.
#[derive(Clone, Copy)]
struct Sizes {
    /// Width of a line, mm.
    line_mm: f64,
    /// How far a layer may reach over the one below, mm.
    step_mm: f64,
}

fn places(layers: &Layers, sizes: Sizes) -> Vec<Hanging> {
    let mut open: Vec<Open> = Vec::new();
    let mut closed = Vec::new();
    for &at in layers.hanging() {
        let (Some(below), Some(cut)) = (layers.cut(at - 1), layers.cut(at)) else { continue };
        let (still, done): (Vec<Open>, Vec<Open>) = open.into_iter().partition(|place| place.last + 1 == at);
        closed.extend(done);
        open = still;
        for [plan, under] in over_air(below, cut, sizes) {
            let is_apart = under.is_empty() || plan.grown(TOUCH_MM).intersection(&under).is_empty();
            let island = is_apart && !stands(cut, below, &plan);
            // The next layer closes a gap of two steps.
            let near = plan.grown(2.0 * sizes.step_mm + TOUCH_MM);
            let touches = |place: &Open| near.may_meet(&place.plan) && !place.plan.intersection(&near).is_empty();
            let (joined, apart): (Vec<Open>, Vec<Open>) = open.into_iter().partition(|place| touches(place));
            open = apart;
            let own = Open { layers: vec![(at, plan.clone())], plan, under, first: at, last: at, island };
            open.push(joined.into_iter().fold(own, |all, one| Open {
                plan: all.plan.union(&one.plan),
                layers: [one.layers, all.layers].concat(),
                under: all.under.union(&one.under),
                first: all.first.min(one.first),
                last: at,
                island: all.island || one.island,
            }));
        }
    }
    closed.extend(open);
    closed.into_iter().filter_map(|place| place.closed(layers, sizes)).collect()
}

/// Whether a piece of a layer is of a body that lies on the layer below somewhere: such a piece hangs off that body, however far from what is below.
fn stands(cut: &Region, below: &Region, piece: &Region) -> bool {
    let own = cut.bodies().into_iter().filter(|body| body.may_meet(piece) && !body.intersection(piece).is_empty());
    own.into_iter().any(|body| !body.intersection(below).is_empty())
}

/// What of a layer hangs over the one below, in pieces: its plan and what is below around it.
fn over_air(below: &Region, cut: &Region, sizes: Sizes) -> Vec<[Region; 2]> {
    let mut pieces = Vec::new();
    for out in cut.minus(below).bodies() {
        if out.area_mm2() < LEAST_MM2 {
            continue;
        }
        let near = below.within(out.bounds_mm(), AROUND_MM);
        let beyond = out.minus(&near.grown(sizes.step_mm + 1e-4));
        if beyond.area_mm2() < LEAST_MM2 {
            continue;
        }
        // Growing gathers crumbs of the cut beside it: a crumb that is left out of what hangs is no island either.
        let grown = beyond.grown(sizes.step_mm + TOUCH_MM).intersection(&out).bodies();
        for plan in grown.into_iter().filter(|plan| plan.area_mm2() >= LEAST_MM2) {
            let under = plan.grown(AROUND_MM).intersection(&near);
            pieces.push([plan, under]);
        }
    }
    pieces
}

impl Open {
    fn closed(self, layers: &Layers, sizes: Sizes) -> Option<Hanging> {
        // What is narrower than a line along an axis is so after its gaps are closed, too.
        let [low, high] = self.plan.bounds_mm();
        if (0..2).any(|axis| high[axis] - low[axis] < sizes.line_mm - TOUCH_MM) {
            return None;
        }
        let plan = self.plan.grown(sizes.step_mm).grown(-sizes.step_mm);
        // A strip that is narrower than a line is laid on what is beside it.
        if plan.grown(-0.5 * sizes.line_mm).is_empty() {
            return None;
        }
        // Not the slivers at the seams between its layers.
        let support = self.under.minus(&plan.grown(TOUCH_MM));
        let Laid { loose_mm2, span_mm, loose_reach_mm } = chords::best(&plan, &support, sizes.line_mm);
        let area_mm2 = plan.area_mm2();
        let heights_mm = [layers.bottom_mm(self.first), layers.bottom_mm(self.last)];
        let farthest_mm = chords::farthest_mm(&plan, &support);
        // Where some lines rest at both ends, only what does not reaches out.
        let reach_mm = if loose_mm2 < MOST_LOOSE * area_mm2 { farthest_mm.min(loose_reach_mm) } else { farthest_mm };
        let reach_mm = (reach_mm - TOUCH_MM).max(0.0);
        let layers = self.layers.into_iter().map(|(at, piece)| (layers.bottom_mm(at), piece)).collect();
        Some(Hanging {
            plan,
            layers,
            area_mm2,
            heights_mm,
            island: self.island,
            reach_mm,
            span_mm,
            bridged: loose_mm2 <= LOOSE_SHARE * area_mm2,
        })
    }
}
