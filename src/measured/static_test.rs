//! A static test: a CSV table of displacement and force, `displacement_mm,force_n`; other columns are left aside.

use std::ops::RangeInclusive;
use std::path::Path;

use super::malformed::{Fault, Malformed, Place};
use super::reading::{bytes_of, malformed};
use super::table::{number, refused};

/// Columns that must be there.
const COLUMNS: [&str; 2] = ["displacement_mm", "force_n"];
/// Displacements, mm, and forces, N, that can be.
const BOUNDS: [RangeInclusive<f64>; 2] = [0.0..=200.0, 0.0..=1e5];
/// Units of the columns.
const UNITS: [&str; 2] = ["mm", "N"];
/// Most bytes of a table.
const MOST_BYTES: u64 = 1 << 20;

/// Displacement, mm, and force, N, of each row of a table.
///
/// # Errors
/// When it cannot be read, lacks a column, or a row is no pair of numbers.
pub fn read_static_test(path: &Path) -> Result<Vec<[f64; 2]>, Malformed> {
    rows(&bytes_of(path, MOST_BYTES)?).map_err(|(place, fault)| malformed(path, place, fault))
}

fn rows(bytes: &[u8]) -> Result<Vec<[f64; 2]>, (Place, Fault)> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(bytes);
    let names = reader.byte_headers().map_err(|error| refused(&error))?.clone();
    let place = |wanted: &str| names.iter().position(|name| name.trim_ascii() == wanted.as_bytes());
    let missing: Vec<String> = COLUMNS.iter().filter(|column| place(column).is_none()).map(|column| (*column).into()).collect();
    let [Some(displacement), Some(force)] = COLUMNS.map(place) else {
        return Err((Place::Line(1), Fault::NoColumn { missing }));
    };
    let mut points = Vec::new();
    let mut row = csv::ByteRecord::new();
    while reader.read_byte_record(&mut row).map_err(|error| refused(&error))? {
        let line = row.position().map_or(0, csv::Position::line);
        let mut point = [0.0; 2];
        for (at, column) in [displacement, force].into_iter().enumerate() {
            point[at] = number(&row, column, COLUMNS[at], &BOUNDS[at], UNITS[at]).map_err(|fault| (Place::Line(line), fault))?;
        }
        points.push(point);
    }
    if points.is_empty() { Err((Place::Whole, Fault::Empty)) } else { Ok(points) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_columns_stand_in_any_order_and_remarks_are_skipped() {
        let found = rows(b"# by hand\nforce_n,who,displacement_mm\n20,me,1\n33,me,3.5\n").expect("reads");
        assert_eq!(found, [[1.0, 20.0], [3.5, 33.0]]);
    }

    #[test]
    fn planted_faults_are_named_with_their_line() {
        for (text, place, says) in [
            ("displacement_mm\n1\n", Place::Line(1), "lacks the column `force_n`"),
            ("displacement_mm,force_n\n1,x\n", Place::Line(2), "`force_n` is `x`"),
            ("displacement_mm,force_n\n-1,2\n", Place::Line(2), "out of bounds"),
            ("displacement_mm,force_n\n", Place::Whole, "is empty"),
        ] {
            let (at, fault) = rows(text.as_bytes()).expect_err("is refused");
            assert!(at == place && fault.to_string().contains(says), "{text}: {at:?} {fault}");
        }
    }
}
