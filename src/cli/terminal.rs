//! What goes to the terminal: data to standard output, messages to standard error.

use std::io::{self, ErrorKind, Write};

use super::failure::Failure;

/// Prints data. A reader that has gone (a closed pipe) wants no more, and is nobody's failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Machine { what: "cannot print".into(), error }),
        _ => Ok(()),
    }
}

/// Prints a value as JSON.
pub(super) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text =
        serde_json::to_string_pretty(value).map_err(|error| Failure::Machine { what: "cannot print JSON".into(), error: error.into() })?;
    print(&(text + "\n"))
}

/// Tells of something beside the data; nobody may be listening.
pub(super) fn tell(message: &str) {
    let _ = writeln!(io::stderr().lock(), "{message}");
}
