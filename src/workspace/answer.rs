//! What a workspace answers.

use crate::memo::Made;
use crate::params::refusal::Refusal;
use crate::report::frame_folder::FolderError;

/// A result, and what was computed for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer<T> {
    /// The result.
    pub value: T,
    /// The steps that were carried out, each with how often, in the order of their names; the others' results were there.
    pub made: Vec<(Made, usize)>,
}

/// Why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    /// The frame is none: the refusal names the place in its file.
    #[error(transparent)]
    Frame(#[from] Refusal),
    /// A file cannot be made.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The computation was ended by whoever followed it.
    #[error("the computation was ended")]
    Ended,
}
