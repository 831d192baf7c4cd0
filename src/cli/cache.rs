//! Results of steps, kept on disk from one command to the next.
//!
//! Each result is a file, named by the key of its step and inputs; it begins with a hash of this program and of the file's own
//! content, and one that does not agree is not used. Files are put in place whole, so commands may run side by side and be ended at
//! any time. Of the sixteen folders a command looks through one at its end, and drops the oldest beyond the folder's share of the
//! room. Nothing here can make a command fail: what cannot be read or written is computed.

use std::any::TypeId;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::options::Common;
use super::output;
use crate::memo::{Key, Memo, PROGRAM, Storage};
use crate::params::files::{Disk, Files};

/// Room for all results, bytes.
const ROOM: u64 = 256 << 20;
/// Folders that share it.
const FOLDERS: u64 = 16;
/// Largest result, bytes.
const LARGEST: u64 = 16 << 20;

/// A memo that keeps results on disk, unless that is not wanted or there is no place for them.
pub(super) fn memo(common: &Common) -> Arc<Memo> {
    let folder = if common.no_cache { None } else { folder() };
    Arc::new(folder.map_or_else(Memo::default, |folder| Memo::on(Box::new(Cache { folder, last: Mutex::default() }))))
}

/// The folder of results.
struct Cache {
    folder: PathBuf,
    /// Where something was put last.
    last: Mutex<Option<PathBuf>>,
}

impl Storage for Cache {
    fn read(&self, key: &Key) -> Option<Vec<u8>> {
        let mut bytes = Disk.bytes(&self.place(key), LARGEST).ok().filter(|bytes| bytes.len() >= HEAD)?;
        let content = bytes.split_off(HEAD);
        (bytes == head(&content)).then_some(content)
    }

    fn write(&self, key: &Key, content: &[u8]) {
        if content.len() as u64 + HEAD as u64 > LARGEST {
            return;
        }
        let place = self.place(key);
        let Some(folder) = place.parent() else { return };
        let bytes = [head(content).as_slice(), content].concat();
        let written = output::replace_file(&place, &bytes);
        // The folder is made when it is missing, not looked for each time.
        let written = written.or_else(|_| fs::create_dir_all(folder).and_then(|()| output::replace_file(&place, &bytes)));
        if written.is_ok() {
            *self.last.lock().unwrap_or_else(PoisonError::into_inner) = Some(folder.to_path_buf());
        }
    }
}

impl Cache {
    fn place(&self, key: &Key) -> PathBuf {
        let name = format!("{key:?}");
        self.folder.join(&name[..1]).join(name)
    }
}

impl Drop for Cache {
    fn drop(&mut self) {
        let last = self.last.lock().unwrap_or_else(PoisonError::into_inner).take();
        last.iter().for_each(|folder| trim(folder, ROOM / FOLDERS));
    }
}

/// Characters of a key.
const KEY: usize = 32;

/// Bytes of a head: a key.
const HEAD: usize = KEY;

/// What a file begins with: this program, its libraries and the content, hashed.
fn head(content: &[u8]) -> Vec<u8> {
    format!("{:?}", Key::of_bytes([PROGRAM.as_bytes(), &libraries(), content])).into_bytes()
}

/// What tells this program from one of the same sources with other versions of libraries, or other features of them: `cargo install`
/// without `--locked` takes the newest. Cargo names a crate after all that it depends on, and the compiler the crate's types after that name.
fn libraries() -> [u8; 8] {
    let mut hash = DefaultHasher::new();
    TypeId::of::<Cache>().hash(&mut hash);
    hash.finish().to_le_bytes()
}

/// Removes the oldest results until the rest has room. Other files count for nothing and stay: the folder may be one of the user's.
fn trim(folder: &Path, room: u64) {
    let Ok(listed) = fs::read_dir(folder) else { return };
    let dated = |entry: fs::DirEntry| {
        entry.file_name().to_str().filter(|name| is_result(name))?;
        let about = entry.metadata().ok()?;
        Some((about.modified().ok()?, entry.path(), about.len()))
    };
    let mut files: Vec<_> = listed.flatten().filter_map(dated).collect();
    files.sort();
    let mut held = 0;
    for (_, path, bytes) in files.into_iter().rev() {
        held += bytes;
        if held > room {
            // Another command may have removed it.
            let _ = fs::remove_file(path);
        }
    }
}

/// Whether a file is named as a result, or as one that was being written when its command was killed: `.KEY.PID.new`.
fn is_result(name: &str) -> bool {
    let staged = |name| str::strip_prefix(name, '.')?.strip_suffix(".new")?.split_once('.').map(|(key, _)| key);
    let key = staged(name).unwrap_or(name);
    key.len() == KEY && key.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'))
}

/// `FLEXFRAME_CACHE`, in the working directory where it is a relative path, or the folder that the system has for such things; `off` and
/// an empty name are none.
fn folder() -> Option<PathBuf> {
    let named = |variable: &str| std::env::var_os(variable).map(PathBuf::from);
    let folder = match named("FLEXFRAME_CACHE") {
        Some(folder) if folder.as_os_str() == "off" => return None,
        // An empty path is none that could be made absolute.
        Some(folder) => return std::path::absolute(folder).ok(),
        None => match (named("XDG_CACHE_HOME").filter(|path| path.is_absolute()), named("HOME")) {
            (Some(folder), _) => folder.join("flexframe"),
            (None, Some(home)) => home.join(".cache/flexframe"),
            (None, None) => return None,
        },
    };
    folder.is_absolute().then_some(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_oldest_goes_first() {
        let folder = tempfile::tempdir().expect("a folder");
        let [a, b, c] = ["a", "b", "c"].map(|digit| digit.repeat(KEY));
        written(folder.path(), &[&c, &a, &b]);
        trim(folder.path(), 250);
        assert_eq!(left(folder.path()), [a, b]);
    }

    /// A folder of the user's own may be given as that of the results.
    #[test]
    fn planted_files_that_are_no_results_stay_and_count_for_nothing() {
        let folder = tempfile::tempdir().expect("a folder");
        let key = format!("{:?}", Key::of("step", &1));
        let half = format!(".{key}.4711.new");
        let foreign = ["notes.txt", "A234567890abcdef1234567890abcdef", "1234567890abcdef1234567890abcde", ".notes.txt.4711.new"];
        written(folder.path(), &foreign);
        written(folder.path(), &[&half, &key]);
        trim(folder.path(), 150);
        let mut expected = [&foreign[..], &[&key]].concat();
        expected.sort_unstable();
        assert_eq!(left(folder.path()), expected);
        trim(folder.path(), 0);
        assert_eq!(left(folder.path()).len(), foreign.len());
    }

    /// Files of 100 bytes, the oldest first.
    fn written(folder: &Path, names: &[&str]) {
        for name in names {
            fs::write(folder.join(name), [0; 100]).expect("is written");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }

    fn left(folder: &Path) -> Vec<String> {
        let listed = fs::read_dir(folder).expect("is there").flatten();
        let mut names: Vec<String> = listed.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn planted_a_file_that_is_not_what_was_put_there_is_not_used() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache { folder: folder.path().join("results"), last: Mutex::default() };
        let key = Key::of("step", &1);
        assert_eq!(cache.read(&key), None);
        cache.write(&key, b"result");
        assert_eq!(cache.read(&key).as_deref(), Some(&b"result"[..]));
        let place = cache.place(&key);
        let whole = Disk.bytes(&place, LARGEST).expect("is there");
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 1;
            fs::write(&place, damaged).expect("is written");
            assert_eq!(cache.read(&key), None, "byte {at}");
            fs::write(&place, &whole[..at]).expect("is written");
            assert_eq!(cache.read(&key), None, "{at} bytes");
        }
    }
}
