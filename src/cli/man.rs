//! `flexframe man`: the manual pages.

use std::process::ExitCode;

use clap::CommandFactory;

use super::failure::Failure;
use super::options::Common;
use super::terminal;

/// Print a manual page (roff): that of the program, or of one command.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe man | man -l -\n  flexframe man study run > flexframe-study-run.1")]
pub(super) struct Args {
    /// The command, such as build, or study run.
    #[arg(value_name = "COMMAND")]
    pub command: Vec<String>,
}

/// Prints the page of the whole command line, or of one command.
pub(super) fn run(args: &Args, _: &Common) -> Result<ExitCode, Failure> {
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
