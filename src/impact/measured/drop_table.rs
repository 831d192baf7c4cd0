//! A table of what else is known of drops: `trial`, `height_m` where trials are numbered anew at each height, and one column a quantity.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::encoding::plain;
use super::height::is_same_m;
use super::malformed::{Fault, Malformed, SourcePosition};
use super::reading::malformed;
use super::record::DropSet;
use super::row_lines::{REMARK, RowLines};
use super::table::{HEIGHTS_M, number, refused};
use super::table_header::separator;

/// Every column that such a table can have, in words.
const KNOWN: &str = "trial, height_m if trials are numbered anew at each height, and a column for each quantity";

/// What a row says of a drop.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    trial: String,
    height_m: Option<f64>,
    values: Vec<String>,
}

/// What else is known of drops.
#[derive(Clone, Debug, PartialEq)]
pub struct DropTable {
    /// Names of the quantities.
    pub columns: Vec<String>,
    rows: Vec<Row>,
}

impl DropTable {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Malformed`] with the line.
    #[cfg(feature = "cli")]
    pub fn read(path: &Path) -> Result<Self, Malformed> {
        Self::read_bytes(&path.display().to_string(), &super::disk::bytes_of(path, super::sheet::MOST_BYTES)?)
    }

    /// The same from the bytes of a file of this name.
    ///
    /// # Errors
    /// [`Malformed`] with the line.
    pub fn read_bytes(name: &str, bytes: &[u8]) -> Result<Self, Malformed> {
        table(bytes).map_err(|(place, fault)| malformed(Path::new(name), place, fault))
    }

    /// Adds what the table says to the drops; how many drops it has no row of.
    pub fn add_to(&self, set: &mut DropSet) -> usize {
        let mut of_trial: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
        for row in &self.rows {
            of_trial.entry(&row.trial).or_default().push(row);
        }
        let mut without = 0;
        for record in set.groups.iter_mut().flat_map(|group| &mut group.records) {
            let height_m = record.height_m;
            let own = |row: &&&Row| row.height_m.is_none_or(|of_m| is_same_m(of_m, height_m));
            match of_trial.get(record.trial.as_str()).and_then(|rows| rows.iter().find(own)) {
                Some(row) => record.columns.extend(self.columns.iter().cloned().zip(row.values.iter().cloned())),
                None => without += 1,
            }
        }
        without
    }
}

fn table(bytes: &[u8]) -> Result<DropTable, (SourcePosition, Fault)> {
    let bytes = plain(bytes)?;
    let mut reader = csv::ReaderBuilder::new().comment(Some(REMARK)).delimiter(separator(bytes)).from_reader(bytes);
    let names = reader.byte_headers().map_err(|error| refused(&error, RowLines::of(bytes, true)))?.clone();
    let names: Vec<String> = names.iter().map(|name| String::from_utf8_lossy(name.trim_ascii()).into_owned()).collect();
    let mut before = BTreeSet::new();
    if let Some(name) = names.iter().find(|name| !before.insert(*name)) {
        return Err((SourcePosition::Line(1), Fault::TwoColumns { name: name.clone() }));
    }
    let place = |wanted: &str| names.iter().position(|name| name == wanted);
    let (trial, height) = (place("trial"), place("height_m"));
    let others: Vec<usize> = (0..names.len()).filter(|at| Some(*at) != trial && Some(*at) != height).collect();
    let (Some(trial), false) = (trial, others.is_empty()) else {
        let missing = if trial.is_none() { "`trial`" } else { "of a quantity" };
        return Err((SourcePosition::Line(1), Fault::NoColumn { missing: vec![missing.into()], found: names, known: KNOWN }));
    };
    let mut seen = BTreeSet::new();
    let mut rows = Vec::new();
    let (mut row, mut lines) = (csv::ByteRecord::new(), RowLines::of(bytes, true));
    while reader.read_byte_record(&mut row).map_err(|error| refused(&error, RowLines::of(bytes, true)))? {
        let at = SourcePosition::Line(lines.at(row.position()));
        let text = |column: usize| String::from_utf8_lossy(row.get(column).unwrap_or_default().trim_ascii()).into_owned();
        let height_m = height.map(|column| number(&row, column, "height_m", &HEIGHTS_M, "m")).transpose();
        let height_m = height_m.map_err(|fault| (at, fault))?;
        let one = Row { trial: text(trial), height_m, values: others.iter().map(|column| text(*column)).collect() };
        if one.trial.is_empty() {
            return Err((at, Fault::NoTrial));
        }
        if !seen.insert((one.trial.clone(), height_m.map(f64::to_bits))) {
            return Err((at, Fault::TwoRows { trial: one.trial }));
        }
        rows.push(one);
    }
    if rows.is_empty() {
        return Err((SourcePosition::Whole, Fault::NoRows));
    }
    Ok(DropTable { columns: others.into_iter().map(|at| names[at].clone()).collect(), rows })
}

#[cfg(test)]
mod tests {
    use super::super::{FileFormat, read_bytes};
    use super::*;

    fn drops() -> DropSet {
        let text = "trial,height_m,t_s,accel_g\n1,0.5,0,0\n1,1,0,0\n2,1,0,0\n";
        read_bytes(&[("a.csv".into(), text.into())], &FileFormat::default()).expect("reads")
    }

    #[test]
    fn analytic_rows_find_their_drops() {
        let table = DropTable::read_bytes("c.csv", b"trial;height_m;surface\n1;0,5;mat\n1;1;floor\n").expect("reads");
        let mut set = drops();
        assert_eq!((table.add_to(&mut set), &table.columns[..]), (1, &["surface".to_string()][..]));
        let said: Vec<Option<&str>> = set.records().map(|record| record.column("surface")).collect();
        assert_eq!(said, [Some("mat"), Some("floor"), None]);
    }

    #[test]
    fn planted_tables_that_say_nothing_are_refused() {
        for (text, says) in [
            ("surface\nmat\n", "lacks the column `trial`"),
            ("trial\n1\n", "lacks the column"),
            ("trial,a\n", "has no row below its header"),
            ("trial,a\n1,2\n1,3\n", "line 3: has a second row of trial `1`"),
            ("trial,a,a\n1,2,2\n", "twice"),
            ("trial,height_m,a\n1,high,2\n", "line 2: `height_m` is `high`"),
        ] {
            let error = DropTable::read_bytes("c.csv", text.as_bytes()).expect_err("is refused");
            assert!(error.to_string().contains(says), "{text}: {error}");
        }
    }
}
