//! What an edge can run along, and where two surfaces meet.

use nalgebra::{Isometry3, Point3, Unit, Vector3};

use super::surface::{Surface, across};
use super::touching::touching_tubes;

/// A curve between the two vertices of an edge, mm.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// Straight.
    Line,
    /// Along an ellipse, counter-clockwise about its axis; a circle when both radii are the same.
    Ellipse {
        /// Centre.
        centre: Point3<f64>,
        /// Normal of its plane.
        axis: Unit<Vector3<f64>>,
        /// Direction of the larger radius.
        major: Unit<Vector3<f64>>,
        /// Larger and smaller radius, mm.
        radii_mm: [f64; 2],
        /// How far it turns, rad; a full turn at most.
        sweep_rad: f64,
    },
    /// Cubic pieces (Hermite) through points, the edge's ends included, with a direction in each.
    Spline {
        /// The points, mm.
        points: Vec<Point3<f64>>,
        /// Unit tangents there.
        tangents: Vec<Unit<Vector3<f64>>>,
    },
}

/// Sine of the angle below which directions count as parallel.
const PARALLEL: f64 = 1e-9;

/// Sine of the least angle at which two surfaces may cross along a spline.
const LEAST_CROSSING: f64 = 0.02;

/// Longest piece of a spline, mm.
const PIECE_MM: f64 = 0.1;

impl Curve {
    /// Points from one end to the other, both included, mm. A spline has its pieces in each of its own.
    pub fn points(&self, from: &Point3<f64>, to: &Point3<f64>, pieces: u32) -> Vec<Point3<f64>> {
        let share = |i: u32| f64::from(i) / f64::from(pieces);
        match self {
            Self::Line => vec![*from, *to],
            Self::Ellipse { centre, axis, major, radii_mm: [a, b], sweep_rad } => {
                let minor = axis.cross(major);
                let arm = from - centre;
                let begin = libm::atan2(arm.dot(&minor) / b, arm.dot(major) / a);
                let at = |i: u32| {
                    let (sin, cos) = libm::sincos(begin + sweep_rad * share(i));
                    centre + major.into_inner() * (a * cos) + minor * (b * sin)
                };
                (0..=pieces).map(at).collect()
            }
            Self::Spline { points, tangents } => {
                let mut all = vec![points[0]];
                for i in 1..points.len() {
                    let (p, q) = (points[i - 1].coords, points[i].coords);
                    let reach = (q - p).norm();
                    let (u, v) = (tangents[i - 1].into_inner() * reach, tangents[i].into_inner() * reach);
                    all.extend((1..=4).map(|k| {
                        let t = f64::from(k) / 4.0;
                        let (t2, t3) = (t * t, t * t * t);
                        let ends = p * (2.0 * t3 - 3.0 * t2 + 1.0) + q * (3.0 * t2 - 2.0 * t3);
                        Point3::from(ends + u * (t3 - 2.0 * t2 + t) + v * (t3 - t2))
                    }));
                }
                all
            }
        }
    }

    /// The same moved rigidly.
    pub fn placed(&self, pose: &Isometry3<f64>) -> Self {
        let turned = |v: &Unit<Vector3<f64>>| Unit::new_normalize(pose * v.into_inner());
        match self {
            Self::Line => Self::Line,
            Self::Ellipse { centre, axis, major, radii_mm, sweep_rad } => Self::Ellipse {
                centre: pose * centre,
                axis: turned(axis),
                major: turned(major),
                radii_mm: *radii_mm,
                sweep_rad: *sweep_rad,
            },
            Self::Spline { points, tangents } => {
                Self::Spline { points: points.iter().map(|p| pose * p).collect(), tangents: tangents.iter().map(turned).collect() }
            }
        }
    }

    /// Where two surfaces meet near a chain of points whose ends lie on both; `None` where that is no single curve.
    pub(super) fn between(a: &Surface, b: &Surface, chain: &[Point3<f64>]) -> Option<Self> {
        match (a, b) {
            (Surface::Plane { normal, .. }, Surface::Plane { normal: other, .. }) => {
                (normal.cross(other).norm() > PARALLEL).then_some(Self::Line)
            }
            (Surface::Plane { .. }, Surface::Cylinder { .. }) => on_plane(a, b, chain),
            (Surface::Cylinder { .. }, Surface::Plane { .. }) => on_plane(b, a, chain),
            (
                Surface::Cylinder { point, axis, radius_mm },
                Surface::Cylinder { point: other_point, axis: other_axis, radius_mm: other_radius_mm },
            ) => {
                if axis.cross(other_axis).norm() < PARALLEL {
                    return Some(Self::Line);
                }
                let apart = axis.cross(other_axis).normalize().dot(&(other_point - point)).abs();
                if (radius_mm - other_radius_mm).abs() < 1e-9 && apart < 1e-9 { mitre(a, b, chain) } else { spline(a, b, chain) }
            }
            _ => match common_axis(a, b).or_else(|| touching_tubes(a, b)).or_else(|| touching_tubes(b, a)) {
                Some((point, axis)) => circle(&point, &axis, chain),
                None => spline(a, b, chain),
            },
        }
    }
}

/// The axis about which both surfaces are round, and a point on it. A plane is round about its normals, a sphere about all its diameters.
fn common_axis(a: &Surface, b: &Surface) -> Option<(Point3<f64>, Unit<Vector3<f64>>)> {
    let is_on = |p: &Point3<f64>, (point, axis): &(Point3<f64>, Unit<Vector3<f64>>)| across(axis, &(p - point)).norm() < PARALLEL;
    match (a, b) {
        (Surface::Plane { normal, .. }, Surface::Sphere { centre, .. })
        | (Surface::Sphere { centre, .. }, Surface::Plane { normal, .. }) => Some((*centre, *normal)),
        (Surface::Sphere { centre, .. }, Surface::Sphere { centre: other, .. }) => {
            Unit::try_new(other - centre, PARALLEL).map(|axis| (*centre, axis))
        }
        (Surface::Plane { normal, .. }, round) | (round, Surface::Plane { normal, .. }) => {
            round.axis().filter(|(_, axis)| axis.cross(normal).norm() < PARALLEL)
        }
        (Surface::Sphere { centre, .. }, round) | (round, Surface::Sphere { centre, .. }) => {
            round.axis().filter(|line| is_on(centre, line))
        }
        _ => a
            .axis()
            .zip(b.axis())
            .filter(|(line, (point, axis))| line.1.cross(axis).norm() < PARALLEL && is_on(point, line))
            .map(|(line, _)| line),
    }
}

/// The arc about an axis through the points of a chain.
fn circle(point: &Point3<f64>, axis: &Unit<Vector3<f64>>, chain: &[Point3<f64>]) -> Option<Curve> {
    let centre = point + axis.into_inner() * axis.dot(&(chain[0] - point));
    let arm = across(axis, &(chain[0] - centre));
    let major = Unit::try_new(arm, PARALLEL)?;
    Some(turned(centre, axis, major, [arm.norm(); 2], chain))
}

/// The arc of an ellipse about an axis from the first point of a chain to its last, on the chain's side.
fn turned(centre: Point3<f64>, axis: &Unit<Vector3<f64>>, major: Unit<Vector3<f64>>, radii_mm: [f64; 2], chain: &[Point3<f64>]) -> Curve {
    let [u, v] = [major.into_inner(), axis.cross(&major)];
    let angle = |q: &Point3<f64>| libm::atan2((q - centre).dot(&v) / radii_mm[1], (q - centre).dot(&u) / radii_mm[0]);
    let step = |pair: &[Point3<f64>]| {
        let turn = angle(&pair[1]) - angle(&pair[0]);
        turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round()
    };
    let sweep: f64 = chain.windows(2).map(step).sum();
    let axis = if sweep < 0.0 { -*axis } else { *axis };
    Curve::Ellipse { centre, axis, major, radii_mm, sweep_rad: sweep.abs().min(std::f64::consts::TAU) }
}

/// A plane through a cylinder.
fn on_plane(plane: &Surface, cylinder: &Surface, chain: &[Point3<f64>]) -> Option<Curve> {
    let (Surface::Plane { point: p, normal }, Surface::Cylinder { point, axis, radius_mm }) = (plane, cylinder) else { return None };
    let rise = normal.dot(axis);
    if rise.abs() < PARALLEL {
        return Some(Curve::Line);
    }
    let centre = point + axis.into_inner() * (normal.dot(&(p - point)) / rise);
    let lean = across(normal, &axis.into_inner());
    let (major, long) = match Unit::try_new(lean, PARALLEL) {
        Some(major) => (major, radius_mm / rise.abs()),
        // A circle begins where the edge begins.
        None => (Unit::new_normalize(across(normal, &(chain[0] - centre))), *radius_mm),
    };
    Some(turned(centre, normal, major, [long, *radius_mm], chain))
}

/// Two cylinders of one radius whose axes meet: ellipses in the planes between the axes.
fn mitre(a: &Surface, b: &Surface, chain: &[Point3<f64>]) -> Option<Curve> {
    let (Surface::Cylinder { point, axis, radius_mm }, Surface::Cylinder { point: other, axis: along, .. }) = (a, b) else { return None };
    let square = axis.cross(along);
    let t = (other - point).cross(along).dot(&square) / square.norm_squared();
    let meet = point + axis.into_inner() * t;
    let planes = [axis.into_inner() - along.into_inner(), axis.into_inner() + along.into_inner()];
    let planes = planes.map(|normal| Surface::Plane { point: meet, normal: Unit::new_normalize(normal) });
    let beside = |plane: &Surface| chain.iter().map(|p| plane.distance_mm(p).abs()).fold(0.0, f64::max);
    let plane = planes.iter().min_by(|p, q| beside(p).total_cmp(&beside(q)))?;
    if beside(plane) < 0.02 * radius_mm { on_plane(plane, a, chain) } else { None }
}

/// The point on all surfaces that is next to a point, by Newton's steps; where surfaces touch, as near as they let come.
pub(super) fn onto(surfaces: &[&Surface], near: &Point3<f64>) -> Option<Point3<f64>> {
    let mut p = *near;
    for _ in 0..30 {
        let rows: Vec<Vector3<f64>> = surfaces.iter().map(|surface| surface.normal_at(&p)).collect();
        let jacobian = nalgebra::DMatrix::from_fn(rows.len(), 3, |i, j| rows[i][j]);
        let off = nalgebra::DVector::from_iterator(rows.len(), surfaces.iter().map(|surface| surface.distance_mm(&p)));
        let step = jacobian.svd(true, true).solve(&off, 1e-4).ok()?;
        let step = Vector3::new(step[0], step[1], step[2]);
        p -= step;
        if step.norm() < 1e-12 {
            break;
        }
    }
    p.coords.iter().all(|value| value.is_finite()).then_some(p)
}

/// The curve in which two surfaces cross, through points on both.
fn spline(a: &Surface, b: &Surface, chain: &[Point3<f64>]) -> Option<Curve> {
    let mut points = vec![chain[0]];
    for pair in chain.windows(2) {
        let pieces = ((pair[1] - pair[0]).norm() / PIECE_MM).ceil().max(1.0) as u32;
        for i in 1..=pieces {
            let near = pair[0] + (pair[1] - pair[0]) * (f64::from(i) / f64::from(pieces));
            points.push(onto(&[a, b], &near)?);
        }
    }
    let last = points.len() - 1;
    points[last] = chain[chain.len() - 1];
    let crossing = |p: &Point3<f64>| a.normal_at(p).cross(&b.normal_at(p));
    // Piecewise steps that all but vanish say nothing about the curve, nor do points beside an end in which the surfaces touch.
    let mut kept = vec![points[0]];
    for p in &points[1..last] {
        let [before, after] = [kept[kept.len() - 1], points[last]].map(|q| (p - q).norm());
        if before > 0.02 && after > 0.02 && crossing(p).norm() > LEAST_CROSSING {
            kept.push(*p);
        }
    }
    kept.push(points[last]);
    let tangent = |i: usize| {
        let p = &kept[i];
        let along = kept[(i + 1).min(kept.len() - 1)] - kept[i.saturating_sub(1)];
        let cross = crossing(p);
        let is_end = i == 0 || i + 1 == kept.len();
        // In an end in which the surfaces touch their normals are the same; the next point tells the way.
        let cross = if is_end && cross.norm() < LEAST_CROSSING { across(&Unit::new_normalize(a.normal_at(p)), &along) } else { cross };
        Unit::try_new(if cross.dot(&along) < 0.0 { -cross } else { cross }, LEAST_CROSSING)
    };
    let tangents = (0..kept.len()).map(tangent).collect::<Option<Vec<_>>>()?;
    Some(Curve::Spline { points: kept, tangents })
}

/// Distance between a point and the straight piece between two others, mm.
pub(super) fn beside_mm(p: &Point3<f64>, from: &Point3<f64>, to: &Point3<f64>) -> f64 {
    let (arm, along) = (p - from, to - from);
    let t = if along.norm_squared() > 0.0 { (arm.dot(&along) / along.norm_squared()).clamp(0.0, 1.0) } else { 0.0 };
    (arm - along * t).norm()
}
