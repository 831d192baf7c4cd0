//! Small results that were computed ahead, and come with a program: what two bodies share, what a rule found of a part.

use std::collections::BTreeMap;
use std::sync::{Arc, PoisonError, RwLock};

use super::key::{Key, PROGRAM};
use super::store::Storage;

/// Results of more bytes are left out: meshes are as quickly made as loaded.
const LARGEST: usize = 4096;

/// Results by their keys, for any number of memos. Copies share what they hold.
///
/// One that is to be used only reads: it does not grow with the changes of a frame. One that collects only takes in.
#[derive(Clone, Default)]
pub struct Prepared {
    results: Arc<RwLock<BTreeMap<Key, Vec<u8>>>>,
    collects: bool,
}

/// The results are those of another build of the program, or no results at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("these are no results of this build of the program")]
pub struct OtherBuild;

impl Prepared {
    /// One that takes in what is computed.
    pub fn collecting() -> Self {
        Self { collects: true, ..Self::default() }
    }

    /// Adds the results that another wrote; how many there are then.
    ///
    /// # Errors
    /// When another build of the program wrote them: its results may differ.
    pub fn add(&self, written: &[u8]) -> Result<usize, OtherBuild> {
        let (program, results) = postcard::from_bytes::<(String, BTreeMap<Key, Vec<u8>>)>(written).map_err(|_| OtherBuild)?;
        if program != PROGRAM {
            return Err(OtherBuild);
        }
        let mut held = self.results.write().unwrap_or_else(PoisonError::into_inner);
        held.extend(results);
        Ok(held.len())
    }

    /// The results as bytes.
    ///
    /// # Errors
    /// When memory does not suffice.
    pub fn written(&self) -> Result<Vec<u8>, postcard::Error> {
        let held = self.results.read().unwrap_or_else(PoisonError::into_inner);
        postcard::to_allocvec(&(PROGRAM, &*held))
    }
}

impl Storage for Prepared {
    fn read(&self, key: &Key) -> Option<Vec<u8>> {
        self.results.read().unwrap_or_else(PoisonError::into_inner).get(key).cloned()
    }

    fn writes(&self) -> bool {
        self.collects
    }

    fn write(&self, key: &Key, bytes: &[u8]) {
        if self.collects && bytes.len() <= LARGEST {
            self.results.write().unwrap_or_else(PoisonError::into_inner).insert(*key, bytes.to_vec());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Memo;
    use super::*;

    fn length(memo: &Memo, text: &str) -> usize {
        *memo.get("length", "text", &text, || text.len())
    }

    fn row(memo: &Memo, of: usize) -> usize {
        memo.get("row", "zeros", &of, || vec![0_u8; of]).len()
    }

    #[test]
    fn analytic_small_results_are_computed_ahead_and_used() {
        let collected = Prepared::collecting();
        let memo = Memo::on(Box::new(collected.clone()));
        assert_eq!((length(&memo, "rod"), row(&memo, 2 * LARGEST)), (3, 2 * LARGEST));
        let used = Prepared::default();
        let memo = Memo::on(Box::new(used.clone()));
        assert_eq!(used.add(&collected.written().expect("is written")), Ok(1));
        assert_eq!((length(&memo, "rod"), memo.made().len()), (3, 0));
        // What is large, or was not computed ahead, is computed, and not taken in.
        assert_eq!((row(&memo, 2 * LARGEST), length(&memo, "joint"), memo.made().len()), (2 * LARGEST, 5, 2));
        assert_eq!(used.written(), collected.written());
    }

    #[test]
    fn planted_results_of_another_build_are_refused() {
        let other = postcard::to_allocvec(&("another build", BTreeMap::from([(Key::of_bytes([]), vec![1_u8])]))).expect("is written");
        let used = Prepared::default();
        assert_eq!([&other[..], b"", b"not results"].map(|written| used.add(written)), [Err(OtherBuild); 3]);
        assert_eq!(used.written(), Prepared::default().written());
    }
}
