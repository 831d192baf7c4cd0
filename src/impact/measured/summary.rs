//! What the judged records of a height say together.

use std::collections::BTreeMap;

use serde::Serialize;

use super::judged::Drop;
use super::record::DropGroup;
use super::spread::Spread;

/// The drops of one frame from one height.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// What was dropped.
    pub frame: Option<String>,
    /// From where, m.
    pub height_m: f64,
    /// How many.
    pub drops: usize,
    /// How many of them without a flag.
    pub clean: usize,
    /// How many drops have each flag, by its name.
    pub flags: BTreeMap<&'static str, usize>,
    /// Largest magnitude of every drop with an impact, g; as the paper counts.
    pub peak_g: Option<Spread>,
    /// Largest acceleration along the axis of the same, g.
    pub peak_axial_g: Option<Spread>,
    /// The same of the clean ones.
    pub clean_peak_axial_g: Option<Spread>,
    /// Impulse along the axis in 25 ms over v0, of the clean ones.
    pub impulse_over_v0: Option<Spread>,
    /// Impulse of the magnitude over v0, of the clean ones.
    pub impulse_magnitude_over_v0: Option<Spread>,
    /// Speed after over speed before by the impulse, of the clean ones.
    pub restitution: Option<Spread>,
    /// The same by the flight to the second hit.
    pub restitution_by_flight: Option<Spread>,
    /// Length of the free fall, s, of the clean ones.
    pub fall_s: Option<Spread>,
    /// Standard deviation in free fall, g.
    pub noise_g: Option<Spread>,
}

impl Summary {
    /// Sums up a group.
    pub fn of(group: &DropGroup, drops: &[Drop]) -> Self {
        let height_m = group.height_m;
        let v0 = super::impact_speed_m_s(height_m);
        let impacts = || drops.iter().filter_map(|drop| drop.impact.as_ref());
        let clean = || drops.iter().filter_map(Drop::clean);
        let mut flags = BTreeMap::new();
        for flag in drops.iter().flat_map(|drop| &drop.flags) {
            *flags.entry(flag.name()).or_default() += 1;
        }
        let measured = group.records.iter().any(|record| record.axes_g.is_some());
        Self {
            frame: group.frame.clone(),
            height_m,
            drops: drops.len(),
            clean: clean().count(),
            flags,
            peak_g: Spread::of(impacts().map(|impact| impact.peak_g).filter(|_| measured)),
            peak_axial_g: Spread::of(impacts().map(|impact| impact.peak_axial_g)),
            clean_peak_axial_g: Spread::of(clean().map(|impact| impact.peak_axial_g)),
            impulse_over_v0: Spread::of(clean().map(|impact| impact.impulse_over_v0(height_m))),
            impulse_magnitude_over_v0: Spread::of(clean().map(|impact| impact.impulse_magnitude_m_s / v0).filter(|_| measured)),
            restitution: Spread::of(clean().map(|impact| impact.restitution(height_m))),
            restitution_by_flight: Spread::of(clean().filter_map(|impact| impact.restitution_by_flight(height_m))),
            fall_s: Spread::of(clean().filter_map(|impact| impact.fall_s)),
            noise_g: Spread::of(clean().filter_map(|impact| impact.noise_g)),
        }
    }
}
