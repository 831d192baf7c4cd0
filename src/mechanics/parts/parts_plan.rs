//! Every flexible part of a design as beams.

use super::corner_plan;
use super::joint_plans;
use super::plan::{NoSection, Plan, PlannedBeam};
use crate::frame::assembly::{Design, Printed};
use crate::frame::parts::{BottomCorner, Fork, HubJoint, Knee, MotorMount, TopCorner};
use crate::mechanics::model::model_error::ModelError;
use crate::mechanics::settings::MechanicsSettings;
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

/// How a part is cut into beams: from the design and the part as made.
type Cut = fn(&Design, &Printed, &MechanicsSettings) -> Result<Plan, NoSection>;

/// What a printed part is in the structure.
#[derive(Clone, Copy)]
enum BeamPlan {
    /// Beams, cut from its flat solid.
    Beams(Cut),
    /// A piece of the rigid centre.
    RigidCentre,
}

/// What each part is in the structure: one that is missing here does not compile.
fn beam_plan(name: PartName) -> BeamPlan {
    match name {
        PartName::TopCorner => BeamPlan::Beams(top_corner),
        PartName::BottomCorner => BeamPlan::Beams(bottom_corner),
        PartName::HubJoint => BeamPlan::Beams(hub_joint),
        PartName::Fork => BeamPlan::Beams(fork),
        PartName::Knee => BeamPlan::Beams(knee),
        PartName::MotorMount => BeamPlan::Beams(motor_mount),
        PartName::Hub
        | PartName::PiCarrier
        | PartName::BatteryBracket
        | PartName::BatterySleeve
        | PartName::BatteryLid
        | PartName::CameraConnectorLeft
        | PartName::CameraConnectorRight
        | PartName::AccessoryPlate => BeamPlan::RigidCentre,
    }
}

/// Whether a part is beams in the structure, not a piece of the rigid centre.
pub fn is_beams(name: PartName) -> bool {
    matches!(beam_plan(name), BeamPlan::Beams(_))
}

/// Cuts every part of a design that deforms.
///
/// # Errors
/// When a part's mesh is not met on one of its paths.
pub fn part_models(design: &Design, settings: &MechanicsSettings) -> Result<Vec<PartModel>, ModelError> {
    use rayon::prelude::*;
    let cuts: Vec<(&Printed, Cut)> = design
        .printed
        .iter()
        .filter_map(|part| match beam_plan(part.name) {
            BeamPlan::Beams(cut) => Some((part, cut)),
            BeamPlan::RigidCentre => None,
        })
        .collect();
    let model = |(part, cut): &(&Printed, Cut)| match cut(design, part, settings) {
        Ok(plan) => Ok(PartModel { name: part.name, plan }),
        Err(error) => Err(ModelError::Part { part: part.name, error }),
    };
    cuts.par_iter().map(model).collect::<Vec<_>>().into_iter().collect()
}

fn top_corner(design: &Design, part: &Printed, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    let own = TopCorner::from_frame(&design.frame, design.skeleton.closure.strut_tilt);
    corner_plan::plan(&own.sockets, &part.flat, &part.bends, None, settings)
}

fn bottom_corner(design: &Design, part: &Printed, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    let own = BottomCorner::from_frame(&design.frame, design.skeleton.closure.strut_tilt);
    corner_plan::plan(&own.sockets, &part.flat, &part.bends, Some(own.leg_bottom_mm), settings)
}

fn hub_joint(design: &Design, part: &Printed, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    joint_plans::hub_joint(&HubJoint::from_frame(&design.frame), &part.flat, part.bends.first(), settings)
}

fn fork(design: &Design, part: &Printed, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    joint_plans::fork(&Fork::from_frame(&design.frame), &part.flat, settings)
}

fn knee(design: &Design, part: &Printed, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    joint_plans::knee(&Knee::from_frame(&design.frame, design.skeleton.closure.strut_tilt), &part.flat, settings)
}

fn motor_mount(design: &Design, part: &Printed, settings: &MechanicsSettings) -> Result<Plan, NoSection> {
    joint_plans::motor_mount(&MotorMount::from_frame(&design.frame), &part.flat, settings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::catalogue;

    #[test]
    fn analytic_every_flexible_part_is_beams_and_every_rigid_one_is_not() {
        for part in catalogue() {
            assert_eq!(is_beams(part.name), part.is_flexible(), "{}", part.name);
        }
    }
}
