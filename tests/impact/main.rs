//! The drop: effects, simulation, records, fits and the diagnosis, against arithmetic, the paper and the real drops.

#[expect(dead_code, reason = "the benchmark uses the rest")]
mod bodies;
mod case;
mod case_study;
mod diagnosis_statistics;
mod effects;
mod frame_curve;
mod frame_fit;
mod paper;
mod plant;
mod published;
mod random_models;
mod records_random;
mod recovery;
mod reproduction;
mod validity;
