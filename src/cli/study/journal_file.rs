//! The file of finished rows. It grows by a line a row, and is the one file that is not replaced as a whole: a line that was being
//! written when the program was killed is cut off at the next run.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::study::{Journal, JournalError, Outcome, Outcomes, Study, begun, line};

/// A journal that is open for writing, for one run at a time.
pub(super) struct JournalFile {
    place: PathBuf,
    file: File,
    /// What is known.
    pub outcomes: Outcomes,
}

impl JournalFile {
    /// Opens the journal of a study, or begins one; with `restart` what is there is given up.
    ///
    /// # Errors
    /// [`Failure::Usage`] when it is that of another plan, or another run writes it; [`Failure::Machine`] when it cannot be read or written.
    pub fn open(place: &Path, study: &Study, restart: bool) -> Result<Self, Failure> {
        let failed = |error| Failure::Machine { what: format!("cannot write {}", place.display()), error };
        let file = OpenOptions::new().create(true).append(true).open(place).map_err(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(Failure::Usage { message: format!("another run of this study writes {}", place.display()) });
            }
            // A file system without locks has no protection, and is good enough for one run.
            Err(TryLockError::Error(_)) => {}
        }
        if restart {
            file.set_len(0).map_err(failed)?;
        }
        let text = fs::read(place).map_err(failed)?;
        let mut journal = Self { place: place.into(), file, outcomes: Outcomes::none(study.rows()) };
        let known = read(place, &text, study)?;
        journal.file.set_len(known.whole as u64).map_err(failed)?;
        journal.outcomes = known.outcomes;
        if known.whole == 0 {
            journal.file.write_all(begun(study).as_bytes()).map_err(failed)?;
        }
        Ok(journal)
    }

    /// Keeps a row. Of one that could not be written whole, nothing stays.
    ///
    /// # Errors
    /// [`Failure::Machine`] when it cannot be written.
    pub fn keep(&mut self, row: usize, outcome: Outcome) -> Result<(), Failure> {
        let failed = |error: io::Error| Failure::Machine { what: format!("cannot write {}", self.place.display()), error };
        let before = self.file.metadata().map_err(failed)?.len();
        if let Err(error) = self.file.write_all(line(row, &outcome).as_bytes()) {
            // Should that fail, too, the next run cuts off what is half.
            let _ = self.file.set_len(before);
            return Err(failed(error));
        }
        self.outcomes.learn(row, outcome);
        Ok(())
    }
}

/// What the text of a journal says of a study.
fn read(place: &Path, text: &[u8], study: &Study) -> Result<Journal, Failure> {
    Journal::read(study, text).map_err(|error| {
        let remedy = match error {
            JournalError::OfAnother => "begin again with `study run --restart`, or give another folder with -o",
            JournalError::Unreadable { line: 1 } => "move it away, or give another folder with -o",
            JournalError::Unreadable { .. } => "delete that line: the next run evaluates its row again, and keeps the others",
        };
        Failure::Usage { message: format!("{}: {error}; {remedy}", place.display()) }
    })
}

/// What is known of a study, without writing.
pub(super) fn outcomes(place: &Path, study: &Study) -> Result<Outcomes, Failure> {
    match fs::read(place) {
        Ok(text) => Ok(read(place, &text, study)?.outcomes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(Failure::Usage { message: format!("{} is not there: run the study first", place.display()) })
        }
        Err(error) => Err(Failure::Machine { what: format!("cannot read {}", place.display()), error }),
    }
}
