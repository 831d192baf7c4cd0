//! Every flexible part of a design as beams.

use super::corner_plan;
use super::joint_plans;
use super::plan::{NoSection, Plan, PlannedBeam};
use crate::frame::assembly::{Design, Printed};
use crate::frame::parts::{BottomCorner, Fork, HubJoint, Knee, MotorMount, TopCorner};
use crate::mechanics::model::frame_model::ModelError;
use crate::mechanics::settings::Settings;
use crate::params::PartName;

/// A part and its plan.
#[derive(Clone, Debug)]
pub struct PartModel {
    /// Which part.
    pub name: PartName,
    /// Its beams.
    pub plan: Plan,
}

impl Plan {
    /// Length of one of its beams, mm.
    pub fn length_mm(&self, beam: &PlannedBeam) -> f64 {
        (self.nodes[beam.nodes[1]] - self.nodes[beam.nodes[0]]).norm()
    }
}

/// Cuts every flexible part of a design.
///
/// # Errors
/// When a part's mesh is not met on one of its paths.
pub fn part_models(design: &Design, settings: &Settings) -> Result<Vec<PartModel>, ModelError> {
    use rayon::prelude::*;
    let flexible: Vec<&Printed> = design.printed.iter().filter(|part| part.name.is_flexible()).collect();
    let planned: Vec<Option<Result<PartModel, ModelError>>> = flexible
        .par_iter()
        .map(|part| {
            let plan = plan(design, part, settings)?;
            Some(plan.map(|plan| PartModel { name: part.name, plan }).map_err(|error| ModelError::Part { part: part.name, error }))
        })
        .collect();
    planned.into_iter().flatten().collect()
}

fn plan(design: &Design, part: &Printed, settings: &Settings) -> Option<Result<Plan, NoSection>> {
    let (frame, tilt) = (&design.frame, design.skeleton.closure.strut_tilt);
    let flat = &part.flat;
    Some(match part.name {
        PartName::TopCorner => {
            let own = TopCorner::from_frame(frame, tilt);
            corner_plan::plan(&own.sockets, flat, &part.bends, None, settings)
        }
        PartName::BottomCorner => {
            let own = BottomCorner::from_frame(frame, tilt);
            corner_plan::plan(&own.sockets, flat, &part.bends, Some(own.leg_bottom_mm), settings)
        }
        PartName::HubJoint => joint_plans::hub_joint(&HubJoint::from_frame(frame), flat, part.bends.first()?, settings),
        PartName::Fork => joint_plans::fork(&Fork::from_frame(frame), flat, settings),
        PartName::Knee => joint_plans::knee(&Knee::from_frame(frame, tilt), flat, settings),
        PartName::MotorMount => joint_plans::motor_mount(&MotorMount::from_frame(frame), flat, settings),
        _ => return None,
    })
}
