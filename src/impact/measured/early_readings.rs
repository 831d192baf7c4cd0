//! Readings above the trigger that are no impact: before the fall, or alone in it.

use std::fmt;

use super::impact::{Impact, TRIGGER_G};
use super::record::DropSet;

/// Drops that are named one by one, at the most.
const NAMED: usize = 3;

/// Drops in which the impact is not the first reading above the trigger.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EarlyReadings {
    /// Trial, time of the reading before the impact, s, and the reading, g, of each.
    drops: Vec<(String, f64, f64)>,
    of: usize,
}

impl EarlyReadings {
    /// `None` where there are none.
    pub fn of(set: &DropSet) -> Option<Self> {
        let early = |record: &super::Record| {
            let impact = Impact::of(record)?;
            let sample = impact.passed_over?;
            Some((record.trial.clone(), record.t_s[impact.trigger] - record.t_s[sample], record.size_g(sample)))
        };
        let drops: Vec<(String, f64, f64)> = set.records().filter_map(early).collect();
        (!drops.is_empty()).then(|| Self { drops, of: set.records().count() })
    }
}

impl fmt::Display for EarlyReadings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { drops, of } = self;
        let named: Vec<String> = drops
            .iter()
            .take(NAMED)
            .map(|(trial, before_s, g)| format!("{trial}: {g:.1} g, {:.0} ms before the impact", 1e3 * before_s))
            .collect();
        let more = if drops.len() > NAMED { ", and others" } else { "" };
        write!(
            f,
            "in {} of {of} drops readings before the impact are above {TRIGGER_G} g ({}{more}): they are passed over, as they have \
             less impulse than the impact, and the fall before that lasts as the height says",
            drops.len(),
            named.join("; ")
        )
    }
}
