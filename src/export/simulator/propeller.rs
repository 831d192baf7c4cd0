//! What is known of a propeller, and what is estimated.
//!
//! Thrust is T = C_T ρ n² D⁴ and power P = C_P ρ n³ D⁵ (the definitions of the UIUC propeller data base), and torque is
//! P / (2 π n), so Q / T = C_P / (2 π C_T) D, whatever the speed. Of the propellers of the catalogue neither coefficient is known, so
//! C_P / (2 π C_T) is an estimate: 0.065 for the APC Slow Flyer 10 x 4.7 at 4029 rpm (UIUC: C_T = 0.1136, C_P = 0.0466), 0.13 for the
//! 45 mm propeller of the Crazyflie 2.0 (J. Förster, *System Identification of the Crazyflie 2.0 Nano Quadrocopter*, ETH Zürich, 2015:
//! Q = 0.005965 m T). Propellers of 65 to 100 mm are between them: 0.1, which may be wrong by a third.

/// C_P / (2 π C_T): an estimate, see above.
pub const TORQUE_OVER_THRUST: f64 = 0.1;

/// Torque over thrust of a propeller of this diameter, m.
pub fn torque_over_thrust_m(diameter_m: f64) -> f64 {
    TORQUE_OVER_THRUST * diameter_m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_the_estimate_is_between_the_two_propellers_that_were_measured() {
        let apc = 0.0466 / (std::f64::consts::TAU * 0.1136);
        let crazyflie = 0.005_964_552 / 0.045;
        assert!(apc < TORQUE_OVER_THRUST && TORQUE_OVER_THRUST < crazyflie, "{apc} {crazyflie}");
        assert!((crazyflie / apc).sqrt() < 1.45, "the middle is not wrong by more than a half");
    }
}
