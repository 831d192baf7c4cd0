//! What the program wrote into a folder, file by file with its hash, as the folder itself states it.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::export::manifest::{FileEntry, is_signed, sha256, signed_text};

/// The record of a folder that has no manifest.
pub(super) const RECORD: &str = ".written.json";

/// The manifest of a build, which lists the folder's other files.
pub(super) const MANIFEST: &str = "manifest.json";

/// Form of [`RECORD`]; a manifest has these keys, too.
#[derive(Serialize, Deserialize)]
struct Listed {
    schema_version: u32,
    files: Vec<FileEntry>,
    /// Manifests of former versions have none.
    #[serde(default)]
    own_sha256: Option<String>,
}

/// Whether a path is that of a list of what the program wrote.
pub(super) fn is_list(path: &Path) -> bool {
    [RECORD, MANIFEST].iter().any(|list| Path::new(list) == path)
}

/// Hashes of the files that were written into a folder, by path.
#[derive(Debug, Default)]
pub(super) struct Record(BTreeMap<String, String>);

impl Record {
    /// What a folder says of itself; empty where it says nothing. A list that was changed by hand is not one of its own files.
    pub fn read(folder: &Path) -> Self {
        [RECORD, MANIFEST].iter().find_map(|name| Self::of_file(folder, name)).unwrap_or_default()
    }

    fn of_file(folder: &Path, name: &str) -> Option<Self> {
        let bytes = content(&folder.join(name)).ok()?;
        let text = std::str::from_utf8(&bytes).ok()?;
        let listed: Listed = serde_json::from_str(text).ok()?;
        let mut hashes: BTreeMap<String, String> = listed.files.into_iter().map(|file| (file.path, file.sha256)).collect();
        if listed.own_sha256.is_none_or(|own| is_signed(text, &own)) {
            hashes.insert(name.into(), sha256(&bytes));
        }
        Some(Self(hashes))
    }

    /// The record that goes with these files; `None` where a manifest among them is one.
    pub fn file_for(files: &[(String, Vec<u8>)]) -> io::Result<Option<Vec<u8>>> {
        if files.iter().any(|(path, _)| path == MANIFEST) {
            return Ok(None);
        }
        let listed = files.iter().map(|(path, bytes)| FileEntry { path: path.clone(), sha256: sha256(bytes) }).collect();
        let text = signed_text(&Listed { schema_version: 1, files: listed, own_sha256: Some(String::new()) })?;
        Ok(Some(text.into_bytes()))
    }

    /// Whether the program wrote something at this path.
    pub fn names(&self, path: &Path) -> bool {
        path.to_str().is_some_and(|path| self.0.contains_key(path))
    }

    /// Whether a file below a folder is one that the program wrote, unchanged.
    pub fn is_ours(&self, folder: &Path, path: &Path) -> bool {
        let Some(stated) = path.to_str().and_then(|path| self.0.get(path)) else { return false };
        let is_file = fs::symlink_metadata(folder.join(path)).is_ok_and(|found| found.is_file());
        is_file && content(&folder.join(path)).is_ok_and(|bytes| sha256(&bytes) == *stated)
    }

    /// Whether the program made this folder for a file of its own.
    pub fn made_folder(&self, path: &Path) -> bool {
        self.0.keys().any(|file| Path::new(file) != path && Path::new(file).starts_with(path))
    }
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
