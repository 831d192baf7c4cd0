//! Folders as they lie on the disk: what is in one, which file is which, how one is copied and removed.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use super::file::write_new;
use super::record::content;

/// Something below a folder.
pub(super) struct Entry {
    /// Path below the folder.
    pub path: PathBuf,
    /// What it is; a link is a link.
    pub is: Metadata,
}

/// Everything below a folder, a folder before what is in it. Links are not followed.
pub(super) fn entries(folder: &Path) -> io::Result<Vec<Entry>> {
    let mut found = Vec::new();
    let mut open = vec![PathBuf::new()];
    while let Some(within) = open.pop() {
        let listed: io::Result<Vec<_>> = fs::read_dir(folder.join(&within))?.collect();
        let mut names: Vec<_> = listed?.into_iter().map(|entry| entry.file_name()).collect();
        names.sort();
        for name in names {
            let path = within.join(name);
            let is = match fs::symlink_metadata(folder.join(&path)) {
                // It went while the folder was read.
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                is => is?,
            };
            if is.is_dir() {
                open.push(path.clone());
            }
            found.push(Entry { path, is });
        }
    }
    Ok(found)
}

/// What two names of one file have in common; `None` where the system does not say.
#[cfg(unix)]
pub(super) fn identity(is: &Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((is.dev(), is.ino()))
}

#[cfg(not(unix))]
pub(super) fn identity(_: &Metadata) -> Option<(u64, u64)> {
    None
}

/// Whether two files hold the same: bytes, or where a link leads.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    let same_link = fs::read_link(a).is_ok_and(|to| fs::read_link(b).is_ok_and(|other| to == other));
    same_link || content(a).is_ok_and(|bytes| content(b).is_ok_and(|other| bytes == other))
}

/// Gives a file a second name; a copy of it where the disk cannot. Never takes a name that is there.
pub(super) fn link(from: &Path, to: &Path) -> io::Result<()> {
    if let Some(parent) = to.parent() {
        fs::create_dir_all(parent)?;
    }
    match fs::hard_link(from, to) {
        Err(error) if ![io::ErrorKind::AlreadyExists, io::ErrorKind::NotFound].contains(&error.kind()) => copy(from, to, error),
        done => done,
    }
}

/// Copies a file or a link; `error` is why it could not be done otherwise.
fn copy(from: &Path, to: &Path, error: io::Error) -> io::Result<()> {
    let is = fs::symlink_metadata(from)?;
    if is.is_file() {
        write_new(to, &content(from)?)?;
        let file = fs::OpenOptions::new().write(true).open(to)?;
        file.set_modified(is.modified()?)?;
        return file.set_permissions(is.permissions());
    }
    #[cfg(unix)]
    if is.is_symlink() {
        return std::os::unix::fs::symlink(fs::read_link(from)?, to);
    }
    Err(error)
}

/// Makes a folder writable for its owner, or what is in it could not be removed.
pub(super) fn make_writable(folder: &Path) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Where it fails, removing will, and says so.
        let _ = fs::set_permissions(folder, fs::Permissions::from_mode(0o700));
    }
    #[cfg(not(unix))]
    let _ = folder;
}

/// Removes a folder with all that is in it, read-only folders too; links are removed, not followed.
pub(super) fn remove(folder: &Path) -> io::Result<()> {
    for entry in entries(folder)?.iter().filter(|entry| entry.is.is_dir() && entry.is.permissions().readonly()) {
        make_writable(&folder.join(&entry.path));
    }
    fs::remove_dir_all(folder)
}
