//! What parts weigh on a scale: a CSV table `part,mass_g`, and `quantity` where several were weighed at once.

use std::ops::RangeInclusive;
use std::path::Path;

use super::malformed::{Fault, Malformed, SourcePosition};
use super::reading::malformed;
use super::sheet::{self, Columns};
use super::table::number;

/// Column that may be there.
const QUANTITY: &str = "quantity";
const COLUMNS: Columns<2> =
    Columns { needed: ["part", "mass_g"], optional: Some(QUANTITY), known: "part,mass_g, and quantity if several lay on the scale" };
/// Masses that a reading can be, g.
const MASSES_G: RangeInclusive<f64> = 0.01..=1e4;
/// Parts that can lie on a scale.
const QUANTITIES: RangeInclusive<f64> = 1.0..=1000.0;

/// A reading.
#[derive(Clone, Debug, PartialEq)]
pub struct ScaleReading {
    /// Line of the file, from 1.
    pub line: u64,
    /// What lay on the scale, as it is written there.
    pub part: String,
    /// How many of them.
    pub quantity: u32,
    /// Mass of all, g.
    pub mass_g: f64,
    /// The last digit that was written, g: what the scale resolves.
    pub resolution_g: f64,
}

/// Reads a table of scale readings; a part may stand there more than once.
///
/// # Errors
/// When it cannot be read, lacks a column, or a row is no reading.
#[cfg(feature = "cli")]
pub fn read_scale(path: &Path) -> Result<Vec<ScaleReading>, Malformed> {
    scale_readings(&path.display().to_string(), &super::disk::bytes_of(path, super::sheet::MOST_BYTES)?)
}

/// The same from the bytes of a file of this name.
///
/// # Errors
/// When it lacks a column, or a row is no reading.
pub fn scale_readings(name: &str, bytes: &[u8]) -> Result<Vec<ScaleReading>, Malformed> {
    rows(bytes).map_err(|(place, fault)| malformed(Path::new(name), place, fault))
}

fn rows(bytes: &[u8]) -> Result<Vec<ScaleReading>, (SourcePosition, Fault)> {
    sheet::rows(bytes, &COLUMNS, |row, line, ([part, mass], quantity)| reading(row, line, part, mass, quantity))
}

fn reading(row: &csv::ByteRecord, line: u64, part: usize, mass: usize, quantity: Option<usize>) -> Result<ScaleReading, Fault> {
    let mass_g = number(row, mass, "mass_g", &MASSES_G, "g")?;
    let quantity = match quantity.filter(|at| row.get(*at).is_some_and(|field| !field.trim_ascii().is_empty())) {
        Some(at) => number(row, at, QUANTITY, &QUANTITIES, "parts")?,
        None => 1.0,
    };
    if quantity.fract() != 0.0 {
        return Err(Fault::NotWhole { column: QUANTITY, value: quantity });
    }
    let part = String::from_utf8_lossy(row.get(part).unwrap_or_default().trim_ascii()).into_owned();
    Ok(ScaleReading { line, part, quantity: quantity as u32, mass_g, resolution_g: last_digit(row.get(mass).unwrap_or_default()) })
}

/// Value of the last digit of a number: 0.1 of `12.3` and `12,3`, 1 of `12`, 0.01 of `1.23`, 10 of `1.2e2`.
fn last_digit(field: &[u8]) -> f64 {
    let text = String::from_utf8_lossy(field).trim().to_ascii_lowercase().replacen(',', ".", 1);
    let (digits, power) = text.split_once('e').map_or((text.as_str(), 0), |(digits, power)| (digits, power.parse().unwrap_or(0)));
    let behind = digits.split_once('.').map_or(0, |(_, behind)| behind.len() as i32);
    10f64.powi(power - behind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_half_a_part_is_refused_with_its_number() {
        let refused = scale_readings("scale.csv", b"part,mass_g,quantity\nhub,12.3,1.5\n").expect_err("is no number of parts").to_string();
        assert!(refused.contains("`quantity` is `1.5`, no whole number") && refused.contains("line 2"), "{refused}");
    }

    #[test]
    fn analytic_readings_as_a_person_writes_them() {
        let text = "# kitchen scale\nquantity, mass_g ,note,part\n4,12.30,red,foot\n,7,,hub\n1,1.2e1,,knee\n";
        let readings = rows(text.as_bytes()).expect("reads");
        let told: Vec<(u64, &str, u32, f64, f64)> =
            readings.iter().map(|r| (r.line, r.part.as_str(), r.quantity, r.mass_g, r.resolution_g)).collect();
        assert_eq!(told, [(3, "foot", 4, 12.3, 0.01), (4, "hub", 1, 7.0, 1.0), (5, "knee", 1, 12.0, 1.0)]);
        // With decimal commas, in quotes or between semicolons.
        for text in ["part,mass_g\nhub,\"7,25\"\n", "# scale, kitchen\npart;mass_g\nhub;7,25\n"] {
            let reading = &rows(text.as_bytes()).expect("reads")[0];
            assert_eq!((reading.mass_g, reading.resolution_g), (7.25, 0.01), "{text}");
        }
    }

    #[test]
    fn analytic_what_is_no_reading_is_refused_with_its_line() {
        for (text, line) in [
            ("part,grams\nhub,7\n", SourcePosition::Line(1)),
            ("part,mass_g\nhub,7\nhub,0\n", SourcePosition::Line(3)),
            ("part,mass_g\nhub,seven\n", SourcePosition::Line(2)),
            ("part,mass_g,quantity\nhub,7,1.5\n", SourcePosition::Line(2)),
            ("part,mass_g\nhub,7,4\n", SourcePosition::Line(2)),
            ("part,mass_g\n", SourcePosition::Whole),
        ] {
            assert_eq!(rows(text.as_bytes()).expect_err("is refused").0, line, "{text}");
        }
    }
}
