//! Ctrl-C, and being asked to end: a search ends with the best so far; everything else leaves nothing unfinished behind.
//!
//! The second Ctrl-C ends a search at once, too. Results are put in place by a rename, so an interruption leaves the former result
//! or the new one.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;

/// Whether somebody finishes in order when asked to end, and whether that was asked.
static HEARD: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);
/// Hidden folders in which results are being made.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Listens from now on. Where that is not possible, an interruption ends the program as it ends any other.
pub(super) fn listen() {
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            if HEARD.load(Ordering::SeqCst) && !ASKED.swap(true, Ordering::SeqCst) {
                continue;
            }
            remove_unfinished();
            // What a shell expects of a program that a signal ended.
            std::process::exit(128 + signal);
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

/// A folder in which a result is being made: an interruption removes it.
pub(super) fn unfinished(folder: &Path) {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_path_buf());
}

/// A folder that is in its place, or gone.
pub(super) fn finished(folder: &Path) {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner).remove(folder);
}

/// The main thread may still write: what it adds while a folder is removed is removed by another try.
fn remove_unfinished() {
    let folders = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
    for folder in folders.iter() {
        for _ in 0..10 {
            if std::fs::remove_dir_all(folder).is_ok() || !folder.exists() {
                break;
            }
        }
    }
}
