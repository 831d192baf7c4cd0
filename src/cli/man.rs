//! `flexframe man`: the manual page.

use std::process::ExitCode;

use clap::CommandFactory;

use super::failure::Failure;
use super::options::Common;
use super::terminal;

/// Print the manual page (roff).
#[derive(Debug, clap::Args)]
pub(super) struct Args {}

/// Prints the page of the whole command line.
pub(super) fn run(_: &Args, _: &Common) -> Result<ExitCode, Failure> {
    let mut page = Vec::new();
    let written = clap_mangen::Man::new(super::Arguments::command()).render(&mut page);
    written.map_err(|error| Failure::Machine { what: "cannot make the manual page".into(), error })?;
    terminal::print(&String::from_utf8_lossy(&page))?;
    Ok(ExitCode::SUCCESS)
}
