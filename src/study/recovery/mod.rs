//! Studies of hidden effects: drops with a known truth are made and diagnosed, one set a row, and the table says how often the
//! diagnosis is right. Strengths are noncentralities: squared whitened distances between the truth's noise-free mean waves
//! and those of the base model refitted to them.

mod accuracy;
mod ceiling;
mod covariance;
mod findings;
mod keys;
mod known_rows;
mod landing_truth;
mod measure;
mod noise_free;
mod setting;
mod share;
mod strength;
mod truth;
mod worker;

pub use accuracy::{Accuracy, Fact, Table, accuracy};
pub use findings::Asks;
pub use keys::plan_keys;
pub(super) use keys::{columns, setting};
pub use landing_truth::LandingTruth;
pub use measure::{RECOVERY_MEASURES, RecoveryMeasure};
pub use setting::{Case, Recovery};
pub use share::Share;
pub use strength::{recorded, values};
pub use truth::Truth;
pub use worker::Worker;
