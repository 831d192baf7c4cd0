//! How often the diagnoses of a study are right: shares with their intervals, by level of noise and law of the scatter.

use std::collections::BTreeMap;

use super::findings::LANDING_KEYS;
use super::known_rows::{KnownRow, known_rows};
use super::setting::Recovery;
use super::share::Share;
use super::truth::Truth;
use crate::impact::landing::LANDING_TILT;
use crate::impact::measured::quantile;
use crate::impact::synthetic::ScatterLaw;
use crate::study::outcomes::Outcomes;
use crate::study::plan::Study;

/// What is known of one thing.
#[derive(Clone, Debug, PartialEq)]
pub enum Fact {
    /// Some of several.
    Share(Share),
    /// A number.
    Number(f64),
    /// Words.
    Words(String),
    /// Nothing: no row says it.
    None,
}

/// A table of facts.
pub struct Table {
    /// What it says.
    pub title: &'static str,
    /// What its lines are.
    pub of: &'static str,
    /// The lines: what each is of, and a fact for each setting.
    pub lines: Vec<(String, Vec<Fact>)>,
}

/// How often the diagnoses of a study are right.
pub struct Accuracy {
    /// Level and law of each column of the tables.
    pub settings: Vec<(usize, ScatterLaw)>,
    /// The tables.
    pub tables: Vec<Table>,
}

/// The rows of one level and law.
type Rows<'a> = [KnownRow<'a>];
/// What a line says of them.
type Says = fn(&Rows) -> Fact;

/// The tables of a study of hidden effects from the rows that are known.
pub fn accuracy(study: &Study, recovery: &Recovery, outcomes: &Outcomes) -> Accuracy {
    let mut by_setting: Vec<((usize, ScatterLaw), Vec<KnownRow>)> = Vec::new();
    for row in known_rows(study, recovery, outcomes) {
        let setting = (row.case.level, row.case.law);
        match by_setting.iter_mut().find(|(known, _)| *known == setting) {
            Some((_, rows)) => rows.push(row),
            None => by_setting.push((setting, vec![row])),
        }
    }
    let lines = |all: Lines| {
        let line = |(name, says): Line| (name, by_setting.iter().map(|(_, rows)| says(rows)).collect());
        all.into_iter().map(line).filter(|(_, facts): &(String, Vec<Fact>)| facts.iter().any(|fact| *fact != Fact::None)).collect()
    };
    let boxed = |(name, says): (&str, Says)| -> Line { (name.to_string(), Box::new(says)) };
    let table = |title, of, lines: Vec<(String, Vec<Fact>)>| Table { title, of, lines };
    let tables = vec![
        table("Summary", "share", lines(SUMMARY.into_iter().map(boxed).collect())),
        table("Named first, by effect", "effect", lines(by_effect(recovery))),
        table("Named first, by strength", "strength", lines(by_strength(recovery))),
        table("Named first, by noncentrality", "noncentrality", lines(by_noncentrality())),
        table("Landings named, by what they are", "landings", lines(by_landing(recovery))),
        table("Landings that slope and are not named, by the first test that failed", "landings", lines(failed_tests(recovery))),
        table("Intervals that contain the truth, by parameter", "parameter", lines(by_parameter(recovery))),
        table("Detectable effects that were named wrongly", "effect", lines(mistaken(recovery))),
    ];
    let settings = by_setting.iter().map(|(setting, _)| *setting).collect();
    Accuracy { settings, tables: tables.into_iter().filter(|table| !table.lines.is_empty()).collect() }
}

/// The lines of the summary.
const SUMMARY: [(&str, Says); 25] = [
    ("named first, of those detectable (noncentrality > 30)", |rows| right(rows, |row| row.is_one() && row.is_detectable())),
    ("named first, of all strengths", |rows| right(rows, |row| row.is_one())),
    ("named first, of all strengths but the least", |rows| right(rows, |row| row.is_one() && !row.is_weakest)),
    ("first in the ranking whatever the verdict, of all strengths", |rows| of(rows, |row| row.is_one(), |row| row.is_first("first"))),
    ("right, of the verdicts `named`", |rows| right(rows, |row| row.is_one() && row.word("verdict") == Some("named"))),
    ("false alarms where nothing is hidden", |rows| of(rows, |row| row.is_nothing(), |row| row.is_right().map(|right| !right))),
    ("p of their p-values being uniform", |rows| uniform(rows, "p.before")),
    ("pairs exactly right", |rows| right(rows, |row| row.is_pair())),
    ("the same, where each effect alone leaves more than 30", |rows| right(rows, |row| row.is_pair() && row.leaves("left.alone"))),
    ("the same, where every other set is more than 30 away", |rows| right(rows, |row| row.is_pair() && row.leaves("left.rival"))),
    ("effects outside the catalogue of which it leaves more than 30: `none_suffices` or `ambiguous`", |rows| {
        right(rows, |row| row.is_outside())
    }),
    ("95 % intervals that contain the truth", |rows| covered(rows, None)),
    ("held-out gap at 2 m where detectable, after/before, median", |rows| held_out(rows, 0.5)),
    ("the same, 90 % below", |rows| held_out(rows, 0.9)),
    ("ceiling: named first, of all strengths", |rows| mean(rows, "ceiling.right", |_| true)),
    ("ceiling: named first, of all strengths but the least", |rows| mean(rows, "ceiling.right", |row| !row.is_weakest)),
    ("ceiling: of the detectable, for somebody who knows that they are", |rows| mean(rows, "ceiling.detectable", |_| true)),
    ("ceiling: first in the ranking, without the limit on alarms", |rows| mean(rows, "ceiling.first", |_| true)),
    ("what single records tell beside their mean, noncentrality, median", |rows| median_of(rows, "ceiling.single_records")),
    ("with the generator's covariance: first in the ranking, of all strengths", |rows| {
        of(rows, |row| row.is_one() && row.word("known_covariance.first").is_some(), |row| row.is_first("known_covariance.first"))
    }),
    ("landings that slope: `landing_tilt` named", |rows| right(rows, |row| row.slopes() == Some(true))),
    ("level landings: `landing_tilt` named", |rows| of(rows, |row| row.slopes() == Some(false), |row| row.is_right().map(|right| !right))),
    ("p of the p-values of `enough` being uniform where landings slope", |rows| uniform(rows, "landing.p.enough")),
    ("the same of `spread`", |rows| uniform(rows, "landing.p.spread")),
    ("refused", |rows| Fact::Number(rows.iter().filter(|row| row.is_refused()).count() as f64)),
];

fn of(rows: &Rows, counts: impl Fn(&KnownRow) -> bool, good: impl Fn(&KnownRow) -> Option<bool>) -> Fact {
    let found: Vec<bool> = rows.iter().filter(|row| counts(row)).filter_map(good).collect();
    Share::of(found).map_or(Fact::None, Fact::Share)
}

fn right(rows: &Rows, counts: impl Fn(&KnownRow) -> bool) -> Fact {
    of(rows, counts, |row| row.is_right())
}

fn covered(rows: &Rows, parameter: Option<&str>) -> Fact {
    let all = rows.iter().filter(|row| row.is_one() || row.slopes() == Some(true)).flat_map(KnownRow::covered);
    Share::of(all.filter(|(key, _)| parameter.is_none_or(|of| of == key)).map(|(_, held)| held).collect()).map_or(Fact::None, Fact::Share)
}

/// The value below which a part of the values lies.
fn part(mut values: Vec<f64>, part: f64) -> Fact {
    values.sort_by(f64::total_cmp);
    quantile(&values, part).map_or(Fact::None, Fact::Number)
}

fn held_out(rows: &Rows, below: f64) -> Fact {
    let ratio = |row: &KnownRow| Some(row.figure("held_out.after")? / row.figure("held_out.before")?);
    part(rows.iter().filter(|row| row.is_one() && row.is_detectable()).filter_map(ratio).collect(), below)
}

fn median_of(rows: &Rows, name: &str) -> Fact {
    part(rows.iter().filter_map(|row| row.figure(name)).collect(), 0.5)
}

fn mean(rows: &Rows, name: &str, counts: impl Fn(&KnownRow) -> bool) -> Fact {
    let values: Vec<f64> = rows.iter().filter(|row| counts(row)).filter_map(|row| row.figure(name)).collect();
    if values.is_empty() { Fact::None } else { Fact::Number(values.iter().sum::<f64>() / values.len() as f64) }
}

/// p-value of the largest distance between the p-values of rows that are what is tested, sloped landings or nothing hidden, and the even
/// distribution on 0 to 1 (Kolmogorov's limit, with M. A. Stephens' factor for few values, J. R. Stat. Soc. B 32 (1970) 115).
fn uniform(rows: &Rows, name: &str) -> Fact {
    let is_tested = |row: &&KnownRow| if name.starts_with("landing.") { row.slopes() == Some(true) } else { row.is_nothing() };
    let mut values: Vec<f64> = rows.iter().filter(is_tested).filter_map(|row| row.figure(name)).collect();
    if values.is_empty() {
        return Fact::None;
    }
    values.sort_by(f64::total_cmp);
    let count = values.len() as f64;
    let off = |(at, value): (usize, &f64)| f64::max(value - at as f64 / count, (at as f64 + 1.0) / count - value);
    let distance = values.iter().enumerate().map(off).fold(0.0, f64::max);
    let scaled = distance * (count.sqrt() + 0.12 + 0.11 / count.sqrt());
    let term = |k: i32| 2.0 * f64::from(1 - 2 * ((k + 1) % 2)) * libm::exp(-2.0 * f64::from(k * k) * scaled * scaled);
    Fact::Number((1..=100).map(term).sum::<f64>().clamp(0.0, 1.0))
}

/// A line: what it is of, and what it says of rows.
type Line = (String, Box<dyn Fn(&Rows) -> Fact>);
type Lines = Vec<Line>;

fn by_effect(recovery: &Recovery) -> Lines {
    let line = |id: &'static str| -> Line { (id.into(), Box::new(move |rows: &Rows| right(rows, |row| row.is_of(id)))) };
    recovery.effects.iter().map(|spec| line(spec.id)).collect()
}

fn by_strength(recovery: &Recovery) -> Lines {
    let line = |strength: f64| -> Line {
        (strength.to_string(), Box::new(move |rows: &Rows| right(rows, |row| row.is_one() && row.case.strength == Some(strength))))
    };
    recovery.strengths.iter().map(|strength| line(*strength)).collect()
}

/// Doubling from 8 on.
fn by_noncentrality() -> Lines {
    let bounds = [1.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0, f64::INFINITY];
    let line = |least: f64, most: f64| -> Line {
        let name = if most.is_finite() { format!("{least} to {most}") } else { format!("{least} and more") };
        let within = move |row: &KnownRow| row.figure("noncentrality").is_some_and(|found| (least..most).contains(&found.max(1.0)));
        (name, Box::new(move |rows: &Rows| right(rows, |row| row.is_one() && within(row))))
    };
    bounds.windows(2).map(|ends| line(ends[0], ends[1])).collect()
}

fn by_parameter(recovery: &Recovery) -> Lines {
    let own = recovery.effects.iter().flat_map(|spec| spec.parameters.iter().map(|parameter| format!("{}.{}", spec.id, parameter.key)));
    let slopes = LANDING_KEYS[2..].iter().map(|key| format!("{LANDING_TILT}.{key}"));
    let line = |key: String| -> Line { (key.clone(), Box::new(move |rows: &Rows| covered(rows, Some(&key)))) };
    ["k".to_string(), "c".into()].into_iter().chain(own).chain(slopes).map(line).collect()
}

/// The names of the landings of a study, each once.
fn landings(recovery: &Recovery) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for case in recovery.cases.iter().filter(|case| matches!(case.truth, Truth::Landing(_))) {
        if !names.contains(&case.truth.name()) {
            names.push(case.truth.name());
        }
    }
    names
}

fn by_landing(recovery: &Recovery) -> Lines {
    let named =
        |name: String| move |rows: &Rows| of(rows, |row| row.case.truth.name() == name, |row| Some(row.figure("landing.named")? == 1.0));
    landings(recovery).into_iter().map(|name| -> Line { (name.clone(), Box::new(named(name))) }).collect()
}

fn failed_tests(recovery: &Recovery) -> Lines {
    let line = |name: String| -> Line {
        let of = name.clone();
        let says = move |rows: &Rows| {
            let sloped = rows.iter().filter(|row| row.slopes() == Some(true) && row.case.truth.name() == of);
            counted(sloped.filter_map(|row| row.word("landing.failed")))
        };
        (name, Box::new(says))
    };
    landings(recovery).into_iter().map(line).collect()
}

/// How often each of these words occurs.
fn counted<'a>(words: impl Iterator<Item = &'a str>) -> Fact {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    words.for_each(|word| *counts.entry(word).or_default() += 1);
    let listed: Vec<String> = counts.into_iter().map(|(word, count)| format!("{word} {count}")).collect();
    if listed.is_empty() { Fact::None } else { Fact::Words(listed.join(", ")) }
}

/// The wrong names of each effect, with how often.
fn mistaken(recovery: &Recovery) -> Lines {
    let line = |id: &'static str| -> Line {
        let says = move |rows: &Rows| {
            let wrong = rows.iter().filter(|row| row.is_of(id) && row.is_detectable() && row.is_right() == Some(false));
            counted(wrong.map(|row| row.word("named").unwrap_or("nothing")))
        };
        (id.into(), Box::new(says))
    };
    recovery.effects.iter().map(|spec| line(spec.id)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::files::Memory;
    use crate::study::outcomes::Outcome;

    /// A row's figures by the names of its columns.
    fn learnt(study: &Study, figures: &[(&str, f64)]) -> Outcome {
        let of = |name: String| figures.iter().find(|(known, _)| *known == name).map(|(_, figure)| *figure);
        Outcome::Figures(study.columns.iter().map(|column| of(column.name())).collect())
    }

    fn fact<'a>(found: &'a Accuracy, title: &str, line: &str) -> &'a Fact {
        let table = found.tables.iter().find(|table| table.title == title).expect("the table");
        &table.lines.iter().find(|(name, _)| name == line).expect("the line").1[0]
    }

    #[test]
    fn analytic_landings_are_counted_by_what_they_are() {
        let plan = "kind = \"recovery\"\nrates_rad_s = [0.2]\nmeasures = [\"right\", \"landing.named\", \"landing.failed\", \"parameter.2.true\", \
                    \"parameter.2.least\", \"parameter.2.most\"]\n[seeds]\nsloped = [1, 4]\nlevel = [1, 2]\n";
        let files = Memory([("s.toml".into(), plan.as_bytes().to_vec())].into_iter().collect());
        let study = crate::study::load("s.toml", &files).expect("is a plan");
        let crate::study::Subject::Recovery(recovery) = &study.subject else { panic!("is none") };
        let mut outcomes = Outcomes::none(6);
        let rate = |least: f64| {
            [("right", 1.0), ("landing.named", 1.0), ("parameter.2.true", 0.2), ("parameter.2.least", least), ("parameter.2.most", 0.3)]
        };
        outcomes.learn(0, learnt(&study, &rate(0.1)));
        outcomes.learn(1, learnt(&study, &rate(0.25)));
        outcomes.learn(2, learnt(&study, &[("right", 0.0), ("landing.named", 0.0), ("landing.failed", 6.0)]));
        outcomes.learn(3, learnt(&study, &[("right", 1.0), ("landing.named", 0.0)]));
        outcomes.learn(4, learnt(&study, &[("right", 0.0), ("landing.named", 1.0)]));
        let found = accuracy(&study, recovery, &outcomes);
        let share = |good, all| Fact::Share(Share { good, all });
        assert_eq!(fact(&found, "Summary", "landings that slope: `landing_tilt` named"), &share(2, 3));
        assert_eq!(fact(&found, "Summary", "level landings: `landing_tilt` named"), &share(1, 2));
        assert_eq!(fact(&found, "Landings named, by what they are", "level, ringing"), &share(1, 1));
        let failed = fact(&found, "Landings that slope and are not named, by the first test that failed", "landing_tilt 0.2 rad/s");
        assert_eq!(failed, &Fact::Words("spread 1".into()));
        let parameter = fact(&found, "Intervals that contain the truth, by parameter", "landing_tilt.sigma_r_rad_s");
        assert_eq!(parameter, &share(1, 2));
    }

    #[test]
    fn analytic_shares_are_counted_by_kind_strength_and_verdict() {
        let plan = "kind = \"recovery\"\nstrengths = [5, 100]\neffects = [\"preload\"]\n[seeds]\nnothing = [1, 5]\none = [1, 3]\noutside = [0, 4]\n";
        let files = Memory([("s.toml".into(), plan.as_bytes().to_vec())].into_iter().collect());
        let study = crate::study::load("s.toml", &files).expect("is a plan");
        let crate::study::Subject::Recovery(recovery) = &study.subject else { panic!("is none") };
        assert_eq!(study.rows(), 4 + 4 + 4);
        let mut outcomes = Outcomes::none(12);
        for (row, right) in [1.0, 1.0, 0.0, 1.0].into_iter().enumerate() {
            outcomes.learn(row, learnt(&study, &[("right", right), ("p.before", 0.2 + 0.2 * row as f64)]));
        }
        // Strengths 5 and 100 of two seeds: the weak are missed, of the strong one is refused.
        let weak = [("right", 0.0), ("noncentrality", 6.0)];
        let interval = [("k.true", 2.0), ("k.found", 2.1), ("k.least", 1.9), ("k.most", 2.2)];
        let strong = [("right", 1.0), ("noncentrality", 90.0), ("held_out.before", 8.0), ("held_out.after", 2.0)];
        outcomes.learn(4, learnt(&study, &weak));
        outcomes.learn(5, learnt(&study, &[&strong[..], &interval].concat()));
        outcomes.learn(6, learnt(&study, &weak));
        outcomes.learn(7, Outcome::Refused("no".into()));
        // A stranger of which the catalogue leaves little is no stranger.
        outcomes.learn(8, learnt(&study, &[("right", 0.0), ("left.rival", 3.0)]));
        outcomes.learn(9, learnt(&study, &[("right", 1.0), ("left.rival", 300.0)]));
        outcomes.learn(10, learnt(&study, &[("right", 1.0)]));
        let found = accuracy(&study, recovery, &outcomes);
        let share = |good, all| Fact::Share(Share { good, all });
        assert_eq!(fact(&found, "Summary", "named first, of all strengths"), &share(1, 3));
        assert_eq!(fact(&found, "Summary", "named first, of all strengths but the least"), &share(1, 1));
        assert_eq!(fact(&found, "Summary", "named first, of those detectable (noncentrality > 30)"), &share(1, 1));
        assert_eq!(fact(&found, "Summary", "false alarms where nothing is hidden"), &share(1, 4));
        assert_eq!(fact(&found, "Summary", "95 % intervals that contain the truth"), &share(1, 1));
        assert_eq!(fact(&found, "Summary", "held-out gap at 2 m where detectable, after/before, median"), &Fact::Number(0.25));
        assert_eq!(fact(&found, "Summary", "refused"), &Fact::Number(1.0));
        let outsiders = "effects outside the catalogue of which it leaves more than 30: `none_suffices` or `ambiguous`";
        assert_eq!(fact(&found, "Summary", outsiders), &share(2, 2));
        assert_eq!(fact(&found, "Named first, by strength", "5"), &share(0, 2));
        assert_eq!(fact(&found, "Named first, by effect", "preload"), &share(1, 3));
        assert_eq!(fact(&found, "Intervals that contain the truth, by parameter", "k"), &share(1, 1));
        let Fact::Number(p) = fact(&found, "Summary", "p of their p-values being uniform") else { panic!("no p") };
        assert!(*p > 0.9, "0.2, 0.4, 0.6 and 0.8 are as even as four can be: {p}");
    }
}
