//! A new variant: what is asked for on top of a frame, and what has to change with it.

use std::ops::ControlFlow;

use super::aim::Aim;
use super::ended::Ended;
use super::feasible::presets;
use super::measures::Evaluation;
use super::problem::{SearchProblem, SearchProgress, Solution, SolveError, Vary};
use super::solve::solve;
use crate::checks::Verdict;
use crate::frame::assembly::Design;
use crate::frame::skeleton::{Envelope, lengths_for};
use crate::params::refusal::Refusal;
use crate::params::{Frame, FrameFile, parameters};

/// What is asked for: already set in the file.
pub struct Request<'a> {
    /// The frame with the wishes in it.
    pub file: &'a FrameFile,
    /// The frame without them.
    pub from: &'a Frame,
    /// Width and height to stay within, mm, when asked for.
    pub envelope_mm: Option<[f64; 2]>,
    /// How many frames may be looked at.
    pub most: usize,
    /// Who follows the search, and may end it.
    pub follows: &'a (dyn Fn(&SearchProgress) -> ControlFlow<()> + Sync + 'a),
}

/// A number that had to change.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Its key with its table.
    pub key: String,
    /// In the frame that it came from.
    pub before: f64,
    /// In the new one.
    pub after: f64,
}

/// A new variant.
pub struct Creation {
    /// The frame.
    pub evaluation: Evaluation,
    /// What had to change, besides what was asked for.
    pub moved: Vec<Moved>,
    /// What would be violated without those changes.
    pub why: Vec<String>,
    /// How many frames were looked at.
    pub looked_at: usize,
    /// Why the search ended.
    pub ended: Ended,
}

/// Why there is no such variant.
#[derive(Debug, thiserror::Error)]
pub enum CreateError {
    /// What is asked for is refused.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// No frame near by keeps all limits.
    #[error(transparent)]
    Unsolved(#[from] SolveError),
}

/// Numbers that may change, the frame's size: none of them is a matter of taste or print.
const MOVABLE: [&str; 4] =
    ["rods.cage_rod_length_mm", "rods.arm_rod_length_mm", "rods.strut_rod_length_mm", "motor_mount.motor_position_mm"];

/// Makes a variant that keeps every limit, as near to the frame it comes from as the search finds.
///
/// # Errors
/// When what is asked for is refused, or no frame near by keeps all limits.
pub fn create(request: &Request) -> Result<Creation, CreateError> {
    let frame = Frame::resolve(request.file)?;
    let start = start(request, &frame);
    let as_asked = Design::new(frame).map(Evaluation::of);
    let why: Vec<String> = match &as_asked {
        Ok(evaluation) => evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).map(|f| f.message.clone()).collect(),
        Err(error) => vec![error.to_string()],
    };
    if let (Ok(evaluation), true) = (as_asked, why.is_empty()) {
        return Ok(Creation { evaluation, moved: Vec::new(), why, looked_at: 1, ended: Ended::Converged });
    }
    let vary = movable(request.from);
    let from: Vec<f64> = vary.iter().map(|v| request.from.value(v.parameter.table, v.parameter.key).unwrap_or(v.bounds[0])).collect();
    let Request { file, most, follows, .. } = *request;
    let problem = SearchProblem { file, aim: Aim::Near(from), goals: Vec::new(), vary, start, most, follows, mechanics: None };
    let Solution { evaluation, values, looked_at, ended, .. } = solve(&problem)?;
    let moved = values
        .into_iter()
        .filter(|(_, before, after)| before != after)
        .map(|(vary, before, after)| Moved { key: vary.key(), before, after })
        .collect();
    Ok(Creation { evaluation, moved, why, looked_at, ended })
}

/// What the search may change of a frame, and between which bounds.
pub fn movable(from: &Frame) -> Vec<Vary> {
    let all = MOVABLE.iter().filter_map(|key| parameters().find(|p| *key == format!("{}.{}", p.table, p.key)));
    all.map(|parameter| reaching_presets(Vary::around(parameter, from, REACH))).collect()
}

/// The same with bounds that hold every preset: what a frame is known for is within reach.
fn reaching_presets(vary: Vary) -> Vary {
    let Vary { parameter, bounds } = vary;
    let values = presets().filter_map(|frame| frame.value(parameter.table, parameter.key));
    let bounds = values.fold(bounds, |[least, most], value| [least.min(value), most.max(value)]);
    Vary { parameter, bounds }
}

/// How far from the frame that it comes from a number may move, in shares of it, where no preset is farther.
const REACH: f64 = 0.3;

/// How much smaller than asked for the search begins, mm: sockets stand out beyond the nodes that are solved for.
const WITHIN_MM: f64 = 2.0;

/// Where the search begins: the rods that fill the wanted envelope at the struts' present tilt, and the motors between hub
/// and fork as they were; else the frame itself.
fn start(request: &Request, frame: &Frame) -> Vec<f64> {
    let closure = crate::frame::skeleton::Skeleton::new(request.from).map(|skeleton| skeleton.closure);
    let (Some([width_mm, height_mm]), Ok(closure)) = (request.envelope_mm, closure) else { return Vec::new() };
    let envelope = Envelope { width_mm: width_mm - WITHIN_MM, height_mm: height_mm - WITHIN_MM, strut_tilt: closure.strut_tilt };
    let [cage, arm, strut] = lengths_for(&envelope, frame);
    let motor = frame.motor_mount.motor_position_mm * arm / request.from.rods.arm_rod_length_mm;
    let within =
        [cage, arm, strut, motor].iter().zip(movable(request.from)).all(|(value, vary)| (vary.bounds[0]..=vary.bounds[1]).contains(value));
    if within { vec![cage, arm, strut, motor] } else { Vec::new() }
}
