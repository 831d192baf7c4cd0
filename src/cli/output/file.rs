//! Single files.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// Writes a file beside its place and puts it there in one step: a reader sees the former one or the new one, whole.
pub(in crate::cli) fn replace_file(place: &Path, bytes: &[u8]) -> io::Result<()> {
    let name = place.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let staging = place.with_file_name(format!(".{name}.{}.new", std::process::id()));
    let done = write_new(&staging, bytes).and_then(|()| fs::rename(&staging, place));
    if done.is_err() {
        // The new file is of no use; that it cannot be removed either changes nothing.
        let _ = fs::remove_file(&staging);
    }
    done
}

/// Writes a file that is not there yet, so that no link that lies in its place is followed.
pub(in crate::cli) fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::OpenOptions::new().write(true).create_new(true).open(path)?;
    let done = file.write_all(bytes);
    if done.is_err() {
        // Half a file would stand in the way of the next try; that it cannot be removed either changes nothing.
        let _ = fs::remove_file(path);
    }
    done
}
