//! Names of hidden files and folders beside a place, in which what is being written stands until it is whole.

use std::io;
use std::path::{Path, PathBuf};

/// How many hidden folders of one process number there may be beside a place.
const MOST: usize = 1000;

/// Names for the hidden files and folders of this run; another in a container of its own may have the same process number.
pub(super) fn names(place: &Path, end: &str) -> impl Iterator<Item = PathBuf> {
    let (name, pid) = (place.file_name().unwrap_or_default().to_string_lossy().into_owned(), std::process::id());
    let numbers = std::iter::once(pid.to_string()).chain((1..MOST).map(move |number| format!("{pid}-{number}")));
    numbers.map(move |number| place.with_file_name(format!(".{name}.{number}.{end}")))
}

/// Every name is taken.
pub(super) fn too_many() -> io::Error {
    io::Error::new(io::ErrorKind::AlreadyExists, "there are too many hidden files and folders of other runs")
}
