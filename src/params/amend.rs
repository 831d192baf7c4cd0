//! The text of a frame file with other values; comments, order and all else stay.

use toml_edit::{DocumentMut, InlineTable, Item, Key, Table, TableLike, TomlError};

use super::frame_file::Value;

/// A value that the text is to state, or no longer to state.
#[derive(Clone, Copy, Debug)]
pub struct Amendment<'a> {
    /// The key with its tables, as TOML writes it.
    pub key: &'a str,
    /// The value; none takes the key out.
    pub value: Option<&'a Value>,
    /// The reason, as a comment after the value; if it is empty, an existing comment is kept.
    pub why: &'a str,
}

/// The mark that some editors begin a file with.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// The text with these amendments, its byte order mark as it was, and all lines ended as the first one is.
///
/// # Errors
/// When the text is not TOML, or holds a value where a key has its table.
pub fn amended(text: &str, amendments: &[Amendment]) -> Result<String, String> {
    let (mark, bare) = text.strip_prefix(BYTE_ORDER_MARK).map_or(("", text), |bare| ("\u{feff}", bare));
    let amended = amended_lines(bare, amendments)?.replace("\r\n", "\n");
    let is_dos = bare.split_once('\n').is_some_and(|(first, _)| first.ends_with('\r'));
    Ok(format!("{mark}{}", if is_dos { amended.replace('\n', "\r\n") } else { amended }))
}

fn amended_lines(text: &str, amendments: &[Amendment]) -> Result<String, String> {
    let mut document: DocumentMut = text.parse().map_err(|error: TomlError| error.to_string())?;
    for amendment in amendments {
        let steps = Key::parse(amendment.key).map_err(|error| error.to_string())?;
        let Some((name, tables)) = steps.split_last() else { continue };
        match amendment.value {
            Some(value) => state(document.as_table_mut(), tables, name, value, amendment.why)?,
            None => take_out(document.as_table_mut(), tables, name),
        }
    }
    Ok(document.to_string())
}

fn state(document: &mut Table, tables: &[Key], name: &Key, value: &Value, why: &str) -> Result<(), String> {
    let mut value = formatted(value).parse::<toml_edit::Value>().map_err(|error| error.to_string())?;
    let mut table = document as &mut dyn TableLike;
    let mut in_a_line = false;
    for step in tables {
        let inner = table.entry(step.get()).or_insert_with(if in_a_line { inline_table } else { implicit_table });
        in_a_line |= inner.is_inline_table();
        table = inner.as_table_like_mut().ok_or_else(|| format!("`{}` is no table there", step.get()))?;
    }
    if why.is_empty() {
        let former = table.get(name.get()).and_then(Item::as_value).map(|former| former.decor().clone());
        former.into_iter().for_each(|former| *value.decor_mut() = former);
    } else if !in_a_line {
        // A comment takes the rest of its line, and in an inline table that is the table's end.
        value.decor_mut().set_suffix(format!(" # {}", why.replace(char::is_control, " ")));
    }
    table.insert(name.get(), value.into());
    Ok(())
}

/// Takes a key out; a table that holds nothing then goes, too.
fn take_out(table: &mut dyn TableLike, tables: &[Key], name: &Key) {
    let Some((first, rest)) = tables.split_first() else {
        table.remove(name.get());
        return;
    };
    let Some(inner) = table.get_mut(first.get()).and_then(Item::as_table_like_mut) else { return };
    take_out(inner, rest, name);
    if inner.is_empty() {
        table.remove(first.get());
    }
}

/// A table that shows only when it holds values.
fn implicit_table() -> Item {
    let mut table = Table::new();
    table.set_implicit(true);
    Item::Table(table)
}

/// A table within an inline one, which holds no others.
fn inline_table() -> Item {
    Item::Value(InlineTable::new().into())
}

/// A value as TOML.
pub fn formatted(value: &Value) -> String {
    match value {
        Value::Number(number) => format!("{number:?}"),
        Value::Text(text) => quoted(text),
        Value::Other(other) => other.to_string(),
    }
}

/// A basic string of TOML: JSON's escapes are among its own. JSON leaves the delete character as it is, which TOML does not allow.
pub fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('\u{7f}', "\\u007f")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::FrameFile;

    #[test]
    fn analytic_what_is_amended_keeps_the_rest() {
        let before = "# mine\nbase = \"cognifly\" # the base\n\n[rods]\n# long\narm_rod_length_mm = 80.0\n\n[override.materials.tpu-95a]\nprint_factor = 0.9 # guessed\n";
        let numbers = [0.95, 0.97, -0.2, 0.6].map(Value::Number);
        let keys = [
            "override.materials.tpu-95a.print_factor",
            "override.materials.abs.print_factor",
            "fit.grip_clearance_mm",
            "override.printers.\"generic-0.4\".nozzle_mm",
        ];
        let lines: Vec<Amendment> =
            keys.iter().zip(&numbers).map(|(key, value)| Amendment { key, value: Some(value), why: "weighed" }).collect();
        let after = amended(before, &lines).expect("amends");
        for kept in
            ["# mine\nbase = \"cognifly\" # the base\n\n[rods]\n# long\narm_rod_length_mm = 80.0\n", "print_factor = 0.95 # weighed\n"]
        {
            assert!(after.contains(kept), "{after}");
        }
        assert!(!after.contains("guessed") && !after.contains("[override]\n"), "{after}");
        let file = FrameFile::parse("mine", &after).expect(&after);
        assert_eq!(file.entries["fit.grip_clearance_mm"].value, Value::Number(-0.2));
        assert_eq!(amended(&after, &lines).expect("amends"), after);
        assert!(amended("fit = 3\n", &lines).is_err());
    }

    #[test]
    fn planted_inline_tables_and_reasons_of_any_text_stay_toml() {
        let number = Value::Number(0.25);
        let keys = ["fit.plug_clearance_mm", "override.materials.abs.print_factor", "rods.arm_rod_length_mm"];
        let lines = keys.map(|key| Amendment { key, value: Some(&number), why: "found\n\u{7}by \u{7f}hand" });
        let after = amended("fit = {plug_clearance_mm = 0.1, slide_clearance_mm = 0.2}\noverride = {}\n", &lines).expect("amends");
        let file = FrameFile::parse("mine", &after).expect(&after);
        assert!(keys.iter().all(|key| file.entries[*key].value == number), "{after}");
        assert!(after.contains("0.25 # found  by  hand\n"), "{after}");
    }

    #[test]
    fn analytic_the_ends_of_lines_and_the_mark_at_the_head_stay() {
        let number = Value::Number(81.0);
        let line = [Amendment { key: "rods.arm_rod_length_mm", value: Some(&number), why: "" }];
        let unix = "base = \"cognifly\" # mine\n\n[rods]\narm_rod_length_mm = 80.0\n";
        let expected = unix.replace("80.0", "81.0");
        for (mark, end) in [("", "\n"), ("", "\r\n"), ("\u{feff}", "\n"), ("\u{feff}", "\r\n")] {
            let of = |text: &str| format!("{mark}{}", text.replace('\n', end));
            assert_eq!(amended(&of(unix), &line).as_deref(), Ok(of(&expected).as_str()), "{end:?}");
        }
    }

    #[test]
    fn analytic_what_is_taken_out_leaves_no_trace() {
        let before = "base = \"cognifly\"\n";
        let number = Value::Number(80.0);
        let key = "rods.arm_rod_length_mm";
        let stated = amended(before, &[Amendment { key, value: Some(&number), why: "" }]).expect("amends");
        assert!(stated.contains("[rods]\narm_rod_length_mm = 80.0\n"), "{stated}");
        assert_eq!(amended(&stated, &[Amendment { key, value: None, why: "" }]).expect("amends"), before);
        let commented = stated.replace("80.0\n", "80.0 # long\n");
        let other = Value::Number(81.0);
        let changed = amended(&commented, &[Amendment { key, value: Some(&other), why: "" }]).expect("amends");
        assert_eq!(changed, commented.replace("80.0", "81.0"));
    }
}
