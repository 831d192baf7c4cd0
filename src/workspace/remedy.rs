//! Remedies: the change of one key that clears a violation. It is tried on the frame before it is named.
//!
//! The levers of a violated rule are moved, each alone and step by step up to its bounds, until the rule holds; then the step is made as
//! small as it can be, and every rule but the fold's is asked about the frame with it. Where no lever helps, and none of them chooses a bought
//! part, the rods and what else drives the parts that the violation names are tried, and another choice of what sets the limit, such as the
//! printer. This takes seconds: it is for a person who reads a report, not for a search.
//!
//! A change that takes back what the user's file asks for comes last, and is called so; before it stands what follows from the wish (`wishes`). Of
//! warnings those are looked at that another choice of material or printer clears.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::wishes::Wishes;
use crate::checks::{self, CATALOGUE, Cost, Finding, Rule, Verdict};
use crate::figures::decimals;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass;
use crate::memo::Memo;
use crate::params::frame_file::Value;
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile, follows, parameters, preset};

/// Rods are tried for every violation.
const RODS: [&str; 3] = ["rods.cage_rod_length_mm", "rods.arm_rod_length_mm", "rods.strut_rod_length_mm"];
/// First step, as a share of the value, and of the way between the bounds where that is more.
const FIRST_STEP: [f64; 2] = [0.02, 0.01];
/// A step is twice the one before it, so many times.
const DOUBLINGS: i32 = 6;
/// Steps without effect after which a direction is given up.
const PATIENCE: usize = 5;
/// How often the last step is halved.
const HALVINGS: usize = 5;
/// Share of the value by which other keys are moved to see whether they have an effect.
const PROBE: f64 = 0.2;
/// Shares of that step, of which the largest that leaves a frame counts.
const PROBES: [f64; 2] = [1.0, 0.4];
/// Keys, beyond the levers, that are tried in earnest: those with the most effect.
const OTHERS: usize = 3;
/// Remedies that are named for a violation.
const NAMED: usize = 2;
/// Groups of violations that are looked at; the first are the report's first.
const GROUPS: usize = 8;

/// A change that clears a violation.
#[derive(Clone, Debug, PartialEq)]
pub struct Remedy {
    /// The key, with its table.
    pub key: String,
    /// Its value now.
    pub from: String,
    /// The value that clears the violation.
    pub to: String,
    /// By how much the frame gets heavier, g.
    pub heavier_g: f64,
    /// What is violated then that was not before, the first of it.
    pub breaks: Option<String>,
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, from, to, heavier_g, breaks } = self;
        let sign = if *heavier_g < 0.0 { "" } else { "+" };
        write!(f, "{key} {from} -> {to} clears it ({sign}{} g)", decimals(*heavier_g, 1))?;
        breaks.as_ref().map_or(Ok(()), |broken| write!(f, ", but breaks {broken}"))
    }
}

/// What a person reads of the remedies for each finding, in their order: empty for what is not violated, or was not looked at.
pub fn advice(file: &FrameFile, findings: &[Finding], memo: &Arc<Memo>) -> Vec<String> {
    let Some(bench) = Bench::new(file, memo).filter(|_| findings.iter().any(asks)) else {
        return vec![String::new(); findings.len()];
    };
    let (mut groups, mut told): (Vec<(&Finding, String)>, Vec<String>) = (Vec::new(), Vec::new());
    for finding in findings {
        let known = groups.iter().find(|(known, _)| alike(known, finding)).map(|(_, text)| text.clone());
        told.push(match known {
            _ if !asks(finding) || !bench.sees(finding) => String::new(),
            Some(text) => text,
            None if groups.len() >= GROUPS => not_looked_at(finding),
            None => {
                let text = bench.sentence(finding);
                groups.push((finding, text.clone()));
                text
            }
        });
    }
    told
}

/// What is said of a violation beyond the groups that are looked at.
fn not_looked_at(finding: &Finding) -> String {
    let levers = if finding.levers.is_empty() { String::new() } else { format!("driven by {}; ", finding.levers.join(", ")) };
    format!("{levers}no remedy was looked for: it is for the first {GROUPS} kinds of violation, ask again when these are mended")
}

/// Whether one remedy is to clear both.
fn alike(a: &Finding, b: &Finding) -> bool {
    let both_warn = [a, b].iter().all(|f| f.verdict == Verdict::Note);
    a.rule == b.rule && a.levers == b.levers && (a.unit == b.unit || both_warn)
}

/// Whether remedies are looked for: of a violation, and of a warning that another choice may clear.
fn asks(finding: &Finding) -> bool {
    let is_choice = |lever: &Cow<str>| !preset::names_for(lever).is_empty();
    let is_chosen = !finding.levers.is_empty() && finding.levers.iter().all(is_choice);
    finding.verdict == Verdict::Violated || finding.warns() && is_chosen
}

fn joined(remedies: &[Remedy]) -> String {
    remedies.iter().map(Remedy::to_string).collect::<Vec<_>>().join("; or ")
}

/// The frame on which changes are tried.
struct Bench<'a> {
    file: &'a FrameFile,
    frame: Frame,
    memo: &'a Arc<Memo>,
    mass_g: f64,
    found: Vec<Finding>,
    wishes: Wishes<'a>,
    /// What keeps the wishes, looked for once.
    kept_by: OnceLock<Option<String>>,
}

impl<'a> Bench<'a> {
    /// None for a frame that cannot be designed.
    fn new(file: &'a FrameFile, memo: &'a Arc<Memo>) -> Option<Self> {
        let frame = Frame::resolve(file).ok()?;
        let design = Design::with(frame.clone(), memo).ok()?;
        let masses = mass::table(&design);
        let found = checks::check_by(&all_but_the_fold(), Cost::Slow, &design, &masses);
        let (wishes, kept_by) = (Wishes::of(file), OnceLock::new());
        Some(Self { file, frame, memo, mass_g: masses.total_g, found, wishes, kept_by })
    }

    /// Whether it is found again: only then its end can be seen.
    fn sees(&self, finding: &Finding) -> bool {
        self.found.iter().any(|f| f.rule == finding.rule && f.subject == finding.subject && asks(f))
    }

    /// What a person reads of the remedies of a finding.
    fn sentence(&self, finding: &Finding) -> String {
        let (back, mut other): (Vec<Remedy>, Vec<Remedy>) = self.remedies(finding).into_iter().partition(|remedy| self.takes_back(remedy));
        if finding.verdict == Verdict::Note {
            other.extend(back.iter().cloned());
        }
        if other.iter().any(|remedy| remedy.breaks.is_none()) || (back.is_empty() && !other.is_empty() && !self.has_wishes(finding)) {
            return joined(&other);
        }
        let kept = self.kept_by.get_or_init(|| self.wishes.kept_by(self.memo, &all_but_the_fold()));
        match (kept, &back[..], &other[..]) {
            (Some(kept), ..) if finding.verdict == Verdict::Violated => kept.clone(),
            // What warns says itself what is done about it.
            (_, [], []) if finding.warns() => String::new(),
            (_, [], []) => self.wishes.nothing_found(),
            (_, _, [_, ..]) => joined(&other),
            _ => format!("all that was found takes back what the file asks for: {}", joined(&back)),
        }
    }

    /// Whether a remedy takes back a wish.
    fn takes_back(&self, remedy: &Remedy) -> bool {
        self.wishes.takes_back(&remedy.key, [&remedy.from, &remedy.to].map(|value| value.parse().ok()))
    }

    /// Whether a key that drives a finding is a wish.
    fn has_wishes(&self, finding: &Finding) -> bool {
        finding.levers.iter().any(|lever| self.wishes.has(lever))
    }

    /// The frame with a key changed; none where that is refused.
    fn design(&self, key: &str, value: &Value) -> Option<Design> {
        let mut file = self.file.clone();
        file.set(key, value.clone());
        Design::with(Frame::resolve(&file).ok()?, self.memo).ok()
    }

    /// The least margin of the findings that are like this one, with a key changed; none where there is no such frame. A choice after which the
    /// rule says nothing of its kind is not known to clear it.
    fn margin(&self, finding: &Finding, rule: &Rule, key: &str, value: &Value) -> Option<f64> {
        let design = self.design(key, value)?;
        let found = checks::check_one(rule, &design, &mass::table(&design));
        let of_kind =
            |f: &&Finding| alike(f, finding) || finding.verdict == Verdict::Note && f.rule == finding.rule && f.levers == finding.levers;
        let counts = |f: &&Finding| f.verdict != Verdict::Note || finding.verdict == Verdict::Note;
        if matches!(value, Value::Text(_)) && !found.iter().any(|f| of_kind(&f)) {
            return None;
        }
        let same = found.iter().filter(counts).filter(|f| of_kind(f) || f.subject == finding.subject);
        Some(same.map(|f| f.margin).fold(f64::INFINITY, f64::min))
    }

    /// The remedies of a violation, the lightest change first; those that break something else only where there are no others.
    fn remedies(&self, finding: &Finding) -> Vec<Remedy> {
        let Some(rule) = CATALOGUE.iter().find(|rule| rule.id == finding.rule) else { return Vec::new() };
        let levers: Vec<&str> = finding.levers.iter().map(|lever| &**lever).collect();
        let of = |keys: &[String]| -> Vec<Remedy> { keys.par_iter().flat_map_iter(|key| self.by_key(finding, rule, key)).collect() };
        let mut found = of(&self.chosen(&levers));
        // A bought part that is in the way is replaced, not built around.
        let bought = levers.iter().any(|lever| lever.starts_with("bought."));
        if !bought && finding.verdict == Verdict::Violated && found.iter().all(|remedy| remedy.breaks.is_some() || self.takes_back(remedy))
        {
            found.extend(of(&self.effective(finding, rule, &levers)));
            let limit = rule.limit_key(&finding.subject).filter(|key| !levers.contains(key));
            found.extend(limit.and_then(|key| self.by_name(finding, rule, key)));
        }
        if found.iter().any(|remedy| remedy.breaks.is_none()) {
            found.retain(|remedy| remedy.breaks.is_none());
        }
        found.sort_by_key(|remedy| self.takes_back(remedy));
        found.truncate(NAMED);
        found
    }

    /// What a person chooses: instead of a number that follows from a bought part the choice of that part, unless the file states the number.
    fn chosen(&self, levers: &[&str]) -> Vec<String> {
        let mut keys = Vec::new();
        for lever in levers {
            let role = lever.rsplit('.').next().and_then(follows::role_of).filter(|_| !self.file.entries.contains_key(*lever));
            let key = role.map_or_else(|| (*lever).to_string(), |role| format!("bought.{role}"));
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        keys
    }

    /// Other keys with an effect, the most effective first: rods, and what drives the parts that the subject names.
    fn effective(&self, finding: &Finding, rule: &Rule, levers: &[&str]) -> Vec<String> {
        let drives = |p: &&Parameter| p.drives.iter().any(|part| finding.subject.contains(part.slug()));
        let driving = parameters().filter(drives).filter(|p| p.table != "fit").map(|p| format!("{}.{}", p.table, p.key));
        let keys: BTreeSet<String> = driving.chain(RODS.map(String::from)).filter(|key| !levers.contains(&key.as_str())).collect();
        let keys: Vec<String> = keys.into_iter().collect();
        let gain = |key: &String| {
            let parameter = parameter(key)?;
            let value = self.frame.value(parameter.table, parameter.key)?;
            let step = PROBE * value.abs().max(0.1 * (parameter.max - parameter.min));
            let margin = |to: f64| self.margin(finding, rule, key, &Value::Number(to.clamp(parameter.min, parameter.max)));
            // A whole step may leave no frame where a part of it helps.
            let probed = |way: f64| PROBES.into_iter().find_map(|share| margin(value + way * share * step));
            [1.0, -1.0].into_iter().filter_map(probed).reduce(f64::max).map(|margin| (margin, key.clone()))
        };
        let mut gains: Vec<(f64, String)> =
            keys.par_iter().filter_map(gain).filter(|(margin, _)| *margin > finding.margin + 1e-6).collect();
        gains.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        gains.into_iter().take(OTHERS).map(|(_, key)| key).collect()
    }

    /// The smallest change of one key that clears a violation.
    fn by_key(&self, finding: &Finding, rule: &Rule, key: &str) -> Option<Remedy> {
        match parameter(key) {
            Some(parameter) => {
                let value = self.frame.value(parameter.table, parameter.key)?;
                let ways = [1.0, -1.0].map(|way| self.number(finding, rule, parameter, value, way));
                let nearest = ways.into_iter().flatten().min_by(|a, b| (a - value).abs().total_cmp(&(b - value).abs()))?;
                self.remedy(key, plain(value), Value::Number(nearest), plain(nearest))
            }
            None => self.by_name(finding, rule, key),
        }
    }

    /// Another choice by name that clears a violation, the one that changes the mass least.
    fn by_name(&self, finding: &Finding, rule: &Rule, key: &str) -> Option<Remedy> {
        let now = match self.file.entries.get(key).map(|entry| &entry.value) {
            Some(Value::Text(name)) => name.clone(),
            _ => return None,
        };
        let clears = |name: &String| {
            let value = Value::Text(name.clone());
            let cleared = self.margin(finding, rule, key, &value)? >= 0.0;
            cleared.then(|| self.remedy(key, now.clone(), value, name.clone())).flatten()
        };
        let names: Vec<String> = preset::names_for(key).into_iter().filter(|name| *name != now).collect();
        let found: Vec<Remedy> = names.par_iter().filter_map(clears).collect();
        let rank = |remedy: &Remedy| (remedy.breaks.is_some(), remedy.heavier_g.abs());
        found.into_iter().min_by(|a, b| rank(a).0.cmp(&rank(b).0).then(rank(a).1.total_cmp(&rank(b).1)))
    }

    /// The nearest value of a number in one direction that clears a violation, rounded away from the value it has.
    fn number(&self, finding: &Finding, rule: &Rule, parameter: &Parameter, value: f64, way: f64) -> Option<f64> {
        let key = format!("{}.{}", parameter.table, parameter.key);
        let at = |to: f64| self.margin(finding, rule, &key, &Value::Number(to));
        let first = (FIRST_STEP[0] * value.abs()).max(FIRST_STEP[1] * (parameter.max - parameter.min));
        let (mut last, mut idle) = (value, 0);
        for doubling in 0..=DOUBLINGS {
            let to = (value + way * first * libm::exp2(f64::from(doubling))).clamp(parameter.min, parameter.max);
            if to == last {
                return None;
            }
            let Some(margin) = at(to) else { return self.least(&at, between(&at, [last, to])?, parameter) };
            if margin >= 0.0 {
                return self.least(&at, [last, to], parameter);
            }
            idle = if margin > finding.margin + 1e-9 { 0 } else { idle + 1 };
            if idle >= PATIENCE {
                return None;
            }
            last = to;
        }
        None
    }

    /// The value nearest to the first, which does not clear a violation, that clears it as the second does.
    fn least(&self, margin: &dyn Fn(f64) -> Option<f64>, [mut bad, mut good]: [f64; 2], parameter: &Parameter) -> Option<f64> {
        let clears = |to: f64| margin(to).is_some_and(|margin| margin >= 0.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (bad + good);
            if clears(middle) {
                good = middle;
            } else {
                bad = middle;
            }
        }
        let grid = if parameter.max - parameter.min > 20.0 { 10.0 } else { 100.0 };
        let away = if good > bad { (good * grid).ceil() } else { (good * grid).floor() } / grid;
        [away, good].into_iter().map(|to| to.clamp(parameter.min, parameter.max)).find(|to| clears(*to))
    }

    /// A change that clears a violation, with what else it does.
    fn remedy(&self, key: &str, from: String, value: Value, to: String) -> Option<Remedy> {
        let design = self.design(key, &value)?;
        let masses = mass::table(&design);
        let known =
            |f: &Finding| self.found.iter().any(|k| k.verdict == Verdict::Violated && (&k.rule, &k.subject) == (&f.rule, &f.subject));
        let found = checks::check_by(&all_but_the_fold(), Cost::Slow, &design, &masses);
        let new = found.iter().find(|f| f.verdict == Verdict::Violated && !known(f));
        let breaks = new.map(|f| format!("{} ({})", f.rule, f.subject));
        Some(Remedy { key: key.into(), from, to, heavier_g: masses.total_g - self.mass_g, breaks })
    }
}

/// Between a value that does not clear a violation and one with which there is no frame: the last value that does not, and the first that
/// was seen to clear it.
fn between(margin: &dyn Fn(f64) -> Option<f64>, [mut bad, mut none]: [f64; 2]) -> Option<[f64; 2]> {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (bad + none);
        match margin(middle) {
            Some(margin) if margin >= 0.0 => return Some([bad, middle]),
            Some(_) => bad = middle,
            None => none = middle,
        }
    }
    None
}

/// The rules that a change is asked by: a search for a fold takes longer than all others together.
fn all_but_the_fold() -> Vec<&'static Rule> {
    CATALOGUE.into_iter().filter(|rule| rule.id != "fold_sequence").collect()
}

/// The parameter of a key; none of a name.
fn parameter(key: &str) -> Option<&'static Parameter> {
    let (table, key) = key.split_once('.')?;
    parameters().find(|p| p.table == table && p.key == key)
}

/// A value as a person types it.
fn plain(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The file with a remedy in it.
    fn mended(file: &FrameFile, remedy: &Remedy) -> FrameFile {
        let value = remedy.to.parse().map_or_else(|_| Value::Text(remedy.to.clone()), Value::Number);
        let mut file = file.clone();
        file.set(&remedy.key, value);
        file
    }

    /// Each remedy for the first violation of a rule, applied, clears it; the keys.
    fn keys(text: &str, rule: &str) -> Vec<String> {
        let file = FrameFile::parse("own.toml", text).expect("reads");
        let memo = Arc::default();
        let bench = Bench::new(&file, &memo).expect("can be designed");
        let violated = |found: &[Finding], of: &Finding| found.iter().any(|f| f.verdict == Verdict::Violated && alike(f, of));
        let broken = bench.found.iter().find(|f| f.rule == rule && f.verdict == Verdict::Violated).expect("is violated");
        let remedies = bench.remedies(broken);
        for remedy in &remedies {
            let mended = mended(&file, remedy);
            let after = Bench::new(&mended, &memo).expect("can be designed");
            assert!(!violated(&after.found, broken), "{remedy}");
            assert!((after.mass_g - bench.mass_g - remedy.heavier_g).abs() < 1e-6, "{remedy}");
        }
        remedies.into_iter().map(|remedy| remedy.key).collect()
    }

    #[test]
    fn planted_rods_of_4_mm_ask_for_a_wider_cheek_gap() {
        let narrow = "base = \"cognifly\"\nbought.rod = \"rod-carbon-4\"\n[fork]\nfork_bar_height_mm = 5.6\nfork_cheek_gap_mm = 6.13\n";
        let found = keys(narrow, "interference");
        assert!(found.contains(&"fork.fork_cheek_gap_mm".to_string()), "{found:?}");
    }

    /// What a person reads of the remedies of the first violation of a rule.
    fn told(text: &str, rule: &str) -> String {
        let file = FrameFile::parse("own.toml", text).expect("reads");
        let memo = Arc::default();
        let bench = Bench::new(&file, &memo).expect("can be designed");
        let found = bench.found.clone();
        advice(&file, &found, &memo).into_iter().zip(found).find(|(_, f)| f.rule == rule && asks(f)).expect("is found").0
    }

    #[test]
    fn planted_a_wish_is_kept_by_another_base_or_by_what_moves_with_it() {
        let propeller = told("base = \"cognifly\"\nbought.propeller = \"propeller-4-inch\"\n", "propeller_clearance");
        assert!(propeller.starts_with("to keep what the file asks for: base = \"cognifly-1106\" keeps every limit"), "{propeller}");
        assert!(!propeller.contains("propeller-3-inch"), "{propeller}");
        let long = told("base = \"cognifly\"\nrods.cage_side_ratio = 1.15\n", "envelope");
        assert!(long.contains("rods.cage_rod_length_mm 192") && long.contains("together keep every limit"), "{long}");
        assert!(!long.contains("cage_side_ratio"), "{long}");
    }

    #[test]
    fn planted_a_warning_of_heat_names_another_material_and_another_printer() {
        let heat = told("base = \"cognifly\"\nprinter = \"ender-3\"\n", "printer_heat");
        assert!(heat.starts_with("materials.rigid abs -> pla clears it (+5.5 g)") && heat.contains("; or printer ender-3 -> "), "{heat}");
        // A printer that states no heat is not known to be hot enough.
        assert!(!heat.contains("generic"), "{heat}");
    }

    /// The skirt of its mount cannot be thicker beside the motor's screws.
    #[test]
    fn planted_a_wall_that_is_too_thin_for_a_wide_nozzle_asks_for_another_printer() {
        let wide = "base = \"cognifly\"\nprinter = \"generic-0.4\"\n[override.printers.\"generic-0.4\"]\nnozzle_mm = 0.6\n";
        assert_eq!(keys(wide, "thinnest_wall"), ["printer"]);
    }

    #[test]
    fn analytic_what_is_not_looked_at_says_so_with_its_levers() {
        let file = FrameFile::load("cognifly").expect("a preset");
        let bench = Bench::new(&file, &Arc::default()).map(|bench| bench.found).expect("can be designed");
        let mut finding = bench.into_iter().find(|f| f.rule == "envelope").expect("is looked at");
        finding.levers = vec!["a.b".into(), "c.d".into()];
        assert!(not_looked_at(&finding).starts_with("driven by a.b, c.d; no remedy was looked for"));
        finding.levers.clear();
        assert!(not_looked_at(&finding).starts_with("no remedy was looked for"));
    }

    /// The diameter is that of the propeller which is bought, unless the file states its own.
    #[test]
    fn planted_a_propeller_that_is_too_large_is_replaced_by_a_smaller_one() {
        let chosen = "base = \"cognifly\"\nbought.propeller = \"propeller-4-inch\"\n";
        assert_eq!(keys(chosen, "propeller_clearance").first().map(String::as_str), Some("bought.propeller"));
        let stated = "base = \"cognifly\"\nmotor_mount.propeller_diameter_mm = 101.6\n";
        let found = keys(stated, "propeller_clearance");
        assert!(
            found.contains(&"motor_mount.propeller_diameter_mm".to_string()) && !found.contains(&"bought.propeller".into()),
            "{found:?}"
        );
    }

    /// Its last step, to 103 mm, leaves no frame; from 92 mm on the propellers are clear.
    #[test]
    fn planted_a_motor_position_short_of_where_there_is_no_frame() {
        let wide = "base = \"cognifly\"\nbought.propeller = \"propeller-4-inch\"\nbought.motor = \"motor-1404\"\n\
                    [target]\nwidth_mm = 300\nheight_mm = 140\nstrut_tilt_deg = 24\n\
                    [limits]\nenvelope_width_mm = 300\nenvelope_height_mm = 140\nmass_budget_g = 350\n";
        let told = told(wide, "propeller_clearance");
        assert!(told.starts_with("motor_mount.motor_position_mm 78 -> 91.") && !told.contains("bought.propeller"), "{told}");
    }

    #[test]
    fn analytic_between_what_does_not_clear_and_what_is_no_frame() {
        let margin = |to: f64| (to < 7.0).then_some(to - 6.0);
        let [bad, good] = between(&margin, [4.0, 8.0]).expect("is found");
        assert!(bad < 6.0 && (6.0..7.0).contains(&good), "{bad} {good}");
        assert_eq!(between(&|to: f64| (to < 5.0).then_some(to - 6.0), [4.0, 8.0]), None);
    }

    #[test]
    fn analytic_nothing_is_said_of_a_frame_that_keeps_its_limits() {
        let file = FrameFile::load("cognifly").expect("a preset");
        let memo = Arc::default();
        let bench = Bench::new(&file, &memo).expect("can be designed");
        assert!(advice(&file, &bench.found, &memo).iter().all(String::is_empty));
    }
}
