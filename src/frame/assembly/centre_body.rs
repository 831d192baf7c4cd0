//! Solids of the bought parts, at their catalogued sizes, where they sit in the assembly: for interference, clearances and pictures.
//!
//! What belongs to the battery is drawn in the battery's axes and turned with its sleeve.
//! What of a zip tie lies outside of its holes is not drawn. Wires and cables are in [`wires`](super::wires).

use nalgebra::{Isometry3, Point3};

use super::board_solid::{Populated, board};
use super::screw_solids;
use crate::frame::parts::battery_bracket::connector;
use crate::frame::parts::outline::along_y;
use crate::frame::skeleton::{Accessories, Centre, Stack};
use crate::params::Frame;
use crate::params::catalogue::BoughtPart;
use crate::params::hung_boards::hung_boards;
use crate::solid::Feature;

/// A body of the centre that is bought: a part of the catalogue, or one of its pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CentreBody {
    /// The battery.
    Battery,
    /// The computer's board.
    Computer,
    /// The flight controller under the hub.
    FlightController,
    /// The motor controllers' board under it.
    MotorController,
    /// The half of the power connector in the bracket.
    ConnectorBracket,
    /// The half of the power connector in the lid.
    ConnectorLid,
    /// The bracket's magnet.
    MagnetBracket,
    /// The lid's magnet.
    MagnetLid,
    /// The optical flow sensor under its tray.
    FlowSensor,
    /// The camera board with its lens.
    Camera,
    /// The four screws of the boards under the hub.
    StackScrews,
    /// The four nuts on them, below the lowest board.
    StackNuts,
    /// The spacers on them between hub and the first board: those of the flight controller, or of an only board.
    SpacersUnderHub,
    /// The spacers on them between the two boards.
    SpacersBetweenBoards,
    /// The four dampers of the flight controller.
    Dampers,
    /// The four ties through hub, carrier and bracket.
    Ties,
    /// The radio receiver on the accessory plate.
    Receiver,
    /// The buzzer beside it.
    Buzzer,
    /// The GPS on its mast.
    Gps,
    /// The camera for goggles between its cheeks.
    FpvCamera,
}

/// Play of the connector in its channel, each side, mm.
const CONNECTOR_PLAY_MM: f64 = 0.175;
/// Depth of the connector's lid half behind the lid, mm.
const CONNECTOR_BEHIND_MM: f64 = 6.0;
/// The flow sensor's edge in front of its holes, mm (Matek 3901-L0X, from pictures).
const SENSOR_BEFORE_MM: f64 = 3.0;
/// Thickness of a camera's circuit board, mm (Raspberry Pi camera).
const CAMERA_BOARD_MM: f64 = 1.1;
/// Half the width of a camera's lens, mm.
const LENS_HALF_MM: f64 = 4.25;

impl CentreBody {
    /// All of them.
    pub const ALL: [Self; 20] = [
        Self::Battery,
        Self::Computer,
        Self::FlightController,
        Self::MotorController,
        Self::ConnectorBracket,
        Self::ConnectorLid,
        Self::MagnetBracket,
        Self::MagnetLid,
        Self::FlowSensor,
        Self::Camera,
        Self::StackScrews,
        Self::StackNuts,
        Self::SpacersUnderHub,
        Self::SpacersBetweenBoards,
        Self::Dampers,
        Self::Ties,
        Self::Receiver,
        Self::Buzzer,
        Self::Gps,
        Self::FpvCamera,
    ];

    /// The name in files.
    pub fn slug(self) -> &'static str {
        match self {
            Self::Battery => "battery",
            Self::Computer => "computer",
            Self::FlightController => "flight_controller",
            Self::MotorController => "motor_controller",
            Self::ConnectorBracket => "connector_bracket",
            Self::ConnectorLid => "connector_lid",
            Self::MagnetBracket => "magnet_bracket",
            Self::MagnetLid => "magnet_lid",
            Self::FlowSensor => "flow_sensor",
            Self::Camera => "camera",
            Self::StackScrews => "stack_screw",
            Self::StackNuts => "stack_nut",
            Self::SpacersUnderHub => "stack_spacer_hub",
            Self::SpacersBetweenBoards => "stack_spacer_boards",
            Self::Dampers => "damper",
            Self::Ties => "tie",
            Self::Receiver => "receiver",
            Self::Buzzer => "buzzer",
            Self::Gps => "gps",
            Self::FpvCamera => "fpv_camera",
        }
    }

    /// The role in the frame file.
    pub fn role(self) -> &'static str {
        match self {
            Self::ConnectorBracket | Self::ConnectorLid => "connector",
            Self::MagnetBracket | Self::MagnetLid => "magnet",
            Self::SpacersUnderHub | Self::SpacersBetweenBoards => "stack_spacer",
            other => other.slug(),
        }
    }

    /// The one with this name in files.
    pub fn named(slug: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|part| part.slug() == slug)
    }

    /// Its share of the pieces of its role, as a weight among the role's bodies.
    pub fn weight(self, frame: &Frame) -> f64 {
        let board = match self {
            Self::SpacersUnderHub => 0,
            Self::SpacersBetweenBoards => 1,
            _ => return 1.0,
        };
        let boards = hung_boards(|role| frame.bought.get(role).map(|item| &item.part));
        boards.get(board).and_then(|board| board.spacers).map_or(0.0, |spacers| f64::from(spacers.count))
    }

    /// Its solid, in the assembly's axes; none where the frame does without it, or has nothing that it belongs to.
    pub fn feature(self, frame: &Frame, centre: &Centre) -> Option<Feature> {
        let part = &frame.bought.get(self.role())?.part;
        Some(match self {
            Self::Battery => turned(centre, battery(frame, centre)),
            Self::Computer => computer(part, frame, centre),
            Self::FlightController | Self::MotorController => return stack_board(self.role(), frame, centre),
            Self::ConnectorBracket => turned(centre, connector_bracket(part, frame, centre)),
            Self::ConnectorLid => turned(centre, connector_lid(frame, centre)),
            Self::MagnetBracket => magnet(frame, centre, -centre.bracket_half_mm + frame.bracket.magnet_thickness_mm),
            Self::MagnetLid => magnet(frame, centre, -centre.bracket_half_mm - frame.bracket.magnet_gap_mm),
            Self::FlowSensor => turned(centre, flow_sensor(part, frame, centre)),
            Self::Camera => camera(part, frame, centre),
            Self::StackScrews => return screw_solids::stack_screws(part, frame, centre),
            Self::StackNuts => return screw_solids::stack_nuts(part, frame, centre),
            Self::SpacersUnderHub => return screw_solids::stack_spacers(0, frame, centre),
            Self::SpacersBetweenBoards => return screw_solids::stack_spacers(1, frame, centre),
            Self::Dampers => return screw_solids::dampers(frame, centre),
            Self::Ties => turned(centre, screw_solids::ties(part, frame, centre)?),
            Self::Receiver | Self::Buzzer | Self::Gps => return on_plate(self.role(), part, frame, centre),
            Self::FpvCamera => return fpv_camera(part, frame, centre),
        })
    }
}

/// A solid of the battery's axes in the frame's.
fn turned(centre: &Centre, own: Feature) -> Feature {
    let axes = centre.battery_axes;
    if axes.are_turned() { own.placed(axes.pose(Isometry3::identity())) } else { own }
}

/// A box, long from front to rear, on its seat.
fn on_plate(role: &str, part: &BoughtPart, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let [long, wide, high] = part.size_mm;
    let low = Feature::cuboid_between([-0.5 * wide, -0.5 * long, 0.0], [0.5 * wide, 0.5 * long, high]);
    Some(low.placed(Accessories::new(frame, centre).pose(role, frame)?))
}

/// Its case, as deep as it is high, on the axis of its side screws, and the lens in front of it.
fn fpv_camera(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let [wide, high, deep] = part.size_mm;
    let (case, half) = (deep.min(0.75 * high), 0.5 * deep);
    let body = Feature::cuboid_between([-0.5 * wide, -half, -0.5 * high], [0.5 * wide, case - half, 0.5 * high]);
    let lens = Feature::cylinder_between(Point3::new(0.0, case - half - 0.1, 0.0), Point3::new(0.0, half, 0.0), 0.4 * wide.min(high));
    let camera = if deep > case + 0.2 { Feature::union([body, lens]) } else { body };
    Some(camera.placed(Accessories::new(frame, centre).pose("fpv_camera", frame)?))
}

fn battery(frame: &Frame, centre: &Centre) -> Feature {
    let b = &frame.battery;
    let (half, low) = (0.5 * b.battery_width_mm, centre.sleeve_z_mm() - centre.inner_mm[1]);
    let [rear, front] = centre.battery_y_mm;
    // A pack that is shorter than its space is taped to the lid's floor.
    let front = frame.battery_as_it_lies_mm().map_or(front, |[long_mm, ..]| front.min(rear + long_mm));
    Feature::cuboid_between([-half, rear, low], [half, front, low + b.battery_height_mm])
}

/// Long along y, on its carrier; its lower side is bare.
fn computer(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Feature {
    let p = &frame.pi_carrier;
    board(part, true, [p.pi_pattern_across_mm, p.pi_pattern_along_mm], centre.carrier_top_mm(), Populated::Above)
}

fn stack_board(role: &str, frame: &Frame, centre: &Centre) -> Option<Feature> {
    let stack = Stack::new(frame, centre);
    let placed = stack.boards.iter().find(|board| board.role == role)?;
    let low_mm = placed.middle_mm - 0.5 * placed.part.size_mm[2];
    // The motor controller's battery pads look where the battery's connector is.
    let turned = role == "motor_controller" && centre.battery_axes.are_turned();
    Some(board(placed.part, turned, [frame.hub.stack_pattern_mm; 2], low_mm, Populated::Both))
}

/// Length of the halves of the power connector, mm: of the bracket's, and of the lid's. The lid's reaches from behind the lid's block to the bracket,
/// and the other one is what the mated pair is long beyond that. No pair has halves of every length: the rule `hardware_fit` looks at them.
pub fn connector_halves_mm(pair_mm: f64, frame: &Frame, centre: &Centre) -> [f64; 2] {
    let lid_mm = -centre.bracket_half_mm - lid_block_rear_mm(frame, centre) + CONNECTOR_BEHIND_MM;
    [pair_mm - lid_mm, lid_mm]
}

/// Where the rear face of the lid's block is, along y of the battery's axes.
fn lid_block_rear_mm(frame: &Frame, centre: &Centre) -> f64 {
    centre.rim_y_mm - frame.lid.lid_reach_mm - frame.lid.lid_block_depth_mm
}

fn connector_bracket(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Feature {
    let rear = -centre.bracket_half_mm;
    let [long_mm, _] = connector_halves_mm(part.size_mm[0], frame, centre);
    let reach = [rear, rear + long_mm.max(1.0)];
    along_y(connector(&frame.bracket, CONNECTOR_PLAY_MM, centre.connector_z_mm + centre.bracket_z_mm()), reach)
}

fn connector_lid(frame: &Frame, centre: &Centre) -> Feature {
    let (b, z) = (&frame.bracket, centre.connector_z_mm + centre.bracket_z_mm());
    let rear = lid_block_rear_mm(frame, centre);
    let nose = along_y(connector(b, b.connector_step_mm + CONNECTOR_PLAY_MM, z), [rear - 0.5, -centre.bracket_half_mm - 0.05]);
    Feature::union([nose, along_y(connector(b, CONNECTOR_PLAY_MM, z), [rear - CONNECTOR_BEHIND_MM, rear])])
}

/// A magnet whose front face is at this y of the battery's axes.
fn magnet(frame: &Frame, centre: &Centre, front: f64) -> Feature {
    let b = &frame.bracket;
    let (half, up, z) = (0.5 * b.magnet_length_mm, 0.5 * b.magnet_width_mm, centre.magnet_z_mm + centre.bracket_z_mm());
    turned(centre, Feature::cuboid_between([-half, front - b.magnet_thickness_mm, z - up], [half, front, z + up]))
}

/// Under its tray, its bare side up.
fn flow_sensor(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Feature {
    let s = &frame.sleeve;
    let [width, depth, height] = part.size_mm;
    let before = SENSOR_BEFORE_MM.min(0.5 * depth);
    let holes = centre.front_y_mm + s.sensor_reach_mm;
    let top = centre.sleeve_z_mm() + centre.outer_mm[1] + s.tray_lift_mm - s.tray_thickness_mm;
    Feature::cuboid_between([-0.5 * width, holes + before - depth, top - height], [0.5 * width, holes + before, top])
}

/// Upright, its back on the connectors' posts, its upper holes as far from the upper edge as from the sides. The lens is as high as the
/// lower holes, and all that the camera is deep beyond its circuit board is in front of that.
fn camera(part: &BoughtPart, frame: &Frame, centre: &Centre) -> Feature {
    let ([width, height, deep], c) = (part.size_mm, &frame.camera);
    let thick = part.board_thickness_mm.unwrap_or(CAMERA_BOARD_MM).min(deep);
    let above = 0.5 * c.camera_pattern_up_mm + 0.5 * (width - c.camera_pattern_across_mm).clamp(0.0, height);
    let back = 0.5 * frame.pi_carrier.pi_pattern_along_mm + c.camera_reach_mm;
    let z = centre.board_top_mm() + c.camera_lift_mm;
    let [low, high] = [z + above - height, z + above];
    let board = Feature::cuboid_between([-0.5 * width, back, low], [0.5 * width, back + thick, high]);
    let half = LENS_HALF_MM.min(0.5 * width).min(0.5 * height);
    let lens = (z - 0.5 * c.camera_pattern_up_mm).clamp(low + half, high - half);
    let barrel = Feature::cuboid_between([-half, back + 0.5 * thick, lens - half], [half, back + deep, lens + half]);
    if deep > thick { Feature::union([board, barrel]) } else { board }
}
