//! CSV tables of drops: `trial,height_m,t_s,accel_g`, and `x`, `y`, `z` where all axes were measured.
//!
//! Rows of a trial may lie apart, but their time ascends. Trials may be numbered anew at each height.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use super::malformed::{Fault, Place};
use super::record::Record;

/// Columns that must be there.
const COLUMNS: [&str; 4] = ["trial", "height_m", "t_s", "accel_g"];
/// Columns that may be there.
const AXES: [&str; 3] = ["x", "y", "z"];
/// Drop heights, m.
const HEIGHTS_M: RangeInclusive<f64> = 0.01..=100.0;
/// Times, s.
const TIMES_S: RangeInclusive<f64> = -1e7..=1e7;
/// Accelerations, g.
const ACCELS_G: RangeInclusive<f64> = -1e5..=1e5;
/// From here on a reading stands at the end of the converter's +-230 g, g: a few counts below it.
const FULL_SCALE_G: f64 = 229.5;

type Refused = (Place, Fault);

/// Where the columns stand.
struct Header {
    columns: [usize; 4],
    axes: [Option<usize>; 3],
    others: Vec<String>,
}

impl Header {
    fn of(names: &csv::ByteRecord) -> Result<Self, Fault> {
        let names: Vec<String> = names.iter().map(|name| String::from_utf8_lossy(name).trim().to_string()).collect();
        let place = |wanted: &str| names.iter().position(|name| name == wanted);
        let known = || COLUMNS.iter().chain(&AXES);
        if let Some(twice) = known().find(|known| names.iter().filter(|name| name == *known).count() > 1) {
            return Err(Fault::TwoColumns { name: (*twice).into() });
        }
        let missing: Vec<String> = COLUMNS.iter().filter(|column| place(column).is_none()).map(|column| (*column).into()).collect();
        let columns = match COLUMNS.map(place) {
            [Some(trial), Some(height), Some(time), Some(accel)] => [trial, height, time, accel],
            _ => return Err(Fault::NoColumn { missing, known: "trial,height_m,t_s,accel_g, and x,y,z if they are there" }),
        };
        let others = names.iter().filter(|name| known().all(|known| known != name)).cloned().collect();
        Ok(Self { columns, axes: AXES.map(place), others })
    }
}

/// A number of a row.
pub(super) fn number(
    row: &csv::ByteRecord,
    at: usize,
    column: &'static str,
    bounds: &RangeInclusive<f64>,
    unit: &'static str,
) -> Result<f64, Fault> {
    let field = row.get(at).unwrap_or_default().trim_ascii();
    let parsed = std::str::from_utf8(field).ok().and_then(|text| text.parse::<f64>().ok()).filter(|value| value.is_finite());
    let Some(value) = parsed else {
        let value = String::from_utf8_lossy(&field[..field.len().min(40)]).into_owned();
        return Err(Fault::NoNumber { column, value });
    };
    if !bounds.contains(&value) {
        return Err(Fault::OutOfBounds { column, value, min: *bounds.start(), max: *bounds.end(), unit });
    }
    Ok(value)
}

/// Records in the making.
struct Builder<'a> {
    source: &'a str,
    frame: Option<&'a str>,
    header: Header,
    records: Vec<Record>,
    /// By trial and bits of the height.
    places: BTreeMap<(Vec<u8>, u64), usize>,
    /// The row before: its trial and height as they stand in the file, and its record.
    before: Option<(Vec<u8>, Vec<u8>, usize)>,
}

impl Builder<'_> {
    fn row(&mut self, row: &csv::ByteRecord) -> Result<(), Fault> {
        let [_, _, time, accel] = self.header.columns;
        let t_s = number(row, time, "t_s", &TIMES_S, "s")?;
        let accel_g = number(row, accel, "accel_g", &ACCELS_G, "g")?;
        let mut axes = [None, None, None];
        for ((value, at), column) in axes.iter_mut().zip(self.header.axes).zip(AXES) {
            if let Some(at) = at {
                *value = Some(number(row, at, column, &ACCELS_G, "g")?);
            }
        }
        let at = self.place(row, t_s)?;
        let record = &mut self.records[at];
        if let Some(before_s) = record.t_s.last().copied().filter(|before_s| *before_s >= t_s) {
            return Err(Fault::Unsorted { trial: record.trial.clone(), before_s, t_s });
        }
        record.t_s.push(t_s);
        record.accel_g.push(accel_g);
        record.at_full_scale += usize::from(accel_g.abs() >= FULL_SCALE_G);
        if let ([Some(x), Some(y), z], Some(magnitude_g)) = (axes, &mut record.magnitude_g) {
            let z = z.unwrap_or(accel_g);
            magnitude_g.push((x * x + y * y + z * z).sqrt());
        }
        Ok(())
    }

    /// The record that a row belongs to.
    fn place(&mut self, row: &csv::ByteRecord, t_s: f64) -> Result<usize, Fault> {
        let [trial, height] = [0, 1].map(|column| row.get(self.header.columns[column]).unwrap_or_default().trim_ascii());
        let before = self.before.as_ref();
        if let Some((_, _, at)) = before.filter(|(of, from, _)| of == trial && from == height) {
            return Ok(*at);
        }
        if trial.is_empty() {
            return Err(Fault::NoTrial);
        }
        let height_m = number(row, self.header.columns[1], "height_m", &HEIGHTS_M, "m")?;
        if let Some((_, _, at)) = before.filter(|(of, ..)| of == trial) {
            let record = &self.records[*at];
            let goes_on = record.t_s.last().is_some_and(|last_s| t_s > *last_s);
            if goes_on && record.height_m != height_m {
                return Err(Fault::MixedHeights { trial: record.trial.clone(), before_m: record.height_m, height_m });
            }
        }
        let at = *self.places.entry((trial.to_vec(), height_m.to_bits())).or_insert(self.records.len());
        if at == self.records.len() {
            self.records.push(Record {
                trial: String::from_utf8_lossy(trial).into_owned(),
                height_m,
                frame: self.frame.map(String::from),
                source: self.source.to_string(),
                t_s: Vec::new(),
                accel_g: Vec::new(),
                magnitude_g: matches!(self.header.axes, [Some(_), Some(_), _]).then(Vec::new),
                at_full_scale: 0,
            });
        }
        self.before = Some((trial.to_vec(), height.to_vec(), at));
        Ok(at)
    }

    /// A trial whose heights follow each other in time is one drop with two heights, not two drops with one number.
    fn one_height_each(&self) -> Result<(), Fault> {
        let mut last: Option<(&[u8], &Record)> = None;
        for ((trial, _), at) in &self.places {
            let record = &self.records[*at];
            if let Some((_, other)) = last.filter(|(of, _)| of == trial) {
                let ends = |record: &Record| Some((*record.t_s.first()?, *record.t_s.last()?));
                if let (Some((a, b)), Some((c, d))) = (ends(other), ends(record))
                    && (b < c || d < a)
                {
                    let (before_m, height_m) = (other.height_m, record.height_m);
                    return Err(Fault::MixedHeights { trial: record.trial.clone(), before_m, height_m });
                }
            }
            last = Some((trial, record));
        }
        Ok(())
    }
}

/// Reads a table: its records, and the names of the columns that were left aside.
pub(super) fn records(bytes: &[u8], source: &str, frame: Option<&str>) -> Result<(Vec<Record>, Vec<String>), Refused> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.trim_ascii().is_empty() {
        return Err((Place::Whole, Fault::Empty));
    }
    let mut reader = csv::ReaderBuilder::new().buffer_capacity(1 << 16).from_reader(bytes);
    let header = Header::of(reader.byte_headers().map_err(|error| refused(&error))?).map_err(|fault| (Place::Line(1), fault))?;
    let mut builder = Builder { source, frame, header, records: Vec::new(), places: BTreeMap::new(), before: None };
    let mut row = csv::ByteRecord::new();
    while reader.read_byte_record(&mut row).map_err(|error| refused(&error))? {
        let line = row.position().map_or(0, csv::Position::line);
        builder.row(&row).map_err(|fault| (Place::Line(line), fault))?;
    }
    if builder.records.is_empty() {
        return Err((Place::Whole, Fault::Empty));
    }
    builder.one_height_each().map_err(|fault| (Place::Whole, fault))?;
    Ok((builder.records, builder.header.others))
}

pub(super) fn refused(error: &csv::Error) -> Refused {
    let place = error.position().map_or(Place::Whole, |position| Place::Line(position.line()));
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => (place, Fault::Fields { found: *len, expected: *expected_len }),
        _ => (place, Fault::Unreadable { why: error.to_string() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(Vec<Record>, Vec<String>), Refused> {
        records(text.as_bytes(), "a.csv", None)
    }

    #[test]
    fn analytic_columns_stand_in_any_order() {
        let (records, others) =
            read("t_s,y,accel_g,x,trial,height_m,mood\r\n0,3,12,4,a,0.5,good\r\n0.001,0,-1,0,a,0.5,bad\r\n").expect("reads");
        assert_eq!((records.len(), others), (1, vec!["mood".to_string()]));
        assert_eq!((records[0].accel_g.clone(), records[0].magnitude_g.clone()), (vec![12.0, -1.0], Some(vec![13.0, 1.0])));
    }

    #[test]
    fn analytic_trials_may_be_numbered_anew_at_each_height_and_lie_apart() {
        let head = "trial,height_m,t_s,accel_g\n";
        let (records, _) = read(&format!("{head}1,0.5,0,0\n1,0.5,1,0\n1,1,0,0\n1,1,1,0\n")).expect("reads");
        assert_eq!(records.iter().map(|record| (record.height_m, record.len())).collect::<Vec<_>>(), [(0.5, 2), (1.0, 2)]);
        let (records, _) = read(&format!("{head}1,0.5,0,0\n2,0.5,0,0\n1,0.5,1,0\n2,0.50,1,0\n")).expect("reads");
        assert_eq!(records.iter().map(Record::len).collect::<Vec<_>>(), [2, 2]);
    }

    #[test]
    fn planted_faults_are_named_with_their_line() {
        let head = "trial,height_m,t_s,accel_g\n";
        let cases = [
            ("", Place::Whole, "is empty"),
            (head, Place::Whole, "is empty"),
            ("trial;height_m;t_s;accel_g\n1;2;3;4\n", Place::Line(1), "lacks the columns `trial`, `height_m`, `t_s`, `accel_g`"),
            ("trial,height_m,t_s\n1,2,3\n", Place::Line(1), "lacks the column `accel_g`"),
            ("trial,trial,height_m,t_s,accel_g\n1,1,2,3,4\n", Place::Line(1), "twice"),
            (&format!("{head}1,0.5,0,0\n1,0.5,0.001\n"), Place::Line(3), "has 3 fields, the header has 4"),
            (&format!("{head}1,0.5,0,nan\n"), Place::Line(2), "`accel_g` is `nan`, no number"),
            (&format!("{head}1,0.5,0,\n"), Place::Line(2), "`accel_g` is ``, no number"),
            (&format!("{head}1,0.5,0,1e9\n"), Place::Line(2), "`accel_g` = 1000000000 is out of bounds"),
            (&format!("{head}1,-0.5,0,1\n"), Place::Line(2), "`height_m` = -0.5 is out of bounds: 0.01 to 100 m"),
            (&format!("{head},0.5,0,1\n"), Place::Line(2), "`trial` is empty"),
            (&format!("{head}1,0.5,1,0\n1,0.5,0,0\n"), Place::Line(3), "time does not ascend in trial `1`: 0 s after 1 s"),
            (&format!("{head}1,0.5,1,0\n1,0.5,1,0\n"), Place::Line(3), "time does not ascend"),
            (&format!("{head}1,0.5,0,0\n1,1.0,1,0\n"), Place::Line(3), "trial `1` has two heights: 0.5 m and 1 m"),
            (&format!("{head}1,0.5,0,0\n2,0.5,0,0\n1,1,1,0\n"), Place::Whole, "has two heights"),
            ("PK\u{3}\u{4}\0\0\0", Place::Line(1), "lacks the columns"),
        ];
        for (text, place, says) in cases {
            let (at, fault) = read(text).expect_err("is refused");
            assert_eq!(at, place, "{text}: {fault}");
            assert!(fault.to_string().contains(says), "{text}: {fault}");
        }
    }
}
