//! The effects that can act in a drop: one file an effect, each with its equation, its source, its limits of validity, and its record
//! ([`Spec`]).
//! SI units.
//!
//! The base is a body on a linear spring and a linear damper, m x'' = m g - F(x, v). An effect adds a force, or changes
//! how forces, fall or sensor act. They are applied in this order: the sum of the forces (staggered feet replace spring
//! and damper), the tension factor where F < 0 or x < 0, the stop in addition, which never pulls; then the sensor's low-pass,
//! gain and limit on F/m. An effect at its 'off' value is left out of the sum, so the base model's results stay the same to the last bit.
//!
//! x is the compression since first touch, positive downwards, v = x'; forces on the body count positive upwards.

mod air_drag;
mod arrangement;
mod bilinear_stiffness;
mod bottoming;
mod catalogue;
mod coulomb_friction;
mod cubic_stiffness;
mod drop_height_error;
mod effect;
mod fall;
mod foot_stagger;
mod frame_curve;
mod frame_force_curve;
mod generator;
mod hunt_crossley_damping;
mod linear_damper;
mod linear_spring;
mod maxwell_branch;
mod model;
mod model_text;
mod parameter;
mod payload_mode;
mod preload;
mod quadratic_damping;
mod sensor;
mod sensor_gain;
mod sensor_low_pass;
mod sensor_saturation;
mod spec;
mod unilateral_contact;

pub use air_drag::SPEC as AIR_DRAG;
pub use arrangement::{Arrangement, AttachedMass, Feet, SpringCurve};
pub use catalogue::{CATALOGUE, by_id, states, working};
pub use coulomb_friction::TURN_M_S;
pub use drop_height_error::SPEC as DROP_HEIGHT_ERROR;
pub use effect::{Effect, MotionState, Reach, Threshold};
pub use fall::Fall;
pub use frame_curve::{FrameCurve, POINTS, REACH_MM};
pub use frame_force_curve::SPEC as FRAME_FORCE_CURVE;
pub use generator::{Conditions, Generator, GeneratorState, Rider};
pub use linear_damper::{LinearDamper, SPEC as LINEAR_DAMPER};
pub use linear_spring::{LinearSpring, SPEC as LINEAR_SPRING};
pub use model::{Listed, Model, candidates};
pub use model_text::{CHANNEL, CURVE, MOST_STAGES, PLAIN_NUMBERS, channel_words};
pub use parameter::{Choice, Parameter, Scale};
pub use payload_mode::SPEC as PAYLOAD_MODE;
pub use sensor::{Channel, Sensor};
pub use sensor_saturation::SPEC as SENSOR_SATURATION;
pub use spec::{Availability, Inputs, Spec, Stage, StartContext};
pub use unilateral_contact::SPEC as UNILATERAL_CONTACT;
