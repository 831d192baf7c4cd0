//! Taking a hidden folder apart without losing anything of the user's.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::folder::{self, Entry};
use super::kept;
use super::record::{Record, is_list};

/// What a hidden folder was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// A result in its place: somebody may have changed its files.
    WasInPlace,
    /// A result that was being written: a file of it may be half.
    Unfinished,
}

/// Removes a folder. Files that the program did not write, and that are not in the result, are put there; says which.
///
/// # Errors
/// When something cannot be removed or put there. It is then still in the folder.
pub(super) fn clear(hidden: &Path, place: &Path, state: State) -> io::Result<Vec<String>> {
    let record = Record::read(hidden);
    let (entries, there) = (folder::entries(hidden)?, Place::of(place)?);
    let mut notes = Vec::new();
    let (folders, files): (Vec<&Entry>, Vec<&Entry>) = entries.iter().partition(|entry| entry.is.is_dir());
    folder::make_writable(hidden);
    for entry in folders.iter().filter(|entry| entry.is.permissions().readonly()) {
        folder::make_writable(&hidden.join(&entry.path));
    }
    // The lists go last: should this be killed, they are needed again.
    let (lists, others): (Vec<&Entry>, Vec<&Entry>) = files.into_iter().partition(|entry| is_list(&entry.path));
    for entry in others.iter().chain(&lists) {
        let from = hidden.join(&entry.path);
        let half = state == State::Unfinished && (record.names(&entry.path) || is_list(&entry.path));
        if !half && !record.is_ours(hidden, &entry.path) && !there.holds(&from, entry) {
            let to = rescue(&from, place, &entry.path)?;
            notes.push(format!("{} was found beside the result: it is in its place again", to.display()));
        }
        unless_gone(fs::remove_file(&from))?;
    }
    for entry in folders.iter().rev() {
        if state == State::WasInPlace && !record.made_folder(&entry.path) && place.join(&entry.path).symlink_metadata().is_err() {
            fs::create_dir_all(place.join(&entry.path))?;
        }
        unless_gone(fs::remove_dir(hidden.join(&entry.path)))?;
    }
    unless_gone(fs::remove_dir(hidden))?;
    Ok(notes)
}

/// Another run may clear the same folder.
fn unless_gone(done: io::Result<()>) -> io::Result<()> {
    match done {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        done => done,
    }
}

/// Puts a file into a folder under its own name or the next that is free.
fn rescue(from: &Path, place: &Path, path: &Path) -> io::Result<PathBuf> {
    for name in std::iter::once(path.to_path_buf()).chain(kept::names(path)) {
        let to = place.join(name);
        match folder::link(from, &to) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            done => return done.map(|()| to),
        }
    }
    Err(io::Error::new(io::ErrorKind::AlreadyExists, "no name is free"))
}

/// The files of a result.
struct Place {
    folder: PathBuf,
    entries: Vec<Entry>,
    identities: BTreeSet<(u64, u64)>,
}

impl Place {
    fn of(folder: &Path) -> io::Result<Self> {
        let entries = folder::entries(folder)?;
        let identities = entries.iter().filter_map(|entry| folder::identity(&entry.is)).collect();
        Ok(Self { folder: folder.to_path_buf(), entries, identities })
    }

    /// Whether a file of another folder is here, too: under a second name, or as a copy of a similar name.
    fn holds(&self, from: &Path, file: &Entry) -> bool {
        let similar = |entry: &&Entry| {
            let [a, b] = [&entry.path, &file.path].map(|path| path.as_os_str().as_encoded_bytes());
            (a.starts_with(b) || b.starts_with(a)) && entry.is.len() == file.is.len()
        };
        folder::identity(&file.is).is_some_and(|identity| self.identities.contains(&identity))
            || self.entries.iter().filter(similar).any(|entry| folder::is_same(from, &self.folder.join(&entry.path)))
    }
}
