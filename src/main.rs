//! The `flexframe` program.

use std::process::ExitCode;

fn main() -> ExitCode {
    flexframe::cli::run()
}
