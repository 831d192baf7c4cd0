//! A curve divided at a point of it.

use nalgebra::{Point3, Unit, Vector3};

use super::curve::Curve;

/// Points of a spline nearer than this to where it is divided are left out, mm.
const NEAR_MM: f64 = 1e-3;

impl Curve {
    /// The point after a share of an arc or a spline, mm; none of a straight line, which does not know its end.
    pub(super) fn at(&self, from: &Point3<f64>, share: f64) -> Option<Point3<f64>> {
        match self {
            Self::Line => None,
            Self::Ellipse { .. } => self.swept(0.0, share).points(from, from, 1).pop(),
            Self::Spline { points, tangents } => Some(on_spline(points, tangents, share).0),
        }
    }

    /// Both pieces of an arc or a spline, the first of which is a share of it, and the point between them, mm.
    pub(super) fn divided(&self, from: &Point3<f64>, share: f64) -> Option<(Point3<f64>, [Self; 2])> {
        let at = self.at(from, share)?;
        let pieces = match self {
            Self::Spline { points, tangents } => {
                let (_, tangent, piece) = on_spline(points, tangents, share);
                let far = |i: &usize| (points[*i] - at).norm() > NEAR_MM;
                let before: Vec<usize> = (0..=piece).filter(|i| *i == 0 || far(i)).collect();
                let behind: Vec<usize> = (piece + 1..points.len()).filter(|i| *i + 1 == points.len() || far(i)).collect();
                let of = |which: &[usize]| -> (Vec<Point3<f64>>, Vec<Unit<Vector3<f64>>>) {
                    which.iter().map(|i| (points[*i], tangents[*i])).unzip()
                };
                let ((mut points, mut tangents), (later, ways)) = (of(&before), of(&behind));
                points.push(at);
                tangents.push(tangent);
                let second = Self::Spline {
                    points: std::iter::once(at).chain(later).collect(),
                    tangents: std::iter::once(tangent).chain(ways).collect(),
                };
                [Self::Spline { points, tangents }, second]
            }
            _ => [self.swept(0.0, share), self.swept(share, 1.0)],
        };
        Some((at, pieces))
    }

    /// A closed arc or spline that begins after a share of it, and the point where it then begins, mm.
    pub(super) fn begun_at(&self, from: &Point3<f64>, share: f64) -> Option<(Point3<f64>, Self)> {
        let (at, pieces) = self.divided(from, share)?;
        let curve = match pieces {
            [Self::Spline { points: first, tangents: ways }, Self::Spline { mut points, mut tangents }] => {
                points.extend(&first[1..]);
                tangents.extend(&ways[1..]);
                Self::Spline { points, tangents }
            }
            _ => self.beginning(&at),
        };
        Some((at, curve))
    }

    /// From one share of an ellipse to another.
    fn swept(&self, from: f64, to: f64) -> Self {
        match self {
            Self::Ellipse { centre, axis, major, radii_mm, sweep_rad } => {
                let sweep_rad = sweep_rad * (to - from);
                Self::Ellipse { centre: *centre, axis: *axis, major: *major, radii_mm: *radii_mm, sweep_rad }
            }
            _ => self.clone(),
        }
    }

    /// A circle begins where its edge begins.
    fn beginning(&self, at: &Point3<f64>) -> Self {
        match self {
            Self::Ellipse { centre, axis, radii_mm: [a, b], sweep_rad, .. } if a == b => Self::Ellipse {
                centre: *centre,
                axis: *axis,
                major: Unit::new_normalize(at - centre),
                radii_mm: [*a, *b],
                sweep_rad: *sweep_rad,
            },
            _ => self.clone(),
        }
    }
}

/// The point of a spline after a share of its pieces, mm, the direction there, and the piece.
fn on_spline(points: &[Point3<f64>], tangents: &[Unit<Vector3<f64>>], share: f64) -> (Point3<f64>, Unit<Vector3<f64>>, usize) {
    let pieces = points.len() - 1;
    let place = share * pieces as f64;
    let piece = (place as usize).min(pieces - 1);
    let t = place - piece as f64;
    let (p, q) = (points[piece].coords, points[piece + 1].coords);
    let reach = (q - p).norm();
    let (u, v) = (tangents[piece].into_inner() * reach, tangents[piece + 1].into_inner() * reach);
    let (t2, t3) = (t * t, t * t * t);
    let at = p * (2.0 * t3 - 3.0 * t2 + 1.0) + q * (3.0 * t2 - 2.0 * t3) + u * (t3 - 2.0 * t2 + t) + v * (t3 - t2);
    let along = (p - q) * (6.0 * t2 - 6.0 * t) + u * (3.0 * t2 - 4.0 * t + 1.0) + v * (3.0 * t2 - 2.0 * t);
    (at.into(), Unit::new_normalize(along), piece)
}
