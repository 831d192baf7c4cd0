//! A landing on one foot first, as the generator follows it: a rigid body in space on four feet.
//!
//! Nothing is small here: the body's attitude is a rotation, the feet hang below the centre of mass, and Newton's and Euler's
//! equations are stepped by the semi-implicit method of Euler, 10 µs a step. The sensor turns with the body. Where feet have friction on the
//! ground, each holds on to its place by a spring and damper until that pulls by more than the friction, and takes the place along then (P. A. Cundall, O. D. L.
//! Strack, Géotechnique 29 (1979) 47). What a foot's touch does sideways beside it is drawn, not derived: a spike of 1.5 ms away from the foot, and a third of it back.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector2, Vector3};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

use super::trajectory::VerticalConditions;
use crate::units::GRAVITY_M_S2;

/// Step of the method, s.
const STEP_S: f64 = 1e-5;
/// From the centre of mass down to the feet, m.
const BELOW_M: f64 = 0.05;
/// What holds a foot at its place on the ground: stiffness, N/m, and damping, N s/m. A choice of this generator, no measurement: some thirty times
/// as stiff as a leg of the published frame (7040 N/m on four), so that a foot that does not slip hardly moves, and a quarter of the critical
/// damping of a quarter of its mass.
const HOLD_N_M: f64 = 5e4;
const HOLD_N_S_M: f64 = 25.0;
/// Length of a spike, s.
const SPIKE_S: f64 = 1.5e-3;
/// What comes back after it.
const BACK: f64 = 0.33;
/// Moment of inertia about the vertical axis over that about the others.
const VERTICAL_AXIS: f64 = 1.7;
/// A level frame rings sideways at this frequency, Hz, and for so long, s.
const RINGING_HZ: f64 = 190.0;
const RINGING_S: f64 = 6e-3;

/// Landings of a plan that has lateral axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landings {
    /// Standard deviation of the turning rate at release about each horizontal axis, rad/s.
    pub rate_rad_s: f64,
    /// Standard deviation of the slope at release about each horizontal axis, rad.
    pub at_release_rad: f64,
    /// Moment of inertia about a horizontal axis, kg m².
    pub inertia_kg_m2: f64,
    /// From the vertical axis to each foot, m.
    pub foot_radius_m: f64,
    /// Mass that the feet carry themselves; `None` for none.
    pub heavy_feet: Option<HeavyFeet>,
    /// Coefficient of friction of the feet on the ground; 0 for none.
    pub ground_friction: f64,
    /// Mean height of a touch's spike, g; 0 for none.
    pub touch_g: f64,
    /// The sensor's lean against the body: how far its axis points toward x and toward y, rad.
    pub sensor_lean_rad: [f64; 2],
    /// Sideways ringing from first touch on, in any direction, standard deviation of its height, g.
    pub ringing_g: f64,
}

/// Feet with mass, each on a spring and damper between it and the body, along the body's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeavyFeet {
    /// Of all four, as a part of the whole mass.
    pub share: f64,
    /// Frequency of a foot on a body that is held, Hz.
    pub f_hz: f64,
    /// Damping over the critical one.
    pub zeta: f64,
}

/// Readings along the sensor's x, y and z, g, evenly spaced from first touch on.
pub(super) type Axes = [Vec<f64>; 3];

impl Landings {
    /// Whether landings differ in slope.
    pub fn is_tilted(&self) -> bool {
        self.rate_rad_s > 0.0 || self.at_release_rad > 0.0
    }

    /// Whether they are followed in space: they slope, or their feet have mass.
    pub fn is_in_space(&self) -> bool {
        self.is_tilted() || self.heavy_feet.is_some()
    }

    /// What the feet have of the moment of inertia about a horizontal axis, kg m²: two of them stand on each diagonal.
    pub(super) fn inertia_of_feet_kg_m2(&self, whole_kg: f64) -> f64 {
        self.heavy_feet.map_or(0.0, |feet| 0.5 * feet.share * whole_kg * self.foot_radius_m.powi(2))
    }

    /// What a sensor that leans reads of an acceleration in the body's axes.
    pub(super) fn read_by_sensor(&self, acceleration_g: [f64; 3]) -> [f64; 3] {
        let [toward_x, toward_y] = self.sensor_lean_rad;
        let sensor = Rotation3::new(Vector3::new(-toward_y, toward_x, 0.0));
        (sensor.inverse() * Vector3::from(acceleration_g)).into()
    }

    /// One landing with a random slope.
    pub(super) fn tilted(&self, drop: &VerticalConditions, every_s: f64, count: usize, rng: &mut impl Rng) -> Axes {
        let mut about_axes = |deviation: f64| -> [f64; 2] {
            std::array::from_fn(|_| deviation * <StandardNormal as Distribution<f64>>::sample(&StandardNormal, rng))
        };
        let rates_rad_s = about_axes(self.rate_rad_s);
        // Without slopes at release nothing is drawn for them.
        let at_release_rad = if self.at_release_rad > 0.0 { about_axes(self.at_release_rad) } else { [0.0; 2] };
        let mut body = Body::of(self, drop, rates_rad_s, at_release_rad);
        let spikes: [f64; 4] = std::array::from_fn(|_| self.touch_g * rng.random_range(0.7..1.3));
        let steps = (every_s / STEP_S).round().max(1.0) as usize;
        let mut axes: Axes = std::array::from_fn(|_| Vec::with_capacity(count));
        for point in 0..count {
            let t_s = point as f64 * every_s;
            let [x, y] = sideways_g(&body, &spikes, t_s);
            let own = body.reading_g();
            axes[0].push(own.x + x);
            axes[1].push(own.y + y);
            axes[2].push(drop.gain * body.filtered.last().copied().unwrap_or(own.z));
            for step in 0..steps {
                body.step(drop, t_s + step as f64 * STEP_S);
            }
        }
        axes
    }

    /// Sideways ringing of a frame that lands level, from first touch on, g.
    pub(super) fn ringing(&self, every_s: f64, count: usize, rng: &mut impl Rng) -> [Vec<f64>; 2] {
        let angle = rng.random_range(0.0..std::f64::consts::TAU);
        let size: f64 = StandardNormal.sample(rng);
        let phase = rng.random_range(0.0..std::f64::consts::TAU);
        let at = |t: f64| self.ringing_g * size * libm::exp(-t / RINGING_S) * libm::sin(std::f64::consts::TAU * RINGING_HZ * t + phase);
        let along = |share: f64| (0..count).map(|point| share * at(point as f64 * every_s)).collect();
        [along(libm::cos(angle)), along(libm::sin(angle))]
    }
}

/// The sum of the feet's spikes, g.
fn sideways_g(body: &Body, spikes: &[f64; 4], t_s: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (foot, (touched_s, size)) in body.touched_s.iter().zip(spikes).enumerate() {
        let Some(age) = touched_s.map(|touched_s| t_s - touched_s) else { continue };
        let shape = match age / SPIKE_S {
            place if (0.0..1.0).contains(&place) => libm::sin(std::f64::consts::PI * place),
            place if (1.0..2.0).contains(&place) => -BACK * libm::sin(std::f64::consts::PI * (place - 1.0)),
            _ => 0.0,
        };
        let away = -body.feet[foot];
        sum[0] += size * shape * away.x / body.radius_m;
        sum[1] += size * shape * away.y / body.radius_m;
    }
    sum
}

/// How the body moves along the ground.
struct Sideways {
    friction: f64,
    place_m: Vector2<f64>,
    speed_m_s: Vector2<f64>,
    acceleration_m_s2: Vector2<f64>,
    /// Where each foot that touches holds on.
    held_m: [Option<Vector2<f64>>; 4],
}

impl Sideways {
    fn standing(friction: f64) -> Self {
        let zero = Vector2::zeros();
        Self { friction, place_m: zero, speed_m_s: zero, acceleration_m_s2: zero, held_m: [None; 4] }
    }

    /// Force of the ground on a foot, N: how far it is off the centre of mass, m, how fast, m/s, and what presses it, N; none for one in the air.
    fn force_n(&mut self, foot: usize, arm_m: Vector2<f64>, turning_m_s: Vector2<f64>, pressed_n: Option<f64>) -> Vector2<f64> {
        let Some(pressed_n) = pressed_n else {
            self.held_m[foot] = None;
            return Vector2::zeros();
        };
        let here_m = self.place_m + arm_m;
        let held_m = self.held_m[foot].get_or_insert(here_m);
        let pull_n = HOLD_N_M * (*held_m - here_m) - HOLD_N_S_M * (self.speed_m_s + turning_m_s);
        let most_n = self.friction * pressed_n.max(0.0);
        if pull_n.norm() <= most_n {
            return pull_n;
        }
        let force_n = pull_n * (most_n / pull_n.norm());
        *held_m = here_m + force_n / HOLD_N_M;
        force_n
    }

    fn step(&mut self, force_n: Vector2<f64>, mass_kg: f64) {
        self.acceleration_m_s2 = force_n / mass_kg;
        self.speed_m_s += STEP_S * self.acceleration_m_s2;
        self.place_m += STEP_S * self.speed_m_s;
    }
}

/// A rigid body in space.
struct Body {
    /// Feet in the body's axes, m.
    feet: [Vector3<f64>; 4],
    radius_m: f64,
    inertia: Matrix3<f64>,
    height_m: f64,
    speed_m_s: f64,
    attitude: UnitQuaternion<f64>,
    turning_rad_s: Vector3<f64>,
    acceleration_m_s2: f64,
    sideways: Sideways,
    filtered: Vec<f64>,
    touched_s: [Option<f64>; 4],
    heavy: Option<HeavyFeet>,
    /// Of each foot with mass: how far it stands below its place on the body, m, and how fast it goes down there, m/s.
    swing: [[f64; 2]; 4],
}

impl Body {
    /// At first touch: it has turned while it fell, and does so still.
    fn of(landings: &Landings, drop: &VerticalConditions, rates_rad_s: [f64; 2], at_release_rad: [f64; 2]) -> Self {
        let side = landings.foot_radius_m * std::f64::consts::FRAC_1_SQRT_2;
        let feet = [(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)].map(|(x, y)| Vector3::new(x * side, y * side, -BELOW_M));
        let [turning_rad_s, at_release_rad] = [rates_rad_s, at_release_rad].map(|[about_x, about_y]| Vector3::new(about_x, about_y, 0.0));
        let attitude = UnitQuaternion::from_scaled_axis(turning_rad_s * drop.fall_s + at_release_rad);
        let lowest = feet.iter().map(|foot| (attitude * foot).z).fold(f64::INFINITY, f64::min);
        // What of the moment of inertia the feet do not have. About the vertical axis nothing turns.
        let i = landings.inertia_kg_m2 - landings.inertia_of_feet_kg_m2(drop.mass_kg);
        Self {
            feet,
            radius_m: landings.foot_radius_m,
            inertia: Matrix3::from_diagonal(&Vector3::new(i, i, VERTICAL_AXIS * i)),
            height_m: -lowest,
            speed_m_s: -drop.speed_m_s,
            attitude,
            turning_rad_s: attitude.inverse() * turning_rad_s,
            acceleration_m_s2: -GRAVITY_M_S2,
            sideways: Sideways::standing(landings.ground_friction),
            filtered: vec![0.0; drop.stages],
            touched_s: [None; 4],
            heavy: landings.heavy_feet,
            swing: [[0.0; 2]; 4],
        }
    }

    /// Proper acceleration in the body's axes, g.
    fn reading_g(&self) -> Vector3<f64> {
        let along = self.sideways.acceleration_m_s2 / GRAVITY_M_S2;
        self.attitude.inverse() * Vector3::new(along.x, along.y, self.acceleration_m_s2 / GRAVITY_M_S2 + 1.0)
    }

    fn step(&mut self, drop: &VerticalConditions, t_s: f64) {
        let turning = self.attitude * self.turning_rad_s;
        let (mut lift_n, mut torque) = (0.0, Vector3::zeros());
        let share = self.heavy.map_or(0.0, |feet| feet.share);
        let mut onto_feet = [0.0; 4];
        let mut along_n = Vector2::zeros();
        for (i, foot) in self.feet.iter().enumerate() {
            let arm = self.attitude * foot;
            let [below_m, falling_m_s] = self.swing[i];
            let above_m = self.height_m + arm.z - below_m;
            let mut push_n = 0.0;
            if above_m <= 0.0 {
                self.touched_s[i].get_or_insert(t_s);
                let sinking_m_s = falling_m_s - (self.speed_m_s + turning.cross(&arm).z);
                push_n = drop.foot_n(-above_m, sinking_m_s);
            }
            let pressed_n = (above_m <= 0.0).then_some(push_n);
            let held_n = self.sideways.force_n(i, arm.xy(), turning.cross(&arm).xy(), pressed_n);
            along_n += held_n;
            if let Some(feet) = self.heavy {
                let (mass_kg, circular) = (0.25 * share * drop.mass_kg, 2.0 * std::f64::consts::PI * feet.f_hz);
                let spring_n = -mass_kg * circular * (circular * below_m + 2.0 * feet.zeta * falling_m_s);
                // Downward, of the foot alone in space.
                onto_feet[i] = (spring_n - push_n) / mass_kg + GRAVITY_M_S2;
                push_n = spring_n;
            }
            lift_n += push_n;
            torque += arm.cross(&Vector3::new(held_n.x, held_n.y, push_n));
        }
        self.sideways.step(along_n, drop.mass_kg);
        self.acceleration_m_s2 = lift_n / ((1.0 - share) * drop.mass_kg) - GRAVITY_M_S2;
        let own = self.attitude.inverse() * torque;
        let spin = self.turning_rad_s.cross(&(self.inertia * self.turning_rad_s));
        let inverse = self.inertia.map_diagonal(|i| 1.0 / i);
        let gained_rad_s = STEP_S * (own - spin).component_mul(&inverse);
        self.turning_rad_s += gained_rad_s;
        if self.heavy.is_some() {
            let gained_rad_s = self.attitude * gained_rad_s;
            for (i, foot) in self.feet.iter().enumerate() {
                let place_m_s = STEP_S * self.acceleration_m_s2 + gained_rad_s.cross(&(self.attitude * foot)).z;
                self.swing[i][1] += STEP_S * onto_feet[i] + place_m_s;
                self.swing[i][0] += STEP_S * self.swing[i][1];
            }
        }
        self.speed_m_s += STEP_S * self.acceleration_m_s2;
        self.height_m += STEP_S * self.speed_m_s;
        self.attitude *= UnitQuaternion::from_scaled_axis(STEP_S * self.turning_rad_s);
        let mut input = self.reading_g().z;
        for stage in &mut self.filtered {
            *stage += STEP_S * drop.filter_1_s * (input - *stage);
            input = *stage;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// A foot that is moved along the ground is held by at most the friction, and by all of it once it slides.
        #[test]
        fn analytic_a_foot_is_held_by_at_most_its_friction(friction in 0.05_f64..1.0, pressed_n in 1.0_f64..200.0, x_m_s in 0.2_f64..3.0, y_m_s in -3.0_f64..3.0) {
            let mut sideways = Sideways::standing(friction);
            let speed_m_s = Vector2::new(x_m_s, y_m_s);
            let mut force_n = Vector2::zeros();
            for step in 0..4000 {
                force_n = sideways.force_n(0, speed_m_s * (f64::from(step) * STEP_S), speed_m_s, Some(pressed_n));
                prop_assert!(force_n.norm() <= friction * pressed_n * (1.0 + 1e-9));
            }
            // Against the motion, and as large as friction allows.
            prop_assert!((force_n + speed_m_s.normalize() * friction * pressed_n).norm() < 1e-6 * friction * pressed_n);
            // In the air nothing holds it, and it holds on anew where it comes down.
            prop_assert_eq!(sideways.force_n(0, speed_m_s, speed_m_s, None), Vector2::zeros());
            prop_assert_eq!(sideways.force_n(0, speed_m_s, Vector2::zeros(), Some(pressed_n)), Vector2::zeros());
        }
    }

    #[test]
    fn analytic_what_the_ground_pushes_is_the_momentum_of_the_body() {
        let mut sideways = Sideways::standing(0.5);
        let force_n = Vector2::new(3.0, -1.5);
        (0..1000).for_each(|_| sideways.step(force_n, 0.25));
        assert!((sideways.speed_m_s - force_n / 0.25 * 1000.0 * STEP_S).norm() < 1e-9);
        assert_eq!(sideways.acceleration_m_s2, force_n / 0.25);
    }
}
