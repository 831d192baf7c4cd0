//! The test coupon: small prints from which a printer's clearances and the strain limit of hinges are read, and the readings as lines
//! of a frame file.
//!
//! Axes as printed: x along a row, y back, z up from the bed, mm.

mod bed;
mod found;
mod gauge;
mod hinge_limit;
mod hinges;
mod label;
mod pieces;

pub use bed::{CouponPlate, CouponPlates};
pub use found::{FindingError, Fit, Found};
pub use hinge_limit::{FoldedHinge, FoldingError, HingeLimit, KEY as HINGE_KEY, StrainedHinge};
pub use hinges::{FOLDS, Hinges};
pub use pieces::{Coupon, CouponError, Piece};
