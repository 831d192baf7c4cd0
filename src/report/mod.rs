//! What is written about a frame: words and pictures.

mod arrow;
mod bands;
mod bars;
pub mod bent_scene;
pub mod booklet;
pub mod booklet_html;
pub mod booklet_pdf;
mod boxes;
mod camera;
pub mod diagnosis_data;
pub mod diagnosis_page;
pub mod diff_page;
pub mod drop_data;
pub mod drop_plots;
pub mod fit_data;
pub mod fit_plots;
pub mod fold_scene;
pub mod impact_data;
pub mod impact_plots;
mod lettering;
mod lines;
pub mod measure_data;
pub mod measure_plots;
pub mod page;
pub mod picture;
pub mod plate_picture;
mod plot;
pub mod print_settings;
mod raster;
pub mod scene;
pub mod side_by_side;
pub mod stiffness_data;
pub mod stiffness_plots;
pub mod summary;
mod surface;

pub use plot::PlotError;
