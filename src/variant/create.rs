//! A new variant: what is asked for on top of a frame, and what has to change with it.

use std::ops::ControlFlow;
use std::sync::Arc;

use super::aim::Aim;
use super::ended::Ended;
use super::feasible::presets;
use super::measures::Evaluation;
use super::problem::{SearchProblem, SearchProgress, Solution, SolveError, Vary};
use super::solve::{own_values, solve};
use crate::checks::Verdict;
use crate::frame::assembly::DesignError;
use crate::frame::skeleton::{Envelope, lengths_for};
use crate::memo::Memo;
use crate::params::refusal::Refusal;
use crate::params::{Frame, FrameFile, parameters};

/// What is asked for: already set in the file.
pub struct Request<'a> {
    /// The frame with the wishes in it.
    pub file: &'a FrameFile,
    /// The frame without them.
    pub from: &'a Frame,
    /// Width, depth and height to stay within, mm, when asked for.
    pub envelope_mm: Option<[f64; 3]>,
    /// What else may move, and in which bounds; one of the frame's sizes among them has these bounds.
    pub vary: &'a [Vary],
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
    /// In the frame with what is asked for, before anything else moves.
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
    /// What would be violated without those changes; of the slow rules only where the quick ones would be kept.
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

/// What may change, too, where a frame is longer than wide or may be.
const SIDE_RATIO: &str = "rods.cage_side_ratio";

/// Makes a variant that keeps every limit, as near to the frame it comes from as the search finds.
///
/// # Errors
/// When what is asked for is refused, or no frame near by keeps all limits.
pub fn create(request: &Request) -> Result<Creation, CreateError> {
    let frame = Frame::resolve(request.file)?;
    let start = start(request, &frame);
    let vary = movable(request);
    let memo = Arc::<Memo>::default();
    let as_asked = as_asked(frame, &memo);
    let why: Vec<String> = match &as_asked {
        Ok(evaluation) => evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).map(|f| f.message.clone()).collect(),
        Err(error) => vec![error.to_string()],
    };
    let from = own_values(&vary, request.from);
    let is_within = from.iter().zip(&vary).all(|(value, vary)| (vary.bounds[0]..=vary.bounds[1]).contains(value));
    if let (Ok(evaluation), true, true) = (as_asked, why.is_empty(), is_within) {
        return Ok(Creation { evaluation, moved: Vec::new(), why, looked_at: 1, ended: Ended::Converged });
    }
    let Request { file, most, follows, .. } = *request;
    let problem = SearchProblem { file, aim: Aim::Near(from), goals: Vec::new(), vary, start, most, follows, mechanics: None, memo };
    let Solution { evaluation, values, looked_at, ended, .. } = solve(&problem)?;
    let moved = values
        .into_iter()
        .filter(|(_, before, after)| before != after)
        .map(|(vary, before, after)| Moved { key: vary.key(), before, after })
        .collect();
    Ok(Creation { evaluation, moved, why, looked_at, ended })
}

/// The frame as asked for; by the slow rules, too, where it keeps the quick ones.
fn as_asked(frame: Frame, memo: &Arc<Memo>) -> Result<Evaluation, DesignError> {
    let quick = Evaluation::quick(frame, memo)?;
    let is_kept = quick.findings.iter().all(|finding| finding.verdict != Verdict::Violated);
    Ok(if is_kept { Evaluation::of(quick.design) } else { quick })
}

/// What the search may change of a frame, and between which bounds: its size, where it helps how much longer it is than wide, and what is
/// asked for.
pub fn movable(request: &Request) -> Vec<Vary> {
    let is_deeper = request.envelope_mm.is_some_and(|[width_mm, depth_mm, _]| depth_mm > width_mm);
    let ratio = (is_deeper || request.from.rods.cage_side_ratio > 1.0).then_some(SIDE_RATIO);
    let all = MOVABLE.into_iter().chain(ratio).filter_map(|key| parameters().find(|p| key == format!("{}.{}", p.table, p.key)));
    let own = all.map(|parameter| reaching_presets(Vary::around(parameter, request.from, REACH)));
    let asked = |key: &str| request.vary.iter().find(|vary| vary.key() == key).copied();
    let mut all: Vec<Vary> = own.map(|vary| asked(&vary.key()).unwrap_or(vary)).collect();
    let more = request.vary.iter().filter(|vary| all.iter().all(|known| known.key() != vary.key())).copied().collect::<Vec<_>>();
    all.extend(more);
    all
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

/// Where the search begins: the rods that fill the wanted envelope at the struts' present tilt, sides no longer than the depth allows, and the
/// motors between hub and fork as they were, none of them beyond its bounds; else the frame itself.
fn start(request: &Request, frame: &Frame) -> Vec<f64> {
    let closure = crate::frame::skeleton::Skeleton::new(request.from).map(|skeleton| skeleton.closure);
    let (Some([width_mm, depth_mm, height_mm]), Ok(closure)) = (request.envelope_mm, closure) else { return Vec::new() };
    let deeper_mm = (depth_mm - width_mm).max(0.0);
    let envelope =
        Envelope { width_mm: width_mm.min(depth_mm) - WITHIN_MM, height_mm: height_mm - WITHIN_MM, strut_tilt: closure.strut_tilt };
    let [cage, arm, strut] = lengths_for(&envelope, frame);
    let motor = frame.motor_mount.motor_position_mm * arm / request.from.rods.arm_rod_length_mm;
    let ratio = request.from.rods.cage_side_ratio.min(1.0 + deeper_mm / cage);
    let vary = movable(request);
    let value = |vary: &Vary| match MOVABLE.iter().position(|key| *key == vary.key()) {
        Some(at) => Some([cage, arm, strut, motor][at]),
        None if vary.key() == SIDE_RATIO => Some(ratio),
        None => request.from.value(vary.parameter.table, vary.parameter.key),
    };
    let within = |vary: &Vary| value(vary).map(|value| value.clamp(vary.bounds[0], vary.bounds[1]));
    vary.iter().map(within).collect::<Option<Vec<f64>>>().unwrap_or_default()
}
