//! Ctrl-C, and being asked to end: a search ends with the best so far, a study between rows; everything else leaves nothing unfinished
//! behind.
//!
//! The second Ctrl-C ends those at once, too. Results are put in place by a rename, so an interruption leaves the former result
//! or the new one.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError, RwLock, RwLockReadGuard};

use signal_hook::consts::{SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::iterator::Signals;

/// Whether somebody finishes in order when asked to end, and the signal that asked for it.
static HEARD: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicI32 = AtomicI32::new(NOTHING);
/// No signal has this number.
const NOTHING: i32 = 0;
/// Hidden folders in which results are being made.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Held for reading over each step that writes into an unfinished folder, and for writing by the end of the program.
static STEPS: RwLock<()> = RwLock::new(());

/// Listens from now on. Where that is not possible, an interruption ends the program as it ends any other.
///
/// A file beyond the limit on their size is an error of the write, as a full disk is, once somebody listens to its signal.
pub(super) fn listen() {
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM, SIGXFSZ]) else { return };
    std::thread::spawn(move || {
        for signal in signals.forever().filter(|signal| *signal != SIGXFSZ) {
            if HEARD.load(Ordering::SeqCst) && ASKED.swap(signal, Ordering::SeqCst) == NOTHING {
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
        ASKED.store(NOTHING, Ordering::SeqCst);
        HEARD.store(true, Ordering::SeqCst);
        Self
    }

    /// Whether it was asked to end.
    pub fn is_asked(&self) -> bool {
        self.exit_code().is_some()
    }

    /// The exit code of a command that was asked to end and has not done its work.
    pub fn exit_code(&self) -> Option<u8> {
        match ASKED.load(Ordering::SeqCst) {
            NOTHING => None,
            signal => u8::try_from(code_of(signal)).ok(),
        }
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

/// One step of writing a result, which an interruption waits for.
pub(super) struct Step {
    _held: RwLockReadGuard<'static, ()>,
}

impl Step {
    /// Begins it; waits for the end of the program where that was asked for.
    pub fn begin() -> Self {
        Self { _held: STEPS.read().unwrap_or_else(PoisonError::into_inner) }
    }
}

/// Removes what is unfinished and ends the program. The steps that have begun end first; no step and no folder begins after them.
fn end(signal: i32) -> ! {
    let _steps = STEPS.write().unwrap_or_else(PoisonError::into_inner);
    let folders = all_unfinished();
    for folder in folders.iter() {
        // Where one cannot be removed, the next run tries it.
        let _ = fs::remove_dir_all(folder);
    }
    std::process::exit(code_of(signal));
}

/// What a shell expects of a program that a signal ended.
fn code_of(signal: i32) -> i32 {
    128 + signal
}
