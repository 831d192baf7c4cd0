//! Writes `docs/reproduction.md`: figures of arXiv 2103.04423 beside ours.
//!
//! Run it as `FLEXFRAME_DATA=<folder> cargo run --release --example reproduction`. The measured drops carry no licence and
//! are not part of the repository: they are read from `crash_landing` in that folder (default `../shared/data`), and only
//! figures are written down.

#[path = "../tests/impact/paper/mod.rs"]
#[allow(dead_code)] // The tests use the rest of it.
mod paper;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = paper::folder();
    if !folder.is_dir() {
        return Err(std::io::Error::other(format!("no folder {}: set FLEXFRAME_DATA", folder.display())));
    }
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reproduction.md"), paper::page())
}
