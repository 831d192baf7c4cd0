//! What records show together of how they were measured or written, each with what mends it.

use super::copied_records::CopiedRecords;
use super::fall::Fall;
use super::free_fall_offset::FreeFallOffset;
use super::hint::Hint;
use super::loud_noise::LoudNoise;
use super::mixed_rates::MixedRates;
use super::record::DropSet;
use super::sensor_scale::SensorScale;
use super::stamp_jitter::StampJitter;
use super::unknown_zero::UnknownZero;

/// In words, one a sentence or two; none where the records are as they should be.
///
/// Readings in another unit, of another axis or from heights in another unit are looked for first: what else they show is of no use.
pub fn symptoms(set: &DropSet) -> Vec<String> {
    told(set, |falls| Fall::of_another_unit(falls).into_iter().collect())
}

/// The same, and falls that belong to other heights than the stated ones. A diagnosis compares falls with its own model instead.
pub fn symptoms_and_heights(set: &DropSet) -> Vec<String> {
    told(set, |falls| match Fall::of_another_unit(falls) {
        Some(unit) => vec![unit],
        None => Fall::of_other_heights(falls),
    })
}

/// What records show, and what their falls say of heights where readings are what they should be.
fn told(set: &DropSet, of_falls: impl Fn(&[Fall]) -> Vec<String>) -> Vec<String> {
    let jitter = StampJitter::of(set).map(|jitter| jitter.to_string());
    let rates = MixedRates::all(set).into_iter().map(|mixed| mixed.to_string());
    let others = jitter.into_iter().chain(rates).chain(CopiedRecords::of(set).map(|copied| copied.to_string()));
    match Hint::of(set) {
        Some(hint) => std::iter::once(hint.to_string()).chain(others).collect(),
        None => {
            let offsets = FreeFallOffset::all(set);
            let heights = if offsets.is_empty() { of_falls(&Fall::of(set)) } else { Vec::new() };
            let noise = LoudNoise::of(set).map(|noise| noise.to_string());
            let zeros = if offsets.is_empty() { UnknownZero::all(set) } else { Vec::new() };
            let zeros = zeros.iter().map(ToString::to_string);
            // A wrong height has another impulse, too.
            let scales = if heights.is_empty() && offsets.is_empty() { SensorScale::all(set) } else { Vec::new() };
            let scales: Vec<String> = scales.iter().map(ToString::to_string).collect();
            let of_readings = offsets.iter().map(ToString::to_string).chain(zeros).chain(heights).chain(scales);
            of_readings.chain(noise).chain(others).collect()
        }
    }
}
