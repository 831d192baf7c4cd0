//! The drop written down a second time, straight from the table of effects, for another integrator: DOP853 of ode_solvers.

use flexframe::impact::body::{DropBody, Origin};
use flexframe::impact::effects::{Channel, Model, Sensor, by_id};
use ode_solvers::{Dop853, OutputType, SVector, System as Equations};

pub const G: f64 = 9.81;
pub const MASS_KG: f64 = 0.241;
pub const K: f64 = 7040.0;
pub const C: f64 = 46.0;
const CUTOFF_HZ: f64 = 500.0;

/// x, v, low-pass, Maxwell force, payload's lag and its rate.
type State = SVector<f64, 6>;

/// The base model, with a gap that is never used up.
pub fn base() -> Model {
    let body = DropBody { mass_kg: MASS_KG, gap_m: 1.0, travel_m: None, feet: None, origin: Origin::Model("test".into()) };
    Model::base(body, Sensor::new(CUTOFF_HZ, 1, 1e5, Channel::Axial), K, C)
}

/// The base model with these effects.
pub fn model(effects: &[(&str, &[f64])]) -> Model {
    effects.iter().fold(base(), |model, (id, values)| model.with(by_id(id).expect("is in the catalogue"), values, 0))
}

/// The equations of the table; feet are those that touch now, so it holds on the way down.
pub struct Table<'a> {
    effects: &'a [(&'a str, &'a [f64])],
}

impl<'a> Table<'a> {
    pub fn new(effects: &'a [(&'a str, &'a [f64])]) -> Self {
        Self { effects }
    }

    fn of(&self, id: &str) -> Option<&'a [f64]> {
        self.effects.iter().find(|(known, _)| *known == id).map(|(_, values)| *values)
    }

    fn one(&self, id: &str) -> f64 {
        self.of(id).map_or(0.0, |values| values[0])
    }

    /// Ground's force, without the payload.
    fn force(&self, x: f64, v: f64, q: f64) -> f64 {
        let delta = self.one("foot_stagger") * 1e-3;
        let mut sum = 0.0;
        for foot in 0..4 {
            let at = delta * f64::from(foot) / 3.0;
            if x.max(0.0) >= at {
                sum += 0.25 * (K * (x - at) + C * v);
            }
        }
        sum += self.one("cubic_stiffness") * x.powi(3) + self.one("hunt_crossley_damping") * x * v + q;
        sum += self.one("coulomb_friction") * (v / 0.05).tanh() + self.one("quadratic_damping") * v * v.abs();
        sum += self.one("preload") * (x / 0.2e-3).tanh();
        if let Some(&[x1_mm, k_bl]) = self.of("bilinear_stiffness") {
            sum += k_bl * (x - x1_mm * 1e-3).max(0.0);
        }
        if let Some(&[tau]) = self.of("unilateral_contact")
            && (sum < 0.0 || x < 0.0)
        {
            sum *= tau;
        }
        if let Some(&[x_b_mm, k_b, lambda]) = self.of("bottoming") {
            sum += (k_b * (x - x_b_mm * 1e-3).max(0.0).powf(1.5) * (1.0 + 1.5 * lambda * v)).max(0.0);
        }
        sum
    }

    fn cutoff_hz(&self) -> f64 {
        self.of("sensor_low_pass").map_or(CUTOFF_HZ, |values| values[0])
    }
}

impl Equations<f64, State> for Table<'_> {
    fn system(&self, _t: f64, y: &State, dy: &mut State) {
        let (x, v, q) = (y[0], y[1], y[3]);
        let force = self.force(x, v, q);
        let [mu, f_hz, zeta] = self.of("payload_mode").map_or([0.0, 1.0, 0.0], |v| [v[0], v[1], v[2]]);
        let circular = 2.0 * std::f64::consts::PI * f_hz;
        let payload = circular * circular * y[4] + 2.0 * zeta * circular * y[5];
        let proper = (force - mu * MASS_KG * payload) / ((1.0 - mu) * MASS_KG);
        dy[0] = v;
        dy[1] = G - proper;
        dy[2] = 2.0 * std::f64::consts::PI * self.cutoff_hz() * (proper - y[2]);
        dy[3] = self.of("maxwell_branch").map_or(0.0, |values| values[0] * v - q / (values[1] * 1e-3));
        dy[4] = y[5];
        dy[5] = if mu > 0.0 { G - payload - dy[1] } else { 0.0 };
    }
}

/// Compression in m and the low-pass's output in g at a time after first touch.
pub fn reference(table: Table, height_m: f64, t_s: f64) -> [f64; 2] {
    let start = State::from([0.0, (2.0 * G * height_m).sqrt(), 0.0, 0.0, 0.0, 0.0]);
    // Every step is put out: its dense output takes the end from the first step when no other point comes before.
    let mut solver = Dop853::from_param(
        table,
        0.0,
        t_s,
        t_s,
        start,
        1e-12,
        1e-13,
        0.9,
        0.0,
        0.333,
        6.0,
        t_s,
        1e-6,
        1_000_000,
        1_000_000,
        OutputType::Sparse,
    );
    solver.integrate().expect("integrates");
    let (end_s, end) = (solver.x_out().last().expect("has an end"), solver.y_out().last().expect("has an end"));
    assert!((end_s - t_s).abs() < 1e-12, "it ended at {end_s} s instead of {t_s} s");
    [end[0], end[2] / G]
}

/// The same at the tolerance of fits with DOPRI5 and its dense output in steps of 0.05 ms: what is timed beside ours.
pub fn quick(table: Table, height_m: f64, t_s: f64) -> usize {
    let start = State::from([0.0, (2.0 * G * height_m).sqrt(), 0.0, 0.0, 0.0, 0.0]);
    let mut solver = ode_solvers::Dopri5::new(table, 0.0, t_s, 5e-5, start, 1e-6, 1e-7);
    solver.integrate().expect("integrates");
    solver.y_out().len()
}
