//! Results as data: JSON and CSV.

pub mod beam_model_data;
pub mod diagnosis_data;
pub mod difference_data;
pub mod drop_data;
pub mod fit_data;
pub mod front_data;
pub mod impact_data;
pub mod impact_fit_data;
pub mod landing_data;
pub mod measure_data;
pub mod stiffness_data;
