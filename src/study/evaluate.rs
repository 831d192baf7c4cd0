//! From a row of a study to its figures.

use std::cell::LazyCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use super::axis::Axis;
use super::column::Column;
use super::outcomes::Outcome;
use super::plan::{Frames, Study, Subject};
use super::recovery::{RecoveryMeasure, Worker};
use super::sampling::Sampling;
use crate::checks::{CATALOGUE, Cost, Rule};
use crate::export::bill::bill;
use crate::frame::assembly::Design;
use crate::memo::Memo;
use crate::params::Frame;
use crate::variant::Evaluation;

/// Rows for which a result is kept without being used, where every number is another in each row: what does not vary is used in each.
const ROWS: u64 = 2;
/// Most such rows: some megabytes each.
const MOST_ROWS: u64 = 16;

/// For how many rows results are kept. Names, and the values of a grid, come again: after about as many rows as there are of them.
fn lasting(study: &Study) -> u64 {
    let of_grid = if let Sampling::Grid { points } = &study.sampling { points.iter().copied().max() } else { None };
    let names = study.axes.iter().filter_map(|axis| if let Axis::Name { names, .. } = axis { Some(names.len()) } else { None });
    let values = names.chain(of_grid).max().unwrap_or(0) as u64;
    (2 * values).clamp(ROWS, MOST_ROWS)
}

/// Evaluates rows of a study, one after the other or side by side.
pub struct Evaluator<'a> {
    study: &'a Study,
    work: Work<'a>,
}

/// What is kept from row to row.
enum Work<'a> {
    /// The rules that are carried out. Steps that two rows share are computed once, as long as few rows lie between them.
    Frames { frames: &'a Frames, rules: Vec<&'static Rule>, memo: Arc<Memo> },
    /// What makes drops and diagnoses them.
    Recovery { worker: Worker<'a>, columns: Vec<&'static RecoveryMeasure> },
}

impl<'a> Evaluator<'a> {
    /// For the rows of a study.
    pub fn new(study: &'a Study) -> Self {
        let work = match &study.subject {
            Subject::Frames(frames) => {
                let asked: Vec<&str> = study.columns.iter().flat_map(Column::rules).map(|rule| rule.id).collect();
                let rules = CATALOGUE.iter().copied().filter(|rule| asked.contains(&rule.id)).collect();
                Work::Frames { frames, rules, memo: Arc::new(Memo::lasting(lasting(study))) }
            }
            Subject::Recovery(recovery) => {
                let columns: Vec<&'static RecoveryMeasure> = study.columns.iter().filter_map(Column::recovery).collect();
                Work::Recovery { worker: Worker::new(recovery, columns.iter().copied()), columns }
            }
        };
        Self { study, work }
    }

    /// The figures of a row, in the order of the columns; or why there is no such frame, or are no such drops. A row on which the
    /// program fails is refused, too: a study of thousands does not end at one.
    pub fn row(&self, row: usize) -> Outcome {
        let figures = || match &self.work {
            Work::Frames { frames, rules, memo } => self.of_frame(frames, rules, memo, row),
            Work::Recovery { worker, columns } => worker.row(row, columns),
        };
        let outcome = catch_unwind(AssertUnwindSafe(figures));
        match outcome {
            Ok(Ok(figures)) => Outcome::Figures(figures),
            Ok(Err(why)) => Outcome::Refused(why),
            Err(_) => Outcome::Refused("the program failed on this row, which is a defect of the program".into()),
        }
    }

    fn of_frame(&self, frames: &Frames, rules: &[&'static Rule], memo: &Arc<Memo>, row: usize) -> Result<Vec<Option<f64>>, String> {
        let frame = Frame::resolve(&self.study.frame_file(frames, row)).map_err(|refusal| refusal.reason.to_string())?;
        let design = Design::with(frame, memo).map_err(|error| error.to_string())?;
        let evaluation = Evaluation::by(rules, Cost::Quick, design);
        let evaluation = match &frames.mechanics {
            None => evaluation,
            Some(settings) => evaluation.strengthened(settings).map_err(|error| error.to_string())?,
        };
        let bill = LazyCell::new(|| bill(&evaluation.design, &evaluation.masses, None));
        Ok(self.study.columns.iter().map(|column| column.of_frame(&evaluation, || &bill)).collect())
    }
}
