//! How a table of drops is written, where it is not as this program writes it: names of columns, units, rate.

use std::ops::RangeInclusive;

/// What a column of a table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Name of the drop.
    Trial,
    /// Name of the session.
    Session,
    /// Stated drop height.
    Height,
    /// Speed at first touch, in place of the height.
    Speed,
    /// Time.
    Time,
    /// Acceleration along the frame's axis; the sensor's z where there is no other.
    Axial,
    /// Acceleration along the sensor's x.
    X,
    /// Along y.
    Y,
    /// Along z.
    Z,
}

impl Quantity {
    /// Each with its key on the command line and its column's own name.
    pub const ALL: [(Self, &'static str, &'static str); 9] = [
        (Self::Trial, "trial", "trial"),
        (Self::Session, "session", "session"),
        (Self::Height, "h", "height_m"),
        (Self::Speed, "v", "speed_m_s"),
        (Self::Time, "t", "t_s"),
        (Self::Axial, "a", "accel_g"),
        (Self::X, "x", "x"),
        (Self::Y, "y", "y"),
        (Self::Z, "z", "z"),
    ];

    /// Its column's own name.
    pub fn column(self) -> &'static str {
        Self::ALL.iter().find(|(quantity, ..)| *quantity == self).map_or("", |(.., column)| column)
    }
}

/// A column under another name.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// What it holds.
    pub quantity: Quantity,
    /// Its name in the file.
    pub name: String,
    /// Whether its sign is to be changed.
    pub negated: bool,
}

/// Why an option does not say how a table is written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FormatError {
    /// Not KEY=NAME.
    #[error("--columns `{given}`: give KEY=NAME with one of the keys {}, as in t=Time,z=-Acc_Z", keys())]
    Column {
        /// What was given.
        given: String,
    },
    /// No unit.
    #[error("--units `{given}`: give one of g, mg, m/s2, or N/g for readings in counts, N of them a g; s, ms, us; m, cm, mm")]
    Unit {
        /// What was given.
        given: String,
    },
    /// So many counts a g that no sensor has them.
    #[error(
        "--units `{given}`: the counts of a g are a number from {} to {}, as in 2048/g; --columns a=-NAME changes a sign",
        COUNTS_PER_G.start(),
        COUNTS_PER_G.end()
    )]
    Counts {
        /// What was given.
        given: String,
    },
    /// Twice the same quantity, or two units of one.
    #[error("--{option}: {first} and {second} are both given, and say the same thing twice: leave one of them out")]
    Twice {
        /// Which option.
        option: &'static str,
        /// The one.
        first: String,
        /// The other.
        second: String,
    },
    /// Not one number, nor three.
    #[error("--zero takes one number, along the axis, or three, for x, y and z: as in 0.4,-0.3,2")]
    Zero,
    /// No rate.
    #[error("--rate {given}: give samples a second, 1 to 1000000")]
    Rate {
        /// What was given.
        given: f64,
    },
}

fn keys() -> String {
    Quantity::ALL.map(|(_, key, _)| key).join(", ")
}

/// How a table is written.
#[derive(Clone, Debug, PartialEq)]
pub struct TableFormat {
    /// Columns whose names are not this program's.
    pub columns: Vec<Column>,
    /// Seconds in a unit of time.
    pub time_s: f64,
    /// g in a unit of acceleration.
    pub accel_g: f64,
    /// Metres in a unit of height.
    pub height_m: f64,
    /// Readings of x, y and z in free fall, g, which are taken off; the third is that of the frame's axis, too.
    pub zero_g: [f64; 3],
    /// Samples a second; the stamps are left aside.
    pub rate_hz: Option<f64>,
    /// Further columns whose values are kept with each drop, where a table has them.
    pub kept: Vec<String>,
}

impl Default for TableFormat {
    fn default() -> Self {
        Self { columns: Vec::new(), time_s: 1.0, accel_g: 1.0, height_m: 1.0, zero_g: [0.0; 3], rate_hz: None, kept: Vec::new() }
    }
}

/// What a column says: speed at first touch and height say the same.
fn quantity_of(quantity: Quantity) -> &'static str {
    if quantity == Quantity::Speed { Quantity::Height.column() } else { quantity.column() }
}

/// What a known unit is of: what is neither a time nor a height is an acceleration.
fn dimension_of(unit: &str) -> &'static str {
    match unit.trim() {
        "s" | "ms" | "us" | "µs" => "time",
        "m" | "cm" | "mm" => "height",
        _ => "acceleration",
    }
}

/// Refuses two that say the same, by what each of them is of.
fn twice(option: &'static str, given: &[String], of: &[&str]) -> Result<(), FormatError> {
    let again = (0..of.len()).find_map(|at| Some((of[..at].iter().position(|before| *before == of[at])?, at)));
    match again {
        Some((first, second)) => Err(FormatError::Twice { option, first: given[first].clone(), second: given[second].clone() }),
        None => Ok(()),
    }
}

/// Counts of a sensor for one g: from those of a range of thousands of g to those of 24 bits for one g.
const COUNTS_PER_G: RangeInclusive<f64> = 1e-2..=1e7;

/// N of the unit N/g.
fn counts_per_g(unit: &str) -> Result<f64, FormatError> {
    let counts = unit.strip_suffix("/g").ok_or_else(|| FormatError::Unit { given: unit.into() })?;
    let per_g = counts.trim().parse::<f64>().ok().filter(|per_g| COUNTS_PER_G.contains(per_g));
    per_g.ok_or_else(|| FormatError::Counts { given: unit.into() })
}

/// Metres a second squared in one g, by definition.
const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

impl TableFormat {
    /// From what an option each says: `t=Time`, `z=-Acc_Z`; `m/s2`, `ms`; samples a second. What stands between two commas and has no `=` is
    /// a part of the name before it.
    ///
    /// # Errors
    /// [`FormatError`] with the first that cannot be.
    pub fn new(columns: &[String], units: &[String], rate_hz: Option<f64>) -> Result<Self, FormatError> {
        let columns = with_commas(columns);
        let mut format = Self { columns: columns.iter().map(|given| column(given)).collect::<Result<_, _>>()?, ..Self::default() };
        twice("columns", &columns, &format.columns.iter().map(|column| quantity_of(column.quantity)).collect::<Vec<_>>())?;
        for unit in units {
            match unit.trim() {
                "g" => format.accel_g = 1.0,
                "mg" => format.accel_g = 1e-3,
                "m/s2" | "m/s^2" | "m/s²" => format.accel_g = 1.0 / STANDARD_GRAVITY_M_S2,
                "s" => format.time_s = 1.0,
                "ms" => format.time_s = 1e-3,
                "us" | "µs" => format.time_s = 1e-6,
                "m" => format.height_m = 1.0,
                "cm" => format.height_m = 1e-2,
                "mm" => format.height_m = 1e-3,
                other => format.accel_g = 1.0 / counts_per_g(other)?,
            }
        }
        twice("units", units, &units.iter().map(|unit| dimension_of(unit)).collect::<Vec<_>>())?;
        if let Some(given) = rate_hz.filter(|rate_hz| !(1.0..=1e6).contains(rate_hz)) {
            return Err(FormatError::Rate { given });
        }
        format.rate_hz = rate_hz;
        Ok(format)
    }

    /// The same with what the sensor reads in free fall, g: along the axis, or x, y and z; nothing changes it.
    ///
    /// # Errors
    /// [`FormatError::Zero`] with another count of numbers.
    pub fn zeroed(self, zero_g: &[f64]) -> Result<Self, FormatError> {
        let zero_g = match *zero_g {
            [] => [0.0; 3],
            [along] => [0.0, 0.0, along],
            [x, y, z] => [x, y, z],
            _ => return Err(FormatError::Zero),
        };
        Ok(Self { zero_g, ..self })
    }

    /// The name of a quantity's column, and whether its sign is to be changed.
    pub(super) fn name(&self, quantity: Quantity) -> (&str, bool) {
        let other = self.columns.iter().find(|column| column.quantity == quantity);
        other.map_or((quantity.column(), false), |column| (column.name.as_str(), column.negated))
    }
}

/// Columns that were given between commas, of which one may be in a name: what is no KEY=NAME goes on with the name before it.
fn with_commas(given: &[String]) -> Vec<String> {
    let mut whole: Vec<String> = Vec::new();
    for part in given {
        match whole.last_mut().filter(|_| !part.contains('=')) {
            Some(before) => *before = format!("{before},{part}"),
            None => whole.push(part.clone()),
        }
    }
    whole
}

fn column(given: &str) -> Result<Column, FormatError> {
    let refused = || FormatError::Column { given: given.into() };
    let (key, name) = given.split_once('=').ok_or_else(refused)?;
    let (quantity, ..) = Quantity::ALL.into_iter().find(|(_, known, _)| *known == key.trim()).ok_or_else(refused)?;
    let (name, negated) = name.trim().strip_prefix('-').map_or((name.trim(), false), |name| (name, true));
    if name.is_empty() { Err(refused()) } else { Ok(Column { quantity, name: name.into(), negated }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_options_say_how_a_table_is_written() {
        let strings = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
        let format = TableFormat::new(&strings(&["t=Time", "z=-Acc Z"]), &strings(&["m/s2", "ms"]), Some(3200.0)).expect("is one");
        assert_eq!((format.name(Quantity::Time), format.name(Quantity::Z)), (("Time", false), ("Acc Z", true)));
        assert_eq!((format.name(Quantity::Trial), format.time_s, format.rate_hz), (("trial", false), 1e-3, Some(3200.0)));
        assert!((format.accel_g * 9.806_65 - 1.0).abs() < 1e-15);
        let parts = TableFormat::new(&strings(&["z=-Acc", " z (g)", "t=Time"]), &[], None).expect("is one");
        assert_eq!((parts.name(Quantity::Z), parts.name(Quantity::Time)), (("Acc, z (g)", true), ("Time", false)));
        assert_eq!(format.clone().zeroed(&[2.0]).expect("is one").zero_g, [0.0, 0.0, 2.0]);
        assert_eq!(format.zeroed(&[1.0, 2.0]), Err(FormatError::Zero));
        let counts = |unit: &str| TableFormat::new(&[], &strings(&[unit]), None).map(|format| format.accel_g);
        assert_eq!([counts("2048/g"), counts("20.5 /g")], [Ok(1.0 / 2048.0), Ok(1.0 / 20.5)]);
        for unit in ["0/g", "-2048/g", "nan/g", "inf/g", "/g", "1e9/g"] {
            assert_eq!(counts(unit), Err(FormatError::Counts { given: unit.into() }));
        }
        assert!(
            TableFormat::new(&[], &strings(&["2048/g", "mg"]), None).is_err_and(|error| error.to_string().contains("the same thing twice"))
        );
        for (columns, units, rate) in
            [(&["q=Time"][..], &[][..], None), (&["t="], &[], None), (&["t"], &[], None), (&[], &["ft"], None), (&[], &[], Some(0.0))]
        {
            assert!(TableFormat::new(&strings(columns), &strings(units), rate).is_err(), "{columns:?} {units:?}");
        }
    }
}
