//! `flexframe plant`: drops with a known truth.

use std::process::ExitCode;

use serde_json::json;

use super::arguments::{Common, PlantOptions};
use super::output;
use super::progress::Progress;
use super::session::Failure;
use super::terminal;
use crate::impact::synthetic::{Plan, records};

/// Plants drops and writes a folder: `drops/` for whoever shall find the truth, `truth/` for whoever knows it.
pub(super) fn plant(options: &PlantOptions, common: &Common) -> Result<ExitCode, Failure> {
    let mut plan = Plan::load(&options.plan)?;
    if let Some(seed) = options.seed {
        plan.seed = seed;
    }
    let working = Progress::of("planting", common);
    let mut table = String::from("trial,height_m,t_s,accel_g\n");
    let all = records(&plan);
    for record in &all {
        for (t_s, accel_g) in record.t_s.iter().zip(&record.accel_g) {
            table += &format!("{},{},{t_s:.6},{accel_g:.5}\n", record.trial, record.height_m);
        }
    }
    let truth = json!({
        "schema_version": 1,
        "effects": plan.model.effects.iter().skip(2).map(|listed| json!({
            "id": listed.spec.id,
            "parameters": listed.spec.parameters.iter().zip(&listed.values).map(|(parameter, value)| (parameter.key.to_string(), json!(value))).collect::<serde_json::Map<_, _>>(),
        })).collect::<Vec<_>>(),
        "hidden": plan.hidden.map(|hidden| hidden.name()),
        "k": plan.model.stiffness_and_damping()[0],
        "c": plan.model.stiffness_and_damping()[1],
        "seed": plan.seed,
    });
    let name = format!("plant-{}", plan.model.name);
    let files = vec![
        ("drops/drops.csv".to_string(), table.into_bytes()),
        ("truth/truth.json".to_string(), format!("{truth:#}\n").into_bytes()),
        ("truth/model.toml".to_string(), plan.model.to_toml().into_bytes()),
    ];
    drop(working);
    let place = output::write_folder(&options.output, &name, &files)?;
    if common.json {
        terminal::print_json(&json!({ "schema_version": 1, "folder": place.display().to_string(), "drops": all.len() }))?;
    } else if !common.quiet {
        terminal::print(&format!("{}: {} drops from {} heights\n", place.display(), all.len(), plan.heights_m.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}
