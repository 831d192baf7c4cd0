//! A coupon: small prints that tell which clearances a printer needs and what strain its hinges bear, and what was found on them
//! as lines of a frame file.
//!
//! Axes as printed: x along a row, y back, z up from the bed, mm.

mod bed;
mod found;
mod gauge;
mod hinge_limit;
mod hinges;
mod label;
mod pieces;

pub use bed::CouponPlate;
pub use found::{FindingError, Fit, Found};
pub use hinge_limit::{FoldedHinge, FoldingError, HingeLimit, KEY as HINGE_KEY, StrainedHinge};
pub use hinges::{FOLDS, Hinges};
pub use pieces::{Coupon, CouponError, Piece};
