//! Every number a frame is made of, table by table: key, bounds, meaning, and the parts it drives.

use super::parameter::parameters;
use super::part_name::PartName;

parameters! {
    /// Rod lengths and the rod itself.
    pub struct RodParameters in "rods" {
        /// Length of the eight rods of the top and bottom ring; of those in front and behind where the sides are longer.
        cage_rod_length_mm: 60.0..=320.0 => [Knee],
        /// Length of a ring's left and right rods over that of the front and rear ones: a long X where it is more than 1.
        cage_side_ratio: 1.0..=1.25 => [Hub, PiCarrier, BatteryBracket, BatterySleeve, AccessoryPlate],
        /// Length of the eight rods between hub and fork.
        arm_rod_length_mm: 40.0..=180.0 => [Knee],
        /// Length of the eight rods between knee and ring; with the arm it fixes the strut tilt and the height.
        strut_rod_length_mm: 20.0..=120.0 => [Knee],
        /// Outer diameter of every rod; all bores follow it.
        rod_diameter_mm: 2.0..=4.0 => [TopCorner, BottomCorner, Knee, Fork, MotorMount, HubJoint],
        /// From the arm rod's end to the bottom of its bore in the fork.
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
        hub_joint_diameter_mm: 4.5..=9.0 => [HubJoint, Hub, PiCarrier, AccessoryPlate, BatteryBracket, BatterySleeve, BatteryLid],
        /// Distance between the two parallel arm rods.
        arm_pitch_mm: 18.0..=34.0 => [HubJoint, Fork, MotorMount, Hub, PiCarrier, AccessoryPlate, BatteryBracket, BatterySleeve, BatteryLid],
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
        /// Gap between the cheeks that hold the knee; where it follows, it grows with grip_clearance_mm over -0.3 mm, as the knee does.
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
        /// How far the skirt reaches down below the plate's underside.
        motor_skirt_depth_mm: 0.0..=4.0 => [MotorMount],
        /// Rounding of the plate's upper rim.
        motor_edge_round_mm: 0.0..=2.0 => [MotorMount],
        /// Concave radius between plate and rings.
        motor_waist_round_mm: 1.0..=8.0 => [MotorMount],
        /// Narrowest width between plate and ring.
        motor_waist_mm: 3.0..=9.0 => [MotorMount],
        /// Diameter of the motor's screw holes in the plate.
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
        propeller_diameter_mm: 30.0..=200.0 => [],
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
        hub_tie_wall_mm: 1.2..=3.5 => [Hub, PiCarrier, AccessoryPlate, BatteryBracket, BatterySleeve, BatteryLid],
        /// Plate left behind a plug bore (plate edge between two arms of a pair).
        hub_back_wall_mm: 0.8..=3.0 => [Hub],
        /// Rounding of the bosses and the plate edge; no more than leaves a rim around the tie holes.
        hub_edge_radius_mm: 0.5..=2.0 => [Hub],
        /// Radius of the ring around a tie hole, in hub, carrier and bracket.
        tie_ring_radius_mm: 2.5..=5.0 => [Hub, PiCarrier, AccessoryPlate, BatteryBracket, BatterySleeve, BatteryLid],
        /// Diameter of the four tie holes through the hub.
        hub_tie_hole_diameter_mm: 2.0..=4.0 => [Hub],
        /// From the middle of a tie hole inwards to the end of the flat top around it.
        hub_pad_depth_mm: 4.0..=8.0 => [Hub],
        /// Fillet between plate and the inner side of a pad.
        hub_pad_fillet_mm: 2.0..=6.0 => [Hub],
        /// Square hole pattern of the flight controller stack.
        stack_pattern_mm: 16.0..=30.5 => [Hub],
        /// Pilot hole of a stack screw (self-tapping M2).
        stack_pilot_diameter_mm: 1.2..=3.4 => [Hub],
        /// Diameter of the counterbore that takes a stack screw's head.
        stack_counterbore_diameter_mm: 3.0..=7.0 => [Hub],
        /// Depth of that counterbore below the plate's upper face.
        stack_counterbore_depth_mm: 0.5..=3.0 => [Hub],
    }
}

parameters! {
    /// The plate that carries the computer above the hub.
    pub struct CarrierParameters in "pi_carrier" {
        /// Thickness of the whole carrier, from the hub's top to the board's underside.
        carrier_thickness_mm: 1.2..=4.0 => [PiCarrier],
        /// Distance of the board's holes left to right, from middle to middle.
        pi_pattern_across_mm: 20.0..=49.0 => [PiCarrier, CameraConnectorLeft, CameraConnectorRight],
        /// Distance of the board's holes front to rear, from middle to middle.
        pi_pattern_along_mm: 50.0..=58.0 => [PiCarrier],
        /// Diameter of the carrier's holes under the board's; 1.9 for an M2 screw that cuts its thread.
        pi_hole_diameter_mm: 1.6..=3.2 => [PiCarrier],
        /// Diameter of the four tie holes through the carrier.
        carrier_tie_hole_diameter_mm: 2.5..=5.0 => [PiCarrier, AccessoryPlate],
        /// Outer radius of the rings around the board's holes.
        carrier_pad_radius_mm: 2.2..=4.0 => [PiCarrier],
        /// Width of the bars from the tie rings to the board's holes.
        carrier_strut_width_mm: 2.0..=4.0 => [PiCarrier],
        /// Width of the four bars from tie ring to tie ring.
        carrier_bar_width_mm: 2.0..=5.0 => [PiCarrier],
        /// Fillet where the carrier's bars meet.
        carrier_fillet_mm: 0.4..=2.0 => [PiCarrier],
    }
}

parameters! {
    /// The battery's size; its mass is the bought part's.
    pub struct BatteryParameters in "battery" {
        /// Length of the battery without leads, front to rear; the bought battery's unless stated.
        battery_length_mm: 40.0..=110.0 => [BatterySleeve, BatteryLid],
        /// Width of the battery, left to right; the bought battery's unless stated.
        battery_width_mm: 14.0..=50.0 => [BatterySleeve, BatteryLid],
        /// Height of the battery; the bought battery's unless stated.
        battery_height_mm: 8.0..=45.0 => [BatterySleeve, BatteryLid],
        /// Inner width of sleeve and lid minus the battery's width, both sides together.
        battery_clearance_across_mm: 0.3..=1.5 => [BatterySleeve, BatteryLid],
        /// Inner height of sleeve and lid minus the battery's height, top and bottom together.
        battery_clearance_up_mm: 0.2..=1.5 => [BatterySleeve, BatteryLid],
        /// Mass of the battery; the bought battery's unless stated.
        battery_mass_g: 0.0..=1000.0 => [],
    }
}

parameters! {
    /// The battery tube under the bracket, with the tray of the flow sensor; front and rear are those of a tube that lies along the frame.
    pub struct SleeveParameters in "sleeve" {
        /// Thickness of the left and right wall of sleeve and lid.
        sleeve_side_wall_mm: 0.8..=2.5 => [BatterySleeve, BatteryLid],
        /// Thickness of the top and bottom wall of sleeve and lid.
        sleeve_top_wall_mm: 0.8..=3.0 => [BatterySleeve, BatteryLid],
        /// Rounding of the sleeve's and the lid's long outer edges; no more than their side wall is thick.
        sleeve_edge_radius_mm: 0.0..=2.0 => [BatterySleeve, BatteryLid],
        /// Chamfer inside the sleeve's rear rim, where the battery enters.
        sleeve_lead_in_mm: 0.0..=0.9 => [BatterySleeve],
        /// Height above the sleeve's top of the two ribs between which the bracket's base is glued.
        rib_height_mm: 0.8..=3.0 => [BatterySleeve],
        /// Width of a rib's flat top; its outer side is a quarter circle.
        rib_width_mm: 0.6..=2.0 => [BatterySleeve],
        /// From each side of the bracket's base to the rib beside it.
        channel_clearance_mm: 0.0..=0.3 => [BatterySleeve],
        /// Size of each lug on the sleeve's sides, front to rear.
        lug_width_mm: 3.0..=10.0 => [BatterySleeve],
        /// Size of each lug's outer face, from bottom to top.
        lug_height_mm: 5.0..=14.0 => [BatterySleeve],
        /// How far each lug stands out from the sleeve's side wall.
        lug_depth_mm: 1.0..=3.0 => [BatterySleeve],
        /// From the middle of the battery's cross section down to the middle of the lugs.
        lug_drop_mm: -3.0..=3.0 => [BatterySleeve],
        /// From the sleeve's front rim back to the middle of the front lugs.
        lug_front_mm: 3.0..=30.0 => [BatterySleeve],
        /// From the sleeve's rear rim forward to the middle of the rear lugs.
        lug_rear_mm: 3.0..=30.0 => [BatterySleeve],
        /// Thickness of the flow sensor's tray.
        tray_thickness_mm: 1.2..=3.0 => [BatterySleeve],
        /// From the sleeve's top face up to the tray's.
        tray_lift_mm: 0.6..=2.0 => [BatterySleeve],
        /// How far the tray's wings lie on the sleeve, from the front rim back.
        tray_overlap_mm: 2.0..=8.0 => [BatterySleeve],
        /// Distance of the flow sensor's two holes, from middle to middle.
        sensor_hole_pitch_mm: 16.0..=34.0 => [BatterySleeve],
        /// Diameter of the flow sensor's holes in the tray.
        sensor_hole_diameter_mm: 1.6..=3.4 => [BatterySleeve],
        /// From the sleeve's front rim forward to the middle of the flow sensor's holes.
        sensor_reach_mm: 8.0..=20.0 => [BatterySleeve],
        /// Width, front to rear, of the tray's bar between the sensor's holes.
        tray_bar_mm: 2.5..=6.0 => [BatterySleeve],
        /// From the middle of a sensor hole to the tray's edge.
        tray_pad_radius_mm: 2.2..=4.0 => [BatterySleeve],
        /// From the sleeve's outer side in to the tray's window, each side.
        tray_window_side_mm: 4.0..=12.0 => [BatterySleeve],
    }
}

parameters! {
    /// The bracket between hub and sleeve: electronics bay, connector and magnet.
    pub struct BracketParameters in "bracket" {
        /// From the bracket's underside up to the connector's channel.
        bracket_floor_mm: 0.8..=2.0 => [BatteryBracket, BatteryLid],
        /// From the connector's channel out to the bracket's side, each side.
        bracket_side_wall_mm: 1.0..=2.5 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Thickness of the base between the two uprights.
        bracket_base_mm: 2.0..=5.0 => [BatteryBracket],
        /// From the base's top up to the top of the uprights: room for the electronics; connector, magnet and tie hole may need more.
        bay_height_mm: 14.0..=45.0 => [BatteryBracket],
        /// From the top of the connector's channel up to the magnet's pocket.
        bracket_wall_mm: 1.2..=3.0 => [BatteryBracket, BatteryLid],
        /// From the top of the magnet's pocket up to the bottom of the tie hole.
        bracket_roof_mm: 1.2..=3.0 => [BatteryBracket],
        /// Diameter of the tie holes down into the uprights.
        tie_hole_diameter_mm: 2.5..=5.0 => [BatteryBracket],
        /// From the top of the uprights down to the bottom of the tie holes.
        tie_hole_depth_mm: 4.0..=10.0 => [BatteryBracket],
        /// Width of the slots through which the ties leave the uprights.
        tie_slot_width_mm: 2.0..=4.5 => [BatteryBracket],
        /// Height of those slots, from the bottom of the tie hole up.
        tie_slot_height_mm: 1.2..=3.0 => [BatteryBracket],
        /// Fillet between the base's top and the rear upright.
        bracket_fillet_mm: 0.5..=4.0 => [BatteryBracket],
        /// Diameter of the wire holes through the uprights.
        wire_hole_diameter_mm: 1.5..=4.0 => [BatteryBracket],
        /// Distance of the wire holes left to right, from middle to middle.
        wire_hole_pitch_across_mm: 4.5..=8.0 => [BatteryBracket],
        /// Distance of the rows of wire holes up and down, from middle to middle.
        wire_hole_pitch_up_mm: 4.0..=8.0 => [BatteryBracket],
        /// Width of the power connector's channel; the bought connector's and its room unless stated.
        connector_width_mm: 9.0..=20.0 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Height of the power connector's channel; the bought connector's and its room unless stated.
        connector_height_mm: 5.0..=10.0 => [BatteryBracket, BatteryLid],
        /// How much of the connector's two left corners is cut off, along both edges; they code its polarity.
        connector_chamfer_mm: 0.0..=3.0 => [BatteryBracket, BatteryLid],
        /// How much smaller than the channel the lid's hole for the connector's nose is, each side.
        connector_step_mm: 0.0..=1.5 => [BatteryLid],
        /// Length of each magnet, left to right; the bought magnet's unless stated.
        magnet_length_mm: 4.0..=20.0 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// Height of each magnet as it stands in its pocket; the bought magnet's width unless stated.
        magnet_width_mm: 3.0..=10.0 => [BatteryBracket, BatteryLid],
        /// Thickness of each magnet, front to rear: depth of the bracket's pocket.
        magnet_thickness_mm: 1.0..=5.0 => [BatteryBracket, BatteryLid],
        /// Length and height of the magnets' pockets minus the magnet's, both sides together.
        magnet_clearance_mm: 0.0..=0.4 => [BatteryBracket, BatteryLid],
        /// Least wall beside the magnets' pockets, and above the lid's.
        magnet_wall_mm: 1.0..=3.0 => [BatteryBracket, BatterySleeve, BatteryLid],
        /// From the bracket's magnet back to the lid's when the lid is closed.
        magnet_gap_mm: 0.1..=1.5 => [BatteryLid],
        /// From the hub's underside down to the top of the bracket's uprights.
        stack_z_offset_mm: 0.0..=0.6 => [],
    }
}

parameters! {
    /// The lid that stays on the battery: the cartridge's rim, connector and magnet.
    pub struct LidParameters in "lid" {
        /// From the rim plane to the front face of the lid block.
        lid_reach_mm: 8.0..=25.0 => [BatterySleeve, BatteryLid],
        /// From the bracket's rear face back to the lid's block when the lid is closed.
        lid_clearance_mm: 0.1..=0.6 => [BatterySleeve, BatteryLid],
        /// From the bracket's underside down to the lid's deck that slides under it.
        lid_slide_clearance_mm: 0.05..=0.4 => [BatteryLid],
        /// From the front to the rear face of the block that carries the connector.
        lid_block_depth_mm: 5.0..=15.0 => [BatteryLid],
        /// From the top of the connector's hole up to the top of the block.
        lid_block_above_mm: 1.0..=3.0 => [BatteryLid],
        /// Rounding, seen from above, of the block's rear corners; no more than the block stands out behind the shell.
        lid_corner_radius_mm: 1.0..=7.0 => [BatteryLid],
        /// Thickness of the cheeks beside the trough that the bracket slides in.
        lid_cheek_mm: 1.0..=3.0 => [BatteryLid],
        /// Radius of the arch under the block, where it stands out behind the shell.
        lid_arch_radius_mm: 1.0..=7.0 => [BatteryLid],
        /// From the bottom of the lid magnet's pocket to the rear of the tower.
        tower_back_mm: 1.2..=4.0 => [BatteryLid],
        /// Rounding of the tower's edges that hold the lid's magnet.
        tower_radius_mm: 0.5..=2.5 => [BatteryLid],
    }
}

parameters! {
    /// The two connectors between computer board and camera.
    pub struct CameraParameters in "camera" {
        /// Distance of the camera's holes left to right, from middle to middle.
        camera_pattern_across_mm: 10.0..=40.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Distance of the camera's holes up and down, from middle to middle.
        camera_pattern_up_mm: 8.0..=40.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Diameter of the connectors' holes, for the camera and for the board.
        camera_hole_diameter_mm: 1.5..=3.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// From the board's front holes forward to the face that carries the camera.
        camera_reach_mm: 14.0..=40.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// From the board's upper face up to the middle between the camera's holes.
        camera_lift_mm: 6.0..=30.0 => [CameraConnectorLeft, CameraConnectorRight],
        /// Height of the connectors' feet, from the board's upper face up.
        camera_foot_mm: 2.0..=8.0 => [CameraConnectorLeft, CameraConnectorRight],
    }
}

parameters! {
    /// The plate on the hub for receiver, buzzer, GPS and a camera for goggles, in place of the computer's carrier.
    pub struct AccessoryParameters in "accessories" {
        /// Thickness of the accessory plate.
        accessory_plate_thickness_mm: 1.2..=4.0 => [AccessoryPlate],
        /// From the hub's axis to the middle of the receiver, to the left, and of the buzzer, to the right.
        accessory_side_mm: 8.0..=16.0 => [AccessoryPlate],
        /// Length of the slots beside receiver and buzzer, for the straps of their ties.
        accessory_slot_mm: 2.0..=6.0 => [AccessoryPlate],
        /// From the hub's axis back to the mast's axis.
        mast_back_mm: 8.0..=30.0 => [AccessoryPlate],
        /// From the plate's upper face up to the face that carries the GPS.
        mast_height_mm: 10.0..=100.0 => [AccessoryPlate],
        /// Diameter of the mast between foot and shelf.
        mast_diameter_mm: 4.0..=12.0 => [AccessoryPlate],
        /// From the hub's axis forward to the axis of the camera's side screws.
        fpv_forward_mm: 24.0..=60.0 => [AccessoryPlate],
        /// From the plate's upper face up to the axis of the camera's side screws.
        fpv_above_mm: 6.0..=40.0 => [AccessoryPlate],
        /// How far the camera looks up.
        fpv_tilt_deg: 0.0..=60.0 => [],
        /// Thickness of the two cheeks beside the camera.
        fpv_cheek_mm: 1.5..=4.0 => [AccessoryPlate],
        /// Distance of the cheeks minus the camera's width, both sides together.
        fpv_clearance_mm: 0.0..=1.0 => [AccessoryPlate],
        /// Diameter of the cheeks' holes for the camera's side screws.
        fpv_hole_diameter_mm: 1.6..=3.2 => [AccessoryPlate],
    }
}

parameters! {
    /// What the frame must keep; `check` holds it against these.
    pub struct LimitParameters in "limits" {
        /// Largest width of the whole frame, without propellers.
        envelope_width_mm: 60.0..=600.0 => [],
        /// Largest depth of the whole frame, from front to rear, without propellers.
        envelope_depth_mm: 60.0..=600.0 => [],
        /// Largest height of the whole frame, without propellers.
        envelope_height_mm: 40.0..=400.0 => [],
        /// Largest mass of the whole frame, ready to take off.
        mass_budget_g: 20.0..=2000.0 => [],
        /// Least distance of a propeller's disc to everything but its own motor, mount and screws.
        propeller_clearance_mm: 0.0..=50.0 => [],
        /// Least distance between rods, and between rods and parts that do not hold them.
        part_clearance_mm: 0.0..=20.0 => [],
        /// Least distance between what hangs lowest at the centre and the ground.
        ground_clearance_mm: 0.0..=60.0 => [],
        /// Least length of a rod inside each socket.
        socket_engagement_mm: 0.0..=20.0 => [],
        /// Elongation at break over the largest strain allowed in a fold hinge.
        hinge_strain_factor: 1.0..=20.0 => [],
        /// Largest distance of the centre of mass from the motors' centre, in plan.
        centre_of_mass_offset_mm: 0.0..=60.0 => [],
    }
}
