//! What is known of the rows of a study.

use super::plan::Study;
use super::sampling::Sampling;

/// What came of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Its figures, in the order of the study's columns; none where the frame has no such thing.
    Figures(Vec<Option<f64>>),
    /// Why there is no such frame.
    Refused(String),
}

/// The rows that are known, in their order.
#[derive(Clone, Debug, Default)]
pub struct Outcomes {
    rows: Vec<Option<Outcome>>,
}

impl Outcomes {
    /// None of so many rows is known.
    pub fn none(rows: usize) -> Self {
        Self { rows: vec![None; rows] }
    }

    /// Learns a row. The same row twice is the same.
    pub fn learn(&mut self, row: usize, outcome: Outcome) {
        if let Some(place) = self.rows.get_mut(row) {
            *place = Some(outcome);
        }
    }

    /// A row, where it is known.
    pub fn of(&self, row: usize) -> Option<&Outcome> {
        self.rows.get(row).and_then(Option::as_ref)
    }

    /// How many rows are known.
    pub fn known(&self) -> usize {
        self.rows.iter().flatten().count()
    }

    /// How many of them are no frames.
    pub fn refused(&self) -> usize {
        self.rows.iter().flatten().filter(|outcome| matches!(outcome, Outcome::Refused(_))).count()
    }

    /// The rows that are not known yet.
    pub fn missing(&self) -> Vec<usize> {
        self.rows.iter().enumerate().filter(|(_, outcome)| outcome.is_none()).map(|(row, _)| row).collect()
    }

    /// The figure of a column, by its place, in a row; none where there is none.
    pub fn figure(&self, row: usize, column: usize) -> Option<f64> {
        match self.of(row)? {
            Outcome::Figures(figures) => figures.get(column).copied().flatten(),
            Outcome::Refused(_) => None,
        }
    }

    /// How many groups of a `saltelli` study there are, and how many rows in each; none for other samplings.
    pub fn groups(&self, study: &Study) -> Option<(usize, usize)> {
        match study.sampling {
            Sampling::Saltelli { samples } => Some((samples, study.axes.len() + 2)),
            _ => None,
        }
    }
}
