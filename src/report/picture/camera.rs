//! Where a picture is taken from: directions of view, fitting, and the projection to pixels.
//!
//! World axes: X right, Y front, Z up, mm. Picture axes: x right, y down, pixels from the upper left corner.
//! The third coordinate is called nearness: greater is nearer, and it is linear across the picture for any flat facet.

use nalgebra::{Matrix3, Point3, Vector3};

/// Share of the picture left empty at each side.
const MARGIN: f64 = 0.04;

/// Tangent of half the angle of view across the longer side of a perspective picture (15°).
const HALF_VIEW_TANGENT: f64 = 0.267_949_192_431_122_7;

/// Direction a picture is taken from; world axes X right, Y front, Z up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// Orthographic, from +Y along -Y, where the camera looks: X to the left of the picture, Z up.
    Front,
    /// Orthographic, from +X along -X: Y to the right, Z up.
    Right,
    /// Orthographic, from +Z along -Z: X to the right, Y up.
    Top,
    /// Orthographic, from -Z along +Z: X to the right, Y down.
    Bottom,
    /// Perspective from a raised corner between +Y and -X, so that the front of a frame points to the lower left.
    /// With a print bed: from above its front edge (-Y), X to the right.
    Perspective,
}

impl View {
    /// Unit vectors of the picture's right, its up, and towards the viewer, as rows.
    fn axes(self, on_bed: bool) -> Matrix3<f64> {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let (right, up) = match self {
            Self::Front => (-x, z),
            Self::Right => (y, z),
            Self::Top => (x, y),
            Self::Bottom => (x, -y),
            Self::Perspective => {
                let back = if on_bed { Vector3::new(-0.22, -1.0, 1.1) } else { Vector3::new(-0.85, 1.0, 0.82) }.normalize();
                let right = z.cross(&back).normalize();
                (right, back.cross(&right))
            }
        };
        Matrix3::from_rows(&[right.transpose(), up.transpose(), right.cross(&up).transpose()])
    }

    /// Towards the viewer of a frame.
    pub fn towards(self) -> Vector3<f64> {
        self.axes(false).row(2).transpose()
    }
}

/// A camera that has everything in the picture.
#[derive(Clone, Debug)]
pub struct Camera {
    axes: Matrix3<f64>,
    /// Orthographic: the middle of the picture; perspective: the eye. In camera axes, mm.
    origin: Vector3<f64>,
    /// Middle of the picture, pixels.
    middle: [f64; 2],
    /// Pixels per mm (orthographic) or per unit of tangent (perspective).
    scale: f64,
    perspective: bool,
}

impl Camera {
    /// The camera of a view from which all the points (mm) lie in a picture of this size (pixels), with a margin.
    pub fn fit(view: View, on_bed: bool, points: &[Point3<f64>], size: [u32; 2]) -> Self {
        let axes = view.axes(on_bed);
        let turned: Vec<Vector3<f64>> = points.iter().map(|p| axes * p.coords).filter(|c| c.iter().all(|x| x.is_finite())).collect();
        let size = size.map(f64::from);
        let middle = size.map(|s| s / 2.0);
        let usable = size.map(|s| s * (0.5 - MARGIN));
        let perspective = view == View::Perspective;
        let (origin, scale) = if turned.is_empty() {
            (Vector3::new(0.0, 0.0, if perspective { 1.0 } else { 0.0 }), 1.0)
        } else if perspective {
            let scale = size[0].max(size[1]) / (2.0 * HALF_VIEW_TANGENT);
            (eye(&turned, usable.map(|u| u / scale)), scale)
        } else {
            centre(&turned, usable)
        };
        Self { axes, origin, middle, scale, perspective }
    }

    /// Picture x and y (pixels) and nearness of a point (mm).
    pub fn project(&self, point: &Point3<f64>) -> [f64; 3] {
        let c = self.turn(&point.coords) - self.origin;
        let scale = if self.perspective { self.scale / -c.z } else { self.scale };
        [self.middle[0] + scale * c.x, self.middle[1] - scale * c.y, if self.perspective { -1.0 / c.z } else { c.z }]
    }

    /// A direction in camera axes: x to the right of the picture, y up, z towards the viewer.
    pub fn turn(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.axes * direction
    }

    /// The nearness of a point moved towards the viewer by the distance that these pixels span where it is.
    pub fn raised(&self, nearness: f64, pixels: f64) -> f64 {
        let distance = pixels / self.scale;
        if self.perspective { nearness / (1.0 - distance).max(0.1) } else { nearness + distance }
    }
}

/// The greatest of a quantity over the points.
fn greatest(points: &[Vector3<f64>], quantity: impl Fn(&Vector3<f64>) -> f64) -> f64 {
    points.iter().map(quantity).fold(f64::NEG_INFINITY, f64::max)
}

/// Middle of the points and the scale (pixels per mm) at which they just fill the usable half sizes (pixels).
fn centre(points: &[Vector3<f64>], usable: [f64; 2]) -> (Vector3<f64>, f64) {
    let high = [0, 1, 2].map(|axis| greatest(points, |c| c[axis]));
    let low = [0, 1, 2].map(|axis| -greatest(points, |c| -c[axis]));
    let half = [0, 1].map(|axis| ((high[axis] - low[axis]) / 2.0).max(1e-3));
    let middle = Vector3::from_fn(|axis, _| (high[axis] + low[axis]) / 2.0);
    (middle, (usable[0] / half[0]).min(usable[1] / half[1]))
}

/// Nearest eye from which the points lie between the planes of these tangents, left and right, above and below.
///
/// A point lies between them when ±c ≤ ±e + t·(e_z - c_z); the greatest of ±c + t·c_z therefore gives both the
/// sideways place of the eye (half the difference) and its distance (half the sum over t).
fn eye(points: &[Vector3<f64>], tangents: [f64; 2]) -> Vector3<f64> {
    let reach = |axis: usize, sign: f64| greatest(points, |c| sign * c[axis] + tangents[axis] * c.z);
    let sides = [0, 1].map(|axis| (reach(axis, 1.0), reach(axis, -1.0)));
    let nearest = greatest(points, |c| c.z) + 1.0;
    let z = [0, 1].map(|axis| (sides[axis].0 + sides[axis].1) / (2.0 * tangents[axis])).into_iter().fold(nearest, f64::max);
    Vector3::new((sides[0].0 - sides[0].1) / 2.0, (sides[1].0 - sides[1].1) / 2.0, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(half: f64) -> Vec<Point3<f64>> {
        (0..8).map(|i| Point3::from([i & 1, i >> 1 & 1, i >> 2].map(|bit| half * (2.0 * f64::from(bit) - 1.0)))).collect()
    }

    #[test]
    fn analytic_every_view_fits_and_touches_the_margin() {
        for view in [View::Front, View::Right, View::Top, View::Bottom, View::Perspective] {
            let camera = Camera::fit(view, false, &cube(30.0), [400, 300]);
            let seen: Vec<[f64; 3]> = cube(30.0).iter().map(|p| camera.project(p)).collect();
            let top = seen.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
            let bottom = seen.iter().map(|p| p[1]).fold(0.0, f64::max);
            assert!((top - 300.0 * MARGIN).abs() < 1e-6 && (300.0 - bottom - 300.0 * MARGIN).abs() < 1e-6, "{view:?} {top} {bottom}");
            assert!(seen.iter().all(|p| p[0] > 400.0 * MARGIN - 1e-6 && p[0] < 400.0 * (1.0 - MARGIN) + 1e-6), "{view:?}");
        }
    }

    #[test]
    fn analytic_axes_lie_as_documented() {
        let points = cube(10.0);
        let seen = |view, p: [f64; 3]| {
            let camera = Camera::fit(view, false, &points, [100, 100]);
            let (at, from) = (camera.project(&p.into()), camera.project(&Point3::origin()));
            [0, 1, 2].map(|i| (at[i] - from[i]).total_cmp(&0.0) as i8 * i8::from((at[i] - from[i]).abs() > 1e-9))
        };
        assert_eq!(seen(View::Front, [1.0, 0.0, 0.0]), [-1, 0, 0]);
        assert_eq!(seen(View::Front, [0.0, 1.0, 0.0]), [0, 0, 1]);
        assert_eq!(seen(View::Front, [0.0, 0.0, 1.0]), [0, -1, 0]);
        assert_eq!(seen(View::Right, [0.0, 1.0, 0.0]), [1, 0, 0]);
        assert_eq!(seen(View::Right, [1.0, 0.0, 0.0]), [0, 0, 1]);
        assert_eq!(seen(View::Top, [0.0, 1.0, 0.0]), [0, -1, 0]);
        assert_eq!(seen(View::Bottom, [0.0, 1.0, 0.0]), [0, 1, 0]);
        assert_eq!(seen(View::Perspective, [0.0, 1.0, 0.0]), [-1, 1, 1]);
    }
}
