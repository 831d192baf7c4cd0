//! `flexframe study report`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::journal_file::outcomes;
use super::recovery_report;
use super::study_option::{REPORT, StudyOption, journal_of};
use crate::cli::failure::Failure;
use crate::cli::options::Common;
use crate::cli::output;
use crate::cli::terminal;
use crate::report::chart::study_plots;
use crate::report::page::document;
use crate::report::page::study_page::StudyReport;
use crate::study::{Column, Indices, IndicesError, Outcomes, Study, Subject, front, indices};
use crate::variant::Better;

/// Write the report of a study: front, charts, sensitivities and failures of frames, or how often hidden effects were found.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    study: StudyOption,
    /// Goals of the front: one to three measures of the study [default: its first two that have a better side].
    #[arg(long, value_delimiter = ',', value_name = "MEASURE,…")]
    goals: Vec<String>,
    /// For a study of hidden effects: a Markdown page. The tables are written between the two lines of it that name the study.
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
}

pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let study = args.study.load()?;
    let folder = args.study.folder(&study);
    let known = outcomes(&journal_of(&folder), &study)?;
    match &study.subject {
        Subject::Frames(_) if args.into.is_some() => {
            Err(Failure::Usage { message: "--into: only tables of hidden effects are written into a page".into() })
        }
        Subject::Frames(_) => of_frames(args, &study, &folder, &known, common),
        Subject::Recovery(_) if !args.goals.is_empty() => {
            Err(Failure::Usage { message: "--goals: a study of hidden effects has no front".into() })
        }
        Subject::Recovery(recovery) => recovery_report::write(&study, recovery, &known, &folder, args.into.as_deref(), common),
    }
}

fn of_frames(args: &Args, study: &Study, folder: &Path, known: &Outcomes, common: &Common) -> Result<ExitCode, Failure> {
    let goals = goals(args, study, known)?;
    let usage = |error| Failure::Usage { message: format!("--goals: {error}") };
    let found = if goals.is_empty() { Vec::new() } else { front(study, known, &goals).map_err(usage)? };
    let (explained, unexplained) = explained(study, known);
    let report = StudyReport { study, outcomes: known, goals: &goals, front: &found, indices: &explained, without_indices: &unexplained };
    let plots = study_plots::plots(study, known, &goals, &found, &explained);
    let plots = plots?;
    let json = json(&report);
    let blocks = report.blocks(&plots);
    let mut files = vec![
        ("report.md".to_string(), document::markdown(&report.title(), &blocks).into_bytes()),
        ("report.html".into(), document::html(&report.title(), &blocks).into_bytes()),
        ("report.json".into(), format!("{json:#}\n").into_bytes()),
    ];
    files.extend(plots);
    let place = output::write_folder(folder, REPORT, &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}: written; {} rows that none beats\n", place.display(), found.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn goals(args: &Args, study: &Study, known: &Outcomes) -> Result<Vec<String>, Failure> {
    // A price that no row has is no goal unless it is asked for.
    let is_known = |at: usize| (0..study.rows()).any(|row| known.figure(row, at).is_some());
    let sided = study.columns.iter().enumerate().filter(|(at, column)| column.better() != Better::Neither && is_known(*at));
    let goals: Vec<String> =
        if args.goals.is_empty() { sided.take(2).map(|(_, column)| column.name()).collect() } else { args.goals.clone() };
    let twice = goals.iter().enumerate().any(|(at, goal)| goals[..at].contains(goal));
    // A study of which no measure has a better side has no front.
    if goals.len() <= 3 && !twice {
        return Ok(goals);
    }
    Err(Failure::Usage { message: "--goals: give one to three different measures of the study, with commas between".into() })
}

/// Things of columns, by their places.
type OfColumns<T> = Vec<(usize, T)>;

/// The indices of every column, and why others have none, where the study is made for them.
fn explained(study: &Study, outcomes: &Outcomes) -> (OfColumns<Indices>, OfColumns<IndicesError>) {
    let (mut explained, mut unexplained) = (Vec::new(), Vec::new());
    for at in 0..study.columns.len() {
        match indices(study, outcomes, at) {
            Ok(found) => explained.push((at, found)),
            Err(IndicesError::Sampling) => {}
            Err(why) => unexplained.push((at, why)),
        }
    }
    (explained, unexplained)
}

fn json(report: &StudyReport) -> serde_json::Value {
    let study = report.study;
    let point = |(row, figures): &(usize, Vec<f64>)| {
        let figures: serde_json::Map<String, serde_json::Value> =
            report.goals.iter().cloned().zip(figures.iter().map(|figure| serde_json::json!(figure))).collect();
        serde_json::json!({ "row": row, "measures": figures })
    };
    let index = |(column, indices): &(usize, Indices)| {
        let axis = |(at, axis): (usize, &crate::study::Axis)| {
            let of = |index: &crate::study::Index| serde_json::json!({ "share": index.share, "half_interval": index.half_interval });
            serde_json::json!({ "key": axis.key(), "first": of(&indices.first[at]), "total": of(&indices.total[at]) })
        };
        serde_json::json!({
            "measure": study.columns[*column].name(),
            "groups": indices.groups,
            "left_out": indices.left_out,
            "axes": study.axes.iter().enumerate().map(axis).collect::<Vec<_>>(),
        })
    };
    let without =
        |(column, why): &(usize, IndicesError)| serde_json::json!({ "measure": study.columns[*column].name(), "why": why.to_string() });
    let mut value = serde_json::json!({
        "schema_version": 1,
        "study": study.name,
        "rows": study.rows(),
        "known": report.outcomes.known(),
        "refused": report.outcomes.refused(),
        "goals": report.goals,
        "front": report.front.iter().map(point).collect::<Vec<_>>(),
        "indices": report.indices.iter().map(index).collect::<Vec<_>>(),
        "without_indices": report.without_indices.iter().map(without).collect::<Vec<_>>(),
    });
    for [name, caveat] in Column::caveats(&study.columns) {
        value[name] = caveat.into();
    }
    value
}
