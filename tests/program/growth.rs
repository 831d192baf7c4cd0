//! No reader takes more than its share of a longer input: eight times the input takes eight times the time, or a little more.
//!
//! A reader whose time grows with the square takes 64 times as long, so a factor of [`MOST`] tells the two apart. Time is that of the
//! processor, as machines are busy with other things, too; the quickest of some runs counts, and what is quicker than [`QUICK`] says
//! nothing about growth.

use std::fmt::Write;
use std::fs;
use std::time::{Duration, Instant};

use crate::readers::{by_name, prepared};

/// Bytes of the shorter input; the longer one is below the most that is read of a file of parameters.
const SHORT: usize = 100_000;
/// How much longer the longer input is.
const TIMES: usize = 8;
/// How much more time it may take.
const MOST: u32 = 30;
/// What a short input may take in any case.
const QUICK: Duration = Duration::from_millis(10);
/// What no input of this size may take.
const LONGEST: Duration = Duration::from_secs(20);
/// Runs of each length.
const RUNS: usize = 3;

/// A text of at least so many bytes: a head, and lines that are told their number.
fn lines(head: &str, bytes: usize, line: impl Fn(usize) -> String) -> String {
    let mut text = String::from(head);
    for at in 0.. {
        if text.len() >= bytes {
            break;
        }
        text += &line(at);
    }
    text
}

/// What this thread has had of a processor, where the system tells it as Linux does: the clock runs on while others are served.
fn processor_time() -> Option<Duration> {
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    told.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

fn quickest(reader: &str, bytes: &[u8]) -> Duration {
    let read = by_name(reader).read;
    let run = |_| {
        let (begun, before) = (Instant::now(), processor_time());
        read(bytes);
        before.and_then(|before| Some(processor_time()? - before)).unwrap_or_else(|| begun.elapsed())
    };
    prepared(reader);
    (0..RUNS).map(run).min().unwrap_or_default()
}

/// Fails when a reader's time grows faster than its input, made for a number of bytes.
fn grows(reader: &str, what: &str, input: impl Fn(usize) -> Vec<u8>) -> Result<(), String> {
    let [short, long] = [SHORT, TIMES * SHORT].map(|bytes| quickest(reader, &input(bytes)));
    println!("{reader}, {what}: {short:?}, {long:?}");
    let most = MOST * short.max(QUICK);
    if long <= most.min(LONGEST) { Ok(()) } else { Err(format!("{reader}, {what}: {short:?}, and {long:?} for {TIMES} times as much")) }
}

/// The input of a text.
fn of(text: impl Fn(usize) -> String) -> impl Fn(usize) -> Vec<u8> {
    move |bytes| text(bytes).into_bytes()
}

/// All that fail, at once.
fn all(results: impl IntoIterator<Item = Result<(), String>>) {
    let failed: Vec<String> = results.into_iter().filter_map(Result::err).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn planted_frame_files_take_time_by_their_length() {
    let base = "base = \"cognifly\"\n";
    let part = format!("{base}[override.parts]\n");
    let frame = |what: &str, text: &dyn Fn(usize) -> String| grows("frame_files", what, |bytes| text(bytes).into_bytes());
    all([
        frame("unknown keys", &|bytes| lines(base, bytes, |at| format!("k{at} = 1\n"))),
        frame("comments", &|bytes| lines(base, bytes, |at| format!("# {at}\n"))),
        frame("extras", &|bytes| {
            lines(base, bytes, |at| format!("[extras.e{at}]\nmass_g = 0\nmass_basis = \"estimate\"\nsource = \"s\"\n"))
        }),
        frame("described parts", &|bytes| lines(&part, bytes, |at| format!("p{at}.kind = \"motor\"\n"))),
        frame("described parts with texts", &|bytes| lines(&part, bytes, |at| format!("p{at}.source = \"p{}\"\n", at + 1))),
        frame("a long table's name", &|bytes| {
            lines(&format!("{base}[extras.{}]\n", "n".repeat(bytes / 2)), bytes, |at| format!("k{at} = 1\n"))
        }),
        frame("a long name and a long key", &|bytes| {
            let (a, b) = ("a".repeat(bytes / 2), "b".repeat(bytes / 2));
            format!("{base}printer = \"{a}\"\n[override.printers.{b}]\nkind = \"x\"\n")
        }),
        frame("a long description", &|bytes| format!("{base}description = \"{}\"\n", "d ".repeat(bytes / 2))),
        frame("a list", &|bytes| format!("{base}x = [{}]\n", "1,".repeat(bytes / 2))),
        frame("lists of tables", &|bytes| lines(base, bytes, |_| "[[x]]\n".into())),
        frame("brackets", &|bytes| format!("{base}x = {}\n", "[".repeat(bytes))),
        frame("dots", &|bytes| format!("{base}{}x = 1\n", "a.".repeat(bytes / 2))),
        frame("quotes", &|bytes| format!("{base}x = '''{}'''\n", "''\n".repeat(bytes / 3))),
        grows("amended_frames", "keys", of(|bytes| lines("", bytes, |at| format!("k{at} = 1\n")))),
        grows("amended_frames", "tables", of(|bytes| lines("", bytes, |at| format!("[t{at}]\n")))),
    ]);
}

#[test]
fn planted_models_and_plans_take_time_by_their_length() {
    let paper = include_str!("../../params/impact/paper.toml");
    let plan = include_str!("../../params/synthetic/bottoming.toml");
    let vary = "[vary]\ncage_rod = [100, 200]\n";
    all([
        grows("impact_models", "keys", of(|bytes| lines(paper, bytes, |at| format!("k{at} = 1\n")))),
        grows("impact_models", "effects", of(|bytes| lines(paper, bytes, |at| format!("[effects.e{at}]\nx = 1\n")))),
        grows("synthetic_plans", "heights", of(|bytes| plan.replace("heights_m = [", &format!("heights_m = [{}", "1,".repeat(bytes / 2))))),
        grows("mechanics_settings", "keys", of(|bytes| lines("", bytes, |at| format!("k{at} = 1\n")))),
        grows("study_plans", "measures", of(|bytes| format!("measures = [{}]\n{vary}", "\"mass\",".repeat(bytes / 7)))),
        grows("study_plans", "ranges", of(|bytes| lines(vary, bytes, |at| format!("k{at} = [1, 2]\n")))),
        grows("study_plans", "names", of(|bytes| format!("[choose]\nprinter = [{}]\n", "\"prusa-mk4\",".repeat(bytes / 12)))),
        grows("study_samples", "rows", of(|bytes| lines("cage_rod,arm_rod\n", bytes, |at| format!("{}.5,80\n", 100 + at % 100)))),
        grows("study_samples", "names", of(|bytes| lines("printer\n", bytes, |at| format!("p{at}\n")))),
        grows("study_samples", "columns", of(|bytes| lines("cage_rod", bytes, |at| format!(",c{at}")) + "\n1\n")),
        grows("study_journals", "lines", of(|bytes| lines("", bytes, |at| format!("{{\"row\":{at},\"refused\":\"no\"}}\n")))),
        grows(
            "accepted_findings",
            "entries",
            of(|bytes| {
                let entry = |at| format!("{{\"frame\":\"f{at}\",\"rule\":\"r\",\"subject\":\"s\",\"margin\":-1,\"unit\":\"g\"}},");
                let mut text = lines("{\"schema_version\":1,\"accepted\":[", bytes, entry);
                text.truncate(text.len() - 1);
                text + "]}"
            }),
        ),
        grows("accepted_findings", "brackets", of(|bytes| "[".repeat(bytes))),
        grows("goals", "signs", of(|bytes| "<=".repeat(bytes / 2))),
        grows("coupon_findings", "findings", of(|bytes| "held=2.8,".repeat(bytes / 9))),
        grows("table_formats", "columns", of(|bytes| "t=Time,".repeat(bytes / 7))),
    ]);
}

#[test]
fn planted_records_and_tables_take_time_by_their_length() {
    let head = "trial,height_m,t_s,accel_g\n";
    let logged =
        |bytes: usize| (0..(bytes / 10) as u32).flat_map(|at| [&(1000 * at).to_le_bytes()[..], &[0, 8, 0, 8, 0, 8]].concat()).collect();
    let columns = |head: &str, bytes: usize| {
        let mut text = lines(head, bytes, |at| format!(",c{at}"));
        let count = text.matches(',').count();
        let _ = write!(text, "\n1{}\n", ",1".repeat(count));
        text
    };
    all([
        grows("logger_files", "samples", logged),
        grows("drop_tables", "rows", of(|bytes| lines(head, bytes, |at| format!("1,0.5,{:.3},1\n", at as f64 * 1e-3)))),
        grows("drop_tables", "trials", of(|bytes| lines(head, bytes, |at| format!("t{at},0.5,0,1\n")))),
        grows("drop_tables", "heights", of(|bytes| lines(head, bytes, |at| format!("1,{},0,1\n", 0.01 + at as f64 * 1e-4)))),
        grows("drop_tables", "frames apart", of(|bytes| lines(head, bytes, |at| format!("{},0.5,{at},1\n", at % 7)))),
        grows("drop_tables", "columns", of(|bytes| columns("trial,height_m,t_s,accel_g", bytes))),
        grows("drop_tables", "quotes", of(|bytes| head.to_string() + &"\"\n".repeat(bytes / 2))),
        grows("covariate_tables", "columns", of(|bytes| columns("trial", bytes))),
        grows("covariate_tables", "rows", of(|bytes| lines("trial,surface\n", bytes, |at| format!("{at},mat\n")))),
        grows("scale_readings", "rows", of(|bytes| lines("part,mass_g\n", bytes, |_| "hub,7.25\n".into()))),
        grows("fold_readings", "rows", of(|bytes| lines("thickness_mm,fold_deg,folds\n", bytes, |_| "2.9,114,held\n".into()))),
        grows("scale_readings", "digits", of(|bytes| format!("part,mass_g\nhub,7.{}\n", "1".repeat(bytes)))),
        grows("static_tests", "rows", of(|bytes| lines("displacement_mm,force_n\n", bytes, |_| "1.5,20\n".into()))),
    ]);
}
