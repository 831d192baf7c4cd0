//! What happens between a mesh and a finished print: printability, heat, plates, the test coupon, and weighing.

pub mod coupon;
pub mod filament;
pub mod heat;
pub mod plates;
pub mod print_time;
pub mod printability;
pub mod room;
pub mod weighing;
