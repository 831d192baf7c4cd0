//! Where parameter files are: on disk, in memory, or somewhere that looks like a disk, such as a revision of a repository.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// A place that holds files.
pub trait Files {
    /// Whether there is such a file.
    fn is_file(&self, path: &Path) -> bool;

    /// A file's bytes, no more of them than asked for: a longer file ends there.
    ///
    /// # Errors
    /// When there is none or it cannot be read.
    fn bytes(&self, path: &Path, most: u64) -> io::Result<Vec<u8>>;
}

/// Files that are held in memory, by path.
#[derive(Clone, Debug, Default)]
pub struct Memory(pub BTreeMap<PathBuf, Vec<u8>>);

impl Files for Memory {
    fn is_file(&self, path: &Path) -> bool {
        self.0.contains_key(path)
    }

    fn bytes(&self, path: &Path, most: u64) -> io::Result<Vec<u8>> {
        let bytes = self.0.get(path).ok_or_else(|| io::Error::new(io::ErrorKind::NotFound, "there is no such file"))?;
        let most = usize::try_from(most).unwrap_or(usize::MAX);
        Ok(bytes[..bytes.len().min(most)].to_vec())
    }
}

/// The disk; there is none without the feature `cli`.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

#[cfg(not(feature = "cli"))]
impl Files for Disk {
    fn is_file(&self, _: &Path) -> bool {
        false
    }

    fn bytes(&self, _: &Path, _: u64) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::Unsupported, "there is no disk here"))
    }
}

#[cfg(feature = "cli")]
impl Files for Disk {
    fn is_file(&self, path: &Path) -> bool {
        path.is_file()
    }

    fn bytes(&self, path: &Path, most: u64) -> io::Result<Vec<u8>> {
        // A pipe or a device may never end, a pipe not even open.
        if !std::fs::metadata(path)?.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
        }
        let file = std::fs::File::open(path)?;
        let mut bytes = Vec::new();
        io::Read::read_to_end(&mut io::Read::take(file, most), &mut bytes)?;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{FrameFile, LoadError};

    #[test]
    fn analytic_a_frame_and_its_bases_are_read_from_memory() {
        let files = [("a/x.toml", "base = \"y\"\n"), ("a/y.toml", "base = \"cognifly\"\n[rods]\narm_rod_length_mm = 99.0\n")];
        let memory = Memory(files.into_iter().map(|(path, text)| (path.into(), text.into())).collect());
        let file = FrameFile::load_from("a/x.toml", &memory).expect("reads");
        let places: Vec<&str> = file.files.iter().map(|source| source.name.as_str()).collect();
        assert_eq!((file.name.as_str(), places), ("x", vec!["a/x.toml", "a/y.toml"]));
        assert_eq!(file.entries["rods.arm_rod_length_mm"].depth, 1);
        assert!(matches!(FrameFile::load_from("x.toml", &memory), Err(LoadError::Unreadable { .. })));
        assert_eq!(memory.bytes(Path::new("a/x.toml"), 4).expect("is there"), b"base");
    }
}
