//! Ctrl-C, and being asked to end: a search ends with the best so far; everything else leaves nothing unfinished behind.
//!
//! The second Ctrl-C ends a search at once, too. Results are put in place by a rename, so an interruption leaves the former result
//! or the new one.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// Whether somebody finishes in order when asked to end, and whether that was asked.
static HEARD: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);
/// Hidden folders in which results are being made.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// How often it is tried to remove a folder into which another thread writes.
const TRIES: usize = 50;

/// Listens from now on. Where that is not possible, an interruption ends the program as it ends any other.
pub(super) fn listen() {
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            if HEARD.load(Ordering::SeqCst) && !ASKED.swap(true, Ordering::SeqCst) {
                continue;
            }
            end(signal);
        }
    });
}

/// Work that finishes in order when it is asked to end, for as long as this lives.
pub(super) struct Finishing;

impl Finishing {
    /// From now on the first Ctrl-C is a wish.
    pub fn begin() -> Self {
        ASKED.store(false, Ordering::SeqCst);
        HEARD.store(true, Ordering::SeqCst);
        Self
    }

    /// Whether it was asked to end.
    pub fn is_asked(&self) -> bool {
        ASKED.load(Ordering::SeqCst)
    }
}

impl Drop for Finishing {
    fn drop(&mut self) {
        HEARD.store(false, Ordering::SeqCst);
    }
}

/// Makes a folder for a result; an interruption removes it, also one that comes while it is made.
pub(super) fn make_unfinished(folder: &Path) -> io::Result<()> {
    let mut folders = all_unfinished();
    fs::create_dir(folder)?;
    folders.insert(folder.to_path_buf());
    Ok(())
}

/// A folder that is in its place, or gone.
pub(super) fn finished(folder: &Path) {
    all_unfinished().remove(folder);
}

fn all_unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is unfinished and ends the program. Until then nothing new is begun, and a thread that fails to write into a
/// removed folder waits in [`finished`].
fn end(signal: i32) -> ! {
    let folders = all_unfinished();
    folders.iter().for_each(|folder| remove(folder));
    // What a shell expects of a program that a signal ended.
    std::process::exit(128 + signal);
}

/// Another thread may be writing into the folder: it is renamed first, so that only what was being written, or a folder made anew with it,
/// needs another try.
fn remove(folder: &Path) {
    let renamed = renamed(folder);
    for _ in 0..TRIES {
        let _ = fs::rename(folder, &renamed);
        // Where one cannot be removed, the next run tries it.
        for there in [folder, &renamed] {
            let _ = fs::remove_dir_all(there);
        }
        if !folder.exists() && !renamed.exists() {
            break;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// By this name, too, another run knows it for an unfinished one, should this one be killed now.
fn renamed(folder: &Path) -> PathBuf {
    folder.with_file_name(format!("{}-0.new", folder.file_stem().unwrap_or_default().to_string_lossy()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_what_was_written_while_it_was_removed_is_removed_too() {
        let place = tempfile::tempdir().expect("is made");
        let folder = place.path().join(".frame.7.new");
        // As after a first try that a file came into: the folder has its other name, and is not empty.
        fs::create_dir_all(renamed(&folder).join("parts")).expect("is made");
        remove(&folder);
        assert_eq!(fs::read_dir(place.path()).expect("is there").count(), 0);
        // As after a file that was written anew by the first name.
        for there in [renamed(&folder), folder.clone()] {
            fs::create_dir_all(there.join("parts")).expect("is made");
        }
        remove(&folder);
        assert_eq!(fs::read_dir(place.path()).expect("is there").count(), 0);
    }
}
