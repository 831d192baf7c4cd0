//! The frame at first touch, and what is read of its motion.

use nalgebra::Vector3;

use crate::mechanics::element::foot::{Foot, Grip};
use crate::mechanics::element::rotation::exp;
use crate::mechanics::model::frame_builder::TOUCH_MM;
use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::solve::dynamics::TimeIntegration;
use crate::mechanics::system::equation_system::System;
use crate::mechanics::system::sparse::NOWHERE;
use crate::mechanics::system::structure::State;
use crate::units::{Angle, GRAVITY_MM_MS2};

/// The frame at rest in itself, turned, its lowest foot on the ground as deep as a foot stands at rest.
pub(in crate::mechanics) fn touching(system: &System, hub: usize, tilt: [Angle; 2]) -> State {
    let mut state = system.rest();
    if tilt.iter().all(|angle| angle.to_rad() == 0.0) {
        return state;
    }
    let [about_x, about_y] = tilt.map(Angle::to_rad);
    let turn = exp(&Vector3::new(0.0, about_y, 0.0)) * exp(&Vector3::new(about_x, 0.0, 0.0));
    let centre = state.places[hub];
    state.places.iter_mut().for_each(|place| *place = centre + turn * (*place - centre));
    state.turns.iter_mut().for_each(|own| *own = turn * *own);
    let feet = &system.structure.feet;
    let above = |foot: &Foot| (state.places[foot.node] + turn * foot.arm).z - (foot.ground_mm - TOUCH_MM);
    let lowest = feet.iter().map(above).fold(f64::INFINITY, f64::min);
    let down = lowest + TOUCH_MM;
    state.places.iter_mut().for_each(|place| place.z -= down);
    for (grip, foot) in state.grips.iter_mut().zip(feet) {
        let at = state.places[foot.node] + turn * foot.arm;
        *grip = Grip { place: (at.z < foot.ground_mm).then_some([at.x, at.y]) };
    }
    state
}

/// Proper acceleration of the centre along its own axis, g.
pub(in crate::mechanics) fn along_axis_g(model: &FrameModel, motion: &TimeIntegration) -> f64 {
    let of = model.system.unknowns.of(model.hub);
    let value = |at: usize| if of[at] == NOWHERE { 0.0 } else { motion.acceleration[of[at]] };
    let proper = Vector3::new(value(0), value(1), value(2) + GRAVITY_MM_MS2);
    (motion.state.turns[model.hub] * Vector3::z()).dot(&proper) / GRAVITY_MM_MS2
}

/// Every node falls.
pub(in crate::mechanics) fn falling(model: &FrameModel, speed_m_s: f64) -> Vec<f64> {
    let mut velocity = vec![0.0; model.system.unknowns.size()];
    for node in 0..model.system.structure.nodes.len() {
        let z = model.system.unknowns.of(node)[2];
        if z != NOWHERE {
            velocity[z] = -speed_m_s;
        }
    }
    velocity
}

/// Speed of the centre of mass upwards, m/s.
pub(in crate::mechanics) fn rising(model: &FrameModel, motion: &TimeIntegration) -> f64 {
    let (mut mass, mut momentum) = (0.0, 0.0);
    for (node, own) in model.system.structure.nodes.iter().enumerate() {
        let z = model.system.unknowns.of(node)[2];
        if z != NOWHERE {
            mass += own.mass_g;
            momentum += own.mass_g * motion.velocity[z];
        }
    }
    momentum / mass
}
