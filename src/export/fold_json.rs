//! The fold sequence as JSON.

use serde_json::{Value, json};

use crate::frame::assembly::Design;
use crate::frame::fold::{FlatState, FoldSequence, STEP_S, Sweep, TABLE_MM};
use crate::frame::mounting::{MountStep, Mounting};
use crate::frame::skeleton::{MODULE_NAMES, ROTORS};

/// Version of the file's form.
const SCHEMA_VERSION: u32 = 2;

/// The steps of a frame's assembly: what is mounted before the fold, the fold, what is mounted after it.
///
/// # Errors
/// When a number in it is none.
pub fn fold_json(design: &Design, fold: &FoldSequence, sweeps: &[Sweep]) -> Result<Vec<u8>, serde_json::Error> {
    let mounting = Mounting::new(design, fold);
    let steps = steps(fold, sweeps, &mounting)?;
    let [arm_hub, arm_fork] = fold.module.linkage.arm_holds_mm.map(|hold| hold * fold.entry.pulled);
    let [strut_knee, strut_corner] = fold.module.linkage.strut_out_mm(fold.entry.pulled);
    let [off_hub_mm, started_mm] = fold.off_hub_mm;
    let mut value = json!({
        "schema_version": SCHEMA_VERSION,
        "frame": design.frame.name,
        "units": "mm, degrees from flat, N mm, minutes, seconds",
        "axes": "bodies are those of module FR in frame axes: X right, Y front, Z up; the other modules are the same, turned",
        "stages": "before_fold: hub and electronics; fold: the modules, four of each; after_fold: wires, lid, battery and, last, propellers",
        "propellers": propellers(),
        "step_shown_s": STEP_S,
        "triangle": {
            "closes_from_strut_fold_deg": fold.entry.strut_deg,
            "leg_way_mm": fold.module.linkage.leg_way_mm(),
            "left_out_mm": {
                "arm_in_hub_joint": arm_hub,
                "arm_in_fork": arm_fork,
                "strut_in_knee": strut_knee,
                "strut_in_corner": strut_corner,
            },
        },
        "module_stands_off_hub_mm": off_hub_mm,
        "plugs_started_off_hub_mm": started_mm,
        "minutes": fold.steps.iter().map(|step| step.minutes).chain(mounting.steps().map(|step| step.minutes)).sum::<f64>(),
        "flat": flat(design),
        "steps": steps,
    });
    round(&mut value);
    let mut bytes = serde_json::to_vec_pretty(&value)?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// All steps, numbered from 1 in the order in which they are done.
fn steps(fold: &FoldSequence, sweeps: &[Sweep], mounting: &Mounting) -> Result<Vec<Value>, serde_json::Error> {
    let mounted = |steps: &[MountStep]| steps.iter().map(mounted).collect::<Result<Vec<Value>, _>>();
    let mut all = mounted(&mounting.before)?;
    for (at, step) in fold.steps.iter().enumerate() {
        let mut value = serde_json::to_value(step)?;
        value["stage"] = json!("fold");
        value["parts"] = serde_json::to_value(mounting.fold_parts.get(at))?;
        if let Some(sweep) = sweeps.get(at) {
            value["sweep"] = serde_json::to_value(sweep)?;
        }
        all.push(value);
    }
    all.extend(mounted(&mounting.after)?);
    for (at, step) in all.iter_mut().enumerate() {
        step["number"] = json!(at + 1);
    }
    Ok(all)
}

/// A mount, with the keys that every step has.
fn mounted(step: &MountStep) -> Result<Value, serde_json::Error> {
    let mut value = serde_json::to_value(step)?;
    value["bends"] = json!([]);
    let join = |body: &String| json!({ "body": body, "onto": step.onto_of(body), "from": step.from, "left_out_mm": 0.0, "depth_mm": null });
    value["joins"] = step.brings.iter().map(join).collect();
    Ok(value)
}

/// Number and direction of each motor, seen from above.
fn propellers() -> Value {
    let of = |(module, name): (usize, &&str)| json!({ "module": name, "motor": ROTORS[module].number, "turns": ROTORS[module].spin });
    MODULE_NAMES.iter().enumerate().map(of).collect()
}

/// The module on the table before the first step.
fn flat(design: &Design) -> Value {
    let flat = FlatState::new(design);
    let lying = flat.lying.iter().map(|l| json!({ "body": l.body, "at_mm": [l.at.translation.x, l.at.translation.y] })).collect::<Vec<_>>();
    let wrong: Vec<String> = flat.check(design).iter().map(ToString::to_string).collect();
    json!({ "table_mm": TABLE_MM, "takes_mm": flat.size_mm(), "lying": lying, "wrong": wrong })
}

/// To a millionth, so that the last bits of a computation do not reach the file.
fn round(value: &mut Value) {
    match value {
        Value::Array(all) => all.iter_mut().for_each(round),
        Value::Object(all) => all.values_mut().for_each(round),
        Value::Number(number) => {
            if let Some(x) = number.as_f64().filter(|_| number.is_f64()) {
                let rounded = (x * 1e6).round() / 1e6;
                *value = json!(if rounded == 0.0 { 0.0 } else { rounded });
            }
        }
        _ => {}
    }
}
