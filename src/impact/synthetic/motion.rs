//! The drop written once more, as plainly as it can be: one right-hand side, fixed steps.

use super::Hidden;
use crate::impact::effects::Model;

const G_M_S2: f64 = 9.81;
/// Step of the method, s.
const STEP_S: f64 = 2e-6;
/// States: x, v, three filter stages, Maxwell's force, two payloads' lag and rate.
const STATES: usize = 10;
type State = [f64; STATES];
const FILTER: usize = 2;
const MAXWELL: usize = 5;
const PAYLOADS: usize = 6;

/// What a drop remembers.
#[derive(Clone, Copy, Debug)]
struct Past {
    /// Feet that have touched.
    touched: usize,
    /// Largest compression so far, m.
    deepest_m: f64,
}

/// A payload on a spring of its own.
#[derive(Clone, Copy, Debug)]
struct Rider {
    share: f64,
    circular_1_s: f64,
    zeta: f64,
}

/// Numbers of a model, ready to run. Off values are those at which a term vanishes.
#[derive(Clone, Debug)]
pub struct Motion {
    mass_kg: f64,
    k: f64,
    c: f64,
    tension_factor: f64,
    stop: [f64; 3],
    k3: f64,
    bilinear: [f64; 2],
    chi: f64,
    friction_n: f64,
    maxwell: [f64; 2],
    c2: f64,
    preload_n: f64,
    riders: Vec<Rider>,
    on_rider: bool,
    /// Share and points of the frame's curve, m.
    curve: Option<(f64, Vec<[f64; 2]>)>,
    stagger_m: f64,
    extra_m: f64,
    drag_1_m: f64,
    filter_1_s: f64,
    order: usize,
    /// The sensor's gain.
    pub gain: f64,
    /// Its largest reading, g.
    pub limit_g: f64,
    hidden: Option<Hidden>,
}

impl Motion {
    /// A model's numbers with spring and damper scaled.
    pub fn of(model: &Model, hidden: Option<Hidden>, stiffness_factor: f64, damping_factor: f64) -> Self {
        let value = |effect: &str, key: &str| model.value(effect, key);
        let or_zero = |effect: &str, key: &str| value(effect, key).unwrap_or(0.0);
        let circular = |f_hz: f64| 2.0 * std::f64::consts::PI * f_hz;
        let rider = |share: f64, f_hz: f64, zeta: f64| Rider { share, circular_1_s: circular(f_hz), zeta };
        let mut riders = Vec::new();
        if or_zero("payload_mode", "mu") > 0.0 {
            riders.push(rider(or_zero("payload_mode", "mu"), or_zero("payload_mode", "f_hz"), or_zero("payload_mode", "zeta")));
        }
        if let Some(Hidden::TwoModes { shares, f_hz, zeta }) = hidden {
            riders = vec![rider(shares[0], f_hz[0], zeta), rider(shares[1], f_hz[1], zeta)];
        }
        let [k, c] = model.stiffness_and_damping();
        Self {
            mass_kg: model.body.mass_kg,
            k: k * stiffness_factor,
            c: c * damping_factor,
            tension_factor: value("unilateral_contact", "tension_factor").unwrap_or(1.0),
            stop: [or_zero("bottoming", "x_b_mm") * 1e-3, or_zero("bottoming", "k_b"), or_zero("bottoming", "lambda")],
            k3: or_zero("cubic_stiffness", "k3"),
            bilinear: [or_zero("bilinear_stiffness", "x1_mm") * 1e-3, or_zero("bilinear_stiffness", "k_bl")],
            chi: or_zero("hunt_crossley_damping", "chi"),
            friction_n: or_zero("coulomb_friction", "f_c_n"),
            maxwell: [or_zero("maxwell_branch", "k_m"), value("maxwell_branch", "tau_ms").unwrap_or(1.0) * 1e-3],
            c2: or_zero("quadratic_damping", "c2"),
            preload_n: or_zero("preload", "f0_n"),
            riders,
            on_rider: model.arrangement().sensor.on_payload,
            curve: model
                .frame_curve
                .as_ref()
                .map(|curve| (or_zero("frame_force_curve", "share"), curve.points_mm().map(|point| point.map(|mm| mm * 1e-3)).collect())),
            stagger_m: or_zero("foot_stagger", "delta_mm") * 1e-3,
            extra_m: or_zero("drop_height_error", "dh_m"),
            drag_1_m: or_zero("air_drag", "beta"),
            filter_1_s: circular(value("sensor_low_pass", "cutoff_hz").unwrap_or(model.sensor.cutoff_hz)),
            order: model.sensor.order,
            gain: value("sensor_gain", "gain").unwrap_or(1.0),
            limit_g: value("sensor_saturation", "limit_g").unwrap_or(f64::INFINITY).min(model.sensor.limit_g),
            hidden,
        }
    }

    /// Speed at first touch, m/s.
    fn impact_speed_m_s(&self, stated_m: f64) -> f64 {
        let height_m = (stated_m + self.extra_m).max(0.0);
        let squared = if self.drag_1_m > 0.0 {
            G_M_S2 / self.drag_1_m * (1.0 - libm::exp(-2.0 * self.drag_1_m * height_m))
        } else {
            2.0 * G_M_S2 * height_m
        };
        squared.sqrt()
    }

    /// What the frame's curve makes of a compression, m: Bézier's cubic between its points, by repeated halving of ways
    /// (P. de Casteljau).
    fn bent(&self, x: f64) -> f64 {
        let Some((share, points)) = &self.curve else { return x };
        if x <= 0.0 || *share == 0.0 {
            return x;
        }
        let count = points.len();
        // Slope of the parabola through three neighbours; straight at the last, 1 at rest.
        let way = |i: usize| {
            if i == 0 {
                return 1.0;
            }
            let chord = |a: usize, b: usize| (points[b][1] - points[a][1]) / (points[b][0] - points[a][0]);
            if i + 1 == count {
                return chord(i - 1, i);
            }
            let weight = (points[i + 1][0] - points[i][0]) / (points[i + 1][0] - points[i - 1][0]);
            weight * chord(i - 1, i) + (1.0 - weight) * chord(i, i + 1)
        };
        let phi = match (1..count).find(|i| x < points[*i][0]) {
            None => points[count - 1][1] + way(count - 1) * (x - points[count - 1][0]),
            Some(i) => {
                let third = (points[i][0] - points[i - 1][0]) / 3.0;
                let t = (x - points[i - 1][0]) / (3.0 * third);
                let mut hull = [points[i - 1][1], points[i - 1][1] + third * way(i - 1), points[i][1] - third * way(i), points[i][1]];
                for last in (1..4).rev() {
                    for j in 0..last {
                        hull[j] += t * (hull[j + 1] - hull[j]);
                    }
                }
                hull[0]
            }
        };
        (1.0 - share) * x + share * phi
    }

    /// Force of the frame on the body, N.
    fn force_n(&self, y: &State, past: Past) -> f64 {
        let (x, v) = (y[0], y[1]);
        let mut sum = if self.stagger_m > 0.0 {
            (0..past.touched).map(|foot| 0.25 * (self.k * self.bent(x - self.stagger_m * foot as f64 / 3.0) + self.c * v)).sum()
        } else {
            self.k * self.bent(x) + self.c * v
        };
        sum += self.k3 * x * x * x + self.bilinear[1] * (x - self.bilinear[0]).max(0.0);
        sum += self.chi * x * v + self.c2 * v * v.abs() + y[MAXWELL];
        if self.friction_n != 0.0 {
            sum += self.friction_n * libm::tanh(v / 0.05);
        }
        if self.preload_n != 0.0 {
            sum += self.preload_n * libm::tanh(x / 2e-4);
        }
        if let Some(Hidden::TwoStage { x1_m, stiffness_n_m, loss }) = self.hidden {
            let kept = 1.0 - 0.5 * loss * (1.0 - libm::tanh(v / 0.05));
            sum += kept * stiffness_n_m * (x - x1_m).max(0.0);
        }
        if let Some(Hidden::Snap { x1_m, loss }) = self.hidden
            && past.deepest_m > x1_m
        {
            sum -= loss * self.k * x;
        }
        if sum < 0.0 || x < 0.0 {
            sum *= self.tension_factor;
        }
        let depth = x - self.stop[0];
        let stop = if depth > 0.0 { self.stop[1] * depth * depth.sqrt() * (1.0 + 1.5 * self.stop[2] * v) } else { 0.0 };
        sum + stop.max(0.0)
    }

    fn rates(&self, y: &State, past: Past) -> State {
        let mut rates = [0.0; STATES];
        let pushed: Vec<f64> = self.riders.iter().enumerate().map(|(i, rider)| self.rider_m_s2(rider, y, i)).collect();
        let held: f64 = self.riders.iter().zip(&pushed).map(|(rider, a)| rider.share * a).sum();
        let free: f64 = 1.0 - self.riders.iter().map(|rider| rider.share).sum::<f64>();
        let frame = (self.force_n(y, past) / self.mass_kg - held) / free;
        rates[0] = y[1];
        rates[1] = G_M_S2 - frame;
        for (i, a) in pushed.iter().enumerate() {
            rates[PAYLOADS + 2 * i] = y[PAYLOADS + 2 * i + 1];
            rates[PAYLOADS + 2 * i + 1] = G_M_S2 - a - rates[1];
        }
        rates[MAXWELL] = self.maxwell[0] * y[1] - y[MAXWELL] / self.maxwell[1];
        let mut felt = if self.on_rider { pushed[0] } else { frame };
        for stage in FILTER..FILTER + self.order {
            rates[stage] = self.filter_1_s * (felt - y[stage]);
            felt = y[stage];
        }
        rates
    }

    fn rider_m_s2(&self, rider: &Rider, y: &State, i: usize) -> f64 {
        let (lag, rate) = (y[PAYLOADS + 2 * i], y[PAYLOADS + 2 * i + 1]);
        rider.circular_1_s * rider.circular_1_s * lag + 2.0 * rider.zeta * rider.circular_1_s * rate
    }

    /// The low-pass's output times the gain, without the limit, g, every `every_s` from first touch on.
    pub fn wave_g(&self, height_m: f64, every_s: f64, count: usize) -> Vec<f64> {
        let steps = (every_s / STEP_S).round().max(1.0) as usize;
        let step_s = every_s / steps as f64;
        let mut y = [0.0; STATES];
        y[1] = self.impact_speed_m_s(height_m);
        let mut past = Past { touched: 1, deepest_m: 0.0 };
        let mut out = Vec::with_capacity(count);
        for _ in 0..count {
            out.push(self.gain * y[FILTER + self.order - 1] / G_M_S2);
            for _ in 0..steps {
                y = self.step(&y, past, step_s);
                past.deepest_m = past.deepest_m.max(y[0]);
                while past.touched < 4 && past.deepest_m > self.stagger_m * past.touched as f64 / 3.0 {
                    past.touched += 1;
                }
            }
        }
        out
    }

    /// One step of the classical method of order 4.
    fn step(&self, y: &State, past: Past, h: f64) -> State {
        let along = |rates: &State, part: f64| std::array::from_fn(|i| y[i] + part * h * rates[i]);
        let first = self.rates(y, past);
        let second = self.rates(&along(&first, 0.5), past);
        let third = self.rates(&along(&second, 0.5), past);
        let last = self.rates(&along(&third, 1.0), past);
        std::array::from_fn(|i| y[i] + h / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + last[i]))
    }
}
