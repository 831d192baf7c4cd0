//! The fork: holds the outer ends of the arms and reaches with its bar through the knee's window.
//!
//! Frame: origin `reach_mm` ahead of the arm bores' bottoms, x along the arms and outward, y along the bar,
//! z normal. Printed flat.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::place::{SINK_MM, along_y, half_space, with_mirror};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::placement;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::Fork,
    feature: |frame, _, _| Fork::from_frame(frame).feature(),
    material: MaterialClass::Flexible,
    seat: Seat::Modules(placement::fork),
    fold: Fold::Moves,
    print_turn: Fork::print_turn,
    needed: always,
    walls: &[Wall::anywhere(&["fork.fork_wall_mm", "fork.fork_bar_height_mm", "fork.fork_finger_width_mm"])],
};

/// How far a leg's outer line stays behind the bar's front where they meet, mm.
const LEG_INSET_MM: f64 = 0.05;

/// The bar that passes through the knee.
#[derive(Clone, Debug, PartialEq)]
pub struct ForkBar {
    /// Size along the arms, mm.
    pub size_x_mm: f64,
    /// Height, and thickness of the whole fork, mm.
    pub size_z_mm: f64,
    /// Rounding of its four long edges, mm.
    pub round_mm: f64,
    /// Its centre, ahead of the frame's origin, mm.
    pub offset_mm: f64,
}

/// The fork.
#[derive(Clone, Debug, PartialEq)]
pub struct Fork {
    /// Bore of the sockets, mm.
    pub bore_mm: f64,
    /// Wall around the bores, mm.
    pub wall_mm: f64,
    /// Depth of the sockets, mm.
    pub depth_mm: f64,
    /// Distance of the two arm rods, mm.
    pub arm_pitch_mm: f64,
    /// From the bores' bottoms to the origin, mm.
    pub reach_mm: f64,
    /// The bar.
    pub bar: ForkBar,
    /// Free length of the bar between the legs, mm.
    pub cheek_gap_mm: f64,
    /// Depth of the gap behind the bar, mm.
    pub finger_length_mm: f64,
    /// Width of the fingers beside the gap, mm.
    pub finger_width_mm: f64,
    /// Angle between the legs and the arms.
    pub leg_slope: Angle,
}

impl Fork {
    /// The part for a frame.
    pub fn from_frame(frame: &Frame) -> Self {
        let fork = &frame.fork;
        Self {
            bore_mm: frame.grip_bore_mm(),
            wall_mm: fork.fork_wall_mm,
            depth_mm: fork.fork_socket_depth_mm,
            arm_pitch_mm: frame.hub_joint.arm_pitch_mm,
            reach_mm: fork.fork_reach_mm,
            bar: ForkBar {
                size_x_mm: fork.fork_bar_depth_mm,
                size_z_mm: fork.fork_bar_height_mm,
                round_mm: fork.fork_bar_round_mm,
                offset_mm: fork.fork_bar_offset_mm,
            },
            cheek_gap_mm: fork.fork_cheek_gap_mm,
            finger_length_mm: fork.fork_finger_length_mm,
            finger_width_mm: fork.fork_finger_width_mm,
            leg_slope: Angle::deg(fork.fork_leg_slope_deg),
        }
    }

    /// The turn that lays the part on the bed: it lies there as modelled.
    pub fn print_turn() -> UnitQuaternion<f64> {
        UnitQuaternion::identity()
    }

    /// The part as printed.
    pub fn feature(&self) -> Feature {
        let half_z = 0.5 * self.bar.size_z_mm;
        let slab = Feature::cuboid_between([-60.0, -60.0, -half_z], [60.0, 60.0, half_z]);
        let whole = Feature::union([with_mirror(self.side(), Vector3::y()), self.bar_body()]);
        Feature::intersection([whole, slab]).minus(self.bores())
    }

    /// Outer radius of the sockets, mm.
    pub fn radius_mm(&self) -> f64 {
        0.5 * self.bore_mm + self.wall_mm
    }

    /// Mouths of the bores, along the arms, mm.
    pub fn mouth_mm(&self) -> f64 {
        -self.reach_mm - self.depth_mm
    }

    fn bar_front_mm(&self) -> f64 {
        self.bar.offset_mm + 0.5 * self.bar.size_x_mm
    }

    fn bar_back_mm(&self) -> f64 {
        self.bar.offset_mm - 0.5 * self.bar.size_x_mm
    }

    /// Where the leg's axis is at a distance from the fork's middle; its outer line meets the bar's front at the gap.
    pub fn leg_axis_x_mm(&self, y_mm: f64) -> f64 {
        let off_bar = Angle::deg(90.0 - self.leg_slope.to_deg());
        let middle = self.bar_front_mm() - LEG_INSET_MM + 0.5 * self.cheek_gap_mm * off_bar.tan() - self.radius_mm() / off_bar.cos();
        middle - y_mm * off_bar.tan()
    }

    /// One socket, leg and finger, on the side of +y.
    fn side(&self) -> Feature {
        let (r, y, gap) = (self.radius_mm(), 0.5 * self.arm_pitch_mm, 0.5 * self.cheek_gap_mm);
        let elbow = Point3::new(self.leg_axis_x_mm(y), y, 0.0);
        let knuckle = Feature::sphere(r - SINK_MM).at(elbow.x, elbow.y, elbow.z);
        let body = Feature::union([
            Feature::cylinder_between(Point3::new(self.mouth_mm(), y, 0.0), elbow, r),
            Feature::cylinder_between(elbow, Point3::new(self.leg_axis_x_mm(0.0), 0.0, 0.0), r),
            knuckle,
            self.finger(),
        ]);
        let outside_gap = Feature::cuboid_between([self.mouth_mm() - 1.0, gap, -r - 1.0], [self.bar_front_mm() + r, 2.0 * y, r + 1.0]);
        Feature::intersection([body, outside_gap])
    }

    /// Starts inside the gap, which cuts it.
    fn finger(&self) -> Feature {
        let gap = 0.5 * self.cheek_gap_mm;
        let back = self.bar_back_mm() - self.finger_length_mm;
        along_y(self.rounded_zx(back, self.leg_axis_x_mm(gap) + 0.5 * self.radius_mm()), gap - 0.5, gap + self.finger_width_mm)
    }

    /// The bar, sunk into the legs; its front edge is bevelled there.
    fn bar_body(&self) -> Feature {
        let (gap, front) = (0.5 * self.cheek_gap_mm, self.bar_front_mm());
        let sunk = (0.4 * self.finger_width_mm).min(0.6);
        let long = along_y(self.rounded_zx(self.bar_back_mm(), front), -gap - sunk, gap + sunk);
        let bevel = |side: f64| half_space(Point3::new(front, side * gap, 0.0), Vector3::new(-1.0, -side, 0.0));
        Feature::intersection([long, bevel(1.0), bevel(-1.0)])
    }

    /// Rounded section between two x, a little higher than the fork: the fork's faces cut it.
    fn rounded_zx(&self, x0_mm: f64, x1_mm: f64) -> Contour {
        let size = [self.bar.size_z_mm + 2.0 * SINK_MM, x1_mm - x0_mm];
        Contour::rounded_rectangle([0.0, 0.5 * (x0_mm + x1_mm)], size, self.bar.round_mm)
    }

    fn bores(&self) -> Vec<Feature> {
        let y = 0.5 * self.arm_pitch_mm;
        let bore = |y: f64| {
            Feature::bore_between(Point3::new(-self.reach_mm, y, 0.0), Point3::new(self.mouth_mm() - 1.0, y, 0.0), 0.5 * self.bore_mm)
        };
        vec![bore(y), bore(-y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::measure::{ahead, assert_close, assert_like, hits, pin_mm, printed, v8};

    fn part() -> Fork {
        Fork::from_frame(&v8())
    }

    #[test]
    fn measured_fork_is_like_the_original() {
        let mesh = printed(&part().feature(), 0);
        assert_like(&mesh, [21.90, 31.13, 5.60], 1341.6, 0.03);
        for y in [12.665, -12.665] {
            assert_close("bore", pin_mm(&mesh, [-16.0, y, 0.0], Vector3::x()), 2.7);
            assert_close("bottom", ahead(&mesh, [-16.0, y, 0.0], Vector3::x()), 16.0 - 12.506);
            assert_close("mouth", ahead(&mesh, [-16.0, y, 2.1], -Vector3::x()), 4.006);
        }
        let bar = hits(&mesh, [-30.0, 0.1, 0.01], Vector3::x());
        assert_close("bar along the arms", bar[1] - bar[0], 3.2);
        assert_close("bar's centre", 0.5 * (bar[0] + bar[1]) - 30.0, 0.3);
        assert_close("gap", 2.0 * ahead(&mesh, [-4.0, 0.0, 0.01], Vector3::y()), 6.13);
        let finger = hits(&mesh, [-30.0, 4.0, 0.01], Vector3::x());
        assert_close("finger", bar[0] - finger[0], 4.5);
        assert_close("thickness", mesh.size_mm()[2], 5.6);
    }
}
