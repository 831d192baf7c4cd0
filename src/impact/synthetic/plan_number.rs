//! The plain numbers of a plan of synthetic drops.

use crate::params::ImpactFile;
use crate::params::refusal::{Reason, Refusal};

/// A plain number of a plan.
#[derive(Clone, Copy, Debug)]
pub struct PlanNumber {
    /// Its key.
    pub key: &'static str,
    /// Least and largest value.
    pub bounds: [f64; 2],
    /// Its unit; `1` for none.
    pub unit: &'static str,
    /// What it is where nothing is stated; `None` where it has to be.
    pub default: Option<f64>,
}

impl PlanNumber {
    const fn optional(key: &'static str, bounds: [f64; 2], unit: &'static str, default: f64) -> Self {
        Self { key, bounds, unit, default: Some(default) }
    }

    const fn stated(key: &'static str, bounds: [f64; 2], unit: &'static str) -> Self {
        Self { key, bounds, unit, default: None }
    }

    /// What a plan states, or the default.
    ///
    /// # Errors
    /// When it is no number, out of bounds, or missing without a default.
    pub fn read(&self, file: &ImpactFile) -> Result<f64, Refusal> {
        match self.default {
            Some(default) => Ok(file.number(self.key, self.bounds, self.unit)?.unwrap_or(default)),
            None => file.stated(self.key, self.bounds, self.unit),
        }
    }

    /// The same of a number that counts.
    ///
    /// # Errors
    /// As [`Self::read`], and when it is no whole number.
    pub fn read_whole(&self, file: &ImpactFile) -> Result<u64, Refusal> {
        let value = self.read(file)?;
        let message = || format!("`{}` = {value} is no whole number", self.key);
        let reason = || Reason::Impossible { message: message(), remedy: "give a whole number".into() };
        if value.fract() == 0.0 { Ok(value as u64) } else { Err(file.refuse(self.key, reason())) }
    }
}

/// One by one.
impl PlanNumber {
    pub(super) const DROPS_COUNT: Self = Self::optional("drops.count", [2.0, 100_000.0], "1", 20.0);
    pub(super) const DROPS_SEED: Self = Self::optional("drops.seed", [0.0, 9e15], "1", 1.0);
    pub(super) const SCATTER_SHARE: Self = Self::optional("scatter.share", [0.0, 2.0], "1", 0.1);
    pub(super) const SCATTER_CORRELATION_MS: Self = Self::optional("scatter.correlation_ms", [0.01, 1000.0], "ms", 1.5);
    pub(super) const SCATTER_STIFFNESS: Self = Self::optional("scatter.stiffness", [0.0, 0.5], "1", 0.0);
    pub(super) const SCATTER_DAMPING: Self = Self::optional("scatter.damping", [0.0, 0.5], "1", 0.0);
    pub(super) const SCATTER_TILT_DEG: Self = Self::optional("scatter.tilt_deg", [0.0, 45.0], "deg", 0.0);
    pub(super) const LOGGER_NOISE_G: Self = Self::optional("logger.noise_g", [0.0, 50.0], "g", 0.17);
    pub(super) const LOGGER_COUNTS_PER_G: Self = Self::optional("logger.counts_per_g", [0.1, 1e6], "1/g", 8.877);
    pub(super) const LOGGER_RATE_HZ: Self = Self::optional("logger.rate_hz", [200.0, 200_000.0], "Hz", 1000.0);
    pub(super) const LOGGER_RECORD_S: Self = Self::optional("logger.record_s", [0.0, 20.0], "s", 0.0);
    pub(super) const LOGGER_STALL_MS: Self = Self::optional("logger.stall_ms", [0.0, 1000.0], "ms", 0.0);
    pub(super) const LOGGER_SECTOR_SAMPLES: Self = Self::optional("logger.sector_samples", [50.0, 1e6], "1", 409.6);
    pub(super) const LOGGER_CATCH_UP: Self = Self::optional("logger.catch_up", [1.1, 100.0], "1", 2.7);
    pub(super) const LANDING_RATE_RAD_S: Self = Self::optional("landing.rate_rad_s", [0.0, 3.0], "rad/s", 0.0);
    pub(super) const LANDING_AT_RELEASE_RAD: Self = Self::optional("landing.at_release_rad", [0.0, 0.5], "rad", 0.0);
    pub(super) const LANDING_INERTIA_KG_M2: Self = Self::optional("landing.inertia_kg_m2", [1e-5, 0.1], "kg m2", 8e-4);
    pub(super) const LANDING_FOOT_RADIUS_MM: Self = Self::optional("landing.foot_radius_mm", [20.0, 1000.0], "mm", 144.5);
    pub(super) const LANDING_FOOT_SHARE: Self = Self::optional("landing.foot_share", [0.0, 0.6], "1", 0.0);
    pub(super) const LANDING_FOOT_F_HZ: Self = Self::optional("landing.foot_f_hz", [20.0, 2000.0], "Hz", 250.0);
    pub(super) const LANDING_FOOT_ZETA: Self = Self::optional("landing.foot_zeta", [0.0, 2.0], "1", 0.05);
    pub(super) const LANDING_GROUND_FRICTION: Self = Self::optional("landing.ground_friction", [0.0, 2.0], "1", 0.0);
    pub(super) const LANDING_TOUCH_G: Self = Self::optional("landing.touch_g", [0.0, 500.0], "g", 0.0);
    pub(super) const LANDING_RINGING_G: Self = Self::optional("landing.ringing_g", [0.0, 500.0], "g", 0.0);
    pub(super) const LANDING_SENSOR_LEAN_X_DEG: Self = Self::optional("landing.sensor_lean_x_deg", [-30.0, 30.0], "deg", 0.0);
    pub(super) const LANDING_SENSOR_LEAN_Y_DEG: Self = Self::optional("landing.sensor_lean_y_deg", [-30.0, 30.0], "deg", 0.0);
    pub(super) const HIDDEN_LOSS: Self = Self::optional("hidden.loss", [0.0, 1.0], "1", 0.5);
    pub(super) const HIDDEN_X1_MM: Self = Self::stated("hidden.x1_mm", [0.1, 60.0], "mm");
    pub(super) const HIDDEN_STIFFNESS_N_M: Self = Self::stated("hidden.stiffness_n_m", [0.0, 1e6], "N/m");
    pub(super) const HIDDEN_SHARE_1: Self = Self::stated("hidden.share_1", [0.0, 0.45], "1");
    pub(super) const HIDDEN_SHARE_2: Self = Self::stated("hidden.share_2", [0.0, 0.45], "1");
    pub(super) const HIDDEN_F_1_HZ: Self = Self::stated("hidden.f_1_hz", [20.0, 1000.0], "Hz");
    pub(super) const HIDDEN_F_2_HZ: Self = Self::stated("hidden.f_2_hz", [20.0, 1000.0], "Hz");
    pub(super) const HIDDEN_ZETA: Self = Self::stated("hidden.zeta", [0.005, 1.5], "1");
}

/// All of them.
pub const PLAN_NUMBERS: [PlanNumber; 34] = [
    PlanNumber::DROPS_COUNT,
    PlanNumber::DROPS_SEED,
    PlanNumber::SCATTER_SHARE,
    PlanNumber::SCATTER_CORRELATION_MS,
    PlanNumber::SCATTER_STIFFNESS,
    PlanNumber::SCATTER_DAMPING,
    PlanNumber::SCATTER_TILT_DEG,
    PlanNumber::LOGGER_NOISE_G,
    PlanNumber::LOGGER_COUNTS_PER_G,
    PlanNumber::LOGGER_RATE_HZ,
    PlanNumber::LOGGER_RECORD_S,
    PlanNumber::LOGGER_STALL_MS,
    PlanNumber::LOGGER_SECTOR_SAMPLES,
    PlanNumber::LOGGER_CATCH_UP,
    PlanNumber::LANDING_RATE_RAD_S,
    PlanNumber::LANDING_AT_RELEASE_RAD,
    PlanNumber::LANDING_INERTIA_KG_M2,
    PlanNumber::LANDING_FOOT_RADIUS_MM,
    PlanNumber::LANDING_FOOT_SHARE,
    PlanNumber::LANDING_FOOT_F_HZ,
    PlanNumber::LANDING_FOOT_ZETA,
    PlanNumber::LANDING_GROUND_FRICTION,
    PlanNumber::LANDING_TOUCH_G,
    PlanNumber::LANDING_RINGING_G,
    PlanNumber::LANDING_SENSOR_LEAN_X_DEG,
    PlanNumber::LANDING_SENSOR_LEAN_Y_DEG,
    PlanNumber::HIDDEN_LOSS,
    PlanNumber::HIDDEN_X1_MM,
    PlanNumber::HIDDEN_STIFFNESS_N_M,
    PlanNumber::HIDDEN_SHARE_1,
    PlanNumber::HIDDEN_SHARE_2,
    PlanNumber::HIDDEN_F_1_HZ,
    PlanNumber::HIDDEN_F_2_HZ,
    PlanNumber::HIDDEN_ZETA,
];
