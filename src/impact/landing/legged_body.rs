//! What lands: a rigid body on four legs, and how its slope varies between drops.

use super::foot_mode::FootMode;
use super::sensor_mount::SensorMount;
use crate::impact::effects::Model;

/// From the hub's axis to a foot of CogniFly v8, m. Source: its parts as measured; 0.14 m to the middle of the foot's contact.
pub const COGNIFLY_FOOT_RADIUS_M: f64 = 0.1445;

/// Id of the friction of legs: that of the effect of the catalogue, which acts in each leg here.
pub const COULOMB_FRICTION: &str = "coulomb_friction";

/// From the lower ring up to the arms of CogniFly v8, m, near which the centre of mass lies.
pub const COGNIFLY_CENTRE_HEIGHT_M: f64 = 0.043;

/// A rigid body with a foot at each end of two diagonals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeggedBody {
    /// Mass, kg.
    pub mass_kg: f64,
    /// From the vertical axis to each foot, m.
    pub foot_radius_m: f64,
    /// From the feet up to the centre of mass, m.
    pub centre_height_m: f64,
}

impl LeggedBody {
    /// A model's body; without a frame it has CogniFly's feet. The centre of mass is taken in the plane of the arms. `None` where the
    /// feet do not stand on a square.
    pub fn of(model: &Model) -> Option<Self> {
        let foot_radius_m = model.body.feet.map_or(Some(COGNIFLY_FOOT_RADIUS_M), |feet| feet.square_radius_m())?;
        let centre_height_m = model.body.travel_m.unwrap_or(COGNIFLY_CENTRE_HEIGHT_M);
        Some(Self { mass_kg: model.body.mass_kg, foot_radius_m, centre_height_m })
    }
}

/// The legs: each carries a quarter, pushes and never pulls; and what carries the sensor.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Legs {
    /// Stiffness of all four together, N/m.
    pub stiffness_n_m: f64,
    /// Damping of all four together, N s/m.
    pub damping_n_s_m: f64,
    /// Dry friction of all four together, against the speed at which each is pressed, N; 0 for none.
    pub friction_n: f64,
    /// Moment of inertia about a horizontal axis, with the feet, kg m².
    pub inertia_kg_m2: f64,
    /// Mass of the feet themselves; `None` for legs without mass.
    pub feet: Option<FootMode>,
    /// What carries the sensor; `None` for one that is fixed to the body.
    pub mount: Option<SensorMount>,
}

/// How the landing's slope varies between drops: along each diagonal a normal quantity with mean 0.
///
/// Part of it grows with the fall, as that of a body that turns from its release on; part of it does not.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Slopes {
    /// Standard deviation of the turning rate at release, a diagonal, rad/s.
    pub rate_rad_s: f64,
    /// Standard deviation of the slope at release, a diagonal, rad.
    pub at_release_rad: f64,
}

impl Slopes {
    /// Whether one of both is none.
    pub fn has_none(&self) -> bool {
        self.rate_rad_s == 0.0 || self.at_release_rad == 0.0
    }

    /// Standard deviation of the slope along a diagonal after a fall, rad.
    pub fn deviation_rad(&self, fall_s: f64) -> f64 {
        libm::hypot(self.rate_rad_s * fall_s, self.at_release_rad)
    }

    /// Turning rate over slope, 1/s, of landings after a fall: the mean of those that have the same slope. Where no slopes are known, they have grown
    /// while the body fell.
    pub fn turning_1_s(&self, fall_s: f64) -> f64 {
        let share = self.rate_rad_s * fall_s / self.deviation_rad(fall_s);
        if share.is_nan() { 1.0 / fall_s } else { share * share / fall_s }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Slope = rate times time + slope at release, both normal: the mean rate at a slope is its covariance with the slope over the slope's variance.
        #[test]
        fn analytic_landings_of_one_slope_turn_as_their_mean(rate in 0.0_f64..1.5, release in 0.001_f64..0.25, fall_s in 0.2_f64..0.8) {
            let of = |rate_rad_s: f64, at_release_rad: f64| Slopes { rate_rad_s, at_release_rad }.turning_1_s(fall_s);
            let expected = rate * rate * fall_s / (rate * rate * fall_s * fall_s + release * release);
            prop_assert!((of(rate, release) - expected).abs() < 1e-9 * (1.0 + expected));
            // What turned alone has turned all the while; what did not turn does not.
            prop_assert!((of(rate + 0.01, 0.0) * fall_s - 1.0).abs() < 1e-12 && of(0.0, release) == 0.0);
            prop_assert_eq!(of(0.0, 0.0), 1.0 / fall_s);
        }
    }
}
