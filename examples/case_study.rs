//! Writes `docs/case-study.md`: what `diagnose` finds on the real drops.
//!
//! Run it as `FLEXFRAME_DATA=<folder> cargo run --release --example case_study`. The measured drops carry no licence and
//! are not part of the repository: they are read from `crash_landing` in that folder (default `../shared/data`), and only
//! figures are written down.

#[path = "../tests/impact/case/mod.rs"]
mod case;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = case::folder();
    if !folder.is_dir() {
        return Err(std::io::Error::other(format!("no folder {}: set FLEXFRAME_DATA", folder.display())));
    }
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/case-study.md"), case::Study::made().page())
}
