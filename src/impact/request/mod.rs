//! A diagnosis as it is asked for, and all that is judged in it: effects along the vertical, landings that are not level, and what the records
//! themselves contradict.
//!
//! [`DiagnosisRequest::diagnosed`] takes a model and drops as they were read, and gives the [`Diagnosis`](crate::impact::diagnose::Diagnosis) with
//! [`Compared`], the record of what was compared.

mod compared;
mod diagnosis_request;
mod separating_experiment;

pub use compared::Compared;
pub use diagnosis_request::{DiagnosisRequest, MOST_EFFECTS, RequestError, usual_model};
pub use separating_experiment::SeparatingExperiment;
