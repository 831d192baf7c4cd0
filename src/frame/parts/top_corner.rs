//! The top corner: two cage rods and a strut that folds by more than a right angle.
//!
//! Frame: origin in the ring's node, rods' axes in z = 0, cage sockets along +x and +y, strut along the
//! diagonal away from them; folding turns the strut towards +z, into the notch. Printed as it lies.

use nalgebra::{Point2, Point3, UnitQuaternion, Vector2, Vector3};

use super::corner::{CornerSockets, strut_direction, swapped};
use super::place::{SINK_MM, along_x, half_space, plate};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::{placement, strut_fold_deg};
use crate::params::{Frame, PartName};
use crate::solid::{Bend, Contour, Feature, Segment};
use crate::units::Angle;

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::TopCorner,
    feature: |frame, closure, _| TopCorner::from_frame(frame, closure.strut_tilt).feature(),
    material: MaterialClass::Flexible,
    seat: Seat::Modules(placement::top_corner),
    fold: Fold::Bends(|frame, closure| TopCorner::from_frame(frame, closure.strut_tilt).bends()),
    print_turn: TopCorner::print_turn,
    needed: always,
    walls: &[Wall::anywhere(&["corner.corner_wall_mm", "corner.corner_hinge_thickness_mm"])],
};

/// The top corner.
#[derive(Clone, Debug, PartialEq)]
pub struct TopCorner {
    /// The sockets and the strut's hinge.
    pub sockets: CornerSockets,
    /// Fillet between the web and the cage sockets, mm.
    pub web_fillet_mm: f64,
    /// Angle of the assembled strut against the vertical.
    pub strut_tilt: Angle,
}

impl TopCorner {
    /// The part for a frame; `strut_tilt` is the assembled strut's angle against the vertical.
    pub fn from_frame(frame: &Frame, strut_tilt: Angle) -> Self {
        Self { sockets: CornerSockets::from_frame(frame), web_fillet_mm: frame.corner.corner_web_fillet_mm, strut_tilt }
    }

    /// The part as printed.
    pub fn feature(&self) -> Feature {
        let s = &self.sockets;
        let (r, end) = (s.radius_mm(), s.mouth_mm());
        let mut body = vec![s.cage_x(), swapped(s.cage_x()), s.body(strut_direction(), end), self.web()];
        if self.web_fillet_mm > 0.0 {
            // Before the notch is cut: its faces end the fillets.
            body.push(self.fillets());
        }
        s.opened(Feature::union(body), end + r, vec![self.cage_kept(), swapped(self.cage_kept())]).minus(s.bores())
    }

    /// The turn that lays the part on the bed: it lies there as modelled.
    pub fn print_turn() -> UnitQuaternion<f64> {
        UnitQuaternion::identity()
    }

    /// The strut folds by a right angle and its tilt against the vertical.
    pub fn bends(&self) -> Vec<Bend> {
        vec![self.sockets.strut_bend(Angle::deg(strut_fold_deg(self.strut_tilt.to_deg())))]
    }

    /// The plate that ties the cage sockets together; after folding it lies outside, on top.
    fn web(&self) -> Feature {
        let r = self.sockets.radius_mm();
        let (end, side) = (self.sockets.mouth_mm() - SINK_MM, r - SINK_MM);
        let outline = Contour::polygon(&[[0.0, 0.0], [end, 0.0], [end, side], [side, end], [0.0, end]]);
        plate(outline, SINK_MM - r, 0.0)
    }

    /// The notch's face on the cage socket along +x runs from the mitre to where the sockets' inner walls cross.
    fn cage_kept(&self) -> Feature {
        let r = self.sockets.radius_mm();
        let foot = self.sockets.mitre_foot();
        let along = (Point3::new(r, r, foot.z) - foot).normalize();
        let into_notch = Vector3::new(-along.y, along.x, 0.0);
        half_space(foot, -into_notch - Vector3::z() * self.sockets.notch_lean.tan())
    }

    /// They taper out along the web's edge before the sockets end: their own end would leave a sliver beside the socket.
    fn fillets(&self) -> Feature {
        let (r, end) = (self.sockets.radius_mm(), self.sockets.mouth_mm() - 2.0 * SINK_MM);
        let along = along_x(fillet_outline(r, self.web_fillet_mm), r, end);
        let edge = 0.5 * (end + fillet_touch_mm(r, self.web_fillet_mm) - SINK_MM);
        let inside = half_space(Point3::new(edge, edge, 0.0), strut_direction());
        Feature::intersection([Feature::union([along.clone(), swapped(along)]), inside])
    }
}

/// Distance from the socket's axis, along the web, at which a fillet touches the socket, mm.
fn fillet_touch_mm(socket_mm: f64, fillet_mm: f64) -> f64 {
    let apart = socket_mm + fillet_mm;
    libm::sqrt(apart * apart - fillet_mm * fillet_mm) * socket_mm / apart
}

/// Outline, in (distance from the socket's axis, height), of a fillet between a socket and the web at height 0.
fn fillet_outline(socket_mm: f64, fillet_mm: f64) -> Contour {
    let apart = socket_mm + fillet_mm;
    let foot = libm::sqrt(apart * apart - fillet_mm * fillet_mm);
    let centre = Point2::new(foot, fillet_mm - SINK_MM);
    let touch = centre - Vector2::new(foot, fillet_mm) * (fillet_mm / apart);
    let line = |x: f64, y: f64| Segment::Line { to: Point2::new(x, y) };
    let start = Point2::new(0.8 * socket_mm, -0.3 * socket_mm);
    Contour::Path {
        start,
        segments: vec![
            line(foot, -0.3 * socket_mm),
            line(foot, -SINK_MM),
            Segment::Arc { to: touch, centre, counter_clockwise: false },
            line(touch.x - 0.3, touch.y),
            Segment::Line { to: start },
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::parts::corner::tests::{assert_socket, web_mm};
    use crate::frame::parts::measure::{assert_close, assert_like, hits, printed, v8};
    use crate::solid::{MeshSolid, gate};

    fn part() -> TopCorner {
        TopCorner::from_frame(&v8(), Angle::deg(25.0))
    }

    #[test]
    fn measured_top_corner_is_like_the_original() {
        let mesh = printed(&part().feature(), 0);
        assert_like(&mesh, [23.39, 23.39, 5.80], 884.8, 0.03);
        for direction in [Vector3::x(), Vector3::y(), strut_direction()] {
            assert_socket(&mesh, direction, 5.0);
        }
        assert_close("web", web_mm(&mesh, strut_direction(), 1.2), 2.9);
    }

    /// The fillets' inner ends stood up in the notch's root as two horns.
    #[test]
    fn regress_nothing_stands_up_in_the_root_of_the_notch() {
        let mesh = printed(&part().feature(), 0);
        let top = |x: f64, y: f64| hits(&mesh, [x + 0.0013, y + 0.0007, -9.0], Vector3::z()).last().map_or(0.0, |above| above - 9.0);
        for (x, y, real_mm) in [(2.5, 3.0, 0.21), (2.75, 3.5, 0.62), (3.0, 3.0, 0.07), (3.25, 2.75, 0.38), (5.0, 3.25, 0.15)] {
            let [one, other] = [top(x, y), top(y, x)];
            assert!((one - real_mm).abs() < 0.03 && (other - real_mm).abs() < 0.05, "({x}, {y}): {one} {other}, real {real_mm}");
        }
    }

    #[test]
    fn analytic_a_thinner_hinge_thins_the_web() {
        let mut thin = part();
        thin.sockets.hinge_mm = 2.0;
        let mesh = printed(&thin.feature(), 0);
        assert_close("web", web_mm(&mesh, strut_direction(), 1.18), 2.0);
    }

    #[test]
    fn analytic_folding_turns_the_socket_and_keeps_one_body() {
        let part = part();
        let bend = part.bends()[0];
        let folded = bend.apply(&MeshSolid::build(&part.feature())).to_mesh();
        gate::pass(&folded).expect("the folded part is one closed body");
        let axis = bend.motion() * strut_direction();
        let expected = Vector3::new(libm::sin(0.436_332_313), 0.0, libm::cos(0.436_332_313));
        assert!((axis.z - expected.z).abs() < 1e-6, "{axis}");
        assert!((axis.x - expected.x * std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-6, "{axis}");
        let bottom = bend.motion() * Point3::from(strut_direction() * 9.0);
        assert_close("bore", crate::frame::parts::measure::pin_mm(&folded, bottom.coords.into(), axis), 2.7);
    }
}
