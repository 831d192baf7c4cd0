//! A printed part: flat as printed, folded as assembled.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use crate::frame::parts::{
    BottomCorner, Fork, HubJoint, Knee, MotorMount, TopCorner, battery_bracket, battery_lid, battery_sleeve, camera_connector, hub,
    pi_carrier,
};
use crate::frame::skeleton::Centre;
use crate::frame::skeleton::Skeleton;
use crate::params::{Frame, PartName};
use crate::solid::gate::{self, GateError, Topology};
use crate::solid::{Bend, Brep, Feature, Mesh, MeshSolid};

/// A printed part, made.
#[derive(Clone)]
pub struct Printed {
    /// Which.
    pub name: PartName,
    /// What it is made of, in its own axes.
    pub feature: Feature,
    /// How it bends when the frame is assembled.
    pub bends: Vec<Bend>,
    /// The flat solid, in its own axes.
    pub flat: MeshSolid,
    /// The solid after its bends, in its own axes; the flat one when it has none.
    pub folded: MeshSolid,
    /// The flat solid in print orientation, resting on z = 0.
    pub printed: MeshSolid,
    /// The flat solid with all its detail, in its own axes: each facet stands for one surface of the feature.
    pub raw: MeshSolid,
    /// From the part's axes to those in which it is printed.
    pub print_pose: Isometry3<f64>,
    /// The mesh of it that is written.
    pub mesh: Mesh,
    /// What the export gate saw.
    pub topology: Topology,
    /// Volume of the printed mesh, mm³.
    pub volume_mm3: f64,
    /// Volume by the B-rep kernel, mm³, for parts that it builds without booleans.
    pub exact_volume_mm3: Option<f64>,
}

impl Printed {
    /// Makes a part.
    ///
    /// # Errors
    /// When its mesh does not pass the export gate, or the B-rep kernel makes another solid of it: its parameters
    /// contradict each other.
    pub fn make(name: PartName, frame: &Frame, skeleton: &Skeleton, centre: &Centre) -> Result<Self, GateError> {
        Self::by(name, recipe(name, frame, skeleton, centre))
    }

    /// Makes a part by its recipe; nothing else enters.
    pub(super) fn by(name: PartName, recipe: Recipe) -> Result<Self, GateError> {
        let Recipe { feature, bends, print_turn } = recipe;
        let raw = MeshSolid::build(&feature);
        let flat = raw.melted();
        let (printed, print_pose) = laid(&flat, &print_turn)?;
        let mesh = printed.mesh();
        let topology = gate::pass(&mesh)?;
        let folded = if bends.is_empty() { flat.clone() } else { bent(&flat, &bends)? };
        let exact_volume_mm3 = Brep::build(&feature).map(|brep| brep.volume_mm3());
        exact_volume_mm3.map_or(Ok(()), |exact_mm3| gate::agree(mesh.volume_mm3(), exact_mm3))?;
        Ok(Self {
            name,
            volume_mm3: mesh.volume_mm3(),
            feature,
            bends,
            raw,
            flat,
            folded,
            printed,
            print_pose,
            mesh,
            topology,
            exact_volume_mm3,
        })
    }
}

/// The solid as it is printed, resting on z = 0, and the way there from its own axes.
pub(super) fn laid(flat: &MeshSolid, print_turn: &UnitQuaternion<f64>) -> Result<(MeshSolid, Isometry3<f64>), GateError> {
    let turn = Isometry3::from_parts(Translation3::identity(), *print_turn);
    let turned = flat.placed(&turn);
    if turned.is_empty() {
        return Err(GateError::Empty);
    }
    let low = turned.bounds_mm()[0];
    let lift = Isometry3::translation(0.0, 0.0, -low[2]);
    Ok((turned.placed(&lift), lift * turn))
}

/// The mesh of a solid, with the first of these amounts of detail, mm, melted away that lets it pass the gate.
///
/// # Errors
/// What the gate says to the last.
pub(super) fn melted(raw: &MeshSolid, melts_mm: &[f64]) -> Result<(MeshSolid, Mesh), GateError> {
    let mut refused = GateError::Empty;
    for below_mm in melts_mm {
        let solid = raw.without_detail(*below_mm);
        let mesh = solid.mesh();
        match gate::pass(&mesh) {
            Ok(_) => return Ok((solid, mesh)),
            Err(error) => refused = error,
        }
    }
    Err(refused)
}

/// Detail that is melted away after a bend, mm, in the order in which it is tried.
const MELTS_MM: [f64; 4] = [0.001, 0.0005, 0.0002, 0.0001];

/// The folded solid. Taking away detail where the swept web all but touches the sides can make facets cross, in one
/// part of a hundred; then less is taken away.
fn bent(flat: &MeshSolid, bends: &[Bend]) -> Result<MeshSolid, GateError> {
    Ok(melted(&bends.iter().fold(flat.clone(), |solid, bend| bend.apply(&solid)), &MELTS_MM)?.0)
}

/// A part before it is made.
#[derive(Clone, PartialEq)]
pub(super) struct Recipe {
    feature: Feature,
    bends: Vec<Bend>,
    print_turn: UnitQuaternion<f64>,
}

/// How a part of a frame is made.
pub(super) fn recipe(name: PartName, frame: &Frame, skeleton: &Skeleton, centre: &Centre) -> Recipe {
    let closure = &skeleton.closure;
    let rigid = |feature, print_turn| Recipe { feature, bends: Vec::new(), print_turn };
    match name {
        PartName::TopCorner => {
            let part = TopCorner::from_frame(frame, closure.strut_tilt);
            Recipe { feature: part.feature(), bends: part.bends(), print_turn: TopCorner::print_turn() }
        }
        PartName::BottomCorner => {
            let part = BottomCorner::from_frame(frame, closure.strut_tilt);
            Recipe { feature: part.feature(), bends: part.bends(closure.leg_tilt), print_turn: BottomCorner::print_turn() }
        }
        PartName::HubJoint => {
            let part = HubJoint::from_frame(frame);
            Recipe { feature: part.feature(), bends: part.bends(closure.leg_tilt), print_turn: HubJoint::print_turn() }
        }
        PartName::Knee => rigid(Knee::from_frame(frame, closure.strut_tilt).feature(), Knee::print_turn()),
        PartName::Fork => rigid(Fork::from_frame(frame).feature(), Fork::print_turn()),
        PartName::MotorMount => rigid(MotorMount::from_frame(frame).feature(), MotorMount::print_turn()),
        PartName::Hub => rigid(hub::feature(frame, centre), hub::print_turn()),
        PartName::PiCarrier => rigid(pi_carrier::feature(frame, centre), pi_carrier::print_turn()),
        PartName::BatteryBracket => rigid(battery_bracket::feature(frame, centre), battery_bracket::print_turn()),
        PartName::BatterySleeve => rigid(battery_sleeve::feature(frame, centre), battery_sleeve::print_turn()),
        PartName::BatteryLid => rigid(battery_lid::feature(frame, centre), battery_lid::print_turn()),
        PartName::CameraConnectorLeft => rigid(camera_connector::left(frame, centre), camera_connector::print_turn_left()),
        PartName::CameraConnectorRight => rigid(camera_connector::right(frame, centre), camera_connector::print_turn_right()),
    }
}
