//! What is written about a frame: words and pictures.

mod camera;
pub mod picture;
mod raster;
pub mod scene;
pub mod summary;
mod surface;
