//! Where a run leaves the range in which its model is valid.

/// A validity warning.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ValidityWarning {
    /// The lowest body has reached the ground; the simulation ignores this contact.
    #[error("the gap of {gap_mm:.1} mm is used up after {t_ms:.2} ms at {speed_m_s:.2} m/s: from then on a rigid body hits the ground")]
    PastGap {
        /// The gap.
        gap_mm: f64,
        /// When.
        t_ms: f64,
        /// How fast.
        speed_m_s: f64,
    },
    /// The frame cannot be compressed so far.
    #[error("{x_mm:.1} mm is more than the {travel_mm:.1} mm by which the frame can be compressed")]
    PastTravel {
        /// Largest compression.
        x_mm: f64,
        /// What there is.
        travel_mm: f64,
    },
    /// A ground that pulls.
    #[error("from {t_ms:.2} ms on the model's ground pulls; unilateral_contact prevents this")]
    Pulls {
        /// When.
        t_ms: f64,
    },
    /// The reading stands at its limit.
    #[error("the sensor is at its limit of {limit_g:.1} g")]
    SensorLimit {
        /// The limit.
        limit_g: f64,
    },
    /// The ground still pushes when the run ends.
    #[error("the frame has not left the ground after {t_ms:.0} ms")]
    NoRelease {
        /// Length of the run.
        t_ms: f64,
    },
    /// The simulation diverges.
    #[error("the simulation diverges after {t_ms:.2} ms")]
    Diverges {
        /// When.
        t_ms: f64,
    },
    /// Forces that switch faster than the integrator can resolve.
    #[error("the forces switch faster than the integrator can resolve; stopped after {t_ms:.2} ms")]
    Chatters {
        /// When.
        t_ms: f64,
    },
    /// An effect is used outside its range of validity.
    #[error("{effect}: {reason}")]
    Effect {
        /// Which.
        effect: &'static str,
        /// Why.
        reason: String,
    },
    /// Nothing to fall.
    #[error("with its error the drop height is zero or less")]
    NoFall,
}

impl ValidityWarning {
    /// From when on the model is not valid, ms; none where that is no matter of time.
    pub fn t_ms(&self) -> Option<f64> {
        match self {
            Self::PastGap { t_ms, .. } | Self::Pulls { t_ms } | Self::Diverges { t_ms } | Self::Chatters { t_ms } => Some(*t_ms),
            Self::PastTravel { .. } | Self::SensorLimit { .. } | Self::NoRelease { .. } | Self::Effect { .. } | Self::NoFall => None,
        }
    }
}
