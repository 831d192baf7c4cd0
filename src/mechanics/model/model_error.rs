//! Why a frame has no mechanics.

use crate::mechanics::parts::plan::NoSection;
use crate::mechanics::system::sparse::SparseError;
use crate::params::PartName;

/// Why a frame has no mechanics.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A part's mesh was not met.
    #[error("{part}: {error}")]
    Part {
        /// Which part.
        part: PartName,
        /// What was not met.
        error: NoSection,
    },
    /// The rods' material says nothing of its stiffness.
    #[error("the rods' material `{material}` does not say its tensile_modulus_mpa")]
    NoModulus {
        /// Which.
        material: String,
    },
    /// The structure cannot be solved.
    #[error(transparent)]
    Sparse(#[from] SparseError),
}
