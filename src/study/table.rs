//! The table of a study.

use super::column::Column;
use super::outcomes::{Outcome, Outcomes};
use super::plan::Study;
use crate::export::ExportError;
use crate::export::table;

/// The rows that are known as CSV: the row's number, what differs, the figures, and why a row is no frame. A head without units has
/// the keys and the names of measures, so that programs find them; `docs/studies.md` lists the units.
///
/// # Errors
/// When the table cannot be written.
pub fn csv(study: &Study, outcomes: &Outcomes) -> Result<String, ExportError> {
    let axes = study.axes.iter().map(super::axis::Axis::key);
    let columns = study.columns.iter().map(Column::name);
    let head: Vec<String> = ["row".to_string()].into_iter().chain(axes).chain(columns).chain(["refused".to_string()]).collect();
    let rows = (0..study.rows()).filter_map(|row| {
        let outcome = outcomes.of(row)?;
        let inputs = study.inputs(row).into_iter().map(|input| input.field());
        let (figures, refused) = match outcome {
            Outcome::Figures(figures) => {
                (study.columns.iter().zip(figures).map(|(column, figure)| field(column, *figure)).collect(), String::new())
            }
            Outcome::Refused(why) => (vec![String::new(); study.columns.len()], why.clone()),
        };
        Some([row.to_string()].into_iter().chain(inputs).chain(figures).chain([refused]).collect::<Vec<String>>())
    });
    table::csv("study.csv", head, rows)
}

/// A figure as a field: a word where the column has words.
fn field(column: &Column, figure: Option<f64>) -> String {
    match (column.words(), figure) {
        (Some(_), Some(figure)) => column.word(figure).unwrap_or_default().into(),
        (_, figure) => table::number(figure),
    }
}
