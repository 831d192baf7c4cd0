//! A drop as data: JSON, and CSV files of results, traces and samples.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::export::ExportError;
use crate::export::table::{csv, number};
use crate::impact::body::DropBody;
use crate::impact::effects::{Listed, Model};
use crate::impact::sim::{Sampler, Trace};

/// How much of the fall stands before first touch in the samples, s.
const FALL_S: f64 = 0.1;

/// A body: mass, gap, and where they come from.
pub(super) fn body(body: &DropBody) -> Value {
    json!({ "mass_kg": body.mass_kg, "gap_mm": body.gap_m * 1e3, "from": body.origin.to_string() })
}

/// Everything as JSON; the traces' series only when asked for.
pub fn json(model: &Model, traces: &[Trace], series: bool) -> Value {
    let sensor = &model.sensor;
    let values = |listed: &Listed| -> BTreeMap<_, _> { listed.spec.parameters.iter().map(|p| p.key).zip(listed.values.clone()).collect() };
    let effects: BTreeMap<_, _> = model.effects.iter().map(|listed| (listed.spec.id, values(listed))).collect();
    let outside: Vec<Value> = traces
        .iter()
        .flat_map(|trace| trace.warnings.iter().map(|warning| json!({ "height_m": trace.height_m, "warning": warning.to_string() })))
        .collect();
    json!({
        "schema_version": 1,
        "model": model.name,
        "body": body(&model.body),
        "sensor": { "cutoff_hz": sensor.cutoff_hz, "order": sensor.order, "limit_g": sensor.limit_g },
        "effects": effects,
        "heights": traces.iter().map(|trace| of_height(trace, series)).collect::<Vec<_>>(),
        "outside": outside,
    })
}

fn of_height(trace: &Trace, series: bool) -> Value {
    let mut energy = json!(trace.compression);
    if let Value::Object(energy) = &mut energy {
        energy.insert("paper".into(), json!(trace.paper));
        energy.insert("release".into(), json!(trace.release));
    }
    let mut value = json!({
        "height_m": trace.height_m,
        "peak_coordinate_g": trace.peaks.map(|peaks| peaks.coordinate_g),
        "peak_proper_g": trace.peaks.map(|peaks| peaks.proper_g),
        "peak_sensor_g": trace.peaks.map(|peaks| peaks.sensor_g),
        "contact_time_ms": trace.contact_s.map(|t_s| t_s * 1e3),
        "max_displacement_mm": trace.max_displacement_m.map(|x_m| x_m * 1e3),
        "energy": energy,
    });
    if series {
        value["t_s"] = json!(trace.t_s);
        value["accel_g"] = json!(trace.sensor_g);
        value["x_mm"] = trace.x_m.iter().map(|x_m| x_m * 1e3).collect();
        value["ground_n"] = json!(trace.ground_n);
    }
    value
}

/// One line a height.
///
/// # Errors
/// Those of [`csv()`].
pub fn results_csv(traces: &[Trace]) -> Result<String, ExportError> {
    let columns = "height_m,impact_speed_m_s,peak_coordinate_g,peak_proper_g,peak_sensor_g,contact_time_ms,max_displacement_mm,\
                   input_j,stored_j,dissipated_j,kinetic_j,collision_j,air_j,\
                   paper_damper_percent,paper_spring_percent,paper_rigid_percent";
    let row = |trace: &Trace| {
        let (balance, paper) = (trace.compression.as_ref(), trace.paper.as_ref());
        let numbers = [
            Some(trace.height_m),
            Some(trace.impact_speed_m_s),
            trace.peaks.map(|peaks| peaks.coordinate_g),
            trace.peaks.map(|peaks| peaks.proper_g),
            trace.peaks.map(|peaks| peaks.sensor_g),
            trace.contact_s.map(|t_s| t_s * 1e3),
            trace.max_displacement_m.map(|x_m| x_m * 1e3),
            balance.map(|b| b.input_j),
            balance.map(|b| b.stored_j),
            balance.map(|b| b.dissipated_j),
            balance.map(|b| b.kinetic_j),
            balance.map(|b| b.collision_j),
            balance.map(|b| b.air_j),
            paper.map(|p| p.damper_percent),
            paper.map(|p| p.spring_percent),
            paper.map(|p| p.rigid_percent),
        ];
        numbers.map(number)
    };
    csv("results.csv", columns.split(','), traces.iter().map(row))
}

/// The series of every height.
///
/// # Errors
/// Those of [`csv()`].
pub fn trace_csv(traces: &[Trace]) -> Result<String, ExportError> {
    let columns = ["height_m", "t_s", "x_m", "v_m_s", "proper_g", "sensor_g"];
    let row = |trace: &Trace, at: usize| {
        [trace.height_m, trace.t_s[at], trace.x_m[at], trace.v_m_s[at], trace.proper_g[at], trace.sensor_g[at]].map(|x| x.to_string())
    };
    let rows = traces.iter().flat_map(|trace| (0..trace.t_s.len()).map(move |at| row(trace, at)));
    csv("trace.csv", columns, rows)
}

/// What a logger would have written, in the form of measured records: one trial a height, the end of the fall before it.
///
/// # Errors
/// Those of [`csv()`].
pub fn samples_csv(model: &Model, traces: &[Trace]) -> Result<String, ExportError> {
    let logger = Sampler { range_g: model.sensor.limit_g, ..Sampler::LOGGER };
    let rows = traces.iter().enumerate().flat_map(|(trial, trace)| {
        let before = (trace.fall_s.min(FALL_S) * logger.rate_hz).floor() as i32;
        let fall = (-before..0).map(|sample| (logger.time_s(sample), 0.0));
        let samples = fall.chain(logger.samples(&trace.sensor_g, Trace::STEP_S));
        samples.map(move |(t_s, g)| [(trial + 1).to_string(), trace.height_m.to_string(), t_s.to_string(), format!("{g:.4}")])
    });
    csv("samples.csv", ["trial", "height_m", "t_s", "accel_g"], rows)
}
