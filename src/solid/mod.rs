//! Solids: one feature tree, two kernels, and the gate every written mesh passes.
//!
//! Only this folder uses the mesh kernel (a port of Manifold) and the B-rep kernel (truck).

mod bend;
mod boundary;
mod box_tree;
mod brep;
mod crossing;
mod facets;
mod feature;
mod flat_facets;
pub mod gate;
mod half_edges;
mod mesh;
mod mesh_cut;
mod mesh_section;
mod mesh_solid;
mod oriented_box;
mod profile;
mod region;
mod stout;
mod turn_polygon;

pub use bend::{Bend, OFF_EDGE_MM, OPENING};
pub use boundary::{Boundary, Curve, Edge, FLATNESS_MM, Face, NotExact, Side, Surface, square_to};
pub use box_tree::BoxTree;
pub use brep::Brep;
pub use feature::Feature;
pub use mesh::Mesh;
pub use mesh_section::{CutPlane, Piece};
pub use mesh_solid::{Hit, MeshSolid, SEGMENTS_PER_TURN};
pub use oriented_box::OrientedBox;
pub use profile::{Contour, Profile, Segment};
pub use region::Region;
