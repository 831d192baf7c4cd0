//! Every number a frame is made of, table by table: key, bounds, meaning, and the parts it drives.

use super::parameter::parameters;
use super::part_name::PartName;

parameters! {
    /// Rod lengths and the rod itself.
    pub struct RodParameters in "rods" {
        /// Length of the eight rods of the top and bottom ring.
        cage_rod_length_mm: 60.0..=320.0 => [Knee],
        /// Length of the eight rods between hub and fork.
        arm_rod_length_mm: 40.0..=180.0 => [Knee],
        /// Length of the eight rods between knee and ring; with the arm it fixes the strut tilt and the height.
        strut_rod_length_mm: 20.0..=120.0 => [Knee],
        /// Outer diameter of every rod; all bores follow it.
        rod_diameter_mm: 2.0..=4.0 => [TopCorner, BottomCorner, Knee, Fork, MotorMount, HubJoint],
        /// Free length behind the arm rod's end in the fork.
        arm_rod_slack_mm: 0.0..=4.0 => [Knee],
    }
}

parameters! {
    /// Clearances between rods, bores and plugs; negative grips.
    pub struct FitParameters in "fit" {
        /// Bore minus rod diameter where a rod is held: corners, knee, fork.
        grip_clearance_mm: -0.6..=0.1 => [TopCorner, BottomCorner, Knee, Fork],
        /// Bore minus rod diameter where a rod slides: hub joint, motor mount.
        slide_clearance_mm: 0.0..=0.5 => [HubJoint, MotorMount],
        /// Plug bore of the hub minus plug diameter.
        plug_clearance_mm: -0.2..=0.4 => [Hub],
    }
}

parameters! {
    /// The printed corners of the two rings.
    pub struct CornerParameters in "corner" {
        /// Wall around a corner's bore.
        corner_wall_mm: 1.2..=2.5 => [TopCorner, BottomCorner, Knee],
        /// Depth of each bore of a corner.
        corner_socket_depth_mm: 4.0..=16.0 => [TopCorner, BottomCorner],
        /// From the ring node to the bottom of the cage and strut bores.
        corner_node_to_bottom_mm: 4.0..=8.0 => [TopCorner, BottomCorner, Knee],
        /// Thickness of the bending web under the strut and leg hinges.
        corner_hinge_thickness_mm: 1.5..=3.5 => [TopCorner, BottomCorner],
        /// Lean of each face of the V notch; the notch closes at twice this.
        notch_half_angle_deg: 30.0..=60.0 => [TopCorner, BottomCorner],
        /// Fillet between the top corner's plate and its sockets.
        corner_web_fillet_mm: 0.0..=2.0 => [TopCorner],
        /// From the ring node to the bottom of the leg bore.
        corner_leg_bottom_mm: 8.0..=16.0 => [BottomCorner],
        /// Lean of the faces beside the leg.
        corner_leg_face_deg: 0.0..=45.0 => [BottomCorner],
        /// Rounding of the cage sockets in the pocket.
        corner_pocket_round_mm: 0.3..=6.0 => [BottomCorner],
    }
}

parameters! {
    /// The joint between hub, two arm rods and one leg rod.
    pub struct HubJointParameters in "hub_joint" {
        /// Outer diameter of the sockets.
        hub_joint_diameter_mm: 4.5..=9.0 => [HubJoint, Hub, PiCarrier, BatteryBracket, BatterySleeve, BatteryLid],
        /// Distance between the two parallel arm rods.
        arm_pitch_mm: 18.0..=34.0 => [HubJoint, Fork, MotorMount, Hub, PiCarrier, BatteryBracket, BatterySleeve, BatteryLid],
        /// Depth of the arm bores.
        hub_arm_socket_depth_mm: 6.0..=16.0 => [HubJoint],
        /// Length of the plugs, and depth of the hub's plug bores.
        plug_length_mm: 5.0..=14.0 => [HubJoint, Hub],
        /// Depth of the leg bore.
        hub_leg_socket_depth_mm: 5.0..=16.0 => [HubJoint],
        /// From the hub's face to the mouth of the leg bore.
        hub_leg_mouth_mm: 16.0..=34.0 => [HubJoint],
        /// From the bottom of the leg bore back to the axis about which the leg folds.
        hub_leg_pivot_mm: 1.0..=7.0 => [],
        /// Solid behind the leg bore.
        hub_leg_root_mm: 5.0..=12.0 => [HubJoint],
        /// Width of the arch that carries the leg.
        arch_width_mm: 3.0..=8.0 => [HubJoint],
        /// Thickness of the two necks that twist when the leg folds.
        neck_thickness_mm: 1.8..=4.0 => [HubJoint],
    }
}

parameters! {
    /// The fork that closes the arm pair, and its bar that snaps into the knee.
    pub struct ForkParameters in "fork" {
        /// Wall around a fork bore.
        fork_wall_mm: 1.2..=2.5 => [Fork],
        /// Depth of the fork bores.
        fork_socket_depth_mm: 5.0..=16.0 => [Fork],
        /// From the bottoms of the bores to the bar's nominal centre.
        fork_reach_mm: 9.0..=20.0 => [Knee, Fork],
        /// How far bar and window lie beyond their nominal centre.
        fork_bar_offset_mm: -1.0..=1.0 => [Fork, Knee],
        /// Bar along the rods.
        fork_bar_depth_mm: 2.0..=5.0 => [Fork, Knee],
        /// Bar across, and thickness of the whole fork.
        fork_bar_height_mm: 3.0..=8.0 => [Fork, Knee],
        /// Rounding of the bar.
        fork_bar_round_mm: 0.0..=1.5 => [Fork],
        /// Gap between the cheeks that hold the knee.
        fork_cheek_gap_mm: 4.0..=10.0 => [Fork],
        /// Depth of the gap behind the bar.
        fork_finger_length_mm: 2.0..=8.0 => [Fork],
        /// Width of the fingers beside the gap.
        fork_finger_width_mm: 1.0..=4.0 => [Fork],
        /// Slope of the fork's legs to the rods.
        fork_leg_slope_deg: 45.0..=80.0 => [Fork],
    }
}

parameters! {
    /// The knee that carries two struts and is snapped onto the fork's bar.
    pub struct KneeParameters in "knee" {
        /// Depth of the strut bores.
        knee_socket_depth_mm: 5.0..=16.0 => [Knee],
        /// From the crossing of the strut axes to the bottom of a bore.
        knee_node_to_bottom_mm: 4.0..=9.0 => [Knee],
        /// Wall beside a bore.
        knee_side_wall_mm: 1.2..=2.5 => [Knee],
        /// Wall behind a bore.
        knee_back_wall_mm: 1.2..=2.5 => [Knee],
        /// From the crossing of the strut axes out to the bar's nominal centre.
        knee_node_offset_mm: 1.0..=6.0 => [Knee],
        /// Window minus bar, along the rods.
        knee_window_clearance_depth_mm: 0.0..=0.4 => [Knee],
        /// Window minus bar, across.
        knee_window_clearance_height_mm: 0.0..=0.4 => [Knee],
        /// Rounding of the window's corners.
        knee_window_round_mm: 0.2..=1.5 => [Knee],
        /// Rounding of the window's rims.
        knee_window_flare_mm: 0.3..=2.0 => [Knee],
        /// Rib on the inner side of the window.
        knee_rib_mm: 2.0..=5.0 => [Knee],
        /// Plate on the outer side of the window.
        knee_plate_thickness_mm: 2.0..=6.0 => [Knee],
        /// Width of the outer plate.
        knee_plate_width_mm: 8.0..=20.0 => [Knee],
        /// Rounding of the plate's ends.
        knee_plate_round_mm: 0.5..=4.0 => [Knee],
        /// Rounding of the block's edges.
        knee_edge_round_mm: 0.5..=3.0 => [Knee],
    }
}

parameters! {
    /// The motor mount that slides on an arm pair, and where the motor sits.
    pub struct MotorMountParameters in "motor_mount" {
        /// From the hub axis to the motor axis, along the diagonal.
        motor_position_mm: 30.0..=140.0 => [],
        /// Outer diameter of the slide rings.
        motor_ring_diameter_mm: 4.5..=9.0 => [MotorMount],
        /// Width of the slide rings along the rods.
        motor_ring_width_mm: 4.0..=10.0 => [MotorMount],
        /// Thickness of the motor plate.
        motor_plate_thickness_mm: 1.5..=4.0 => [MotorMount],
        /// Diameter of the motor plate.
        motor_plate_diameter_mm: 11.0..=26.0 => [MotorMount],
        /// Wall of the skirt under the plate.
        motor_skirt_wall_mm: 0.8..=2.0 => [MotorMount],
        /// Depth of the skirt.
        motor_skirt_depth_mm: 0.0..=4.0 => [MotorMount],
        /// Rounding of the plate's rim.
        motor_edge_round_mm: 0.0..=2.0 => [MotorMount],
        /// Concave radius between plate and rings.
        motor_waist_round_mm: 1.0..=8.0 => [MotorMount],
        /// Narrowest width between plate and ring.
        motor_waist_mm: 3.0..=9.0 => [MotorMount],
        /// Screw holes of the motor.
        motor_hole_diameter_mm: 1.4..=3.4 => [MotorMount],
        /// Diameter of the circle of the screw holes.
        motor_hole_circle_mm: 6.6..=19.0 => [MotorMount],
        /// Hole under the motor's shaft; 0 leaves it out.
        motor_shaft_hole_mm: 0.0..=6.0 => [MotorMount],
        /// How much the plate is raised above the rods.
        motor_riser_mm: 0.0..=12.0 => [MotorMount],
        /// Height of the plate's top above the rods' axes without riser.
        motor_ledge_mm: 2.5..=6.0 => [MotorMount],
        /// Diameter of the propellers; the bought propeller's unless stated.
        propeller_diameter_mm: 30.0..=160.0 => [],
        /// From the plate's top to the propeller's mid plane.
        propeller_height_mm: 6.0..=30.0 => [],
    }
}

parameters! {
    /// The rigid plate that eight plugs are pressed into.
    pub struct HubParameters in "hub" {
        /// Distance from the hub axis to the mouth of the plug bores, along the diagonal.
        hub_mouth_mm: 18.0..=40.0 => [Knee, Hub],
        /// Thickness of the plate.
        hub_plate_thickness_mm: 2.5..=6.0 => [Hub],
        /// Wall around a plug bore; fixes the hub height.
        hub_boss_wall_mm: 0.8..=2.5 => [Hub],
        /// Wall between plug bore and the outer flank; fixes the tie radius.
        hub_tie_wall_mm: 1.2..=3.5 => [Hub, PiCarrier, BatteryBracket, BatterySleeve, BatteryLid],
        /// Plate left behind a plug bore (plate edge between two arms of a pair).
        hub_back_wall_mm: 0.8..=3.0 => [Hub],
        /// Rounding of the bosses and the plate edge.
        hub_edge_radius_mm: 0.5..=2.0 => [Hub],
        /// Radius of the ring around a tie hole, in hub, carrier and bracket.
        tie_ring_radius_mm: 2.5..=5.0 => [Hub, PiCarrier, BatteryBracket, BatterySleeve, BatteryLid],
        /// Tie hole through the hub.
        hub_tie_hole_diameter_mm: 2.0..=4.0 => [Hub],
        /// Flat top inwards of the tie hole.
        hub_pad_depth_mm: 4.0..=8.0 => [Hub],
        /// Fillet between plate and the inner side of a pad.
        hub_pad_fillet_mm: 2.0..=6.0 => [Hub],
        /// Square hole pattern of the flight controller stack.
        stack_pattern_mm: 16.0..=30.5 => [Hub],
        /// Pilot hole of a stack screw (self-tapping M2).
        stack_pilot_diameter_mm: 1.2..=3.4 => [Hub],
        /// Counterbore for the screw head.
        stack_counterbore_diameter_mm: 3.0..=7.0 => [Hub],
        /// Depth of the counterbore, upper face.
        stack_counterbore_depth_mm: 0.5..=3.0 => [Hub],
    }
}

parameters! {
    /// The plate that carries the computer above the hub.
    pub struct CarrierParameters in "pi_carrier" {
        /// Carrier thickness.
        carrier_thickness_mm: 1.2..=4.0 => [PiCarrier],
        /// Hole pattern of the board, across.
        pi_pattern_across_mm: 20.0..=49.0 => [PiCarrier, CameraConnectorLeft, CameraConnectorRight],
        /// Hole pattern of the board, along the camera direction.
        pi_pattern_along_mm: 50.0..=58.0 => [PiCarrier],
        /// Board holes.
        pi_hole_diameter_mm: 2.0..=3.2 => [PiCarrier],
        /// Tie holes of the carrier.
        carrier_tie_hole_diameter_mm: 2.5..=5.0 => [PiCarrier],
        /// Carrier pad radius.
        carrier_pad_radius_mm: 2.2..=4.0 => [PiCarrier],
        /// Bars to the board pads.
        carrier_strut_width_mm: 2.0..=4.0 => [PiCarrier],
        /// Bars between the ties.
        carrier_bar_width_mm: 2.0..=5.0 => [PiCarrier],
        /// Carrier fillet.
        carrier_fillet_mm: 0.4..=2.0 => [PiCarrier],
    }
}

parameters! {
    /// The battery's size; its mass is the bought part's.
    pub struct BatteryParameters in "battery" {
        /// Battery length.
        battery_length_mm: 40.0..=110.0 => [BatterySleeve, BatteryLid],
        /// Battery width.
        battery_width_mm: 18.0..=50.0 => [BatterySleeve, BatteryLid],
        /// Battery height.
        battery_height_mm: 8.0..=35.0 => [BatterySleeve, BatteryLid],
        /// Sleeve width minus battery width.
        battery_clearance_across_mm: 0.3..=1.5 => [BatterySleeve, BatteryLid],
        /// Sleeve height minus battery height.
        battery_clearance_up_mm: 0.2..=1.5 => [BatterySleeve, BatteryLid],
        /// Mass of the battery; the bought battery's unless stated.
        battery_mass_g: 0.0..=1000.0 => [],
    }
}

parameters! {
    /// The battery tube under the bracket, with the tray of the flow sensor.
    pub struct SleeveParameters in "sleeve" {
        /// Sleeve side wall.
        sleeve_side_wall_mm: 0.8..=2.5 => [BatterySleeve, BatteryLid],
        /// Top and bottom wall of sleeve and lid.
        sleeve_top_wall_mm: 0.8..=3.0 => [BatterySleeve, BatteryLid],
        /// Sleeve edge radius.
        sleeve_edge_radius_mm: 0.0..=2.0 => [BatterySleeve, BatteryLid],
        /// Chamfer inside the rear rim.
        sleeve_lead_in_mm: 0.0..=0.9 => [BatterySleeve],
        /// Ribs on both sides of the bracket base.
        rib_height_mm: 0.8..=3.0 => [BatterySleeve],
        /// Flat top of a rib; its outer side is a quarter circle.
        rib_width_mm: 0.6..=2.0 => [BatterySleeve],
        /// Between bracket base and rib, each side.
        channel_clearance_mm: 0.0..=0.3 => [BatterySleeve],
        /// Lug width.
        lug_width_mm: 3.0..=10.0 => [BatterySleeve],
        /// Lug height.
        lug_height_mm: 5.0..=14.0 => [BatterySleeve],
        /// Lug depth.
        lug_depth_mm: 1.0..=3.0 => [BatterySleeve],
        /// Lugs below the middle.
        lug_drop_mm: -3.0..=3.0 => [BatterySleeve],
        /// Middle of the front lugs, behind the front rim.
        lug_front_mm: 3.0..=30.0 => [BatterySleeve],
        /// Middle of the rear lugs, in front of the rear rim.
        lug_rear_mm: 3.0..=30.0 => [BatterySleeve],
        /// Tray thickness.
        tray_thickness_mm: 1.2..=3.0 => [BatterySleeve],
        /// Tray top above the sleeve top.
        tray_lift_mm: 0.6..=2.0 => [BatterySleeve],
        /// Tray on the sleeve.
        tray_overlap_mm: 2.0..=8.0 => [BatterySleeve],
        /// Hole pitch of the flow sensor.
        sensor_hole_pitch_mm: 16.0..=34.0 => [BatterySleeve],
        /// Sensor hole diameter.
        sensor_hole_diameter_mm: 1.6..=3.4 => [BatterySleeve],
        /// Sensor holes in front of the front rim.
        sensor_reach_mm: 8.0..=20.0 => [BatterySleeve],
        /// Front bar.
        tray_bar_mm: 2.5..=6.0 => [BatterySleeve],
        /// Tray pad radius.
        tray_pad_radius_mm: 2.2..=4.0 => [BatterySleeve],
        /// Tray left and right of the window.
        tray_window_side_mm: 4.0..=12.0 => [BatterySleeve],
    }
}

parameters! {
    /// The bracket between hub and sleeve: electronics bay, connector and magnet.
    pub struct BracketParameters in "bracket" {
        /// Under the connector channel.
        bracket_floor_mm: 0.8..=2.0 => [BatteryBracket, BatteryLid],
        /// Beside the channel.
        bracket_side_wall_mm: 1.0..=2.5 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Height of the base.
        bracket_base_mm: 2.0..=5.0 => [BatteryBracket],
        /// Clear height between base and hub (electronics bay).
        bay_height_mm: 14.0..=45.0 => [BatteryBracket],
        /// Between channel and magnet.
        bracket_wall_mm: 1.2..=3.0 => [BatteryBracket, BatteryLid],
        /// Between magnet and tie hole.
        bracket_roof_mm: 1.2..=3.0 => [BatteryBracket],
        /// Tie hole diameter.
        tie_hole_diameter_mm: 2.5..=5.0 => [BatteryBracket],
        /// Tie hole depth.
        tie_hole_depth_mm: 4.0..=10.0 => [BatteryBracket],
        /// Tie slot width.
        tie_slot_width_mm: 2.0..=4.5 => [BatteryBracket],
        /// Tie slot height.
        tie_slot_height_mm: 1.2..=3.0 => [BatteryBracket],
        /// Base to rear upright.
        bracket_fillet_mm: 0.5..=4.0 => [BatteryBracket],
        /// Wire hole diameter.
        wire_hole_diameter_mm: 1.5..=4.0 => [BatteryBracket],
        /// Wire hole pitch across.
        wire_hole_pitch_across_mm: 4.5..=8.0 => [BatteryBracket],
        /// Wire hole pitch up.
        wire_hole_pitch_up_mm: 4.0..=8.0 => [BatteryBracket],
        /// Channel for the power connector (XT30), across.
        connector_width_mm: 9.0..=20.0 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Connector height.
        connector_height_mm: 5.0..=10.0 => [BatteryBracket, BatteryLid],
        /// The two corners that code its polarity.
        connector_chamfer_mm: 0.0..=3.0 => [BatteryBracket, BatteryLid],
        /// The nose held by the lid is smaller by this, each side.
        connector_step_mm: 0.0..=1.5 => [BatteryLid],
        /// Magnet length.
        magnet_length_mm: 4.0..=20.0 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Magnet width.
        magnet_width_mm: 3.0..=10.0 => [BatteryBracket, BatteryLid],
        /// Magnet thickness.
        magnet_thickness_mm: 1.0..=5.0 => [BatteryBracket, BatteryLid],
        /// Pocket minus magnet, whole.
        magnet_clearance_mm: 0.0..=0.4 => [BatteryBracket, BatteryLid],
        /// Beside and above the magnet.
        magnet_wall_mm: 1.0..=3.0 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Between the magnet faces, lid closed.
        magnet_gap_mm: 0.1..=1.5 => [BatteryLid],
        /// Air between hub and bracket (CAD).
        stack_z_offset_mm: 0.0..=0.6 => [],
    }
}

parameters! {
    /// The lid that stays on the battery: the cartridge's rim, connector and magnet.
    pub struct LidParameters in "lid" {
        /// From the rim plane to the front face of the lid block.
        lid_reach_mm: 8.0..=25.0 => [BatterySleeve, BatteryLid],
        /// Lid block behind the bracket.
        lid_clearance_mm: 0.1..=0.6 => [BatterySleeve, BatteryLid],
        /// Lid top under the bracket.
        lid_slide_clearance_mm: 0.05..=0.4 => [BatteryLid],
        /// Front to back of the block that carries the connector.
        lid_block_depth_mm: 5.0..=15.0 => [BatteryLid],
        /// Block above the connector hole.
        lid_block_above_mm: 1.0..=3.0 => [BatteryLid],
        /// Lid corner radius.
        lid_corner_radius_mm: 1.0..=7.0 => [BatteryLid],
        /// Thickness of the cheeks.
        lid_cheek_mm: 1.0..=3.0 => [BatteryLid],
        /// Lid arch radius.
        lid_arch_radius_mm: 1.0..=7.0 => [BatteryLid],
        /// Behind the magnet.
        tower_back_mm: 1.2..=4.0 => [BatteryLid],
        /// Tower radius.
        tower_radius_mm: 0.5..=2.5 => [BatteryLid],
    }
}

parameters! {
    /// The two connectors between computer board and camera.
    pub struct CameraParameters in "camera" {
        /// Camera pattern across.
        camera_pattern_across_mm: 10.0..=40.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Camera pattern up.
        camera_pattern_up_mm: 8.0..=40.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Camera hole diameter.
        camera_hole_diameter_mm: 1.5..=3.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// From the board hole to the face that carries the camera.
        camera_reach_mm: 14.0..=40.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Camera hole pattern centre above the board.
        camera_lift_mm: 6.0..=30.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Foot height.
        camera_foot_mm: 2.0..=8.0 => [CameraConnectorLeft, CameraConnectorRight],
    }
}

parameters! {
    /// What the frame must keep; `check` holds it against these.
    pub struct LimitParameters in "limits" {
        /// Largest width and depth of the whole frame, without propellers.
        envelope_width_mm: 60.0..=600.0 => [],
        /// Largest height.
        envelope_height_mm: 40.0..=400.0 => [],
        /// Largest take-off mass.
        mass_budget_g: 20.0..=2000.0 => [],
        /// Least distance of a propeller's disc to rods, hub, boards and its neighbour.
        propeller_clearance_mm: 0.0..=50.0 => [],
        /// Least distance between rods, and between rods and parts that do not hold them.
        part_clearance_mm: 0.0..=20.0 => [],
        /// Least distance between the battery sleeve and the ground.
        ground_clearance_mm: 0.0..=60.0 => [],
        /// Least length of a rod inside each socket.
        socket_engagement_mm: 0.0..=20.0 => [],
        /// Elongation at break over the largest strain allowed in a fold hinge.
        hinge_strain_factor: 1.0..=20.0 => [],
        /// Largest distance of the centre of mass from the motors' centre, in plan.
        centre_of_mass_offset_mm: 0.0..=60.0 => [],
    }
}
