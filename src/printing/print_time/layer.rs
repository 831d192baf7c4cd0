//! What of a printed layer decides how long it takes.

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};

use crate::solid::{CutPlane, Mesh, Piece};

/// Radius of a loop up to which PrusaSlicer prints it slowly, mm (`SMALL_PERIMETER_LENGTH` there); Orca and Bambu do so only where they are told.
pub const SHORT_LOOP_MM: f64 = 6.5;
/// The length of that loop, mm.
const SHORT_MM: f64 = std::f64::consts::TAU * SHORT_LOOP_MM;

/// A layer's section, cut in the middle of its height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LayerShape {
    /// Its area, mm².
    pub area_mm2: f64,
    /// Length of all its outlines, mm.
    pub outline_mm: f64,
    /// Of these, what belongs to short loops, mm.
    pub short_mm: f64,
    /// How many loops it has.
    pub loops: usize,
}

/// The layers of a mesh in print orientation that rests on z = 0.
pub(super) fn layers(mesh: &Mesh, layer_mm: f64) -> Vec<LayerShape> {
    let [low, high] = mesh.bounds_mm();
    let count = ((high[2] - low[2]) / layer_mm).round().max(1.0) as usize;
    let middle = |at: usize| Point3::new(0.0, 0.0, low[2] + (at as f64 + 0.5) * layer_mm);
    let plane = |at: usize| CutPlane::across(middle(at), &Vector3::z(), &Vector3::y());
    (0..count).filter_map(plane).map(|plane| LayerShape::of(&mesh.cut(&plane))).collect()
}

impl LayerShape {
    fn of(pieces: &[Piece]) -> Self {
        let mut shape =
            Self { area_mm2: pieces.iter().map(|[a, b]| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum::<f64>().abs(), ..Self::default() };
        for length_mm in loop_lengths_mm(pieces) {
            shape.outline_mm += length_mm;
            shape.loops += 1;
            shape.short_mm += if length_mm <= SHORT_MM { length_mm } else { 0.0 };
        }
        shape
    }
}

/// Lengths of the loops that pieces make; neighbours share an end to the last bit.
fn loop_lengths_mm(pieces: &[Piece]) -> Vec<f64> {
    // A facet that touches the plane with a corner has a piece without length, which would end a loop.
    let pieces: Vec<&Piece> = pieces.iter().filter(|[from, to]| from != to).collect();
    let bits = |end: [f64; 2]| end.map(f64::to_bits);
    let begins: BTreeMap<[u64; 2], usize> = pieces.iter().enumerate().map(|(at, [from, _])| (bits(*from), at)).collect();
    let mut done = vec![false; pieces.len()];
    let mut lengths = Vec::new();
    for first in 0..pieces.len() {
        let (mut at, mut length_mm) = (Some(first), 0.0);
        while let Some(piece) = at.filter(|piece| !done[*piece]) {
            done[piece] = true;
            let [from, to] = *pieces[piece];
            length_mm += libm::hypot(to[0] - from[0], to[1] - from[1]);
            at = begins.get(&bits(to)).copied();
        }
        if length_mm > 0.0 {
            lengths.push(length_mm);
        }
    }
    lengths
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    #[test]
    fn analytic_a_tube_with_a_bore_has_two_loops_a_layer() {
        let tube = Feature::cylinder(10.0, 4.0).minus([Feature::cylinder(3.0, 6.0).at(0.0, 0.0, -1.0)]);
        let shapes = layers(&MeshSolid::build(&tube).to_mesh(), 0.2);
        assert_eq!(shapes.len(), 20);
        let [outer, inner] = [10.0, 3.0].map(|r| std::f64::consts::TAU * r);
        for shape in shapes {
            assert_eq!(shape.loops, 2);
            assert!((shape.short_mm / inner - 1.0).abs() < 0.01 && (shape.outline_mm / (outer + inner) - 1.0).abs() < 0.01, "{shape:?}");
            assert!((shape.area_mm2 / (std::f64::consts::PI * 91.0) - 1.0).abs() < 0.01, "{shape:?}");
        }
    }
}
