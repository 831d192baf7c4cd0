//! Single files.

use std::fs::{self, Permissions};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// Writes a file of the program's beside its place and puts it there in one step: a reader sees the former one or the new one, whole.
/// A link in the place goes, and what it leads to stays.
pub(in crate::cli) fn replace_file(place: &Path, bytes: &[u8]) -> io::Result<()> {
    put(place, bytes, None)
}

/// The same for a file of the user's: a link in its place stays, and the file that it leads to is replaced. The file keeps its permissions.
///
/// # Errors
/// When the file is read-only, for root too: whoever made it so wants it as it is. When the link leads nowhere.
pub(in crate::cli) fn replace_users_file(place: &Path, bytes: &[u8]) -> io::Result<()> {
    if place.symlink_metadata().is_err() {
        return put(place, bytes, None);
    }
    let place = fs::canonicalize(place).map_err(|error| match error.kind() {
        ErrorKind::NotFound => io::Error::new(error.kind(), "it is a link that leads nowhere"),
        _ => error,
    })?;
    let permissions = fs::metadata(&place)?.permissions();
    // A rename needs the permission of the folder only, so the file itself is asked: by its mode, as root may open it, and by opening it.
    if permissions.readonly() {
        return Err(io::Error::new(ErrorKind::PermissionDenied, "it is read-only; make it writable, or name another file"));
    }
    fs::OpenOptions::new().write(true).open(&place)?;
    put(&place, bytes, Some(permissions))
}

fn put(place: &Path, bytes: &[u8], permissions: Option<Permissions>) -> io::Result<()> {
    let name = place.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let staging = place.with_file_name(format!(".{name}.{}.new", std::process::id()));
    let permit = || permissions.map_or(Ok(()), |permissions| fs::set_permissions(&staging, permissions));
    let done = write_new(&staging, bytes).and_then(|()| permit()).and_then(|()| fs::rename(&staging, place));
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
