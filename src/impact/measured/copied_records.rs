//! Records that have the readings of another record: a file that was given twice, or copied.

use std::collections::BTreeMap;
use std::fmt;

use super::record::{DropSet, Record};

/// Fewest readings of a record that can be told from another one by its noise.
const FEWEST: usize = 20;

/// How many records are copies, and the first of them.
///
/// *When it is wrong:* for drops that were computed without scatter, which are alike.
#[derive(Clone, Debug, PartialEq)]
pub struct CopiedRecords {
    /// Records beside the first one of each kind.
    pub count: usize,
    /// The first copy, and what it has the readings of.
    pub first: [String; 2],
}

impl CopiedRecords {
    /// Among all records; `None` where each has readings of its own.
    pub fn of(set: &DropSet) -> Option<Self> {
        let mut known: BTreeMap<Vec<u64>, &Record> = BTreeMap::new();
        let (mut count, mut first) = (0, None);
        for record in set.records().filter(|record| record.len() >= FEWEST) {
            let readings = record.accel_g.iter().map(|reading| reading.to_bits()).collect();
            if let Some(original) = known.get(&readings) {
                count += 1;
                first.get_or_insert_with(|| [record, original].map(name));
            } else {
                known.insert(readings, record);
            }
        }
        first.map(|first| Self { count, first })
    }
}

fn name(record: &Record) -> String {
    let place = if record.source.is_empty() { String::new() } else { format!(" in {}", record.source) };
    format!("drop `{}` from {} m{place}", record.trial, record.height_m)
}

impl fmt::Display for CopiedRecords {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { count, first: [copy, original] } = self;
        let have = if *count == 1 { "1 record has" } else { &format!("{count} records have") };
        write!(
            f,
            "{have} the readings of another one to the last digit, first {copy}, which is {original}: intervals and p-values count each as a \
             drop of its own. Give each drop once"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(trial: &str, seed: u32) -> Record {
        Record {
            trial: trial.into(),
            height_m: 1.0,
            frame: None,
            session: None,
            source: String::new(),
            t_s: (0..40).map(|at| 1e-3 * f64::from(at)).collect(),
            accel_g: (0..40).map(|at| libm::sin(f64::from(at * seed))).collect(),
            axes_g: None,
            columns: BTreeMap::new(),
            at_full_scale: Vec::new(),
        }
    }

    #[test]
    fn planted_a_copy_is_seen_and_drops_of_their_own_are_not() {
        let own = DropSet::of(vec![record("1", 1), record("2", 2)], Vec::new());
        assert_eq!(CopiedRecords::of(&own), None);
        let copied = DropSet::of(vec![record("1", 1), record("2", 2), record("1b", 1)], Vec::new());
        let found = CopiedRecords::of(&copied).expect("one is a copy");
        assert_eq!((found.count, found.first), (1, ["drop `1b` from 1 m".into(), "drop `1` from 1 m".into()]));
    }
}
