//! A short table that a person wrote: one thing a row, columns in any order, parted by commas, semicolons or tabs, remarks after `#`.

use super::encoding::plain;
use super::malformed::{Fault, SourcePosition};
use super::row_lines::{REMARK, RowLines};
use super::table::refused;
use super::table_header::separator;

/// Most bytes of such a table on a disk.
#[cfg(feature = "cli")]
pub(super) const MOST_BYTES: u64 = 1 << 20;

/// Columns of a table.
pub(super) struct Columns<const N: usize> {
    /// Those that must be there.
    pub needed: [&'static str; N],
    /// One that may be there.
    pub optional: Option<&'static str>,
    /// All of them in words, for who lacks one.
    pub known: &'static str,
}

/// Places of the columns in a row: those that are needed, and the one that may be there.
pub(super) type Places<const N: usize> = ([usize; N], Option<usize>);

/// What each row says; at least one.
pub(super) fn rows<T, const N: usize>(
    bytes: &[u8],
    columns: &Columns<N>,
    read: impl Fn(&csv::ByteRecord, u64, Places<N>) -> Result<T, Fault>,
) -> Result<Vec<T>, (SourcePosition, Fault)> {
    let bytes = plain(bytes)?;
    let mut reader = csv::ReaderBuilder::new().comment(Some(REMARK)).delimiter(separator(bytes)).from_reader(bytes);
    let names = reader.byte_headers().map_err(|error| refused(&error, RowLines::of(bytes, true)))?.clone();
    let twice = |name: &str| names.iter().filter(|found| found.trim_ascii() == name.as_bytes()).count() > 1;
    if let Some(name) = columns.needed.iter().chain(&columns.optional).find(|name| twice(name)) {
        return Err((SourcePosition::Line(1), Fault::TwoColumns { name: name.to_string() }));
    }
    let place = |wanted: &str| names.iter().position(|name| name.trim_ascii() == wanted.as_bytes());
    let found = columns.needed.map(place);
    let missing: Vec<String> =
        columns.needed.iter().zip(found).filter(|(_, at)| at.is_none()).map(|(name, _)| format!("`{name}`")).collect();
    if !missing.is_empty() {
        let found = names.iter().map(|name| String::from_utf8_lossy(name).into_owned()).collect();
        return Err((SourcePosition::Line(1), Fault::NoColumn { missing, found, known: columns.known }));
    }
    let places = (found.map(Option::unwrap_or_default), columns.optional.and_then(place));
    let mut said = Vec::new();
    let (mut row, mut lines) = (csv::ByteRecord::new(), RowLines::of(bytes, true));
    while reader.read_byte_record(&mut row).map_err(|error| refused(&error, RowLines::of(bytes, true)))? {
        let line = lines.at(row.position());
        said.push(read(&row, line, places).map_err(|fault| (SourcePosition::Line(line), fault))?);
    }
    if said.is_empty() { Err((SourcePosition::Whole, Fault::NoRows)) } else { Ok(said) }
}
