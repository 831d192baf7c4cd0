//! Heights of drops whose speeds at first touch were measured.

use super::record::Record;

/// Drops whose heights are within this share of the lowest one of them are of one height: a light gate tells speeds of one stated height apart.
const ALIKE: f64 = 0.05;
/// Heights are given to this, m.
const STEP_M: f64 = 1e-3;

/// Gives drops of nearly the same height the mean of theirs, m.
pub(super) fn grouped(records: &mut [Record]) {
    let mut order: Vec<usize> = (0..records.len()).collect();
    order.sort_by(|a, b| records[*a].height_m.total_cmp(&records[*b].height_m));
    let mut rest = &order[..];
    while let Some(first) = rest.first() {
        let most_m = (1.0 + ALIKE) * records[*first].height_m;
        let (alike, others) = rest.split_at(rest.iter().take_while(|at| records[**at].height_m <= most_m).count());
        let mean_m = alike.iter().map(|at| records[*at].height_m).sum::<f64>() / alike.len() as f64;
        alike.iter().for_each(|at| records[*at].height_m = decimal(mean_m));
        rest = others;
    }
}

/// The nearest millimetre as it is written, not a sum of binary fractions.
fn decimal(height_m: f64) -> f64 {
    (height_m / STEP_M).round() / STEP_M.recip()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn record(height_m: f64) -> Record {
        Record {
            trial: String::new(),
            height_m,
            frame: None,
            session: None,
            source: String::new(),
            t_s: vec![0.0],
            accel_g: vec![0.0],
            axes_g: None,
            columns: BTreeMap::new(),
            at_full_scale: Vec::new(),
        }
    }

    #[test]
    fn analytic_drops_of_one_stated_height_are_one_height() {
        let heights_m = [0.4994, 1.0123, 0.5061, 0.4942, 0.9871, 1.501];
        let mut records: Vec<Record> = heights_m.into_iter().map(record).collect();
        grouped(&mut records);
        let found: Vec<f64> = records.iter().map(|record| record.height_m).collect();
        assert_eq!(found, [0.5, 1.0, 0.5, 0.5, 1.0, 1.501]);
    }
}
