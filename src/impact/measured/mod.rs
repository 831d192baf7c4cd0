//! Measured drops: reading records, detecting the impact in each, flagging bad records, summaries of each height.
//!
//! [`read_bytes`] takes files' names and bytes: the logger's `.bin` files and CSV tables, written as a [`FileFormat`] says; `read`,
//! with the feature `cli`, takes paths of files and folders. They give a [`DropSet`], records grouped by frame and height.
//! [`JudgedDrops`] flags them together: the [`Impact`] in each record, each [`Flag`] with its evidence, and the [`Session`] it
//! belongs to. [`Summary`] has the statistics of the records of a height. Acceleration is proper acceleration in g along the frame's axis,
//! positive while the ground pushes, 0 in free fall. Static tests, readings of a scale
//! and tables of folded hinges are read here, too.

mod clock_check;
mod clock_period;
mod clock_sign;
mod clock_trace;
mod copied_records;
mod decimal;
#[cfg(feature = "cli")]
mod disk;
mod drop_order;
mod drop_table;
mod encoding;
mod fall;
mod fall_begin;
mod fall_drag;
mod fall_length;
mod file_format;
mod file_kind;
mod flag;
mod folds;
mod free_fall;
mod free_fall_offset;
mod height;
mod hint;
mod impact;
mod judged;
mod logger;
mod loud_noise;
mod malformed;
mod mixed_rates;
mod reading;
mod record;
mod row_lines;
mod scale;
mod seen_fall;
mod sensor_scale;
mod session;
mod sheet;
mod shorth;
mod speed_heights;
mod spread;
mod stamp_jitter;
mod static_test;
mod stray_readings;
mod summary;
mod symptom;
mod table;
mod table_format;
mod table_header;
mod unknown_zero;

pub use clock_period::ClockPeriod;
pub use clock_sign::ClockSign;
pub use decimal::decimal;
#[cfg(feature = "cli")]
pub use disk::read;
pub use drop_table::DropTable;
pub use fall::{Fall, RELEASE_S};
pub use file_format::FileFormat;
pub use flag::{Flag, LEAST_OVER_V0, flags};
#[cfg(feature = "cli")]
pub use folds::read_folds;
pub use folds::{FoldReading, fold_readings};
pub use free_fall::impact_speed_m_s;
pub use free_fall_offset::FreeFallOffset;
pub use height::is_same_m;
pub use hint::Hint;
pub use impact::{Impact, TRIGGER_G};
pub use judged::{Drop, JudgedDrops};
pub use logger::Calibration;
pub use malformed::{Fault, Malformed, SourcePosition};
pub use mixed_rates::{is_sampled_every, usual_step_s};
pub use reading::read_bytes;
pub use record::{DropGroup, DropSet, Record};
#[cfg(feature = "cli")]
pub use scale::read_scale;
pub use scale::{ScaleReading, scale_readings};
pub use session::{Session, Zero, mean_in_fall};
pub use spread::{Spread, quantile};
pub use stamp_jitter::StampJitter;
pub use static_test::StaticTest;
#[cfg(feature = "cli")]
pub use static_test::read_static_test;
pub use summary::Summary;
pub use symptom::{symptoms, symptoms_and_heights};
pub use table_format::{Column, FormatError, Quantity, TableFormat};
