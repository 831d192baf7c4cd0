//! Why a command did not do its work, what a person reads of it, and its exit code.

use std::io;
use std::path::Path;

use serde_json::json;

use crate::checks::gate::Refused;
use crate::export::ExportError;
use crate::impact::measured::{Fault, Malformed, SourcePosition};
use crate::params::{LoadError, is_of_machine};
use crate::report::chart::PlotError;
use crate::report::frame_folder::FolderError;

/// Why a command did not do its work.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Input or usage is wrong.
    #[error(transparent)]
    Input(#[from] LoadError),
    /// A measured record is wrong.
    #[error(transparent)]
    Records(#[from] Malformed),
    /// A value on the command line is wrong.
    #[error("{message}")]
    Usage {
        /// What, and what to do.
        message: String,
    },
    /// The input is good and asks for what there is not: a frame within its limits, an order of folding.
    #[error("{message}")]
    Impossible {
        /// What there is not, and why.
        message: String,
    },
    /// The machine failed: a disk, a permission.
    #[error("{what}: {error}")]
    Machine {
        /// What was being done.
        what: String,
        /// What the system said.
        error: io::Error,
    },
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        Self::Machine { what: format!("cannot make {}", error.what), error: error.error }
    }
}

impl From<PlotError> for Failure {
    fn from(error: PlotError) -> Self {
        Self::Machine { what: "cannot make the plots".into(), error: io::Error::other(error) }
    }
}

impl From<FolderError> for Failure {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::Compensation { .. } | FolderError::Unsound { .. } => Self::Usage { message: error.to_string() },
            FolderError::File(error) => error.into(),
        }
    }
}

impl Failure {
    /// The exit code that tells a shell of it.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Input(error) if error.is_of_machine() => 3,
            Self::Records(Malformed { fault: Fault::Unreadable { kind, .. }, .. }) if is_of_machine(*kind) => 3,
            Self::Impossible { .. } => 1,
            Self::Input(_) | Self::Records(_) | Self::Usage { .. } => 2,
            Self::Machine { .. } => 3,
        }
    }

    /// What a program reads: the message, the remedy and the place where there is one, and the exit code. A place has the file and,
    /// where it is known, the `line` with its `column`, or the `sample` of a logger's file, from 1.
    pub fn json(&self) -> serde_json::Value {
        let (message, remedy, place) = match self {
            Self::Input(error) => {
                let refused = Refused::of_load(error);
                (
                    refused.message,
                    Some(refused.remedy),
                    refused.spot.map(|spot| json!({ "file": spot.file, "line": spot.line, "column": spot.column })),
                )
            }
            Self::Records(malformed) => (malformed.to_string(), Some(malformed.fault.remedy().to_string()), Some(place_of(malformed))),
            other => (other.to_string(), None, None),
        };
        json!({ "schema_version": 1, "error": { "message": message, "remedy": remedy, "place": place, "exit_code": self.exit_code() } })
    }

    /// What a person reads.
    pub fn render(&self) -> String {
        match self {
            Self::Input(LoadError::Refused(refusal)) => refusal.render(),
            Self::Records(malformed) => format!("error: {malformed}\nhelp: {}\n", malformed.fault.remedy()),
            Self::Impossible { message } => format!("{message}\n"),
            other => format!("error: {other}\n"),
        }
    }
}

/// Where a file is no record.
fn place_of(Malformed { file, place, .. }: &Malformed) -> serde_json::Value {
    match place {
        SourcePosition::Whole => json!({ "file": file }),
        SourcePosition::Line(line) => json!({ "file": file, "line": line }),
        SourcePosition::Sample(sample) => json!({ "file": file, "sample": sample }),
    }
}

/// A failure of the machine at a step with a file or folder.
pub(super) fn failed(what: &str, path: &Path) -> impl FnOnce(io::Error) -> Failure + use<> {
    let what = format!("cannot {what} {}", path.display());
    move |error: io::Error| Failure::Machine { what, error }
}

/// A failure of the model, as the user reads it.
pub(super) fn mechanics_refused(error: impl std::fmt::Display) -> Failure {
    Failure::Usage { message: format!("the frame's mechanics cannot be computed: {error}") }
}

#[cfg(test)]
mod tests {
    use std::io::ErrorKind;

    use super::*;

    #[test]
    fn analytic_a_records_fault_has_its_place() {
        for (place, expected) in [
            (SourcePosition::Whole, json!({ "file": "drops.csv" })),
            (SourcePosition::Line(3), json!({ "file": "drops.csv", "line": 3 })),
            (SourcePosition::Sample(7), json!({ "file": "drops.csv", "sample": 7 })),
        ] {
            let failure = Failure::Records(Malformed { file: "drops.csv".into(), place, fault: Fault::Empty });
            assert_eq!(failure.json()["error"]["place"], expected);
        }
    }

    #[test]
    fn analytic_a_wrong_path_is_wrong_input_and_a_refused_read_is_the_machines() {
        for (kind, code) in [
            (ErrorKind::NotFound, 2),
            (ErrorKind::IsADirectory, 2),
            (ErrorKind::NotADirectory, 2),
            (ErrorKind::PermissionDenied, 3),
            (ErrorKind::Other, 3),
        ] {
            let failure = Failure::Input(LoadError::Unreadable { path: "frame.toml".into(), error: kind.into() });
            assert_eq!((failure.exit_code(), failure.json()["error"]["exit_code"].as_u64()), (code, Some(code.into())), "{kind}");
            let fault = Fault::Unreadable { why: kind.to_string(), kind };
            let failure = Failure::Records(Malformed { file: "drops.csv".into(), place: SourcePosition::Whole, fault });
            assert_eq!(failure.exit_code(), code, "{kind}");
        }
    }
}
