//! What the program wrote into a folder, file by file with its hash, as the folder itself states it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::export::manifest::{hash, list_text, listed};

/// The record of a folder that has no manifest.
pub(super) const RECORD: &str = ".written.json";

/// The manifest of a build, which lists the folder's other files.
pub(super) const MANIFEST: &str = "manifest.json";

/// Whether a path is that of a list of what the program wrote.
pub(super) fn is_list(path: &Path) -> bool {
    [RECORD, MANIFEST].iter().any(|list| Path::new(list) == path)
}

/// Hashes of the files that were written into a folder, by path: several where files are being replaced.
#[derive(Debug, Default)]
pub(super) struct Record(BTreeMap<String, BTreeSet<String>>);

impl Record {
    /// What a folder says of itself; empty where it says nothing. A list that was changed by hand is not one of its own files.
    pub fn read(folder: &Path) -> Self {
        [RECORD, MANIFEST].iter().find_map(|name| Self::of_file(folder, name)).unwrap_or_default()
    }

    fn of_file(folder: &Path, name: &str) -> Option<Self> {
        let bytes = content(&folder.join(name)).ok()?;
        let text = std::str::from_utf8(&bytes).ok()?;
        let (listed, whole) = listed(text)?;
        let itself = whole.then(|| (name.to_string(), hash(&bytes)));
        let mut hashes: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (path, digest) in listed.into_iter().chain(itself) {
            hashes.entry(path).or_default().insert(digest);
        }
        Some(Self(hashes))
    }

    /// The record that goes with these files; `None` where a manifest among them is one.
    pub fn file_for(files: &[(String, Vec<u8>)]) -> io::Result<Option<Vec<u8>>> {
        if files.iter().any(|(path, _)| path == MANIFEST) {
            return Ok(None);
        }
        Self::list_of(files).map(Some)
    }

    /// The record of these files.
    pub fn list_of(files: &[(String, Vec<u8>)]) -> io::Result<Vec<u8>> {
        Ok(list_text(hashes(files))?.into_bytes())
    }

    /// The record while these files take the place of those that were recorded: one that is interrupted names both.
    pub fn while_replaced_by(&self, files: &[(String, Vec<u8>)]) -> io::Result<Vec<u8>> {
        let former = self.0.iter().filter(|(path, _)| !is_list(Path::new(path)));
        let former = former.flat_map(|(path, hashes)| hashes.iter().map(|digest| (path.clone(), digest.clone())));
        let both: BTreeSet<(String, String)> = former.chain(hashes(files)).collect();
        Ok(list_text(both)?.into_bytes())
    }

    /// Whether the program wrote something at this path.
    pub fn names(&self, path: &Path) -> bool {
        path.to_str().is_some_and(|path| self.0.contains_key(path))
    }

    /// Whether a file below a folder is one that the program wrote, unchanged.
    pub fn is_ours(&self, folder: &Path, path: &Path) -> bool {
        let Some(stated) = path.to_str().and_then(|path| self.0.get(path)) else { return false };
        let is_file = fs::symlink_metadata(folder.join(path)).is_ok_and(|found| found.is_file());
        is_file && content(&folder.join(path)).is_ok_and(|bytes| stated.contains(&hash(&bytes)))
    }

    /// Whether the program made this folder for a file of its own.
    pub fn made_folder(&self, path: &Path) -> bool {
        self.0.keys().any(|file| Path::new(file) != path && Path::new(file).starts_with(path))
    }
}

/// Paths of files with their hashes.
fn hashes(files: &[(String, Vec<u8>)]) -> impl Iterator<Item = (String, String)> {
    files.iter().map(|(path, bytes)| (path.clone(), hash(bytes)))
}

/// Bytes of a regular file; a link is not followed, a pipe not waited for.
pub(super) fn content(path: &Path) -> io::Result<Vec<u8>> {
    let found = fs::symlink_metadata(path)?;
    if !found.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.read_to_end(&mut bytes)?;
    Ok(bytes)
}
