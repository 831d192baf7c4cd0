//! What is written about a frame: words and pictures.

mod bars;
mod camera;
pub mod drop_data;
pub mod drop_plots;
mod lines;
pub mod picture;
mod plot;
mod raster;
pub mod scene;
pub mod summary;
mod surface;

pub use plot::PlotError;
