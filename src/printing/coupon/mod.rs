//! A coupon: small prints that tell which clearances a printer needs, and what was found on them as lines of a frame file.
//!
//! Axes as printed: x along a row, y back, z up from the bed, mm.

mod found;
mod gauge;
mod label;
mod pieces;

pub use found::{FindingError, Fit, Found};
pub use pieces::{Coupon, CouponError, Piece};
