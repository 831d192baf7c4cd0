//! The logger's files: samples of 10 bytes, little-endian u32 t_us, u16 x, u16 y, u16 z, in counts of the converter.
//!
//! Source of the calibration: 27 tumbles in the notebook of arXiv 2103.04423 (thecognifly/CrashLandingExperiments).
//! *When it is wrong:* the lateral axes have a scale of their own that was only estimated, and offsets drift with warmth.

use std::collections::BTreeMap;

use super::malformed::{Fault, SourcePosition};
use super::record::Record;
use crate::paper_logger::COUNTS_PER_G;

/// Bytes of a sample.
const SAMPLE: usize = 10;

/// From counts to g.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibration {
    /// Counts at 0 g: x, y, z.
    pub offset_counts: [f64; 3],
    /// Counts to one g: x, y, z.
    pub counts_per_g: [f64; 3],
    /// Largest count of the converter.
    pub full_scale: u16,
}

impl Calibration {
    /// What the ends of the converter read, axis by axis, g.
    pub fn ends_g(&self) -> [[f64; 2]; 3] {
        let of = |axis: usize| [0.0, f64::from(self.full_scale)].map(|count| (count - self.offset_counts[axis]) / self.counts_per_g[axis]);
        [of(0), of(1), of(2)]
    }
}

impl Default for Calibration {
    fn default() -> Self {
        let side = COUNTS_PER_G * 0.9577;
        Self { offset_counts: [2_019.938_72, 2020.0, 2_020.772_844_38], counts_per_g: [side, side, COUNTS_PER_G], full_scale: 4095 }
    }
}

/// A file's name, and what its folder says.
pub(super) struct Label {
    pub trial: String,
    pub source: String,
    pub frame: Option<String>,
    pub height_m: f64,
}

/// Frame and height of a folder's name: `soft_050cm` is 0.5 m.
pub(super) fn frame_and_height(folder: &str) -> Option<(Option<String>, f64)> {
    let stem = folder.strip_suffix("cm")?;
    let digits = stem.bytes().rev().take_while(u8::is_ascii_digit).count();
    let (frame, height) = stem.split_at(stem.len() - digits);
    let height_cm: u32 = height.parse().ok().filter(|height| (1..=10_000).contains(height))?;
    let frame = frame.trim_end_matches(['_', '-']);
    Some(((!frame.is_empty()).then(|| frame.to_string()), f64::from(height_cm) / 100.0))
}

/// Reads a file's bytes.
pub(super) fn record(bytes: &[u8], label: Label, calibration: &Calibration) -> Result<Record, (SourcePosition, Fault)> {
    if bytes.is_empty() {
        return Err((SourcePosition::Whole, Fault::Empty));
    }
    if !bytes.len().is_multiple_of(SAMPLE) {
        return Err((SourcePosition::Whole, Fault::Truncated { bytes: bytes.len() }));
    }
    let Label { trial, source, frame, height_m } = label;
    let count = bytes.len() / SAMPLE;
    let (mut t_s, mut axes_g) = (Vec::with_capacity(count), [0; 3].map(|_| Vec::with_capacity(count)));
    let (mut at_full_scale, mut before_us) = (Vec::new(), None);
    for (at, sample) in bytes.chunks_exact(SAMPLE).enumerate() {
        let place = SourcePosition::Sample(at + 1);
        let t_us = u32::from_le_bytes([sample[0], sample[1], sample[2], sample[3]]);
        let counts = [4, 6, 8].map(|byte| u16::from_le_bytes([sample[byte], sample[byte + 1]]));
        let most = calibration.full_scale;
        if let Some((axis, count)) = ['x', 'y', 'z'].into_iter().zip(counts).find(|(_, count)| *count > most) {
            return Err((place, Fault::Counts { axis, count, most }));
        }
        if let Some(before_us) = before_us.filter(|before| *before >= t_us) {
            let [before_s, t_s] = [before_us, t_us].map(|us| f64::from(us) * 1e-6);
            return Err((place, Fault::Unsorted { trial, before_s, t_s }));
        }
        before_us = Some(t_us);
        if counts.iter().any(|count| *count == 0 || *count == most) {
            at_full_scale.push(at);
        }
        t_s.push(f64::from(t_us) * 1e-6);
        for (axis, readings) in axes_g.iter_mut().enumerate() {
            readings.push((f64::from(counts[axis]) - calibration.offset_counts[axis]) / calibration.counts_per_g[axis]);
        }
    }
    let accel_g = axes_g[2].clone();
    Ok(Record {
        trial,
        height_m,
        frame,
        session: None,
        source,
        t_s,
        accel_g,
        axes_g: Some(axes_g),
        columns: BTreeMap::new(),
        at_full_scale,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn label() -> Label {
        Label { trial: "a".into(), source: "a.bin".into(), frame: None, height_m: 1.0 }
    }

    fn sample(t_us: u32, counts: [u16; 3]) -> Vec<u8> {
        t_us.to_le_bytes().into_iter().chain(counts.into_iter().flat_map(u16::to_le_bytes)).collect()
    }

    #[test]
    fn analytic_folder_names() {
        assert_eq!(frame_and_height("soft_050cm"), Some((Some("soft".into()), 0.5)));
        assert_eq!(frame_and_height("my-frame-262cm"), Some((Some("my-frame".into()), 2.62)));
        assert_eq!(frame_and_height("150cm"), Some((None, 1.5)));
        for foreign in ["soft", "cm", "soft_cm", "soft_000cm", "soft_99999999999cm", "soft_050"] {
            assert_eq!(frame_and_height(foreign), None, "{foreign}");
        }
    }

    #[test]
    fn analytic_counts_become_g() {
        let bytes = [sample(1000, [2020, 2020, 2110]), sample(2000, [2020, 2105, 4095])].concat();
        let record = record(&bytes, label(), &Calibration::default()).expect("reads");
        assert!((record.accel_g[0] - (2110.0 - 2_020.772_844_38) / 8.877_004_38).abs() < 1e-12);
        assert_eq!((record.t_s.clone(), record.at_full_scale.clone()), (vec![0.001, 0.002], vec![1]));
        let y = 85.0 / (8.877_004_38 * 0.9577);
        assert!((record.size_g(1) - libm::hypot(record.accel_g[1], y)).abs() < 1e-3);
    }

    #[test]
    fn planted_faults_are_named() {
        let fault = |bytes: &[u8]| record(bytes, label(), &Calibration::default()).expect_err("is refused");
        assert_eq!(fault(&[]), (SourcePosition::Whole, Fault::Empty));
        assert_eq!(fault(&[0; 25]), (SourcePosition::Whole, Fault::Truncated { bytes: 25 }));
        assert_eq!(fault(&sample(0, [1, 5000, 3])), (SourcePosition::Sample(1), Fault::Counts { axis: 'y', count: 5000, most: 4095 }));
        let still = [sample(1000, [1; 3]), sample(1000, [1; 3])].concat();
        assert!(matches!(fault(&still), (SourcePosition::Sample(2), Fault::Unsorted { .. })));
    }
}
