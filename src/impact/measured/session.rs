//! What the records of one session share: zero and scale of the sensor.

use std::collections::BTreeMap;

use serde::Serialize;

use super::fall_drag::FallDrag;
use super::impact::Impact;
use super::record::Record;
use super::spread::Spread;

/// The mean reading of an axis in free fall, of the axis along the fall without the drag of the air.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Zero {
    /// Median over the records of each record's mean, g; 0 for a sensor that is calibrated.
    pub mean_g: f64,
    /// Its standard error, from the variation between records, g; `None` of a single one. That of the drag is not in it.
    pub error_g: Option<f64>,
    /// Records with a fall.
    pub records: usize,
}

/// Records that were measured in one go.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Session {
    /// What a table says, or else frame and height.
    pub name: String,
    /// How many records.
    pub records: usize,
    /// Of x, y and z where all were measured, or of the one axis in the third place.
    pub zeros: [Option<Zero>; 3],
    /// Magnitude while the frame is held, less the zeros, g: 1 for a sensor that is calibrated. Where all axes were measured.
    pub held_g: Option<Spread>,
}

impl Session {
    /// The session of a record.
    pub fn name_of(record: &Record) -> String {
        let stated = record.session.clone();
        stated.unwrap_or_else(|| match &record.frame {
            Some(frame) => format!("{frame} {} m", record.height_m),
            None => format!("{} m", record.height_m),
        })
    }

    /// All sessions of some records with their impacts, by name.
    pub fn all<'a>(records: impl Iterator<Item = (&'a Record, &'a Option<Impact>)>) -> Vec<Self> {
        let mut by_name: BTreeMap<String, Vec<(&Record, Option<&Impact>)>> = BTreeMap::new();
        let mut by_frame: BTreeMap<Option<&str>, Vec<(&Record, &Impact)>> = BTreeMap::new();
        for (record, impact) in records {
            by_name.entry(Self::name_of(record)).or_default().push((record, impact.as_ref()));
            by_frame.entry(record.frame.as_deref()).or_default().extend(impact.as_ref().map(|impact| (record, impact)));
        }
        let drags: BTreeMap<Option<&str>, FallDrag> =
            by_frame.into_iter().map(|(frame, falls)| (frame, FallDrag::of(falls.into_iter()))).collect();
        by_name.into_iter().map(|(name, records)| Self::of(name, &records, &drags)).collect()
    }

    fn of(name: String, records: &[(&Record, Option<&Impact>)], drags: &BTreeMap<Option<&str>, FallDrag>) -> Self {
        let drag = |record: &Record| drags.get(&record.frame.as_deref()).copied().unwrap_or_default();
        let zeros = [
            zero(records, |record, impact| mean_in_fall(record, impact, 0)),
            zero(records, |record, impact| mean_in_fall(record, impact, 1)),
            zero(records, |record, impact| drag(record).zero_g(record, impact)),
        ];
        let session = Self { name, records: records.len(), zeros, held_g: None };
        let held_g = Spread::of(records.iter().filter_map(|(record, impact)| held_g(record, (*impact)?, session.zero_g())));
        Self { held_g, ..session }
    }

    /// Zeros of x, y and z, g; 0 where they are not known.
    pub fn zero_g(&self) -> [f64; 3] {
        self.zeros.map(|zero| zero.map_or(0.0, |zero| zero.mean_g))
    }
}

/// Mean reading of an axis over the fall, g; `None` for a fall that is too short, and for an axis that was not measured.
pub fn mean_in_fall(record: &Record, impact: &Impact, axis: usize) -> Option<f64> {
    let falling = impact.behind_release()?;
    let readings = match &record.axes_g {
        Some(axes) => &axes[axis],
        None if axis == 2 => &record.accel_g,
        None => return None,
    };
    Some(readings[falling.clone()].iter().sum::<f64>() / falling.len() as f64)
}

/// Median over records.
fn zero(records: &[(&Record, Option<&Impact>)], of: impl Fn(&Record, &Impact) -> Option<f64>) -> Option<Zero> {
    let spread = Spread::of(records.iter().filter_map(|(record, impact)| of(record, (*impact)?)))?;
    // The median, because some falls are none.
    let error_g = (spread.count > 1).then(|| spread.median_error());
    Some(Zero { mean_g: spread.median, error_g, records: spread.count })
}

/// Median magnitude of the first samples of a record, while the frame is held, g.
fn held_g(record: &Record, impact: &Impact, zero_g: [f64; 3]) -> Option<f64> {
    let axes = record.axes_g.as_ref()?;
    let held = impact.held(record)?;
    let size = |sample: usize| (0..3).map(|axis| (axes[axis][sample] - zero_g[axis]).powi(2)).sum::<f64>().sqrt();
    Spread::of(held.map(size)).map(|spread| spread.median)
}
