//! What records show together of how they were measured or written, each with what mends it.

use super::copied_records::CopiedRecords;
use super::fall::Fall;
use super::free_fall_offset::FreeFallOffset;
use super::hint::Hint;
use super::record::DropSet;
use super::stamp_jitter::StampJitter;

/// In words, one a sentence or two; none where the records are as they should be.
///
/// Readings in another unit, of another axis or from heights in another unit are looked for first: what else they show is of no use.
pub fn symptoms(set: &DropSet) -> Vec<String> {
    let jitter = StampJitter::of(set).map(|jitter| jitter.to_string());
    let others = jitter.into_iter().chain(CopiedRecords::of(set).map(|copied| copied.to_string()));
    match Hint::of(set) {
        Some(hint) => std::iter::once(hint.to_string()).chain(others).collect(),
        None => {
            let offsets = FreeFallOffset::all(set);
            let heights = if offsets.is_empty() { Fall::of_another_unit(&Fall::of(set)) } else { None };
            offsets.iter().map(ToString::to_string).chain(heights).chain(others).collect()
        }
    }
}
