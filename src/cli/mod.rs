//! The command line: the only place that prints, and that opens files for writing.
//!
//! A subcommand is a file: its `Args`, with the words of its help, and its `run`. `commands!` below is the one list of them.

mod bom;
mod bounded;
mod build;
mod cache;
mod candidates;
mod check;
mod choice;
mod completions;
mod coupon;
mod diagnose;
mod diff;
mod drop;
mod explain;
mod export;
mod failure;
mod fit;
mod fold;
mod frame_text;
mod frames;
mod given_drops;
mod interrupt;
mod list;
mod man;
mod measure;
mod names;
mod new;
mod options;
mod output;
mod params;
mod progress;
mod render;
mod revision;
mod schema;
mod searching;
mod session;
mod slicer;
mod solve;
mod stiffness;
mod studio;
mod study;
mod synthesize;
mod table;
mod terminal;
#[cfg(test)]
mod tests;
mod tip;
mod varied;
mod watch;
mod weigh;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

pub use failure::Failure;
use options::Common;

/// Flexible, printable drone frames from one parameter file.
#[derive(Debug, Parser)]
#[command(name = "flexframe", version, about, arg_required_else_help = true, after_help = EXAMPLES)]
struct Arguments {
    /// What to do.
    #[command(subcommand)]
    command: Command,
    /// Options of every command.
    #[command(flatten)]
    common: Common,
}

impl Arguments {
    /// Whether standard output is JSON, of an error, too.
    fn wants_json(&self) -> bool {
        let by_format = match &self.command {
            Command::Check(args) => args.wants_json(),
            Command::Diff(args) => args.wants_json(),
            Command::Bom(args) => args.wants_json(),
            _ => false,
        };
        self.common.json || by_format
    }
}

const EXAMPLES: &str = "Examples:
  flexframe build                                  the default frame into out/cognifly
  flexframe build params/frames/cognifly-mini.toml -o /tmp/frames
  flexframe check cognifly-v8                      exits 1: among others, it is 1.92 mm too wide
  flexframe render cognifly
  flexframe drop --model paper --height 0.5,1,1.5
  flexframe measure soft_050cm soft_100cm drops.csv
  flexframe fit --model paper-corrected drops.csv
  flexframe params --filter arm

Exit codes: 0 good, 1 a limit is violated, 2 input or usage is wrong, 3 a disk or permission error";

/// Makes the subcommands of the files that hold them, by what they are for, in the order of the help.
macro_rules! commands {
    ($($group:literal: $($name:ident in $file:ident),*;)*) => {
        /// The subcommands.
        #[derive(Debug, Subcommand)]
        enum Command {
            $($($name($file::Args),)*)*
        }

        /// What subcommands are for, and which these are.
        const GROUPS: &[(&str, &[&str])] = &[$(($group, &[$(stringify!($name)),*])),*];

        impl Command {
            fn run(&self, common: &Common) -> Result<ExitCode, Failure> {
                match self {
                    $($(Self::$name(args) => $file::run(args, common),)*)*
                }
            }
        }
    };
}

commands! {
    "Design": Build in build, Check in check, New in new, Solve in solve, Explain in explain, Params in params, Watch in watch, Studio in studio;
    "Make": Fold in fold, Bom in bom, Coupon in coupon, Weigh in weigh, Render in render;
    "Simulate": Drop in drop, Stiffness in stiffness, Export in export;
    "Compare": Diff in diff, Study in study;
    "Measured drops": Measure in measure, Fit in fit, Diagnose in diagnose, Synthesize in synthesize;
    "Names and shells": List in list, Schema in schema, Completions in completions, Man in man;
}

/// The command line, its help in groups.
pub(super) fn command_line() -> clap::Command {
    let command = Arguments::command();
    let listed = groups(&command);
    command
        .help_template("{about-with-newline}\n{usage-heading} {usage}\n\n{before-help}Options:\n{options}{after-help}")
        .before_help(listed)
}

/// The subcommands by what they are for, a line each.
fn groups(command: &clap::Command) -> String {
    let line = |name: &&str| {
        let name = name.to_lowercase();
        let about = command.find_subcommand(&name).and_then(|found| found.get_about()).map(ToString::to_string).unwrap_or_default();
        let options = textwrap::Options::new(80).initial_indent("  ").subsequent_indent("               ");
        textwrap::fill(&format!("{name:<12} {about}"), options) + "\n"
    };
    GROUPS.iter().map(|(group, names)| format!("{group}:\n{}\n", names.iter().map(line).collect::<String>())).collect::<String>()
}

/// Prints help, or why the command line does not parse; where its words ask for JSON as a JSON object, too.
fn unparsed(error: clap::Error) -> ExitCode {
    let is_wrong = error.use_stderr();
    let printed = error.print().and_then(|()| std::io::stdout().flush());
    if !is_wrong {
        return match printed {
            // A closed pipe while printing help is nobody's failure.
            Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                failed(&Failure::Machine { what: "cannot print".into(), error })
            }
            _ => ExitCode::SUCCESS,
        };
    }
    let failure = Failure::Usage { message: cause(&error) };
    if asks_for_json(&std::env::args_os().collect::<Vec<_>>()) {
        // A closed pipe is nobody's failure; the exit code is.
        let _ = terminal::print_json(&failure.json());
    }
    ExitCode::from(failure.exit_code())
}

/// Whether the words of a command line that does not parse ask for JSON.
fn asks_for_json(words: &[OsString]) -> bool {
    let is_one = |word: &OsString| word == "--json" || word == "--format=json";
    words.iter().any(is_one) || words.windows(2).any(|pair| pair[0] == "--format" && pair[1] == "json")
}

/// Why a command line does not parse, in one line.
fn cause(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "no command is given".into();
    }
    let text = error.render().to_string();
    let first = text.split("\n\n").next().unwrap_or_default().trim_start_matches("error:");
    first.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Runs the program: parses the command line, does the work, prints, and tells the shell how it went.
///
/// Exit codes: 0 good, 1 a limit is violated, 2 input or usage is wrong, 3 the machine failed.
pub fn run() -> ExitCode {
    // A shell that asks how a word goes on gets its answer here, and the program ends.
    clap_complete::CompleteEnv::with_factory(command_line).var(completions::ASKS).bin("flexframe").complete();
    let arguments = match command_line().try_get_matches().and_then(|matches| Arguments::from_arg_matches(&matches)) {
        Ok(arguments) => arguments,
        Err(error) => {
            return unparsed(tip::mended(error));
        }
    };
    interrupt::listen();
    match arguments.command.run(&arguments.common) {
        Ok(code) => code,
        Err(failure) => {
            let code = failed(&failure);
            if arguments.wants_json() {
                // A closed pipe is nobody's failure; the exit code is.
                let _ = terminal::print_json(&failure.json());
            }
            code
        }
    }
}

/// Tells why it failed; the exit code.
fn failed(failure: &Failure) -> ExitCode {
    terminal::tell(failure.render().trim_end());
    ExitCode::from(failure.exit_code())
}
