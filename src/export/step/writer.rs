//! The exchange structure of ISO 10303-21: numbered entities between a header and an end.

use std::collections::BTreeMap;
use std::fmt::{Display, Write};

use nalgebra::{Point3, Vector3};

/// Number of an entity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Id(usize);

impl Display for Id {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// A file while it grows.
pub(super) struct Writer {
    text: String,
    last: usize,
    directions: BTreeMap<[i64; 3], Id>,
}

/// Decimals of a length in mm, and of a direction.
const LENGTH_DECIMALS: u32 = 8;
const DIRECTION_DECIMALS: u32 = 12;

/// Decimals of a surface's or a curve's place and radius in mm: where two circles touch, a billionth of a millimetre more lets them cross a hundred
/// thousand times as far beside, and OCCT then read a border that crosses itself.
const PLACE_DECIMALS: u32 = 12;

/// Of all files: the same input gives the same bytes.
const TIME_STAMP: &str = "1970-01-01T00:00:00";

impl Writer {
    /// A file with its header. `schema` is AP214, whose colours and assemblies nearly every program reads.
    pub(super) fn new(name: &str, description: &str) -> Self {
        let system = format!("flexframe {}", env!("CARGO_PKG_VERSION"));
        let text = format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(({}),'2;1');\nFILE_NAME({},'{TIME_STAMP}',(''),(''),'{system}','{system}','');\n\
             FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n",
            string(description),
            string(name),
        );
        Self { text, last: 0, directions: BTreeMap::new() }
    }

    /// The whole file.
    pub(super) fn finish(mut self) -> Vec<u8> {
        self.text.push_str("ENDSEC;\nEND-ISO-10303-21;\n");
        self.text.into_bytes()
    }

    /// Adds an entity by what stands behind its number.
    pub(super) fn add(&mut self, entity: impl Display) -> Id {
        self.last += 1;
        // Writing into a string does not fail.
        let _ = writeln!(self.text, "#{}={entity};", self.last);
        Id(self.last)
    }

    /// A point, mm.
    pub(super) fn point(&mut self, p: &Point3<f64>) -> Id {
        self.point_of([p.x, p.y, p.z].map(length))
    }

    fn point_of(&mut self, [x, y, z]: [Decimal; 3]) -> Id {
        self.add(format_args!("CARTESIAN_POINT('',({x},{y},{z}))"))
    }

    /// A unit vector; the same is written once.
    pub(super) fn direction(&mut self, v: &Vector3<f64>) -> Id {
        let key = [v.x, v.y, v.z].map(|value| scaled(value, DIRECTION_DECIMALS));
        if let Some(id) = self.directions.get(&key) {
            return *id;
        }
        let [x, y, z] = key.map(|value| Decimal { value, decimals: DIRECTION_DECIMALS });
        let id = self.add(format_args!("DIRECTION('',({x},{y},{z}))"));
        self.directions.insert(key, id);
        id
    }

    /// A place with its z and x axes.
    pub(super) fn placement(&mut self, at: &Point3<f64>, z: &Vector3<f64>, x: &Vector3<f64>) -> Id {
        let (at, z, x) = (self.point_of([at.x, at.y, at.z].map(radius)), self.direction(z), self.direction(x));
        self.add(format_args!("AXIS2_PLACEMENT_3D('',{at},{z},{x})"))
    }
}

/// A number with a fixed number of decimals at most.
#[derive(Clone, Copy)]
pub(super) struct Decimal {
    value: i64,
    decimals: u32,
}

impl Display for Decimal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let one = 10_u64.pow(self.decimals);
        let size = self.value.unsigned_abs();
        let (whole, mut rest, mut width) = (size / one, size % one, self.decimals as usize);
        let sign = if self.value < 0 { "-" } else { "" };
        if rest == 0 {
            return write!(f, "{sign}{whole}.");
        }
        while rest % 10 == 0 {
            (rest, width) = (rest / 10, width - 1);
        }
        write!(f, "{sign}{whole}.{rest:0width$}")
    }
}

/// A length, mm, as STEP writes it: always with a point.
pub(super) fn length(value_mm: f64) -> Decimal {
    Decimal { value: scaled(value_mm, LENGTH_DECIMALS), decimals: LENGTH_DECIMALS }
}

/// A radius or a coordinate of a place, mm.
pub(super) fn radius(value_mm: f64) -> Decimal {
    Decimal { value: scaled(value_mm, PLACE_DECIMALS), decimals: PLACE_DECIMALS }
}

/// An angle, rad.
pub(super) fn angle(value_rad: f64) -> Decimal {
    Decimal { value: scaled(value_rad, DIRECTION_DECIMALS), decimals: DIRECTION_DECIMALS }
}

fn scaled(value: f64, decimals: u32) -> i64 {
    (value * 10_f64.powi(decimals as i32)).round() as i64
}

/// Numbers in a row, `(#1,#2)`.
pub(super) fn list(ids: &[Id]) -> String {
    let mut text = String::with_capacity(8 * ids.len() + 2);
    text.push('(');
    for (at, id) in ids.iter().enumerate() {
        let _ = write!(text, "{}{id}", if at == 0 { "" } else { "," });
    }
    text.push(')');
    text
}

/// Text between quotes: other characters than those of ISO 646 by their numbers (ISO 10303-21, 6.4.3).
pub(super) fn string(text: &str) -> String {
    let mut quoted = String::from("'");
    for character in text.chars() {
        match character {
            '\'' => quoted.push_str("''"),
            '\\' => quoted.push_str("\\\\"),
            ' '..='~' => quoted.push(character),
            _ if u32::from(character) <= 0xFFFF => {
                let _ = write!(quoted, "\\X2\\{:04X}\\X0\\", u32::from(character));
            }
            _ => {
                let _ = write!(quoted, "\\X4\\{:08X}\\X0\\", u32::from(character));
            }
        }
    }
    quoted.push('\'');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_numbers_have_a_point_and_no_idle_zeros() {
        for (value, text) in [(0.0, "0."), (-0.0, "0."), (1.5, "1.5"), (-12.0, "-12."), (0.000_000_01, "0.00000001"), (-1e-9, "0.")] {
            assert_eq!(length(value).to_string(), text);
        }
    }

    #[test]
    fn analytic_text_outside_iso_646_is_numbered() {
        assert_eq!(string("a'b\\ü"), "'a''b\\\\\\X2\\00FC\\X0\\'");
        assert_eq!(string("\n\u{1F681}"), "'\\X2\\000A\\X0\\\\X4\\0001F681\\X0\\'");
    }
}
