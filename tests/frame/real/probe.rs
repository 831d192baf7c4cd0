//! Probes: what a calliper, a pin or a protractor finds on a mesh, ours or a real one.

use flexframe::solid::{Mesh, MeshSolid};
use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use serde::Deserialize;

use super::rays::{fan, hits};

/// Rays around a bore.
const AROUND: u32 = 96;

/// A way to measure; positions and directions in the part's own axes, mm. Hits along a ray are counted from 0.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Probe {
    /// Diameter of the largest pin around a point of a bore's axis, mm.
    Pin { at: [f64; 3], axis: [f64; 3] },
    /// Distance between two passes of a ray through the surface, mm.
    Span { from: [f64; 3], along: [f64; 3], hits: [usize; 2] },
    /// Distance, along the ray, of a pass from a point (the part's origin), mm.
    Reach {
        from: [f64; 3],
        along: [f64; 3],
        #[serde(default)]
        hit: usize,
        #[serde(default)]
        zero: [f64; 3],
    },
    /// Distance between the middles of two parallel holes, mm.
    Pitch { of: [[f64; 3]; 2], axis: [f64; 3] },
    /// Distance of a hole's middle from where it should be, mm.
    Off { at: [f64; 3], axis: [f64; 3] },
    /// Radius of a rounding seen from near its middle: rays over a sweep from a first direction, the given pass of each, mm.
    Arc {
        at: [f64; 3],
        axis: [f64; 3],
        first: [f64; 3],
        sweep_deg: f64,
        #[serde(default)]
        hit: usize,
    },
    /// Angle between the surface's normal at a pass and a direction, degrees.
    Lean {
        from: [f64; 3],
        along: [f64; 3],
        #[serde(default)]
        hit: usize,
        against: [f64; 3],
    },
    /// Angle between a bore's axis, through its middles near two points, and a direction, degrees.
    Axis { near: [[f64; 3]; 2], against: [f64; 3] },
    /// Area of the cut through the part, mm².
    Section { at: [f64; 3], normal: [f64; 3] },
    /// Extent of the part, mm.
    Size { along: [f64; 3] },
}

impl Probe {
    /// The unit of what it finds.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Lean { .. } | Self::Axis { .. } => "°",
            Self::Section { .. } => "mm²",
            _ => "mm",
        }
    }

    /// What it finds; `None` when it does not meet the part.
    pub fn measure(&self, mesh: &Mesh) -> Option<f64> {
        match self {
            Self::Pin { at, axis } => {
                let passes = fan(unit(axis), None, 360.0, AROUND).into_iter().map(|d| Some(hits(mesh, point(at), d).first()?.distance));
                passes.collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::min).map(|radius| 2.0 * radius)
            }
            Self::Span { from, along, hits: [a, b] } => {
                let passes = hits(mesh, point(from), unit(along));
                Some((passes.get(*b)?.distance - passes.get(*a)?.distance).abs())
            }
            Self::Reach { from, along, hit, zero } => {
                let along = unit(along);
                let distance = hits(mesh, point(from), along).get(*hit)?.distance;
                Some((along.dot(&(point(from) - point(zero))) + distance).abs())
            }
            Self::Pitch { of: [a, b], axis } => Some((middle(mesh, b, axis)? - middle(mesh, a, axis)?).norm()),
            Self::Off { at, axis } => Some((middle(mesh, at, axis)? - point(at)).norm()),
            Self::Arc { at, axis, first, sweep_deg, hit } => {
                let directions = fan(unit(axis), Some(Vector3::from(*first)), *sweep_deg, AROUND / 4);
                Some(circle(mesh, point(at), unit(axis), &directions, *hit)?.1)
            }
            Self::Lean { from, along, hit, against } => {
                let normal = hits(mesh, point(from), unit(along)).get(*hit)?.normal;
                Some(angle_deg(&normal, against))
            }
            Self::Axis { near: [a, b], against } => {
                let along: Vector3<f64> = point(b) - point(a);
                let axis = along.into();
                Some(angle_deg(&(middle(mesh, b, &axis)? - middle(mesh, a, &axis)?), against))
            }
            Self::Section { at, normal } => section_mm2(mesh, point(at), unit(normal)),
            Self::Size { along } => {
                let along = unit(along);
                let heights = || mesh.vertices.iter().map(|v| along.dot(&Vector3::from(v.map(f64::from))));
                Some(heights().reduce(f64::max)? - heights().reduce(f64::min)?)
            }
        }
    }
}

fn point(p: &[f64; 3]) -> Point3<f64> {
    Point3::from(*p)
}

fn unit(v: &[f64; 3]) -> Unit<Vector3<f64>> {
    Unit::new_normalize(Vector3::from(*v))
}

fn angle_deg(a: &Vector3<f64>, b: &[f64; 3]) -> f64 {
    let b = Vector3::from(*b);
    libm::atan2(a.cross(&b).norm(), a.dot(&b)).to_degrees()
}

/// Middle of the hole around a point of its axis.
fn middle(mesh: &Mesh, at: &[f64; 3], axis: &[f64; 3]) -> Option<Point3<f64>> {
    let directions = fan(unit(axis), None, 360.0, AROUND);
    circle(mesh, point(at), unit(axis), &directions, 0).map(|(middle, _)| middle)
}

/// Circle through what rays from a point across an axis meet: middle and radius, least squares (I. Kåsa, 1976).
fn circle(
    mesh: &Mesh,
    at: Point3<f64>,
    axis: Unit<Vector3<f64>>,
    directions: &[Unit<Vector3<f64>>],
    hit: usize,
) -> Option<(Point3<f64>, f64)> {
    let u = directions.first()?.into_inner();
    let v = axis.cross(&u);
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for direction in directions {
        let p = direction.into_inner() * hits(mesh, at, *direction).get(hit)?.distance;
        let row = Vector3::new(u.dot(&p), v.dot(&p), 1.0);
        normal += row * row.transpose();
        right += row * p.norm_squared();
    }
    let found = normal.try_inverse()? * right;
    let (x, y) = (0.5 * found.x, 0.5 * found.y);
    Some((at + u * x + v * y, libm::sqrt(found.z + x * x + y * y)))
}

/// Area of the part's cut by a plane, mm².
fn section_mm2(mesh: &Mesh, at: Point3<f64>, normal: Unit<Vector3<f64>>) -> Option<f64> {
    let turn = UnitQuaternion::rotation_between(&normal, &Vector3::z())?;
    let laid =
        MeshSolid::from_mesh(mesh)?.placed(&(Isometry3::from_parts(Translation3::identity(), turn) * Translation3::from(-at.coords)));
    Some(laid.slice(0.0).area_mm2())
}
