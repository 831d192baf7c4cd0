//! Why a mesh cannot be put back on the surfaces of its features.

/// Why a mesh cannot be put back on the surfaces of its features.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotExact {
    /// Some edge is not shared by two facets.
    #[error("the mesh is not closed")]
    Open,
    /// What a hull spans between round bodies.
    #[error("{count} facets lie on no surface of the features, the first near {at:.3?}")]
    Surface {
        /// How many facets.
        count: usize,
        /// Where the first is, mm.
        at: [f64; 3],
    },
    /// Surfaces do not meet where the mesh has a corner.
    #[error("the surfaces around the corner near {at:.3?} meet {off_mm:.3} mm beside it")]
    Corner {
        /// Where, mm.
        at: [f64; 3],
        /// How far away, mm.
        off_mm: f64,
    },
    /// Two surfaces do not cross in one curve along a chain.
    #[error("the surfaces beside the edge near {at:.3?} do not cross along it")]
    Edge {
        /// Where, mm.
        at: [f64; 3],
    },
    /// A face is not what its facets are.
    #[error("a face near {at:.3?} has {exact_mm2:.4} mm², its facets {mesh_mm2:.4} mm²")]
    Face {
        /// Where, mm.
        at: [f64; 3],
        /// Area of the face, mm².
        exact_mm2: f64,
        /// Area of its facets, mm².
        mesh_mm2: f64,
    },
    /// The volume is another.
    #[error("the faces enclose {exact_mm3:.3} mm³, the mesh {mesh_mm3:.3} mm³")]
    Volume {
        /// Volume by the faces, mm³.
        exact_mm3: f64,
        /// Volume of the mesh, mm³.
        mesh_mm3: f64,
    },
}
