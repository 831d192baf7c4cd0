//! The two connectors between the computer's front holes and the camera board.
//!
//! Frame of reference: origin at the board hole's axis on the board's upper face, x right, y front, z up. Left and
//! right are as seen when facing the camera, as the v8 files are named: the left one sits at +x.

use nalgebra::{UnitQuaternion, Vector3};

use super::outline::{Corner, SINK_MM, along_x, along_y, arc, bore, bore_y, face, sharp, upright};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall};
use crate::frame::skeleton::centre::Centre;
use crate::params::{Frame, PartName};
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// The record of the left one.
pub static LEFT: PrintedPart = PrintedPart {
    name: PartName::CameraConnectorLeft,
    feature: |frame, _, _| left(frame),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::camera_left_pose),
    fold: Fold::Stands,
    print_turn: print_turn_left,
    needed: carries_a_camera,
    walls: &[Wall::anywhere(&["camera.camera_foot_mm", "camera.camera_hole_diameter_mm"])],
};

/// The record of the right one.
pub static RIGHT: PrintedPart = PrintedPart {
    name: PartName::CameraConnectorRight,
    feature: |frame, _, _| right(frame),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::camera_right_pose),
    fold: Fold::Stands,
    print_turn: print_turn_right,
    needed: carries_a_camera,
    walls: &[Wall::anywhere(&["camera.camera_foot_mm", "camera.camera_hole_diameter_mm"])],
};

fn carries_a_camera(frame: &Frame) -> bool {
    frame.bought.contains_key("camera")
}

/// Half the width of the foot; the foot reaches from that far behind the hole to twice that in front, mm.
const FOOT_HALF_MM: f64 = 2.0;
/// Wall of the posts around their holes, mm.
const POST_WALL_MM: f64 = 1.2;
/// Length of the posts, mm.
pub const POST_LENGTH_MM: f64 = 3.5;
/// How far the upright stays behind the posts' faces, mm.
const UPRIGHT_BACK_MM: f64 = 1.5;
/// Half the width of the upright, mm.
const UPRIGHT_HALF_MM: f64 = 2.0;
/// The arm's end: below and above the middle of the camera's holes, mm.
const ARM_END_MM: [f64; 2] = [-3.673, 0.327];
/// The block's share of the way between foot and upright.
const BLOCK_SHARE: f64 = 0.208;
/// Fillets of the upright, mm.
const FILLET_MM: f64 = 1.0;

/// The left connector, at +x.
pub fn left(frame: &Frame) -> Feature {
    Connector::new(frame).feature()
}

/// The right connector, at -x: the left one mirrored.
pub fn right(frame: &Frame) -> Feature {
    left(frame).mirrored(Vector3::x())
}

/// The left one is printed on its flat inner side.
pub fn print_turn_left() -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), Angle::deg(-90.0).to_rad())
}

/// The right one is printed on its flat inner side.
pub fn print_turn_right() -> UnitQuaternion<f64> {
    print_turn_left().inverse()
}

struct Connector<'a> {
    frame: &'a Frame,
    /// Camera hole outwards of the board hole; inner and outer side of the upright; outer side of the block.
    hole: f64,
    inner: f64,
    outer: f64,
    block: f64,
    /// Rear and front face of the upright, and where the arm meets the block.
    back: f64,
    face: f64,
    arm_end: f64,
    /// Lower and upper face of the block.
    z: [f64; 2],
}

impl<'a> Connector<'a> {
    fn new(frame: &'a Frame) -> Self {
        let c = &frame.camera;
        let hole = 0.5 * (c.camera_pattern_across_mm - frame.pi_carrier.pi_pattern_across_mm);
        let back = c.camera_reach_mm - POST_LENGTH_MM;
        let outer = hole + UPRIGHT_HALF_MM;
        Self {
            frame,
            hole,
            // The part is printed on this side, so the foot does not reach beyond it.
            inner: (hole - UPRIGHT_HALF_MM).min(-FOOT_HALF_MM),
            outer,
            block: (outer + 2.0).max(3.0),
            back,
            face: c.camera_reach_mm - UPRIGHT_BACK_MM,
            arm_end: back - (back - 2.0 * FOOT_HALF_MM) * BLOCK_SHARE,
            z: ARM_END_MM.map(|z| c.camera_lift_mm + z),
        }
    }

    fn feature(&self) -> Feature {
        let body = [self.foot(), self.arm(), self.block(), self.upright()].into_iter().chain(self.fillets()).chain(self.posts());
        Feature::union(body).minus(self.cuts())
    }

    fn foot(&self) -> Feature {
        let (w, front) = (FOOT_HALF_MM, 2.0 * FOOT_HALF_MM);
        let outline = face(&[([-w, -w], w), ([w, -w], w), sharp(w, front), sharp(-w, front)]);
        upright(outline, [0.0, self.frame.camera.camera_foot_mm])
    }

    fn arm(&self) -> Feature {
        let (w, front, e) = (FOOT_HALF_MM - SINK_MM, 2.0 * FOOT_HALF_MM, 2.0 * SINK_MM);
        let high = self.frame.camera.camera_foot_mm - SINK_MM;
        let root = Feature::cuboid_between([-w, front - e, SINK_MM], [w, front, high]);
        let low = [self.inner + SINK_MM, self.arm_end, self.z[0] + e];
        let end = Feature::cuboid_between(low, [self.block - e, self.arm_end + 0.1, self.z[1] - e]);
        Feature::hull([root, end])
    }

    /// Thickens the arm's end in front of the upright; its inner side is cut flat with the rest.
    fn block(&self) -> Feature {
        let low = [self.inner - 1.0, self.arm_end, self.z[0] + SINK_MM];
        Feature::cuboid_between(low, [self.block - SINK_MM, self.back + 0.5, self.z[1] - SINK_MM])
    }

    /// Heights of the camera's holes.
    fn holes_z(&self) -> [f64; 2] {
        [-0.5, 0.5].map(|side| self.frame.camera.camera_lift_mm + side * self.frame.camera.camera_pattern_up_mm)
    }

    fn upright(&self) -> Feature {
        let ([low, high], [z0, z1], inner) = (self.holes_z(), self.z, self.inner - 1.0);
        let (outer, block) = (self.outer, self.block + 1.0);
        let cross: [Corner; 8] = [
            sharp(inner, low),
            sharp(outer, low),
            ([outer, z0], FILLET_MM),
            sharp(block, z0),
            sharp(block, z1),
            ([outer, z1], FILLET_MM),
            sharp(outer, high),
            sharp(inner, high),
        ];
        let (left, right) = (inner - 1.0, self.block);
        let plan = face(&[sharp(left, self.back - 1.0), sharp(right, self.back - 1.0), ([right, self.face], 1.5), sharp(left, self.face)]);
        Feature::intersection([along_y(face(&cross), [self.back, self.face + 1.0]), upright(plan, [low - 1.0, high + 1.0])])
    }

    /// Between the block and the upright's rear face, above and below.
    fn fillets(&self) -> [Feature; 2] {
        let e = 2.0 * SINK_MM;
        let (deep, y) = (self.back + 0.3, self.back - FILLET_MM + e);
        let one = |z: f64, up: f64| {
            let top = z + up * (FILLET_MM - 0.03);
            let mut corners = vec![sharp(deep, z - up * 0.3), sharp(deep, top)];
            corners.extend(arc([y, top], FILLET_MM, 0.0, -90.0 * up));
            corners.push(sharp(y, z - up * 0.3));
            along_x(face(&corners), [self.inner - 1.0, self.outer - SINK_MM])
        };
        [one(self.z[1], 1.0), one(self.z[0], -1.0)]
    }

    fn posts(&self) -> [Feature; 2] {
        let radius = 0.5 * self.frame.camera.camera_hole_diameter_mm + POST_WALL_MM;
        self.holes_z()
            .map(|z| along_y(Profile::new(Contour::circle([self.hole, z], radius)), [self.back, self.frame.camera.camera_reach_mm]))
    }

    /// The holes, and the flat on which the part is printed.
    fn cuts(&self) -> Vec<Feature> {
        let (c, [low, high]) = (&self.frame.camera, self.holes_z());
        let flat =
            Feature::cuboid_between([self.inner - 9.0, self.arm_end - 1.0, low - 9.0], [self.inner, c.camera_reach_mm + 1.0, high + 9.0]);
        let mut cuts = vec![bore(0.0, 0.0, c.camera_hole_diameter_mm, [-1.0, c.camera_foot_mm + 1.0]), flat];
        cuts.extend([low, high].map(|z| bore_y(self.hole, z, c.camera_hole_diameter_mm, [self.back - 1.0, c.camera_reach_mm + 1.0])));
        cuts
    }
}

#[cfg(test)]
mod tests {
    use super::super::gauges::{Gauged, v8};
    use super::*;
    use crate::solid::MeshSolid;

    /// Whatever camera is on the board, the flat on which it is printed is the lowest place, and wide enough to stand on.
    #[test]
    fn analytic_connectors_stand_on_their_flat_for_any_camera() {
        for across_mm in [18.0, 21.0, 23.0, 24.0, 34.0, 40.0] {
            let (mut frame, _) = v8();
            frame.camera.camera_pattern_across_mm = across_mm;
            let mesh = MeshSolid::build(&left(&frame).placed(nalgebra::convert(print_turn_left()))).to_mesh();
            let low_mm = mesh.bounds_mm()[0][2];
            let lies = |triangle: &&[u32; 3]| mesh.corners(triangle).iter().all(|corner| corner.z < low_mm + 1e-3);
            let area_mm2: f64 = mesh
                .triangles
                .iter()
                .filter(lies)
                .map(|triangle| {
                    let [a, b, c] = mesh.corners(triangle);
                    0.5 * (b - a).cross(&(c - a)).norm()
                })
                .sum();
            // The narrowest has 44 mm², where it stood on its foot alone 20.
            assert!(area_mm2 > 40.0, "{across_mm}: {area_mm2}");
        }
    }

    #[test]
    fn measured_connectors_are_like_the_real_ones() {
        let (frame, _) = v8();
        for (feature, side) in [(left(&frame), 1.0), (right(&frame), -1.0)] {
            let connector = Gauged::new(&feature);
            connector.like_the_real_one([6.0, 21.55, 16.9], 510.1, 2.0, 3);
            connector.hole([0.0, 0.0, -1.0], [0.0, 0.0, 5.0], 2.0);
            for z in [1.923, 14.423] {
                connector.hole([-side, 15.0, z], [-side, 20.0, z], 2.0);
            }
        }
    }
}
