//! `flexframe params`: every parameter of a frame.

use std::process::ExitCode;

use serde::Serialize;

use super::choice;
use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::session;
use super::terminal;
use crate::params::parameter::Parameter;
use crate::params::{Frame, follows, parameters, target};

/// List every parameter with unit, default, bounds and the parts it drives.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe params\n  flexframe params cognifly-v8 --filter hinge --json\n  flexframe params --markdown > docs/parameters.md"
)]
pub(super) struct Args {
    /// Which frame's values to show.
    #[command(flatten)]
    pub frame: FrameOption,
    /// List only keys that contain this text.
    #[arg(long, value_name = "TEXT")]
    pub filter: Option<String>,
    /// Print Markdown tables, as in docs/parameters.md.
    #[arg(long, conflicts_with = "json")]
    pub markdown: bool,
}

/// A parameter as listed.
#[derive(Serialize)]
struct Row {
    #[serde(skip)]
    parameter: &'static Parameter,
    key: String,
    unit: &'static str,
    value: Option<f64>,
    default: Option<f64>,
    /// What the value follows from, when no file states it: a bought part's role, another number, or the target size.
    follows: Option<&'static str>,
    min: f64,
    max: f64,
    drives: Vec<&'static str>,
    doc: &'static str,
}

/// Lists the parameters.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let (frame, file) = session::load(&args.frame)?;
    let frame = session::with_lengths(frame, &file, common)?;
    let (default, _) = Frame::load("cognifly")?;
    let rows: Vec<Row> = parameters()
        .map(|p| {
            let key = format!("{}.{}", p.table, p.key);
            Row {
                parameter: p,
                unit: p.unit(),
                value: frame.value(p.table, p.key),
                default: default.value(p.table, p.key),
                follows: if target::gives(&frame, &key) {
                    Some("target")
                } else if file.entries.contains_key(&key) {
                    None
                } else {
                    follows::followed(p.key)
                },
                min: p.min,
                max: p.max,
                drives: p.drives.iter().map(|part| part.slug()).collect(),
                doc: p.doc.trim(),
                key,
            }
        })
        .filter(|row| args.filter.as_ref().is_none_or(|text| row.key.contains(text.as_str())))
        .collect();
    if rows.is_empty() {
        return Err(Failure::Usage { message: none_listed(args.filter.as_deref().unwrap_or_default()) });
    }
    if common.json {
        terminal::print_json(&rows)?;
    } else {
        terminal::print(&if args.markdown { page(&frame.name, &rows) } else { table(&rows) })?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What is said where no parameter is listed: neither a target size nor a name is one.
fn none_listed(filter: &str) -> String {
    let targets: Vec<String> = target::KEYS
        .iter()
        .filter(|target| target.key.contains(filter))
        .map(|target| format!("`{}`, {} to {} {}", target.key, target.min, target.max, target.unit))
        .collect();
    let names: Vec<String> = choice::keys().into_iter().filter(|key| key.contains(filter)).map(|key| format!("`{key}`")).collect();
    match (targets.is_empty(), names.is_empty()) {
        (true, true) => "no key contains that text; `flexframe params` lists them all".into(),
        (false, _) => format!(
            "no parameter contains that text, but keys of a target size, of which the three rod lengths follow: {}",
            targets.join("; ")
        ),
        (true, false) => {
            format!(
                "no parameter contains that text, but keys that hold a name: {}; `flexframe explain KEY` lists the names",
                names.join(", ")
            )
        }
    }
}

/// To a millionth, without zeros behind the last digit; nothing for a number that there is not.
fn number(value: Option<f64>) -> String {
    // Adding 0 takes the sign off a zero.
    value.map_or(String::new(), |value| format!("{}", (value * 1e6).round() / 1e6 + 0.0))
}

fn table(rows: &[Row]) -> String {
    let mut text = format!("{:<42} {:>9} {:>9}  {:<18} what it is; what it drives\n", "key", "value", "default", "bounds");
    for row in rows {
        let bounds = format!("{} to {} {}", row.min, row.max, row.unit).trim_end().to_string();
        let drives = if row.drives.is_empty() { String::new() } else { format!(" [{}]", row.drives.join(", ")) };
        let follows = row.follows.map(|followed| follows::followed_key(row.parameter.key).unwrap_or_else(|| followed.into()));
        let follows = follows.map_or(String::new(), |key| format!(" (follows from {key})"));
        text +=
            &format!("{:<42} {:>9} {:>9}  {bounds:<18} {}{follows}{drives}\n", row.key, number(row.value), number(row.default), row.doc);
    }
    text
}

/// The parameters as a page, a table of it for each table of a frame file.
fn page(frame: &str, rows: &[Row]) -> String {
    let mut page = format!(
        "# Parameters\n\nPrinted by `flexframe params --markdown`; `docs/frame-files.md` says how a frame file states them. The value is that of\n\
         `{frame}`; one with a bought part's role or another number in brackets follows from it unless a file states it. \"Drives\" lists\n\
         the printed parts whose shape changes with the number; every number may move parts, and change mass and checks.\n"
    );
    let mut table = "";
    for row in rows {
        let Row { parameter: p, unit, min, max, doc, .. } = row;
        if p.table != table {
            table = p.table;
            page += &format!(
                "\n## [{table}]\n\n{}\n\n| key | unit | value | bounds | what it is | drives |\n|---|---|---|---|---|---|\n",
                p.table_doc.trim()
            );
        }
        let follows = row.follows.map_or(String::new(), |role| format!(" ({role})"));
        let unit = if unit.is_empty() { "-" } else { unit };
        let (key, value, drives) = (p.key, number(row.value), row.drives.join(", "));
        page += &format!("| `{key}` | {unit} | {value}{follows} | {min} to {max} | {doc} | {drives} |\n");
    }
    page
}
