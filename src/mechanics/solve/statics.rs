//! Equilibrium under a load that grows, with one displacement in command: past limit points, too.
//!
//! Newton's iterations on the full tangent. Each solves for two right-hand sides, the forces left over and the load, and
//! takes as much of the load as brings the commanded displacement to its value (J.-L. Batoz, G. Dhatt, Int. J. Numer. Meth.
//! Engng 14 (1979) 1262). The way on from two states is extrapolated.

use crate::mechanics::system::equation_system::{Sum, System};
use crate::mechanics::system::sparse::{SparseError, Work};
use crate::mechanics::system::structure::State;

/// A load and the displacement in command.
#[derive(Clone, Debug)]
pub struct Command {
    /// The load's direction over the unknowns; the load factor multiplies it.
    pub load: Vec<f64>,
    /// The unknown in command.
    pub unknown: usize,
}

/// An equilibrium.
#[derive(Clone, Debug)]
pub struct Balance {
    /// Sum of the commanded displacement so far, mm or rad.
    pub displacement: f64,
    /// Load factor.
    pub load: f64,
    /// Where everything is.
    pub state: State,
    /// Iterations it took.
    pub iterations: usize,
    /// Directions in which the structure would give way at this displacement, the commanded one free.
    pub unstable: usize,
}

/// Why no equilibrium was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StaticsError {
    /// The tangent is singular.
    #[error(transparent)]
    Sparse(#[from] SparseError),
    /// Iterations ran away.
    #[error("no equilibrium was found at a displacement of {displacement:.3}")]
    Lost {
        /// Where.
        displacement: f64,
    },
}

/// How exactly.
#[derive(Clone, Copy, Debug)]
pub struct Precision {
    /// Force left over, relative to the load.
    pub relative: f64,
    /// Force left over that is always small enough, N.
    pub absolute_n: f64,
    /// Most iterations of one step.
    pub iterations: usize,
    /// How often a step may be halved.
    pub halvings: usize,
}

impl Default for Precision {
    fn default() -> Self {
        Self { relative: 1e-7, absolute_n: 1e-6, iterations: 25, halvings: 4 }
    }
}

/// Follows a structure from rest through displacements.
pub struct Path<'a> {
    system: &'a System,
    command: Command,
    precision: Precision,
    work: Work,
    sum: Sum,
    /// Unknowns' change over the last step, per unit of displacement.
    direction: Option<Vec<f64>>,
    last: Balance,
}

impl<'a> Path<'a> {
    /// Starts in a state that is in balance without load.
    pub fn new(system: &'a System, command: Command, state: State, precision: Precision) -> Self {
        let last = Balance { displacement: 0.0, load: 0.0, state, iterations: 0, unstable: 0 };
        Self { system, command, precision, work: system.pattern.work(), sum: Sum::default(), direction: None, last }
    }

    /// The equilibrium last found.
    pub fn last(&self) -> &Balance {
        &self.last
    }

    /// Goes to a displacement; in smaller steps where one is too large.
    ///
    /// # Errors
    /// When the tangent is singular or iterations run away even in small steps.
    pub fn go(&mut self, displacement: f64) -> Result<&Balance, StaticsError> {
        let from = self.last.displacement;
        let mut lost = StaticsError::Lost { displacement };
        for halving in 0..=self.precision.halvings {
            let steps = 1_usize << halving;
            let kept = (self.last.clone(), self.direction.clone());
            let went = (1..=steps).try_for_each(|step| self.step(from + (displacement - from) * step as f64 / steps as f64));
            match went {
                Ok(()) => return Ok(&self.last),
                Err(error) => lost = error,
            }
            (self.last, self.direction) = kept;
            self.direction = None;
        }
        Err(lost)
    }

    fn step(&mut self, displacement: f64) -> Result<(), StaticsError> {
        let by = displacement - self.last.displacement;
        let mut state = self.last.state.clone();
        let mut load = self.last.load;
        let size = self.system.unknowns.size();
        let mut moved = vec![0.0; size];
        if let Some(direction) = &self.direction {
            moved = direction.iter().map(|d| d * by).collect();
            state.moved(&self.system.unknowns, &moved);
        }
        let bias = self.system.elastic();
        for iteration in 1..=self.precision.iterations {
            self.system.assemble(&state, &bias, &mut self.sum);
            let left: Vec<f64> = self.sum.force.iter().zip(&self.command.load).map(|(f, q)| load * q - f).collect();
            let missing = by - moved[self.command.unknown];
            let error = left.iter().map(|f| f * f).sum::<f64>().sqrt();
            let enough = self.precision.absolute_n + self.precision.relative * load.abs();
            if iteration > 1 && error < enough && missing.abs() < 1e-9 * (1.0 + by.abs()) {
                return self.arrive(displacement, load, state, iteration, &moved, by);
            }
            self.system.pattern.factorise(&self.sum.tangent, &mut self.work)?;
            let (mut by_rest, mut by_load) = (left, self.command.load.clone());
            self.system.pattern.solve(&mut self.work, &mut by_rest);
            self.system.pattern.solve(&mut self.work, &mut by_load);
            let more = (missing - by_rest[self.command.unknown]) / by_load[self.command.unknown];
            let change: Vec<f64> = by_rest.iter().zip(&by_load).map(|(r, q)| r + more * q).collect();
            let largest = change.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
            if !largest.is_finite() || largest > 1e3 {
                break;
            }
            load += more;
            state.moved(&self.system.unknowns, &change);
            moved.iter_mut().zip(&change).for_each(|(m, c)| *m += c);
        }
        Err(StaticsError::Lost { displacement })
    }

    fn arrive(
        &mut self,
        displacement: f64,
        load: f64,
        mut state: State,
        iterations: usize,
        moved: &[f64],
        by: f64,
    ) -> Result<(), StaticsError> {
        self.system.settle(&mut state, &self.sum);
        let unstable = self.system.pattern.negative_pivots(&self.work);
        self.direction = Some(moved.iter().map(|m| m / by).collect());
        self.last = Balance { displacement, load, state, iterations, unstable };
        Ok(())
    }
}
