//! Paths to records: files and folders, mixed, on the disk.

use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::file_format::FileFormat;
use super::file_kind::FileKind;
use super::logger;
use super::malformed::{Fault, Malformed, SourcePosition};
use super::reading::{self, known_kind, malformed};
use super::record::DropSet;

/// Folders within folders that are looked into.
const DEPTH: usize = 4;

/// Files that were found.
#[derive(Default)]
struct Found {
    files: Vec<(PathBuf, FileKind)>,
    others: usize,
}

fn unreadable(path: &Path, error: &std::io::Error) -> Malformed {
    malformed(path, SourcePosition::Whole, Fault::Unreadable { why: error.to_string(), kind: error.kind() })
}

/// Reads every record of files and folders; in folders, files that are none are left aside.
///
/// # Errors
/// The first file, in order of the paths and of names, that is no record though it should be one.
pub fn read(paths: &[PathBuf], format: &FileFormat) -> Result<DropSet, Malformed> {
    let mut found = Found::default();
    for path in paths {
        let meta = fs::metadata(path).map_err(|error| unreadable(path, &error))?;
        if meta.is_dir() {
            let before = found.files.len();
            walk(path, DEPTH, &mut found)?;
            if found.files.len() == before {
                return Err(malformed(path, SourcePosition::Whole, Fault::NoRecords { others: found.others }));
            }
        } else {
            let kind = known_kind(path)?;
            found.files.push((path.clone(), kind));
        }
    }
    // A file that is named twice, or once with its folder, is one drop.
    let mut seen = std::collections::BTreeSet::new();
    found.files.retain(|(path, _)| seen.insert(fs::canonicalize(path).unwrap_or_else(|_| path.clone())));
    let all = found.files.par_iter().map(|(path, kind)| read_file(path, *kind, format)).collect::<Vec<_>>();
    let mut set = reading::gathered(all)?;
    if found.others > 0 {
        set.notes.push(format!("{} other files in the folders were left aside", found.others));
    }
    Ok(set)
}

/// Records of a folder, those in its folders, too; sorted by name, hidden ones left out.
fn walk(folder: &Path, depth: usize, found: &mut Found) -> Result<(), Malformed> {
    let entries = fs::read_dir(folder).map_err(|error| unreadable(folder, &error))?;
    let mut paths = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>, _>>().map_err(|error| unreadable(folder, &error))?;
    paths.sort();
    for path in paths {
        let hidden = path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if hidden {
            continue;
        }
        if path.is_dir() {
            if depth > 0 {
                walk(&path, depth - 1, found)?;
            }
            continue;
        }
        match FileKind::of(&path) {
            Some(kind) => found.files.push((path, kind)),
            None => found.others += 1,
        }
    }
    Ok(())
}

/// Reads a file, not more of it than a record can have.
pub(super) fn bytes_of(path: &Path, most: u64) -> Result<Vec<u8>, Malformed> {
    let meta = fs::metadata(path).map_err(|error| unreadable(path, &error))?;
    if !meta.is_file() {
        // A pipe or a device may never end.
        return Err(malformed(path, SourcePosition::Whole, Fault::Foreign { what: "no file".into() }));
    }
    if meta.len() > most {
        return Err(malformed(path, SourcePosition::Whole, Fault::Huge { bytes: meta.len(), most }));
    }
    fs::read(path).map_err(|error| unreadable(path, &error))
}

/// The name of the folder that a file lies in: as it was given where that says frame and height, or else without links.
fn folder_of(path: &Path) -> String {
    let name = |folder: PathBuf| folder.file_name().map(|name| name.to_string_lossy().into_owned());
    let parent = std::path::absolute(path).ok().and_then(|path| path.parent().map(Path::to_path_buf)).unwrap_or_default();
    let given = name(parent.clone()).filter(|name| logger::frame_and_height(name).is_some());
    given.or_else(|| name(fs::canonicalize(parent).ok()?)).unwrap_or_default()
}

fn read_file(path: &Path, kind: FileKind, format: &FileFormat) -> Result<reading::Read, Malformed> {
    reading::records(path, kind, &folder_of(path), format, || bytes_of(path, kind.most_bytes()))
}
