//! A record, and records by frame and height.

use std::collections::BTreeMap;
use std::path::Path;

use super::drop_order::in_order;
use super::file_kind::FileKind;
use crate::units::Angle;

/// One drop as it was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Its name: the trial of a table, the file's stem of a logger.
    pub trial: String,
    /// Stated drop height, m.
    pub height_m: f64,
    /// What was dropped, where a folder's name says it.
    pub frame: Option<String>,
    /// Where and when it was measured, as a table says it: records of one session share mount, zero and scale.
    pub session: Option<String>,
    /// The file.
    pub source: String,
    /// Time as the logger stamped it, s, strictly ascending.
    pub t_s: Vec<f64>,
    /// Proper acceleration along the axis, g; positive while the ground pushes.
    pub accel_g: Vec<f64>,
    /// Proper acceleration along the sensor's x, y and z, g, where they were measured. The third is [`Self::accel_g`] where a file
    /// has no other.
    pub axes_g: Option<[Vec<f64>; 3]>,
    /// Further columns of a table that were asked for, by name, and what other tables say of this drop.
    pub columns: BTreeMap<String, String>,
    /// The samples that stand at an end of the converter's range.
    pub at_full_scale: Vec<usize>,
}

impl Record {
    /// Magnitude of the acceleration, g: of all axes, or of the one there is.
    pub fn size_g(&self, sample: usize) -> f64 {
        let magnitude = |axes: &[Vec<f64>; 3]| axes.iter().map(|axis| axis[sample] * axis[sample]).sum::<f64>().sqrt();
        self.axes_g.as_ref().map_or_else(|| self.accel_g[sample].abs(), magnitude)
    }

    /// The lateral readings of a sensor whose x points so far to the left of the frame's front, as those of the frame's front and left.
    #[must_use]
    pub(super) fn turned_back(mut self, turn: Angle) -> Self {
        let angle = turn.to_rad();
        if let Some([x, y, _]) = self.axes_g.as_mut().filter(|_| angle != 0.0) {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            for (x, y) in x.iter_mut().zip(y) {
                (*x, *y) = (*x * cos - *y * sin, *x * sin + *y * cos);
            }
        }
        self
    }

    /// What a further column says; `None` where it says nothing.
    pub fn column(&self, name: &str) -> Option<&str> {
        self.columns.get(name).map(String::as_str).filter(|value| !value.is_empty())
    }

    /// Every axis there is: x, y and z, or the one.
    pub fn axes(&self) -> Vec<&[f64]> {
        self.axes_g.as_ref().map_or_else(|| vec![&self.accel_g[..]], |axes| axes.iter().map(Vec::as_slice).collect())
    }

    /// How many samples last so long; at least one.
    pub fn samples_in(&self, time_s: f64) -> usize {
        self.step_s().map_or(1, |step_s| (time_s / step_s).round().max(1.0) as usize)
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.t_s.len()
    }

    /// Whether there is none; readers give no such record.
    pub fn is_empty(&self) -> bool {
        self.t_s.is_empty()
    }

    /// Whether it stands in a table, not in a file of the logger.
    pub fn is_of_table(&self) -> bool {
        FileKind::of(Path::new(&self.source)) == Some(FileKind::Table)
    }

    /// The median step of time, s; `None` for fewer than two samples.
    pub fn step_s(&self) -> Option<f64> {
        let mut steps: Vec<f64> = self.t_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = steps.len().checked_sub(1)? / 2;
        Some(*steps.select_nth_unstable_by(middle, f64::total_cmp).1)
    }

    /// Mean time between samples, s; `None` with fewer than two.
    pub fn mean_step_s(&self) -> Option<f64> {
        let steps = self.t_s.len().checked_sub(1).filter(|steps| *steps > 0)?;
        Some((self.t_s[steps] - self.t_s[0]) / steps as f64)
    }
}

/// Records of one frame from one height, in the order in which they were made, as far as names tell it.
#[derive(Clone, Debug, PartialEq)]
pub struct DropGroup {
    /// What was dropped, where that is known.
    pub frame: Option<String>,
    /// From where, m.
    pub height_m: f64,
    /// The records.
    pub records: Vec<Record>,
}

/// All records that were read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DropSet {
    /// By frame, then by height.
    pub groups: Vec<DropGroup>,
    /// What was left aside in reading.
    pub notes: Vec<String>,
}

impl DropSet {
    /// Groups records.
    pub fn of(records: Vec<Record>, notes: Vec<String>) -> Self {
        let mut groups: Vec<DropGroup> = Vec::new();
        for record in records {
            let order =
                |group: &DropGroup| group.frame.as_ref().cmp(&record.frame.as_ref()).then(group.height_m.total_cmp(&record.height_m));
            match groups.binary_search_by(order) {
                Ok(at) => groups[at].records.push(record),
                Err(at) => {
                    let (frame, height_m) = (record.frame.clone(), record.height_m);
                    groups.insert(at, DropGroup { frame, height_m, records: vec![record] });
                }
            }
        }
        groups.iter_mut().for_each(|group| in_order(&mut group.records, |record| [&record.source, &record.trial]));
        Self { groups, notes }
    }

    /// Every record, group by group.
    pub fn records(&self) -> impl Iterator<Item = &Record> {
        self.groups.iter().flat_map(|group| &group.records)
    }

    /// The frames that were dropped, each once.
    pub fn frames(&self) -> Vec<Option<&str>> {
        let mut frames: Vec<Option<&str>> = self.groups.iter().map(|group| group.frame.as_deref()).collect();
        frames.dedup();
        frames
    }
}
