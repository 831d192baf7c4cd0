//! Printed parts: one file a part, each a plain struct and a pure function to features.

pub mod accessory_plate;
pub mod battery_bracket;
pub mod battery_lid;
pub mod battery_sleeve;
pub mod bottom_corner;
pub mod camera_connector;
mod catalogue;
pub mod corner;
pub mod fork;
#[cfg(test)]
pub(in crate::frame) mod gauges;
pub mod hub;
pub mod hub_joint;
pub mod knee;
mod knee_window;
#[cfg(test)]
mod measure;
pub mod motor_mount;
mod motor_outline;
pub(in crate::frame) mod outline;
pub mod pi_carrier;
pub mod place;
mod record;
pub mod top_corner;

pub use bottom_corner::BottomCorner;
pub use catalogue::{catalogue, record};
pub use fork::Fork;
pub use hub_joint::HubJoint;
pub use knee::Knee;
pub use motor_mount::MotorMount;
pub use record::{Fold, MaterialClass, PrintedPart, Seat, Wall, WallPlace};
pub use top_corner::TopCorner;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Frame;
    use crate::solid::{Bend, Feature, MeshSolid, gate};
    use crate::units::Angle;

    /// Flat and folded, each flexible part of a frame is one closed body.
    fn assert_sound(what: &str, frame: &Frame, tilt: Angle, leg: Angle) {
        let (top, bottom) = (TopCorner::from_frame(frame, tilt), BottomCorner::from_frame(frame, tilt));
        let hub = HubJoint::from_frame(frame);
        let parts: [(&str, Feature, Vec<Bend>, i64); 6] = [
            ("top corner", top.feature(), top.bends(), 0),
            ("bottom corner", bottom.feature(), bottom.bends(leg), 0),
            ("hub joint", hub.feature(), hub.bends(leg), 0),
            ("fork", Fork::from_frame(frame).feature(), Vec::new(), 0),
            ("knee", Knee::from_frame(frame, tilt).feature(), Vec::new(), 1),
            ("motor mount", MotorMount::from_frame(frame).feature(), Vec::new(), 7),
        ];
        for (part, feature, bends, tunnels) in parts {
            let flat = MeshSolid::build(&feature);
            let topology = gate::pass(&flat.to_mesh()).unwrap_or_else(|error| panic!("{what}, {part}: {error}"));
            assert_eq!(topology.euler, 2 - 2 * tunnels, "{what}, {part}");
            let flat_mm3 = flat.volume_mm3();
            let folded = bends.iter().fold(flat, |solid, bend| bend.apply(&solid));
            assert!(!folded.has_self_intersections(), "{what}, {part}, folded");
            let rest_mm3 = folded.volume_mm3() - folded.largest_body().volume_mm3();
            assert!(rest_mm3.abs() < 1e-6, "{what}, {part}, folded: {rest_mm3} mm³ apart");
            let change = folded.volume_mm3() / flat_mm3 - 1.0;
            assert!(change.abs() < 0.1, "{what}, {part}, folded: {:.1} % more", 100.0 * change);
        }
    }

    #[test]
    fn analytic_flexible_parts_of_every_preset_are_sound() {
        for name in crate::params::preset::names() {
            let frame = Frame::load(name).expect("a preset is valid").0;
            assert_sound(name, &frame, Angle::deg(25.0), Angle::deg(28.1));
        }
    }

    #[test]
    fn analytic_flexible_parts_are_sound_over_rods_and_pitches() {
        for (rod_mm, pitch_mm, hinge_off_mm, tilt, leg) in
            [(2.0, 22.0, -0.6, 15.0, 40.0), (2.5, 30.0, 0.3, 30.0, 15.0), (4.0, 30.0, -0.6, 30.0, 40.0)]
        {
            let mut frame = measure::v8();
            frame.rods.rod_diameter_mm = rod_mm;
            frame.hub_joint.arm_pitch_mm = pitch_mm;
            frame.hub_joint.hub_joint_diameter_mm += rod_mm - 3.0;
            frame.motor_mount.motor_ring_diameter_mm += rod_mm - 3.0;
            frame.motor_mount.motor_plate_diameter_mm = pitch_mm - 10.0;
            frame.motor_mount.motor_hole_circle_mm = 6.6;
            frame.corner.corner_hinge_thickness_mm += 0.5 * (rod_mm - 3.0) + hinge_off_mm;
            frame.corner.corner_node_to_bottom_mm += 0.5 * (rod_mm - 3.0);
            frame.fork.fork_cheek_gap_mm += rod_mm - 3.0;
            assert_sound(&format!("rods {rod_mm} mm, pitch {pitch_mm} mm"), &frame, Angle::deg(tilt), Angle::deg(leg));
        }
    }
}
