//! What is written about a frame: words and pictures.

mod arrow;
mod bars;
pub mod booklet;
pub mod booklet_html;
pub mod booklet_pdf;
mod camera;
pub mod drop_data;
pub mod drop_plots;
pub mod fold_scene;
mod lettering;
mod lines;
pub mod picture;
mod plot;
mod raster;
pub mod scene;
pub mod summary;
mod surface;

pub use plot::PlotError;
