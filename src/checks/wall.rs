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
use crate::figures::decimals;
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
        let Self { part, thickness_mm, at_mm, limit_mm } = self;
        let [x, y, z] = at_mm.map(|mm| decimals(mm, 1));
        let levers = levers(*part);
        let measure = Measure { rule: "thinnest_wall", value: *thickness_mm, limit: *limit_mm, unit: "mm", levers };
        let [thickness, needed] = measure.figures(2);
        let message = if *thickness_mm < REACH * limit_mm {
            format!("the thinnest wall of {part} is {thickness} mm (at {x}, {y}, {z} as printed), the nozzle needs {needed} mm")
        } else {
            format!("every wall of {part} is over {thickness} mm, the nozzle needs {needed} mm")
        };
        measure.at_least(part.slug().into(), message)
    }
}

/// The keys of the part's thinnest walls.
fn levers(part: PartName) -> &'static [&'static str] {
    match part {
        PartName::TopCorner | PartName::BottomCorner => &["corner.corner_wall_mm", "corner.corner_hinge_thickness_mm"],
        PartName::Knee => &["knee.knee_back_wall_mm", "knee.knee_side_wall_mm"],
        PartName::Fork => &["fork.fork_wall_mm", "fork.fork_bar_height_mm", "fork.fork_finger_width_mm"],
        PartName::MotorMount => {
            &["motor_mount.motor_skirt_wall_mm", "motor_mount.motor_ring_diameter_mm", "motor_mount.motor_plate_diameter_mm"]
        }
        PartName::HubJoint => &["hub_joint.hub_joint_diameter_mm", "hub_joint.neck_thickness_mm"],
        PartName::Hub => &["hub.hub_boss_wall_mm", "hub.hub_tie_wall_mm", "hub.hub_back_wall_mm"],
        PartName::PiCarrier => &["pi_carrier.carrier_pad_radius_mm", "hub.tie_ring_radius_mm", "pi_carrier.carrier_tie_hole_diameter_mm"],
        PartName::BatteryBracket => &["bracket.bracket_floor_mm", "bracket.bracket_side_wall_mm", "hub.tie_ring_radius_mm"],
        PartName::BatterySleeve => &["sleeve.sleeve_side_wall_mm", "sleeve.sleeve_top_wall_mm", "sleeve.tray_pad_radius_mm"],
        PartName::BatteryLid => &["sleeve.sleeve_side_wall_mm", "sleeve.sleeve_top_wall_mm", "lid.lid_cheek_mm"],
        PartName::CameraConnectorLeft | PartName::CameraConnectorRight => &["camera.camera_foot_mm", "camera.camera_hole_diameter_mm"],
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
    fn planted_a_wall_as_thick_as_the_nozzle_needs() {
        let skirt = |wall_mm: f64| {
            let found = Planted::frame(|frame| {
                frame.motor_mount.motor_skirt_wall_mm = wall_mm;
                (frame.printer.nozzle_mm, frame.printer.min_wall_nozzles) = (0.4, 2.0);
            });
            violated(&found.found(check))
        };
        assert_eq!(skirt(0.8), []);
        let thin = skirt(0.78);
        assert!(thin.len() == 1 && thin[0].message.contains("is 0.78 mm") && thin[0].message.contains("needs 0.80 mm"), "{thin:?}");
    }

    #[test]
    fn regress_the_lid_keeps_its_walls_around_a_wide_and_high_battery() {
        let found = Planted::frame(|frame| {
            let battery = &mut frame.battery;
            (battery.battery_length_mm, battery.battery_width_mm, battery.battery_height_mm) = (67.0, 37.0, 22.0);
        });
        assert_eq!(violated(&found.found(check)), []);
    }

    #[test]
    fn regress_the_default_frame_has_none() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
    }
}
