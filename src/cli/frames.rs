//! Frames by name, file or pattern.

use std::collections::BTreeSet;
use std::fs::{self, DirEntry};
use std::path::{Path, PathBuf};

use super::failure::Failure;

/// Most frames that one command takes.
const MOST_FRAMES: usize = 1000;

/// The frames of the command line: patterns become the files that they match, in alphabetical order; the rest stays as it is.
/// Each frame stands once.
///
/// # Errors
/// When a pattern is none, or matches nothing.
pub(super) fn expand(asked: &[String]) -> Result<Vec<String>, Failure> {
    let mut frames: Vec<String> = Vec::new();
    let mut known = BTreeSet::new();
    for name in asked {
        let found = if is_pattern(name) { matches(name)? } else { vec![name.clone()] };
        for frame in found {
            let real = fs::canonicalize(&frame).unwrap_or_else(|_| frame.clone().into());
            if known.insert(real) {
                frames.push(frame);
            }
        }
        if frames.len() > MOST_FRAMES {
            return Err(Failure::Usage { message: format!("more than {MOST_FRAMES} frames at once: give a narrower pattern") });
        }
    }
    Ok(frames)
}

/// A file may have brackets in its name; then it is no pattern.
fn is_pattern(name: &str) -> bool {
    name.contains(['*', '?', '[']) && !Path::new(name).exists()
}

fn matches(pattern: &str) -> Result<Vec<String>, Failure> {
    let usage = |message: String| Failure::Usage { message };
    let paths = glob::glob(pattern).map_err(|error| usage(format!("`{pattern}` is no pattern of files: {error}")))?;
    let mut found = Vec::new();
    for path in paths.take(MOST_FRAMES + 1) {
        let path = path.map_err(|error| Failure::Machine { what: format!("cannot look for {pattern}"), error: error.into() })?;
        // A link that leads nowhere stays: reading it says so.
        if !path.is_dir() {
            found.push(path.to_str().map(String::from).ok_or_else(|| usage(not_utf8(&path)))?);
        }
    }
    if let Some(path) = passed_over(Path::new(""), &parts(pattern)) {
        return Err(usage(not_utf8(&path)));
    }
    if found.is_empty() {
        return Err(usage(format!("no file matches `{pattern}`")));
    }
    Ok(found)
}

fn not_utf8(path: &Path) -> String {
    format!("the name {} is not UTF-8; rename it", path.display())
}

/// What stands for any number of folders.
const ANY_FOLDERS: &str = "**";

/// The names in a pattern, from the outermost folder on.
fn parts(pattern: &str) -> Vec<&str> {
    let mut parts: Vec<&str> = Path::new(pattern).components().filter_map(|part| part.as_os_str().to_str()).collect();
    parts.dedup_by(|a, b| *a == ANY_FOLDERS && a == b);
    parts
}

/// A file that a pattern matches as it is shown, and whose path is not UTF-8: the crate glob passes over such names without a word. A
/// folder that cannot be read has none; glob has told of it.
fn passed_over(folder: &Path, parts: &[&str]) -> Option<PathBuf> {
    let (part, rest) = parts.split_first()?;
    if *part == ANY_FOLDERS {
        // A link may lead back, and is not followed here.
        let is_folder = |entry: &DirEntry| entry.file_type().is_ok_and(|found| found.is_dir());
        let deeper = || listed(folder, is_folder).iter().find_map(|inner| passed_over(inner, parts));
        return passed_over(folder, rest).or_else(deeper);
    }
    let found = match part.contains(['*', '?', '[']).then(|| glob::Pattern::new(part)) {
        None => vec![folder.join(part)],
        Some(Err(_)) => return None,
        Some(Ok(names)) => listed(folder, |entry| names.matches(&entry.file_name().to_string_lossy())),
    };
    let is_one = |path: &PathBuf| path.to_str().is_none() && path.symlink_metadata().is_ok() && !path.is_dir();
    match rest {
        [] => found.into_iter().find(is_one),
        _ => found.iter().find_map(|inner| passed_over(inner, rest)),
    }
}

/// What is wanted of a folder, in the order of the names.
fn listed(folder: &Path, is_wanted: impl Fn(&DirEntry) -> bool) -> Vec<PathBuf> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let entries = fs::read_dir(here).into_iter().flatten().flatten().filter(is_wanted);
    let mut paths: Vec<PathBuf> = entries.map(|entry| folder.join(entry.file_name())).collect();
    paths.sort();
    paths
}
