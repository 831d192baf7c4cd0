//! One case an effect, for every test that needs each effect at work.

/// An effect with values at which it shows.
pub struct Case {
    /// Its id.
    pub id: &'static str,
    /// What a plan of synthetic drops states of it, for the recovery tests; `None` where a diagnosis needs a frame's curve
    /// (tests/impact/frame_curve.rs).
    pub planned: Option<&'static str>,
    /// Values and index of the word at which generator and simulation are compared.
    pub compared: &'static [(&'static [f64], usize)],
}

/// Every effect that can come on top of the base, in the order of the catalogue.
pub const CASES: [Case; 17] = [
    Case { id: "unilateral_contact", planned: Some("tension_factor = 0.0"), compared: &[(&[0.3], 0)] },
    Case { id: "bottoming", planned: Some("x_b_mm = 9.0\nk_b = 6e5"), compared: &[(&[9.0, 3e6, 0.3], 0)] },
    Case { id: "cubic_stiffness", planned: Some("k3 = 9e6"), compared: &[(&[-3.5e6], 0), (&[3e7], 0)] },
    Case { id: "bilinear_stiffness", planned: Some("x1_mm = 6.0\nk_bl = 6e3"), compared: &[(&[8.0, 9e3], 0)] },
    Case { id: "hunt_crossley_damping", planned: Some("chi = 1.5e3"), compared: &[(&[3e3], 0)] },
    Case { id: "coulomb_friction", planned: Some("f_c_n = 14.0"), compared: &[(&[20.0], 0)] },
    Case { id: "maxwell_branch", planned: Some("k_m = 9e3\ntau_ms = 2.8"), compared: &[(&[9e3, 2.5], 0)] },
    Case { id: "quadratic_damping", planned: Some("c2 = 7.0"), compared: &[(&[9.0], 0)] },
    Case { id: "preload", planned: Some("f0_n = 8.0"), compared: &[(&[20.0], 0)] },
    Case { id: "sensor_low_pass", planned: Some("cutoff_hz = 55.0"), compared: &[(&[200.0], 0)] },
    Case { id: "sensor_saturation", planned: Some("limit_g = 45.0"), compared: &[(&[40.0], 0)] },
    Case { id: "sensor_gain", planned: Some("gain = 0.8"), compared: &[(&[1.2], 0)] },
    Case { id: "payload_mode", planned: Some("mu = 0.12\nf_hz = 120.0"), compared: &[(&[0.2, 120.0, 0.05], 0), (&[0.2, 120.0, 0.05], 1)] },
    Case { id: "foot_stagger", planned: Some("delta_mm = 7.0"), compared: &[(&[6.0], 0)] },
    Case { id: "drop_height_error", planned: Some("dh_m = -0.2"), compared: &[(&[-0.1], 0)] },
    Case { id: "air_drag", planned: Some("beta = 0.35"), compared: &[(&[0.2], 0)] },
    Case { id: "frame_force_curve", planned: None, compared: &[(&[0.8], 0)] },
];
