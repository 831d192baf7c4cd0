//! A frame's own static curve: the base's spring k x becomes k [(1 - s) x + s φ(x)], φ with slope 1 at rest.
//!
//! φ is the force of a frame pressed down over its stiffness at rest, as `flexframe stiffness` computes it from the frame's geometry:
//! legs at a slope give way as they turn. The points stand in the model file; between them runs the cubic whose slopes are
//! those of the parabolas through three neighbours, beyond the last point the curve goes on straight, above the ground it
//! is x. The share s says how much of it there is: 0 none, 1 as the frame says. It stores k [(1 - s) x²/2 + s Φ(x)], Φ the
//! area under φ.
//!
//! *When it is wrong:* beyond the last point; in an impact, where motors and ring swing against the centre, and the force on the
//! ground is not that on the payload; for another frame than the curve's.

use std::sync::Arc;

use super::effect::{Effect, Parameter, Spec, Stage};

/// The catalogue entry.
pub(super) const SPEC: Spec = Spec {
    id: "frame_force_curve",
    title: "the frame's static curve",
    stage: Stage::Arrangement,
    parameters: &[Parameter {
        key: "share",
        unit: "1",
        si: 1.0,
        min: 0.0,
        max: 1.5,
        off: Some(0.0),
        default: None,
        doc: "how much of the frame's curve stands in the spring's place",
    }],
    choice: None,
    build: |_, _| Box::new(FrameForceCurve),
};

/// Its part is the spring's: [`Softening`].
#[derive(Clone, Copy, Debug)]
struct FrameForceCurve;

impl Effect for FrameForceCurve {}

/// A curve over the compression, both in m.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameCurve {
    x_m: Vec<f64>,
    phi_m: Vec<f64>,
    slopes: Vec<f64>,
    /// Area below each point, m².
    areas_m2: Vec<f64>,
}

/// Fewest and most points.
pub const POINTS: [usize; 2] = [3, 200];
/// Bounds of compressions and curve, mm.
pub const REACH_MM: [f64; 2] = [0.0, 200.0];
/// How far the curve's first step may be from a slope of 1.
const FIRST_SLOPE: f64 = 0.3;

impl FrameCurve {
    /// A curve through points, mm, the origin first.
    ///
    /// # Errors
    /// What is wrong with the points, in words.
    pub fn new(x_mm: &[f64], phi_mm: &[f64]) -> Result<Self, String> {
        let [fewest, most] = POINTS;
        if x_mm.len() != phi_mm.len() || !(fewest..=most).contains(&x_mm.len()) {
            return Err(format!("{} compressions and {} values, where {fewest} to {most} of each are needed", x_mm.len(), phi_mm.len()));
        }
        if x_mm[0] != 0.0 || phi_mm[0] != 0.0 {
            return Err(format!("the curve begins at {} and {}, not at 0 and 0", x_mm[0], phi_mm[0]));
        }
        if let Some(pair) = x_mm.windows(2).find(|pair| pair[1] - pair[0] < 1e-6) {
            return Err(format!("{} mm does not come after {} mm", pair[1], pair[0]));
        }
        let first = phi_mm[1] / x_mm[1];
        if (first - 1.0).abs() > FIRST_SLOPE {
            return Err(format!("the curve begins with slope {first:.2}, not 1: divide the force by the stiffness at rest"));
        }
        let [x_m, phi_m] = [x_mm, phi_mm].map(|values| values.iter().map(|value| value * 1e-3).collect::<Vec<f64>>());
        let slopes = slopes(&x_m, &phi_m);
        let mut areas_m2 = vec![0.0];
        for at in 1..x_m.len() {
            let h = x_m[at] - x_m[at - 1];
            let area = h * (0.5 * (phi_m[at] + phi_m[at - 1]) + h * (slopes[at - 1] - slopes[at]) / 12.0);
            areas_m2.push(areas_m2[at - 1] + area);
        }
        Ok(Self { x_m, phi_m, slopes, areas_m2 })
    }

    /// The points, mm.
    pub fn points_mm(&self) -> impl Iterator<Item = [f64; 2]> {
        self.x_m.iter().zip(&self.phi_m).map(|(x, phi)| [x * 1e3, phi * 1e3])
    }

    /// The largest compression of its points, m.
    pub fn reach_m(&self) -> f64 {
        self.x_m.last().copied().unwrap_or(0.0)
    }

    /// φ, m, and the area under it, m², at a compression, m.
    pub fn at(&self, x_m: f64) -> [f64; 2] {
        if x_m <= 0.0 {
            return [x_m, 0.5 * x_m * x_m];
        }
        let last = self.x_m.len() - 1;
        if x_m >= self.x_m[last] {
            let over = x_m - self.x_m[last];
            let (phi, slope) = (self.phi_m[last], self.slopes[last]);
            return [phi + slope * over, self.areas_m2[last] + phi * over + 0.5 * slope * over * over];
        }
        let after = self.x_m.partition_point(|at| *at <= x_m);
        let before = after - 1;
        let h = self.x_m[after] - self.x_m[before];
        let t = (x_m - self.x_m[before]) / h;
        let (p, q) = (self.phi_m[before], self.phi_m[after]);
        let (m, n) = (self.slopes[before] * h, self.slopes[after] * h);
        // p + m t + b t² + a t³.
        let (a, b) = (2.0 * (p - q) + m + n, 3.0 * (q - p) - 2.0 * m - n);
        let value = p + t * (m + t * (b + t * a));
        [value, self.areas_m2[before] + h * t * (p + t * (0.5 * m + t * (b / 3.0 + 0.25 * t * a)))]
    }
}

/// Slopes at the points: 1 at rest, then those of parabolas through three neighbours, the last straight.
fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let secant = |at: usize| (y[at + 1] - y[at]) / (x[at + 1] - x[at]);
    let inner = |at: usize| {
        let (before, after) = (x[at] - x[at - 1], x[at + 1] - x[at]);
        (after * secant(at - 1) + before * secant(at)) / (before + after)
    };
    let last = x.len() - 1;
    (0..=last)
        .map(|at| {
            if at == 0 {
                1.0
            } else if at == last {
                secant(last - 1)
            } else {
                inner(at)
            }
        })
        .collect()
}

/// The spring with some of a frame's curve in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Softening {
    /// s.
    pub share: f64,
    /// The curve.
    pub curve: Arc<FrameCurve>,
}

impl Softening {
    /// What stands in the place of x, m.
    pub fn compression_m(&self, x_m: f64) -> f64 {
        x_m + self.share * (self.curve.at(x_m)[0] - x_m)
    }

    /// What stands in the place of x², m².
    pub fn square_m2(&self, x_m: f64) -> f64 {
        x_m * x_m + self.share * (2.0 * self.curve.at(x_m)[1] - x_m * x_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_straight_curve_is_the_spring_and_areas_are_integrals() {
        let straight = FrameCurve::new(&[0.0, 1.0, 3.0, 10.0], &[0.0, 1.0, 3.0, 10.0]).expect("is a curve");
        for x in [-0.002, 0.0, 0.0004, 0.002, 0.0099, 0.02] {
            let [phi, area] = straight.at(x);
            assert!((phi - x).abs() < 1e-15 && (area - 0.5 * x * x).abs() < 1e-15, "{x}: {phi} {area}");
        }
        // 10 mm tanh(x / 10 mm), whose area is 100 mm² ln cosh.
        let x_mm: Vec<f64> = (0..=20).map(f64::from).collect();
        let phi_mm: Vec<f64> = x_mm.iter().map(|x| 10.0 * libm::tanh(x / 10.0)).collect();
        let soft = FrameCurve::new(&x_mm, &phi_mm).expect("is a curve");
        for x in [0.0005, 0.0033, 0.0101, 0.0177] {
            let [phi, area] = soft.at(x);
            assert!((phi - 0.01 * libm::tanh(x / 0.01)).abs() < 2e-6, "{x}: {phi}");
            assert!((area - 1e-4 * libm::log(libm::cosh(x / 0.01))).abs() < 1e-8, "{x}: {area}");
        }
        // Beyond the last point it goes on straight.
        let [a, b, c] = [0.021, 0.022, 0.023].map(|x| soft.at(x)[0]);
        assert!((c - 2.0 * b + a).abs() < 1e-15);
    }

    #[test]
    fn planted_curves_that_are_none_are_refused() {
        for (x, phi, says) in [
            (vec![0.0, 1.0], vec![0.0, 1.0], "needed"),
            (vec![0.0, 1.0, 2.0], vec![0.0, 1.0], "needed"),
            (vec![0.5, 1.0, 2.0], vec![0.5, 1.0, 2.0], "begins at"),
            (vec![0.0, 2.0, 1.0], vec![0.0, 2.0, 1.0], "does not come after"),
            (vec![0.0, 1.0, 2.0], vec![0.0, 12.0, 20.0], "slope"),
        ] {
            assert!(FrameCurve::new(&x, &phi).expect_err("is none").contains(says), "{says}");
        }
    }
}
