//! Drawing aids of the part files: profiles in the three planes, sampled arcs, corners.

use nalgebra::{Isometry3, Matrix3, Point2, Rotation3, Translation3, UnitQuaternion, Vector2};

use crate::solid::{Contour, Feature, Profile, SEGMENTS_PER_TURN, Segment};

/// How far features are sunk into each other or past a surface, mm, so that no two faces coincide.
pub(in crate::frame) const SINK_MM: f64 = 0.01;

/// A corner of a rounded polygon: position and radius, mm.
pub(super) type Corner = ([f64; 2], f64);

/// A sharp corner.
pub(super) fn sharp(x: f64, y: f64) -> Corner {
    ([x, y], 0.0)
}

/// Points of an arc between two directions (degrees), both ends included, as sharp corners.
pub(super) fn arc(centre: [f64; 2], radius_mm: f64, from_deg: f64, to_deg: f64) -> Vec<Corner> {
    let sweep = to_deg - from_deg;
    let steps = libm::ceil(sweep.abs() / 360.0 * f64::from(SEGMENTS_PER_TURN) - 1e-9).max(2.0) as u32;
    (0..=steps)
        .map(|i| {
            let (sin, cos) = libm::sincos((from_deg + sweep * f64::from(i) / f64::from(steps)).to_radians());
            sharp(centre[0] + radius_mm * cos, centre[1] + radius_mm * sin)
        })
        .collect()
}

/// The corners mirrored at the second axis, in the opposite order.
pub(super) fn mirrored(corners: &[Corner]) -> Vec<Corner> {
    corners.iter().rev().map(|(p, r)| ([-p[0], p[1]], *r)).collect()
}

/// A profile without holes from its corners.
pub(super) fn face(corners: &[Corner]) -> Profile {
    Profile::new(Contour::rounded_polygon(corners))
}

/// A profile in (x, y), drawn from one height to another.
pub(in crate::frame) fn upright(profile: Profile, z: [f64; 2]) -> Feature {
    Feature::extrude(profile, z[1] - z[0]).at(0.0, 0.0, z[0])
}

/// A profile in (y, z), drawn along x.
pub(super) fn along_x(profile: Profile, x: [f64; 2]) -> Feature {
    let turn = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
    Feature::extrude(profile, x[1] - x[0]).placed(pose(turn, [x[0], 0.0, 0.0]))
}

/// A profile in (x, z), drawn along y.
pub(in crate::frame) fn along_y(profile: Profile, y: [f64; 2]) -> Feature {
    let turn = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    Feature::extrude(profile, y[1] - y[0]).placed(pose(turn, [0.0, y[1], 0.0]))
}

/// A bore along z through (x, y).
pub(super) fn bore(x: f64, y: f64, diameter_mm: f64, z: [f64; 2]) -> Feature {
    upright(Profile::new(Contour::bore([x, y], 0.5 * diameter_mm)), z)
}

/// A bore along y through (x, z).
pub(super) fn bore_y(x: f64, z: f64, diameter_mm: f64, y: [f64; 2]) -> Feature {
    along_y(Profile::new(Contour::bore([x, z], 0.5 * diameter_mm)), y)
}

fn pose(turn: Matrix3<f64>, at: [f64; 3]) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    Isometry3::from_parts(Translation3::new(at[0], at[1], at[2]), turn)
}

/// Draws a contour of lines and true arcs.
pub(super) struct Pen {
    start: Point2<f64>,
    at: Point2<f64>,
    segments: Vec<Segment>,
}

impl Pen {
    /// Sets the pen down.
    pub(super) fn new(start: Point2<f64>) -> Self {
        Self { start, at: start, segments: Vec::new() }
    }

    /// Draws a straight line; nothing when it is already there.
    pub(super) fn line(&mut self, to: Point2<f64>) -> &mut Self {
        if (to - self.at).norm() > 1e-9 {
            self.segments.push(Segment::Line { to });
            self.at = to;
        }
        self
    }

    /// Draws a line to where an arc begins, then the arc.
    pub(super) fn arc(&mut self, centre: Point2<f64>, from: Point2<f64>, to: Point2<f64>, counter_clockwise: bool) -> &mut Self {
        self.line(from);
        self.segments.push(Segment::Arc { to, centre, counter_clockwise });
        self.at = to;
        self
    }

    /// The closed contour.
    pub(super) fn close(mut self) -> Contour {
        let start = self.start;
        self.line(start);
        Contour::Path { start, segments: self.segments }
    }
}

/// A straight line `normal · p = offset` in the plane, with a unit normal.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub(super) normal: Vector2<f64>,
    pub(super) offset: f64,
}

impl Line {
    /// The parallel line that lies further along the normal.
    pub(super) fn shifted(self, by_mm: f64) -> Self {
        Self { offset: self.offset + by_mm, ..self }
    }

    /// Where two lines meet; `None` when they are parallel.
    pub(super) fn meet(self, other: Self) -> Option<Point2<f64>> {
        let det = self.normal.perp(&other.normal);
        let x = self.offset * other.normal.y - other.offset * self.normal.y;
        let y = self.normal.x * other.offset - other.normal.x * self.offset;
        (det.abs() > 1e-9).then(|| Point2::new(x / det, y / det))
    }

    /// Where the line enters and leaves a circle, seen with the normal on the right; `None` when it misses it.
    pub(super) fn cross(self, centre: Point2<f64>, radius_mm: f64) -> Option<[Point2<f64>; 2]> {
        let distance = self.offset - self.normal.dot(&centre.coords);
        let half = radius_mm * radius_mm - distance * distance;
        let along = Vector2::new(-self.normal.y, self.normal.x) * half.max(0.0).sqrt();
        let foot = centre + self.normal * distance;
        (half > 0.0).then(|| [foot - along, foot + along])
    }
}
