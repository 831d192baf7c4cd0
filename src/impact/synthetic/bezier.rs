//! The frame's static curve as the generator follows it: Bézier's cubic between its points.

/// A curve through points, m.
#[derive(Clone, Debug)]
pub(super) struct Bezier {
    points: Vec<[f64; 2]>,
}

impl Bezier {
    pub fn new(points: Vec<[f64; 2]>) -> Self {
        Self { points }
    }

    /// Slope of the parabola through three neighbours; straight at the last point, 1 at rest.
    fn slope(&self, i: usize) -> f64 {
        if i == 0 {
            return 1.0;
        }
        let points = &self.points;
        let chord = |a: usize, b: usize| (points[b][1] - points[a][1]) / (points[b][0] - points[a][0]);
        if i + 1 == points.len() {
            return chord(i - 1, i);
        }
        let weight = (points[i + 1][0] - points[i][0]) / (points[i + 1][0] - points[i - 1][0]);
        weight * chord(i - 1, i) + (1.0 - weight) * chord(i, i + 1)
    }

    /// The curve at a compression above zero, m, by repeated linear interpolation (P. de Casteljau).
    pub fn at(&self, x: f64) -> f64 {
        let points = &self.points;
        let count = points.len();
        match (1..count).find(|i| x < points[*i][0]) {
            None => points[count - 1][1] + self.slope(count - 1) * (x - points[count - 1][0]),
            Some(i) => {
                let third = (points[i][0] - points[i - 1][0]) / 3.0;
                let t = (x - points[i - 1][0]) / (3.0 * third);
                let (left, right) = (third * self.slope(i - 1), third * self.slope(i));
                let mut hull = [points[i - 1][1], points[i - 1][1] + left, points[i][1] - right, points[i][1]];
                for last in (1..4).rev() {
                    for j in 0..last {
                        hull[j] += t * (hull[j + 1] - hull[j]);
                    }
                }
                hull[0]
            }
        }
    }
}
