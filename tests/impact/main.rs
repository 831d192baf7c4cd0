//! The drop: effects, simulation, records, fits and the diagnosis, against arithmetic, the paper and the real drops.

#[expect(dead_code, reason = "the benchmark uses the rest")]
mod bodies;
mod case;
mod case_study;
mod clock_stalls;
mod covariates;
mod diagnosis_statistics;
mod effect_cases;
mod effect_catalogue;
mod effects;
mod fit_intervals;
mod frame_curve;
mod frame_fit;
mod landing;
mod paper;
mod published;
mod random_models;
mod recorded_falls;
mod records_random;
mod recovery;
mod reproduction;
mod sampling_rates;
mod synthetic;
mod validity_warnings;
