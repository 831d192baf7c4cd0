//! Charts of results, as SVG and PNG.

pub(in crate::report) mod bands;
pub(in crate::report) mod bars;
pub(in crate::report) mod boxes;
pub mod drop_plots;
pub mod fit_plots;
pub mod front_plot;
pub mod impact_plots;
pub(in crate::report) mod index_bars;
pub(in crate::report) mod lines;
pub mod measure_plots;
pub(in crate::report) mod parallel;
pub(in crate::report) mod plot;
pub mod stiffness_plots;
pub mod study_plots;

pub use plot::PlotError;
