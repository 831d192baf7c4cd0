//! Where parameter files are: on disk, or somewhere that looks like one, such as a revision of a repository.

use std::io;
use std::path::Path;

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

/// The disk.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

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
