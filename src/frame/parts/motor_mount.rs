//! The motor mount: a plate with a skirt between two rings that slide on the arms.
//!
//! Frame: origin below the motor's axis between the arms' axes, x along the arms, y across, z up; the motor
//! stands on the plate's flat upper face. Printed with that face down.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::motor_outline::Outline;
use super::place::{along_y, half_space, turn, with_mirror};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::placement;
use crate::params::{Frame, PartName};
use crate::solid::Feature;
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::MotorMount,
    feature: |frame, _, _| MotorMount::from_frame(frame).feature(),
    material: MaterialClass::Flexible,
    seat: Seat::Modules(placement::motor_mount),
    fold: Fold::Moves,
    print_turn: MotorMount::print_turn,
    needed: always,
    walls: &[Wall::anywhere(&[
        "motor_mount.motor_skirt_wall_mm",
        "motor_mount.motor_plate_diameter_mm",
        "motor_mount.motor_shaft_hole_mm",
    ])],
};

/// A plate this much higher than the rings' tops gets sloping arms, mm.
const RAISED_MM: f64 = 0.5;

/// Screw pattern of the motor.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorHoles {
    /// How many screw holes there are.
    pub count: u32,
    /// Diameter of the screw holes, mm.
    pub screw_mm: f64,
    /// Diameter of the circle they lie on, mm.
    pub circle_mm: f64,
    /// Diameter of the hole for the shaft, mm.
    pub shaft_mm: f64,
}

/// The motor mount.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorMount {
    /// Distance of the two arm rods, mm.
    pub arm_pitch_mm: f64,
    /// Bore of the rings, mm; larger than the rod, so that they slide.
    pub bore_mm: f64,
    /// Outer diameter of the rings, mm.
    pub ring_diameter_mm: f64,
    /// Width of the rings along the rod, mm.
    pub ring_width_mm: f64,
    /// Narrowest width between plate and ring, mm.
    pub waist_mm: f64,
    /// Concave radius between plate and ring, mm.
    pub waist_round_mm: f64,
    /// Diameter of the plate, mm.
    pub plate_diameter_mm: f64,
    /// Thickness of the plate, mm.
    pub plate_mm: f64,
    /// Wall of the skirt, mm.
    pub skirt_wall_mm: f64,
    /// Height of the skirt under the plate, mm.
    pub skirt_depth_mm: f64,
    /// Rounding of the upper rim, mm.
    pub edge_round_mm: f64,
    /// Height of the face the motor stands on over the arms' axes, mm.
    pub top_mm: f64,
    /// Holes for the motor.
    pub holes: MotorHoles,
}

impl MotorMount {
    /// The part for a frame.
    pub fn from_frame(frame: &Frame) -> Self {
        let mount = &frame.motor_mount;
        Self {
            arm_pitch_mm: frame.hub_joint.arm_pitch_mm,
            bore_mm: frame.slide_bore_mm(),
            ring_diameter_mm: mount.motor_ring_diameter_mm,
            ring_width_mm: mount.motor_ring_width_mm,
            waist_mm: mount.motor_waist_mm,
            waist_round_mm: mount.motor_waist_round_mm,
            plate_diameter_mm: mount.motor_plate_diameter_mm,
            plate_mm: mount.motor_plate_thickness_mm,
            skirt_wall_mm: mount.motor_skirt_wall_mm,
            skirt_depth_mm: mount.motor_skirt_depth_mm,
            edge_round_mm: mount.motor_edge_round_mm,
            top_mm: mount.motor_ledge_mm + mount.motor_riser_mm,
            holes: MotorHoles {
                count: frame.bought.get("motor").map_or(4, |motor| motor.part.motor_holes()),
                screw_mm: mount.motor_hole_diameter_mm,
                circle_mm: mount.motor_hole_circle_mm,
                shaft_mm: mount.motor_shaft_hole_mm,
            },
        }
    }

    /// The part in its frame.
    pub fn feature(&self) -> Feature {
        let (ring_r, y) = (0.5 * self.ring_diameter_mm, 0.5 * self.arm_pitch_mm);
        let outer = self.outline(0.0);
        let low = self.skirt_bottom_mm().min(-ring_r) - 1.0;
        let reach = outer.plate_mm + 1.0;
        // Level arms end in the middle of the rings, whose tops they touch there.
        let half_y = if self.is_raised() { self.arm_root_mm()[1] } else { y };
        let side = Feature::cuboid_between([-reach, -half_y, self.skirt_bottom_mm()], [reach, half_y, self.top_mm + 1.0]);
        let solid = outer.rounded(self.edge_round_mm, [low, self.top_mm], y + ring_r);
        let cavity = self.outline(self.skirt_wall_mm).plain(self.skirt_bottom_mm() - 1.0, self.plate_bottom_mm());
        let shell = Feature::intersection([solid, side]).minus([cavity]);
        let mut bodies = vec![shell, with_mirror(self.ring(), Vector3::y())];
        if self.is_raised() {
            bodies.push(with_mirror(self.raised_arm(), Vector3::y()));
        }
        Feature::union(bodies).minus(self.all_holes())
    }

    /// The turn that lays the plate on the bed.
    pub fn print_turn() -> UnitQuaternion<f64> {
        turn(Vector3::x(), -Vector3::y(), -Vector3::z())
    }

    /// Whether the plate stands so high over the rings that the arms slope down to them.
    fn is_raised(&self) -> bool {
        self.top_mm > 0.5 * self.ring_diameter_mm + RAISED_MM
    }

    /// Axes of the motor's screws, x and y: four between the arms, three with the first outwards along the arms.
    pub fn screw_axes_mm(&self) -> Vec<[f64; 2]> {
        let (first, step) = (if self.holes.count == 4 { 45.0 } else { 0.0 }, 360.0 / f64::from(self.holes.count));
        let at = |hole: u32| {
            let (angle, r) = (Angle::deg(first + step * f64::from(hole)), 0.5 * self.holes.circle_mm);
            [r * angle.cos(), r * angle.sin()]
        };
        (0..self.holes.count).map(at).collect()
    }

    fn plate_bottom_mm(&self) -> f64 {
        self.top_mm - self.plate_mm
    }

    fn skirt_bottom_mm(&self) -> f64 {
        self.plate_bottom_mm() - self.skirt_depth_mm
    }

    fn outline(&self, inset_mm: f64) -> Outline {
        Outline {
            plate_mm: 0.5 * self.plate_diameter_mm - inset_mm,
            waist_mm: 0.5 * self.waist_mm.min(self.ring_width_mm) - inset_mm,
            waist_round_mm: self.waist_round_mm + inset_mm,
        }
    }

    fn ring(&self) -> Feature {
        let (half, y) = (0.5 * self.ring_width_mm, 0.5 * self.arm_pitch_mm);
        Feature::cylinder_between(Point3::new(-half, y, 0.0), Point3::new(half, y, 0.0), 0.5 * self.ring_diameter_mm)
    }

    /// Where a raised arm leaves the plate: from and to, mm from the middle.
    fn arm_root_mm(&self) -> [f64; 2] {
        [0.4 * self.plate_diameter_mm, 0.533 * self.plate_diameter_mm]
    }

    /// The arm of a raised mount: from the plate's rim down to the ring, its upper edges rounded.
    fn raised_arm(&self) -> Feature {
        let (y, ring_r) = (0.5 * self.arm_pitch_mm, 0.5 * self.ring_diameter_mm);
        let (top, bottom, half) = (self.top_mm, self.plate_bottom_mm(), 0.5 * self.ring_width_mm);
        let [root, out] = self.arm_root_mm();
        let waist = self.outline(0.0).waist_mm;
        let mut pieces = vec![self.ring(), self.prism(waist - 0.02, [bottom + 0.01, top - 0.005], [root - 0.2, out + 0.1])];
        if bottom > 0.9 * ring_r {
            pieces.push(self.prism(half - 0.02, [bottom - self.edge_round_mm - 0.1, bottom], [y - 0.05, y]));
        }
        let angle = Angle::deg(14.0); // where the arm's underside meets the ring
        let down = Vector3::new(0.0, y - ring_r * angle.cos() - root, ring_r * angle.sin() - bottom);
        let below = half_space(Point3::new(0.0, root, bottom), Vector3::new(0.0, down.z, -down.y));
        Feature::hull(pieces).minus([below])
    }

    /// A piece of arm along y whose upper edges are rounded.
    fn prism(&self, half_mm: f64, z_mm: [f64; 2], y_mm: [f64; 2]) -> Feature {
        let round = self.edge_round_mm.min(half_mm - 0.05).min(z_mm[1] - z_mm[0] - 0.01);
        along_y(super::motor_outline::arm_section(half_mm, round, z_mm), y_mm[0], y_mm[1])
    }

    fn all_holes(&self) -> Vec<Feature> {
        let (low, high) = (self.plate_bottom_mm() - 1.0, self.top_mm + 1.0);
        let drilled =
            |x: f64, y: f64, diameter: f64| Feature::bore_between(Point3::new(x, y, low), Point3::new(x, y, high), 0.5 * diameter);
        let mut holes: Vec<_> = self.screw_axes_mm().into_iter().map(|[x, y]| drilled(x, y, self.holes.screw_mm)).collect();
        if self.holes.shaft_mm > 0.0 {
            holes.push(drilled(0.0, 0.0, self.holes.shaft_mm));
        }
        let (y, reach) = (0.5 * self.arm_pitch_mm, self.plate_diameter_mm);
        for side in [y, -y] {
            holes.push(Feature::bore_between(Point3::new(-reach, side, 0.0), Point3::new(reach, side, 0.0), 0.5 * self.bore_mm));
        }
        holes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::measure::{ahead, assert_close, assert_like, hits, pin_mm, printed, v8};

    fn part(riser_mm: f64) -> MotorMount {
        let mut frame = v8();
        frame.motor_mount.motor_riser_mm = riser_mm;
        MotorMount::from_frame(&frame)
    }

    #[test]
    fn measured_motor_mount_is_like_the_original() {
        let mesh = printed(&part(0.0).feature(), 7);
        assert_like(&mesh, [15.0, 31.93, 6.6], 906.1, 0.03);
        for y in [12.665, -12.665] {
            assert_close("ring bore", pin_mm(&mesh, [0.5, y, 0.0], Vector3::x()), 3.2);
            let ring = hits(&mesh, [-9.0, y, 2.5], Vector3::x());
            assert_close("ring width", ring[1] - ring[0], 6.26);
        }
        let plate = hits(&mesh, [5.5, 0.1, -9.0], Vector3::z());
        assert_close("plate", plate[1] - plate[0], 2.5);
        assert_close("top", plate[1] - 9.0, 3.3);
        assert_close("skirt", ahead(&mesh, [7.1, 0.1, -9.0], Vector3::z()), 9.0 - 2.2);
        let side = hits(&mesh, [-9.0, 0.1, -1.0], Vector3::x());
        assert_close("skirt wall", side[1] - side[0], 0.8);
        for i in 0..4 {
            let angle = Angle::deg(45.0 + 90.0 * f64::from(i));
            assert_close("screw hole", pin_mm(&mesh, [4.5 * angle.cos(), 4.5 * angle.sin(), 2.0], Vector3::z()), 2.0);
        }
        assert_close("shaft hole", pin_mm(&mesh, [0.0, 0.0, 2.0], Vector3::z()), 4.1);
    }

    #[test]
    fn analytic_three_screws_have_their_holes() {
        let mut frame = v8();
        frame.bought.get_mut("motor").expect("a motor").part.hole_count = Some(3);
        frame.motor_mount.motor_hole_circle_mm = 10.0;
        let mount = MotorMount::from_frame(&frame);
        let mesh = printed(&mount.feature(), 6);
        assert_eq!(mount.screw_axes_mm().len(), 3);
        for deg in [0.0, 120.0, 240.0] {
            let angle = Angle::deg(deg);
            assert_close("screw hole", pin_mm(&mesh, [5.0 * angle.cos(), 5.0 * angle.sin(), 2.0], Vector3::z()), 2.0);
        }
        assert_eq!(hits(&mesh, [-5.0, 0.0, -9.0], Vector3::z()).len(), 2, "plate, and no fourth hole");
    }

    #[test]
    fn analytic_without_a_shaft_hole_the_plate_is_whole_in_the_middle() {
        let mut frame = v8();
        for (hole_mm, tunnels, faces) in [(4.1, 7, 0), (0.0, 6, 2)] {
            frame.motor_mount.motor_shaft_hole_mm = hole_mm;
            let mesh = printed(&MotorMount::from_frame(&frame).feature(), tunnels);
            assert_eq!(hits(&mesh, [0.1, 0.2, -9.0], Vector3::z()).len(), faces);
        }
    }

    #[test]
    fn measured_raised_mounts_are_like_the_originals() {
        assert_like(&printed(&part(5.0).feature(), 7), [15.0, 31.93, 11.6], 1110.0, 0.03);
        assert_like(&printed(&part(10.0).feature(), 7), [15.0, 31.93, 16.6], 1418.7, 0.10);
    }
}
