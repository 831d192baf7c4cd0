//! `flexframe completions`: a shell's completion script.

use std::process::ExitCode;

use clap::CommandFactory;

use super::failure::Failure;
use super::options::Common;
use super::terminal;

/// Print a shell's completion script.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The shell.
    pub shell: clap_complete::Shell,
}

/// Prints the script of the whole command line.
pub(super) fn run(args: &Args, _: &Common) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut super::Arguments::command(), "flexframe", &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
