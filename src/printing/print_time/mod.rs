//! How long printing takes.
//!
//! The length of the lines of infill or walls is the area of their section over the distance of two lines. They are printed at the
//! material's speed, or at its largest volumetric flow, and slower in short loops. Walls lose time in corners, and each loop adds travel
//! moves. Three factors are fitted to the times that PrusaSlicer 2.5 estimates for the plates of this project on printers with 500, 1000
//! and 1250 mm/s²; `tests/external/print_time.py` measures that each plate is within 15 %,
//! in layers of 0.2 mm from a nozzle of 0.4 mm; a few plates in layers of 0.1 mm and from a nozzle of 0.6 mm took 1 to 6 % longer than stated.
//!
//! *When it is wrong:* for speeds far from those of the catalogue (18 to 60 mm/s), where acceleration has more influence, and for plates
//! with layers so small that the slicer waits for them to cool. Support and heating of the bed are not included.

mod layer;
mod lines;

pub use layer::SHORT_LOOP_MM;
pub use lines::{SLOW_MM_S, of_part_s};
