//! A Pareto front, as a table, as CSV and JSON, and as a picture.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use crate::cli::failure::Failure;
use crate::cli::options::Common;
use crate::cli::output;
use crate::cli::searching;
use crate::cli::terminal;
use crate::figures::decimals;
use crate::report::chart::front_plot;
use crate::report::data::front_data;
use crate::study::Column;
use crate::variant::{Front, caveats};

/// Says what was found, and writes it when asked to.
pub(super) fn report_front(front: &Front, frame: &str, into: Option<&Path>, common: &Common) -> Result<ExitCode, Failure> {
    let json = front_data::json(front, frame, searching::id(front.ended));
    let written = into.map(|folder| write(front, &json, frame, folder)).transpose();
    if common.json {
        // A folder that cannot be written is the one document that is printed.
        written?;
        terminal::print_json(&json)?;
        return Ok(ExitCode::SUCCESS);
    }
    if !common.quiet {
        terminal::print(&table(front))?;
    }
    if let Some(place) = written?.filter(|_| !common.quiet) {
        terminal::print(&format!("{}: written\n", place.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes the folder of a front; says where it is.
fn write(front: &Front, json: &serde_json::Value, frame: &str, folder: &Path) -> Result<PathBuf, Failure> {
    let mut files = vec![("pareto.csv".to_string(), front_data::csv(front)?.into_bytes())];
    files.push(("pareto.json".into(), format!("{json:#}\n").into_bytes()));
    let points: Vec<&[f64]> = front.points.iter().map(|point| &point.goals[..]).collect();
    let goals: Vec<Column> = front.goals.iter().map(|goal| Column::Measure(goal)).collect();
    let plots = front_plot::plots(&goals, &points, frame);
    files.extend(plots?);
    output::write_folder(folder, &format!("pareto-{frame}"), &files)
}

fn table(front: &Front) -> String {
    let goals = front.goals.iter().map(|goal| format!("{:>22}", format!("{}, {}", goal.name, goal.unit)));
    let vary = front.vary.iter().map(|vary| format!("{:>22}", vary.parameter.key));
    let mut text = format!("{}\n\n{}\n", searching::summary(front.looked_at, front.ended), goals.chain(vary).collect::<String>());
    for point in &front.points {
        let goals = front.goals.iter().zip(&point.goals).map(|(goal, value)| format!("{:>22}", goal.reported(Some(*value))));
        let values = point.values.iter().map(|value| format!("{:>22}", decimals(*value, 3)));
        text += &goals.chain(values).collect::<String>();
        text.push('\n');
    }
    for [_, caveat] in caveats(front.goals.iter().copied()) {
        text += &format!("\n{caveat}\n");
    }
    text
}
