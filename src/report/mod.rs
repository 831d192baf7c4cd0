//! What is written about a frame: words and pictures.

pub mod booklet;
pub mod chart;
pub mod data;
pub mod page;
pub mod picture;

pub use chart::plot::PlotError;
