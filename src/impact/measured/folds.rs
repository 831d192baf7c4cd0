//! After how many folds hinges cracked: a CSV table `thickness_mm,fold_deg,folds`.

use std::ops::RangeInclusive;
use std::path::Path;

use super::malformed::{Fault, Malformed, SourcePosition};
use super::reading::malformed;
use super::sheet::{self, Columns};
use super::table::number;

/// The column that a person fills in.
const FOLDS: &str = "folds";
const COLUMNS: Columns<3> = Columns { needed: ["thickness_mm", "fold_deg", FOLDS], optional: None, known: "thickness_mm,fold_deg,folds" };
/// What stands there of a hinge that did not crack.
const HELD: &str = "held";
/// Thicknesses that a hinge can have, mm.
const THICKNESSES_MM: RangeInclusive<f64> = 0.2..=20.0;
/// Folds that a hand can make, degrees.
const FOLDS_DEG: RangeInclusive<f64> = 10.0..=180.0;

/// A hinge that was folded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldReading {
    /// Line of the file, from 1.
    pub line: u64,
    /// Thickness of its web, mm.
    pub thickness_mm: f64,
    /// How far it was folded, degrees.
    pub fold_deg: f64,
    /// After how many folds it cracked; nothing where it held.
    pub cracked_after: Option<u32>,
}

/// Reads a table of folded hinges; those that were not folded yet, with an empty last column, are left out. `most` is how often
/// each was to be folded.
///
/// # Errors
/// When it cannot be read, lacks a column, or a row says no number of folds.
#[cfg(feature = "cli")]
pub fn read_folds(path: &Path, most: u32) -> Result<Vec<FoldReading>, Malformed> {
    fold_readings(&path.display().to_string(), &super::disk::bytes_of(path, sheet::MOST_BYTES)?, most)
}

/// The same from the bytes of a file of this name.
///
/// # Errors
/// When it lacks a column, or a row says no number of folds.
pub fn fold_readings(name: &str, bytes: &[u8], most: u32) -> Result<Vec<FoldReading>, Malformed> {
    rows(bytes, most).map_err(|(place, fault)| malformed(Path::new(name), place, fault))
}

fn rows(bytes: &[u8], most: u32) -> Result<Vec<FoldReading>, (SourcePosition, Fault)> {
    let read = sheet::rows(bytes, &COLUMNS, |row, line, (at, _)| reading(row, line, at, most))?;
    Ok(read.into_iter().flatten().collect())
}

fn reading(row: &csv::ByteRecord, line: u64, [thickness, fold, folds]: [usize; 3], most: u32) -> Result<Option<FoldReading>, Fault> {
    let said = String::from_utf8_lossy(row.get(folds).unwrap_or_default().trim_ascii()).to_lowercase();
    if said.is_empty() {
        return Ok(None);
    }
    let cracked_after = match said.parse::<u32>() {
        Ok(count) if (1..=most).contains(&count) => Some(count),
        _ if said == HELD => None,
        _ => return Err(Fault::NoFolds { value: said.chars().take(40).collect(), most }),
    };
    let thickness_mm = number(row, thickness, COLUMNS.needed[0], &THICKNESSES_MM, "mm")?;
    let fold_deg = number(row, fold, COLUMNS.needed[1], &FOLDS_DEG, "deg")?;
    Ok(Some(FoldReading { line, thickness_mm, fold_deg, cracked_after }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_table_as_a_person_fills_it_in() {
        let text = "# black TPU\nfolds,thickness_mm,fold_deg\n 23,1.7,114\nHeld,2.9,114\n,3.8,114\n";
        let read = rows(text.as_bytes(), 100).expect("reads");
        let told: Vec<_> = read.iter().map(|r| (r.line, r.thickness_mm, r.fold_deg, r.cracked_after)).collect();
        assert_eq!(told, [(3, 1.7, 114.0, Some(23)), (4, 2.9, 114.0, None)]);
    }

    #[test]
    fn analytic_what_is_no_number_of_folds_is_refused_with_its_line() {
        let of = |row: &str| format!("thickness_mm,fold_deg,folds\n2.9,114,held\n{row}\n");
        for row in ["1.7,114,broke", "1.7,114,0", "1.7,114,101", "1.7,114,2.5", "1.7,114,-3"] {
            let (place, fault) = rows(of(row).as_bytes(), 100).expect_err("is refused");
            assert!(place == SourcePosition::Line(3) && matches!(fault, Fault::NoFolds { .. }), "{row}: {fault}");
        }
        for row in ["thick,114,held", "1.7,200,held", "0,114,4"] {
            assert_eq!(rows(of(row).as_bytes(), 100).expect_err("is refused").0, SourcePosition::Line(3), "{row}");
        }
        assert_eq!(rows(b"thickness_mm,folds\n", 100).expect_err("is refused").0, SourcePosition::Line(1));
    }
}
