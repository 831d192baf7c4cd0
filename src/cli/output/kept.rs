//! What stays of a folder whose files are replaced: all that the program did not write, or that was changed since.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::folder::{self, Entry};
use super::record::{MANIFEST, RECORD, Record, content};

/// The files of a result, by path, and the folders they lie in.
struct New<'a> {
    files: BTreeMap<&'a Path, &'a [u8]>,
    folders: BTreeSet<&'a Path>,
}

impl<'a> New<'a> {
    fn of(files: &'a [(String, Vec<u8>)]) -> Self {
        let files: BTreeMap<&Path, &[u8]> = files.iter().map(|(path, bytes)| (Path::new(path), bytes.as_slice())).collect();
        let folders = files.keys().flat_map(|path| path.ancestors().skip(1)).filter(|path| !path.as_os_str().is_empty()).collect();
        Self { files, folders }
    }

    /// The first part of a path that something of the result takes.
    fn in_the_way<'p>(&self, path: &'p Path, is_folder: bool) -> Option<&'p Path> {
        let parts: Vec<&Path> = path.ancestors().filter(|part| !part.as_os_str().is_empty()).collect();
        parts.into_iter().rev().find(|part| {
            let whole = *part == path;
            let record = *part == Path::new(RECORD) && !self.files.contains_key(Path::new(MANIFEST));
            self.files.contains_key(part) || record || (whole && !is_folder && self.folders.contains(part))
        })
    }
}

/// Links all that stays of a former folder into the one that takes its place. Says what has got another name.
///
/// # Errors
/// When the former folder cannot be read, or is read-only: whoever made it so does not want it replaced.
pub(super) fn keep(former: &Path, staging: &Path, files: &[(String, Vec<u8>)]) -> io::Result<Vec<String>> {
    let (new, record, entries) = (New::of(files), Record::read(former), folder::entries(former)?);
    writable(former, &new, &record, &entries)?;
    fs::set_permissions(staging, fs::metadata(former)?.permissions())?;
    let mut notes = Vec::new();
    let mut renamed: BTreeMap<&Path, PathBuf> = BTreeMap::new();
    let mut folders = Vec::new();
    for Entry { path, is } in &entries {
        let theirs = if is.is_dir() { !record.made_folder(path) } else { !record.is_ours(former, path) };
        if !theirs || is_as_new(former, path, &new) {
            continue;
        }
        let to = match new.in_the_way(path, is.is_dir()) {
            None => path.clone(),
            Some(part) => {
                let name = renamed.entry(part).or_insert_with(|| free_name(part, former, staging));
                name.join(path.strip_prefix(part).unwrap_or(Path::new("")))
            }
        };
        // A path that is joined with nothing ends in a slash.
        let to: PathBuf = to.components().collect();
        if is.is_dir() {
            fs::create_dir_all(staging.join(&to))?;
            folders.push((to, is.permissions()));
            continue;
        }
        link(&former.join(path), &staging.join(&to))?;
        if to != *path || record.names(path) {
            notes.push(note(former, path, &to, record.names(path)));
        }
    }
    // What lies in a read-only folder could not be written after this; the innermost comes last.
    for (folder, permissions) in folders.into_iter().rev() {
        fs::set_permissions(staging.join(folder), permissions)?;
    }
    Ok(notes)
}

/// What is said of a file that has got another name, or that stays though the result has none of its name any more.
pub(super) fn note(former: &Path, path: &Path, to: &Path, was_ours: bool) -> String {
    let shown = former.join(path);
    let shown = shown.display();
    match (was_ours, to == path) {
        (true, true) => format!("{shown} was changed since it was written: it stays, though the result has no such file any more"),
        (true, false) => format!("{shown} was changed since it was written: your text is kept as {}", former.join(to).display()),
        (false, _) => format!("{shown} was not written by flexframe: it is kept as {}", former.join(to).display()),
    }
}

/// Whether a file holds what the result has at its path.
fn is_as_new(former: &Path, path: &Path, new: &New) -> bool {
    new.files.get(path).is_some_and(|bytes| content(&former.join(path)).is_ok_and(|found| found == **bytes))
}

/// A free name for something whose own is taken: `report.md.yours`, then `report.md.yours-2` and so on.
fn free_name(path: &Path, former: &Path, staging: &Path) -> PathBuf {
    let taken = |name: &Path| [former, staging].iter().any(|folder| folder.join(name).symlink_metadata().is_ok());
    names(path).find(|name| !taken(name)).unwrap_or_else(|| path.to_path_buf())
}

/// The names that something may get when its own is taken, best first, without end.
pub(super) fn names(path: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let name = path.as_os_str().to_owned();
    (1_u32..).map(move |number| {
        let mut name = name.clone();
        name.push(if number == 1 { ".yours".to_string() } else { format!(".yours-{number}") });
        name.into()
    })
}

/// Gives a file that stays a name in the new folder.
fn link(from: &Path, to: &Path) -> io::Result<()> {
    match folder::link(from, to) {
        // Whoever owns it has just removed it.
        Err(error) if error.kind() == io::ErrorKind::NotFound && from.symlink_metadata().is_err() => Ok(()),
        done => done,
    }
}

/// Refuses a read-only folder in which files would be replaced.
fn writable(former: &Path, new: &New, record: &Record, entries: &[Entry]) -> io::Result<()> {
    let inner = entries.iter().filter(|entry| entry.is.is_dir());
    let filled = inner.filter(|entry| record.made_folder(&entry.path) || new.folders.contains(entry.path.as_path()));
    let read_only = |is: &fs::Metadata| is.permissions().readonly();
    let own = read_only(&fs::metadata(former)?).then(|| former.to_path_buf());
    match own.or_else(|| filled.filter(|entry| read_only(&entry.is)).map(|entry| former.join(&entry.path)).next()) {
        None => Ok(()),
        Some(folder) => {
            let message = format!("{} is read-only; make it writable, or choose another place with -o", folder.display());
            Err(io::Error::new(io::ErrorKind::PermissionDenied, message))
        }
    }
}
