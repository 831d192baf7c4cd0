//! The command line: the only place that prints, and that opens files for writing.

mod arguments;
mod bom;
mod build;
mod cache;
mod check;
mod choice;
mod coupon;
mod diagnose;
mod diff;
mod drop;
mod drop_fit;
mod drop_frame;
mod explain;
mod fit;
mod fold;
mod frame_text;
mod frames;
mod measure;
mod new;
mod output;
mod params;
mod progress;
mod render;
mod revision;
mod schema;
mod session;
mod slicer;
mod solve;
mod stiffness;
mod synthesize;
mod table;
mod terminal;
mod watch;
mod weigh;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};

use arguments::{Arguments, Command};
pub use session::Failure;

/// Runs the program: parses the command line, does the work, prints, and tells the shell how it went.
///
/// Exit codes: 0 good, 1 a limit is violated, 2 input or usage is wrong, 3 the machine failed.
pub fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            let code = if error.use_stderr() { 2 } else { 0 };
            // A closed pipe while printing help is nobody's failure.
            let _ = error.print();
            return ExitCode::from(code);
        }
    };
    match perform(&arguments) {
        Ok(code) => code,
        Err(failure) => {
            terminal::tell(failure.render().trim_end());
            ExitCode::from(failure.exit_code())
        }
    }
}

fn perform(arguments: &Arguments) -> Result<ExitCode, Failure> {
    match &arguments.command {
        Command::Bom(options) => bom::bom(options, &arguments.common),
        Command::Diff(options) => diff::diff(options, &arguments.common),
        Command::Explain(options) => explain::explain(options, &arguments.common),
        Command::New(options) => new::new(options, &arguments.common),
        Command::Schema(options) => schema::print(options),
        Command::Solve(options) => solve::run(options, &arguments.common),
        Command::Coupon(options) => coupon::coupon(options, &arguments.common),
        Command::Weigh(options) => weigh::weigh(options, &arguments.common),
        Command::Watch(options) => watch::watch(options, &arguments.common),
        Command::Build(options) => build::build(options, &arguments.common),
        Command::Check(options) => check::check(options, &arguments.common),
        Command::Diagnose(options) => diagnose::diagnose(options, &arguments.common),
        Command::Synthesize(options) => synthesize::synthesize(options, &arguments.common),
        Command::Fold(options) => fold::fold(options, &arguments.common),
        Command::Drop(options) => drop::drop(options, &arguments.common),
        Command::Fit(options) => fit::fit(options, &arguments.common),
        Command::Measure(options) => measure::measure(options, &arguments.common),
        Command::Stiffness(options) => stiffness::stiffness(options, &arguments.common),
        Command::Render(options) => render::render(options, &arguments.common),
        Command::Params(options) => params::list(options, &arguments.common),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "flexframe", &mut script);
            terminal::print(&String::from_utf8_lossy(&script))?;
            Ok(ExitCode::SUCCESS)
        }
        Command::Man => {
            let mut page = Vec::new();
            let written = clap_mangen::Man::new(Arguments::command()).render(&mut page);
            written.map_err(|error| Failure::Machine { what: "cannot make the manual page".into(), error })?;
            terminal::print(&String::from_utf8_lossy(&page))?;
            Ok(ExitCode::SUCCESS)
        }
    }
}
