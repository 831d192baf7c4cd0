//! What the frame's own mechanics say: pressed down, and dropped.

use flexframe::checks::{self, Finding};
use flexframe::export::{File, deformed_glb};
use flexframe::mechanics::model::frame_model::{Extent, FrameModel};
use flexframe::mechanics::parts::parts_plan::part_models;
use flexframe::mechanics::result::deformed::{Bound, DeformedBody};
use flexframe::mechanics::result::impact::{Impact, Run};
use flexframe::mechanics::result::static_curve::{DOWN_MM, INSIDE_MM, StaticCurve};
use flexframe::mechanics::result::underside::Underside;
use flexframe::mechanics::settings::MechanicsSettings;
use flexframe::mechanics::solve::modes::{Modes, REPORTED};
use flexframe::report::data::impact_data::{self, Impacts};
use flexframe::report::data::stiffness_data::{self, Stiffness};
use serde_json::Value;

use crate::answer::{Answer, Refused};
use crate::open_frame::OpenFrame;
use crate::tell_stage;

/// Most bent shapes in the motion of an impact.
const MOST_SHAPES: usize = 24;
/// How many times slower than it happens the motion is.
const SLOWER: f64 = 100.0;

/// The program's numbers, for a frame's own material.
fn settings(open: &OpenFrame) -> Result<MechanicsSettings, Refused> {
    Ok(MechanicsSettings::load(None)?.for_material(&open.design.frame.flexible.material))
}

/// The findings of the design drop, as of `check --strength`.
///
/// # Errors
/// When the frame has no model.
pub fn design_drop(open: &OpenFrame) -> Result<Vec<Finding>, Refused> {
    checks::design_drop(&open.design, &open.masses, &settings(open)?).map_err(refused)
}

/// Stiffness and modes, as of `stiffness --json`.
///
/// # Errors
/// When they cannot be computed.
pub fn stiffness(open: &OpenFrame) -> Result<Value, Refused> {
    let settings = settings(open)?;
    let model = |extent| FrameModel::new(&open.design, &open.masses, &settings, extent).map_err(refused);
    let curve = StaticCurve::new(&model(Extent::Quarter)?, DOWN_MM, &INSIDE_MM).map_err(refused)?;
    let modes = Modes::new(&model(Extent::Whole)?, REPORTED).map_err(refused)?;
    Ok(stiffness_data::json(&Stiffness {
        frame: &open.design.frame.name,
        settings: &settings,
        curve: &curve,
        gap_mm: checks::ground_clearance(&open.design, &open.masses).map(|ground| ground.clearance_mm),
        modes: Some(&modes),
        measured: &[],
        rms_n: None,
        calibrated: false,
        ratios: None,
    }))
}

/// A level drop by the frame's own model, as of `drop --model frame --trace --json`, and its motion as `impact.glb`: slowed down,
/// with bent bodies.
///
/// # Errors
/// When the height is out of bounds, or the motion is lost.
pub fn impact(open: &OpenFrame, height_m: f64, motion: bool) -> Result<Answer, Refused> {
    flexframe::impact::sim::check_heights(&[height_m]).map_err(Refused::plain)?;
    let OpenFrame { design, masses, .. } = open;
    let settings = settings(open)?;
    tell_stage(0, 3, "beams of the frame");
    let parts = part_models(design, &settings).map_err(refused)?;
    let model = |extent| FrameModel::of_parts(design, &parts, masses, &settings, extent).map_err(refused);
    let quarter = model(Extent::Quarter)?;
    tell_stage(1, 3, "the impact");
    let impact = Impact::new(&quarter, &settings, height_m, &Run::default()).map_err(refused)?;
    let impacts = [impact];
    let underside = checks::ground_clearance(design, masses).map(|ground| Underside::of(design, &quarter, ground.clearance_mm));
    let name = &design.frame.name;
    let found = Impacts { frame: name, settings: &settings, mass_g: masses.total_g, underside, tilt_deg: [0.0; 2], impacts: &impacts };
    let mut answer = Answer::data(impact_data::json(&found, true));
    if motion {
        tell_stage(2, 3, "its motion");
        answer.files = Answer::of_files(vec![bent(open, &model(Extent::Whole)?, &quarter, &impacts[0])?]).files;
    }
    Ok(answer)
}

/// The bodies as they bend, one shape after the other.
fn bent(open: &OpenFrame, whole: &FrameModel, quarter: &FrameModel, impact: &Impact) -> Result<File, Refused> {
    let bound = Bound::new(&open.design, whole).ok_or_else(|| Refused::plain("the frame's bodies are not those of its model"))?;
    let states: Vec<_> = impact.states.iter().step_by(impact.states.len().div_ceil(MOST_SHAPES).max(1)).collect();
    let shapes: Vec<Vec<DeformedBody>> = states.iter().map(|(_, state)| bound.deformed(&whole.unfolded(quarter, state))).collect();
    let count = shapes.len();
    let only = |shape: Option<usize>| (0..count).map(|at| if Some(at) == shape { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let moments = states.iter().enumerate().map(|(at, (t_ms, _))| (t_ms * 1e-3 * SLOWER, only(Some(at))));
    let keys: Vec<deformed_glb::Key> = std::iter::once((0.0, only(None))).chain(moments).collect();
    let rest = bound.deformed(&whole.system.rest());
    let bytes = deformed_glb::deformed(&open.design, "a drop, slowed down", &rest, &shapes, &keys).map_err(Refused::plain)?;
    Ok(File::new("impact.glb", bytes))
}

/// A failure of the model, as the command line says it.
fn refused(error: impl std::fmt::Display) -> Refused {
    Refused::plain(format!("the frame's mechanics cannot be computed: {error}"))
}
