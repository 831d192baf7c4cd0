//! Pages to read: Markdown and HTML.

mod base64;
pub mod coupon_page;
#[cfg(feature = "charts")]
pub mod diagnosis_page;
pub mod diff_page;
pub mod document;
#[cfg(feature = "charts")]
mod landing_figures;
#[cfg(feature = "charts")]
mod landing_section;
pub mod next_steps;
pub mod print_settings;
pub mod recovery_page;
pub mod study_page;
pub mod summary;
pub mod weighing_page;
