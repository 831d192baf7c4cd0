//! What reads a file, by its name.

use std::path::Path;

/// Largest file of a logger, bytes: half an hour at 1 kHz.
const MOST_LOGGED: u64 = 20_000_000;
/// Largest table, bytes.
const MOST_TABLE: u64 = 2_000_000_000;

/// What reads a file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum FileKind {
    Logger,
    Table,
}

impl FileKind {
    /// The kind that a name's ending says.
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "bin" | "bhn" => Some(Self::Logger),
            "csv" | "tsv" => Some(Self::Table),
            _ => None,
        }
    }

    /// Largest file of the kind, bytes.
    pub fn most_bytes(self) -> u64 {
        match self {
            Self::Logger => MOST_LOGGED,
            Self::Table => MOST_TABLE,
        }
    }
}
