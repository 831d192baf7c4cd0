//! Why a frame file, a model file or a plan could not be read at all.

use std::io::ErrorKind;
use std::path::PathBuf;

use super::refusal::Refusal;

/// Largest parameter file read, bytes.
pub(super) const LARGEST_FILE: u64 = 1 << 20;

/// A frame file or a model file could not be read at all.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// What it says is refused.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// No file, no preset.
    #[error(
        "there is no frame `{name}`: neither a file nor a preset ({presets}){}; the name of a frame's file ends in .toml, and in `check` \
         'FOLDER/*.toml' names those of a folder",
        nearest.as_ref().map_or(String::new(), |nearest| format!("; did you mean `{nearest}`?"))
    )]
    NoSuchFrame {
        /// What was asked for.
        name: String,
        /// The presets there are.
        presets: String,
        /// The preset that is nearest to it.
        nearest: Option<String>,
    },
    /// No file, no model that comes with the program.
    #[error("there is no model `{name}`: neither a file nor one of those that come with the program ({models})")]
    NoSuchModel {
        /// What was asked for.
        name: String,
        /// The models there are.
        models: String,
    },
    /// No file; no plan comes with the program.
    #[error("there is no plan `{name}`: give a TOML file, such as params/synthetic/bottoming.toml of flexframe's sources")]
    NoSuchPlan {
        /// What was asked for.
        name: String,
    },
    /// The file cannot be read.
    #[error("cannot read {path}: {error}")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// The file is too large to be one of parameters.
    #[error("{path} is too large; a file of parameters has at most {LARGEST_FILE} bytes")]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
}

/// What the system says of a path that is wrong, not of a machine that fails.
const WRONG_PATH: [ErrorKind; 6] = [
    ErrorKind::NotFound,
    ErrorKind::NotADirectory,
    ErrorKind::IsADirectory,
    ErrorKind::InvalidData,
    ErrorKind::InvalidInput,
    ErrorKind::InvalidFilename,
];

impl LoadError {
    /// Whether the machine failed, a disk or a permission, and the input may be good.
    pub fn is_of_machine(&self) -> bool {
        matches!(self, Self::Unreadable { error, .. } if is_of_machine(error.kind()))
    }
}

/// Whether what the system says of a file tells that the machine failed, a disk or a permission, and not that the path is wrong.
pub fn is_of_machine(kind: ErrorKind) -> bool {
    !WRONG_PATH.contains(&kind)
}
