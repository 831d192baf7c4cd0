//! Landings that are not level: one foot touches first, the frame turns, the others follow.
//!
//! A drop's lateral axes show when each foot touches ([`LegTouches`]). [`TouchEvidence`] tests from these times alone, without a
//! model, whether they are those of four feet in one plane. [`simulate`] drops a rigid body on four legs; [`LandingTable`] holds its
//! waves and touch times over all slopes at one speed. [`Population`] averages over random slopes, and [`given_touches`] predicts a
//! single drop from its own touch times. [`LandingFit`] fits stiffness, damping, inertia and the spread of slopes.
//! [`LandingAssessment`] applies the tests that the effect `landing_tilt` has to pass before it is named, [`AttitudeAssessment`] those of
//! `attitude_sensor`: a sensor that leans against the body.

mod assessment;
mod attitude_assessment;
mod attitude_fit;
mod bell;
mod chosen_model;
mod cosine;
mod deciding;
mod descent;
mod drop_weights;
mod evidence;
mod fit_step;
mod fitting;
mod foot_mode;
mod gaps;
mod gate;
mod height_peaks;
mod kept_tables;
mod landing_evidence;
mod landing_gates;
mod landing_scatter;
mod lateral_readings;
mod legged_body;
mod observed;
mod paid_effects;
mod parameter;
mod population;
mod posterior;
mod read_delays;
mod read_drops;
mod reading_error;
mod record_spread;
mod refused_effect;
mod score_sums;
mod sensor_attitude;
mod sensor_mount;
mod shown;
mod simulated_drops;
mod simulation;
mod slope_grid;
mod spike;
mod steadiness;
mod table;
mod touch_adequacy;
mod touch_errors;
mod touch_pattern;
mod touch_power;
mod touched_slopes;
mod touches;
mod turned_back;
mod uncertainty;
mod unjudged_landings;

pub use assessment::{LandingAssessment, SeparatingDrops, SlopesAtHeight};
pub use attitude_assessment::AttitudeAssessment;
pub use cosine::CosineSize;
pub use descent::Descent;
pub use evidence::TouchEvidence;
pub use fitting::{LandingFit, LandingProblem, ModelParts};
pub use foot_mode::{FOOT_MODE, FootMode};
pub use gaps::LandingGaps;
pub use gate::{GATES, Gate};
pub use landing_evidence::LandingEvidence;
pub use landing_scatter::LandingScatter;
pub use legged_body::{COGNIFLY_FOOT_RADIUS_M, COULOMB_FRICTION, LeggedBody, Legs, Slopes};
pub use observed::{HeightLandings, ObservedLanding, ObservedLandings};
pub use population::Population;
pub use posterior::{SlopeEstimate, given_touches};
pub use reading_error::likeliest_read_s;
pub use refused_effect::{Reason, RefusedEffect};
pub use sensor_attitude::{ATTITUDE_SENSOR, SensorAttitude};
pub use sensor_mount::{MOUNT_LOW_PASS, SensorMount};
pub use shown::{HeightSpread, ShownDrop};
pub use simulation::{Landing, simulate};
pub use table::LandingTable;
pub use touch_adequacy::TouchAdequacy;
pub use touches::{LegTouches, SEEN_G, Touch};
pub use uncertainty::FitUncertainty;
pub use unjudged_landings::UnjudgedLandings;

/// The effect's id.
pub const LANDING_TILT: &str = "landing_tilt";
