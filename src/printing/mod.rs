//! What happens between a mesh and a finished print: printability, plates, the test coupon, and weighing.

pub mod coupon;
pub mod plates;
pub mod print_time;
pub mod printability;
pub mod weighing;
