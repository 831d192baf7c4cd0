//! Atomic writing of a folder, which preserves every file that the program did not write.
//!
//! Each folder states the files that the program wrote into it, with their hashes ([`record`]). Only those may be replaced or
//! removed, and only while their bytes are as stated. All else stays ([`kept`]): it is linked into the new folder before this takes
//! the former one's place, so a run may be killed at any moment. The new folder is made in a hidden one beside its place ([`staging`]).
//! The former folder is then removed file by file ([`former`]); a file that exists nowhere else is moved into the new folder.

mod file;
mod folder;
mod former;
mod hidden_name;
mod kept;
mod record;
mod result_files;
mod staging;
#[cfg(test)]
mod tests;

use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

use super::failure::{Failure, failed};
use super::interrupt::Step;
use super::terminal;
pub(super) use file::{can_be_written, replace_file, replace_users_file, write_new};
use record::{MANIFEST, RECORD, Record};
pub(super) use result_files::{remove_result, write_result};
use staging::{Lock, Staging};

/// How often a place is tried in which another run has just put its result.
const TRIES: usize = 8;

/// Writes a folder beside its place and puts it there in one step, so that a run that is killed or fails leaves the
/// last good result. What the program did not write stays in it; a message says what has got another name for that.
///
/// A link in the folder's place is followed: the folder that it leads to is the place.
///
/// # Errors
/// [`Failure::Machine`] when the place cannot be written or is read-only. The former folder is then as it was.
pub(super) fn write_folder(parent: &Path, name: &str, files: &[(String, Vec<u8>)]) -> Result<PathBuf, Failure> {
    let shown = parent.join(name);
    fs::create_dir_all(parent).map_err(|error| failed("make the folder", parent)(why_no_folder(parent, error)))?;
    let linked = fs::symlink_metadata(&shown).is_ok_and(|found| found.is_symlink());
    let place = if linked { fs::canonicalize(&shown).map_err(failed("replace", &shown))? } else { shown.clone() };
    for note in replace_folder(&place, files)? {
        terminal::tell(&format!("note: {note}"));
    }
    Ok(shown)
}

/// What stands in the way of a folder: the system says of a file and of a link that leads nowhere that the folder exists.
fn why_no_folder(folder: &Path, error: io::Error) -> io::Error {
    let why = match (fs::symlink_metadata(folder), fs::metadata(folder)) {
        (Ok(_), Ok(found)) if !found.is_dir() => "a file is there; name another folder with -o",
        (Ok(link), Err(_)) if link.is_symlink() => "it is a link that leads nowhere; name another folder with -o",
        _ => return error,
    };
    io::Error::new(error.kind(), why)
}

/// Replaces what the program wrote in a folder; says what else has moved.
fn replace_folder(place: &Path, files: &[(String, Vec<u8>)]) -> Result<Vec<String>, Failure> {
    let mut notes = staging::clear_left(place);
    let staging = Staging::beside(place).map_err(failed("write beside", place))?;
    let written = write_files(&staging.path, files).and_then(|()| put(&staging, place, files));
    let former = match written {
        Ok((former, kept)) => {
            notes.extend(kept);
            former
        }
        Err(error) => {
            // The new folder is of no use, and the user's files in it are in their place, too; that it cannot be removed either
            // changes nothing.
            let _step = Step::begin();
            let _ = folder::remove(&staging.path);
            return Err(error);
        }
    };
    if let Some((former, _lock, _step)) = former {
        match former::clear(&former, place, former::State::WasInPlace) {
            Ok(more) => notes.extend(more),
            Err(error) => notes.push(format!("{} is left from the former result and cannot be removed: {error}", former.display())),
        }
    }
    Ok(notes)
}

/// Where a former folder is now, locked and waited for by an interruption; and what is said of what was kept.
type Put = (Option<(PathBuf, Lock, Step)>, Vec<String>);

/// Puts a finished folder in its place, together with what stays of the former one.
fn put(staging: &Staging, place: &Path, files: &[(String, Vec<u8>)]) -> Result<Put, Failure> {
    for _ in 0..TRIES {
        let lock = match fs::symlink_metadata(place) {
            Err(_) => match fs::rename(&staging.path, place) {
                Ok(()) => return Ok((None, Vec::new())),
                // Another run was faster: its folder is the former one now.
                Err(error) if [io::ErrorKind::AlreadyExists, io::ErrorKind::DirectoryNotEmpty].contains(&error.kind()) => continue,
                Err(error) => return Err(failed("replace", place)(error)),
            },
            Ok(found) if !found.is_dir() => {
                let error = io::Error::new(io::ErrorKind::NotADirectory, "a file is there");
                return Err(failed("replace", place)(error));
            }
            Ok(_) => Lock::wait_for(place),
        };
        let step = Step::begin();
        let notes = kept::keep(place, &staging.path, files).map_err(failed("replace", place))?;
        let former = staging.exchange(place).map_err(failed("replace", place))?;
        return Ok((Some((former, lock, step)), notes));
    }
    Err(failed("replace", place)(io::Error::new(io::ErrorKind::ResourceBusy, "other runs write there")))
}

/// Writes the files of a folder, first the one that names all others: so a run that is killed leaves nothing that is not named.
fn write_files(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<(), Failure> {
    let record = Record::file_for(files).map_err(failed("write", &folder.join(RECORD)))?;
    let record = record.map(|bytes| (RECORD.to_string(), bytes));
    let (first, rest): (Vec<_>, Vec<_>) = files.iter().partition(|(path, _)| path == MANIFEST);
    for (path, bytes) in record.iter().chain(first).chain(rest) {
        let within = Path::new(path).components().all(|part| matches!(part, Component::Normal(_)));
        let path = folder.join(path);
        if !within {
            return Err(failed("write", &path)(io::Error::new(io::ErrorKind::InvalidInput, "its name leads out of the folder")));
        }
        let _step = Step::begin();
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(failed("write", &path))?;
        }
        fs::write(&path, bytes).map_err(failed("write", &path))?;
    }
    Ok(())
}
