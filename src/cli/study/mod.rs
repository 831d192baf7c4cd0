//! `flexframe study`: evaluates many frames, one a row, on this machine or on a cluster.

mod block;
mod hq;
mod journal_file;
mod local;
mod pick;
mod plan;
mod recovery_report;
mod report;
mod run;
mod study_option;

use std::process::ExitCode;

use clap::Subcommand;

use super::failure::Failure;
use super::options::Common;

/// Evaluate many frames over ranges of parameters, on this machine or on a cluster.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe study plan examples/studies/rods.toml\n  flexframe study run examples/studies/rods.toml --budget 10m\n  flexframe study run examples/studies/rods.toml --engine hq\n  flexframe study report examples/studies/rods.toml --goals mass,clearance.propeller\n  flexframe study pick examples/studies/rods.toml 17 -o mine\n\nA plan is a TOML file: base, sampling, samples, seed, measures, and the tables vary and choose; or, with kind = \"recovery\", levels,\nstrengths, effects, laws and the table seeds. docs/studies.md lists its keys. A run that was\ninterrupted continues when it is started again."
)]
pub(super) struct Args {
    /// What to do with the study.
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    Plan(plan::Args),
    Run(run::Args),
    Report(report::Args),
    Pick(pick::Args),
    Block(block::Args),
}

pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    match &args.action {
        Action::Plan(args) => plan::run(args, common),
        Action::Run(args) => run::run(args, common),
        Action::Report(args) => report::run(args, common),
        Action::Pick(args) => pick::run(args, common),
        Action::Block(args) => block::run(args),
    }
}
