//! The diagnosis: where simulation and measurement disagree, which effect is missing, and the residual after it is added.
//!
//! [`diagnose`] does all of it. It aligns the drops at their triggers and estimates their trial covariance ([`PreparedDrops`]). It
//! refits the base model and tests its residual ([`Adequacy`]). It tries every effect on top of the base, then sets of effects
//! ([`Search`]), and applies the acceptance tests before it names one. docs/diagnosis.md explains the method.

mod adequacy;
mod alternative;
mod bootstrap;
mod candidate;
mod channel_choice;
mod clipping;
mod confounding;
mod constancy;
mod covariate;
mod diagnosis;
mod diagnosis_options;
mod dictionary;
mod effect_estimate;
mod experiment;
mod frame_mode;
mod free_fall_reading;
mod gap;
mod gaps;
mod judged_again;
mod moved_zero;
mod observable;
mod power;
mod prepared_drops;
mod ranked;
mod residual_force;
mod residual_map;
mod run;
mod search;
mod stage;
mod static_comparison;
mod trend;
mod verdict;

pub use adequacy::{Adequacy, LinearisedFit, Statistics, judge};
pub use alternative::Alternative;
pub use bootstrap::{Bootstrap, REPLICATES, Replicate};
pub use candidate::{Candidate, PRICE, joined};
pub use channel_choice::{ChannelChoice, ComparedAxes};
pub use clipping::{Clipping, clipping};
pub use confounding::{Confounding, confounded};
pub use constancy::{ByHeight, Constancy, UNSTEADY, constancy};
pub use covariate::{Covariate, CovariateEffect};
pub use diagnosis::Diagnosis;
pub use diagnosis_options::DiagnosisOptions;
pub use effect_estimate::{EffectEstimate, HeldParameter, HeldValue, held};
pub use experiment::Experiment;
pub use frame_mode::FrameMode;
pub use free_fall_reading::FreeFallReading;
pub use gap::{Gap, errors, gap};
pub use gaps::Gaps;
pub use observable::{Observable, observables};
pub use power::{COUNTS, POWER, SIMULATED, drops_to_see};
pub use prepared_drops::PreparedDrops;
pub use ranked::Ranked;
pub use residual_force::ForceCell;
pub use residual_map::{Cell, Phase, Point, ResidualMap, SameIn};
pub use run::{DiagnosisError, diagnose, watched};
pub use search::{Level, RARE, Search, SearchContext};
pub use stage::Stage;
pub use static_comparison::StaticComparison;
pub use trend::trend_p;
pub use verdict::Verdict;
