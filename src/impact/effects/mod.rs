//! What can act in a drop: one file an effect, each with its equation, its source, and when it is wrong. SI units.
//!
//! The base is a body on a linear spring and a linear damper, m x'' = m g - F(x, v). An effect adds a force, or changes
//! how forces, fall or sensor act. Together, in this order: the sum of the forces (staggered feet stand in for spring
//! and damper), the tension factor where F < 0 or x < 0, the stop on top, which never pulls; then the sensor's low-pass,
//! gain and limit on F/m. An effect at its 'off' value is left out of the sum, so the base's numbers stay to the last bit.
//!
//! x is the compression since first touch, positive downwards, v = x'; forces on the body count positive upwards.

mod air_drag;
mod bilinear_stiffness;
mod bottoming;
mod catalogue;
mod coulomb_friction;
mod cubic_stiffness;
mod drop_height_error;
mod effect;
mod fall;
mod foot_stagger;
mod frame_force_curve;
mod hunt_crossley_damping;
mod linear_damper;
mod linear_spring;
mod maxwell_branch;
mod model;
mod model_text;
mod payload_mode;
mod preload;
mod quadratic_damping;
mod sensor;
mod sensor_gain;
mod sensor_low_pass;
mod sensor_saturation;
mod unilateral_contact;

pub use catalogue::{BASE, CATALOGUE, OF_FRAME, by_id, candidates, every};
pub use effect::{Arrangement, Choice, Effect, Motion, Parameter, Reach, Spec, Stage, Threshold};
pub use fall::Fall;
pub use foot_stagger::Feet;
pub use frame_force_curve::{FrameCurve, POINTS, REACH_MM, Softening};
pub use linear_damper::LinearDamper;
pub use linear_spring::LinearSpring;
pub use model::{Listed, Model};
pub use model_text::{CHANNEL, CURVE, PLAIN_NUMBERS, channel_words};
pub use payload_mode::Payload;
pub use sensor::{Channel, Sensor};

/// Gravity, m/s².
pub const GRAVITY_M_S2: f64 = 9.81;
