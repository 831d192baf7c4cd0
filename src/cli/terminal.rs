//! What goes to the terminal: data to standard output, messages to standard error.

use std::borrow::Cow;
use std::io::{self, ErrorKind, Write};

use super::failure::Failure;

/// Colours that this program paints with; no other escape sequence reaches a terminal.
pub(super) const PAINT: [&str; 4] = ["\x1b[31m", "\x1b[32m", "\x1b[33m", "\x1b[0m"];

/// A text that a terminal shows and does not obey: control characters, and marks that turn the direction of writing, are written as
/// JSON writes them. Line feeds, tabs and [`PAINT`] stay.
pub(super) fn shown(text: &str) -> Cow<'_, str> {
    let turns = |c: char| matches!(c, '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let obeyed = |c: char| (c.is_control() && c != '\n' && c != '\t') || turns(c);
    if !text.contains(obeyed) {
        return text.into();
    }
    let mut safe = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let own = PAINT.iter().find(|paint| rest.starts_with(**paint));
        match own {
            Some(paint) => safe += paint,
            None if obeyed(c) => safe += &format!("\\u{:04x}", u32::from(c)),
            None => safe.push(c),
        }
        rest = &rest[own.map_or(c.len_utf8(), |paint| paint.len())..];
    }
    safe.into()
}

/// Prints data. A reader that has gone (a closed pipe) wants no more, and is nobody's failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(shown(text).as_bytes()).and_then(|()| out.flush()) {
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
    let _ = writeln!(io::stderr().lock(), "{}", shown(message));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_terminal_obeys_nothing_but_our_colours() {
        assert_eq!(shown("\x1b[31mred\x1b[0m\tand\nplain ä"), "\x1b[31mred\x1b[0m\tand\nplain ä");
        assert_eq!(shown("a\x1b]0;title\x07b\rc\u{9b}2Jd\u{202e}e\u{200f}f"), "a\\u001b]0;title\\u0007b\\u000dc\\u009b2Jd\\u202ee\\u200ff");
        let json = serde_json::to_string("\u{9b}\u{7f}").expect("JSON");
        assert_eq!(serde_json::from_str::<String>(&shown(&json)).expect("still JSON"), "\u{9b}\u{7f}");
    }
}
