//! Variants: what a frame measures, how two frames differ, what a parameter does, and a search for better ones.

mod create;
mod difference;
mod feasible;
mod goal;
mod measures;
mod peak;
mod problem;
mod search;
mod sensitivity;
mod solve;

pub use create::{CreateError, Creation, Moved, Request, create};
pub use difference::{Changed, Difference, Side, Trend};
pub use goal::{Goal, GoalError, Increase, Sense};
pub use measures::{Better, Evaluation, MEASURES, MECHANICS_CAVEAT, Measure, measure, measure_names};
pub use peak::{PEAK_CAVEAT, predicted_peak_g};
pub use problem::{Aim, Binding, SearchProblem, Solution, SolveError, Vary};
pub use sensitivity::{Response, sensitivity};
pub use solve::solve;
