//! Results as data: JSON and CSV.

pub mod diagnosis_data;
pub mod diagnosis_request;
pub mod difference_data;
pub mod drop_data;
pub mod fit_data;
pub mod front_data;
pub mod impact_data;
pub mod impact_fit_data;
pub mod landing_data;
pub mod measure_data;
pub mod separating_experiment;
pub mod stiffness_data;
