//! The rigid centre: dimensions that its parts share, and where each of them sits.
//!
//! Frame of reference of the assembly: origin on the hub axis in the plane of the arms, x right, y front
//! (camera and flow sensor), z up. Everything follows from the frame's parameters; nothing is placed by hand.

use std::f64::consts::SQRT_2;

use nalgebra::Isometry3;

use super::battery_axes::BatteryAxes;
use super::module::ModulePlaces;
use crate::params::Frame;

/// Plate left around the counterbores of the stack where they reach further out than the plug bores, mm.
const COUNTERBORE_RIM_MM: f64 = 1.0;

/// How far the sleeve's front rim stands at least in front of the bracket, mm.
const FRONT_RIM_MM: f64 = 0.088;

/// How far the battery lies at least over the lid's floor, mm: chosen, for the tape that holds both together. The shallowest floor has 7.89.
pub const LEAST_IN_LID_MM: f64 = 7.5;

/// Least distance from the lid's block to the end of its shell, mm.
const SHELL_STEP_MM: f64 = 0.11;

/// Shared dimensions of the rigid parts, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Centre {
    /// Radius of a plug bore.
    pub bore_radius_mm: f64,
    /// Half the height of the hub: its top is at plus, its underside at minus this.
    pub hub_half_height_mm: f64,
    /// Height of the upper face of the hub's plate.
    pub plate_top_mm: f64,
    /// From a diagonal to the outer flank of its bosses.
    pub flank_mm: f64,
    /// From the hub axis to the tie holes on the x axis; in a square frame the outer flanks of neighbours meet there.
    pub tie_side_mm: f64,
    /// From the hub axis to the tie holes on the y axis, where the outer flanks of the front modules meet, and of the rear ones.
    pub tie_front_mm: f64,
    /// Where the modules stand.
    pub places: ModulePlaces,
    /// The axes of the battery and of what holds it: those of the lengths below.
    pub battery_axes: BatteryAxes,
    /// From the hub axis to the tie holes that the bracket hangs on.
    pub tie_bracket_mm: f64,
    /// From the hub axis to the plate's edge between the arms of a pair.
    pub plate_edge_mm: f64,
    /// Shortest distance of the bores' mouths from the hub axis at which neighbouring bores stay apart.
    pub least_mouth_mm: f64,
    /// Magnet pocket: along x, along z.
    pub magnet_pocket_mm: [f64; 2],
    /// Width of the bracket, and of the lid's tower.
    pub bracket_width_mm: f64,
    /// Height of the bracket.
    pub bracket_height_mm: f64,
    /// Half the length of the bracket.
    pub bracket_half_mm: f64,
    /// Middle of the connector channel above the bracket's origin (negative).
    pub connector_z_mm: f64,
    /// Middle of the magnet pocket above the bracket's origin (negative).
    pub magnet_z_mm: f64,
    /// Half the inner width and height of sleeve and lid.
    pub inner_mm: [f64; 2],
    /// Half the outer width and height of sleeve and lid.
    pub outer_mm: [f64; 2],
    /// Where the sleeve's rear rim is, along y of the battery's axes.
    pub rim_y_mm: f64,
    /// Where the sleeve's front rim is, along y of the battery's axes.
    pub front_y_mm: f64,
    /// Where the battery's rear and front faces are, along y of its axes: as far in front as the sleeve goes, but in its lid.
    pub battery_y_mm: [f64; 2],
    /// Length of the sleeve.
    pub sleeve_length_mm: f64,
    /// How much of the battery the lid covers.
    pub lid_cover_mm: f64,
    /// From the lid's front face to the bottom of its magnet pocket.
    pub lid_magnet_depth_mm: f64,
    bracket_z_mm: f64,
    carrier_top_mm: f64,
    board_mm: f64,
    board_hole_mm: [f64; 2],
}

impl Centre {
    /// The centre of a frame.
    pub fn new(frame: &Frame) -> Self {
        let places = ModulePlaces::of(&frame.rods);
        let (hub, joint, bracket, lid) = (&frame.hub, &frame.hub_joint, &frame.bracket, &frame.lid);
        let plug = joint.hub_joint_diameter_mm;
        let hub_half_height_mm = 0.5 * plug + hub.hub_boss_wall_mm;
        let flank_mm = frame.half_pair_mm() + hub.hub_tie_wall_mm;
        let tie_side_mm = frame.tie_side_mm();
        let tie_front_mm = tie_side_mm + places.forward_mm;
        let battery_axes = BatteryAxes::new(frame.sleeve_direction);
        let tie_bracket_mm = if battery_axes.are_turned() { tie_side_mm } else { tie_front_mm };
        let bracket_half_mm = tie_bracket_mm + hub.tie_ring_radius_mm;
        let behind_bores = hub.hub_mouth_mm - joint.plug_length_mm - hub.hub_back_wall_mm;
        let around_stack = 0.5 * hub.stack_pattern_mm * SQRT_2 + 0.5 * hub.stack_counterbore_diameter_mm + COUNTERBORE_RIM_MM;
        let rim_y_mm = lid.lid_reach_mm - lid.lid_clearance_mm - bracket_half_mm;
        let battery_length_mm = frame.battery.battery_length_mm;
        let front_y_mm = (0.5 * battery_length_mm).max(bracket_half_mm + FRONT_RIM_MM);
        let battery_rear_mm = (front_y_mm - battery_length_mm).min(rim_y_mm - LEAST_IN_LID_MM);
        let stack = BracketStack::new(frame);
        let inner_mm = inner(frame);
        let (side, top) = (frame.sleeve.sleeve_side_wall_mm, frame.sleeve.sleeve_top_wall_mm);
        Self {
            bore_radius_mm: 0.5 * (plug + frame.fit.plug_clearance_mm),
            hub_half_height_mm,
            plate_top_mm: hub.hub_plate_thickness_mm - hub_half_height_mm,
            flank_mm,
            tie_side_mm,
            tie_front_mm,
            places,
            battery_axes,
            tie_bracket_mm,
            plate_edge_mm: behind_bores.max(around_stack),
            least_mouth_mm: frame.least_mouth_mm(),
            magnet_pocket_mm: stack.magnet_mm,
            bracket_width_mm: stack.width_mm,
            bracket_height_mm: stack.height_mm,
            bracket_half_mm,
            connector_z_mm: stack.connector_z_mm,
            magnet_z_mm: stack.magnet_z_mm,
            inner_mm,
            outer_mm: [inner_mm[0] + side, inner_mm[1] + top],
            rim_y_mm,
            front_y_mm,
            battery_y_mm: [battery_rear_mm, battery_rear_mm + battery_length_mm],
            sleeve_length_mm: front_y_mm - rim_y_mm,
            lid_cover_mm: (0.5 * battery_length_mm + rim_y_mm).max(lid.lid_reach_mm - SHELL_STEP_MM),
            lid_magnet_depth_mm: bracket.magnet_thickness_mm + bracket.magnet_gap_mm - lid.lid_clearance_mm,
            bracket_z_mm: -hub_half_height_mm - bracket.stack_z_offset_mm,
            carrier_top_mm: hub_half_height_mm + frame.pi_carrier.carrier_thickness_mm,
            board_mm: frame.bought.get("computer").map_or(0.0, |computer| computer.part.board_mm()),
            board_hole_mm: [0.5 * frame.pi_carrier.pi_pattern_across_mm, 0.5 * frame.pi_carrier.pi_pattern_along_mm],
        }
    }

    /// Where the hub sits: its axes are the assembly's.
    pub fn hub_pose(&self) -> Isometry3<f64> {
        Isometry3::identity()
    }

    /// Where the computer's carrier sits: on the hub.
    pub fn carrier_pose(&self) -> Isometry3<f64> {
        Isometry3::translation(0.0, 0.0, self.hub_half_height_mm)
    }

    /// Where the battery's bracket sits: under the hub.
    pub fn bracket_pose(&self) -> Isometry3<f64> {
        self.battery_axes.pose(Isometry3::translation(0.0, 0.0, self.bracket_z_mm))
    }

    /// Where the battery's sleeve sits, and its lid: at the rim between them.
    pub fn sleeve_pose(&self) -> Isometry3<f64> {
        self.battery_axes.pose(Isometry3::translation(0.0, self.rim_y_mm, self.sleeve_z_mm()))
    }

    /// Where the left camera connector sits: on the computer's board, over a front hole.
    pub fn camera_left_pose(&self) -> Isometry3<f64> {
        let [x, y] = self.board_hole_mm;
        Isometry3::translation(x, y, self.board_top_mm())
    }

    /// Where the right camera connector sits.
    pub fn camera_right_pose(&self) -> Isometry3<f64> {
        let [x, y] = self.board_hole_mm;
        Isometry3::translation(-x, y, self.board_top_mm())
    }

    /// Height of the middle of sleeve and battery.
    pub fn sleeve_z_mm(&self) -> f64 {
        self.bracket_z_mm - self.bracket_height_mm - self.outer_mm[1]
    }

    /// Height of the bracket's origin, the top of its uprights.
    pub fn bracket_z_mm(&self) -> f64 {
        self.bracket_z_mm
    }

    /// Height of the carrier's upper face.
    pub fn carrier_top_mm(&self) -> f64 {
        self.carrier_top_mm
    }

    /// Height of the upper face of the computer's circuit board; the camera connectors stand on it.
    pub fn board_top_mm(&self) -> f64 {
        self.carrier_top_mm + self.board_mm
    }

    /// From the bracket's origin down to the middle of the lid.
    pub fn lid_drop_mm(&self) -> f64 {
        self.bracket_height_mm + self.outer_mm[1]
    }
}

/// Half the inner width and height of sleeve and lid, mm.
fn inner(frame: &Frame) -> [f64; 2] {
    let battery = &frame.battery;
    [
        0.5 * (battery.battery_width_mm + battery.battery_clearance_across_mm),
        0.5 * (battery.battery_height_mm + battery.battery_clearance_up_mm),
    ]
}

/// What the bracket stacks from its floor up: connector, wall, magnet, roof, tie hole.
struct BracketStack {
    magnet_mm: [f64; 2],
    width_mm: f64,
    height_mm: f64,
    connector_z_mm: f64,
    magnet_z_mm: f64,
}

impl BracketStack {
    fn new(frame: &Frame) -> Self {
        let b = &frame.bracket;
        let magnet_mm = [b.magnet_length_mm + b.magnet_clearance_mm, b.magnet_width_mm + b.magnet_clearance_mm];
        let above_channel = b.bracket_floor_mm + b.connector_height_mm;
        let needed = above_channel + b.bracket_wall_mm + magnet_mm[1] + b.bracket_roof_mm + b.tie_hole_depth_mm;
        let height_mm = needed.max(b.bracket_base_mm + b.bay_height_mm);
        Self {
            magnet_mm,
            width_mm: (b.connector_width_mm + 2.0 * b.bracket_side_wall_mm).max(magnet_mm[0] + 2.0 * b.magnet_wall_mm),
            height_mm,
            connector_z_mm: above_channel - 0.5 * b.connector_height_mm - height_mm,
            magnet_z_mm: frame.magnet_above_underside_mm() - height_mm,
        }
    }
}
