//! The report of a study of hidden effects.

use std::fs;
use std::path::Path;
use std::process::ExitCode;

use super::study_option::REPORT;
use crate::cli::failure::Failure;
use crate::cli::options::Common;
use crate::cli::output;
use crate::cli::terminal;
use crate::export::table;
use crate::report::page::document;
use crate::report::page::recovery_page::{FACTS, RecoveryReport};
use crate::study::recovery::{Recovery, accuracy};
use crate::study::{Outcomes, Study};

/// Writes the page and the table of its facts, and the tables into another page.
pub(super) fn write(
    study: &Study,
    recovery: &Recovery,
    outcomes: &Outcomes,
    folder: &Path,
    into: Option<&Path>,
    common: &Common,
) -> Result<ExitCode, Failure> {
    let accuracy = accuracy(study, recovery, outcomes);
    let report = RecoveryReport { study, outcomes, accuracy: &accuracy };
    let blocks = report.blocks();
    let facts = table::csv("accuracy.csv", FACTS, report.facts())?;
    let files = [
        ("report.md".to_string(), document::markdown(&report.title(), &blocks).into_bytes()),
        ("report.html".into(), document::html(&report.title(), &blocks).into_bytes()),
        ("accuracy.csv".into(), facts.into_bytes()),
    ];
    if let Some(page) = into {
        write_into(page, &study.name, &document::markdown_part(&blocks))?;
    }
    let place = output::write_folder(folder, REPORT, &files)?;
    let (known, rows) = (outcomes.known(), study.rows());
    if common.json {
        let facts: Vec<serde_json::Value> = report.facts().iter().map(|row| as_json(row)).collect();
        terminal::print_json(
            &serde_json::json!({ "schema_version": 1, "study": study.name, "rows": rows, "known": known, "facts": facts }),
        )?;
    } else if !common.quiet {
        terminal::print(&format!("{}: written; {known} of {rows} rows known\n", place.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A row of facts: numbers as numbers, and what is not there as null.
fn as_json(row: &[String]) -> serde_json::Value {
    let value = |field: &String| match field.parse::<f64>() {
        Ok(number) => serde_json::json!(number),
        Err(_) if field.is_empty() => serde_json::Value::Null,
        Err(_) => serde_json::json!(field),
    };
    FACTS.iter().map(|name| name.to_string()).zip(row.iter().map(value)).collect::<serde_json::Map<_, _>>().into()
}

/// The lines between which a page takes the tables of a study.
fn marks(study: &str) -> [String; 2] {
    [format!("<!-- study {study} -->\n"), format!("<!-- end of study {study} -->\n")]
}

/// Replaces what stands between the marks of a page.
fn write_into(page: &Path, study: &str, tables: &str) -> Result<(), Failure> {
    let machine = |what: &str| {
        let what = format!("cannot {what} {}", page.display());
        move |error| Failure::Machine { what, error }
    };
    let text = fs::read_to_string(page).map_err(machine("read"))?;
    let filled = filled(&text, study, tables).ok_or_else(|| {
        let [begin, end] = marks(study).map(|mark| mark.trim_end().to_string());
        Failure::Usage {
            message: format!("{}: the tables of {study} stand between the lines {begin} and {end}, which it has not", page.display()),
        }
    })?;
    output::replace_users_file(page, filled.as_bytes()).map_err(machine("write"))
}

/// A page with the tables between its marks; none where it has no marks. Headings are a level lower than in a page of their own.
fn filled(text: &str, study: &str, tables: &str) -> Option<String> {
    let [begin, end] = marks(study);
    let from = text.find(&begin)? + begin.len();
    let to = from + text[from..].find(&end)?;
    let lower: String =
        tables.lines().map(|line| if line.starts_with("## ") { format!("#{line}\n") } else { format!("{line}\n") }).collect();
    Some(format!("{}{lower}\n{}", &text[..from], &text[to..]))
}

#[cfg(test)]
mod tests {
    #[test]
    fn analytic_tables_replace_what_stands_between_the_marks_of_their_study() {
        let page = "a\n<!-- study one -->\nold\n<!-- end of study one -->\nb\n<!-- study two -->\n<!-- end of study two -->\n";
        let filled = |text: &str, tables: &str| super::filled(text, "one", tables).expect("has marks");
        let once = filled(page, "\n## T\n\n| x |\n");
        assert_eq!(once, page.replace("old\n", "\n### T\n\n| x |\n\n"));
        assert_eq!(filled(&once, "\n## T\n\n| x |\n"), once);
        assert_eq!(super::filled(page, "three", "x"), None);
    }
}
