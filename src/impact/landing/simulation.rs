//! A rigid body that lands on four legs, followed through time.
//!
//! The body's height above the ground of a level landing, and its slopes along the two diagonals, are three coordinates. A foot stands
//! d = z + r sin p - h (1 - cos p cos q) below the ground, r being its radius and h the height of the centre of mass, and its force acts on
//! each coordinate by d's derivative with respect to it. A foot is pressed by (stiffness/4) d + (damping/4) d', d being how far it stands below the ground, and never pulled. In
//! every step the forces are taken at its middle (the explicit midpoint method, order 2).
//!
//! *When it is wrong:* beyond slopes of about 0.3 rad along both diagonals, as turns about the two are taken to be independent; where feet slide
//! far; where the frame between the feet and the hub bends long after the touch.

use super::legged_body::{LeggedBody, Legs};
use crate::units::GRAVITY_M_S2;

/// Time between the points of a wave, s.
pub use crate::impact::fit::FINE_S as STEP_S;

/// Feet: at the positive and the negative end of the first diagonal, then of the second.
pub const FEET: usize = 4;

/// How the body landed.
#[derive(Clone, Debug, PartialEq)]
pub struct Landing {
    /// Proper acceleration along the body's own axis, which its sensor turns with, from first touch on, g, every [`STEP_S`].
    pub accel_g: Vec<f64>,
    /// From first touch to that of each foot, s; `None` for a foot that does not touch within the time followed.
    pub touch_s: [Option<f64>; FEET],
}

/// Height, the slopes' sines and cosines, and rates: z, sin p, cos p, sin q, cos q, z', p', q'; z in m, downward from where a level body's
/// feet touch; each of several landings. Sines and cosines are followed as coordinates of their own (sin' = cos p', cos' = -sin p'), which
/// costs no function calls.
type State<const N: usize> = [[f64; N]; 8];

/// Lands with a speed, m/s, and slopes along the two diagonals, rad; followed for so many points.
///
/// A positive slope puts the foot at the diagonal's positive end lower. `None` where the body is lost: numbers that no leg has.
pub fn simulate(body: &LeggedBody, legs: &Legs, speed_m_s: f64, slopes: [f64; 2], points: usize) -> Option<Landing> {
    let [landing] = simulate_each(body, legs, speed_m_s, &[slopes], points, SensorAxis::Body);
    landing
}

/// What a sensor's axis keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SensorAxis {
    /// The axis of the body, with which it turns: of the vertical acceleration it reads the cosine of the slope.
    Body,
    /// The vertical, as a sensor would that does not turn.
    Vertical,
}

/// The same of several landings, which a processor computes side by side; each has the numbers that it has alone.
pub fn simulate_each<const N: usize>(
    body: &LeggedBody,
    legs: &Legs,
    speed_m_s: f64,
    slopes: &[[f64; 2]; N],
    points: usize,
    axis: SensorAxis,
) -> [Option<Landing>; N] {
    let mut state = touching(body, speed_m_s, slopes);
    let mut accel_g = Vec::with_capacity(points);
    let mut touch_s = [[None; FEET]; N];
    for point in 0..points {
        let (rate, pressed_n, depth_m) = change(body, legs, &state);
        let mut read_g = [0.0; N];
        for at in 0..N {
            let upright_g = pressed_n[at] / body.mass_kg / GRAVITY_M_S2;
            read_g[at] = if axis == SensorAxis::Body { upright_g * state[2][at] * state[4][at] } else { upright_g };
            for foot in 0..FEET {
                if depth_m[foot][at] >= -1e-12 && touch_s[at][foot].is_none() {
                    touch_s[at][foot] = Some(point as f64 * STEP_S);
                }
            }
        }
        accel_g.push(read_g);
        let middle = moved(&state, &rate, 0.5 * STEP_S);
        state = moved(&state, &change(body, legs, &middle).0, STEP_S);
    }
    std::array::from_fn(|at| {
        let landing = || Landing { accel_g: accel_g.iter().map(|accel_g| accel_g[at]).collect(), touch_s: touch_s[at] };
        state.iter().all(|value| value[at].is_finite()).then(landing)
    })
}

/// When the lowest foot touches.
fn touching<const N: usize>(body: &LeggedBody, speed_m_s: f64, slopes: &[[f64; 2]; N]) -> State<N> {
    let mut state = [[0.0; N]; 8];
    for (at, [p, q]) in slopes.iter().enumerate() {
        let [(sin_p, cos_p), (sin_q, cos_q)] = [libm::sincos(*p), libm::sincos(*q)];
        let raised_m = body.centre_height_m * (1.0 - cos_p * cos_q);
        let lowest_m = body.foot_radius_m * sin_p.abs().max(sin_q.abs()) - raised_m;
        let here = [-lowest_m, sin_p, cos_p, sin_q, cos_q, speed_m_s, 0.0, 0.0];
        state.iter_mut().zip(here).for_each(|(values, value)| values[at] = value);
    }
    state
}

/// Rates of change, the force of all feet, N, and how far each foot stands below the ground, m.
///
/// Written by the place in arrays and without closures: so the compiler computes several landings with one instruction.
#[inline(always)]
fn change<const N: usize>(body: &LeggedBody, legs: &Legs, state: &State<N>) -> (State<N>, [f64; N], [[f64; N]; FEET]) {
    let (mut rate, mut pressed_n, mut depth_m) = ([[0.0; N]; 8], [0.0; N], [[0.0; N]; FEET]);
    let (r, h) = (body.foot_radius_m, body.centre_height_m);
    for at in 0..N {
        let (sin_p, cos_p, sin_q, cos_q) = (state[1][at], state[2][at], state[3][at], state[4][at]);
        let (z_rate, p_rate, q_rate) = (state[5][at], state[6][at], state[7][at]);
        let sunk_m = state[0][at] - h * (1.0 - cos_p * cos_q);
        let depths_m = [sunk_m + r * sin_p, sunk_m - r * sin_p, sunk_m + r * sin_q, sunk_m - r * sin_q];
        // How each slope lowers all feet, and the two at the ends of its own diagonal.
        let (all_p, all_q) = (-h * sin_p * cos_q, -h * cos_p * sin_q);
        let (own_p, own_q) = (r * cos_p, r * cos_q);
        let common_m_s = z_rate + all_p * p_rate + all_q * q_rate;
        let (along_p, along_q) = (own_p * p_rate, own_q * q_rate);
        let a = pressed(legs, depths_m[0], common_m_s + along_p);
        let b = pressed(legs, depths_m[1], common_m_s - along_p);
        let c = pressed(legs, depths_m[2], common_m_s + along_q);
        let d = pressed(legs, depths_m[3], common_m_s - along_q);
        let all_n = a + b + c + d;
        rate[0][at] = z_rate;
        rate[1][at] = cos_p * p_rate;
        rate[2][at] = -sin_p * p_rate;
        rate[3][at] = cos_q * q_rate;
        rate[4][at] = -sin_q * q_rate;
        rate[5][at] = GRAVITY_M_S2 - all_n / body.mass_kg;
        rate[6][at] = -(own_p * (a - b) + all_p * all_n) / legs.inertia_kg_m2;
        rate[7][at] = -(own_q * (c - d) + all_q * all_n) / legs.inertia_kg_m2;
        pressed_n[at] = all_n;
        for foot in 0..FEET {
            depth_m[foot][at] = depths_m[foot];
        }
    }
    (rate, pressed_n, depth_m)
}

/// Force of a foot, N.
#[inline(always)]
fn pressed(legs: &Legs, depth_m: f64, speed_m_s: f64) -> f64 {
    let pressed_n = 0.25 * (legs.stiffness_n_m * depth_m + legs.damping_n_s_m * speed_m_s);
    if (depth_m > 0.0) & (pressed_n > 0.0) { pressed_n } else { 0.0 }
}

#[inline(always)]
fn moved<const N: usize>(state: &State<N>, rate: &State<N>, step_s: f64) -> State<N> {
    let mut moved = *state;
    for i in 0..8 {
        for at in 0..N {
            moved[i][at] += step_s * rate[i][at];
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: LeggedBody = LeggedBody { mass_kg: 0.241, foot_radius_m: 0.1445, centre_height_m: 0.05 };
    const LEGS: Legs = Legs { stiffness_n_m: 20_000.0, damping_n_s_m: 40.0, inertia_kg_m2: 1e-3, mount: None };

    #[test]
    fn analytic_a_level_landing_is_that_of_one_spring_and_damper() {
        let landing = simulate(&BODY, &LEGS, 4.0, [0.0; 2], 100).expect("it lands");
        assert_eq!(landing.touch_s, [Some(0.0); FEET]);
        let (m, k, c) = (BODY.mass_kg, LEGS.stiffness_n_m, LEGS.damping_n_s_m);
        let (decay, swing) = (0.5 * c / m, (k / m - (0.5 * c / m).powi(2)).sqrt());
        // x about the rest position: x(0) = -mg/k, x'(0) = v.
        let rest = m * GRAVITY_M_S2 / k;
        let sine = (4.0 - decay * rest) / swing;
        for (point, accel_g) in landing.accel_g.iter().enumerate().skip(1) {
            let t = point as f64 * STEP_S;
            let e = libm::exp(-decay * t);
            let x = e * (sine * libm::sin(swing * t) - rest * libm::cos(swing * t));
            let v = e
                * (swing * (sine * libm::cos(swing * t) + rest * libm::sin(swing * t))
                    - decay * (sine * libm::sin(swing * t) - rest * libm::cos(swing * t)));
            let expected = (k * (x + rest) + c * v).max(0.0) / m / GRAVITY_M_S2;
            assert!((accel_g - expected).abs() < 2e-2, "{point}: {accel_g} {expected}");
        }
    }

    #[test]
    fn analytic_a_sloped_landing_touches_in_order_and_keeps_its_impulse() {
        let landing = simulate(&BODY, &LEGS, 4.0, [0.1, 0.04], 1000).expect("it lands");
        let [first, last, near, far] = landing.touch_s.map(|touch| touch.expect("all feet touch"));
        assert!(first == 0.0 && 0.0 < near && near < far && far < last, "{:?}", landing.touch_s);
        // Before anything pushes, a foot comes down by its height over the speed.
        assert!((near - 0.1445 * 0.06 / 4.0).abs() < 4e-4);
        let impulse = landing.accel_g.iter().sum::<f64>() * STEP_S * GRAVITY_M_S2;
        assert!((1.0..2.2).contains(&(impulse / 4.0)), "{impulse}");
    }

    #[test]
    fn analytic_a_sensor_that_turns_with_the_body_reads_the_cosine_of_its_slope() {
        let read = |slope: f64, axis| {
            let [landing] = simulate_each(&BODY, &LEGS, 4.0, &[[slope, 0.0]], 400, axis);
            landing.expect("it lands").accel_g
        };
        // Level, it is the same to the last bit; as the first foot touches, the slope is still that of the fall.
        assert_eq!(read(0.0, SensorAxis::Body), read(0.0, SensorAxis::Vertical));
        let slope: f64 = 0.2;
        let (turned, upright) = (read(slope, SensorAxis::Body), read(slope, SensorAxis::Vertical));
        assert!(upright[1] > 1.0 && (turned[1] / upright[1] - libm::cos(slope)).abs() < 1e-5, "{} {}", turned[1], upright[1]);
        // Cosines are followed as coordinates, to the method's order.
        assert!(turned.iter().zip(&upright).all(|(turned, upright)| *turned <= upright * 1.001));
    }

    #[test]
    fn analytic_mirrored_slopes_land_alike() {
        let wave = |slopes| simulate(&BODY, &LEGS, 4.0, slopes, 300).expect("it lands").accel_g;
        let same = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(same(wave([0.1, 0.05]), wave([-0.1, 0.05])) && same(wave([0.1, 0.05]), wave([0.05, 0.1])));
    }
}
