//! Why a file is no record: which, where, what, and the remedy.

use std::fmt;
use std::io::ErrorKind;

/// Where in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourcePosition {
    /// The file as a whole.
    Whole,
    /// A line of a table, from 1.
    Line(u64),
    /// A sample of a logger's file, from 1.
    Sample(usize),
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The system does not give it.
    #[error("cannot be read: {why}")]
    Unreadable {
        /// What the system says.
        why: String,
        /// The kind of that.
        kind: ErrorKind,
    },
    /// Neither file nor folder, or an ending that no reader takes.
    #[error("is {what}")]
    Foreign {
        /// What it is.
        what: String,
    },
    /// A folder without records.
    #[error("holds no record{}", besides(*others))]
    NoRecords {
        /// Files that are none.
        others: usize,
    },
    /// Nothing in it.
    #[error("is empty")]
    Empty,
    /// A table with nothing but the names of its columns.
    #[error("has no row below its header")]
    NoRows,
    /// Text of another encoding.
    #[error("is {encoding} text")]
    Encoding {
        /// Its name.
        encoding: &'static str,
    },
    /// Too large for what it should be.
    #[error("has {bytes} bytes, more than the {most} of any record")]
    Huge {
        /// Its size.
        bytes: u64,
        /// What is read.
        most: u64,
    },
    /// A sample cut short.
    #[error("ends in the middle of a sample: {bytes} bytes are no multiple of 10")]
    Truncated {
        /// Its size.
        bytes: usize,
    },
    /// More counts than the converter has.
    #[error("`{axis}` is {count} counts, more than the converter's {most}")]
    Counts {
        /// Axis.
        axis: char,
        /// Value.
        count: u16,
        /// Largest.
        most: u16,
    },
    /// A folder that does not say the height.
    #[error("lies in the folder `{folder}`, whose name does not say the height")]
    NoHeight {
        /// The folder.
        folder: String,
    },
    /// Columns that a table must have.
    #[error("lacks the column{} {}; it has {}", if .missing.len() == 1 { "" } else { "s" }, .missing.join(", "), columns(.found))]
    NoColumn {
        /// Each as it is to be read: `trial`, or `accel_g` or `z`.
        missing: Vec<String>,
        /// What the first line has in their place.
        found: Vec<String>,
        /// Every column that such a table can have, in words.
        known: &'static str,
    },
    /// A column that is there twice.
    #[error("has the column `{name}` twice")]
    TwoColumns {
        /// Its name.
        name: String,
    },
    /// A row of another length than the header.
    #[error("has {found} fields, the header has {expected}")]
    Fields {
        /// In the row.
        found: u64,
        /// In the header.
        expected: u64,
    },
    /// Not a number.
    #[error("`{column}` is `{value}`, no number")]
    NoNumber {
        /// Column.
        column: &'static str,
        /// What stands there.
        value: String,
    },
    /// A number of things that has a fraction.
    #[error("`{column}` is `{}`, no whole number", written(*.value))]
    NotWhole {
        /// Column.
        column: &'static str,
        /// What stands there.
        value: f64,
    },
    /// Neither a number of folds nor the word for none that cracked.
    #[error("`folds` is `{value}`, neither a number from 1 to {most} nor `held`")]
    NoFolds {
        /// What stands there.
        value: String,
        /// How often a hinge was to be folded.
        most: u32,
    },
    /// A number that cannot be.
    #[error("`{column}` = {} is out of bounds: {min} to {max} {unit}", written(*.value))]
    OutOfBounds {
        /// Column.
        column: &'static str,
        /// What stands there.
        value: f64,
        /// Least.
        min: f64,
        /// Most.
        max: f64,
        /// Unit.
        unit: &'static str,
    },
    /// A static test in which nothing was pressed.
    #[error("`displacement_mm` is 0 in every row")]
    NotPressed,
    /// No trial.
    #[error("`trial` is empty")]
    NoTrial,
    /// Time that stands still or goes back.
    #[error("time does not ascend in trial `{trial}`: {t_s} s after {before_s} s")]
    Unsorted {
        /// Trial.
        trial: String,
        /// Before.
        before_s: f64,
        /// Here.
        t_s: f64,
    },
    /// A trial with two heights.
    #[error("trial `{trial}` has two heights: {before_m} m and {height_m} m")]
    MixedHeights {
        /// Trial.
        trial: String,
        /// Before.
        before_m: f64,
        /// Here.
        height_m: f64,
    },
    /// A quantity of a drop that changes within it.
    #[error("`{column}` is not the same in all rows of trial `{trial}`")]
    Varies {
        /// Column.
        column: String,
        /// Trial.
        trial: String,
    },
    /// A row about a drop that another row is about, too.
    #[error("has a second row of trial `{trial}`")]
    TwoRows {
        /// Trial.
        trial: String,
    },
}

/// Names of columns that a message lists at most, and letters of each.
const LISTED: usize = 12;
const LETTERS: usize = 40;
/// What 32 bits of microseconds count to, s, and how much less a step over their end takes off at the most.
const WRAP_S: f64 = 4_294.967_296;
const WRAP_STEP_S: f64 = 0.1;

/// Names of columns, the first of them, as far as a message has room.
fn columns(names: &[String]) -> String {
    let shortened = |name: &String| format!("`{}`", name.chars().filter(|letter| !letter.is_control()).take(LETTERS).collect::<String>());
    let listed: Vec<String> = names.iter().take(LISTED).map(shortened).collect();
    let more = names.len().saturating_sub(LISTED);
    let others = if more == 0 { String::new() } else { format!(" and {more} more") };
    format!("{}{others}", listed.join(", "))
}

/// Whether time jumps back by what 32 bits of microseconds count to.
fn is_wrap(before_s: f64, t_s: f64) -> bool {
    (WRAP_S - WRAP_STEP_S..=WRAP_S).contains(&(before_s - t_s))
}

/// Numbers from here on are written as powers of ten.
const LONG: f64 = 1e15;

/// A number as it is read best.
fn written(value: f64) -> String {
    if value.abs() < LONG { value.to_string() } else { format!("{value:e}") }
}

/// What a folder without records has, as a clause.
fn besides(others: usize) -> String {
    match others {
        0 => ", and no other file".into(),
        1 => ": one other file".into(),
        _ => format!(": {others} other files"),
    }
}

impl Fault {
    /// What to do.
    pub fn remedy(&self) -> String {
        match self {
            Self::Unreadable { .. } => "name files and folders that are there and may be read".into(),
            Self::Foreign { .. } | Self::NoRecords { .. } => {
                "give .tsv or .csv tables, .bin or .bhn files of the logger, or folders of them".into()
            }
            Self::Encoding { .. } => "save it as UTF-8; spreadsheets call this CSV UTF-8".into(),
            Self::Empty => "leave it out, or copy it again from the logger".into(),
            Self::NoRows => "leave it out, or write its rows below the line that names the columns".into(),
            Self::Huge { .. } => "split it: a drop of 2 s at 1 kHz has 20 000 bytes".into(),
            Self::Truncated { .. } => "copy it again from the logger, or leave it out".into(),
            Self::Counts { .. } => {
                "a logger's file holds u32 t_us, u16 x, u16 y, u16 z, little-endian, 12 bits each axis: is it one?".into()
            }
            Self::NoHeight { .. } => "name the folder FRAME_HEIGHTcm, as in soft_050cm".into(),
            Self::NoColumn { known, .. } => {
                format!("the first line names the columns, with nothing above it, parted by commas, semicolons or tabs: {known}")
            }
            Self::TwoColumns { .. } => "leave one of them".into(),
            Self::Fields { .. } => "give each row as many values as there are columns; is the file cut short?".into(),
            Self::NoNumber { column: "mass_g" | "quantity", .. } => "give a number with a decimal point, a mass in grams and a whole quantity".into(),
            Self::NotWhole { .. } => "give the number of parts that lay on the scale together".into(),
            Self::NoNumber { column: "t_s" | "accel_g" | "x" | "y" | "z", .. } => {
                "give a finite number with a decimal point; leave a drop that lost a reading out as a whole".into()
            }
            Self::NoNumber { .. } => "give a finite number with a decimal point, or leave the row out".into(),
            Self::NoFolds { most, .. } => format!("write after how many folds it cracked, or `held` where it held {most}"),
            Self::OutOfBounds { column: "height_m", .. } => "look at the unit: --units cm or --units mm reads other heights than m".into(),
            Self::OutOfBounds { column: "accel_g" | "x" | "y" | "z", .. } => {
                "look at the unit: --units mg, m/s2 or N/g reads other readings than g, the last one counts, N of them a g".into()
            }
            Self::OutOfBounds { .. } => "look at the unit".into(),
            Self::NotPressed => "give the displacement under at least one force".into(),
            Self::NoTrial => "give each drop a name or a number".into(),
            Self::Unsorted { before_s, t_s, .. } if t_s == before_s => {
                "where a table's stamps are rounded, give its sampling rate in their place: --rate HZ; where a row stands there twice, delete one \
                 of the two: --rate would shift what follows; two drops need two names"
                    .into()
            }
            Self::Unsorted { before_s, t_s, .. } if is_wrap(*before_s, *t_s) => {
                "the counter wrapped: 32 bits of microseconds end there. Add 4294.967296 s to the stamps that follow, or give the sampling rate in \
                 their place: --rate HZ"
                    .into()
            }
            Self::Unsorted { .. } => {
                "where stamps jitter, give the sampling rate in their place: --rate HZ; where rows are mixed up, sort those of each trial by t_s; \
                 two drops need two names"
                    .into()
            }
            Self::Varies { .. } => "a covariate is one value a drop: give it in a table of its own, a row a drop".into(),
            Self::TwoRows { .. } => "give each drop one row; where trials are numbered anew at each height, add height_m".into(),
            Self::MixedHeights { .. } => "give each drop a name of its own, and one height".into(),
        }
    }
}

/// A file that is no record.
#[derive(Clone, Debug, PartialEq)]
pub struct Malformed {
    /// Which.
    pub file: String,
    /// Where.
    pub place: SourcePosition,
    /// What.
    pub fault: Fault,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, place, fault } = self;
        match place {
            SourcePosition::Whole => write!(f, "{file} {fault}"),
            SourcePosition::Line(line) => write!(f, "{file}, line {line}: {fault}"),
            SourcePosition::Sample(sample) => write!(f, "{file}, sample {sample}: {fault}"),
        }
    }
}

impl std::error::Error for Malformed {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_step_back_in_time_is_told_by_its_size() {
        let remedy = |before_s: f64, t_s: f64| Fault::Unsorted { trial: "1".into(), before_s, t_s }.remedy();
        assert!(remedy(4294.967, 0.001).starts_with("the counter wrapped"));
        assert!(remedy(0.5, 0.0).contains("sort those of each trial") && remedy(4294.0, 10.0).contains("sort those of each trial"));
        assert!(remedy(0.5, 0.5).contains("--rate HZ") && remedy(0.5, 0.5).contains("delete one of the two"));
    }

    #[test]
    fn analytic_a_message_lists_what_a_table_has() {
        let of = |found: Vec<String>| Fault::NoColumn { missing: vec!["`t_s`".into()], found, known: "" }.to_string();
        assert_eq!(of(vec!["Drop".into(), "Zeit\n[ms]".into()]), "lacks the column `t_s`; it has `Drop`, `Zeit[ms]`");
        assert!(of((0..40).map(|at| at.to_string()).collect()).ends_with("`11` and 28 more"));
    }
}
