//! How thick walls are, and how wide what is open between them, in the cuts that the nozzle follows.
//!
//! The mesh is cut at the middle of layers. From the middle of each piece of the outline a ray goes square into the
//! material, and one out of it; where the facet that it meets looks back, its length is a wall's thickness or a gap's
//! width. Pieces of facets that lie flatter than 45° are left out: the crown of a lying tube is narrow, but no wall.
//! Reported is the size that [`AREA_MM2`] of the surface falls below, so that a sliver at a tangent edge is no wall.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::solid::{CutPlane, Mesh};

/// Surface that must be thin before a wall, or a floor, is, mm².
pub const AREA_MM2: f64 = 0.5;
/// Least cosine between the directions of opposite facets: 10°. What narrows faster is a wedge, whose edge is thin by nature.
const OPPOSITE: f64 = 0.985;
/// Largest upward or downward part of the direction of a facet that bounds a wall.
const UPRIGHT: f64 = 0.7;
/// Longest piece of an outline that one ray stands for, mm.
const PIECE_MM: f64 = 1.0;
/// Rays begin this far from their piece, mm.
const OFF_MM: f64 = 1e-4;
/// Least distance of cuts, mm.
const STEP_MM: f64 = 0.4;

/// A size and where it was found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thin {
    /// Thickness or width, mm.
    pub mm: f64,
    /// Where, in print axes, mm.
    pub at_mm: [f64; 3],
}

/// The thinnest of both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Walls {
    /// Wall.
    pub wall: Option<Thin>,
    /// Gap.
    pub gap: Option<Thin>,
}

/// A size with the surface that it stands for, mm².
pub(super) type Sample = (Thin, f64);

impl Walls {
    /// Those of a part in print axes; what is larger than the reach, mm, is not looked at.
    pub fn of(mesh: &Mesh, layer_mm: f64, reach_mm: f64) -> Self {
        let cuts: Vec<[Vec<Sample>; 2]> =
            heights(mesh, layer_mm).into_par_iter().map(|(z_mm, height_mm)| Cut::of(mesh, z_mm, reach_mm).samples(height_mm)).collect();
        let all = |side: usize| least(cuts.iter().flat_map(|cut| cut[side].iter().copied()).collect(), AREA_MM2);
        Self { wall: all(0), gap: all(1) }
    }
}

/// Heights of cuts, and of what each stands for, mm, up to the top of the part: where nothing changes one is enough.
fn heights(mesh: &Mesh, layer_mm: f64) -> Vec<(f64, f64)> {
    let step_mm = layer_mm * (STEP_MM / layer_mm).ceil();
    let top_mm = mesh.bounds_mm()[1][2];
    // A last slice that is no layer high has no middle of one.
    let count = ((top_mm - 0.5 * layer_mm) / step_mm).ceil().max(1.0) as usize;
    let mut changes = vec![false; count];
    for triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(triangle);
        let cross = (b - a).cross(&(c - a));
        if cross.z.abs() > 1e-6 * cross.norm() {
            let zs = [a.z, b.z, c.z];
            let number = |z: f64| ((z - 0.5 * layer_mm) / step_mm).max(0.0);
            // It lies between these cuts and those below them.
            let first = number(zs.into_iter().fold(f64::INFINITY, f64::min)).ceil() as usize;
            let last = number(zs.into_iter().fold(0.0, f64::max)).ceil() as usize;
            changes.iter_mut().take(last + 1).skip(first).for_each(|changes| *changes = true);
        }
    }
    let mut heights: Vec<(f64, f64)> = Vec::new();
    for (at, changes) in changes.into_iter().enumerate() {
        let low_mm = at as f64 * step_mm;
        let height_mm = step_mm.min(top_mm - low_mm);
        match heights.last_mut().filter(|_| !changes) {
            Some((_, all_mm)) => *all_mm += height_mm,
            None => heights.push((low_mm + 0.5 * layer_mm, height_mm)),
        }
    }
    heights
}

/// The size that an area falls below.
pub(super) fn least(mut samples: Vec<Sample>, area_mm2: f64) -> Option<Thin> {
    samples.sort_by(|a, b| a.0.mm.total_cmp(&b.0.mm));
    let mut sum = 0.0;
    samples.into_iter().find_map(|(thin, area)| {
        sum += area;
        (sum >= area_mm2).then_some(thin)
    })
}

/// A piece of an outline, its facet's direction, and the direction square into the material in the plane.
struct Piece {
    ends: [[f64; 2]; 2],
    normal: Vector3<f64>,
}

struct Cut {
    z_mm: f64,
    reach_mm: f64,
    pieces: Vec<Piece>,
    grid: Grid,
}

impl Cut {
    fn of(mesh: &Mesh, z_mm: f64, reach_mm: f64) -> Self {
        let plane = CutPlane { origin: Point3::new(0.0, 0.0, z_mm), axes: [Vector3::x(), Vector3::y()] };
        let normal = |facet: usize| {
            let [a, b, c] = mesh.corners(&mesh.triangles[facet]);
            (b - a).cross(&(c - a)).normalize()
        };
        let pieces: Vec<Piece> = mesh.cut_facets(&plane).into_iter().map(|(facet, ends)| Piece { ends, normal: normal(facet) }).collect();
        let grid = Grid::of(&pieces, reach_mm);
        Self { z_mm, reach_mm, pieces, grid }
    }

    /// Samples of walls and of gaps; the cut stands for this height, mm.
    fn samples(&self, height_mm: f64) -> [Vec<Sample>; 2] {
        let mut samples = [Vec::new(), Vec::new()];
        for piece in self.pieces.iter().filter(|piece| piece.normal.z.abs() <= UPRIGHT) {
            let [a, b] = piece.ends;
            let along = [b[0] - a[0], b[1] - a[1]];
            let length = libm::hypot(along[0], along[1]);
            if length < OFF_MM {
                continue;
            }
            let into = [-along[1] / length, along[0] / length];
            let rays = (length / PIECE_MM).ceil();
            for ray in 0..rays as usize {
                let t = (ray as f64 + 0.5) / rays;
                let from = [a[0] + t * along[0], a[1] + t * along[1]];
                for (side, towards) in [into, into.map(|c| -c)].into_iter().enumerate() {
                    if let Some(mm) = self.opposite_mm(piece, from, towards) {
                        samples[side].push((Thin { mm, at_mm: [from[0], from[1], self.z_mm] }, length / rays * height_mm));
                    }
                }
            }
        }
        samples
    }

    /// Distance of the first piece that a ray meets, when its facet looks back.
    fn opposite_mm(&self, piece: &Piece, from: [f64; 2], towards: [f64; 2]) -> Option<f64> {
        let mut first: Option<(f64, &Piece)> = None;
        let to = [0, 1].map(|axis| from[axis] + self.reach_mm * towards[axis]);
        for other in self.grid.touched(from, to).flat_map(|cell| &self.grid.cells[cell]).map(|at| &self.pieces[*at as usize]) {
            // Most pieces are to one side of the ray.
            let [[ax, ay], [bx, by]] = other.ends;
            let [ax, ay, bx, by] = [ax - from[0], ay - from[1], bx - from[0], by - from[1]];
            let (a_across, b_across) = (ay * towards[0] - ax * towards[1], by * towards[0] - bx * towards[1]);
            if (a_across > 0.0) == (b_across > 0.0) {
                continue;
            }
            let (a_along, b_along) = (ax * towards[0] + ay * towards[1], bx * towards[0] + by * towards[1]);
            let t = a_along + (b_along - a_along) * a_across / (a_across - b_across);
            if t > OFF_MM && t < first.map_or(self.reach_mm, |(first, _)| first) {
                first = Some((t, other));
            }
        }
        first.filter(|(_, other)| other.normal.dot(&piece.normal) < -OPPOSITE).map(|(t, _)| t)
    }
}

/// Pieces by the squares that the boxes around them touch.
struct Grid {
    low: [f64; 2],
    cell_mm: f64,
    count: [usize; 2],
    cells: Vec<Vec<u32>>,
}

impl Grid {
    fn of(pieces: &[Piece], cell_mm: f64) -> Self {
        let ends = || pieces.iter().flat_map(|piece| piece.ends);
        let low = [0, 1].map(|axis| ends().map(|p| p[axis]).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|axis| ends().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max));
        let count = [0, 1].map(|axis| ((high[axis] - low[axis]) / cell_mm).max(0.0) as usize + 1);
        let mut grid = Self { low, cell_mm, count, cells: vec![Vec::new(); count[0] * count[1]] };
        for (at, Piece { ends: [a, b], .. }) in pieces.iter().enumerate() {
            for cell in grid.touched(*a, *b) {
                grid.cells[cell].push(at as u32);
            }
        }
        grid
    }

    /// The squares that the box around two points touches.
    fn touched(&self, a: [f64; 2], b: [f64; 2]) -> impl Iterator<Item = usize> + use<> {
        let number = |axis: usize, x: f64| (((x - self.low[axis]) / self.cell_mm).max(0.0) as usize).min(self.count[axis] - 1);
        let [x, y] = [0, 1].map(|axis| number(axis, a[axis].min(b[axis]))..=number(axis, a[axis].max(b[axis])));
        let across = self.count[0];
        y.flat_map(move |y| x.clone().map(move |x| y * across + x))
    }
}
