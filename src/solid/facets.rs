//! The facets of a solid with the kernel's own numbers: what is kept of it.

use std::sync::OnceLock;

use manifold_rust::manifold::Manifold;
use manifold_rust::types::MeshGL64;
use nalgebra::{Isometry3, Point3};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::mesh::Mesh;
use super::stout;
use crate::memo::Key;

/// Corners and triangles of a closed surface, mm.
#[derive(Clone)]
pub(super) struct Facets {
    /// Its corners.
    pub corners: Vec<[f64; 3]>,
    /// Indices of corners, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    key: OnceLock<Key>,
}

impl Facets {
    /// Of a solid, in the kernel's own order. Its export would sort them by the solids that they come from, which the kernel numbers as
    /// they are made: the order would depend on what was made before.
    pub fn of(solid: &Manifold) -> Self {
        let solid = solid.as_impl();
        let corners = solid.vert_pos.iter().map(|p| [p.x, p.y, p.z]).collect();
        let triangles = solid.halfedge.chunks_exact(3).map(|t| [0, 1, 2].map(|i| t[i].start_vert as u32)).collect();
        Self { corners, triangles, key: OnceLock::new() }
    }

    /// Of a written mesh.
    pub fn of_mesh(mesh: &Mesh) -> Self {
        let corners = mesh.vertices.iter().map(|corner| corner.map(f64::from)).collect();
        Self { corners, triangles: mesh.triangles.clone(), key: OnceLock::new() }
    }

    /// The kernel's solid of them; empty when they are not closed.
    pub fn kernel(&self) -> Manifold {
        Manifold::from_mesh_gl64(&MeshGL64 {
            num_prop: 3,
            vert_properties: self.corners.iter().flatten().copied().collect(),
            tri_verts: self.triangles.iter().flatten().map(|i| u64::from(*i)).collect(),
            ..Default::default()
        })
    }

    /// What tells them from others, to the last bit.
    pub fn key(&self) -> Key {
        let corners = || self.corners.iter().flatten().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
        let triangles = || self.triangles.iter().flatten().flat_map(|index| index.to_le_bytes()).collect::<Vec<u8>>();
        *self.key.get_or_init(|| Key::of_bytes([corners().as_slice(), triangles().as_slice()]))
    }

    /// The corners of each separate body.
    pub fn bodies(&self) -> Vec<Vec<Point3<f64>>> {
        let of = self.body_of_corners();
        let mut bodies: Vec<Vec<Point3<f64>>> = vec![Vec::new(); self.corners.len()];
        for (corner, body) in self.corners.iter().zip(of) {
            bodies[body as usize].push(Point3::from(*corner));
        }
        bodies.retain(|corners| !corners.is_empty());
        bodies
    }

    /// For each corner the same number as for the others of its body.
    fn body_of_corners(&self) -> Vec<u32> {
        self.first_of_joined(self.triangles.iter().flat_map(|[a, b, c]| [(*a, *b), (*a, *c)]))
    }

    /// For each corner the first of those that pairs join it to, directly or by others.
    fn first_of_joined(&self, pairs: impl Iterator<Item = (u32, u32)>) -> Vec<u32> {
        fn root(above: &mut [u32], mut at: u32) -> u32 {
            while above[at as usize] != at {
                above[at as usize] = above[above[at as usize] as usize];
                at = above[at as usize];
            }
            at
        }
        let mut above: Vec<u32> = (0..self.corners.len() as u32).collect();
        for (one, other) in pairs {
            let (one, two) = (root(&mut above, one), root(&mut above, other));
            above[one.max(two) as usize] = one.min(two);
        }
        (0..above.len() as u32).map(|corner| root(&mut above, corner)).collect()
    }

    /// The same with corners within a distance, mm, made one, and without the facets that are none then.
    pub fn welded(&self, within_mm: f64) -> Self {
        let mut by_x: Vec<u32> = (0..self.corners.len() as u32).collect();
        let corner = |at: u32| Point3::from(self.corners[at as usize]);
        by_x.sort_unstable_by(|a, b| corner(*a).x.total_cmp(&corner(*b).x).then(a.cmp(b)));
        let near = by_x.iter().enumerate().flat_map(|(at, one)| {
            let after = by_x[at + 1..].iter().take_while(move |other| corner(**other).x - corner(*one).x <= within_mm);
            after.filter(move |other| (corner(**other) - corner(*one)).norm() <= within_mm).map(|other| (*one, *other))
        });
        let first = self.first_of_joined(near);
        let joined = self.triangles.iter().map(|triangle| triangle.map(|at| first[at as usize]));
        let mut triangles: Vec<[u32; 3]> = joined.filter(|[a, b, c]| a != b && b != c && a != c).collect();
        // Corners that no facet has any more would be corners of the bounding box.
        let mut number = vec![u32::MAX; self.corners.len()];
        let mut corners = Vec::new();
        for at in triangles.iter_mut().flatten() {
            let new = &mut number[*at as usize];
            if *new == u32::MAX {
                *new = corners.len() as u32;
                corners.push(self.corners[*at as usize]);
            }
            *at = *new;
        }
        Self { corners, triangles, key: OnceLock::new() }
    }

    /// The same surface with stouter facets where several lie in a plane.
    pub fn stout(&self) -> Self {
        let mut triangles = self.triangles.clone();
        stout::drawn(&self.corners, &mut triangles);
        Self { corners: self.corners.clone(), triangles, key: OnceLock::new() }
    }

    /// Lowest and highest corner of the bounding box in a pose, mm.
    pub fn bounds_in_mm(&self, pose: &Isometry3<f64>) -> [[f64; 3]; 2] {
        let turn = pose.rotation.to_rotation_matrix();
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for corner in &self.corners {
            let at = turn * Point3::from(*corner) + pose.translation.vector;
            for axis in 0..3 {
                bounds[0][axis] = bounds[0][axis].min(at[axis]);
                bounds[1][axis] = bounds[1][axis].max(at[axis]);
            }
        }
        bounds
    }
}

/// With the key, which takes longer to compute than to read.
impl Serialize for Facets {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (&self.corners, &self.triangles, self.key()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Facets {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (corners, triangles, key): (_, _, Key) = Deserialize::deserialize(deserializer)?;
        Ok(Self { corners, triangles, key: OnceLock::from(key) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    #[test]
    fn regress_what_was_made_before_leaves_no_trace() {
        let [ball, pin] = [Feature::sphere(4.0), Feature::cylinder(1.0, 20.0).at(0.5, 0.0, -10.0)];
        let earlier = [MeshSolid::build(&ball), MeshSolid::build(&pin)];
        let later = [&pin, &ball].map(MeshSolid::build);
        let cut = earlier[0].minus(&earlier[1]);
        let again = later[1].minus(&later[0]);
        assert!(cut.key() == again.key() && cut.reimported().mesh() == again.reimported().mesh());
    }

    #[test]
    fn analytic_welded_corners_leave_the_solid_closed() {
        let solid = MeshSolid::build(&Feature::sphere(4.0).minus([Feature::cylinder(1.0, 20.0).at(0.5, 0.0, -10.0)]));
        let facets = solid.facets_held();
        assert_eq!(facets.welded(0.0).triangles.len(), facets.triangles.len());
        let longest = |triangle: &[u32; 3]| triangle.map(|at| Point3::from(facets.corners[at as usize]));
        let shortest_mm = facets.triangles.iter().map(longest).map(|[a, b, _]| (a - b).norm()).fold(f64::INFINITY, f64::min);
        let welded = MeshSolid::of_facets(facets.welded(1.001 * shortest_mm));
        assert!(welded.facet_count() < solid.facet_count() && !welded.is_empty());
        assert!((welded.volume_mm3() / solid.volume_mm3() - 1.0).abs() < 0.01 * shortest_mm.max(0.01));
    }

    #[test]
    fn analytic_what_was_kept_is_the_same_solid() {
        let solid = MeshSolid::build(&Feature::sphere(4.0).minus([Feature::cylinder(1.0, 20.0).at(0.5, 0.0, -10.0)])).reimported();
        let bytes = postcard::to_allocvec(&solid).expect("is written");
        let read: MeshSolid = postcard::from_bytes(&bytes).expect("is read");
        assert_eq!((read.key(), read.mesh()), (solid.key(), solid.mesh()));
        let cut = |solid: &MeshSolid| solid.minus(&MeshSolid::build(&Feature::sphere(3.0).at(1.0, 1.0, 1.0)));
        assert_eq!(cut(&read).key(), cut(&solid).key());
        assert!((read.volume_mm3() - solid.volume_mm3()).abs() < 1e-12 && read.bounds_mm() == solid.bounds_mm());
        assert_ne!(read.placed(&Isometry3::translation(0.0, 0.0, 1e-12)).key(), solid.key());
    }
}
