//! Mass that each foot carries itself: corners, motors and rods, which swing against the hub.
//!
//! A foot of mass m_f stands on its leg and is held by the body through a spring and a damper: on a body that is held it swings at f, with the
//! damping ratio zeta. It meets the ground before the body does, so each touch begins with a short blow and rings on. The moment of inertia
//! of the whole stays what it is: that of the body alone is less by share m r²/2. Source: the response of coupled oscillators (S. S. Rao,
//! *Mechanical Vibrations*, 5). *When it is wrong:* feet move along the body's axis only, and all four alike; the mass of rods lies between. Above
//! some 500 Hz the steps of a simulated landing are too long.

/// The effect's id.
pub const FOOT_MODE: &str = "foot_mode";

/// The mass of feet and how it is held.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct FootMode {
    /// Of all four feet, as a part of the whole mass.
    pub share: f64,
    /// Frequency of a foot on a body that is held, Hz.
    pub f_hz: f64,
    /// Damping over the critical one.
    pub zeta: f64,
}

/// What of it the motion needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct FootForces {
    /// Mass of a foot, kg.
    pub mass_kg: f64,
    /// Of the spring between a foot and the body, N/m.
    pub stiffness_n_m: f64,
    /// Of the damper beside it, N s/m.
    pub damping_n_s_m: f64,
}

impl FootMode {
    pub(super) fn forces(&self, whole_kg: f64) -> FootForces {
        let (mass_kg, w) = (0.25 * self.share * whole_kg, std::f64::consts::TAU * self.f_hz);
        FootForces { mass_kg, stiffness_n_m: mass_kg * w * w, damping_n_s_m: 2.0 * self.zeta * mass_kg * w }
    }
}
