//! A static test: the force at which a frame stands when it is pressed slowly, `displacement_mm,force_n`.

use std::fs;
use std::ops::RangeInclusive;
use std::path::Path;

use super::malformed::{Fault, Malformed, Place};
use super::table::number;

/// Compressions, mm.
const DISPLACEMENTS_MM: RangeInclusive<f64> = 0.0..=1000.0;
/// Forces, N.
const FORCES_N: RangeInclusive<f64> = -1e4..=1e5;
/// Columns.
const COLUMNS: [&str; 2] = ["displacement_mm", "force_n"];
/// Fewest points: with them a line has a scatter.
const FEWEST: usize = 3;

/// Points of a static test.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticTest {
    /// Compression of the frame, m, and force, N.
    pub points: Vec<(f64, f64)>,
}

impl StaticTest {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Malformed`] with the line.
    pub fn read(path: &Path) -> Result<Self, Malformed> {
        let file = path.display().to_string();
        let refused = |why: String| Malformed { file: file.clone(), place: Place::Whole, fault: Fault::Unreadable { why } };
        let bytes = fs::read(path).map_err(|error| refused(error.to_string()))?;
        let text = std::str::from_utf8(&bytes).map_err(|error| refused(error.to_string()))?;
        Self::parse(text, &file)
    }

    /// Reads a CSV table.
    ///
    /// # Errors
    /// [`Malformed`] with the line.
    pub fn parse(text: &str, file: &str) -> Result<Self, Malformed> {
        let refused = |place: Place, fault: Fault| Malformed { file: file.into(), place, fault };
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
        let unreadable = |error: &csv::Error| {
            let place = error.position().map_or(Place::Whole, |position| Place::Line(position.line()));
            refused(place, Fault::Unreadable { why: error.to_string() })
        };
        let header = reader.byte_headers().map_err(|error| unreadable(&error))?.clone();
        let place = |wanted: &str| header.iter().position(|name| name == wanted.as_bytes());
        let [Some(displacement), Some(force)] = COLUMNS.map(place) else {
            let missing = COLUMNS.iter().filter(|column| place(column).is_none()).map(|column| (*column).into()).collect();
            return Err(refused(Place::Line(1), Fault::NoColumn { missing }));
        };
        let mut points = Vec::new();
        for row in reader.byte_records() {
            let row = row.map_err(|error| unreadable(&error))?;
            let at = |fault: Fault| refused(Place::Line(row.position().map_or(0, csv::Position::line)), fault);
            let x_mm = number(&row, displacement, COLUMNS[0], &DISPLACEMENTS_MM, "mm").map_err(at)?;
            points.push((1e-3 * x_mm, number(&row, force, COLUMNS[1], &FORCES_N, "N").map_err(at)?));
        }
        if points.len() < FEWEST {
            return Err(refused(Place::Whole, Fault::FewPoints { found: points.len(), fewest: FEWEST }));
        }
        Ok(Self { points })
    }

    /// Root of the mean square by which a force is off, N.
    pub fn off_n(&self, force_n: impl Fn(f64) -> f64) -> f64 {
        let sum: f64 = self.points.iter().map(|(x_m, measured_n)| (measured_n - force_n(*x_m)).powi(2)).sum();
        (sum / self.points.len() as f64).sqrt()
    }

    /// Stiffness of the straight line through the origin, N/m, with its rms, N.
    pub fn line_through_origin(&self) -> (f64, f64) {
        let sums = self.points.iter().fold((0.0, 0.0), |sums, (x_m, force_n)| (sums.0 + x_m * force_n, sums.1 + x_m * x_m));
        let stiffness_n_m = if sums.1 > 0.0 { sums.0 / sums.1 } else { 0.0 };
        (stiffness_n_m, self.off_n(|x_m| stiffness_n_m * x_m))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_line_is_found_with_what_it_leaves() {
        let test = StaticTest::parse("displacement_mm,force_n\n# a comment\n1, 7\n2,14\n 4,28\n", "a.csv").expect("reads");
        let (stiffness_n_m, off_n) = test.line_through_origin();
        assert!((stiffness_n_m - 7000.0).abs() < 1e-9 && off_n < 1e-9);
        assert!((test.off_n(|x_m| 7000.0 * x_m + 1.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn planted_faults_are_named_with_their_line() {
        let cases = [
            ("displacement_mm\n1\n", "line 1: lacks the column `force_n`"),
            ("displacement_mm,force_n\n1,2\nx,3\n", "line 3: `displacement_mm` is `x`, no number"),
            ("displacement_mm,force_n\n1,2\n-1,3\n", "line 3: `displacement_mm` = -1 is out of bounds: 0 to 1000 mm"),
            ("displacement_mm,force_n\n1,2\n1,2\n", "has 2 points, at least 3"),
            ("displacement_mm,force_n\n1,2,3\n", "line 2: cannot be read"),
            ("", "lacks the columns"),
        ];
        for (text, says) in cases {
            let refused = StaticTest::parse(text, "a.csv").expect_err("is refused").to_string();
            assert!(refused.contains(says), "{text}: {refused}");
        }
    }
}
