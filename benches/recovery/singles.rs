//! One effect a time, at five strengths: names, intervals, held-out gaps, time.

use std::collections::BTreeMap;

use flexframe::impact::effects::CATALOGUE;

use crate::case::diagnosed;
use crate::truth::{DETECTABLE, STRENGTHS, at_strength, noncentrality};

#[derive(Default)]
struct Sums {
    table: BTreeMap<String, Vec<[usize; 2]>>,
    curve: BTreeMap<usize, [usize; 2]>,
    confused: BTreeMap<(String, String), usize>,
    ratios: Vec<f64>,
    /// Intervals that hold the truth, and how many there are, by parameter.
    covered: BTreeMap<&'static str, [usize; 2]>,
    seconds: Vec<f64>,
    stronger: [usize; 2],
    /// First of the ranking of single effects, whatever the verdict; a strength each, and how many there are.
    ranked: [[usize; 2]; STRENGTHS.len()],
}

pub fn singles(level: usize, from: u64, to: u64, only: Option<&str>) {
    let mut sums = Sums::default();
    for spec in CATALOGUE.iter().filter(|spec| only.is_none_or(|only| only == spec.id)) {
        for seed in from..to {
            for (at, strength) in STRENGTHS.iter().enumerate() {
                let Some(plan) = at_strength(spec.id, seed, *strength, level) else { continue };
                let found = noncentrality(&plan).unwrap_or(f64::NAN);
                let case = diagnosed(&plan);
                let good = case.first() == Some(spec.id);
                let ratio = case.ratio(&plan);
                let covered = case.covered(&plan.model);
                let missed: Vec<&str> = covered.iter().filter(|(_, held)| !held).map(|(key, _)| *key).collect();
                let values = plan.model.effects.last().map(|listed| listed.values.clone()).unwrap_or_default();
                println!(
                    "{} {} {values:.3?} nc {found:.0} top {} ratio {:.2} missed {missed:?}: {}",
                    if good { "ok " } else { "BAD" },
                    spec.id,
                    case.top(),
                    ratio.unwrap_or(f64::NAN),
                    case.line()
                );
                let row = sums.table.entry(spec.id.into()).or_insert_with(|| vec![[0; 2]; STRENGTHS.len()]);
                row[at][0] += usize::from(good);
                row[at][1] += 1;
                let bin = sums.curve.entry((libm::log2(found.max(1.0)) as usize).min(10)).or_default();
                bin[0] += usize::from(good);
                bin[1] += 1;
                sums.ranked[at][0] += usize::from(case.top() == spec.id);
                sums.ranked[at][1] += 1;
                if at > 0 {
                    sums.stronger[0] += usize::from(good);
                    sums.stronger[1] += 1;
                }
                if found > DETECTABLE {
                    sums.ratios.extend(ratio);
                    *sums.confused.entry((spec.id.into(), case.first().unwrap_or("nothing").into())).or_default() += 1;
                }
                for (key, held) in covered {
                    let count = sums.covered.entry(key).or_default();
                    *count = [count[0] + usize::from(held), count[1] + 1];
                }
                sums.seconds.push(case.seconds);
            }
        }
    }
    summary(level, &mut sums);
}

fn summary(level: usize, sums: &mut Sums) {
    println!("\n| effect | {} |", STRENGTHS.map(|strength| strength.to_string()).join(" | "));
    for (id, row) in &sums.table {
        println!("| {id} | {} |", row.iter().map(|cell| format!("{}/{}", cell[0], cell[1])).collect::<Vec<_>>().join(" | "));
    }
    for (bin, [good, all]) in &sums.curve {
        println!("CURVE level {level}: noncentrality {}..{}: {good}/{all}", 1 << bin, 1 << (bin + 1));
    }
    for ((truth, named), count) in sums.confused.iter().filter(|((truth, named), _)| truth != named) {
        println!("CONFUSED level {level}: {truth} named {named}: {count}");
    }
    let (good, all) = sums.table.values().flatten().fold((0, 0), |(good, all), cell| (good + cell[0], all + cell[1]));
    let wrong: usize = sums.confused.iter().filter(|((truth, named), _)| truth != named).map(|(_, count)| count).sum();
    let detectable: usize = sums.confused.values().sum();
    sums.ratios.sort_by(f64::total_cmp);
    sums.seconds.sort_by(f64::total_cmp);
    let middle = |values: &[f64], part: f64| values.get((values.len() as f64 * part) as usize).copied().unwrap_or(f64::NAN);
    println!(
        "SINGLES level {level}: detectable {}/{detectable}, all {good}/{all}, four stronger {}/{}",
        detectable - wrong,
        sums.stronger[0],
        sums.stronger[1]
    );
    let ranked = sums.ranked.iter().fold([0, 0], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
    println!("RANKED FIRST level {level}: {:?}, all {}/{}", sums.ranked, ranked[0], ranked[1]);
    let held = sums.covered.values().fold([0, 0], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
    println!("COVERAGE level {level}: {}/{}, by parameter {:?}", held[0], held[1], sums.covered);
    println!("HELD OUT level {level}: median ratio {:.3}, 90 % below {:.3}", middle(&sums.ratios, 0.5), middle(&sums.ratios, 0.9));
    println!("TIME level {level}: median {:.2} s, 95 % below {:.2} s", middle(&sums.seconds, 0.5), middle(&sums.seconds, 0.95));
}
