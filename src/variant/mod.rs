//! Variants: the measures of a frame, the differences of two frames, sensitivities to a parameter, and a search for better frames.

mod aim;
mod approach;
mod changed;
mod choose;
mod create;
mod descent;
mod difference;
mod ended;
mod feasible;
mod goal;
mod improve;
mod measures;
mod pareto;
mod peak;
mod planes;
mod problem;
mod retreat;
mod search;
mod sensitivity;
mod sketch;
mod solve;
mod stated_values;

pub use aim::Aim;
pub use changed::{Changed, Trend};
pub use choose::{Chosen, NameChoice, choose};
pub use create::{CreateError, Creation, Moved, Request, create, movable};
pub use difference::{Difference, Side, why_not_compared};
pub use ended::Ended;
pub use goal::{Goal, GoalError, Increase, Sense};
pub use measures::{Better, Evaluation, MEASURES, MECHANICS_CAVEAT, Measure, caveats, measure, measure_names};
pub use pareto::{Front, FrontPoint, front};
pub use peak::{PEAK_CAVEAT, PredictedPeak, predicted_peak};
pub use problem::{Binding, SearchProblem, SearchProgress, Solution, SolveError, Vary};
pub use sensitivity::{Response, sensitivity};
pub use solve::solve;
