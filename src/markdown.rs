//! Texts of users in Markdown.

/// A space without width: behind an `@` it keeps forges from telling somebody.
const APART: char = '\u{200b}';

/// A text that is read and not obeyed: no HTML, no link under another name, no picture, nobody who is told, no end of a table's cell, no new line. A plain
/// address stays one.
pub fn inert(text: &str) -> String {
    let mut inert = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        match (c, chars.peek()) {
            ('\n' | '\r', _) => inert.push(' '),
            ('@', Some(next)) if next.is_alphanumeric() => inert.extend([c, APART]),
            // Before anything else it is the sign of a comparison.
            ('<', Some(next)) if next.is_alphabetic() || "/!?".contains(*next) => inert += "&lt;",
            (']', Some('(' | '[' | ':')) => inert += "\\]",
            // Else it would take back the one that is put before a bracket.
            ('\\', _) => inert += "\\\\",
            ('|', _) => inert += "\\|",
            _ => inert.push(c),
        }
    }
    inert
}

/// A text as code, whatever backticks are in it: a fence is longer than any run of them.
pub fn code(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    // A backtick at an end would make the fence longer.
    let apart = if text.starts_with('`') || text.ends_with('`') { " " } else { "" };
    format!("{fence}{apart}{}{apart}{fence}", text.replace(['\n', '\r'], " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_text_stays_a_text() {
        assert_eq!(inert("<script>x</script>\n# a"), "&lt;script>x&lt;/script> # a");
        assert_eq!(inert("![a](http://b) [c]: d [e][f]"), "![a\\](http://b) [c\\]: d [e\\][f]");
        assert_eq!(inert("a@b.c @a @ 1"), "a@\u{200b}b.c @\u{200b}a @ 1");
        assert_eq!(inert("a | b < 3, <5 [mm]"), "a \\| b < 3, <5 [mm]");
        assert_eq!(code("a.toml:3"), "`a.toml:3`");
        assert_eq!(code("a`[b](c)``d\n"), "```a`[b](c)``d ```");
        assert_eq!(code("`"), "`` ` ``");
        assert_eq!(inert("![a\\](b)"), "![a\\\\\\](b)");
    }
}
