//! How a hinged mesh follows its hinges: which share of a fold each of its corners has.

use nalgebra::{Point3, Unit, Vector3};

use crate::frame::skeleton::CornerPivots;
use crate::params::Frame;
use crate::solid::{Bend, Mesh, OFF_EDGE_MM, OPENING};

/// Largest turn between two joints of a chain, degrees.
const JOINT_DEG: f64 = 12.0;

/// A corner this much above the notch's floor belongs to the notch's faces, mm.
const ABOVE_FLOOR_MM: f64 = 0.02;

/// A hinge with the chain of joints that bends it.
#[derive(Clone)]
pub(super) struct Hinge {
    pub name: &'static str,
    pub pivot: Point3<f64>,
    pub axis: Unit<Vector3<f64>>,
    pub assembled_deg: f64,
    pub joints: u32,
    bend: Bend,
    /// Half of the web's length that bends, mm.
    reach_mm: f64,
    /// Height of the notch's floor over the hinge axis, mm.
    floor_mm: f64,
}

/// The hinges of a part; a web bends over a socket's pivot distance to both sides.
pub(super) fn hinges(frame: &Frame, bends: &[Bend]) -> Vec<Hinge> {
    let pivots = CornerPivots::of(frame);
    let (reach_mm, floor_mm) = (pivots.strut_mm, frame.corner.corner_hinge_thickness_mm - pivots.radius_mm);
    let hinge = |(index, bend): (usize, &Bend)| {
        let (name, pivot, axis, angle) = match bend {
            Bend::Web { pivot, outward, towards, angle, .. } => {
                (["strut", "leg"][index.min(1)], *pivot, Unit::new_normalize(outward.cross(towards)), angle)
            }
            Bend::Necks { pivot, axis, angle, .. } => ("necks", *pivot, *axis, angle),
        };
        let joints = (angle.to_deg() / JOINT_DEG).ceil().max(2.0) as u32;
        Hinge { name, pivot, axis, assembled_deg: angle.to_deg(), joints, bend: *bend, reach_mm, floor_mm }
    };
    bends.iter().enumerate().map(hinge).collect()
}

impl Hinge {
    /// The mesh with corners at every joint of the chain.
    pub fn refined(&self, mesh: &Mesh) -> Mesh {
        let planes = self.planes();
        planes.iter().fold(mesh.clone(), |mesh, (point, normal)| mesh.cut_along(point, normal))
    }

    fn planes(&self) -> Vec<(Point3<f64>, Vector3<f64>)> {
        let steps = (0..=self.joints).map(|i| f64::from(i) / f64::from(self.joints));
        match self.bend {
            Bend::Web { pivot, outward, .. } => {
                steps.map(|t| (pivot + outward.into_inner() * (self.reach_mm * (2.0 * t - 1.0)), outward.into_inner())).collect()
            }
            Bend::Necks { pivot, axis, inner_mm, outer_mm, .. } => steps
                .flat_map(|t| [1.0, -1.0].map(|side| side * (inner_mm + (outer_mm - inner_mm) * t)))
                .map(|along| (pivot + axis.into_inner() * along, axis.into_inner()))
                .collect(),
        }
    }

    /// How much of the fold a point has, 0 to 1.
    pub fn share(&self, p: &Point3<f64>) -> f64 {
        match self.bend {
            Bend::Necks { pivot, axis, inner_mm, outer_mm, .. } => {
                let along = (p - pivot).dot(&axis).abs();
                ((outer_mm - along) / (outer_mm - inner_mm)).clamp(0.0, 1.0)
            }
            Bend::Web { pivot, outward, towards, half_width_mm, .. } => {
                let off = p - pivot;
                let (out, up) = (off.dot(&outward), off.dot(&towards));
                let aside = off.dot(&self.axis).abs();
                let within = aside <= half_width_mm + OFF_EDGE_MM + OPENING * out.max(0.0);
                let web = ((out + self.reach_mm) / (2.0 * self.reach_mm)).clamp(0.0, 1.0);
                match () {
                    () if !within => 0.0,
                    () if up > self.floor_mm + ABOVE_FLOOR_MM => f64::from(u8::from(out > 0.0)),
                    () => web,
                }
            }
        }
    }
}
