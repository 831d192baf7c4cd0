//! A static test: a CSV table of displacement and force, `displacement_mm,force_n`; other columns are left aside.

use std::ops::RangeInclusive;
use std::path::Path;

use super::malformed::{Fault, Malformed, SourcePosition};
use super::reading::malformed;
use super::sheet::{self, Columns};
use super::table::number;

const COLUMNS: Columns<2> = Columns { needed: ["displacement_mm", "force_n"], optional: None, known: "displacement_mm,force_n" };
/// Displacements, mm, and forces, N, that can be.
const BOUNDS: [RangeInclusive<f64>; 2] = [0.0..=200.0, 0.0..=1e5];
/// Units of the columns.
const UNITS: [&str; 2] = ["mm", "N"];

/// Displacement, mm, and force, N, of each row of a table.
///
/// # Errors
/// When it cannot be read, lacks a column, or a row is no pair of numbers.
#[cfg(feature = "cli")]
pub fn read_static_test(path: &Path) -> Result<Vec<[f64; 2]>, Malformed> {
    points(&path.display().to_string(), &super::disk::bytes_of(path, super::sheet::MOST_BYTES)?)
}

fn points(name: &str, bytes: &[u8]) -> Result<Vec<[f64; 2]>, Malformed> {
    rows(bytes).map_err(|(place, fault)| malformed(Path::new(name), place, fault))
}

fn rows(bytes: &[u8]) -> Result<Vec<[f64; 2]>, (SourcePosition, Fault)> {
    let points = sheet::rows(bytes, &COLUMNS, |row, _, (places, _)| {
        let mut point = [0.0; 2];
        for (at, column) in places.into_iter().enumerate() {
            point[at] = number(row, column, COLUMNS.needed[at], &BOUNDS[at], UNITS[at])?;
        }
        Ok(point)
    })?;
    if points.iter().any(|[displacement_mm, _]| *displacement_mm > 0.0) {
        Ok(points)
    } else {
        Err((SourcePosition::Whole, Fault::NotPressed))
    }
}

/// Points of a static test.
#[derive(Clone, Debug, PartialEq)]
pub struct StaticTest {
    /// Compression of the frame, m, and force, N.
    pub points: Vec<(f64, f64)>,
}

impl StaticTest {
    /// Reads a file as [`read_static_test`] does.
    ///
    /// # Errors
    /// [`Malformed`] with the line.
    #[cfg(feature = "cli")]
    pub fn read(path: &Path) -> Result<Self, Malformed> {
        Ok(Self::of(read_static_test(path)?))
    }

    /// The same from the bytes of a file of this name.
    ///
    /// # Errors
    /// [`Malformed`] with the line.
    pub fn read_bytes(name: &str, bytes: &[u8]) -> Result<Self, Malformed> {
        Ok(Self::of(points(name, bytes)?))
    }

    /// From displacements, mm, and forces, N.
    fn of(points: Vec<[f64; 2]>) -> Self {
        Self { points: points.into_iter().map(|[x_mm, force_n]| (1e-3 * x_mm, force_n)).collect() }
    }

    /// Root of the mean square by which a force of loading is off, N. A frame that is not pressed yet bears any force up to that with which it
    /// begins to move, so that a point without displacement is off by what is beyond that.
    pub fn off_n(&self, force_n: impl Fn(f64) -> f64) -> f64 {
        let off_n = |(x_m, measured_n): &(f64, f64)| match (force_n(*x_m), *x_m > 0.0) {
            (expected_n, true) => measured_n - expected_n,
            (first_n, false) => measured_n - measured_n.clamp(0.0, first_n.max(0.0)),
        };
        let sum: f64 = self.points.iter().map(|point| off_n(point).powi(2)).sum();
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
    fn analytic_a_frame_at_rest_bears_any_force_below_its_friction() {
        let test = |at_rest_n: f64| StaticTest { points: vec![(0.0, at_rest_n), (0.01, 70.0)] };
        let rubs = |x_m: f64| 20.0 + 5e3 * x_m;
        for (at_rest_n, off_n) in [(0.0, 0.0), (20.0, 0.0), (24.0, 4.0)] {
            assert!((test(at_rest_n).off_n(rubs) - off_n * 0.5_f64.sqrt()).abs() < 1e-9, "{at_rest_n}");
        }
    }

    #[test]
    fn analytic_columns_stand_in_any_order_and_remarks_are_skipped() {
        let found = rows(b"# by hand\nforce_n,who,displacement_mm\n20,me,1\n33,me,3.5\n").expect("reads");
        assert_eq!(found, [[1.0, 20.0], [3.5, 33.0]]);
    }

    #[test]
    fn analytic_a_line_is_found_with_what_it_leaves() {
        let test = StaticTest { points: vec![(1e-3, 7.0), (2e-3, 14.0), (4e-3, 28.0)] };
        let (stiffness_n_m, off_n) = test.line_through_origin();
        assert!((stiffness_n_m - 7000.0).abs() < 1e-9 && off_n < 1e-9);
        assert!((test.off_n(|x_m| 7000.0 * x_m + 1.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn planted_faults_are_named_with_their_line() {
        for (text, place, says) in [
            ("displacement_mm\n1\n", SourcePosition::Line(1), "lacks the column `force_n`"),
            ("displacement_mm,force_n\n1,x\n", SourcePosition::Line(2), "`force_n` is `x`"),
            ("displacement_mm,force_n\n-1,2\n", SourcePosition::Line(2), "out of bounds"),
            ("displacement_mm,force_n\n", SourcePosition::Whole, "has no row below its header"),
            ("displacement_mm,force_n\n0,0\n", SourcePosition::Whole, "is 0 in every row"),
        ] {
            let (at, fault) = rows(text.as_bytes()).expect_err("is refused");
            assert!(at == place && fault.to_string().contains(says), "{text}: {at:?} {fault}");
        }
    }
}
