//! The bottom corner: two cage rods, a strut and a leg; strut and leg fold to the same side.
//!
//! Frame: as the top corner's, the leg along (+1, +1, 0). Printed as it lies.

use nalgebra::{Matrix2, Point3, Unit, UnitQuaternion, Vector2, Vector3};

use super::corner::{CornerSockets, strut_direction, swapped};
use super::place::{half_space, placed, plate, turn};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::{CornerPivots, placement, strut_fold_deg};
use crate::params::{Frame, PartName};
use crate::solid::{Bend, Contour, Feature};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::BottomCorner,
    feature: |frame, closure, _| BottomCorner::from_frame(frame, closure.strut_tilt).feature(),
    material: MaterialClass::Flexible,
    seat: Seat::Modules(placement::bottom_corner),
    fold: Fold::Bends(|frame, closure| BottomCorner::from_frame(frame, closure.strut_tilt).bends(closure.leg_tilt)),
    print_turn: BottomCorner::print_turn,
    needed: always,
    walls: &[Wall::anywhere(&["corner.corner_wall_mm", "corner.corner_hinge_thickness_mm"])],
};

/// How far the wedges that shape the pocket reach, mm.
const REACH_MM: f64 = 60.0;

/// The bottom corner.
#[derive(Clone, Debug, PartialEq)]
pub struct BottomCorner {
    /// The sockets and the strut's hinge.
    pub sockets: CornerSockets,
    /// From the node to the bottom of the leg's bore, mm.
    pub leg_bottom_mm: f64,
    /// From the node to the axis about which the leg folds, mm: where the walls of leg and cage sockets meet.
    pub leg_pivot_mm: f64,
    /// How far the faces beside the leg lean away from the normal of the bed.
    pub leg_lean: Angle,
    /// Rounding of the cage sockets' ends in the pocket, mm.
    pub pocket_round_mm: f64,
    /// Angle of the assembled strut against the vertical.
    pub strut_tilt: Angle,
}

impl BottomCorner {
    /// The part for a frame; `strut_tilt` is the assembled strut's angle against the vertical.
    pub fn from_frame(frame: &Frame, strut_tilt: Angle) -> Self {
        let (sockets, corner) = (CornerSockets::from_frame(frame), &frame.corner);
        Self {
            leg_bottom_mm: corner.corner_leg_bottom_mm,
            leg_pivot_mm: CornerPivots::of(frame).leg_mm,
            leg_lean: Angle::deg(corner.corner_leg_face_deg),
            pocket_round_mm: corner.corner_pocket_round_mm,
            strut_tilt,
            sockets,
        }
    }

    /// The turn that lays the part on the bed: it lies there as modelled.
    pub fn print_turn() -> UnitQuaternion<f64> {
        UnitQuaternion::identity()
    }

    /// Strut and leg fold to the same side: the strut by a right angle and its tilt, the leg by `leg` out of the ring's plane.
    pub fn bends(&self, leg: Angle) -> Vec<Bend> {
        let outward = Unit::new_normalize(-strut_direction());
        let leg = Bend::Web {
            pivot: Point3::from(outward.into_inner() * self.leg_pivot_mm),
            outward,
            towards: Vector3::z_axis(),
            half_width_mm: self.sockets.radius_mm(),
            angle: leg,
        };
        vec![self.sockets.strut_bend(Angle::deg(strut_fold_deg(self.strut_tilt.to_deg()))), leg]
    }

    /// The part as printed.
    pub fn feature(&self) -> Feature {
        let s = &self.sockets;
        let leg = -strut_direction();
        let mouth = self.leg_bottom_mm + s.depth_mm;
        let body = Feature::union([s.cage_x(), swapped(s.cage_x()), s.body(strut_direction(), s.mouth_mm()), s.body(leg, mouth)]);
        let kept = vec![self.leg_kept(), self.cage_kept(), swapped(self.cage_kept())];
        let body = s.opened(body, mouth + s.radius_mm(), kept);
        let mut bores = s.bores();
        bores.push(s.bore(leg, self.leg_bottom_mm));
        body.minus(bores)
    }

    fn leg_kept(&self) -> Feature {
        let leg = -strut_direction();
        let foot = Point3::from(leg * self.leg_pivot_mm + Vector3::z() * self.sockets.floor_mm());
        half_space(foot, leg - Vector3::z() * self.leg_lean.tan())
    }

    /// What the pocket leaves of the cage socket along +x: a wedge between its mitres with strut and leg,
    /// whose faces lean like the notch's and the leg's, its edge rounded.
    fn cage_kept(&self) -> Feature {
        let r = self.sockets.radius_mm();
        let floor = self.sockets.floor_mm();
        let foot = self.sockets.mitre_foot();
        let at_leg = Point3::new(self.leg_pivot_mm * std::f64::consts::SQRT_2 - r, r, floor);
        let (a, b) = (Angle::deg(-67.5), Angle::deg(22.5)); // the mitres are square to each other
        let leaning = |across: Angle, lean: Angle| Vector3::new(across.cos(), across.sin(), -lean.tan()).normalize();
        let (from_strut, from_leg) = (leaning(b, self.sockets.notch_lean), leaning(a, self.leg_lean));
        let edge = from_leg.cross(&from_strut).normalize();
        // Within each face, square to the edge and into the wedge.
        let across_strut = (from_leg - from_strut * from_leg.dot(&from_strut)).normalize();
        let across_leg = (from_strut - from_leg * from_strut.dot(&from_leg)).normalize();
        let (x, y) = (across_strut, edge.cross(&across_strut));
        let far = |v: Vector3<f64>| -> [f64; 2] { [REACH_MM * v.dot(&x), REACH_MM * v.dot(&y)] };
        let outline = Contour::rounded_polygon(&[
            ([0.0, 0.0], self.pocket_round_mm),
            (far(across_strut), 0.0),
            (far(across_strut + across_leg), 0.0),
            (far(across_leg), 0.0),
        ]);
        // Where the faces cross on the floor.
        let normals = Matrix2::new(from_strut.x, from_strut.y, from_leg.x, from_leg.y);
        let offsets = Vector2::new(from_strut.xy().dot(&foot.coords.xy()), from_leg.xy().dot(&at_leg.coords.xy()));
        let corner = normals.try_inverse().unwrap_or_else(Matrix2::identity) * offsets;
        placed(plate(outline, -REACH_MM, REACH_MM), turn(x, y, edge), Point3::new(corner.x, corner.y, floor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::corner::tests::{assert_socket, web_mm};
    use crate::frame::parts::measure::{assert_close, assert_like, pin_mm, printed, v8};
    use crate::solid::{MeshSolid, gate};

    fn part() -> BottomCorner {
        BottomCorner::from_frame(&v8(), Angle::deg(25.0))
    }

    #[test]
    fn measured_bottom_corner_is_like_the_original() {
        let mesh = printed(&part().feature(), 0);
        assert_like(&mesh, [26.01, 26.01, 5.80], 1003.6, 0.03);
        for direction in [Vector3::x(), Vector3::y(), strut_direction()] {
            assert_socket(&mesh, direction, 5.0);
        }
        assert_socket(&mesh, -strut_direction(), 11.0);
        assert_close("web at the strut", web_mm(&mesh, strut_direction(), 1.19), 2.9);
        assert_close("web at the leg", web_mm(&mesh, -strut_direction(), 6.98), 2.9);
    }

    #[test]
    fn analytic_both_folds_keep_one_body_and_open_bores() {
        let part = part();
        let flat = MeshSolid::build(&part.feature());
        let bends = part.bends(Angle::deg(28.1));
        let folded = bends.iter().fold(flat, |solid, bend| bend.apply(&solid)).to_mesh();
        gate::pass(&folded).expect("the folded part is one closed body");
        for (bend, direction, bottom) in [(bends[0], strut_direction(), 5.0), (bends[1], -strut_direction(), 11.0)] {
            let inside = bend.motion() * Point3::from(direction * (bottom + 4.0));
            assert_close("bore", pin_mm(&folded, inside.coords.into(), bend.motion() * direction), 2.7);
        }
    }
}
