//! The rows of a study as they are finished: a line of JSON each, in any order, so that an interrupted study goes on where it was.

use serde::{Deserialize, Serialize};

use super::outcomes::{Outcome, Outcomes};
use super::plan::Study;
use crate::memo::{Key, PROGRAM};

/// The name of the study's key in the first line.
pub const KEY_OF_STUDY: &str = "study";

/// A journal cannot be gone on with.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// Another plan, or another program.
    #[error("these rows are of another plan, base or version of the program")]
    OfAnother,
    /// No journal at all.
    #[error("line {line} is no row of a study")]
    Unreadable {
        /// The line, from 1.
        line: usize,
    },
}

/// What a journal says.
#[derive(Debug)]
pub struct Journal {
    /// The rows.
    pub outcomes: Outcomes,
    /// Bytes of whole lines: what follows was being written when the program was killed.
    pub whole: usize,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct First {
    study: String,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    row: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    figures: Option<Vec<Option<f64>>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
}

/// What tells a study by this program from all others.
fn key(study: &Study) -> String {
    let columns: Vec<String> = study.columns.iter().map(super::column::Column::name).collect();
    format!("{:?}", Key::of(KEY_OF_STUDY, &(PROGRAM, &study.text, study.seed, study.rows(), columns)))
}

/// The first line of a journal, with its line end.
pub fn begun(study: &Study) -> String {
    format!("{}\n", serde_json::json!(First { study: key(study) }))
}

/// The line of a row, with its line end.
pub fn line(row: usize, outcome: &Outcome) -> String {
    let (figures, refused) = match outcome {
        Outcome::Figures(figures) => (Some(figures.clone()), None),
        Outcome::Refused(why) => (None, Some(why.clone())),
    };
    format!("{}\n", serde_json::json!(Line { row, figures, refused }))
}

impl Journal {
    /// Reads a journal of a study; the text may end in the middle of a line.
    ///
    /// # Errors
    /// When it is one of another study, or none.
    pub fn read(study: &Study, text: &[u8]) -> Result<Self, JournalError> {
        let mut outcomes = Outcomes::none(study.rows());
        // Less than its first line is a begun journal, or somebody's file.
        if !text.contains(&b'\n') && !begun(study).as_bytes().starts_with(text) {
            return Err(JournalError::Unreadable { line: 1 });
        }
        let whole = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
        for (at, line) in text[..whole].split_inclusive(|byte| *byte == b'\n').enumerate() {
            let unreadable = |_| JournalError::Unreadable { line: at + 1 };
            if at == 0 {
                let first: First = serde_json::from_slice(line).map_err(unreadable)?;
                if first.study != key(study) {
                    return Err(JournalError::OfAnother);
                }
                continue;
            }
            let Line { row, figures, refused } = serde_json::from_slice(line).map_err(unreadable)?;
            let outcome = match (figures, refused) {
                (Some(figures), None) if figures.len() == study.columns.len() => Outcome::Figures(figures),
                (None, Some(why)) => Outcome::Refused(why),
                _ => return Err(JournalError::Unreadable { line: at + 1 }),
            };
            if row >= study.rows() || outcomes.of(row).is_some_and(|known| *known != outcome) {
                return Err(JournalError::Unreadable { line: at + 1 });
            }
            outcomes.learn(row, outcome);
        }
        Ok(Self { outcomes, whole })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::params::files::Memory;

    fn study(samples: usize) -> Study {
        let text = format!("samples = {samples}\nmeasures = [\"mass\", \"peak\"]\n[vary]\ncage_rod = [100, 200]\n");
        let files = Memory([("s.toml".into(), text.into_bytes())].into_iter().collect());
        super::super::plan_file::load("s.toml", &files).expect("is a plan")
    }

    proptest! {
        /// Whatever is cut off at the end of a journal, its whole lines are known, and nothing else.
        #[test]
        fn analytic_a_journal_that_ends_anywhere_keeps_its_whole_lines(
            figures in prop::collection::vec(prop::option::of(prop::num::f64::NORMAL), 0..20), cut in 0.0_f64..1.0
        ) {
            let study = study(40);
            let outcome = |at: usize| match figures[at] {
                Some(figure) => Outcome::Figures(vec![Some(figure), None]),
                None => Outcome::Refused(format!("no \"{at}\"\nat all")),
            };
            let lines: Vec<String> =
                std::iter::once(begun(&study)).chain((0..figures.len()).map(|at| line(2 * at, &outcome(at)))).collect();
            let text = lines.concat();
            let end = (cut * text.len() as f64) as usize;
            let text = &text.as_bytes()[..end];
            let read = Journal::read(&study, text).expect("reads");
            let whole = text.iter().filter(|byte| **byte == b'\n').count();
            prop_assert_eq!(read.whole, lines[..whole].concat().len());
            for at in 0..figures.len() {
                let expected = (at + 1 < whole).then(|| outcome(at));
                prop_assert_eq!(read.outcomes.of(2 * at), expected.as_ref());
            }
        }
    }

    #[test]
    fn planted_a_journal_of_another_plan_and_one_with_a_foreign_line_are_refused() {
        let own = begun(&study(40));
        assert!(matches!(Journal::read(&study(41), own.as_bytes()), Err(JournalError::OfAnother)));
        for wrong in [
            &b"{\"row\":1}\n"[..],
            b"{\"row\":1,\"refused\":\"\xff\"}\n",
            b"{\"row\":1,\"figures\":[1.0]}\n",
            b"nothing\n",
            b"{\"row\":40,\"figures\":[1,2]}\n",
            b"{\"row\":1,\"figures\":[1,2],\"bogus\":3}\n",
            b"{\"row\":1,\"figures\":[1,2],\"refused\":\"no\"}\n",
        ] {
            let text = [own.as_bytes(), wrong].concat();
            assert!(matches!(Journal::read(&study(40), &text), Err(JournalError::Unreadable { line: 2 })), "{wrong:?}");
        }
        // The same row twice may be there, as two runs may have evaluated it; with other figures one of both is wrong.
        let figures = |mass: f64| line(1, &Outcome::Figures(vec![Some(mass), None]));
        let read = |second: f64| Journal::read(&study(40), [own.clone(), figures(1.0), figures(second)].concat().as_bytes());
        assert_eq!(read(1.0).expect("reads").outcomes.known(), 1);
        assert!(matches!(read(2.0), Err(JournalError::Unreadable { line: 3 })));
    }
}
