//! The facets of a solid with the kernel's own numbers: what is kept of it.

use std::sync::OnceLock;

use manifold_rust::manifold::Manifold;
use manifold_rust::types::MeshGL64;
use nalgebra::{Isometry3, Point3};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::mesh::Mesh;
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
        fn root(above: &mut [u32], mut at: u32) -> u32 {
            while above[at as usize] != at {
                above[at as usize] = above[above[at as usize] as usize];
                at = above[at as usize];
            }
            at
        }
        let mut above: Vec<u32> = (0..self.corners.len() as u32).collect();
        for [a, b, c] in &self.triangles {
            for other in [b, c] {
                let (one, two) = (root(&mut above, *a), root(&mut above, *other));
                above[one.max(two) as usize] = one.min(two);
            }
        }
        (0..above.len() as u32).map(|corner| root(&mut above, corner)).collect()
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
