//! How much of the variation between drops of one height a quantity explains.
//!
//! Windows less their height's mean are regressed on the quantity, on four fifths of the drops, and predicted on the last fifth, in
//! turn. What is explained is one minus the sum of squares left over that of the mean alone. Values dealt to other drops of the same
//! height show what chance explains. Drops without a value are in neither.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use crate::figures::p_value;
use crate::impact::fit::{Chosen, WaveGroup, Waves, inverse};
use crate::impact::measured::{Drop, Record, decimal};

/// Parts of the drops that are left out in turn.
const PARTS: usize = 5;
/// Permutations.
const PERMUTED: usize = 199;
/// Ridge of the regression: variance in units of the covariate's own.
const RIDGE: f64 = 0.5;

/// A quantity of each drop, height by height.
#[derive(Clone, Debug)]
pub struct Covariate {
    /// Its name.
    pub id: String,
    /// A height each, a drop each: one number or several; `None` where it is not known.
    pub values: Vec<Vec<Option<Vec<f64>>>>,
}

/// What a quantity explains.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CovariateEffect {
    /// Its name.
    pub id: String,
    /// Part of the variance between drops of one height, out of sample; below 0 where it predicts worse than the mean. `None` where nothing can be known
    /// of it: the quantity is the same for all drops of each height, or has nearly as many names as drops.
    pub explained: Option<f64>,
    /// p-value under permutation within each height.
    pub p: Option<f64>,
    /// Drops of which it is known.
    pub drops: usize,
    /// All drops.
    pub of: usize,
    /// Whether it is the same for all drops of each height.
    #[serde(skip)]
    pub is_same: bool,
}

impl Covariate {
    /// The place of each drop in the order of its height.
    pub fn trial(waves: &Waves) -> Self {
        let order = |group: &WaveGroup| (0..group.windows.len()).map(|at| Some(vec![at as f64])).collect();
        Self { id: "trial".into(), values: waves.groups.iter().map(order).collect() }
    }

    /// What texts say of each drop: numbers, or else names, each a column of its own.
    pub fn of_texts(id: &str, waves: &Waves, chosen: &Chosen, text: impl Fn(&Record) -> Option<String>) -> Self {
        let said = |drops: Vec<Option<&Drop>>| drops.into_iter().map(|drop| drop.and_then(|drop| text(drop.record))).collect();
        let texts: Vec<Vec<Option<String>>> = chosen.behind(waves).into_iter().map(said).collect();
        let said = || texts.iter().flatten().flatten();
        let mut names: Vec<&String> = said().collect();
        names.sort();
        names.dedup();
        let values = |text: &String| match decimal(text).filter(|_| said().all(|text| decimal(text).is_some())) {
            Some(value) => vec![value],
            // One name less than there are: the last is where all others are 0.
            None => names.iter().skip(1).map(|name| f64::from(u8::from(*name == text))).collect(),
        };
        let values = texts.iter().map(|height| height.iter().map(|text| text.as_ref().map(values)).collect()).collect();
        Self { id: id.into(), values }
    }

    /// What it explains of the windows.
    pub fn explains(&self, waves: &Waves, seed: u64) -> CovariateEffect {
        let (mut values, mut windows) = (Vec::new(), Vec::new());
        for (group, known) in waves.groups.iter().zip(&self.values) {
            let known = group.windows.iter().zip(known).filter_map(|(window, value)| Some((value.clone()?, &window[..])));
            let (value, window): (Vec<Vec<f64>>, Vec<&[f64]>) = known.unzip();
            values.push(value);
            windows.push(window);
        }
        let drops = windows.iter().map(Vec::len).sum();
        let of = waves.groups.iter().map(|group| group.windows.len()).sum();
        let id = self.id.clone();
        let is_same = values.iter().all(|height| height.windows(2).all(|pair| pair[0] == pair[1]));
        let explained = if is_same { None } else { explained(&values, &windows) };
        let Some(explained) = explained else { return CovariateEffect { id, explained: None, p: None, drops, of, is_same } };
        let mut rng = Pcg64::seed_from_u64(seed);
        let as_much = (0..PERMUTED)
            .filter(|_| {
                let mut dealt = values.clone();
                dealt.iter_mut().for_each(|height| height.shuffle(&mut rng));
                self::explained(&dealt, &windows).is_some_and(|dealt| dealt >= explained)
            })
            .count();
        CovariateEffect { id, explained: Some(explained), p: Some((as_much + 1) as f64 / (PERMUTED + 1) as f64), drops, of, is_same }
    }
}

impl CovariateEffect {
    /// In a sentence.
    pub fn sentence(&self) -> String {
        let Self { id, explained, p, drops, of, is_same } = self;
        let known = if drops < of { format!("{id}, known of {drops} of {of} drops,") } else { id.clone() };
        match (explained, p) {
            (Some(explained), Some(p)) if *explained <= 0.0 => {
                format!(
                    "{known} explains nothing of the variation between drops of one height ({:.0} % out of sample, p = {})",
                    1e2 * explained,
                    p_value(*p)
                )
            }
            (Some(explained), Some(p)) => {
                format!("{known} explains {:.0} % of the variation between drops of one height (p = {})", 1e2 * explained, p_value(*p))
            }
            _ if *is_same => format!("{known} is the same for all drops of each height: what it explains cannot be told"),
            _ => format!("{known} has nearly as many values as drops from a height: what it explains cannot be told"),
        }
    }
}

/// Share that is explained out of sample; `None` where no height has enough drops for so many columns.
fn explained(values: &[Vec<Vec<f64>>], windows: &[Vec<&[f64]>]) -> Option<f64> {
    let (mut left, mut whole) = (0.0, 0.0);
    for (values, windows) in values.iter().zip(windows) {
        for part in 0..PARTS {
            let is_out = |drop: usize| drop % PARTS == part;
            let (mine, rest): (Vec<usize>, Vec<usize>) = (0..windows.len()).partition(|drop| is_out(*drop));
            let Some((a, b)) = sums_left(values, windows, &rest, &mine) else { continue };
            left += a;
            whole += b;
        }
    }
    (whole > 0.0).then(|| 1.0 - left / whole)
}

/// Sums of squares that the regression on some drops, and their mean alone, leave of others.
fn sums_left(values: &[Vec<f64>], windows: &[&[f64]], known: &[usize], others: &[usize]) -> Option<(f64, f64)> {
    let columns = values.first()?.len();
    let samples = windows.first()?.len();
    if known.len() < columns + 2 {
        return None;
    }
    let mean = |at: usize| known.iter().map(|drop| values[*drop][at]).sum::<f64>() / known.len() as f64;
    let means: Vec<f64> = (0..columns).map(mean).collect();
    let spread =
        |at: usize| (known.iter().map(|drop| (values[*drop][at] - means[at]).powi(2)).sum::<f64>() / known.len() as f64).sqrt().max(1e-30);
    let spreads: Vec<f64> = (0..columns).map(spread).collect();
    let row = |drop: usize, at: usize| (values[drop][at] - means[at]) / spreads[at];
    let design = DMatrix::from_fn(known.len(), columns, |i, at| row(known[i], at));
    let average = DVector::from_fn(samples, |i, _| known.iter().map(|drop| windows[*drop][i]).sum::<f64>() / known.len() as f64);
    let measured = DMatrix::from_fn(known.len(), samples, |i, sample| windows[known[i]][sample] - average[sample]);
    let normal = design.transpose() * &design + DMatrix::identity(columns, columns) * RIDGE;
    let slopes = inverse(&normal)? * design.transpose() * measured;
    let (mut left, mut whole) = (0.0, 0.0);
    for drop in others {
        let own = DVector::from_fn(columns, |at, _| row(*drop, at));
        let predicted = slopes.transpose() * own;
        for i in 0..samples {
            let off = windows[*drop][i] - average[i];
            left += (off - predicted[i]).powi(2);
            whole += off * off;
        }
    }
    Some((left, whole))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::Channel;
    use crate::impact::fit::Decimation;
    use crate::impact::measured::{Drop, FileFormat, TableFormat, read_bytes};

    /// Windows that grow with a value, and a little noise.
    fn windows(count: usize) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let value = |drop: usize| ((drop * 7919) % 101) as f64 / 101.0;
        let noise = |drop: usize, i: usize| ((drop * 31 + i * 17) % 13) as f64 / 13.0 - 0.5;
        let all = (0..count).map(|drop| (0..20).map(|i| value(drop) * i as f64 + 0.5 * noise(drop, i)).collect()).collect();
        ((0..count).map(|drop| vec![value(drop)]).collect(), all)
    }

    fn waves(windows: Vec<Vec<f64>>) -> Waves {
        let decimation = Decimation { native_s: 1e-3, kept_s: 1e-3 };
        let trials = (0..windows.len()).map(|drop| drop.to_string()).collect();
        let group = WaveGroup { height_m: 1.0, decimation, trials, mean: windows[0].clone(), windows };
        Waves { step_s: 1e-3, samples: group.mean.len(), noise_g: 0.1, groups: vec![group] }
    }

    #[test]
    fn analytic_what_drives_the_windows_is_found_and_what_does_not_is_not() {
        let (values, all) = windows(60);
        let waves = waves(all);
        let known = |values: Vec<Vec<f64>>| Covariate { id: "a".into(), values: vec![values.into_iter().map(Some).collect()] };
        let driven = known(values).explains(&waves, 1);
        assert!(driven.explained > Some(0.9) && driven.p < Some(0.01) && driven.drops == 60, "{driven:?}");
        let idle = Covariate::trial(&waves).explains(&waves, 1);
        assert!(idle.explained < Some(0.2) && idle.p > Some(0.02), "{idle:?}");
        let same = known(vec![vec![3.0]; 60]).explains(&waves, 1);
        assert_eq!((same.explained, same.p), (None, None));
    }

    #[test]
    fn analytic_names_drive_windows_and_unknown_values_are_left_out() {
        let (values, _) = windows(60);
        let named = |drop: usize| (!drop.is_multiple_of(7)).then(|| ["mat", "floor", "sand"][drop % 3]);
        let shift = |drop: usize| named(drop).map_or(9.0, |name| name.len() as f64);
        let waves = waves((0..60).map(|drop| (0..20).map(|i| shift(drop) * f64::from(i) + values[drop][0]).collect()).collect());
        let text: String = "trial,height_m,t_s,accel_g,surface\n".into();
        let rows =
            (0..60).map(|drop| format!("{drop},1,0,0,{0}\n{drop},1,0.001,9,{0}\n{drop},1,0.05,0,{0}\n", named(drop).unwrap_or_default()));
        let format = FileFormat { table: TableFormat { kept: vec!["surface".into()], ..TableFormat::default() }, ..FileFormat::default() };
        let set = read_bytes(&[("a.csv".into(), (text + &rows.collect::<String>()).into_bytes())], &format).expect("reads");
        let chosen = Chosen { drops: Vec::new(), channel: Channel::Axial, left_out: Vec::new(), impulses_kept: true };
        let drop = |record| Drop { record, impact: None, flags: Vec::new(), zero_g: [0.0; 3] };
        let chosen = Chosen { drops: set.records().map(drop).collect(), ..chosen };
        let surface = Covariate::of_texts("surface", &waves, &chosen, |record| record.column("surface").map(String::from));
        let found = surface.explains(&waves, 1);
        assert!(found.explained > Some(0.9) && found.p < Some(0.01) && found.drops == 51, "{found:?}");
    }
}
