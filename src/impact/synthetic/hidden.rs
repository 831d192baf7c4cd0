//! Effects outside the catalogue.

/// A truth outside the catalogue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hidden {
    /// A second spring from `x1_m` on that gives back a part of its force only on the way up.
    TwoStage {
        /// Where it begins, m.
        x1_m: f64,
        /// Its stiffness, N/m.
        stiffness_n_m: f64,
        /// Part of its force that is lost on the way up, 0 to 1.
        loss: f64,
    },
    /// Two payloads on the frame, each on a spring of its own.
    TwoModes {
        /// Each one's share of the whole mass.
        shares: [f64; 2],
        /// Each one's frequency on a frame that is held, Hz.
        f_hz: [f64; 2],
        /// Damping ratio of both.
        zeta: f64,
    },
    /// The spring's stiffness falls in proportion to the drops already made; its mean is that of the model.
    Wear {
        /// Fall from the first to the last drop, part of the stiffness.
        loss: f64,
    },
    /// A member snaps through: once the compression has passed `x1_m`, the spring has lost a part for the rest of the drop.
    Snap {
        /// Where it snaps, m.
        x1_m: f64,
        /// Part of the stiffness that is lost.
        loss: f64,
    },
}

impl Hidden {
    /// Names in plans.
    pub const NAMES: [&str; 4] = ["two_stage", "two_modes", "wear", "snap"];

    /// Its numbers, by their keys in a plan.
    pub fn numbers(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::TwoStage { x1_m, stiffness_n_m, loss } => vec![("x1_mm", x1_m * 1e3), ("stiffness_n_m", stiffness_n_m), ("loss", loss)],
            Self::TwoModes { shares, f_hz, zeta } => {
                vec![("share_1", shares[0]), ("share_2", shares[1]), ("f_1_hz", f_hz[0]), ("f_2_hz", f_hz[1]), ("zeta", zeta)]
            }
            Self::Wear { loss } => vec![("loss", loss)],
            Self::Snap { x1_m, loss } => vec![("x1_mm", x1_m * 1e3), ("loss", loss)],
        }
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::TwoStage { .. } => Self::NAMES[0],
            Self::TwoModes { .. } => Self::NAMES[1],
            Self::Wear { .. } => Self::NAMES[2],
            Self::Snap { .. } => Self::NAMES[3],
        }
    }
}
