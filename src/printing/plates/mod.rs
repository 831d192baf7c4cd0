//! The arrangement of printed parts on plates, and their print settings.
//!
//! [`arrange`] fills plates of one material each. Coordinates are the printer's: millimetres, Z up, origin at the front left
//! corner of a rectangular bed, in the middle of a round one.

mod arrange;
mod known;
mod plate;
mod settings;

pub use arrange::{NoRoom, Wanted, all, arrange, arrange_what_fits, without_room};
pub use plate::{Item, Plate, short};
pub use settings::{PrintSetting, PrintSettings, SlicerFamily};
