//! How to cut rods from stock lengths: fewest stock lengths, among those plans one that leaves something of each, and among these the longest
//! piece left over.
//!
//! Frames have a few different lengths of each of which several are needed, so every way of counting them down is looked at:
//! 8, 8, 8 and 4 rods are 3645 states, 4, 4, 8, 8 and 4 are 10,125. Each stock length takes the longest rod that is still missing and as many others as
//! fit; no plan with fewer stock lengths exists. A plan that keeps a rest of each is one of stock lengths that are shorter by that rest.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::frame::assembly::Design;
use crate::frame::skeleton::RodRole;

/// One stock length and what is cut from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stock {
    /// Pieces in the order of cutting: role and length, mm.
    pub pieces: Vec<(RodRole, f64)>,
    /// What is left, mm.
    pub rest_mm: f64,
}

/// A piece longer than the stock.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("a {} rod of {length_mm:.1} mm is longer than the stock of {stock_mm:.0} mm", role.slug())]
pub struct TooLong {
    /// Role of the rod.
    pub role: RodRole,
    /// Its length, mm.
    pub length_mm: f64,
    /// Length that rods are sold in, mm.
    pub stock_mm: f64,
}

/// What a plan leaves of each stock length where it can, mm: ends are trimmed where they are split or crooked, some 2 mm each, and a saw by
/// hand wanders by some tenths at each of ten cuts.
const KEPT_MM: f64 = 5.0;
/// A rest below this is told, mm: trimmed ends, or a saw that is a little wider than meant, use it up.
const NARROW_MM: f64 = 3.0;

/// Sums of lengths are off in the last digits, mm.
const SLACK_MM: f64 = 1e-6;

/// A rest in words, with what a short one asks for.
pub fn rest_words(rest_mm: f64) -> String {
    let care = if rest_mm < NARROW_MM - SLACK_MM { " (trim no end and saw thin)" } else { "" };
    format!("{rest_mm:.1}{care}")
}

/// Rods of one role: role, length in mm, count.
type RodKind = (RodRole, f64, u8);

/// How many stock lengths, and minus the longest rest in mm: less is better.
type Cost = (usize, f64);

struct Table<'a> {
    kinds: &'a [RodKind],
    stock_mm: f64,
    kerf_mm: f64,
    /// The best way on from each state: what it costs, and what the next stock length gives.
    best: BTreeMap<Vec<u8>, (Cost, Vec<u8>)>,
}

impl Table<'_> {
    fn rest_mm(&self, pattern: &[u8]) -> f64 {
        let pieces_mm = self.kinds.iter().zip(pattern).flat_map(|((_, mm, _), n)| std::iter::repeat_n(*mm, usize::from(*n)));
        rest_mm(pieces_mm, self.stock_mm, self.kerf_mm)
    }

    fn fits(&self, pattern: &[u8]) -> bool {
        let used: f64 = self.kinds.iter().zip(pattern).map(|((_, mm, _), n)| f64::from(*n) * (mm + self.kerf_mm)).sum();
        // The last piece may end where the stock ends.
        used - self.kerf_mm <= self.stock_mm + SLACK_MM
    }

    /// Patterns that begin with the longest missing rod and leave no room for another missing one.
    fn patterns(&self, missing: &[u8]) -> Vec<Vec<u8>> {
        let first = missing.iter().position(|n| *n > 0).unwrap_or(0);
        let mut found = Vec::new();
        let mut pattern = vec![0; missing.len()];
        pattern[first] = 1;
        self.extend(missing, first, &mut pattern, &mut found);
        found
    }

    fn extend(&self, missing: &[u8], at: usize, pattern: &mut Vec<u8>, found: &mut Vec<Vec<u8>>) {
        if at == missing.len() {
            let full = (0..missing.len()).all(|kind| {
                pattern[kind] += 1;
                let more = pattern[kind] <= missing[kind] && self.fits(pattern);
                pattern[kind] -= 1;
                !more
            });
            if full {
                found.push(pattern.clone());
            }
            return;
        }
        let own = pattern[at];
        while pattern[at] <= missing[at] && self.fits(pattern) {
            self.extend(missing, at + 1, pattern, found);
            pattern[at] += 1;
        }
        pattern[at] = own;
    }

    fn solve(&mut self, missing: &[u8]) -> Cost {
        if missing.iter().all(|n| *n == 0) {
            return (0, 0.0);
        }
        if let Some((cost, _)) = self.best.get(missing) {
            return *cost;
        }
        let mut best: Option<(Cost, Vec<u8>)> = None;
        for pattern in self.patterns(missing) {
            let left: Vec<u8> = missing.iter().zip(&pattern).map(|(n, used)| n - used).collect();
            let (count, rest) = self.solve(&left);
            let cost = (count + 1, rest.min(-self.rest_mm(&pattern)));
            if best.as_ref().is_none_or(|(known, _)| cost < *known) {
                best = Some((cost, pattern));
            }
        }
        let (cost, pattern) = best.unwrap_or(((usize::MAX / 2, 0.0), vec![0; missing.len()]));
        self.best.insert(missing.to_vec(), (cost, pattern));
        cost
    }
}

/// Cuts rods from stock lengths: of each role a length and a count.
///
/// # Errors
/// When a rod is longer than the stock.
pub fn plan(rods: &[RodKind], stock_mm: f64, kerf_mm: f64) -> Result<Vec<Stock>, TooLong> {
    let least = fewest(rods, stock_mm, kerf_mm)?;
    if least.iter().all(|stock| stock.rest_mm >= KEPT_MM) {
        return Ok(least);
    }
    // A rest is what is left behind the last cut.
    let less_mm = KEPT_MM + kerf_mm;
    let Ok(mut kept) = fewest(rods, stock_mm - less_mm, kerf_mm) else { return Ok(least) };
    if kept.len() > least.len() {
        return Ok(least);
    }
    for stock in &mut kept {
        stock.rest_mm = rest_mm(stock.pieces.iter().map(|(_, mm)| *mm), stock_mm, kerf_mm);
    }
    Ok(kept)
}

/// What is left of a stock length behind the last cut, mm.
fn rest_mm(pieces_mm: impl Iterator<Item = f64>, stock_mm: f64, kerf_mm: f64) -> f64 {
    (stock_mm - pieces_mm.map(|mm| mm + kerf_mm).sum::<f64>()).max(0.0)
}

/// A plan with the fewest stock lengths, and of these the longest piece left over.
fn fewest(rods: &[RodKind], stock_mm: f64, kerf_mm: f64) -> Result<Vec<Stock>, TooLong> {
    let mut kinds: Vec<RodKind> = rods.to_vec();
    kinds.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    if let Some((role, length_mm, _)) = kinds.iter().find(|(_, mm, n)| *n > 0 && *mm > stock_mm + SLACK_MM) {
        return Err(TooLong { role: *role, length_mm: *length_mm, stock_mm });
    }
    let mut table = Table { kinds: &kinds, stock_mm, kerf_mm, best: BTreeMap::new() };
    let mut missing: Vec<u8> = kinds.iter().map(|(.., n)| *n).collect();
    table.solve(&missing);
    let mut stocks = Vec::new();
    while let Some((_, pattern)) = table.best.get(&missing) {
        let pieces = kinds.iter().zip(pattern).flat_map(|((role, mm, _), n)| std::iter::repeat_n((*role, *mm), usize::from(*n))).collect();
        stocks.push(Stock { pieces, rest_mm: table.rest_mm(pattern) });
        missing = missing.iter().zip(pattern).map(|(n, used)| n - used).collect();
    }
    Ok(stocks)
}

/// A role whose rods, cut shorter, need one stock length less.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Saving {
    /// The role.
    pub rod: &'static str,
    /// How long its rods are sawn, mm.
    pub from_mm: f64,
    /// How long they may be, mm.
    pub to_mm: f64,
}

/// By how much shorter rods are looked at, as a share of their length.
const SHORTER: f64 = 0.05;

/// Roles whose rods need one stock length less when they are shorter by at most a twentieth, the smallest change first.
pub fn savings(rods: &[RodKind], stock_mm: f64, kerf_mm: f64) -> Vec<Saving> {
    let count = |rods: &[RodKind], stock_mm: f64| fewest(rods, stock_mm, kerf_mm).map_or(usize::MAX, |stocks| stocks.len());
    let now = count(rods, stock_mm);
    // What is saved by sawing with nothing left over is not worth to be told.
    let with = |at: usize, length_mm: f64| {
        let mut shorter = rods.to_vec();
        shorter[at].1 = length_mm;
        count(&shorter, stock_mm - KEPT_MM - kerf_mm) < now
    };
    let saving = |(at, (role, from_mm, number)): (usize, &RodKind)| {
        let (mut saves_mm, mut wastes_mm) = (from_mm * (1.0 - SHORTER), *from_mm);
        if *number == 0 || now == usize::MAX || !with(at, saves_mm) {
            return None;
        }
        while wastes_mm - saves_mm > 0.01 {
            let middle = 0.5 * (saves_mm + wastes_mm);
            if with(at, middle) { saves_mm = middle } else { wastes_mm = middle }
        }
        // What is told still saves when it is rounded.
        Some(Saving { rod: role.slug(), from_mm: *from_mm, to_mm: (saves_mm * 10.0).floor() / 10.0 })
    };
    let mut found: Vec<Saving> = rods.iter().enumerate().filter_map(saving).collect();
    found.sort_by(|a, b| (a.from_mm - a.to_mm).total_cmp(&(b.from_mm - b.to_mm)));
    found
}

/// Width of a saw cut, mm.
pub const KERF_MM: f64 = 1.0;

/// The stock length that a design's rods are cut from, mm, and how, with saw cuts of a width.
pub(super) fn rod_plan(design: &Design, kerf_mm: f64) -> (f64, Result<Vec<Stock>, TooLong>) {
    let stock_mm = design.frame.stock_mm();
    (stock_mm, cut(design, stock_mm, kerf_mm))
}

/// Rods of a design that, cut shorter, save a stock length.
pub(super) fn rod_savings(design: &Design, stock_mm: f64, kerf_mm: f64) -> Vec<Saving> {
    savings(&kinds(design), stock_mm, kerf_mm)
}

fn cut(design: &Design, stock_mm: f64, kerf_mm: f64) -> Result<Vec<Stock>, TooLong> {
    plan(&kinds(design), stock_mm, kerf_mm)
}

fn kinds(design: &Design) -> Vec<RodKind> {
    let count = |role: RodRole| u8::try_from(design.skeleton.rods_of(role).count()).unwrap_or(u8::MAX);
    design.skeleton.roles().into_iter().map(|role| (role, design.skeleton.sawn_mm(role), count(role))).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const ROLES: [RodRole; 4] = [RodRole::Cage, RodRole::Arm, RodRole::Leg, RodRole::Strut];

    /// First fit decreasing, the usual rule of thumb.
    fn first_fit(rods: &[RodKind], stock_mm: f64, kerf_mm: f64) -> usize {
        let mut pieces: Vec<f64> = rods.iter().flat_map(|(_, mm, n)| std::iter::repeat_n(*mm, usize::from(*n))).collect();
        pieces.sort_by(|a, b| b.total_cmp(a));
        let mut left: Vec<f64> = Vec::new();
        for mm in pieces {
            match left.iter_mut().find(|rest| **rest >= mm) {
                Some(rest) => *rest -= mm + kerf_mm,
                None => left.push(stock_mm - mm - kerf_mm),
            }
        }
        left.len()
    }

    /// Fewest stock lengths by trying every stock for every piece, in turn.
    fn exhaustive(pieces: &[f64], left: &mut Vec<f64>, stock_mm: f64, kerf_mm: f64, best: &mut usize) {
        let Some((mm, others)) = pieces.split_first() else {
            *best = (*best).min(left.len());
            return;
        };
        for at in 0..left.len() {
            if left[at] >= mm - 1e-9 {
                left[at] -= mm + kerf_mm;
                exhaustive(others, left, stock_mm, kerf_mm, best);
                left[at] += mm + kerf_mm;
            }
        }
        if left.len() + 1 < *best {
            left.push(stock_mm - mm - kerf_mm);
            exhaustive(others, left, stock_mm, kerf_mm, best);
            left.pop();
        }
    }

    #[test]
    fn analytic_better_than_the_rule_of_thumb() {
        // 6 + 6 + 4 + 4 and 6 + 5 + 5 + 4 fill two stocks of 20; first fit decreasing takes 6 + 6 + 6 and needs a third.
        let rods = [(ROLES[0], 6.0, 3), (ROLES[1], 5.0, 2), (ROLES[2], 4.0, 3)];
        assert_eq!(first_fit(&rods, 20.0, 0.0), 3);
        let stocks = plan(&rods, 20.0, 0.0).expect("fits");
        assert_eq!(stocks.len(), 2, "{stocks:?}");
        assert!(matches!(plan(&rods, 5.0, 0.0), Err(TooLong { length_mm: 6.0, .. })));
        assert_eq!(plan(&[], 10.0, 1.0), Ok(Vec::new()));
        // The last piece needs no cut behind it.
        assert_eq!(plan(&[(ROLES[0], 4.5, 2)], 10.0, 1.0).expect("fits").len(), 1);
    }

    #[test]
    fn analytic_something_is_left_of_each_stock_where_that_takes_no_more() {
        let rests = |rods: &[RodKind]| plan(rods, 100.0, 0.0).expect("fits").iter().map(|stock| stock.rest_mm).collect::<Vec<_>>();
        // 60 + 40 fill one of 100; 60 and 40 + 40 leave 40 and 20 of two.
        assert_eq!(rests(&[(ROLES[0], 60.0, 1), (ROLES[1], 40.0, 2)]), [40.0, 20.0]);
        // 49.5 + 49.5 leave 1 mm, and the longest rest elsewhere.
        assert!(rests(&[(ROLES[0], 49.5, 3), (ROLES[1], 20.0, 3)]).iter().all(|rest| *rest >= KEPT_MM));
        // Two of 50 fill one of 100, and the third needs another: no plan of two keeps 5 mm of both.
        assert_eq!(rests(&[(ROLES[0], 50.0, 3)]), [0.0, 50.0]);
        // 98 mm leave 2 mm however it is planned.
        assert_eq!(rests(&[(ROLES[0], 98.0, 1)]), [2.0]);
        // The cut behind the last piece counts.
        let cut = plan(&[(ROLES[0], 60.0, 1), (ROLES[1], 34.0, 2)], 100.0, 1.0).expect("fits");
        assert!(cut.iter().all(|stock| stock.rest_mm >= KEPT_MM), "{cut:?}");
    }

    #[test]
    fn analytic_a_rest_that_a_trimmed_end_uses_up_is_told() {
        assert_eq!([3.0, 5.0, 949.0].map(rest_words), ["3.0", "5.0", "949.0"]);
        assert_eq!([0.0, 2.9].map(rest_words), ["0.0 (trim no end and saw thin)", "2.9 (trim no end and saw thin)"]);
    }

    #[test]
    fn analytic_a_little_shorter_saves_a_stock() {
        // Three of 100.5 mm do not go into 300 mm with cuts of 1 mm between them; three of 97.3 mm do, with a cut more and 5 mm that are kept.
        let found = savings(&[(ROLES[0], 100.5, 6), (ROLES[1], 290.0, 1)], 300.0, 1.0);
        assert_eq!(found, [Saving { rod: ROLES[0].slug(), from_mm: 100.5, to_mm: 97.3 }]);
        assert_eq!(savings(&[(ROLES[0], 60.0, 3)], 100.0, 1.0), [], "no twentieth makes two of one");
        assert_eq!(savings(&[(ROLES[0], 120.0, 3)], 100.0, 1.0), [], "longer than the stock");
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

        #[test]
        fn analytic_no_plan_needs_fewer(lengths in prop::collection::vec(20.0..120.0_f64, 1..4), counts in prop::collection::vec(0..4u8, 3), kerf in 0.0..3.0_f64) {
            let rods: Vec<RodKind> = lengths.iter().zip(&counts).zip(ROLES).map(|((mm, n), role)| (role, *mm, *n)).collect();
            let stocks = plan(&rods, 150.0, kerf).expect("fits");
            let mut pieces: Vec<f64> = rods.iter().flat_map(|(_, mm, n)| std::iter::repeat_n(*mm, usize::from(*n))).collect();
            pieces.sort_by(|a, b| b.total_cmp(a));
            let mut fewest = pieces.len();
            exhaustive(&pieces, &mut Vec::new(), 150.0, kerf, &mut fewest);
            prop_assert!(stocks.len() <= fewest, "{} stocks, {fewest} would do: {rods:?}", stocks.len());
            for (role, _, n) in &rods {
                let cut = stocks.iter().flat_map(|stock| &stock.pieces).filter(|(of, _)| of == role).count();
                prop_assert_eq!(cut, usize::from(*n));
            }
            for stock in &stocks {
                let used: f64 = stock.pieces.iter().map(|(_, mm)| mm + kerf).sum::<f64>() - kerf;
                prop_assert!(used <= 150.0 + 1e-6);
            }
        }
    }
}
