//! Finite rotations: exponential, logarithm, and what the logarithm's derivative needs.
//!
//! Source: J.-M. Battini, C. Pacoste, *Co-rotational beam elements with warping effects in instability problems*, Comput.
//! Methods Appl. Mech. Engrg. 191 (2002) 1755. Angles stay below π: local rotations of an element are far smaller.

use nalgebra::{Matrix3, Vector3};

/// Below this angle series stand in for quotients of vanishing numbers, rad. Their error there is below 1e-13.
const SMALL_RAD: f64 = 0.02;

/// The matrix of the cross product with a vector.
pub fn skew(v: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -v.z, v.y, v.z, 0.0, -v.x, -v.y, v.x, 0.0)
}

/// The rotation about a vector by its length.
pub fn exp(v: &Vector3<f64>) -> Matrix3<f64> {
    let square = v.norm_squared();
    let (a, b) = if square < SMALL_RAD * SMALL_RAD {
        (1.0 - square / 6.0 * (1.0 - square / 20.0), 0.5 - square / 24.0 * (1.0 - square / 30.0))
    } else {
        let angle = square.sqrt();
        (libm::sin(angle) / angle, (1.0 - libm::cos(angle)) / square)
    };
    let k = skew(v);
    Matrix3::identity() + k * a + k * k * b
}

/// The rotation vector of a rotation by less than π.
pub fn log(r: &Matrix3<f64>) -> Vector3<f64> {
    let sine = 0.5 * Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    let s = sine.norm();
    let c = 0.5 * (r.trace() - 1.0);
    let angle = libm::atan2(s, c);
    if s < 1e-8 { sine } else { sine * (angle / s) }
}

/// T⁻¹: from a spin to the change of the rotation vector.
pub fn inverse_tangent(v: &Vector3<f64>) -> Matrix3<f64> {
    let square = v.norm_squared();
    // (1 - (φ/2) cot(φ/2)) / φ²
    let k = if square < SMALL_RAD * SMALL_RAD {
        (1.0 + square / 60.0) / 12.0
    } else {
        let half = 0.5 * square.sqrt();
        (1.0 - half * libm::cos(half) / libm::sin(half)) / square
    };
    let s = skew(v);
    Matrix3::identity() - s * 0.5 + s * s * k
}

/// The change of T⁻ᵀ m with a spin, m held: the geometric part of a moment that works on the rotation vector.
pub fn moment_change(v: &Vector3<f64>, m: &Vector3<f64>) -> Matrix3<f64> {
    let square = v.norm_squared();
    let angle = square.sqrt();
    let (eta, mu) = if angle < SMALL_RAD {
        (1.0 / 12.0 + square / 720.0, 1.0 / 360.0 + square / 7560.0)
    } else {
        let (s, c, h) = (libm::sin(angle), libm::cos(angle), libm::sin(0.5 * angle));
        let eta = (2.0 * s - angle * (1.0 + c)) / (2.0 * square * s);
        (eta, (angle * (angle + s) - 8.0 * h * h) / (4.0 * square * square * h * h))
    };
    let k = skew(v);
    let sum = (v * m.transpose() - m * v.transpose() * 2.0 + Matrix3::identity() * v.dot(m)) * eta;
    let sum = sum + k * k * m * v.transpose() * mu - skew(m) * 0.5;
    sum * inverse_tangent(v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_logarithm_undoes_the_exponential_and_derivatives_hold() {
        let m = Vector3::new(0.3, -1.1, 0.7);
        for scale in [1e-9, 1e-3, 0.0199, 0.0201, 0.5, 2.0] {
            let v = Vector3::new(0.6, -0.64, 0.48) * scale;
            assert!((log(&exp(&v)) - v).norm() < 1e-12 * (1.0 + scale), "{scale}");
            let step = 1e-6;
            for axis in 0..3 {
                let spin = Vector3::from_fn(|i, _| if i == axis { step } else { 0.0 });
                let at = |s: Vector3<f64>| log(&(exp(&s) * exp(&v)));
                let slope = (at(spin) - at(-spin)) / (2.0 * step);
                assert!((slope - inverse_tangent(&v).column(axis)).norm() < 1e-8, "{scale}");
                let moment = |s: Vector3<f64>| inverse_tangent(&at(s)).transpose() * m;
                let slope = (moment(spin) - moment(-spin)) / (2.0 * step);
                assert!((slope - moment_change(&v, &m).column(axis)).norm() < 1e-8, "{scale} {slope} {}", moment_change(&v, &m));
            }
        }
    }
}
