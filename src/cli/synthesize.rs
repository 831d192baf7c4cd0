//! `flexframe synthesize`: synthetic drops with a known truth.

use std::path::PathBuf;
use std::process::ExitCode;

use serde_json::json;

use super::bounded::seed;
use super::candidates;
use super::failure::Failure;
use super::options::Common;
use super::output;
use super::progress::Progress;
use super::terminal;
use crate::impact::synthetic::{Plan, records, table};

/// Write synthetic drops from known parameters, to test a diagnosis.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  flexframe synthesize params/synthetic/bottoming.toml --seed 3\n\nA plan is a model file with the tables drops, scatter, logger, landing and hidden; docs/diagnosis.md lists their keys."
)]
pub(super) struct Args {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN", add = candidates::toml_files())]
    pub plan: String,
    /// Seed instead of the plan's.
    #[arg(long, value_name = "N", value_parser = seed())]
    pub seed: Option<u64>,
    /// Folder in which to write the folder `synthesize-PLAN`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Writes a folder: `drops/` with the drops, `truth/` with what they were made from.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let mut plan = Plan::load(&args.plan)?;
    if let Some(seed) = args.seed {
        plan.seed = seed;
    }
    let working = Progress::of("synthesizing", common);
    let all = records(&plan);
    let truth = json!({
        "schema_version": 1,
        "effects": plan.model.effects.iter().skip(2).map(|listed| json!({
            "id": listed.spec.id,
            "parameters": listed.spec.parameters.iter().zip(&listed.values).map(|(parameter, value)| (parameter.key.to_string(), json!(value))).collect::<serde_json::Map<_, _>>(),
        })).collect::<Vec<_>>(),
        "hidden": plan.hidden.map(|hidden| hidden.name()),
        "hidden_numbers": plan.hidden.map(|hidden| hidden.numbers().into_iter().collect::<std::collections::BTreeMap<_, _>>()),
        "k": plan.model.stiffness_and_damping()[0],
        "c": plan.model.stiffness_and_damping()[1],
        "seed": plan.seed,
        "stalled": all.iter().filter(|record| record.stalled).map(|record| &record.trial).collect::<Vec<_>>(),
    });
    let name = format!("synthesize-{}", plan.model.name);
    let files = vec![
        ("drops/drops.csv".to_string(), table(&all).into_bytes()),
        ("truth/truth.json".to_string(), format!("{truth:#}\n").into_bytes()),
        ("truth/model.toml".to_string(), plan.model.to_toml().into_bytes()),
        ("truth/plan.toml".to_string(), plan.to_toml().into_bytes()),
    ];
    drop(working);
    let place = output::write_folder(&args.output, &name, &files)?;
    if common.json {
        terminal::print_json(&json!({ "schema_version": 1, "folder": place.display().to_string(), "drops": all.len() }))?;
    } else if !common.quiet {
        terminal::print(&format!("{}: {} drops from {} heights\n", place.display(), all.len(), plan.heights_m.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}
