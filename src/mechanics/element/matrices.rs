//! Vectors and matrices of a beam.

use nalgebra::{SMatrix, SVector};

/// Stretch and rotations in the beam's own frame: u, then three rotations at each end (x along the beam).
pub type Local = SVector<f64, 7>;
/// Force or displacement of both ends: force, moment, force, moment.
pub type Ends = SVector<f64, 12>;
/// Their matrix.
pub type Tangent = SMatrix<f64, 12, 12>;
/// Stiffness in a beam's own frame.
pub type Matrix7 = SMatrix<f64, 7, 7>;
