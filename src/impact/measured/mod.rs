//! Drops as they were measured: reading records, finding the impact in each, judging it, summing up a height.
//!
//! [`read_bytes`] takes files' names and bytes: the logger's `.bin` files, calibrated by a [`Calibration`], and CSV tables; `read`,
//! with the feature `cli`, takes paths of files and folders. They give a [`DropSet`], records grouped by frame and height. [`Impact`] is the impact in a record, [`Flag`] what is wrong with it,
//! [`Summary`] what the records of a height say together. Acceleration is proper acceleration in g along the frame's axis,
//! positive while the ground pushes, 0 in free fall. Static tests and readings of a scale are read here, too.

#[cfg(feature = "cli")]
mod disk;
mod fall;
mod flag;
mod impact;
mod logger;
mod malformed;
mod reading;
mod record;
mod scale;
mod sheet;
mod spread;
mod static_test;
mod summary;
mod table;

#[cfg(feature = "cli")]
pub use disk::read;
pub use fall::Fall;
pub use flag::{Flag, flags};
pub use impact::Impact;
pub use logger::Calibration;
pub use malformed::{Fault, Malformed, SourcePosition};
pub use reading::read_bytes;
pub use record::{DropGroup, DropSet, Record};
#[cfg(feature = "cli")]
pub use scale::read_scale;
pub use scale::{ScaleReading, scale_readings};
pub use spread::Spread;
pub use static_test::StaticTest;
#[cfg(feature = "cli")]
pub use static_test::read_static_test;
pub use summary::{Drop, Summary, drops};

use crate::units::GRAVITY_M_S2;

/// Speed after a fall without air, m/s.
pub fn impact_speed_m_s(height_m: f64) -> f64 {
    (2.0 * GRAVITY_M_S2 * height_m).sqrt()
}
