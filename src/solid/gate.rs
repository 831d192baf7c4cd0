//! The export gate: what a mesh must be before it may be written.

use serde::{Deserialize, Serialize};

use super::crossing;
use super::mesh::Mesh;
use super::mesh_solid::MeshSolid;

/// Why a mesh may not be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GateError {
    /// Nothing in it.
    #[error("the mesh is empty: the features cancel each other")]
    Empty,
    /// An edge that is not shared by exactly two facets in opposite directions.
    #[error("{count} edges are not closed (the first from corner {from} to {to})")]
    OpenEdges {
        /// How many directed edges lack their reverse, or occur twice.
        count: usize,
        /// First such edge: from this corner …
        from: u32,
        /// … to this one.
        to: u32,
    },
    /// Facets without area.
    #[error("{count} facets have no area")]
    ZeroArea {
        /// How many.
        count: usize,
    },
    /// Inside out, or nothing.
    #[error("the enclosed volume is {volume_mm3:.3} mm³, not positive")]
    NotPositive {
        /// The volume.
        volume_mm3: f64,
    },
    /// More or fewer bodies than the part has.
    #[error("the part falls into {found} separate bodies, it should be {expected}")]
    Bodies {
        /// Bodies in the mesh.
        found: usize,
        /// Bodies that the part has.
        expected: usize,
    },
    /// Facets cross each other.
    #[error("facets cross each other")]
    SelfIntersecting,
    /// The two kernels have not made the same solid.
    #[error("the mesh encloses {volume_mm3:.3} mm³, the B-rep {exact_mm3:.3} mm³: an outline crosses itself")]
    Kernels {
        /// Volume of the mesh.
        volume_mm3: f64,
        /// Volume of the B-rep.
        exact_mm3: f64,
    },
}

impl GateError {
    /// What it means for the part, in words of somebody who states parameters and sees no mesh.
    pub fn meaning(&self) -> String {
        match self {
            Self::Empty | Self::NotPositive { .. } => "nothing of it is left: more is cut away than is there".into(),
            Self::Bodies { found, .. } => format!("it falls into {found} pieces"),
            Self::OpenEdges { .. } | Self::ZeroArea { .. } | Self::SelfIntersecting => "two of its walls run into each other".into(),
            Self::Kernels { .. } => "its outline crosses itself".into(),
        }
    }
}

/// How far the volumes of the two kernels may be apart, as a share: chords take 0.3 % of a round solid, and more of what
/// a plate leaves between its holes.
const KERNELS_AGREE: f64 = 0.01;

/// Lets a volume pass that both kernels have found.
///
/// # Errors
/// When they differ by more than chords explain.
pub fn agree(volume_mm3: f64, exact_mm3: f64) -> Result<(), GateError> {
    if (volume_mm3 / exact_mm3 - 1.0).abs() < KERNELS_AGREE { Ok(()) } else { Err(GateError::Kernels { volume_mm3, exact_mm3 }) }
}

/// What the gate saw in a mesh that passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Topology {
    /// Separate bodies.
    pub bodies: usize,
    /// Euler number V − E + F; 2 for a ball, 0 with one tunnel, −2 with two.
    pub euler: i64,
}

/// Lets a mesh of one body pass, on the coordinates that will be written.
///
/// # Errors
/// The first rule that is broken, see [`GateError`].
pub fn pass(mesh: &Mesh) -> Result<Topology, GateError> {
    if mesh.triangles.is_empty() {
        return Err(GateError::Empty);
    }
    closed(mesh)?;
    let flat = mesh.triangles.iter().filter(|t| area_mm2(mesh, t) <= 0.0).count();
    if flat > 0 {
        return Err(GateError::ZeroArea { count: flat });
    }
    let volume_mm3 = mesh.volume_mm3();
    if volume_mm3 <= 0.0 {
        return Err(GateError::NotPositive { volume_mm3 });
    }
    let bodies = count_bodies(mesh);
    if bodies != 1 {
        return Err(GateError::Bodies { found: bodies, expected: 1 });
    }
    if !crossing::surely_apart(mesh) && MeshSolid::from_mesh(mesh).is_none_or(|solid| solid.has_self_intersections()) {
        return Err(GateError::SelfIntersecting);
    }
    let (v, f) = (mesh.vertices.len() as i64, mesh.triangles.len() as i64);
    Ok(Topology { bodies, euler: v - f * 3 / 2 + f })
}

fn closed(mesh: &Mesh) -> Result<(), GateError> {
    let mut edges: Vec<(u32, u32)> = mesh.triangles.iter().flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
    edges.sort_unstable();
    // A mesh without a double edge whose reversed edges are its edges is closed; only otherwise they are counted.
    let mut reversed: Vec<(u32, u32)> = edges.iter().map(|(a, b)| (*b, *a)).collect();
    reversed.sort_unstable();
    if edges == reversed && edges.windows(2).all(|pair| pair[0] != pair[1]) {
        return Ok(());
    }
    let once = |edge: (u32, u32)| edges.partition_point(|e| *e <= edge) - edges.partition_point(|e| *e < edge) == 1;
    let mut open: Vec<(u32, u32)> = edges.iter().copied().filter(|(a, b)| !(once((*a, *b)) && once((*b, *a)))).collect();
    open.dedup();
    let (from, to) = open[0];
    Err(GateError::OpenEdges { count: open.len(), from, to })
}

fn area_mm2(mesh: &Mesh, triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = mesh.corners(triangle);
    0.5 * (b - a).cross(&(c - a)).norm()
}

fn count_bodies(mesh: &Mesh) -> usize {
    let mut parent: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    fn root(parent: &mut [u32], mut i: u32) -> u32 {
        while parent[i as usize] != i {
            parent[i as usize] = parent[parent[i as usize] as usize];
            i = parent[i as usize];
        }
        i
    }
    for t in &mesh.triangles {
        for pair in [(t[0], t[1]), (t[1], t[2])] {
            let (a, b) = (root(&mut parent, pair.0), root(&mut parent, pair.1));
            parent[a as usize] = b;
        }
    }
    (0..parent.len() as u32).filter(|&i| root(&mut parent, i) == i).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Feature;

    fn cube() -> Mesh {
        MeshSolid::build(&Feature::cuboid([2.0, 2.0, 2.0])).to_mesh()
    }

    #[test]
    fn analytic_a_cube_passes_with_the_euler_number_of_a_ball() {
        assert_eq!(pass(&cube()), Ok(Topology { bodies: 1, euler: 2 }));
    }

    #[test]
    fn planted_kernels_that_differ_are_found() {
        assert_eq!(agree(1000.0, 1003.0), Ok(()));
        assert!(matches!(agree(1000.0, 1020.0), Err(GateError::Kernels { .. })));
        assert!(matches!(agree(1000.0, f64::NAN), Err(GateError::Kernels { .. })));
    }

    #[test]
    fn planted_a_missing_facet_is_found() {
        let mut mesh = cube();
        mesh.triangles.pop();
        assert!(matches!(pass(&mesh), Err(GateError::OpenEdges { count: 3, .. })));
    }

    #[test]
    fn planted_an_inverted_mesh_is_found() {
        let mut mesh = cube();
        for t in &mut mesh.triangles {
            t.swap(0, 1);
        }
        assert!(matches!(pass(&mesh), Err(GateError::NotPositive { .. })));
    }

    #[test]
    fn planted_a_second_body_is_found() {
        let two = Feature::union([Feature::cuboid([2.0, 2.0, 2.0]), Feature::sphere(1.0).at(5.0, 0.0, 0.0)]);
        let mesh = MeshSolid::build(&two).to_mesh();
        assert_eq!(pass(&mesh), Err(GateError::Bodies { found: 2, expected: 1 }));
    }

    #[test]
    fn planted_crossing_facets_are_found() {
        let mut mesh = cube();
        let pushed = mesh.vertices.iter_mut().find(|v| **v == [1.0, 1.0, 1.0]);
        // Through the opposite face, and not so far that the volume is none.
        *pushed.expect("a cube has this corner") = [-1.3, 0.0, 0.0];
        assert!(mesh.volume_mm3() > 0.5, "{}", mesh.volume_mm3());
        assert_eq!(pass(&mesh), Err(GateError::SelfIntersecting));
    }
}
