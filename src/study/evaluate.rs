//! From a row of a study to its figures.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use super::column::Column;
use super::outcomes::Outcome;
use super::plan::Study;
use crate::checks::{CATALOGUE, Cost, Rule};
use crate::frame::assembly::Design;
use crate::memo::Memo;
use crate::params::Frame;
use crate::variant::Evaluation;

/// Evaluates rows of a study, one after the other or side by side.
pub struct Evaluator<'a> {
    study: &'a Study,
    rules: Vec<&'static Rule>,
    memo: Arc<Memo>,
}

impl<'a> Evaluator<'a> {
    /// Steps that two rows share are computed once, as long as they follow each other closely.
    pub fn new(study: &'a Study) -> Self {
        let asked: Vec<&str> = study.columns.iter().flat_map(Column::rules).map(|rule| rule.id).collect();
        let rules = CATALOGUE.iter().copied().filter(|rule| asked.contains(&rule.id)).collect();
        Self { study, rules, memo: Arc::default() }
    }

    /// The figures of a row, in the order of the columns; or why there is no such frame. A frame on which the program fails is
    /// such a row, too: a study of thousands does not end at one.
    pub fn row(&self, row: usize) -> Outcome {
        let outcome = catch_unwind(AssertUnwindSafe(|| self.evaluated(row)));
        self.memo.changed();
        match outcome {
            Ok(Ok(evaluation)) => Outcome::Figures(self.study.columns.iter().map(|column| column.of_frame(&evaluation)).collect()),
            Ok(Err(why)) => Outcome::Refused(why),
            Err(_) => Outcome::Refused("the program failed on this frame, which is a defect of the program".into()),
        }
    }

    fn evaluated(&self, row: usize) -> Result<Evaluation, String> {
        let frame = Frame::resolve(&self.study.frame_file(row)).map_err(|refusal| refusal.reason.to_string())?;
        let design = Design::with(frame, &self.memo).map_err(|error| error.to_string())?;
        let evaluation = Evaluation::by(&self.rules, Cost::Quick, design);
        match &self.study.mechanics {
            None => Ok(evaluation),
            Some(settings) => evaluation.strengthened(settings).map_err(|error| error.to_string()),
        }
    }
}
