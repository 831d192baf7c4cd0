//! No wall is thinner than what the nozzle can lay: two lines side by side.
//!
//! Measured on the mesh that is printed. From the middle of facets a ray goes inwards to the opposite facet; where that
//! one faces away from the first it is a wall, and the ray's length its thickness. Reported is the thickness that
//! [`AREA_MM2`] of the looked-at surface falls below, so that a sliver at a tangent edge is no wall. Facets are taken by
//! size, [`SAMPLES`] a part: a thin spot smaller than the smallest of these is not seen, nor is the edge of a wedge.

use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use super::finding::{Finding, Measure};
use super::scene::Scene;
use crate::assembly::Printed;
use crate::params::PartName;
use crate::solid::MeshSolid;

/// Facets looked at, a part.
const SAMPLES: usize = 500;
/// Surface that must be thin before a wall is, mm².
const AREA_MM2: f64 = 0.5;
/// Walls thicker than this many limits are not measured.
const REACH: f64 = 4.0;
/// Least cosine between the directions of opposite facets: 25°.
const OPPOSITE: f64 = 0.9;
/// Rays start this far inside, mm.
const INSIDE_MM: f64 = 1e-4;

/// The thinnest wall of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct ThinnestWall {
    /// The part.
    pub part: PartName,
    /// Thickness, mm; the reach of the measurement when every wall is thicker.
    pub thickness_mm: f64,
    /// Where, in print axes, mm.
    pub at_mm: [f64; 3],
    /// Least thickness, mm.
    pub limit_mm: f64,
}

impl ThinnestWall {
    fn of(part: &Printed, limit_mm: f64) -> Self {
        let reach = REACH * limit_mm;
        let mut found = Self { part: part.name, thickness_mm: reach, at_mm: [0.0; 3], limit_mm };
        let mut walls: Vec<(f64, f64, Point3<f64>)> = facets(part)
            .into_iter()
            .filter_map(|facet| facet.wall_mm(&part.printed, reach).map(|t| (t, facet.area_mm2, facet.middle)))
            .collect();
        walls.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut area = 0.0;
        for (thickness_mm, area_mm2, middle) in walls {
            area += area_mm2;
            if area >= AREA_MM2 {
                (found.thickness_mm, found.at_mm) = (thickness_mm, middle.into());
                break;
            }
        }
        found
    }

    fn finding(&self) -> Finding {
        let Self { part, thickness_mm, at_mm: [x, y, z], limit_mm } = self;
        let parameter = parameter(*part);
        let measure = Measure { rule: "thinnest_wall", value: *thickness_mm, limit: *limit_mm, unit: "mm", parameter };
        let message = if *thickness_mm < REACH * limit_mm {
            format!(
                "the thinnest wall of {part} is {thickness_mm:.2} mm (at {x:.1}, {y:.1}, {z:.1} as printed), the nozzle needs {limit_mm:.2} mm"
            )
        } else {
            format!("every wall of {part} is over {thickness_mm:.2} mm, the nozzle needs {limit_mm:.2} mm")
        };
        measure.at_least(part.slug().into(), message)
    }
}

/// The key of the part's thinnest wall.
fn parameter(part: PartName) -> &'static str {
    match part {
        PartName::TopCorner | PartName::BottomCorner => "corner.corner_wall_mm",
        PartName::Knee => "knee.knee_back_wall_mm",
        PartName::Fork => "fork.fork_wall_mm",
        PartName::MotorMount => "motor_mount.motor_skirt_wall_mm",
        PartName::HubJoint => "hub_joint.hub_joint_diameter_mm",
        PartName::Hub => "hub.hub_boss_wall_mm",
        PartName::PiCarrier => "pi_carrier.carrier_pad_radius_mm",
        PartName::BatteryBracket => "bracket.bracket_floor_mm",
        PartName::BatterySleeve => "sleeve.sleeve_side_wall_mm",
        PartName::BatteryLid => "lid.lid_cheek_mm",
        PartName::CameraConnectorLeft | PartName::CameraConnectorRight => "camera.camera_foot_mm",
    }
}

struct Facet {
    middle: Point3<f64>,
    normal: Vector3<f64>,
    area_mm2: f64,
}

impl Facet {
    fn wall_mm(&self, solid: &MeshSolid, reach_mm: f64) -> Option<f64> {
        let from = self.middle - self.normal * INSIDE_MM;
        let hit = solid.first_hit(from, self.middle - self.normal * reach_mm)?;
        (hit.normal.dot(&self.normal) < -OPPOSITE).then_some((hit.at - self.middle).norm())
    }
}

/// The largest facets of the printed mesh.
fn facets(part: &Printed) -> Vec<Facet> {
    let facet = |triangle: &[u32; 3]| {
        let [a, b, c] = part.mesh.corners(triangle);
        let cross = (b - a).cross(&(c - a));
        let middle = Point3::from((a.coords + b.coords + c.coords) / 3.0);
        Facet { middle, normal: cross.normalize(), area_mm2: 0.5 * cross.norm() }
    };
    let mut all: Vec<Facet> = part.mesh.triangles.iter().map(facet).collect();
    all.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    all.truncate(SAMPLES);
    all
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let printer = &scene.design.frame.printer;
    let limit_mm = printer.nozzle_mm * printer.min_wall_nozzles;
    scene.design.printed.par_iter().map(|part| ThinnestWall::of(part, limit_mm).finding()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn measured_the_real_frame_has_two_walls_too_thin() {
        let found = Planted::preset("cognifly-v8").found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| (f.subject.clone(), (100.0 * f.value).round())).collect();
        assert_eq!(broken, [("motor_mount".to_string(), 80.0), ("battery_bracket".to_string(), 85.0)]);
    }

    #[test]
    fn regress_the_default_frame_has_none() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
    }
}
