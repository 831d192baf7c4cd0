//! CSV tables of drops: `trial,height_m,t_s,accel_g`, and `x`, `y`, `z` where all axes were measured.
//!
//! Columns are parted by commas, semicolons or tabs; with the last two, numbers may have decimal commas. A [`TableFormat`] says
//! which names and units a logger uses instead. Rows of a trial may lie apart, but their time ascends. Trials may be numbered anew
//! at each height. A file in a folder such as `soft_050cm` needs no columns of trial and height.

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::ops::RangeInclusive;

use super::decimal::decimal;
use super::encoding::plain;
use super::height::stated_m;
use super::logger::Calibration;
use super::logger::Label;
use super::malformed::{Fault, SourcePosition};
use super::record::Record;
use super::row_lines::RowLines;
use super::spread::Spread;
use super::table_format::TableFormat;
use super::table_header::{Header, separator};
use crate::units::GRAVITY_M_S2;

/// Drop heights, m.
pub(super) const HEIGHTS_M: RangeInclusive<f64> = 0.01..=100.0;
/// Speeds at first touch, m/s.
const SPEEDS_M_S: RangeInclusive<f64> = 0.4..=45.0;
/// Heights computed from speeds are different if they differ by this, m.
const HEIGHT_STEP_M: f64 = 1e-4;
/// Times, s; those of the clock count from 1970.
const TIMES_S: RangeInclusive<f64> = -1e10..=1e10;
/// Accelerations, g.
const ACCELS_G: RangeInclusive<f64> = -1e5..=1e5;
/// Readings at the end of a converter of +-230 g, g: a few counts around it.
const FULL_SCALE_G: RangeInclusive<f64> = 229.5..=231.0;
/// How near a reading is to an end of the paper's logger that stands at it, g: a count is 0.11 g.
const AT_END_G: f64 = 0.15;

type Refused = (SourcePosition, Fault);

/// Whether a reading of an axis stands at an end of the paper's logger, whichever way the axis is counted, or of a converter of +-230 g.
fn is_at_end(reading_g: f64, ends_g: &[f64; 2]) -> bool {
    let size_g = reading_g.abs();
    FULL_SCALE_G.contains(&size_g) || ends_g.iter().any(|end_g| (size_g - end_g.abs()).abs() <= AT_END_G)
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
    let text = std::str::from_utf8(field).ok();
    // Where commas part the columns, only a quoted field has a decimal one.
    let Some(value) = text.and_then(decimal) else {
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
    /// What the file's own place says.
    label: Option<&'a Label>,
    format: &'a TableFormat,
    header: Header,
    records: Vec<Record>,
    /// What the time stamps of a record, by its place, say where a sampling rate is given instead.
    stamps: BTreeMap<usize, Stamps>,
    /// What the ends of the paper's logger read, g.
    ends_g: [[f64; 2]; 3],
    /// Whether the sensor reads more than these.
    reads_beyond: bool,
    /// By trial and bits of the height.
    places: BTreeMap<(Vec<u8>, u64), usize>,
    /// The row before: its trial and height as they stand in the file, and its record.
    before: Option<(Vec<u8>, Vec<u8>, usize)>,
}

/// First and last time stamp of a record, s, and how many there are.
#[derive(Clone, Copy)]
struct Stamps {
    first_s: f64,
    last_s: f64,
    count: usize,
}

impl Stamps {
    /// Samples a second by a record's length, Hz; none of stamps that do not ascend.
    fn rate_hz(&self) -> Option<f64> {
        let lasts_s = self.last_s - self.first_s;
        (lasts_s > 0.0).then(|| (self.count - 1) as f64 / lasts_s)
    }
}

/// What a table holds beside its records.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Aside {
    /// Names of columns that were left aside.
    pub columns: Vec<String>,
    /// Sampling rate by the time stamps, Hz, where one was given instead of them: the median of the records.
    pub stamped_hz: Option<f64>,
    /// Whether heights are those of measured speeds, no two of which are the same.
    pub has_speeds: bool,
    /// Whether a reading lies beyond the ends of the paper's logger.
    pub reads_beyond: bool,
}

impl Builder<'_> {
    fn row(&mut self, row: &csv::ByteRecord) -> Result<(), Fault> {
        let accel = |(at, sign): (usize, f64), column: &'static str| scaled(row, at, column, &ACCELS_G, "g", sign * self.format.accel_g);
        let accel_g = accel(self.header.axial, "accel_g")?;
        let mut axes = [None, None, None];
        for ((value, place), column) in axes.iter_mut().zip(self.header.axes).zip(["x", "y", "z"]) {
            *value = place.map(|place| accel(place, column)).transpose()?;
        }
        let stamp_s = self.header.time.map(|at| scaled(row, at, "t_s", &TIMES_S, "s", self.format.time_s)).transpose()?;
        let at = self.place(row, stamp_s)?;
        self.keep_stamp(row, at);
        let record = &mut self.records[at];
        let differs = self.header.kept.iter().find(|(name, column)| record.columns.get(name).is_some_and(|of| *of != text(row, *column)));
        if let Some((name, _)) = differs {
            return Err(Fault::Varies { column: name.clone(), trial: record.trial.clone() });
        }
        let t_s = stamp_s.unwrap_or(record.len() as f64 / self.format.rate_hz.unwrap_or(1.0));
        if let Some(before_s) = record.t_s.last().copied().filter(|before_s| *before_s >= t_s) {
            return Err(Fault::Unsorted { trial: record.trial.clone(), before_s, t_s });
        }
        record.t_s.push(t_s);
        let zero_g = self.format.zero_g;
        let [x_g, y_g] = [axes[0], axes[1]].map(|reading| reading.unwrap_or(0.0));
        if [x_g, y_g, accel_g].iter().zip(&self.ends_g).any(|(reading_g, ends_g)| is_at_end(*reading_g, ends_g)) {
            record.at_full_scale.push(record.accel_g.len());
        }
        let is_beyond = |(reading_g, [low_g, high_g]): (&f64, &[f64; 2])| reading_g.abs() > low_g.abs().max(*high_g) + AT_END_G;
        self.reads_beyond |= [x_g, y_g, accel_g].iter().zip(&self.ends_g).any(is_beyond);
        record.accel_g.push(accel_g - zero_g[2]);
        if let ([Some(x), Some(y), z], Some(all)) = (axes, &mut record.axes_g) {
            for ((axis, value), zero_g) in all.iter_mut().zip([x, y, z.unwrap_or(accel_g)]).zip(zero_g) {
                axis.push(value - zero_g);
            }
        }
        Ok(())
    }

    /// Keeps a time stamp that is not used; what is no number says nothing.
    fn keep_stamp(&mut self, row: &csv::ByteRecord, record: usize) {
        let Some(last_s) = self.header.unused_time.and_then(|at| scaled(row, at, "t_s", &TIMES_S, "s", self.format.time_s).ok()) else {
            return;
        };
        let stamps = self.stamps.entry(record).or_insert(Stamps { first_s: last_s, last_s, count: 0 });
        *stamps = Stamps { last_s, count: stamps.count + 1, ..*stamps };
    }

    /// The record that a row belongs to.
    fn place(&mut self, row: &csv::ByteRecord, t_s: Option<f64>) -> Result<usize, Fault> {
        let field = |column: Option<usize>| column.and_then(|column| row.get(column)).unwrap_or_default().trim_ascii();
        let (trial, height) = (field(self.header.trial), field(self.header.height.or(self.header.speed)));
        let before = self.before.as_ref();
        if let Some((_, _, at)) = before.filter(|(of, from, _)| of == trial && from == height) {
            return Ok(*at);
        }
        if trial.is_empty() && self.header.trial.is_some() {
            return Err(Fault::NoTrial);
        }
        let height_m = self.height_m(row)?;
        if let Some((_, _, at)) = before.filter(|(of, ..)| of == trial) {
            let record = &self.records[*at];
            let goes_on = t_s.is_some_and(|t_s| record.t_s.last().is_some_and(|last_s| t_s > *last_s));
            if goes_on && record.height_m != height_m {
                return Err(Fault::MixedHeights { trial: record.trial.clone(), before_m: record.height_m, height_m });
            }
        }
        let at = *self.places.entry((trial.to_vec(), height_m.to_bits())).or_insert(self.records.len());
        if at == self.records.len() {
            let session = self.header.session.map(|column| String::from_utf8_lossy(field(Some(column))).into_owned());
            let named = self.header.trial.map(|_| String::from_utf8_lossy(trial).into_owned());
            self.records.push(Record {
                trial: named.or_else(|| self.label.map(|label| label.trial.clone())).unwrap_or_default(),
                height_m,
                frame: self.label.and_then(|label| label.frame.clone()),
                session: session.filter(|session| !session.is_empty()),
                source: self.source.to_string(),
                t_s: Vec::new(),
                accel_g: Vec::new(),
                axes_g: matches!(self.header.axes, [Some(_), Some(_), _]).then(<[Vec<f64>; 3]>::default),
                columns: self.header.kept.iter().map(|(name, column)| (name.clone(), text(row, *column))).collect(),
                at_full_scale: Vec::new(),
            });
        }
        self.before = Some((trial.to_vec(), height.to_vec(), at));
        Ok(at)
    }

    /// The height of a row: stated, that of its speed, or that of the file's folder.
    fn height_m(&self, row: &csv::ByteRecord) -> Result<f64, Fault> {
        let Header { height, speed, .. } = self.header;
        match (height, speed, self.label) {
            (Some(at), ..) => scaled(row, at, "height_m", &HEIGHTS_M, "m", self.format.height_m).map(stated_m),
            (None, Some(at), _) => {
                let v_m_s = number(row, at, "speed_m_s", &SPEEDS_M_S, "m/s")?;
                Ok((v_m_s * v_m_s / (2.0 * GRAVITY_M_S2) / HEIGHT_STEP_M).round() * HEIGHT_STEP_M)
            }
            (None, None, label) => Ok(label.map_or(0.0, |label| label.height_m)),
        }
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

/// What stands in a field.
fn text(row: &csv::ByteRecord, at: usize) -> String {
    String::from_utf8_lossy(row.get(at).unwrap_or_default().trim_ascii()).into_owned()
}

/// A number in another unit.
fn scaled(
    row: &csv::ByteRecord,
    at: usize,
    column: &'static str,
    bounds: &RangeInclusive<f64>,
    unit: &'static str,
    factor: f64,
) -> Result<f64, Fault> {
    let value = factor * number(row, at, column, &(f64::MIN..=f64::MAX), unit)?;
    if bounds.contains(&value) {
        return Ok(value);
    }
    Err(Fault::OutOfBounds { column, value, min: *bounds.start(), max: *bounds.end(), unit })
}

/// Reads a table: its records, and what it holds beside them. A label says trial, frame and height where the table does not.
pub(super) fn records(bytes: &[u8], source: &str, label: Option<&Label>, format: &TableFormat) -> Result<(Vec<Record>, Aside), Refused> {
    let bytes = plain(bytes)?;
    if bytes.trim_ascii().is_empty() {
        return Err((SourcePosition::Whole, Fault::Empty));
    }
    let mut reader = csv::ReaderBuilder::new().delimiter(separator(bytes)).buffer_capacity(1 << 16).from_reader(bytes);
    let names = reader.byte_headers().map_err(|error| refused(&error, RowLines::of(bytes, false)))?;
    let header = Header::of(names, format, label.is_some()).map_err(|fault| (SourcePosition::Line(1), fault))?;
    let mut builder = Builder {
        source,
        label,
        format,
        header,
        records: Vec::new(),
        stamps: BTreeMap::new(),
        ends_g: Calibration::default().ends_g(),
        reads_beyond: false,
        places: BTreeMap::new(),
        before: None,
    };
    let mut row = csv::ByteRecord::new();
    while reader.read_byte_record(&mut row).map_err(|error| refused(&error, RowLines::of(bytes, false)))? {
        builder.row(&row).map_err(|fault| (SourcePosition::Line(RowLines::of(bytes, false).at(row.position())), fault))?;
    }
    if builder.records.is_empty() {
        return Err((SourcePosition::Whole, Fault::NoRows));
    }
    builder.one_height_each().map_err(|fault| (SourcePosition::Whole, fault))?;
    let stamped_hz = Spread::of(builder.stamps.values().filter_map(Stamps::rate_hz)).map(|spread| spread.median);
    let has_speeds = builder.header.height.is_none() && builder.header.speed.is_some();
    let reads_beyond = builder.reads_beyond;
    Ok((builder.records, Aside { columns: builder.header.others, stamped_hz, has_speeds, reads_beyond }))
}

/// What the reader refuses, with its line among those of the table.
pub(super) fn refused(error: &csv::Error, mut lines: RowLines) -> Refused {
    let place = error.position().map_or(SourcePosition::Whole, |position| SourcePosition::Line(lines.at(Some(position))));
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => (place, Fault::Fields { found: *len, expected: *expected_len }),
        _ => (place, Fault::Unreadable { why: error.to_string(), kind: ErrorKind::InvalidData }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(Vec<Record>, Aside), Refused> {
        records(text.as_bytes(), "a.csv", None, &TableFormat::default())
    }

    #[test]
    fn analytic_columns_stand_in_any_order() {
        let (records, others) =
            read("t_s,y,accel_g,x,trial,height_m,mood\r\n0,3,12,4,a,0.5,good\r\n0.001,0,-1,0,a,0.5,bad\r\n").expect("reads");
        assert_eq!((records.len(), others.columns), (1, vec!["mood".to_string()]));
        assert_eq!((records[0].accel_g.clone(), [records[0].size_g(0), records[0].size_g(1)]), (vec![12.0, -1.0], [13.0, 1.0]));
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
    fn analytic_tables_of_other_loggers_are_read() {
        let strings = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
        let format = TableFormat::new(&strings(&["t=Zeit", "z=-Az", "v=v0"]), &strings(&["m/s2", "ms"]), None).expect("is one");
        let text = "trial;v0;Zeit;Az\n1;4,4294;0,5;-98,0665\n1;4,4294;1,5;9,80665\n";
        let (all, _) = records(text.as_bytes(), "a.csv", None, &format).expect("reads");
        assert!((all[0].height_m - 1.0).abs() < 2e-4, "{}", all[0].height_m);
        assert!(
            (all[0].accel_g[0] - 10.0).abs() < 1e-9 && (all[0].accel_g[1] + 1.0).abs() < 1e-9 && (all[0].t_s[1] - 0.0015).abs() < 1e-12
        );
        // What the sensor reads at 0 g is taken off after units and signs.
        let format = TableFormat { zero_g: [0.5, 0.0, -1.0], accel_g: 1e-3, ..TableFormat::default() };
        let text = "trial,height_m,t_s,accel_g,x,y,z\n1,1,0,2000,700,-300,4000\n";
        let (all, _) = records(text.as_bytes(), "a.csv", None, &format).expect("reads");
        let read = |at: usize| all[0].axes_g.as_ref().map(|axes| axes[at][0]);
        assert_eq!((all[0].accel_g[0], read(1), read(2)), (3.0, Some(-0.3), Some(5.0)));
        assert!((read(0).expect("was read") - 0.2).abs() < 1e-12);
        // One file a drop: the folder says frame and height, the rate says the time.
        let format = TableFormat { rate_hz: Some(2000.0), ..TableFormat::default() };
        let label = Label { trial: "7".into(), source: "7.csv".into(), frame: Some("soft".into()), height_m: 0.5 };
        let (all, others) = records(b"x\ty\tz\ttemperature\n3\t4\t0\t20\n0\t0\t1\t20\n", "7.csv", Some(&label), &format).expect("reads");
        assert_eq!((all[0].trial.as_str(), all[0].height_m, all[0].t_s.clone()), ("7", 0.5, vec![0.0, 0.0005]));
        assert_eq!((all[0].size_g(0), all[0].accel_g.clone(), others.columns), (5.0, vec![0.0, 1.0], vec!["temperature".to_string()]));
    }

    #[test]
    fn planted_readings_beyond_the_usual_converter_are_of_a_sensor_with_more_range() {
        let drop = |trial: u8, most: f64| format!("{trial},1,0,0\n{trial},1,0.001,{most}\n");
        let scale = |most: f64| {
            let head = "trial,height_m,t_s,accel_g\n";
            let found = |files: &[(String, Vec<u8>)]| {
                let set = super::super::read_bytes(files, &super::super::FileFormat::default()).expect("reads");
                set.records().map(|record| record.at_full_scale.len()).collect::<Vec<_>>()
            };
            let together = found(&[("a.csv".into(), format!("{head}{}{}", drop(1, 229.9), drop(2, most)).into_bytes())]);
            // A file a drop says the same.
            let apart =
                [(1, 229.9), (2, most)].map(|(trial, most)| (format!("{trial}.csv"), format!("{head}{}", drop(trial, most)).into_bytes()));
            assert_eq!(found(&apart), together);
            together
        };
        assert_eq!([scale(229.9), scale(345.0)], [[1, 1], [0, 0]]);
        // The paper's own logger: 4095 counts along its axis are 233.7 g, 0 counts are -227.6 g.
        assert_eq!([scale(233.66), scale(-227.64), scale(232.5)], [[1, 1], [1, 1], [1, 0]]);
    }

    /// As in its own files, where a lateral axis at the end is one, too.
    #[test]
    fn planted_an_end_of_a_lateral_axis_is_one() {
        let text = "trial,height_m,t_s,x,y,z\n1,1,0,0,0,0\n1,1,0.001,244.08,0,100\n2,1,0,0,0,0\n2,1,0.001,0,-237.6,100\n3,1,0,0,0,0\n3,1,0.001,225,0,0\n";
        let found = read(text).expect("reads").0.iter().map(|record| record.at_full_scale.len()).collect::<Vec<_>>();
        assert_eq!(found, [1, 1, 0]);
    }

    #[test]
    fn analytic_stamps_that_are_not_used_stay_with_their_record() {
        let format = TableFormat { rate_hz: Some(1000.0), ..TableFormat::default() };
        let text = "trial,height_m,t_s,accel_g\n1,1,no,0\n1,1,no,0\n2,1,0,0\n2,1,0.002,0\n2,1,0.004,0\n3,1,0,0\n3,1,0.002,0\n";
        let (_, aside) = records(text.as_bytes(), "a.csv", None, &format).expect("reads");
        assert_eq!(aside.stamped_hz, Some(500.0));
    }

    #[test]
    fn planted_names_that_columns_gives_are_those_that_lack() {
        let strings = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
        let format = TableFormat::new(&strings(&["h=Höhe", "z=Acc_Z"]), &[], None).expect("is one");
        let fault = |bytes: &[u8]| records(bytes, "a.csv", None, &format).expect_err("is refused").1.to_string();
        assert_eq!(fault("trial,t_s,Höhe,AccZ\n".as_bytes()), "lacks the column `Acc_Z`; it has `trial`, `t_s`, `Höhe`, `AccZ`");
        // The same names as Windows writes them in western Europe.
        assert_eq!(fault(b"trial,t_s,H\xf6he,Acc_Z\n1,0,0.5,0\n"), "is not UTF-8 text");
    }

    #[test]
    fn planted_a_column_that_is_named_and_not_there_is_told_though_it_may_be_missing() {
        let strings = |all: &[&str]| all.iter().map(ToString::to_string).collect::<Vec<_>>();
        let head = "trial,height_m,speed_m_s,t_s,accel_g,Acc_X\n1,0.5,4.429,0,0,1\n";
        let read = |columns: &[&str]| {
            let format = TableFormat::new(&strings(columns), &[], None).expect("is one");
            records(head.as_bytes(), "a.csv", None, &format).map_err(|(_, fault)| fault.to_string())
        };
        for (column, name) in [("x=AccX", "AccX"), ("session=day", "day"), ("v=velocity", "velocity")] {
            assert!(read(&[column]).expect_err("is refused").starts_with(&format!("lacks the column `{name}`; it has")), "{column}");
        }
        // Speeds that are named are used, and the heights beside them are not.
        let (all, aside) = read(&["v=speed_m_s"]).expect("reads");
        assert_eq!((all[0].height_m, aside.has_speeds, aside.columns), (0.9998, true, strings(&["height_m", "Acc_X"])));
        let (all, aside) = read(&[]).expect("reads");
        assert_eq!((all[0].height_m, aside.has_speeds), (0.5, false));
    }

    #[test]
    fn regress_a_comma_at_the_end_of_a_line_is_no_column() {
        let (_, aside) = read("trial,height_m,t_s,accel_g,\n1,0.5,0,0,\n").expect("reads");
        assert_eq!(aside.columns, Vec::<String>::new());
    }

    #[test]
    fn planted_faults_are_named_with_their_line() {
        let head = "trial,height_m,t_s,accel_g\n";
        let cases = [
            ("", SourcePosition::Whole, "is empty"),
            (head, SourcePosition::Whole, "has no row below its header"),
            (
                "trial:height_m:t_s:accel_g\n1:2:3:4\n",
                SourcePosition::Line(1),
                "lacks the columns `trial`, `height_m` or `speed_m_s`, `t_s`, `accel_g` or `z`; it has `trial:height_m:t_s:accel_g`",
            ),
            (
                "trial,height_m,t_s\n1,2,3\n",
                SourcePosition::Line(1),
                "lacks the column `accel_g` or `z`; it has `trial`, `height_m`, `t_s`",
            ),
            (&format!("# logger 7\n{head}1,0.5,0,0\n"), SourcePosition::Line(1), "it has `# logger 7`"),
            ("trial,trial,height_m,t_s,accel_g\n1,1,2,3,4\n", SourcePosition::Line(1), "twice"),
            (&format!("{head}1,0.5,0,0\n1,0.5,0.001\n"), SourcePosition::Line(3), "has 3 fields, the header has 4"),
            (&format!("{head}1,0.5,0,nan\n"), SourcePosition::Line(2), "`accel_g` is `nan`, no number"),
            (&format!("{head}1,0.5,0,\n"), SourcePosition::Line(2), "`accel_g` is ``, no number"),
            (&format!("{head}1,0.5,0,1e9\n"), SourcePosition::Line(2), "`accel_g` = 1000000000 is out of bounds"),
            (&format!("{head}1,0.5,0,1e300\n"), SourcePosition::Line(2), "`accel_g` = 1e300 is out of bounds"),
            (&format!("{head}1,-0.5,0,1\n"), SourcePosition::Line(2), "`height_m` = -0.5 is out of bounds: 0.01 to 100 m"),
            (&format!("{head},0.5,0,1\n"), SourcePosition::Line(2), "`trial` is empty"),
            (&format!("{head}1,0.5,1,0\n1,0.5,0,0\n"), SourcePosition::Line(3), "time does not ascend in trial `1`: 0 s after 1 s"),
            (&format!("{head}1,0.5,1,0\n1,0.5,1,0\n"), SourcePosition::Line(3), "time does not ascend"),
            (&format!("{head}1,0.5,0,0\n1,1.0,1,0\n"), SourcePosition::Line(3), "trial `1` has two heights: 0.5 m and 1 m"),
            (&format!("{head}1,0.5,0,0\n2,0.5,0,0\n1,1,1,0\n"), SourcePosition::Whole, "has two heights"),
            ("PK\u{3}\u{4}\0\0\0", SourcePosition::Line(1), "lacks the columns"),
        ];
        for (text, place, says) in cases {
            let (at, fault) = read(text).expect_err("is refused");
            assert_eq!(at, place, "{text}: {fault}");
            assert!(fault.to_string().contains(says), "{text}: {fault}");
        }
    }
}
