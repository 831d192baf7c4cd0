//! The command line: the only place that prints, and that opens files for writing.
//!
//! A subcommand is a file: its `Args`, with the words of its help, and its `run`. `commands!` below is the one list of them.

mod bom;
mod bounded;
mod build;
mod cache;
mod check;
mod choice;
mod completions;
mod coupon;
mod diagnose;
mod diff;
mod drop;
mod explain;
mod failure;
mod fit;
mod fold;
mod frame_text;
mod frames;
mod given_drops;
mod man;
mod measure;
mod new;
mod options;
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
mod studio;
mod synthesize;
mod table;
mod terminal;
#[cfg(test)]
mod tests;
mod watch;
mod weigh;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

pub use failure::Failure;
use options::Common;

/// Flexible, printable drone frames from one parameter file.
#[derive(Debug, Parser)]
#[command(name = "flexframe", version, about, arg_required_else_help = true, after_help = EXAMPLES)]
struct Arguments {
    /// What to do.
    #[command(subcommand)]
    command: Command,
    /// How to talk about it.
    #[command(flatten)]
    common: Common,
}

const EXAMPLES: &str = "Examples:
  flexframe build                                  the default frame into out/cognifly
  flexframe build params/frames/cognifly-mini.toml -o /tmp/frames
  flexframe check cognifly-v8                      exits 1: it is 1.92 mm too wide, for one
  flexframe render cognifly
  flexframe drop --model paper --height 0.5,1,1.5
  flexframe measure ../shared/data/crash_landing
  flexframe fit --model paper-corrected ../shared/data/crash_landing/soft_*
  flexframe params --filter arm

Exit codes: 0 good, 1 a limit is violated, 2 input or usage is wrong, 3 the machine failed";

/// Makes the subcommands of the files that hold them, in the order of the help.
macro_rules! commands {
    ($($name:ident in $file:ident),* $(,)?) => {
        /// The subcommands.
        #[derive(Debug, Subcommand)]
        enum Command {
            $($name($file::Args),)*
        }

        impl Command {
            fn run(&self, common: &Common) -> Result<ExitCode, Failure> {
                match self {
                    $(Self::$name(args) => $file::run(args, common),)*
                }
            }
        }
    };
}

commands! {
    Build in build,
    Check in check,
    Fold in fold,
    Drop in drop,
    Diagnose in diagnose,
    Synthesize in synthesize,
    Fit in fit,
    Measure in measure,
    Stiffness in stiffness,
    Render in render,
    Params in params,
    Diff in diff,
    Explain in explain,
    New in new,
    Solve in solve,
    Watch in watch,
    Studio in studio,
    Coupon in coupon,
    Weigh in weigh,
    Bom in bom,
    Schema in schema,
    Completions in completions,
    Man in man,
}

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
    match arguments.command.run(&arguments.common) {
        Ok(code) => code,
        Err(failure) => {
            terminal::tell(failure.render().trim_end());
            ExitCode::from(failure.exit_code())
        }
    }
}
