//! Quantities that know their unit: a unit going in, a unit coming out.
//!
//! The design world is millimetre, gram and degree; plain `f64` fields carry the unit in their name
//! (`socket_depth_mm`). [`Angle`] and [`Density`] exist because degrees and radians, and g/cm³ and
//! g/mm³, are the two pairs that meet in one formula.

/// Gravity in all computations, m/s²: the value of the publication that the drops are compared with (the standard is 9.80665).
pub const GRAVITY_M_S2: f64 = 9.81;

/// The same in millimetres per millisecond squared, and in metres per second and millisecond.
pub const GRAVITY_MM_MS2: f64 = 9.81e-3;

/// An angle; made and read only with its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Angle(f64);

impl Angle {
    /// From radians.
    pub const fn rad(radians: f64) -> Self {
        Self(radians)
    }

    /// From degrees.
    pub fn deg(degrees: f64) -> Self {
        Self(degrees.to_radians())
    }

    /// In radians.
    pub const fn to_rad(self) -> f64 {
        self.0
    }

    /// In degrees.
    pub fn to_deg(self) -> f64 {
        self.0.to_degrees()
    }

    /// Sine, the same bits on every platform.
    pub fn sin(self) -> f64 {
        libm::sin(self.0)
    }

    /// Cosine, the same bits on every platform.
    pub fn cos(self) -> f64 {
        libm::cos(self.0)
    }

    /// Tangent, the same bits on every platform.
    pub fn tan(self) -> f64 {
        libm::tan(self.0)
    }
}

/// Mass per volume.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Density(f64);

impl Density {
    /// From grams per cubic centimetre, the unit of data sheets.
    pub const fn g_cm3(value: f64) -> Self {
        Self(value)
    }

    /// Mass in grams of a volume in cubic millimetres.
    pub fn mass_g(self, volume_mm3: f64) -> f64 {
        self.0 * volume_mm3 / 1000.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_cubic_centimetre_of_water_weighs_a_gram() {
        assert_eq!(Density::g_cm3(1.0).mass_g(1000.0), 1.0);
    }

    #[test]
    fn analytic_angle_units_meet() {
        assert!((Angle::deg(180.0).to_rad() - std::f64::consts::PI).abs() < 1e-15);
        assert!((Angle::rad(1.0).to_deg() - 57.295_779_513).abs() < 1e-9);
        assert!((Angle::deg(30.0).sin() - 0.5).abs() < 1e-15);
    }
}
