//! `flexframe man`: the manual pages.

use std::ffi::{OsStr, OsString};
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::engine::ArgValueCompleter;

use super::candidates::beginning;
use super::failure::Failure;
use super::options::Common;
use super::terminal;

/// Print a manual page (roff): that of the program, or of one command.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe man | man -l -\n  flexframe man study run > flexframe-study-run.1")]
pub(super) struct Args {
    /// The command, such as build, or study run.
    #[arg(value_name = "COMMAND", add = commands())]
    pub command: Vec<String>,
}

/// The commands below those that are typed, such as `run` after `study`.
fn commands() -> ArgValueCompleter {
    ArgValueCompleter::new(|current: &OsStr| {
        let whole = super::Arguments::command();
        let typed: Vec<OsString> = std::env::args_os().skip_while(|word| word != "man").skip(1).collect();
        let before = typed.split_last().map_or(&[][..], |(_, before)| before);
        let Some(of) = before.iter().try_fold(&whole, |of, name| of.find_subcommand(name)) else { return Vec::new() };
        let named = |found: &clap::Command| (found.get_name().to_string(), found.get_about().map(ToString::to_string).unwrap_or_default());
        beginning(current, of.get_subcommands().map(named))
    })
}

/// Prints the page of the whole command line, or of one command.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    common.refuse_json("a manual page (roff)")?;
    let mut whole = super::Arguments::command();
    // Gives every command its full name.
    whole.build();
    let mut asked = &whole;
    for name in &args.command {
        let missing =
            || Failure::Usage { message: format!("there is no command `{}`; `flexframe --help` lists them", args.command.join(" ")) };
        asked = asked.find_subcommand(name).ok_or_else(missing)?;
    }
    let mut page = Vec::new();
    let written = clap_mangen::Man::new(asked.clone()).render(&mut page);
    written.map_err(|error| Failure::Machine { what: "cannot make the manual page".into(), error })?;
    terminal::print(&String::from_utf8_lossy(&page))?;
    Ok(ExitCode::SUCCESS)
}
