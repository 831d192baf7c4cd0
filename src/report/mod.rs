//! Reports on a frame: pages, pictures, charts, instructions and data.

pub mod booklet;
#[cfg(feature = "charts")]
pub mod chart;
pub mod data;
pub mod frame_folder;
pub mod page;
pub mod picture;

#[cfg(feature = "charts")]
pub use chart::plot::PlotError;
