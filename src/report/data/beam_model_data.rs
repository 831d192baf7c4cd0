//! The frame's beam model as JSON, for programs of finite elements.
//!
//! Millimetre, newton, gram, millisecond, which go together: 1 g mm/ms² = 1 N. X, Y and Z are those of the assembled frame. The quarter stands between
//! two planes of symmetry: its nodes there are held, and its forces and masses are a quarter of the frame's.

use serde_json::{Value, json};

use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::result::static_curve::StaticCurve;
use crate::mechanics::solve::modes::{Mode, Modes};
use crate::mechanics::system::sparse::NOWHERE;
use crate::mechanics::system::structure::Unknowns;

/// The quarter with its curve, and the whole frame with its modes on held feet.
pub fn json(frame: &str, quarter: &FrameModel, curve: &StaticCurve, whole: &FrameModel, modes: Option<&Modes>) -> Value {
    let mut pressed = structure(quarter);
    pressed["curve"] = curve.points.iter().map(|point| json!([point.displacement_mm, point.force_n])).collect();
    let mut vibrating = structure(whole);
    if let Some(modes) = modes {
        vibrating["modes"] = modes.modes.iter().map(|mode| of_mode(mode, modes)).collect();
    }
    json!({ "schema_version": 1, "frame": frame, "units": "mm, N, g, ms", "quarter": pressed, "whole": vibrating })
}

fn structure(model: &FrameModel) -> Value {
    let structure = &model.system.structure;
    let (beams, ties) = model.tags.split_at(structure.beams.len());
    let nodes = structure.nodes.iter().map(
        |node| json!({ "place_mm": node.place.as_slice(), "held": node.held, "mass_g": node.mass_g, "inertia_g_mm2": node.inertia_g_mm2 }),
    );
    let beams = structure.beams.iter().zip(beams).map(|(beam, tag)| {
        let axes: Vec<Vec<f64>> = beam.axes.column_iter().map(|axis| axis.iter().copied().collect()).collect();
        json!({ "nodes": beam.nodes, "axes": axes, "length_mm": beam.length_mm, "rigidity": beam.rigidity, "zone": tag.zone })
    });
    let ties = structure.ties.iter().zip(ties).map(|(tie, tag)| {
        let arms: Vec<&[f64]> = tie.arms.iter().map(|arm| arm.as_slice()).collect();
        let (stiffness, turning) = (tie.stiffness_n_mm, tie.turning_n_mm);
        json!({ "nodes": tie.nodes, "arms_mm": arms, "stiffness_n_mm": stiffness, "turning_n_mm": turning, "zone": tag.zone })
    });
    let feet = structure.feet.iter().map(|foot| {
        let (stiffness, ground) = (foot.stiffness_n_mm, foot.ground_mm);
        json!({ "node": foot.node, "arm_mm": foot.arm.as_slice(), "ground_mm": ground, "stiffness_n_mm": stiffness, "friction": foot.friction })
    });
    json!({
        "copies": model.extent.copies(),
        "centre": model.hub,
        "nodes": nodes.collect::<Vec<_>>(),
        "beams": beams.collect::<Vec<_>>(),
        "ties": ties.collect::<Vec<_>>(),
        "feet": feet.collect::<Vec<_>>(),
    })
}

/// Displacements and spins of each node; 0 where it is held.
fn of_mode(mode: &Mode, modes: &Modes) -> Value {
    let unknowns: &Unknowns = &modes.system.unknowns;
    let of = |unknown: usize| if unknown == NOWHERE { 0.0 } else { mode.shape[unknown] };
    let shape: Vec<[f64; 6]> = (0..modes.system.structure.nodes.len()).map(|node| unknowns.of(node).map(of)).collect();
    json!({ "frequency_hz": mode.frequency_hz, "share_up": mode.share_up, "shape": shape })
}
