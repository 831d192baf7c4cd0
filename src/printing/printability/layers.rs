//! A part in layers, as it is printed.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::solid::{Mesh, MeshSolid, Region};

/// Corners of a cut that are nearer than this to the line between their neighbours are left out, mm.
const WITHIN_MM: f64 = 0.005;

/// The layers of a part in print orientation, resting on z = 0. Cut are the middles of those that are asked for.
pub(super) struct Layers {
    layer_mm: f64,
    /// The cuts that were made.
    cuts: BTreeMap<usize, Region>,
    /// Layers that hang over the one below.
    hanging: Vec<usize>,
}

/// A layer is cut this much above its middle, mm: facets that lie exactly there belong to the layer below then, and to no cut.
const ABOVE_MM: f64 = 7e-4;

impl Layers {
    /// The layers that hang over those below by a facet that leans out of the vertical by more than an angle with this sine; each with the one below.
    pub fn hanging_over(solid: &MeshSolid, mesh: &Mesh, layer_mm: f64, least_sine: f64) -> Self {
        let count = (mesh.bounds_mm()[1][2] / layer_mm - 0.5).ceil().max(1.0) as usize;
        let mut hangs = vec![false; count];
        for triangle in &mesh.triangles {
            let corners = mesh.corners(triangle);
            let cross = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
            if -cross.z <= least_sine * cross.norm() {
                continue;
            }
            let heights = corners.map(|c| c.z);
            let (low, high) = heights.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), z| (low.min(*z), high.max(*z)));
            // The facet lies between the middles of these layers and of those below them.
            let [first, last] = [low, high].map(|z| ((z - ABOVE_MM) / layer_mm + 0.5).floor().max(0.0) as usize);
            hangs.iter_mut().take(last + 1).skip(first).for_each(|hangs| *hangs = true);
        }
        let hanging: Vec<usize> = (1..count).filter(|at| hangs[*at]).collect();
        let mut wanted: Vec<usize> = hanging.iter().flat_map(|at| [at - 1, *at]).collect();
        wanted.sort_unstable();
        wanted.dedup();
        let cuts = wanted
            .into_par_iter()
            .map(|at| (at, solid.slice((at as f64 + 0.5) * layer_mm + ABOVE_MM).simplified(WITHIN_MM)))
            .collect::<Vec<_>>();
        Self { layer_mm, cuts: cuts.into_iter().collect(), hanging }
    }

    /// Those that hang over.
    pub fn hanging(&self) -> &[usize] {
        &self.hanging
    }

    /// A cut that was made; nothing where none was.
    pub fn cut(&self, at: usize) -> Option<&Region> {
        self.cuts.get(&at)
    }

    /// Underside of a layer, mm.
    pub fn bottom_mm(&self, at: usize) -> f64 {
        at as f64 * self.layer_mm
    }
}
