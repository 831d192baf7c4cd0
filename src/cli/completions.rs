//! `flexframe completions`: what makes a shell ask the program how a word goes on.

use std::process::ExitCode;

use clap_complete::env::Shells;

use super::failure::Failure;
use super::options::Common;
use super::terminal;

/// The variable by which a shell asks, and the program's name.
pub(super) const ASKS: &str = "COMPLETE";
const PROGRAM: &str = "flexframe";

/// Print a shell's completion script: commands, options, and the names of frames, parts, materials and parameters.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The shell.
    pub shell: clap_complete::Shell,
}

/// Prints the script, which calls the program for each word.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    common.refuse_json("a script of the shell")?;
    let shells = Shells::builtins();
    let Some(shell) = shells.completer(&args.shell.to_string()) else {
        return Err(Failure::Usage { message: format!("there is no script for {}", args.shell) });
    };
    let mut script = Vec::new();
    // Writing into memory does not fail.
    let _ = shell.write_registration(ASKS, PROGRAM, PROGRAM, PROGRAM, &mut script);
    terminal::print(&String::from_utf8_lossy(&script))?;
    Ok(ExitCode::SUCCESS)
}
