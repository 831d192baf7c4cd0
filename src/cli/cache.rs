//! Findings of frames that were held before, kept on disk.
//!
//! A slot holds one frame's findings with the hash of all that they depend on, the program included, and a hash of itself;
//! what does not agree is not used. There are 256 slots of some 100 kB, a newer frame takes an older one's. Nothing here
//! can make a command fail: without a folder, or when it cannot be read or written, findings are made anew.

use std::fs;
use std::io;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::output;
use crate::checks::Finding;
use crate::export::fingerprint;
use crate::frame::assembly::mass::MassTable;
use crate::params::Frame;
use crate::params::frame_file::read_source;

/// What is kept of a frame.
#[derive(Serialize, Deserialize)]
pub(super) struct Kept {
    /// Its findings.
    pub findings: Vec<Finding>,
    /// Its masses.
    pub masses: MassTable,
}

/// Where findings are kept.
pub(super) struct Cache {
    folder: Option<PathBuf>,
}

impl Cache {
    /// The user's folder, unless there is none or it is not wanted.
    pub fn new(wanted: bool) -> Self {
        Self { folder: if wanted { folder() } else { None } }
    }

    /// What was kept of a frame by this program.
    pub fn get(&self, frame: &Frame) -> Option<Kept> {
        let key = fingerprint::of(frame);
        let (_, source) = read_source(self.slot(&key)?).ok()?;
        let (head, body) = source.text.split_once('\n')?;
        if head != format!("{key} {}", fingerprint::of_text(body)) {
            return None;
        }
        serde_json::from_str(body).ok()
    }

    /// Keeps what was found of a frame.
    pub fn put(&self, frame: &Frame, kept: &Kept) {
        let key = fingerprint::of(frame);
        let (Some(slot), Ok(body)) = (self.slot(&key), serde_json::to_string(kept)) else { return };
        let text = format!("{key} {}\n{body}", fingerprint::of_text(&body));
        // A cache that cannot be written is none.
        let _ = write(&slot, &text);
    }

    fn slot(&self, key: &str) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join(format!("{}.json", &key[..2])))
    }
}

fn write(slot: &std::path::Path, text: &str) -> io::Result<()> {
    if let Some(parent) = slot.parent() {
        fs::create_dir_all(parent)?;
    }
    output::replace_file(slot, text.as_bytes())
}

/// `FLEXFRAME_CACHE`, or the folder that the system has for such things; `off` and an empty name are none.
fn folder() -> Option<PathBuf> {
    let named = |variable: &str| std::env::var_os(variable).map(PathBuf::from);
    let folder = match named("FLEXFRAME_CACHE") {
        Some(folder) if folder.as_os_str() == "off" => return None,
        Some(folder) => folder,
        None => match (named("XDG_CACHE_HOME").filter(|path| path.is_absolute()), named("HOME")) {
            (Some(folder), _) => folder.join("flexframe"),
            (None, Some(home)) => home.join(".cache/flexframe"),
            (None, None) => return None,
        },
    };
    folder.is_absolute().then_some(folder)
}
