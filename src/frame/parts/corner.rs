//! What the top and the bottom corner share: sockets in the bed plane that meet in the ring's node.

use nalgebra::{Point3, Unit, Vector3};

use super::place::half_space;
use crate::frame::skeleton::CornerPivots;
use crate::params::Frame;
use crate::solid::{Bend, Feature};
use crate::units::Angle;

/// Gap that keeps the cage sockets off the plane in which the strut's web bends, mm.
const OFF_HINGE_MM: f64 = 0.005;

/// Sockets of a corner, printed flat: cage rods along +x and +y, strut along the diagonal away from them.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerSockets {
    /// Bore of every socket, mm; smaller than the rod, so that it grips.
    pub bore_mm: f64,
    /// Wall around the bore, mm.
    pub wall_mm: f64,
    /// Depth of every bore, mm.
    pub depth_mm: f64,
    /// From the node to the bottom of the cage and strut bores, mm.
    pub bottom_mm: f64,
    /// From the node to the axis about which the strut folds, mm: where the walls of strut and cage sockets meet.
    pub strut_pivot_mm: f64,
    /// Thickness of the web that bends, from the outer side inwards, mm.
    pub hinge_mm: f64,
    /// How far each face of the notch leans away from the normal of the bed; their sum is what the notch lets pass.
    pub notch_lean: Angle,
}

/// Direction of the strut as printed.
pub fn strut_direction() -> Vector3<f64> {
    Vector3::new(-1.0, -1.0, 0.0).normalize()
}

/// Swaps the two cage sockets.
pub fn swapped(feature: Feature) -> Feature {
    feature.mirrored(Vector3::new(1.0, -1.0, 0.0))
}

impl CornerSockets {
    /// Outer radius of the sockets, mm.
    pub fn radius_mm(&self) -> f64 {
        0.5 * self.bore_mm + self.wall_mm
    }

    /// From the node to the mouths of the cage and strut sockets, mm.
    pub fn mouth_mm(&self) -> f64 {
        self.bottom_mm + self.depth_mm
    }

    /// The cage socket along +x: cut at the mitre with the strut's wall, and clear of the strut's hinge.
    pub fn cage_x(&self) -> Feature {
        let (r, end) = (self.radius_mm(), self.mouth_mm());
        let mitre = Angle::deg(-67.5);
        let strut = strut_direction();
        Feature::intersection([
            Feature::cylinder_between(Point3::new(-r, 0.0, 0.0), Point3::new(end + 1.0, 0.0, 0.0), r),
            half_space(Point3::origin(), Vector3::new(-mitre.sin(), mitre.cos(), 0.0)),
            half_space(Point3::from(strut * (self.strut_pivot_mm - OFF_HINGE_MM)), -strut),
            half_space(Point3::new(end, 0.0, 0.0), -Vector3::x()),
        ])
    }

    /// Body of a socket that starts in the node.
    pub fn body(&self, direction: Vector3<f64>, mouth_mm: f64) -> Feature {
        Feature::cylinder_between(Point3::origin(), Point3::from(direction * mouth_mm), self.radius_mm())
    }

    /// A blind bore from beyond the mouth to `bottom_mm` from the node.
    pub fn bore(&self, direction: Vector3<f64>, bottom_mm: f64) -> Feature {
        let (bottom, beyond) = (direction * bottom_mm, direction * (bottom_mm + self.depth_mm + 1.0));
        Feature::bore_between(Point3::from(bottom), Point3::from(beyond), 0.5 * self.bore_mm)
    }

    /// The bores of the two cage sockets and of the strut's.
    pub fn bores(&self) -> Vec<Feature> {
        [Vector3::x(), Vector3::y(), strut_direction()].iter().map(|d| self.bore(*d, self.bottom_mm)).collect()
    }

    /// Height of the web's upper side, the notch's floor, mm.
    pub fn floor_mm(&self) -> f64 {
        self.hinge_mm - self.radius_mm()
    }

    /// What the notch leaves of the strut over the web.
    fn strut_kept(&self) -> Feature {
        let strut = strut_direction();
        let foot = Point3::from(strut * self.strut_pivot_mm + Vector3::z() * self.floor_mm());
        half_space(foot, strut - Vector3::z() * self.notch_lean.tan())
    }

    /// The body without everything over the web but what is kept.
    pub fn opened(&self, body: Feature, reach_mm: f64, mut kept: Vec<Feature>) -> Feature {
        kept.push(self.strut_kept());
        let over_web = Feature::cuboid_between([-reach_mm, -reach_mm, self.floor_mm()], [reach_mm, reach_mm, 2.0 * self.radius_mm()]);
        body.minus([over_web.minus(kept)])
    }

    /// Where the mitre of cage and strut meets the cage socket's outer wall, over the strut's pivot on the notch's floor.
    pub fn mitre_foot(&self) -> Point3<f64> {
        let r = self.radius_mm();
        Point3::new(r - self.strut_pivot_mm * std::f64::consts::SQRT_2, -r, self.floor_mm())
    }

    /// How the strut folds: up into the notch.
    pub fn strut_bend(&self, angle: Angle) -> Bend {
        let outward = Unit::new_normalize(strut_direction());
        Bend::Web {
            pivot: Point3::from(outward.into_inner() * self.strut_pivot_mm),
            outward,
            towards: Vector3::z_axis(),
            half_width_mm: self.radius_mm(),
            angle,
        }
    }

    /// The sockets for a frame.
    pub fn from_frame(frame: &Frame) -> Self {
        let corner = &frame.corner;
        Self {
            bore_mm: frame.grip_bore_mm(),
            wall_mm: corner.corner_wall_mm,
            depth_mm: corner.corner_socket_depth_mm,
            bottom_mm: corner.corner_node_to_bottom_mm,
            strut_pivot_mm: CornerPivots::of(frame).strut_mm,
            hinge_mm: corner.corner_hinge_thickness_mm,
            notch_lean: Angle::deg(corner.notch_half_angle_deg),
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::frame::parts::measure::{ahead, assert_close, hits, pin_mm};
    use crate::solid::Mesh;

    /// Bore, depth, wall and mouth of one socket.
    pub fn assert_socket(mesh: &Mesh, direction: Vector3<f64>, bottom_mm: f64) {
        let inside: [f64; 3] = (direction * (bottom_mm + 4.0)).into();
        assert_close("bore", pin_mm(mesh, inside, direction), 2.7);
        assert_close("depth to the bottom", ahead(mesh, inside, -direction), 4.0);
        let across = hits(mesh, inside, Vector3::z());
        assert_close("wall", across[1] - across[0], 1.55);
        let in_wall: [f64; 3] = (direction * (bottom_mm + 4.0) - Vector3::z() * 2.1).into();
        assert_close("mouth", ahead(mesh, in_wall, direction), 3.5);
    }

    /// Thickness of the web at a distance from the node.
    pub fn web_mm(mesh: &Mesh, direction: Vector3<f64>, distance_mm: f64) -> f64 {
        let below = direction * distance_mm - Vector3::z() * 9.0 + Vector3::new(0.003, 0.001, 0.0);
        let through = hits(mesh, below.into(), Vector3::z());
        through[1] - through[0]
    }
}
