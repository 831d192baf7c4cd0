//! Plane outlines: closed contours of lines and arcs, the input of extrusions and revolutions.

use nalgebra::{Point2, Vector2};

/// One step of a closed path, from where the last one ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Segment {
    /// Straight to a point, mm.
    Line {
        /// End point, mm.
        to: Point2<f64>,
    },
    /// Circular arc to a point, mm.
    Arc {
        /// End point, mm.
        to: Point2<f64>,
        /// Centre of the circle, mm.
        centre: Point2<f64>,
        /// Whether the arc turns counter-clockwise.
        counter_clockwise: bool,
    },
}

impl Segment {
    pub(super) fn to(&self) -> Point2<f64> {
        match self {
            Self::Line { to } | Self::Arc { to, .. } => *to,
        }
    }
}

/// A closed curve in the plane, mm; its direction does not matter.
#[derive(Clone, Debug, PartialEq)]
pub enum Contour {
    /// Lines and arcs; the last segment ends at `start`.
    Path {
        /// First point, mm.
        start: Point2<f64>,
        /// The steps.
        segments: Vec<Segment>,
    },
    /// A full circle.
    Circle {
        /// Centre, mm.
        centre: Point2<f64>,
        /// Radius, mm.
        radius_mm: f64,
        /// A functional bore: its polygon is drawn around the circle, so that the printed hole is not too small.
        bore: bool,
    },
}

impl Contour {
    /// A closed polygon through the points, mm.
    pub fn polygon(points: &[[f64; 2]]) -> Self {
        let mut steps: Vec<Segment> = points[1..].iter().map(|p| Segment::Line { to: Point2::new(p[0], p[1]) }).collect();
        let start = Point2::new(points[0][0], points[0][1]);
        steps.push(Segment::Line { to: start });
        Self::Path { start, segments: steps }
    }

    /// A polygon whose corners are rounded, each by its own radius (0 leaves it sharp), mm. A radius that
    /// does not fit between its neighbours is reduced to what fits.
    pub fn rounded_polygon(corners: &[([f64; 2], f64)]) -> Self {
        let n = corners.len();
        let point = |i: usize| Point2::from(corners[i % n].0);
        let wanted: Vec<f64> = (0..n).map(|i| tangent_length(point(i + n - 1), point(i), point(i + 1), corners[i].1)).collect();
        let fitting = |i: usize, neighbour: usize| {
            let free = (point(i) - point(neighbour)).norm();
            let both = wanted[i % n] + wanted[neighbour % n];
            if both > free { wanted[i % n] * free / both } else { wanted[i % n] }
        };
        let fillet = |i: usize| {
            let length = fitting(i, i + n - 1).min(fitting(i, i + 1));
            let to_before = (point(i + n - 1) - point(i)).normalize();
            let to_after = (point(i + 1) - point(i)).normalize();
            (point(i), to_before, to_after, length)
        };
        let (corner, _, to_after, length) = fillet(n);
        let start = corner + to_after * length;
        let mut segments = Vec::new();
        for i in n + 1..=2 * n {
            let (corner, to_before, to_after, length) = fillet(i);
            segments.push(Segment::Line { to: corner + to_before * length });
            push_fillet(&mut segments, corner, to_before, to_after, length);
        }
        Self::Path { start, segments: without_null_steps(start, segments) }
    }

    /// A polygon with the same radius on every corner, mm.
    pub fn rounded(points: &[[f64; 2]], radius_mm: f64) -> Self {
        let corners: Vec<_> = points.iter().map(|p| (*p, radius_mm)).collect();
        Self::rounded_polygon(&corners)
    }

    /// An axis-parallel rectangle around a centre, mm.
    pub fn rectangle(centre: [f64; 2], size: [f64; 2]) -> Self {
        Self::polygon(&rectangle_points(centre, size))
    }

    /// An axis-parallel rectangle with rounded corners, mm.
    pub fn rounded_rectangle(centre: [f64; 2], size: [f64; 2], radius_mm: f64) -> Self {
        Self::rounded(&rectangle_points(centre, size), radius_mm)
    }

    /// A full circle that bounds material, mm.
    pub fn circle(centre: [f64; 2], radius_mm: f64) -> Self {
        Self::Circle { centre: centre.into(), radius_mm, bore: false }
    }

    /// A full circle that something passes through, mm: see [`Contour::Circle`]'s `bore`.
    pub fn bore(centre: [f64; 2], radius_mm: f64) -> Self {
        Self::Circle { centre: centre.into(), radius_mm, bore: true }
    }

    /// Corner points of the polygon that stands for the contour, mm; `per_turn` segments make a full circle.
    pub fn points(&self, per_turn: u32) -> Vec<Point2<f64>> {
        match self {
            Self::Circle { centre, radius_mm, bore } => {
                let radius = if *bore { circumscribed(*radius_mm, per_turn) } else { *radius_mm };
                (0..per_turn)
                    .map(|i| {
                        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(per_turn);
                        centre + Vector2::new(libm::cos(angle), libm::sin(angle)) * radius
                    })
                    .collect()
            }
            Self::Path { start, segments } => {
                let mut points = vec![*start];
                for segment in segments {
                    if let Segment::Arc { to, centre, counter_clockwise } = segment {
                        let from = points[points.len() - 1];
                        points.extend(arc_interior(from, *to, *centre, *counter_clockwise, per_turn));
                    }
                    points.push(segment.to());
                }
                points.pop();
                points
            }
        }
    }

    /// The exact enclosed area, mm² (arcs are arcs, not chords).
    pub fn area_mm2(&self) -> f64 {
        match self {
            Self::Circle { radius_mm, .. } => std::f64::consts::PI * radius_mm * radius_mm,
            Self::Path { start, segments } => {
                let mut from = *start;
                let mut twice = 0.0;
                for segment in segments {
                    let to = segment.to();
                    twice += from.x * to.y - to.x * from.y;
                    if let Segment::Arc { centre, counter_clockwise, .. } = segment {
                        let radius = (from - centre).norm();
                        let sweep = sweep_angle(from, to, *centre, *counter_clockwise);
                        twice += radius * radius * (sweep - libm::sin(sweep));
                    }
                    from = to;
                }
                0.5 * twice.abs()
            }
        }
    }
}

/// An outline with holes, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The outer boundary.
    pub outer: Contour,
    /// Boundaries of the holes, inside `outer`, apart from each other.
    pub holes: Vec<Contour>,
}

impl Profile {
    /// An outline without holes.
    pub fn new(outer: Contour) -> Self {
        Self { outer, holes: Vec::new() }
    }

    /// The same with one more hole.
    pub fn with_hole(mut self, hole: Contour) -> Self {
        self.holes.push(hole);
        self
    }

    /// The same with more holes.
    pub fn with_holes(mut self, holes: impl IntoIterator<Item = Contour>) -> Self {
        self.holes.extend(holes);
        self
    }

    /// The same with the radius of every functional bore larger by some mm.
    pub(super) fn with_wider_bores(&self, by_mm: f64) -> Self {
        let wider = |contour: &Contour| match contour {
            Contour::Circle { centre, radius_mm, bore: true } => {
                Contour::Circle { centre: *centre, radius_mm: radius_mm + by_mm, bore: true }
            }
            other => other.clone(),
        };
        Self { outer: wider(&self.outer), holes: self.holes.iter().map(wider).collect() }
    }

    /// The exact area, mm².
    pub fn area_mm2(&self) -> f64 {
        self.outer.area_mm2() - self.holes.iter().map(Contour::area_mm2).sum::<f64>()
    }
}

/// Radius of the polygon's corners that makes its flats touch the circle, mm.
pub fn circumscribed(radius_mm: f64, per_turn: u32) -> f64 {
    radius_mm / libm::cos(std::f64::consts::PI / f64::from(per_turn))
}

/// Signed sweep of an arc, rad; counter-clockwise positive.
pub(super) fn sweep_angle(from: Point2<f64>, to: Point2<f64>, centre: Point2<f64>, ccw: bool) -> f64 {
    let (a, b) = (from - centre, to - centre);
    let mut sweep = libm::atan2(b.y, b.x) - libm::atan2(a.y, a.x);
    if ccw && sweep <= 0.0 {
        sweep += std::f64::consts::TAU;
    }
    if !ccw && sweep >= 0.0 {
        sweep -= std::f64::consts::TAU;
    }
    sweep
}

fn arc_interior(from: Point2<f64>, to: Point2<f64>, centre: Point2<f64>, ccw: bool, per_turn: u32) -> Vec<Point2<f64>> {
    let sweep = sweep_angle(from, to, centre, ccw);
    let radius = (from - centre).norm();
    let begin = libm::atan2((from - centre).y, (from - centre).x);
    let steps = (sweep.abs() / std::f64::consts::TAU * f64::from(per_turn)).ceil().max(1.0) as u32;
    (1..steps)
        .map(|i| {
            let angle = begin + sweep * f64::from(i) / f64::from(steps);
            centre + Vector2::new(libm::cos(angle), libm::sin(angle)) * radius
        })
        .collect()
}

/// How far from the corner a fillet of this radius begins, mm.
fn tangent_length(before: Point2<f64>, here: Point2<f64>, after: Point2<f64>, radius_mm: f64) -> f64 {
    let (u, v) = ((before - here).normalize(), (after - here).normalize());
    let half = 0.5 * libm::acos(u.dot(&v).clamp(-1.0, 1.0));
    if half > 0.5 * std::f64::consts::PI - 1e-6 { 0.0 } else { radius_mm / libm::tan(half) }
}

fn push_fillet(segments: &mut Vec<Segment>, corner: Point2<f64>, to_before: Vector2<f64>, to_after: Vector2<f64>, length: f64) {
    if length < 1e-9 {
        return;
    }
    let bisector = (to_before + to_after).normalize();
    let centre = corner + bisector * (length / bisector.dot(&to_before));
    let counter_clockwise = to_before.perp(&to_after) < 0.0;
    segments.push(Segment::Arc { to: corner + to_after * length, centre, counter_clockwise });
}

fn without_null_steps(start: Point2<f64>, segments: Vec<Segment>) -> Vec<Segment> {
    let mut from = start;
    segments
        .into_iter()
        .filter(|segment| {
            let keep = (segment.to() - from).norm() > 1e-9;
            if keep {
                from = segment.to();
            }
            keep
        })
        .collect()
}

fn rectangle_points(centre: [f64; 2], size: [f64; 2]) -> [[f64; 2]; 4] {
    let (x, y) = (0.5 * size[0], 0.5 * size[1]);
    [[centre[0] - x, centre[1] - y], [centre[0] + x, centre[1] - y], [centre[0] + x, centre[1] + y], [centre[0] - x, centre[1] + y]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn analytic_rounded_square_loses_its_corners() {
        let square = Contour::rounded_rectangle([1.0, 2.0], [10.0, 6.0], 2.0);
        let exact = 60.0 - (4.0 - PI) * 4.0;
        assert!((square.area_mm2() - exact).abs() < 1e-9, "{}", square.area_mm2());
        assert_eq!(square.points(48).len(), 4 * 13);
    }

    #[test]
    fn analytic_reflex_corners_are_filled() {
        let l_shape = Contour::rounded(&[[0.0, 0.0], [8.0, 0.0], [8.0, 4.0], [4.0, 4.0], [4.0, 8.0], [0.0, 8.0]], 1.0);
        let exact = 48.0 - 5.0 * (1.0 - PI / 4.0) + (1.0 - PI / 4.0);
        assert!((l_shape.area_mm2() - exact).abs() < 1e-9, "{}", l_shape.area_mm2());
    }

    #[test]
    fn analytic_a_bore_polygon_contains_its_circle() {
        let bore = Contour::bore([0.0, 0.0], 1.35);
        let flat = bore.points(48)[0].coords.lerp(&bore.points(48)[1].coords, 0.5).norm();
        assert!((flat - 1.35).abs() < 1e-12);
    }

    #[test]
    fn analytic_too_large_radius_is_reduced() {
        let pill = Contour::rounded_rectangle([0.0, 0.0], [10.0, 4.0], 50.0);
        assert!((pill.area_mm2() - (24.0 + PI * 4.0)).abs() < 1e-9, "{}", pill.area_mm2());
    }
}
