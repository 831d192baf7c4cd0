//! Files of drops, each a name and its bytes.

use std::collections::BTreeSet;
use std::path::Path;

use super::file_format::FileFormat;
use super::file_kind::FileKind;
use super::logger::{self, Label};
use super::malformed::{Fault, Malformed, SourcePosition};
use super::record::{DropSet, Record};
use super::speed_heights;
use super::stray_readings::{self, without_stray};
use super::symptom::symptoms_and_heights;
use super::table;

/// Share by which a sampling rate that is given and that of the time stamps are different.
const SAME_RATE: f64 = 0.03;

/// The kind of a file that has to be a record.
pub(super) fn known_kind(path: &Path) -> Result<FileKind, Malformed> {
    let foreign = || Fault::Foreign { what: "of no kind that is identified by its ending".into() };
    FileKind::of(path).ok_or_else(|| malformed(path, SourcePosition::Whole, foreign()))
}

pub(super) fn malformed(path: &Path, place: SourcePosition, fault: Fault) -> Malformed {
    Malformed { file: path.display().to_string(), place, fault }
}

/// Something that was left aside in a file.
pub(super) struct Remark {
    source: String,
    text: String,
}

/// What a file holds.
pub(super) struct Read {
    records: Vec<Record>,
    /// What was left aside in it.
    remarks: Vec<Remark>,
    /// Whether its heights are those of measured speeds.
    has_speeds: bool,
    /// Whether it is a table with a reading beyond the ends of the paper's logger: its sensor reads more, and an end is a reading as others.
    reads_beyond: bool,
}

/// Records of a file in a folder of this name; a logger's file has frame and height from the folder's name.
pub(super) fn records(
    path: &Path,
    kind: FileKind,
    folder: &str,
    format: &FileFormat,
    bytes: impl FnOnce() -> Result<Vec<u8>, Malformed>,
) -> Result<Read, Malformed> {
    let source = path.display().to_string();
    let refused = |(place, fault)| malformed(path, place, fault);
    let trial = path.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into_owned());
    let label = logger::frame_and_height(folder).map(|(frame, height_m)| Label { trial, source: source.clone(), frame, height_m });
    match kind {
        FileKind::Logger => {
            let no_height = || malformed(path, SourcePosition::Whole, Fault::NoHeight { folder: folder.into() });
            let record = logger::record(&bytes()?, label.ok_or_else(no_height)?, &format.calibration).map_err(refused)?;
            Ok(Read { records: vec![record.turned_back(format.turn)], remarks: Vec::new(), has_speeds: false, reads_beyond: false })
        }
        FileKind::Table => {
            let (records, aside) = table::records(&bytes()?, &source, label.as_ref(), &format.table).map_err(refused)?;
            let columns = (!aside.columns.is_empty()).then(|| format!("columns left aside: {}", aside.columns.join(", ")));
            let rates = aside.stamped_hz.zip(format.table.rate_hz).filter(|(stamped, given)| (stamped / given - 1.0).abs() > SAME_RATE);
            let rate = rates.map(|(stamped, given)| {
                let places = if stamped < 10.0 { 2 } else { 0 };
                format!("the time stamps say {stamped:.places$} Hz; --rate {given} is used instead of them")
            });
            let remark = |text: String| Remark { source: source.clone(), text };
            let records = records.into_iter().map(|record| record.turned_back(format.turn)).collect();
            let remarks = columns.into_iter().chain(rate).map(remark).collect();
            Ok(Read { records, remarks, has_speeds: aside.has_speeds, reads_beyond: aside.reads_beyond })
        }
    }
}

/// All records by frame and height, or the first refusal.
pub(super) fn gathered(all: Vec<Result<Read, Malformed>>) -> Result<DropSet, Malformed> {
    let (mut records, mut of_speeds, mut remarks) = (Vec::new(), Vec::new(), Vec::new());
    let mut beyond = BTreeSet::new();
    for read in all {
        let read = read?;
        if read.reads_beyond {
            beyond.extend(read.records.iter().map(|record| record.frame.clone()));
        }
        if read.has_speeds { &mut of_speeds } else { &mut records }.extend(read.records);
        remarks.extend(read.remarks);
    }
    // Of all files together: each may hold one drop.
    speed_heights::grouped(&mut of_speeds);
    records.extend(of_speeds);
    // As each may hold one drop, a frame's tables say together what its sensor reads.
    let is_of_table = |record: &Record| FileKind::of(Path::new(&record.source)) == Some(FileKind::Table);
    records
        .iter_mut()
        .filter(|record| beyond.contains(&record.frame) && is_of_table(record))
        .for_each(|record| record.at_full_scale.clear());
    let count = records.len();
    let stray: Vec<_> = records.iter_mut().filter_map(without_stray).collect();
    let mut set = DropSet::of(records, notes(&remarks));
    set.notes.extend(stray_readings::told(&stray, count));
    let shown = symptoms_and_heights(&set);
    set.notes.extend(shown);
    Ok(set)
}

/// A note for each remark; one for all files of which the same is said.
fn notes(remarks: &[Remark]) -> Vec<String> {
    let mut alike: Vec<(&Remark, usize)> = Vec::new();
    for remark in remarks {
        match alike.iter_mut().find(|(first, _)| first.text == remark.text) {
            Some((_, files)) => *files += 1,
            None => alike.push((remark, 1)),
        }
    }
    let note = |(Remark { source, text }, files): (&Remark, usize)| match files {
        1 => format!("{source}: {text}"),
        _ => format!("{files} files, {source} the first: {text}"),
    };
    alike.into_iter().map(note).collect()
}

/// Reads records from files' bytes, each with its path: the ending says what it is, and the last folder of a logger's file,
/// such as `soft_050cm`, frame and height. Nothing is opened.
///
/// # Errors
/// The first file that is no record.
pub fn read_bytes(files: &[(String, Vec<u8>)], format: &FileFormat) -> Result<DropSet, Malformed> {
    let read = |(name, bytes): &(String, Vec<u8>)| {
        let path = Path::new(name);
        let kind = known_kind(path)?;
        let (most, len) = (kind.most_bytes(), bytes.len() as u64);
        if len > most {
            return Err(malformed(path, SourcePosition::Whole, Fault::Huge { bytes: len, most }));
        }
        let folder = path.parent().and_then(Path::file_name).map_or(String::new(), |folder| folder.to_string_lossy().into_owned());
        records(path, kind, &folder, format, || Ok(bytes.clone()))
    };
    gathered(files.iter().map(read).collect())
}

#[cfg(test)]
mod tests {
    use super::super::TableFormat;
    use super::*;
    use crate::units::Angle;

    #[test]
    fn analytic_bytes_are_read_by_their_names() {
        let table = b"trial,height_m,t_s,accel_g\n1,0.5,0,0\n".to_vec();
        let sample = [0, 0, 0, 0, 0xe4, 7, 0xe4, 7, 0xe4, 7].to_vec();
        let files = [("a.CSV".to_string(), table), ("drops/soft_100cm/7.bin".to_string(), sample)];
        let set = read_bytes(&files, &FileFormat::default()).expect("reads");
        let told: Vec<(Option<&str>, f64, &str)> =
            set.groups.iter().map(|group| (group.frame.as_deref(), group.height_m, group.records[0].trial.as_str())).collect();
        assert_eq!(told, [(None, 0.5, "1"), (Some("soft"), 1.0, "7")]);
    }

    #[test]
    fn analytic_drops_are_in_the_order_of_their_names_however_they_are_given() {
        let file = |name: &str, trials: [u8; 2]| {
            let row = |trial: u8| format!("{trial},0.5,0,0\n{trial},0.5,0.001,0\n");
            (name.to_string(), format!("trial,height_m,t_s,accel_g\n{}{}", row(trials[0]), row(trials[1])).into_bytes())
        };
        let mut files = vec![file("d-10.csv", [22, 21]), file("d-9.csv", [3, 20])];
        let read = |files: &[(String, Vec<u8>)]| read_bytes(files, &FileFormat::default()).expect("reads");
        let set = read(&files);
        let trials: Vec<&str> = set.records().map(|record| record.trial.as_str()).collect();
        assert_eq!(trials, ["3", "20", "21", "22"]);
        files.reverse();
        assert_eq!(read(&files), set);
    }

    /// A drop a file, as some loggers write them.
    #[test]
    fn analytic_heights_of_speeds_are_those_of_all_files_together() {
        let file = |trial: usize, v_m_s: f64| {
            (format!("{trial}.csv"), format!("trial,speed_m_s,t_s,accel_g\n{trial},{v_m_s},0,0\n{trial},{v_m_s},0.001,0\n").into_bytes())
        };
        let files = [
            file(1, 3.12),
            file(2, 4.45),
            file(3, 3.15),
            file(4, 4.41),
            ("5.csv".into(), b"trial,height_m,t_s,accel_g\n5,0.5,0,0\n".to_vec()),
        ];
        let set = read_bytes(&files, &FileFormat::default()).expect("reads");
        let groups: Vec<(f64, usize)> = set.groups.iter().map(|group| (group.height_m, group.records.len())).collect();
        assert_eq!(groups, [(0.5, 1), (0.501, 2), (1.0, 2)]);
    }

    #[test]
    fn planted_a_sampling_rate_that_contradicts_the_time_stamps() {
        let rows: String = (0..50).map(|at| format!("1,0.5,{},0\n", f64::from(at) * 1e-3)).collect();
        let files = [("a.csv".to_string(), format!("trial,height_m,t_s,accel_g\n{rows}").into_bytes())];
        let notes = |rate_hz: f64| {
            let table = TableFormat::new(&[], &[], Some(rate_hz)).expect("is one");
            read_bytes(&files, &FileFormat { table, ..FileFormat::default() }).expect("reads").notes
        };
        assert_eq!(notes(500.0), ["a.csv: the time stamps say 1000 Hz; --rate 500 is used instead of them"]);
        assert_eq!(notes(1010.0), Vec::<String>::new());
    }

    /// A push from the front reads 10 g along the front, and a sensor whose x points to the left has it as -10 g along y.
    #[test]
    fn analytic_a_sensor_that_is_mounted_turned_is_turned_back() {
        let files = [("a.csv".to_string(), b"trial,height_m,t_s,x,y,z\n1,0.5,0,0,-10,3\n1,0.5,0.001,2,0,4\n".to_vec())];
        let axes = |degrees: f64| {
            let set = read_bytes(&files, &FileFormat { turn: Angle::deg(degrees), ..FileFormat::default() }).expect("reads");
            let axes = set.records().next().and_then(|record| record.axes_g.clone()).expect("all were measured");
            axes.map(|axis| axis.into_iter().map(|reading| (1e9 * reading).round() * 1e-9 + 0.0).collect::<Vec<f64>>())
        };
        assert_eq!(axes(0.0), [[0.0, 2.0], [-10.0, 0.0], [3.0, 4.0]]);
        assert_eq!(axes(90.0), [[10.0, 0.0], [0.0, 2.0], [3.0, 4.0]]);
        let [[x, _], [y, _]] = [axes(45.0)[0].clone(), axes(45.0)[1].clone()].map(|axis| <[f64; 2]>::try_from(axis).expect("two readings"));
        assert!((x - 50_f64.sqrt()).abs() < 1e-8 && (y + 50_f64.sqrt()).abs() < 1e-8, "{x} {y}");
    }

    #[test]
    fn regress_what_is_left_aside_in_many_files_is_one_note() {
        let file = |trial: usize, column: &str| {
            (format!("{trial}.csv"), format!("trial,height_m,t_s,accel_g,{column}\n{trial},0.5,0,0,20\n").into_bytes())
        };
        let files = [file(1, "celsius"), file(2, "volt"), file(3, "celsius"), file(4, "celsius")];
        let notes = read_bytes(&files, &FileFormat::default()).expect("reads").notes;
        assert_eq!(notes, ["3 files, 1.csv the first: columns left aside: celsius", "2.csv: columns left aside: volt"]);
    }

    #[test]
    fn planted_bytes_that_are_no_record_are_refused() {
        for (name, bytes, says) in [
            ("drops.txt", &b"1"[..], "of no kind"),
            ("a.csv", b"trial\n", "lacks the columns"),
            ("7.bin", b"0123456789", "height"),
            ("soft_100cm/7.bin", b"0123", "middle of a sample"),
        ] {
            let error = read_bytes(&[(name.into(), bytes.to_vec())], &FileFormat::default()).expect_err("is refused");
            assert!(error.file == name && error.to_string().contains(says), "{name}: {error}");
        }
    }
}
