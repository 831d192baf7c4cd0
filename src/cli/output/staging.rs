//! The hidden folder beside its place in which a result is made, `.NAME.PID.new`, and in which the former result is taken apart,
//! `.NAME.PID.old`.
//!
//! Whether the run that made such a folder still goes on is told by a lock that the run holds on it. The kernel takes the lock
//! away when the process ends, however it ends; so neither a process number that was given again nor a number on another host or in
//! a container misleads. Where folders cannot be locked (some network disks, systems other than Unix), hidden folders of killed runs
//! stay.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::folder::{self, identity};
use super::former::{self, State};
use super::hidden_name::{names, too_many};
use super::record::{MANIFEST, RECORD};
use crate::cli::interrupt;

/// How long another run is waited for that is putting its result into the same place; longer, and it is taken for stopped.
const LONGEST_WAIT: Duration = Duration::from_secs(10);

/// A lock on a folder, where folders can be locked; held until it is dropped.
#[derive(Debug)]
pub(super) struct Lock {
    _held: Option<File>,
}

impl Lock {
    /// Waits for the runs that replace a folder now, though not for ever.
    pub fn wait_for(place: &Path) -> Self {
        let begun = Instant::now();
        loop {
            let Ok(folder) = File::open(place) else { return Self { _held: None } };
            match folder.try_lock() {
                // Only a lock on what is there now counts.
                Ok(()) if is_at(&folder, place) => return Self { _held: Some(folder) },
                Err(TryLockError::Error(_)) => return Self { _held: None },
                _ if begun.elapsed() > LONGEST_WAIT => return Self { _held: None },
                _ => sleep(Duration::from_millis(5)),
            }
        }
    }
}

/// Whether an open folder is the one at a path.
fn is_at(folder: &File, path: &Path) -> bool {
    let there = fs::symlink_metadata(path).ok().and_then(|is| identity(&is));
    folder.metadata().ok().and_then(|is| identity(&is)) == there
}

/// A folder in which a result is made.
#[derive(Debug)]
pub(super) struct Staging {
    /// Where it is.
    pub path: PathBuf,
    _lock: Lock,
}

impl Staging {
    /// Makes an empty one.
    pub fn beside(place: &Path) -> io::Result<Self> {
        for path in names(place, "new") {
            match interrupt::make_unfinished(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                made => made?,
            }
            // Another run may take it for a left one until it is locked.
            match File::open(&path) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                Err(_) => return Ok(Self::locked(path, None)),
                Ok(folder) => match folder.try_lock() {
                    Ok(()) if !is_at(&folder, &path) => {}
                    Err(TryLockError::WouldBlock) => {}
                    Ok(()) => return Ok(Self::locked(path, Some(folder))),
                    Err(TryLockError::Error(_)) => return Ok(Self::locked(path, None)),
                },
            }
            interrupt::finished(&path);
        }
        Err(too_many())
    }

    fn locked(path: PathBuf, held: Option<File>) -> Self {
        Self { path, _lock: Lock { _held: held } }
    }

    /// Exchanges it for the folder in its place: at every moment there is a whole one, where the system can. Says where the former
    /// one is then.
    pub fn exchange(&self, place: &Path) -> io::Result<PathBuf> {
        // From here on its name says that it is no unfinished one.
        let former = names(place, "old").find(|former| moved(&self.path, former)).ok_or_else(too_many)?;
        let done = exchange(&former, place).and_then(|at_once| match at_once {
            true => Ok(()),
            false => fs::rename(&former, &self.path).and_then(|()| self.exchange_by_turns(place, &former)),
        });
        if let Err(error) = done {
            // The caller removes what is at the path.
            let _ = fs::rename(&former, &self.path);
            return Err(error);
        }
        Ok(former)
    }

    /// Exchanges where no call does it at once: for a moment nothing is in the place. A run that is killed then leaves the former
    /// folder under a name by which the next run knows it.
    fn exchange_by_turns(&self, place: &Path, former: &Path) -> io::Result<()> {
        fs::rename(place, former)?;
        fs::rename(&self.path, place).inspect_err(|_| {
            // Should this fail, too, the next run does it.
            let _ = fs::rename(former, place);
        })
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        interrupt::finished(&self.path);
    }
}

/// Exchanges two folders at once; `false` where the system cannot.
#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<bool> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    match renameat_with(CWD, a, CWD, b, RenameFlags::EXCHANGE) {
        // Some network file systems do not know how.
        Err(rustix::io::Errno::INVAL | rustix::io::Errno::NOSYS | rustix::io::Errno::NOTSUP) => Ok(false),
        done => Ok(done.map(|()| true)?),
    }
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<bool> {
    Ok(false)
}

/// Moves a folder to a name, unless something is there.
fn moved(folder: &Path, name: &Path) -> bool {
    name.symlink_metadata().is_err() && fs::rename(folder, name).is_ok()
}

/// What a hidden folder is by its name, when it is one of a place's.
fn state_of(name: &str, place: &str) -> Option<State> {
    let (number, end) = name.strip_prefix('.')?.strip_prefix(place)?.strip_prefix('.')?.split_once('.')?;
    let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'-');
    match end {
        "new" if is_number => Some(State::Unfinished),
        "old" if is_number => Some(State::WasInPlace),
        _ => None,
    }
}

/// Removes the hidden folders of runs that are no more. Says what of the user's was found in them, or what cannot be removed.
pub(super) fn clear_left(place: &Path) -> Vec<String> {
    let beside = place.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let own = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let names = fs::read_dir(beside).into_iter().flatten().flatten().map(|entry| entry.file_name());
    let mut left: Vec<(PathBuf, State)> = names.filter_map(|name| Some((beside.join(&name), state_of(name.to_str()?, &own)?))).collect();
    // What was in its place goes back there first.
    left.sort_by_key(|(path, state)| (*state == State::Unfinished, path.clone()));
    let mut notes = Vec::new();
    for (path, state) in left {
        match clear(&path, place, state) {
            Ok(more) => notes.extend(more),
            Err(error) => notes.push(format!("{} is left from a run that was killed and cannot be removed: {error}", path.display())),
        }
    }
    notes
}

fn clear(hidden: &Path, place: &Path, state: State) -> io::Result<Vec<String>> {
    let is_folder = hidden.symlink_metadata().is_ok_and(|is| is.is_dir());
    let Some(folder) = File::open(hidden).ok().filter(|_| is_folder) else { return Ok(Vec::new()) };
    if folder.try_lock().is_err() || !is_at(&folder, hidden) {
        return Ok(Vec::new());
    }
    let nothing_there = place.symlink_metadata().is_err();
    match state {
        // It was killed between the two steps of an exchange.
        State::WasInPlace if nothing_there => fs::rename(hidden, place).map(|()| Vec::new()),
        // What was never in place, and has no place to link anything from, is the program's alone.
        State::Unfinished if nothing_there && is_named(hidden) => folder::remove(hidden).map(|()| Vec::new()),
        State::Unfinished if !is_named(hidden) => fs::remove_dir(hidden).map(|()| Vec::new()),
        _ => former::clear(hidden, place, state),
    }
}

/// Whether a folder holds a list of what the program writes: that is the first file that a run makes.
fn is_named(folder: &Path) -> bool {
    [RECORD, MANIFEST].iter().any(|list| folder.join(list).symlink_metadata().is_ok())
}
