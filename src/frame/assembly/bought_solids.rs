//! Plain solids for the bought parts of the centre, where they sit in the assembly: for interference and pictures.

use crate::frame::parts::battery_bracket::connector;
use crate::frame::parts::outline::{along_y, upright};
use crate::frame::skeleton::centre::{BOARD_THICKNESS_MM, Centre};
use crate::params::Frame;
use crate::solid::{Contour, Feature, Profile};

/// A bought part of the centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BoughtPart {
    /// The battery.
    Battery,
    /// The computer's board.
    Computer,
    /// Flight and motor controllers on the stack holes under the hub.
    Stack,
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
}

/// Board of the computer beyond its hole pattern (Pi Zero: 65 x 30 on 58 x 23), each side, mm.
const BOARD_MARGIN_MM: f64 = 3.5;
/// Boards of the stack beyond their hole pattern, each side, mm.
const STACK_MARGIN_MM: f64 = 3.5;
/// Air between hub and stack, and height of the stack, mm.
const STACK_GAP_MM: f64 = 1.5;
const STACK_HEIGHT_MM: f64 = 13.0;
/// Play of the connector in its channel, each side, mm.
const CONNECTOR_PLAY_MM: f64 = 0.175;
/// Depth of the connector's bracket half beyond the upright, and of the lid half behind the lid, mm.
const CONNECTOR_DEEP_MM: [f64; 2] = [3.0, 6.0];
/// Flow sensor (Matek 3901-L0X, from pictures): width, depth behind and before its holes, height, mm.
const SENSOR_MM: [f64; 4] = [36.5, 9.5, 3.0, 3.0];
/// Camera board, hung by its upper edge: width, height below and above the middle of its holes, thickness, mm.
const CAMERA_MM: [f64; 4] = [25.0, 15.75, 8.25, 1.1];
/// Lens, at the height of the lower holes: half its width, middle above that of the holes, depth, mm.
const LENS_MM: [f64; 3] = [4.25, -6.25, 5.0];

impl BoughtPart {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Battery,
        Self::Computer,
        Self::Stack,
        Self::ConnectorBracket,
        Self::ConnectorLid,
        Self::MagnetBracket,
        Self::MagnetLid,
        Self::FlowSensor,
        Self::Camera,
    ];

    /// The name in files.
    pub fn slug(self) -> &'static str {
        match self {
            Self::Battery => "battery",
            Self::Computer => "computer",
            Self::Stack => "stack",
            Self::ConnectorBracket => "connector_bracket",
            Self::ConnectorLid => "connector_lid",
            Self::MagnetBracket => "magnet_bracket",
            Self::MagnetLid => "magnet_lid",
            Self::FlowSensor => "flow_sensor",
            Self::Camera => "camera",
        }
    }

    /// Its solid, in the assembly's axes.
    pub fn feature(self, frame: &Frame, centre: &Centre) -> Feature {
        match self {
            Self::Battery => battery(frame, centre),
            Self::Computer => computer(frame, centre),
            Self::Stack => stack(frame, centre),
            Self::ConnectorBracket => connector_bracket(frame, centre),
            Self::ConnectorLid => connector_lid(frame, centre),
            Self::MagnetBracket => magnet(frame, centre, -centre.bracket_half_mm + frame.bracket.magnet_thickness_mm),
            Self::MagnetLid => magnet(frame, centre, -centre.bracket_half_mm - frame.bracket.magnet_gap_mm),
            Self::FlowSensor => flow_sensor(frame, centre),
            Self::Camera => camera(frame, centre),
        }
    }
}

fn battery(frame: &Frame, centre: &Centre) -> Feature {
    let b = &frame.battery;
    let (half, low) = (0.5 * b.battery_width_mm, centre.sleeve_z_mm() - centre.inner_mm[1]);
    let rear = centre.front_y_mm - b.battery_length_mm;
    Feature::cuboid_between([-half, rear, low], [half, centre.front_y_mm, low + b.battery_height_mm])
}

fn computer(frame: &Frame, centre: &Centre) -> Feature {
    let p = &frame.pi_carrier;
    let size = [p.pi_pattern_across_mm + 2.0 * BOARD_MARGIN_MM, p.pi_pattern_along_mm + 2.0 * BOARD_MARGIN_MM];
    let board = Contour::rounded_rectangle([0.0, 0.0], size, 3.0);
    upright(Profile::new(board), [centre.carrier_top_mm(), centre.carrier_top_mm() + BOARD_THICKNESS_MM])
}

fn stack(frame: &Frame, centre: &Centre) -> Feature {
    let half = 0.5 * frame.hub.stack_pattern_mm + STACK_MARGIN_MM;
    let top = -centre.hub_half_height_mm - STACK_GAP_MM;
    Feature::cuboid_between([-half, -half, top - STACK_HEIGHT_MM], [half, half, top])
}

fn connector_bracket(frame: &Frame, centre: &Centre) -> Feature {
    let rear = -centre.bracket_half_mm;
    let reach = [rear, rear + 2.0 * frame.hub.tie_ring_radius_mm + CONNECTOR_DEEP_MM[0]];
    along_y(connector(&frame.bracket, CONNECTOR_PLAY_MM, centre.connector_z_mm + centre.bracket_z_mm()), reach)
}

fn connector_lid(frame: &Frame, centre: &Centre) -> Feature {
    let (b, z) = (&frame.bracket, centre.connector_z_mm + centre.bracket_z_mm());
    let rear = centre.rim_y_mm - frame.lid.lid_reach_mm - frame.lid.lid_block_depth_mm;
    let nose = along_y(connector(b, b.connector_step_mm + CONNECTOR_PLAY_MM, z), [rear - 0.5, -centre.bracket_half_mm - 0.05]);
    Feature::union([nose, along_y(connector(b, CONNECTOR_PLAY_MM, z), [rear - CONNECTOR_DEEP_MM[1], rear])])
}

/// A magnet whose front face is at this y.
fn magnet(frame: &Frame, centre: &Centre, front: f64) -> Feature {
    let b = &frame.bracket;
    let (half, up, z) = (0.5 * b.magnet_length_mm, 0.5 * b.magnet_width_mm, centre.magnet_z_mm + centre.bracket_z_mm());
    Feature::cuboid_between([-half, front - b.magnet_thickness_mm, z - up], [half, front, z + up])
}

fn flow_sensor(frame: &Frame, centre: &Centre) -> Feature {
    let s = &frame.sleeve;
    let [width, behind, before, height] = SENSOR_MM;
    let holes = centre.front_y_mm + s.sensor_reach_mm;
    let top = centre.sleeve_z_mm() + centre.outer_mm[1] + s.tray_lift_mm - s.tray_thickness_mm;
    Feature::cuboid_between([-0.5 * width, holes - behind, top - height], [0.5 * width, holes + before, top])
}

fn camera(frame: &Frame, centre: &Centre) -> Feature {
    let [width, below, above, thick] = CAMERA_MM;
    let [lens, lift, deep] = LENS_MM;
    let back = 0.5 * frame.pi_carrier.pi_pattern_along_mm + frame.camera.camera_reach_mm;
    let z = centre.board_top_mm() + frame.camera.camera_lift_mm;
    let board = Feature::cuboid_between([-0.5 * width, back, z - below], [0.5 * width, back + thick, z + above]);
    let barrel = Feature::cuboid_between([-lens, back + 0.5 * thick, z + lift - lens], [lens, back + thick + deep, z + lift + lens]);
    Feature::union([board, barrel])
}
