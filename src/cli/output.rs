//! A folder that is written whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// Writes a folder beside its place and puts it there in one step, so that a run that is killed or fails leaves the
/// last good result.
pub(super) fn write_folder(parent: &Path, name: &str, files: &[(String, Vec<u8>)]) -> Result<PathBuf, Failure> {
    let place = parent.join(name);
    let staging = parent.join(format!(".{name}.{}.new", std::process::id()));
    let failed = |what: &str, path: &Path| {
        let what = format!("cannot {what} {}", path.display());
        move |error: io::Error| Failure::Machine { what, error }
    };
    fs::create_dir_all(parent).map_err(failed("make the folder", parent))?;
    let written = write_files(&staging, files).and_then(|()| put(&staging, &place).map_err(failed("replace", &place)));
    if let Err(error) = written {
        // The new folder is of no use; that it cannot be removed either changes nothing.
        let _ = fs::remove_dir_all(&staging);
        return Err(error);
    }
    if staging.exists() {
        fs::remove_dir_all(&staging).map_err(failed("remove", &staging))?;
    }
    Ok(place)
}

/// Puts a folder in its place; a former one is then where the new one was.
fn put(staging: &Path, place: &Path) -> io::Result<()> {
    match fs::symlink_metadata(place) {
        Err(_) => fs::rename(staging, place),
        Ok(former) if former.is_file() => Err(io::Error::new(io::ErrorKind::NotADirectory, "a file is there")),
        Ok(_) => exchange(staging, place),
    }
}

/// Exchanges two folders: at every moment there is a whole one at either place.
#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    match renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE) {
        // Some network file systems do not know how.
        Err(rustix::io::Errno::INVAL | rustix::io::Errno::NOSYS | rustix::io::Errno::NOTSUP) => exchange_by_turns(a, b),
        done => Ok(done?),
    }
}

#[cfg(not(target_os = "linux"))]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    exchange_by_turns(a, b)
}

/// Exchanges two folders where no call does it at once: for a moment nothing is at `b`.
fn exchange_by_turns(a: &Path, b: &Path) -> io::Result<()> {
    let aside = a.with_extension("old");
    fs::rename(b, &aside)?;
    if let Err(error) = fs::rename(a, b) {
        let _ = fs::rename(&aside, b);
        return Err(error);
    }
    fs::rename(&aside, a)
}

fn write_files(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<(), Failure> {
    for (path, bytes) in files {
        let path = folder.join(path);
        let failed = |error| Failure::Machine { what: format!("cannot write {}", path.display()), error };
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(failed)?;
        }
        fs::write(&path, bytes).map_err(failed)?;
    }
    Ok(())
}

/// Writes a file beside its place and puts it there in one step: a reader sees the former one or the new one, whole.
pub(super) fn replace_file(place: &Path, bytes: &[u8]) -> io::Result<()> {
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
pub(super) fn write_new(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::OpenOptions::new().write(true).create_new(true).open(path)?;
    let done = file.write_all(bytes);
    if done.is_err() {
        // Half a file would stand in the way of the next try; that it cannot be removed either changes nothing.
        let _ = fs::remove_file(path);
    }
    done
}
