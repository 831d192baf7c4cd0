//! The hub joint: two arm sockets with plugs for the hub, and a leg socket on two necks that twist.
//!
//! Frame: origin between the arms' axes in the hub's face, x outward along the arms, y across, z normal.
//! Symmetric in z, so the leg may fold either way. Printed flat.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::place::{SINK_MM, plate, with_mirror};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::placement;
use crate::params::{Frame, PartName};
use crate::solid::{Bend, Contour, Feature, Profile};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::HubJoint,
    feature: |frame, _, _| HubJoint::from_frame(frame).feature(),
    material: MaterialClass::Flexible,
    seat: Seat::Modules(placement::hub_joint),
    fold: Fold::Bends(|frame, closure| HubJoint::from_frame(frame).bends(closure.leg_tilt)),
    print_turn: HubJoint::print_turn,
    needed: always,
    walls: &[Wall::anywhere(&["hub_joint.hub_joint_diameter_mm", "hub_joint.neck_thickness_mm"])],
};

/// Cutters reach this far past a face, mm.
const PAST_MM: f64 = 1.0;

/// The hub joint.
#[derive(Clone, Debug, PartialEq)]
pub struct HubJoint {
    /// Outer diameter of the sockets and the plugs, mm; also the part's thickness.
    pub outer_diameter_mm: f64,
    /// Bore of the sockets, mm.
    pub bore_mm: f64,
    /// Distance of the two arm rods, mm.
    pub arm_pitch_mm: f64,
    /// Depth of the arm sockets from the hub's face, mm.
    pub arm_depth_mm: f64,
    /// Length of the plugs, mm.
    pub plug_length_mm: f64,
    /// Depth of the leg socket, mm.
    pub leg_depth_mm: f64,
    /// From the hub's face to the leg socket's mouth, mm.
    pub leg_mouth_mm: f64,
    /// From the bottom of the leg's bore back to the axis about which the leg folds, mm.
    pub leg_pivot_mm: f64,
    /// Solid behind the leg's bore, mm.
    pub leg_root_mm: f64,
    /// Radial width of the arch that carries the leg, mm.
    pub arch_width_mm: f64,
    /// Thickness of a neck at its thinnest, mm.
    pub neck_mm: f64,
}

/// The arch: a ring around a point on the leg's axis.
pub struct Arch {
    /// Its middle, ahead of the hub's face, mm.
    pub centre_mm: f64,
    /// Inner radius, mm.
    pub inner_mm: f64,
    /// Outer radius, mm.
    pub outer_mm: f64,
}

impl HubJoint {
    /// The part for a frame.
    pub fn from_frame(frame: &Frame) -> Self {
        let joint = &frame.hub_joint;
        Self {
            outer_diameter_mm: joint.hub_joint_diameter_mm,
            bore_mm: frame.slide_bore_mm(),
            arm_pitch_mm: joint.arm_pitch_mm,
            arm_depth_mm: joint.hub_arm_socket_depth_mm,
            plug_length_mm: joint.plug_length_mm,
            leg_depth_mm: joint.hub_leg_socket_depth_mm,
            leg_mouth_mm: joint.hub_leg_mouth_mm,
            leg_pivot_mm: joint.hub_leg_pivot_mm,
            leg_root_mm: joint.hub_leg_root_mm,
            arch_width_mm: joint.arch_width_mm,
            neck_mm: joint.neck_thickness_mm,
        }
    }

    /// The turn that lays the part on the bed: it lies there as modelled.
    pub fn print_turn() -> UnitQuaternion<f64> {
        UnitQuaternion::identity()
    }

    /// The necks, between the leg's root and the arms, twist until the leg points down by `leg`.
    pub fn bends(&self, leg: Angle) -> Vec<Bend> {
        vec![Bend::Necks {
            pivot: Point3::new(self.leg_bottom_mm() - self.leg_pivot_mm, 0.0, 0.0),
            axis: Vector3::y_axis(),
            inner_mm: self.radius_mm(),
            outer_mm: self.cheek_side_mm(),
            angle: leg,
        }]
    }

    /// The part as printed.
    pub fn feature(&self) -> Feature {
        let r = self.radius_mm();
        let arch = self.arch();
        let y = 0.5 * self.arm_pitch_mm;
        let arm = Feature::cylinder_between(Point3::new(-self.plug_length_mm, y, 0.0), Point3::new(self.arm_depth_mm, y, 0.0), r);
        // Behind the bore, and inside the root, which ends at the arch's outer circle.
        let start = (0.5 * (self.leg_bottom_mm() + self.leg_back_mm())).min(arch.centre_mm + arch.outer_mm - PAST_MM);
        let leg = Feature::cylinder_between(Point3::new(start, 0.0, 0.0), Point3::new(self.leg_mouth_mm, 0.0, 0.0), r);
        let body = Feature::union([
            with_mirror(arm, Vector3::y()),
            with_mirror(self.cheek(&arch), Vector3::y()),
            self.arch_body(&arch),
            self.root(&arch),
            leg,
        ]);
        let mut cutters = self.scallops(&arch);
        cutters.extend(self.bores(&arch));
        body.minus(cutters)
    }

    /// Outer radius of sockets and plugs, mm.
    pub fn radius_mm(&self) -> f64 {
        0.5 * self.outer_diameter_mm
    }

    /// Distance of the arm sockets' inner walls from the leg's axis, mm.
    pub fn inner_wall_mm(&self) -> f64 {
        0.5 * self.arm_pitch_mm - self.radius_mm()
    }

    /// Distance of the cheeks' inner sides from the leg's axis, where the necks begin, mm: a little before the sockets' walls.
    fn cheek_side_mm(&self) -> f64 {
        self.inner_wall_mm() - 2.0 * SINK_MM
    }

    /// Bottom of the leg's bore, ahead of the hub's face, mm.
    pub fn leg_bottom_mm(&self) -> f64 {
        self.leg_mouth_mm - self.leg_depth_mm
    }

    fn leg_back_mm(&self) -> f64 {
        self.leg_bottom_mm() - self.leg_root_mm
    }

    /// Its inner circle runs through the back edge of the leg's root and through the arms' inner walls at the hub's face.
    pub fn arch(&self) -> Arch {
        let (back, r, wall) = (self.leg_back_mm(), self.radius_mm(), self.inner_wall_mm());
        let centre_mm = (back * back + r * r - wall * wall) / (2.0 * back);
        let inner_mm = libm::hypot(centre_mm, wall);
        Arch { centre_mm, inner_mm, outer_mm: inner_mm + self.arch_width_mm }
    }

    fn arch_body(&self, arch: &Arch) -> Feature {
        let (r, wall) = (self.radius_mm(), self.inner_wall_mm());
        let centre = [arch.centre_mm, 0.0];
        let ring = Profile::new(Contour::circle(centre, arch.outer_mm)).with_hole(Contour::circle(centre, arch.inner_mm));
        let ring = Feature::extrude(ring, 2.0 * r).at(0.0, 0.0, -r);
        let end = wall + 0.1 * r; // inside the cheeks
        let between_arms = Feature::cuboid_between([2.0 * SINK_MM, -end, -r - PAST_MM], [2.0 * arch.outer_mm, end, r + PAST_MM]);
        Feature::intersection([ring, between_arms])
    }

    /// How far ahead of the hub's face the cheeks reach, mm: as far as the arch's outer circle where it meets the sockets' walls.
    fn cheek_front_mm(&self, arch: &Arch) -> f64 {
        let wall = self.inner_wall_mm();
        arch.centre_mm + libm::sqrt(arch.outer_mm * arch.outer_mm - wall * wall)
    }

    /// Block that carries the arch's end into an arm socket. Its top and underside are the arch's and end just before they touch the socket: a
    /// hundredth lower they would cross it in slivers.
    fn cheek(&self, arch: &Arch) -> Feature {
        let r = self.radius_mm();
        Feature::cuboid_between([0.0, self.cheek_side_mm(), -r], [self.cheek_front_mm(arch), 0.5 * self.arm_pitch_mm - SINK_MM, r])
    }

    /// Block behind the leg socket, ended by the arch's outer circle.
    fn root(&self, arch: &Arch) -> Feature {
        let r = self.radius_mm();
        let front = arch.centre_mm + arch.outer_mm + PAST_MM;
        let disc = plate(Contour::circle([arch.centre_mm, 0.0], arch.outer_mm - SINK_MM), -r - PAST_MM, r + PAST_MM);
        let half = r - 0.5 * SINK_MM;
        Feature::intersection([Feature::cuboid_between([self.leg_back_mm(), -half, -half], [front, half, half]), disc])
    }

    /// Grooves along x, above and below, that leave the necks: each spans from the leg's root to the arm's wall.
    fn scallops(&self, arch: &Arch) -> Vec<Feature> {
        let (r, wall) = (self.radius_mm(), self.inner_wall_mm());
        let (half_width, depth) = (0.5 * (wall - r), r - 0.5 * self.neck_mm);
        let radius = (half_width * half_width + depth * depth) / (2.0 * depth);
        let (y, z) = (0.5 * (wall + r), 0.5 * self.neck_mm + radius);
        let reach = arch.centre_mm + arch.outer_mm + PAST_MM;
        let groove = Feature::cylinder_between(Point3::new(-PAST_MM, y, z), Point3::new(reach, y, z), radius);
        let both = [groove.clone(), groove.mirrored(Vector3::z())];
        both.iter().flat_map(|g| [g.clone(), g.clone().mirrored(Vector3::y())]).collect()
    }

    /// The bores of arms and leg. A wide arch, or one that is carried far out, reaches beyond the arms' sockets: the rods pass through it.
    fn bores(&self, arch: &Arch) -> Vec<Feature> {
        let (y, radius) = (0.5 * self.arm_pitch_mm, 0.5 * self.bore_mm);
        let out = self.arm_depth_mm.max(self.cheek_front_mm(arch));
        let from_to = |x0: f64, x1: f64, y: f64| Feature::bore_between(Point3::new(x0, y, 0.0), Point3::new(x1 + PAST_MM, y, 0.0), radius);
        vec![from_to(0.0, out, y), from_to(0.0, out, -y), from_to(self.leg_bottom_mm(), self.leg_mouth_mm, 0.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::measure::{ahead, assert_close, assert_like, hits, pin_mm, printed, v8};
    use crate::solid::{MeshSolid, gate};

    fn part() -> HubJoint {
        HubJoint::from_frame(&v8())
    }

    #[test]
    fn measured_hub_joint_is_like_the_original() {
        let mesh = printed(&part().feature(), 0);
        assert_like(&mesh, [32.13, 6.80, 30.38], 2098.1, 0.03);
        for y in [12.665, -12.665] {
            assert_close("arm bore", pin_mm(&mesh, [5.0, y, 0.0], Vector3::x()), 3.2);
            assert_close("arm bottom", ahead(&mesh, [5.0, y, 0.0], -Vector3::x()), 5.0);
            assert_close("arm mouth", ahead(&mesh, [5.0, y, 2.5], Vector3::x()), 4.5);
            assert_close("plug", ahead(&mesh, [-4.0, y, 0.0], -Vector3::x()), 5.0);
            let plug = hits(&mesh, [-4.0, y, -9.0], Vector3::z());
            assert_close("plug diameter", plug[1] - plug[0], 6.8);
            let neck = hits(&mesh, [7.8, 0.5 * y, -9.0], Vector3::z());
            assert_close("neck", neck[1] - neck[0], 2.8);
        }
        assert_close("leg bore", pin_mm(&mesh, [17.0, 0.0, 0.0], Vector3::x()), 3.2);
        assert_close("leg bottom", ahead(&mesh, [17.0, 0.0, 0.0], -Vector3::x()), 3.12);
        assert_close("leg mouth", ahead(&mesh, [17.0, 0.0, 2.5], Vector3::x()), 4.38);
    }

    #[test]
    fn analytic_the_necks_twist_and_the_rest_stays_rigid() {
        let part = part();
        let bend = part.bends(Angle::deg(28.1))[0];
        let flat = MeshSolid::build(&part.feature());
        let folded = bend.apply(&flat);
        let mesh = folded.to_mesh();
        gate::pass(&mesh).expect("the folded part is one closed body");
        let axis = bend.motion() * Vector3::x();
        assert!(axis.z < -0.4, "the leg points down: {axis}");
        let inside = bend.motion() * Point3::new(17.0, 0.0, 0.0);
        assert_close("leg bore", pin_mm(&mesh, inside.coords.into(), axis), 3.2);
        assert_close("arm bore", pin_mm(&mesh, [5.0, 12.665, 0.0], Vector3::x()), 3.2);
        assert!((folded.volume_mm3() / flat.volume_mm3() - 1.0).abs() < 0.01);
    }
}
