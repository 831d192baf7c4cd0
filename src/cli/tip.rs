//! Tips for a command line that does not parse: none that misleads, and one where another way is meant.

use clap::error::{ContextKind, ContextValue, ErrorKind};

/// What is no option of a command, and where it is chosen instead.
const ELSEWHERE: [(&str, &str); 4] = [
    ("--printer", "the frame file chooses the printer: printer = \"NAME\"; `flexframe list printers` names them"),
    (
        "--material",
        "--rigid MATERIAL chooses that of the rigid parts, where a command has it; else the frame file: materials.rigid = \"NAME\"",
    ),
    ("--battery", "the frame file chooses bought parts: bought.battery = \"NAME\"; `flexframe new` writes one"),
    ("--propeller", "the frame file chooses bought parts: bought.propeller = \"NAME\"; `flexframe new` writes one"),
];

/// The error without the advice to pass an option as a value, as no value of ours begins with a dash.
pub(super) fn mended(mut error: clap::Error) -> clap::Error {
    if error.kind() != ErrorKind::UnknownArgument {
        return error;
    }
    let own = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(asked)) => ELSEWHERE.iter().find(|(option, _)| option == asked),
        _ => None,
    };
    error.remove(ContextKind::TrailingArg);
    error.remove(ContextKind::Suggested);
    if let Some((_, tip)) = own {
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![(*tip).into()]));
    }
    error
}
