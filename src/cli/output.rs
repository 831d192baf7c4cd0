//! A folder that is written whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::session::Failure;

/// Writes a folder beside its place and renames it there, so that a run that is killed or fails leaves the last
/// good result.
pub(super) fn write_folder(parent: &Path, name: &str, files: &[(String, Vec<u8>)]) -> Result<PathBuf, Failure> {
    let place = parent.join(name);
    let staging = parent.join(format!(".{name}.{}.new", std::process::id()));
    let former = parent.join(format!(".{name}.{}.old", std::process::id()));
    let failed = |what: &str, path: &Path| {
        let what = format!("cannot {what} {}", path.display());
        move |error: io::Error| Failure::Machine { what, error }
    };
    fs::create_dir_all(parent).map_err(failed("make the folder", parent))?;
    let written = write_files(&staging, files);
    if let Err(error) = written {
        // The half-written folder is of no use; that it cannot be removed either changes nothing.
        let _ = fs::remove_dir_all(&staging);
        return Err(error);
    }
    if place.exists() {
        fs::rename(&place, &former).map_err(failed("replace", &place))?;
    }
    if let Err(error) = fs::rename(&staging, &place) {
        let _ = fs::rename(&former, &place);
        return Err(failed("write", &place)(error));
    }
    if former.exists() {
        fs::remove_dir_all(&former).map_err(failed("remove", &former))?;
    }
    Ok(place)
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
