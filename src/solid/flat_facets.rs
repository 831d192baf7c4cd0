//! Facets without area taken out of a mesh.
//!
//! Where an upright cut passes a corner of its outline, slopes on both sides end on the same upright line at different heights. Three
//! corners of that line can be one facet, whose area is exactly zero on the grid of what is written. Its longest side is exchanged for
//! the other diagonal of the two facets beside that side: the surface stays the same, and both facets have an area.

use super::mesh::Mesh;

/// Exchanges at the most: where several flat facets lie beside each other, one exchange hands a flat facet on to the next.
const MOST: usize = 64;

impl Mesh {
    /// The same surface without facets that have no area, as far as exchanged edges make it so; the gate says whether they did.
    pub fn without_flat_facets(&self) -> Self {
        let mut mesh = self.clone();
        for _ in 0..MOST {
            let Some(flat) = mesh.triangles.iter().position(|triangle| mesh.is_flat(triangle)) else { break };
            let [from, to, between] = mesh.longest_side_first(&mesh.triangles[flat]);
            let Some((beside, across)) = mesh.facet_beside(to, from) else { break };
            mesh.triangles[flat] = [to, between, across];
            mesh.triangles[beside] = [between, from, across];
        }
        let corners: Vec<_> = mesh.vertices.iter().map(|v| v.map(f64::from).into()).collect();
        Self::canonical(&corners, &mesh.triangles)
    }

    fn is_flat(&self, triangle: &[u32; 3]) -> bool {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a)).norm() <= 0.0
    }

    /// The corners of a triangle, its longest side between the first two.
    fn longest_side_first(&self, triangle: &[u32; 3]) -> [u32; 3] {
        let turned = |by: usize| [0, 1, 2].map(|at| triangle[(at + by) % 3]);
        let length = |triangle: &[u32; 3]| {
            let [a, b, _] = self.corners(triangle);
            (b - a).norm()
        };
        [turned(1), turned(2)].into_iter().fold(*triangle, |best, other| if length(&other) > length(&best) { other } else { best })
    }

    /// The facet with a side from one corner to another, and its third corner.
    fn facet_beside(&self, from: u32, to: u32) -> Option<(usize, u32)> {
        let third = |t: &[u32; 3]| (0..3).find(|at| t[*at] == from && t[(at + 1) % 3] == to).map(|at| t[(at + 2) % 3]);
        self.triangles.iter().enumerate().find_map(|(at, triangle)| third(triangle).map(|corner| (at, corner)))
    }
}

#[cfg(test)]
mod tests {
    use crate::solid::gate::{self, GateError};
    use crate::solid::{Feature, MeshSolid};

    #[test]
    fn planted_a_facet_on_an_edge_is_taken_out_and_the_solid_stays() {
        let mut mesh = MeshSolid::build(&Feature::cuboid([2.0, 2.0, 2.0])).to_mesh();
        let whole = mesh.clone();
        assert_eq!(mesh.without_flat_facets(), whole);
        // A corner in the middle of an upright edge, and the facet between it and the edge's ends.
        let at = |v: [f32; 3]| whole.vertices.iter().position(|corner| *corner == v).expect("is a corner") as u32;
        let (low, high) = (at([1.0, 1.0, -1.0]), at([1.0, 1.0, 1.0]));
        let (beside, across) = whole.facet_beside(low, high).expect("has facets");
        let middle = mesh.vertices.len() as u32;
        mesh.vertices.push([1.0, 1.0, 0.25]);
        mesh.triangles[beside] = [low, middle, across];
        mesh.triangles.extend([[middle, high, across], [low, high, middle]]);
        assert_eq!(gate::pass(&mesh), Err(GateError::ZeroArea { count: 1 }));
        let mended = mesh.without_flat_facets();
        assert!(gate::pass(&mended).is_ok() && mended.volume_mm3() == whole.volume_mm3(), "{mended:?}");
        assert_eq!(mended.triangles.len(), whole.triangles.len() + 2);
    }
}
