//! Frames by name, file or pattern.

use std::collections::BTreeSet;

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
            let real = std::fs::canonicalize(&frame).unwrap_or_else(|_| frame.clone().into());
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
    name.contains(['*', '?', '[']) && !std::path::Path::new(name).exists()
}

fn matches(pattern: &str) -> Result<Vec<String>, Failure> {
    let usage = |message: String| Failure::Usage { message };
    let paths = glob::glob(pattern).map_err(|error| usage(format!("`{pattern}` is no pattern of files: {error}")))?;
    let mut found = Vec::new();
    for path in paths.take(MOST_FRAMES + 1) {
        let path = path.map_err(|error| Failure::Machine { what: format!("cannot look for {pattern}"), error: error.into() })?;
        // A link that leads nowhere stays: reading it says so.
        if !path.is_dir() {
            found.push(path.to_str().map(String::from).ok_or_else(|| usage(format!("{} is not UTF-8", path.display())))?);
        }
    }
    if found.is_empty() {
        return Err(usage(format!("no file matches `{pattern}`")));
    }
    Ok(found)
}
