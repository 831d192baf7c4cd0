//! Single files.

use std::fs::{self, Permissions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::hidden_name::{names, too_many};

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
    let staging = staged(place, bytes)?;
    let permit = || permissions.map_or(Ok(()), |permissions| fs::set_permissions(&staging, permissions));
    let done = permit().and_then(|()| fs::rename(&staging, place));
    if done.is_err() {
        // The new file is of no use; that it cannot be removed either changes nothing.
        let _ = fs::remove_file(&staging);
    }
    done
}

/// Writes a hidden file beside a place, under a name that no other run has.
fn staged(place: &Path, bytes: &[u8]) -> io::Result<PathBuf> {
    for staging in names(place, "new") {
        match write_new(&staging, bytes) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            written => return written.map(|()| staging),
        }
    }
    Err(too_many())
}

/// Whether a file can be put in a place: asked before what takes long.
///
/// # Errors
/// When its folder is missing, or may not be written.
pub(in crate::cli) fn can_be_written(place: &Path) -> io::Result<()> {
    match staged(place, &[]) {
        Ok(staging) => fs::remove_file(staging),
        Err(error) if error.kind() == ErrorKind::NotFound => {
            Err(io::Error::new(error.kind(), "its folder is not there; make it, or name another one"))
        }
        Err(error) => Err(error),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// In a container most runs have the same process number, so one that was killed leaves a name that the next one would take.
    #[test]
    fn planted_a_file_that_another_run_left_stands_in_no_way_and_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("accepted.json");
        let left = folder.path().join(format!(".accepted.json.{}.new", std::process::id()));
        fs::write(&left, "of another run").expect("can be written");
        replace_file(&place, b"new").expect("is written");
        assert_eq!(fs::read(&place).expect("is there"), b"new");
        assert_eq!(fs::read(&left).expect("is there"), b"of another run");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
    }
}
