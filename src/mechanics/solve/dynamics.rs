//! Motion in time: generalised-α, with branches that relax and feet that touch.
//!
//! J. Chung, G. M. Hulbert, J. Appl. Mech. 60 (1993) 371, forces weighted between the ends of the step; spins are treated as
//! displacements over one step, and moments of inertia as fixed in space, both of which are small for the nodes of beams.

use crate::mechanics::element::bushing::Gap;
use crate::mechanics::element::matrices::Local;
use crate::mechanics::element::relaxation::Relaxation;
use crate::mechanics::system::equation_system::{Sum, System};
use crate::mechanics::system::sparse::{SparseError, Work};
use crate::mechanics::system::structure::{Bias, State};

/// Spectral radius at infinite frequency: how much of what is too fast for the step stays in it.
const RADIUS: f64 = 0.6;

/// Most iterations of a step.
const ITERATIONS: usize = 24;

/// Factors of an earlier state are good enough while each iteration leaves at most this part of the force that was left.
const SLOW: f64 = 0.3;

/// Shortest step, as a part of the usual one.
const SHORTEST: f64 = 1.0 / 64.0;

/// The parameters of the method.
#[derive(Clone, Copy)]
struct Weights {
    mass: f64,
    force: f64,
    gamma: f64,
    beta: f64,
}

impl Weights {
    fn new(radius: f64) -> Self {
        let (mass, force) = ((2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0));
        let gamma = 0.5 - mass + force;
        Self { mass, force, gamma, beta: 0.25 * (1.0 - mass + force) * (1.0 - mass + force) }
    }
}

/// Why a motion ended.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DynamicsError {
    /// The matrix is singular.
    #[error(transparent)]
    Sparse(#[from] SparseError),
    /// Iterations ran away even in short steps.
    #[error("the motion was lost at {t_ms:.3} ms")]
    Lost {
        /// When.
        t_ms: f64,
    },
}

/// A motion in progress.
pub struct TimeIntegration<'a> {
    pub(in crate::mechanics) system: &'a System,
    pub(in crate::mechanics) relaxation: Relaxation,
    weights: Weights,
    pub(in crate::mechanics) masses: Vec<f64>,
    gravity: Vec<f64>,
    work: Work,
    /// The step, ms, that the factors at hand were made for; none before the first.
    factored_ms: Option<f64>,
    pub(in crate::mechanics) sum: Sum,
    /// Time, ms.
    pub t_ms: f64,
    /// Where everything is.
    pub state: State,
    /// Velocities of the unknowns, mm/ms, 1/ms.
    pub velocity: Vec<f64>,
    /// Accelerations.
    pub acceleration: Vec<f64>,
    /// Force on the elements at the step's start.
    force: Vec<f64>,
    /// Stretch of elements, and of each branch of each.
    pub(in crate::mechanics) beams: Vec<Vec<Local>>,
    pub(in crate::mechanics) ties: Vec<Vec<Gap>>,
    /// Loss of each beam, then each tie, mJ.
    pub lost_mj: Vec<f64>,
    /// Normal force of the feet, N.
    pub ground_n: f64,
    pub(in crate::mechanics) friction_mj: f64,
    pub(in crate::mechanics) gravity_mj: f64,
}

/// A step that has converged.
struct Step {
    state: State,
    moved: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
}

impl<'a> TimeIntegration<'a> {
    /// Starts from a state without strain, with velocities; gravity acts along -z, mm/ms².
    pub fn new(system: &'a System, relaxation: Relaxation, state: State, velocity: Vec<f64>, gravity_mm_ms2: f64) -> Self {
        let masses = system.masses();
        let mut gravity = vec![0.0; masses.len()];
        for node in 0..system.structure.nodes.len() {
            let z = system.unknowns.of(node)[2];
            if z != crate::mechanics::system::sparse::NOWHERE {
                gravity[z] = -masses[z] * gravity_mm_ms2;
            }
        }
        let acceleration = gravity.iter().zip(&masses).map(|(g, m)| if *m > 0.0 { g / m } else { 0.0 }).collect();
        let branches = 1 + relaxation.branches.len();
        let structure = &system.structure;
        Self {
            weights: Weights::new(RADIUS),
            work: system.pattern.work(),
            factored_ms: None,
            sum: Sum::default(),
            t_ms: 0.0,
            state,
            velocity,
            acceleration,
            force: vec![0.0; masses.len()],
            beams: vec![vec![Local::zeros(); branches]; structure.beams.len()],
            ties: vec![vec![Gap::zeros(); branches]; structure.ties.len()],
            lost_mj: vec![0.0; structure.beams.len() + structure.ties.len()],
            ground_n: 0.0,
            friction_mj: 0.0,
            gravity_mj: 0.0,
            system,
            relaxation,
            masses,
            gravity,
        }
    }

    /// Goes on by a time, in shorter steps where it has to.
    ///
    /// # Errors
    /// When the matrix is singular or even the shortest step does not converge.
    pub fn advance(&mut self, by_ms: f64) -> Result<(), DynamicsError> {
        let (end, mut step) = (self.t_ms + by_ms, by_ms);
        while self.t_ms < end - 1e-9 * by_ms {
            let now = step.min(end - self.t_ms);
            match self.attempt(now)? {
                Some(done) => {
                    self.accept(done, now);
                    step = (2.0 * step).min(by_ms);
                }
                None if step > by_ms * SHORTEST => step *= 0.5,
                None => return Err(DynamicsError::Lost { t_ms: self.t_ms }),
            }
        }
        Ok(())
    }

    fn attempt(&mut self, dt: f64) -> Result<Option<Step>, DynamicsError> {
        let w = self.weights;
        let bias = self.bias(dt);
        let size = self.masses.len();
        // Start with the acceleration of before.
        let mut moved: Vec<f64> = (0..size).map(|i| dt * self.velocity[i] + 0.5 * dt * dt * self.acceleration[i]).collect();
        let mut state = self.state.clone();
        state.moved(&self.system.unknowns, &moved);
        let mut before = f64::INFINITY;
        for iteration in 0..ITERATIONS {
            self.system.push(&state, &bias, &mut self.sum);
            let acceleration: Vec<f64> = (0..size)
                .map(|i| (moved[i] - dt * self.velocity[i]) / (w.beta * dt * dt) - (0.5 / w.beta - 1.0) * self.acceleration[i])
                .collect();
            let mut left: Vec<f64> = (0..size)
                .map(|i| {
                    let inertia = self.masses[i] * ((1.0 - w.mass) * acceleration[i] + w.mass * self.acceleration[i]);
                    self.gravity[i] - inertia - (1.0 - w.force) * self.sum.force[i] - w.force * self.force[i]
                })
                .collect();
            let error = left.iter().map(|f| f * f).sum::<f64>().sqrt();
            let scale = self.sum.force.iter().map(|f| f * f).sum::<f64>().sqrt();
            if !error.is_finite() {
                return Ok(None);
            }
            if iteration > 0 && error < 2e-4 + 2e-5 * scale {
                let velocity = (0..size)
                    .map(|i| self.velocity[i] + dt * ((1.0 - w.gamma) * self.acceleration[i] + w.gamma * acceleration[i]))
                    .collect();
                return Ok(Some(Step { state, moved, velocity, acceleration }));
            }
            if self.factored_ms != Some(dt) || error > SLOW * before {
                self.factorise(&state, &bias, dt)?;
            }
            before = error;
            self.system.pattern.solve(&mut self.work, &mut left);
            if left.iter().any(|d| d.is_nan() || d.abs() > 20.0) {
                return Ok(None);
            }
            state.moved(&self.system.unknowns, &left);
            moved.iter_mut().zip(&left).for_each(|(m, d)| *m += d);
        }
        Ok(None)
    }

    /// Factors for a state and a step.
    fn factorise(&mut self, state: &State, bias: &Bias, dt: f64) -> Result<(), DynamicsError> {
        let w = self.weights;
        self.system.assemble(state, bias, &mut self.sum);
        self.sum.tangent.iter_mut().for_each(|value| *value *= 1.0 - w.force);
        self.system.add_diagonal(&mut self.sum.tangent, (1.0 - w.mass) / (w.beta * dt * dt), &self.masses);
        self.factored_ms = None;
        self.system.pattern.factorise(&self.sum.tangent, &mut self.work)?;
        self.factored_ms = Some(dt);
        Ok(())
    }

    fn accept(&mut self, step: Step, dt: f64) {
        self.t_ms += dt;
        self.gravity_mj += self.gravity.iter().zip(&step.moved).map(|(g, m)| g * m).sum::<f64>();
        let mut state = step.state;
        for (foot, contact) in self.system.structure.feet.iter().zip(&self.sum.contacts) {
            let Some(contact) = contact else { continue };
            self.friction_mj += foot.friction * contact.normal_n * contact.slid_mm;
        }
        self.ground_n = self.sum.contacts.iter().flatten().map(|contact| contact.normal_n).sum();
        self.system.settle(&mut state, &self.sum);
        self.force.clone_from(&self.sum.force);
        self.state = state;
        self.velocity = step.velocity;
        self.acceleration = step.acceleration;
        self.relax(dt);
    }
}
