//! Where a run leaves what the model can say.

/// A mark.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Outside {
    /// What hangs lowest has met the ground; the model goes on as if it had not.
    #[error("the gap of {gap_mm:.1} mm is used up after {t_ms:.2} ms at {speed_m_s:.2} m/s: from there on something rigid hits the ground")]
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
    /// A ground that holds the frame back.
    #[error("from {t_ms:.2} ms on the ground pulls, as none does (unilateral_contact lets go)")]
    Pulls {
        /// When.
        t_ms: f64,
    },
    /// The reading stands at its limit.
    #[error("the sensor stands at its limit of {limit_g:.1} g")]
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
    /// The forces do not hold the body.
    #[error("the forces do not hold the body: it ran away after {t_ms:.2} ms")]
    RanAway {
        /// When.
        t_ms: f64,
    },
    /// Forces that chatter.
    #[error("the forces change faster than can be followed; stopped after {t_ms:.2} ms")]
    Chatters {
        /// When.
        t_ms: f64,
    },
    /// An effect is used where it does not hold.
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
