//! A rigid body that lands on four legs, followed through time.
//!
//! The body's height above the ground of a level landing, and its slopes along the two diagonals, are three coordinates. A foot stands
//! d = z + r sin p - h (1 - cos p cos q) below the ground, r being its radius and h the height of the centre of mass, and its force acts on
//! each coordinate by d's derivative with respect to it. A foot is pressed by
//! (stiffness/4) d + (damping/4) d' + (friction/4) d'/√(d'² + w²), w = 0.05 m/s, d being how far it stands below the ground, and never pulled.
//! Dry friction is that of hinges and sockets, and of feet that slide apart; the root in place of the sign is the same for fast legs, and
//! creeps where slower ones would stick. Feet may have mass of their own, which then meets the ground ([`FootMode`]). In every step the forces are taken at its middle (the explicit midpoint method, order 2).
//! A foot that comes down within a step has the part of its force that is the part of the step in which it touches ([`touching_share`]), and its
//! touch is timed between the points: so waves and touch times change evenly with the legs, as a fit by difference quotients needs.
//!
//! *When it is wrong:* beyond slopes of about 0.3 rad along both diagonals, as turns about the two are taken to be independent; where feet slide
//! far; where the frame between the feet and the hub bends long after the touch.

use super::descent::Descent;
use super::foot_mode::{FootForces, FootMode};
use super::legged_body::{LeggedBody, Legs};
use crate::impact::effects::TURN_M_S;
use crate::impact::wide_registers::{Loops, with_wide_registers};
use crate::units::GRAVITY_M_S2;

/// Time between the points of a wave, s.
pub use crate::impact::fit::FINE_S as STEP_S;

/// A foot that comes down slower than this has its touch spread over as long a way, m/s.
const SLOW_M_S: f64 = 1e-3;

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

/// How several bodies landed, side by side.
#[derive(Debug, PartialEq)]
pub struct Landings<const N: usize> {
    /// As [`Landing::accel_g`], of each.
    pub accel_g: Vec<[f64; N]>,
    touch_s: [[Option<f64>; FEET]; N],
    followed: [bool; N],
}

impl<const N: usize> Landings<N> {
    /// Each alone; `None` where the body is lost: numbers that no leg has.
    pub fn each(&self) -> [Option<Landing>; N] {
        let accel_g = |at: usize| self.accel_g.iter().map(|accel_g| accel_g[at]).collect();
        std::array::from_fn(|at| self.followed[at].then(|| Landing { accel_g: accel_g(at), touch_s: self.touch_s[at] }))
    }
}

/// Motion of each of several landings.
#[derive(Clone, Copy)]
struct State<const N: usize> {
    /// Height, the slopes' sines and cosines, and rates: z, sin p, cos p, sin q, cos q, z', p', q'; z in m, downward from where a level body's
    /// feet touch. Sines and cosines are followed as coordinates of their own (sin' = cos p', cos' = -sin p'), which costs no function calls.
    body: [[f64; N]; 8],
    /// How far each foot stands below its place on the body, m, and its rate; zero where feet have no mass.
    feet: [[[f64; N]; FEET]; 2],
}

/// Lands at the end of a fall, with slopes along the two diagonals, rad; followed for so many points.
///
/// A positive slope puts the foot at the diagonal's positive end lower. `None` where the body is lost: numbers that no leg has.
pub fn simulate(body: &LeggedBody, legs: &Legs, descent: Descent, slopes: [f64; 2], points: usize) -> Option<Landing> {
    let [landing] = simulate_each(body, legs, descent, &[slopes], points, SensorAxis::Body).each();
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
    descent: Descent,
    slopes: &[[f64; 2]; N],
    points: usize,
    axis: SensorAxis,
) -> Landings<N> {
    with_wide_registers(Following { mechanics: Mechanics::of(body, legs), begin: touching(body, descent, slopes), points, axis })
}

/// Landings that are followed side by side.
struct Following<const N: usize> {
    mechanics: Mechanics,
    begin: State<N>,
    points: usize,
    axis: SensorAxis,
}

impl<const N: usize> Loops for Following<N> {
    type Output = Landings<N>;

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Self { mechanics, begin, points, axis } = self;
        match (mechanics.legs.feet.is_some(), mechanics.legs.friction_n > 0.0) {
            (false, false) => followed::<N, false, false>(&mechanics, begin, points, axis),
            (false, true) => followed::<N, false, true>(&mechanics, begin, points, axis),
            (true, false) => followed::<N, true, false>(&mechanics, begin, points, axis),
            (true, true) => followed::<N, true, true>(&mechanics, begin, points, axis),
        }
    }
}

/// Masses, springs and dampers of a body on its legs.
struct Mechanics {
    legs: Legs,
    foot_radius_m: f64,
    centre_height_m: f64,
    /// Without the mass of the feet.
    mass_kg: f64,
    inertia_kg_m2: f64,
    foot: FootForces,
}

impl Mechanics {
    fn of(body: &LeggedBody, legs: &Legs) -> Self {
        let share = legs.feet.map_or(0.0, |feet| feet.share);
        Self {
            legs: *legs,
            foot_radius_m: body.foot_radius_m,
            centre_height_m: body.centre_height_m,
            mass_kg: (1.0 - share) * body.mass_kg,
            inertia_kg_m2: legs.inertia_kg_m2 - 0.5 * share * body.mass_kg * body.foot_radius_m * body.foot_radius_m,
            foot: legs.feet.unwrap_or(FootMode { share: 0.0, f_hz: 1.0, zeta: 0.0 }).forces(body.mass_kg),
        }
    }
}

/// Least height of all feet of a body that flies, m: far above what rounding moves.
const CLEAR_M: f64 = 1e-6;

impl Mechanics {
    /// Whether no foot of a landing touches for a time, s. Slopes turn as they do, and their sines and cosines change by at most as much, so no
    /// foot is lower than this parabola, whose ends are its lowest places. Feet without mass alone.
    fn flies<const N: usize>(&self, state: &State<N>, at: usize, for_s: f64) -> bool {
        let [z, sin_p, cos_p, sin_q, cos_q, z_rate, p_rate, q_rate] = state.body.map(|values| values[at]);
        let sunk_m = z - self.centre_height_m * (1.0 - cos_p * cos_q);
        let turned_m_s = self.centre_height_m * (p_rate.abs() + q_rate.abs());
        [(sin_p, p_rate), (sin_q, q_rate)].into_iter().all(|(sine, rate)| {
            let begin_m = sunk_m + self.foot_radius_m * sine.abs();
            let speed_m_s = z_rate + turned_m_s + self.foot_radius_m * rate.abs();
            let end_m = begin_m + for_s * (speed_m_s + 0.5 * GRAVITY_M_S2 * for_s);
            // A foot pushes from half a step before it touches on.
            let clear_m = CLEAR_M + 0.5 * STEP_S * (speed_m_s + GRAVITY_M_S2 * for_s).max(SLOW_M_S);
            begin_m < -clear_m && end_m < -clear_m
        })
    }
}

/// From a state on; `FREE` where feet have mass, `RUBS` where legs have friction: what is absent costs nothing.
#[inline(always)]
fn followed<const N: usize, const FREE: bool, const RUBS: bool>(
    mechanics: &Mechanics,
    mut state: State<N>,
    points: usize,
    axis: SensorAxis,
) -> Landings<N> {
    let mut accel_g = Vec::with_capacity(points);
    let mut touch_s = [[None; FEET]; N];
    let mut before_m = [[0.0; N]; FEET];
    for point in 0..points {
        let (rate, pressed_n, depth_m) = change::<N, FREE, RUBS>(mechanics, &state);
        let mut read_g = [0.0; N];
        for at in 0..N {
            let upright_g = pressed_n[at] / mechanics.mass_kg / GRAVITY_M_S2;
            read_g[at] = if axis == SensorAxis::Body { upright_g * state.body[2][at] * state.body[4][at] } else { upright_g };
            for foot in 0..FEET {
                let depth_m = depth_m[foot][at];
                if depth_m >= -1e-12 && touch_s[at][foot].is_none() {
                    let since = if point == 0 { 0.0 } else { depth_m / (depth_m - before_m[foot][at]) };
                    touch_s[at][foot] = Some((point as f64 - since.clamp(0.0, 1.0)) * STEP_S);
                }
            }
        }
        before_m = depth_m;
        accel_g.push(read_g);
        let left_s = (points - point) as f64 * STEP_S;
        let pushed = (0..N).any(|at| pressed_n[at] > 0.0);
        if !FREE && !pushed && (0..N).all(|at| mechanics.flies(&state, at, left_s)) {
            accel_g.resize(points, [0.0; N]);
            break;
        }
        let middle = moved::<N, FREE>(&state, &rate, 0.5 * STEP_S);
        state = moved::<N, FREE>(&state, &change::<N, FREE, RUBS>(mechanics, &middle).0, STEP_S);
    }
    // Feet that have all of the moment of inertia leave the body none.
    let possible = mechanics.inertia_kg_m2 > 0.0;
    let is_finite = |at: usize| state.body.iter().chain(state.feet.iter().flatten()).all(|value| value[at].is_finite());
    Landings { accel_g, touch_s, followed: std::array::from_fn(|at| possible && is_finite(at)) }
}

/// When the lowest foot touches.
fn touching<const N: usize>(body: &LeggedBody, descent: Descent, slopes: &[[f64; 2]; N]) -> State<N> {
    let mut state = State { body: [[0.0; N]; 8], feet: [[[0.0; N]; FEET]; 2] };
    for (at, [p, q]) in slopes.iter().enumerate() {
        let [(sin_p, cos_p), (sin_q, cos_q)] = [libm::sincos(*p), libm::sincos(*q)];
        let raised_m = body.centre_height_m * (1.0 - cos_p * cos_q);
        let lowest_m = body.foot_radius_m * sin_p.abs().max(sin_q.abs()) - raised_m;
        let [p_rate, q_rate] = [p, q].map(|slope| descent.turning_1_s * slope);
        let here = [-lowest_m, sin_p, cos_p, sin_q, cos_q, descent.speed_m_s, p_rate, q_rate];
        state.body.iter_mut().zip(here).for_each(|(values, value)| values[at] = value);
    }
    state
}

/// Rates of change, the force of all feet on the body, N, and how far each foot stands below the ground, m.
///
/// Written by the place in arrays and without closures: so the compiler computes several landings with one instruction.
#[inline(always)]
fn change<const N: usize, const FREE: bool, const RUBS: bool>(
    mechanics: &Mechanics,
    state: &State<N>,
) -> (State<N>, [f64; N], [[f64; N]; FEET]) {
    let mut rate = State { body: [[0.0; N]; 8], feet: [[[0.0; N]; FEET]; 2] };
    let (mut pressed_n, mut depth_m) = ([0.0; N], [[0.0; N]; FEET]);
    let Mechanics { legs, foot_radius_m: r, centre_height_m: h, mass_kg, inertia_kg_m2, foot } = mechanics;
    for at in 0..N {
        let body = &state.body;
        let (sin_p, cos_p, sin_q, cos_q) = (body[1][at], body[2][at], body[3][at], body[4][at]);
        let (z_rate, p_rate, q_rate) = (body[5][at], body[6][at], body[7][at]);
        let sunk_m = body[0][at] - h * (1.0 - cos_p * cos_q);
        let mut depths_m = [sunk_m + r * sin_p, sunk_m - r * sin_p, sunk_m + r * sin_q, sunk_m - r * sin_q];
        // How each slope lowers all feet, and the two at the ends of its own diagonal.
        let (all_p, all_q) = (-h * sin_p * cos_q, -h * cos_p * sin_q);
        let (own_p, own_q) = (r * cos_p, r * cos_q);
        let common_m_s = z_rate + all_p * p_rate + all_q * q_rate;
        let (along_p, along_q) = (own_p * p_rate, own_q * q_rate);
        let mut speeds_m_s = [common_m_s + along_p, common_m_s - along_p, common_m_s + along_q, common_m_s - along_q];
        if FREE {
            for i in 0..FEET {
                depths_m[i] += state.feet[0][i][at];
                speeds_m_s[i] += state.feet[1][i][at];
            }
        }
        let mut ground_n = [0.0; FEET];
        let mut body_n = [0.0; FEET];
        for i in 0..FEET {
            ground_n[i] = pressed::<RUBS>(legs, depths_m[i], speeds_m_s[i]);
            body_n[i] =
                if FREE { -(foot.stiffness_n_m * state.feet[0][i][at] + foot.damping_n_s_m * state.feet[1][i][at]) } else { ground_n[i] };
        }
        let all_n = body_n[0] + body_n[1] + body_n[2] + body_n[3];
        let z_turn = GRAVITY_M_S2 - all_n / mass_kg;
        let p_turn = -(own_p * (body_n[0] - body_n[1]) + all_p * all_n) / inertia_kg_m2;
        let q_turn = -(own_q * (body_n[2] - body_n[3]) + all_q * all_n) / inertia_kg_m2;
        rate.body[0][at] = z_rate;
        rate.body[1][at] = cos_p * p_rate;
        rate.body[2][at] = -sin_p * p_rate;
        rate.body[3][at] = cos_q * q_rate;
        rate.body[4][at] = -sin_q * q_rate;
        rate.body[5][at] = z_turn;
        rate.body[6][at] = p_turn;
        rate.body[7][at] = q_turn;
        if FREE {
            let common = z_turn + all_p * p_turn + all_q * q_turn;
            let places = [common + own_p * p_turn, common - own_p * p_turn, common + own_q * q_turn, common - own_q * q_turn];
            for i in 0..FEET {
                rate.feet[0][i][at] = state.feet[1][i][at];
                rate.feet[1][i][at] = GRAVITY_M_S2 + (body_n[i] - ground_n[i]) / foot.mass_kg - places[i];
            }
        }
        pressed_n[at] = all_n;
        for i in 0..FEET {
            depth_m[i][at] = depths_m[i];
        }
    }
    (rate, pressed_n, depth_m)
}

/// Force of a foot, N.
#[inline(always)]
fn pressed<const RUBS: bool>(legs: &Legs, depth_m: f64, speed_m_s: f64) -> f64 {
    let mut all_n = legs.stiffness_n_m * depth_m + legs.damping_n_s_m * speed_m_s;
    if RUBS {
        all_n += legs.friction_n * (speed_m_s / (speed_m_s * speed_m_s + TURN_M_S * TURN_M_S).sqrt());
    }
    let pressed_n = 0.25 * all_n * touching_share(depth_m, speed_m_s);
    if pressed_n > 0.0 { pressed_n } else { 0.0 }
}

/// The part of a step around a moment in which a foot stands below the ground, by its depth and speed at that moment. It takes the whole of a foot
/// that leaves the ground: there its force has come to nothing before.
#[inline(always)]
fn touching_share(depth_m: f64, speed_m_s: f64) -> f64 {
    let in_a_step_m = STEP_S * speed_m_s.max(SLOW_M_S);
    (0.5 + depth_m / in_a_step_m).clamp(0.0, 1.0)
}

#[inline(always)]
fn moved<const N: usize, const FREE: bool>(state: &State<N>, rate: &State<N>, step_s: f64) -> State<N> {
    let mut moved = *state;
    for i in 0..8 {
        for at in 0..N {
            moved.body[i][at] += step_s * rate.body[i][at];
        }
    }
    if FREE {
        for i in 0..2 * FEET {
            let (order, foot) = (i / FEET, i % FEET);
            for at in 0..N {
                moved.feet[order][foot][at] += step_s * rate.feet[order][foot][at];
            }
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: LeggedBody = LeggedBody { mass_kg: 0.241, foot_radius_m: 0.1445, centre_height_m: 0.05 };
    const LEGS: Legs = Legs { stiffness_n_m: 20_000.0, damping_n_s_m: 40.0, friction_n: 0.0, inertia_kg_m2: 1e-3, feet: None, mount: None };
    const STRAIGHT: Descent = Descent { speed_m_s: 4.0, turning_1_s: 0.0 };

    #[test]
    fn analytic_wide_registers_give_the_bits_of_narrow_ones() {
        let feet = Some(FootMode { share: 0.2, f_hz: 150.0, zeta: 0.3 });
        let slopes = [[0.0, 0.0], [0.2, 0.05], [0.11, -0.3], [0.4, 0.39]];
        for legs in [LEGS, Legs { friction_n: 60.0, ..LEGS }, Legs { feet, ..LEGS }, Legs { friction_n: 60.0, feet, ..LEGS }] {
            let begin = touching(&BODY, Descent { speed_m_s: 4.0, turning_1_s: 2.0 }, &slopes);
            let following = || Following { mechanics: Mechanics::of(&BODY, &legs), begin, points: 700, axis: SensorAxis::Body };
            let [wide, narrow] = [with_wide_registers(following()), following().run()];
            assert!(wide.each().iter().all(Option::is_some) && wide == narrow, "{legs:?}");
        }
    }

    #[test]
    fn analytic_a_level_landing_is_that_of_one_spring_and_damper() {
        let landing = simulate(&BODY, &LEGS, STRAIGHT, [0.0; 2], 100).expect("it lands");
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
        let landing = simulate(&BODY, &LEGS, STRAIGHT, [0.1, 0.04], 1000).expect("it lands");
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
            let [landing] = simulate_each(&BODY, &LEGS, STRAIGHT, &[[slope, 0.0]], 400, axis).each();
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
    fn analytic_feet_with_mass_throw_the_body_back_and_have_a_part_of_the_inertia() {
        let feet = |share: f64| Legs { damping_n_s_m: 0.0, feet: Some(FootMode { share, f_hz: 250.0, zeta: 0.0 }), ..LEGS };
        let landing = simulate(&BODY, &feet(0.15), Descent { speed_m_s: 2.0, ..STRAIGHT }, [0.0; 2], 600).expect("it lands");
        let impulse = landing.accel_g.iter().sum::<f64>() * STEP_S * GRAVITY_M_S2;
        // Without dampers the body comes back nearly as fast; gravity and the feet's swing make the rest.
        assert!((3.0..4.4).contains(&impulse), "{impulse}");
        // Feet that have more than all of the moment of inertia are none.
        assert_eq!(simulate(&BODY, &Legs { inertia_kg_m2: 1e-4, ..feet(0.4) }, STRAIGHT, [0.0; 2], 10), None);
    }

    #[test]
    fn analytic_the_first_blow_of_a_foot_is_that_of_its_own_mass() {
        // A foot alone meets the ground: its own mass on the leg and on its spring, both held by a body that hardly moves yet.
        let legs = Legs { damping_n_s_m: 0.0, feet: Some(FootMode { share: 0.04, f_hz: 300.0, zeta: 0.0 }), ..LEGS };
        let landing = simulate(&BODY, &legs, STRAIGHT, [0.1, 0.0], 30).expect("it lands");
        let foot_kg = 0.01 * BODY.mass_kg;
        let held = foot_kg * (std::f64::consts::TAU * 300.0).powi(2);
        let swing = ((held + 0.25 * LEGS.stiffness_n_m) / foot_kg).sqrt();
        // u'' + swing² u = -k v t / 4 m_f: the leg is pressed by v t + u.
        let push = 0.25 * LEGS.stiffness_n_m * 4.0 / foot_kg;
        for point in [8, 12] {
            let t = f64::from(point) * STEP_S;
            let u = -push / (swing * swing) * (t - libm::sin(swing * t) / swing);
            let expected = -held * u / (0.96 * BODY.mass_kg) / GRAVITY_M_S2;
            let read = landing.accel_g[point as usize];
            assert!((read / expected - 1.0).abs() < 0.06, "{point}: {read} {expected}");
        }
    }

    #[test]
    fn analytic_a_body_that_turns_lowers_and_lifts_its_feet_before_anything_pushes() {
        // Hardly any spring: the slope grows evenly, and the far foot comes down by z + r (sin p0 - sin p) - h (cos p0 - cos p).
        let soft = Legs { stiffness_n_m: 1e-6, damping_n_s_m: 0.0, ..LEGS };
        let (slope, turning_1_s, r, h) = (0.1_f64, 3.0, BODY.foot_radius_m, BODY.centre_height_m);
        let landing = simulate(&BODY, &soft, Descent { turning_1_s, ..STRAIGHT }, [slope, 0.0], 1000).expect("it lands");
        let touch_s = landing.touch_s[1].expect("touches");
        let turned = slope * (1.0 + turning_1_s * touch_s);
        let below_m = |slope: f64| r * libm::sin(slope) + h * (1.0 - libm::cos(slope));
        let sunk_m = 4.0 * touch_s + 0.5 * GRAVITY_M_S2 * touch_s * touch_s;
        let raised_m = r * libm::sin(slope) - h * (1.0 - libm::cos(slope));
        assert!((sunk_m - raised_m - below_m(turned)).abs() < 1e-6, "{touch_s} {sunk_m} {raised_m} {turned}");
        // With no slope there is no turning.
        let level = |turning_1_s| simulate(&BODY, &LEGS, Descent { turning_1_s, ..STRAIGHT }, [0.0; 2], 300);
        assert_eq!(level(3.0), level(0.0));
    }

    #[test]
    fn analytic_mirrored_slopes_land_alike() {
        let wave = |slopes| simulate(&BODY, &LEGS, STRAIGHT, slopes, 300).expect("it lands").accel_g;
        let same = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(same(wave([0.1, 0.05]), wave([-0.1, 0.05])) && same(wave([0.1, 0.05]), wave([0.05, 0.1])));
    }
}
