//! What a population's fit moves: legs, their friction, feet, a mount of the sensor, slopes.

use super::touched_slopes;
use crate::impact::fit::NORMAL_97_5;

/// What is fitted.
pub struct Parameter {
    /// Key.
    pub key: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Bounds.
    pub bounds: [f64; 2],
    /// Step of difference quotients, on the scale of the fit.
    pub step: f64,
    /// Where a fit begins.
    pub start: f64,
    /// What it belongs to.
    pub kind: ParameterKind,
    /// Standard deviation of what the method itself is off, as a share of the value: what synthetic sets of a generator that shares no
    /// equation with this model show beyond how their drops vary (docs/diagnosis.md). 0 where it was not measured.
    method: f64,
}

/// Legs, feet and mount are fitted as logarithms, friction and slopes as they are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum ParameterKind {
    /// Of the legs and the body on them.
    Leg,
    /// Of the legs' dry friction.
    Friction,
    /// Of the feet's own mass.
    Feet,
    /// Of what carries the sensor.
    Mount,
    /// Of the random slopes.
    Slope,
}

impl ParameterKind {
    /// Whether it is of an effect that may be there beside legs and slopes.
    pub fn is_beside_slopes(self) -> bool {
        matches!(self, Self::Friction | Self::Feet | Self::Mount)
    }
}

impl Parameter {
    const fn new(key: &'static str, unit: &'static str, bounds: [f64; 2], step: f64, start: f64, kind: ParameterKind) -> Self {
        Self { key, unit, bounds, step, start, kind, method: 0.0 }
    }

    const fn off_by(self, method: f64) -> Self {
        Self { method, ..self }
    }

    /// Standard deviation of what the method is off at a value, both on the scale of the fit. Friction of the legs and damping beside it trade
    /// with each other.
    pub fn method_at(&self, scaled: f64, rubbing: bool) -> f64 {
        let trades = rubbing && [PARAMETERS[DAMPING].key, PARAMETERS[LEGS].key].contains(&self.key);
        self.unit_at(scaled) * if trades { BESIDE_FRICTION } else { self.method }
    }

    /// What of a damper's force the method is off, with 95 %, as a share.
    pub fn damping_off() -> f64 {
        NORMAL_97_5 * PARAMETERS[DAMPING].method
    }

    /// A share of a value, on the scale of the fit.
    fn unit_at(&self, scaled: f64) -> f64 {
        if self.is_logarithmic() { 1.0 } else { scaled }
    }

    /// A 95 % interval of changes by how drops vary, widened by what the method is off, in standard deviations, all on the scale of the fit.
    pub fn with_method([low, high]: [f64; 2], deviation: f64) -> [f64; 2] {
        let off = NORMAL_97_5 * deviation;
        [-libm::hypot(low.min(0.0), off), libm::hypot(high.max(0.0), off)]
    }

    /// A value on the scale of the fit.
    pub fn inward(&self, value: f64) -> f64 {
        if self.is_logarithmic() { libm::log(value) } else { value }
    }

    /// A value from the scale of the fit.
    pub fn outward(&self, scaled: f64) -> f64 {
        if self.is_logarithmic() { libm::exp(scaled) } else { scaled }
    }

    fn is_logarithmic(&self) -> bool {
        matches!(self.kind, ParameterKind::Leg | ParameterKind::Feet | ParameterKind::Mount)
    }
}

/// Legs, their friction, feet, mount, slopes, in this order; friction, feet and mount may be left out.
pub static PARAMETERS: [Parameter; 11] = [
    Parameter::new("k", "N/m", [300.0, 5e5], 0.02, 1.5e4, ParameterKind::Leg).off_by(0.03),
    Parameter::new("c", "N s/m", [0.05, 1000.0], 0.02, 25.0, ParameterKind::Leg).off_by(0.07),
    Parameter::new("inertia_kg_m2", "kg m2", [2e-5, 5e-2], 0.02, 1e-3, ParameterKind::Leg).off_by(0.115),
    Parameter::new("f_c_n", "N", [0.0, 200.0], 1.0, 0.0, ParameterKind::Friction),
    Parameter::new("foot_share", "1", [0.01, 0.6], 0.05, FEET_START[0], ParameterKind::Feet),
    Parameter::new("foot_f_hz", "Hz", [50.0, 500.0], 0.02, 200.0, ParameterKind::Feet),
    Parameter::new("foot_zeta", "1", [0.002, 1.5], 0.1, FEET_START[1], ParameterKind::Feet),
    Parameter::new("f_hz", "Hz", [50.0, 1500.0], 0.02, 160.0, ParameterKind::Mount),
    Parameter::new("zeta", "1", [0.02, 1.5], 0.02, MOUNT_ZETA, ParameterKind::Mount),
    Parameter::new("sigma_r_rad_s", "rad/s", touched_slopes::BOUNDS[0], touched_slopes::STEPS[0], 0.0, ParameterKind::Slope).off_by(0.06),
    Parameter::new(RELEASE, "rad", touched_slopes::BOUNDS[1], touched_slopes::STEPS[1], 0.0, ParameterKind::Slope),
];
/// Key of the slope at release.
pub const RELEASE: &str = "sigma_0_rad";
/// The place of their damping.
const DAMPING: usize = 1;
/// How many are the legs' without friction, and the place of friction.
pub const LEGS: usize = 3;
/// How many are the mount's, which stand just before the slopes.
pub const MOUNTS: usize = 2;
/// Share and damping ratio at which a fit with heavy feet begins.
pub const FEET_START: [f64; 2] = [0.12, 0.1];
/// Frequencies at which it begins, Hz.
pub const FEET_HZ: [f64; 2] = [150.0, 250.0];
/// What the method is off of friction, and of damping beside it, as a share: the two resist alike, and in 48 synthetic sets with 50 N of friction
/// it is found 19 % too large in mean, and damping 18 % too small.
const BESIDE_FRICTION: f64 = 0.2;
/// Damping ratio at which a fit with a mount begins.
pub const MOUNT_ZETA: f64 = 0.3;
/// Frequencies at which a fit with a mount begins, Hz.
pub const MOUNTS_HZ: [f64; 2] = [120.0, 200.0];
/// Friction at which a fit begins, N.
pub const FRICTION_N: f64 = 15.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::by_id;
    use crate::impact::landing::legged_body::COULOMB_FRICTION;

    #[test]
    fn analytic_the_friction_of_legs_is_the_effect_of_the_catalogue() {
        let spec = by_id(COULOMB_FRICTION).expect("is in the catalogue");
        let own = PARAMETERS.iter().find(|parameter| parameter.kind == ParameterKind::Friction).expect("is fitted");
        let [of_catalogue] = spec.parameters else { panic!("has one number") };
        assert_eq!((own.key, own.unit, own.bounds[0]), (of_catalogue.key, of_catalogue.unit, of_catalogue.min));
    }

    #[test]
    fn analytic_what_the_method_is_off_adds_to_an_interval_in_squares() {
        let of = |key: &str| PARAMETERS.iter().find(|parameter| parameter.key == key).expect("is fitted");
        let with_method = |key: &str, spread: [f64; 2], scaled: f64| Parameter::with_method(spread, of(key).method_at(scaled, false));
        let [low, high] = with_method("k", [-0.04, 0.08], 10.0);
        let off = NORMAL_97_5 * of("k").method;
        assert!((low * low - 0.04 * 0.04 - off * off).abs() < 1e-12 && low < 0.0);
        assert!((high * high - 0.08 * 0.08 - off * off).abs() < 1e-12);
        assert_eq!(PARAMETERS[DAMPING].key, "c");
        assert_eq!((PARAMETERS[LEGS].key, PARAMETERS[LEGS].unit_at(50.0)), ("f_c_n", 50.0));
        // Beside each other, friction and damping are off by more than damping alone.
        assert_eq!([of("f_c_n"), of("c")].map(|one| one.method_at(2.0, true)), [2.0 * BESIDE_FRICTION, BESIDE_FRICTION]);
        assert_eq!(of("k").method_at(2.0, true), of("k").method_at(2.0, false));
        // Of a slope it is a share of the slope.
        let [low, _] = with_method("sigma_r_rad_s", [0.0, 0.0], 0.5);
        assert!((low + 0.5 * NORMAL_97_5 * of("sigma_r_rad_s").method).abs() < 1e-12);
        assert_eq!(with_method("f_hz", [-0.1, 0.2], 5.0), [-0.1, 0.2]);
    }
}
