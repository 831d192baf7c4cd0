//! Models compared with measured drops, and the parameters that bring both together. SI units, readings in g.
//!
//! A logger's clock is not synchronised with the impact, so every record is trigger-aligned: its first sample beyond the trigger
//! is sample zero. The model's prediction for the mean of such records is its wave, averaged over all phases of the clock
//! ([`Expected`]). No phase is fitted. [`TrialCovariance`] holds how the records of one height vary between trials; the
//! distance between mean and model is measured in its units.
//!
//! [`fit`] finds the parameters of one model. [`Likelihood`] compares mean waves in units of their own covariance.
//! [`PaperObjective`] is what the notebook of arXiv 2103.04423 minimises. Resampled drops give intervals. [`FitProblem`] is the
//! same distance as [`Likelihood`]'s for many models one after the other, as a diagnosis needs it.

mod chosen;
mod covariance_model;
mod decimation;
mod early_end;
mod expected;
mod fine_wave;
mod fit_error;
mod fitting;
mod free;
mod least_squares;
mod left_out;
mod likelihood;
mod normal_law;
mod normal_table;
mod paper;
mod problem;
mod trial_covariance;
mod trigger_jitter;
mod waves;

pub use chosen::{Chosen, Keep};
pub use covariance_model::{CovarianceModel, inverse_root, outer};
pub use decimation::Decimation;
pub use early_end::EarlyEnd;
pub use expected::{Expected, Ready};
pub use fine_wave::FINE_S;
pub use fit_error::FitError;
pub use fitting::{Fit, LEAST_RESAMPLED, Objective, ParameterEstimate, fit};
pub use free::{Free, Layout};
pub use least_squares::{Minimum, at_bounds, inverse, minimise, minimise_until};
pub use left_out::LeftOut;
pub use likelihood::Likelihood;
pub use normal_law::{NORMAL_97_5, normal_below, normal_density};
pub use paper::PaperObjective;
pub use problem::{FitProblem, Fitted, MeanWave};
pub use trial_covariance::{TrialCovariance, Whitening};
pub use trigger_jitter::TriggerJitter;
pub use waves::{BEFORE, FittedDrop, Unusable, WaveGroup, Waves, aligned_windows};
