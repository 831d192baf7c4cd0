//! A sensor whose axes lean against those of the body that it is fixed to.
//!
//! Fixed to the body, the sensor turns with its slopes: of the vertical acceleration it reads the cosine of the slope at that moment. That
//! holds for every sensor, has no parameter, and is in each landing ([`super::simulation`]). Gravity is in the reading, as a sensor shows
//! what pushes it: 0 in the fall. One that leans by an angle of its own reads a' = a cos w + b sin w along its axis, a being what a sensor
//! without a lean reads there, and b the lateral acceleration on the side to which the axis leans. Across, it reads b' = b cos w - a sin w. All
//! three are measured, so readings are turned back without a model of what acts sideways.
//!
//! *When it is wrong:* where the axes of the sensor are not at right angles, so that one picks up another's share and not the reverse.

/// The effect's id.
pub const ATTITUDE_SENSOR: &str = "attitude_sensor";

/// How the sensor's axis leans.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct SensorAttitude {
    /// Toward the body's x, rad.
    pub x_rad: f64,
    /// Toward the body's y, rad.
    pub y_rad: f64,
}

impl SensorAttitude {
    /// The whole lean, rad.
    pub fn lean_rad(&self) -> f64 {
        libm::hypot(self.x_rad, self.y_rad)
    }

    /// Readings along the body's x, y and axis, of those along the sensor's.
    pub fn turned_back(&self, [x, y, axis]: [&[f64]; 3]) -> [Vec<f64>; 3] {
        let lean_rad = self.lean_rad();
        if lean_rad == 0.0 {
            return [x, y, axis].map(<[f64]>::to_vec);
        }
        let ([ux, uy], (sin, cos)) = ([self.x_rad / lean_rad, self.y_rad / lean_rad], libm::sincos(lean_rad));
        let along = |at: usize| ux * x[at] + uy * y[at];
        // What the side to which it leans gains.
        let gained = |at: usize| (cos - 1.0) * along(at) + sin * axis[at];
        let each = |of: &dyn Fn(usize) -> f64| (0..axis.len()).map(of).collect::<Vec<f64>>();
        [each(&|at| x[at] + ux * gained(at)), each(&|at| y[at] + uy * gained(at)), each(&|at| cos * axis[at] - sin * along(at))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_sensor_that_leans_reads_cosine_and_sine() {
        let lean: f64 = 0.2;
        // Toward x: the axis reads cos of what pushes along the body's, x lacks its sine.
        let sensor = SensorAttitude { x_rad: lean, y_rad: 0.0 };
        let [x, y, axis] = sensor.turned_back([&[-100.0 * libm::sin(lean)], &[0.0], &[100.0 * libm::cos(lean)]]);
        assert!(x[0].abs() < 1e-12 && y[0].abs() < 1e-12 && (axis[0] - 100.0).abs() < 1e-12, "{x:?} {y:?} {axis:?}");
        let [x, _, axis] = sensor.turned_back([&[70.0 * libm::cos(lean)], &[0.0], &[70.0 * libm::sin(lean)]]);
        assert!((x[0] - 70.0).abs() < 1e-12 && axis[0].abs() < 1e-12, "{x:?} {axis:?}");
    }

    #[test]
    fn analytic_turning_back_keeps_the_magnitude_and_is_undone_by_the_opposite_lean() {
        let read = [[3.0, -40.0], [25.0, 8.0], [90.0, 130.0]];
        let sensor = SensorAttitude { x_rad: 0.07, y_rad: -0.11 };
        let body = sensor.turned_back([&read[0], &read[1], &read[2]]);
        let again = SensorAttitude { x_rad: -0.07, y_rad: 0.11 }.turned_back([&body[0], &body[1], &body[2]]);
        for at in 0..2 {
            let size = |axes: &[f64; 3]| axes.iter().map(|one| one * one).sum::<f64>().sqrt();
            let [before, after] = [[0, 1, 2].map(|axis: usize| read[axis][at]), [0, 1, 2].map(|axis: usize| body[axis][at])];
            assert!((size(&before) - size(&after)).abs() < 1e-9);
            assert!((0..3).all(|axis| (again[axis][at] - read[axis][at]).abs() < 1e-9), "{again:?}");
        }
    }

    #[test]
    fn analytic_without_a_lean_readings_stay_to_the_last_bit() {
        let read = [[0.1, 1.0 / 3.0], [2.0_f64.sqrt(), -7.7], [123.456, 0.0]];
        assert_eq!(SensorAttitude::default().turned_back([&read[0], &read[1], &read[2]]), read.map(|axis| axis.to_vec()));
    }
}
