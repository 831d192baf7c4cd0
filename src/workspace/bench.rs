//! The frame on which remedies are tried before they are named.
//!
//! The levers of a violated rule are moved, each alone and step by step up to its bounds, until the rule holds; then the step is made as
//! small as it can be, and every rule but the fold's is asked about the frame with it. Where no lever helps, and none of them chooses a bought
//! part, the rods and what else drives the parts that the violation names are tried, and another choice of what sets the limit, such as the
//! printer. This takes seconds: it is for a person who reads a report, not for a search. What can be asked of a sketch of the changed frame is asked
//! of it first, and of the frame itself where the sketch says that the rule holds.

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::movable::{Movable, stated_instead};
use super::remedy::{Remedy, alike, asks, joined, named};
use super::wishes::Wishes;
use crate::checks::{self, CATALOGUE, Cost, FOLD_SEQUENCE, Finding, Rule, Verdict};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass;
use crate::frame::skeleton::Skeleton;
use crate::memo::Memo;
use crate::params::frame_file::Value;
use crate::params::parameter::Parameter;
use crate::params::{Frame, FrameFile, follows, parameters, preset};

/// Rods are tried for every violation.
const RODS: [&str; 3] = ["rods.cage_rod_length_mm", "rods.arm_rod_length_mm", "rods.strut_rod_length_mm"];
/// Share of the value by which other keys are moved to see whether they have an effect.
const PROBE: f64 = 0.2;
/// Shares of that step, of which the largest that leaves a frame counts.
const PROBES: [f64; 2] = [1.0, 0.4];
/// By how much of its limit a violated finding may get worse by a remedy of another one.
const WORSE: f64 = 1e-3;
/// Keys, beyond the levers, that are tried in earnest: those with the most effect.
const OTHERS: usize = 3;

/// The frame on which changes are tried.
pub(super) struct Bench<'a> {
    file: &'a FrameFile,
    frame: Frame,
    skeleton: Skeleton,
    memo: &'a Arc<Memo>,
    /// Its mass, g.
    pub(super) mass_g: f64,
    /// All that is found of it.
    pub(super) found: Vec<Finding>,
    /// What of it a sketch says, too.
    sketched: Vec<Finding>,
    wishes: Wishes<'a>,
    /// What keeps the wishes, looked for once.
    kept_by: OnceLock<Option<String>>,
}

impl<'a> Bench<'a> {
    /// None for a frame that cannot be designed.
    pub(super) fn new(file: &'a FrameFile, memo: &'a Arc<Memo>) -> Option<Self> {
        let frame = Frame::resolve(file).ok()?;
        let design = Design::with(frame.clone(), memo).ok()?;
        let masses = mass::table(&design);
        let [found, sketched] = [Cost::Slow, Cost::Sketch].map(|dearest| checks::check_by(&all_but_the_fold(), dearest, &design, &masses));
        let (wishes, kept_by) = (Wishes::of(file), OnceLock::new());
        Some(Self { file, frame, skeleton: design.skeleton, memo, mass_g: masses.total_g, found, sketched, wishes, kept_by })
    }

    /// Whether it is found again: only then its end can be seen.
    pub(super) fn sees(&self, finding: &Finding) -> bool {
        self.found.iter().any(|f| f.rule == finding.rule && f.subject == finding.subject && asks(f))
    }

    /// What a person reads of the remedies of a finding.
    pub(super) fn sentence(&self, finding: &Finding) -> String {
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
            (_, [], _) => joined(&other),
            (_, _, [_, ..]) => format!("{}; or, against what the file asks for: {}", joined(&other), joined(&back)),
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

    /// The frame with a key changed, or a sketch of it; none where that is refused.
    fn design(&self, dearest: Cost, key: &str, value: &Value) -> Option<Design> {
        let mut file = self.file.clone();
        file.set(key, value.clone());
        let frame = Frame::resolve(&file).ok()?;
        match dearest {
            Cost::Sketch => Design::sketched(frame, &self.skeleton, self.memo),
            Cost::Quick | Cost::Slow => Design::with(frame, self.memo),
        }
        .ok()
    }

    /// What has to be looked at before a change is known not to clear a finding: a sketch, where it says that finding, too.
    fn first_look(&self, finding: &Finding) -> Cost {
        if self.sketched.contains(finding) { Cost::Sketch } else { Cost::Slow }
    }

    /// The least margin of the findings that are like this one, with a key changed; none where there is no such frame. A choice after which the
    /// rule says nothing of its kind is not known to clear it.
    fn margin(&self, finding: &Finding, rule: &Rule, dearest: Cost, key: &str, value: &Value) -> Option<f64> {
        let design = self.design(dearest, key, value)?;
        let found = checks::check_one(rule, dearest, &design, &mass::table(&design));
        if matches!(value, Value::Text(_)) && !found.iter().any(|f| is_of_kind(f, finding)) {
            return None;
        }
        Some(least_margin(&found, finding))
    }

    /// The least margin of the findings that are like this one, as they are now: what a change is measured by.
    fn margin_now(&self, finding: &Finding, dearest: Cost) -> f64 {
        let found = if dearest == Cost::Sketch { &self.sketched } else { &self.found };
        least_margin(found, finding).min(finding.margin)
    }

    /// The remedies of a violation, in the order of the levers that its rule names; those that break something else only where there are no others.
    pub(super) fn remedies(&self, finding: &Finding) -> Vec<Remedy> {
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
        let (back, kept) = found.into_iter().partition(|remedy| self.takes_back(remedy));
        named(kept, back)
    }

    /// What a person chooses: instead of a number that follows from a bought part the choice of that part, unless the file states the number.
    fn chosen(&self, levers: &[&str]) -> Vec<String> {
        let mut keys = Vec::new();
        for lever in levers {
            let role = lever
                .rsplit('.')
                .next()
                .and_then(|key| follows::role_in(&self.frame.bought, key))
                .filter(|_| !self.file.entries.contains_key(*lever));
            let key = role.map_or_else(|| (*lever).to_string(), |role| format!("bought.{role}"));
            for key in stated_instead(&self.frame, &key) {
                if !keys.contains(&key) {
                    keys.push(key);
                }
            }
        }
        keys
    }

    /// Other keys with an effect, the most effective first: rods, and what drives the parts that the subject names.
    fn effective(&self, finding: &Finding, rule: &Rule, levers: &[&str]) -> Vec<String> {
        let drives = |p: &&Parameter| p.drives.iter().any(|part| finding.names(*part));
        let driving = parameters().filter(drives).filter(|p| p.table != "fit").map(|p| format!("{}.{}", p.table, p.key));
        let instead = driving.chain(RODS.map(String::from)).flat_map(|key| stated_instead(&self.frame, &key));
        let keys: BTreeSet<String> = instead.filter(|key| !levers.contains(&key.as_str())).collect();
        let keys: Vec<String> = keys.into_iter().collect();
        let gain = |key: &String| {
            let Movable { value, min, max, .. } = Movable::of(&self.frame, key)?;
            let step = PROBE * value.abs().max(0.1 * (max - min));
            let look = self.first_look(finding);
            let margin = |to: f64| self.margin(finding, rule, look, key, &Value::Number(to.clamp(min, max)));
            // A whole step may leave no frame where a part of it helps.
            let probed = |way: f64| PROBES.into_iter().find_map(|share| margin(value + way * share * step));
            [1.0, -1.0].into_iter().filter_map(probed).reduce(f64::max).map(|margin| (margin, key.clone()))
        };
        let margin_now = self.margin_now(finding, self.first_look(finding));
        let mut gains: Vec<(f64, String)> = keys.par_iter().filter_map(gain).filter(|(margin, _)| *margin > margin_now + 1e-6).collect();
        gains.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
        gains.into_iter().take(OTHERS).map(|(_, key)| key).collect()
    }

    /// The smallest change of one key that clears a violation.
    fn by_key(&self, finding: &Finding, rule: &Rule, key: &str) -> Option<Remedy> {
        match Movable::of(&self.frame, key) {
            Some(movable) => {
                let value = movable.value;
                let ways = [1.0, -1.0].map(|way| self.number(finding, rule, &movable, way));
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
            let holds = |dearest| self.margin(finding, rule, dearest, key, &value).is_some_and(|margin| margin >= 0.0);
            let cleared = holds(self.first_look(finding)) && holds(Cost::Slow);
            cleared.then(|| self.remedy(key, now.clone(), value, name.clone())).flatten()
        };
        let names: Vec<String> = preset::names_for(key).into_iter().filter(|name| *name != now).collect();
        let found: Vec<Remedy> = names.par_iter().filter_map(clears).collect();
        let rank = |remedy: &Remedy| (remedy.breaks.is_some(), remedy.heavier_g.abs());
        found.into_iter().min_by(|a, b| rank(a).0.cmp(&rank(b).0).then(rank(a).1.total_cmp(&rank(b).1)))
    }

    /// The nearest value of a number in one direction that clears a violation, rounded away from the value it has. What no sketch clears is not
    /// looked at any closer.
    fn number(&self, finding: &Finding, rule: &Rule, movable: &Movable, way: f64) -> Option<f64> {
        let margin = |dearest: Cost, to: f64| self.margin(finding, rule, dearest, &movable.key, &Value::Number(to));
        let first = self.first_look(finding);
        let nearest = |dearest| movable.nearest(&|to| margin(dearest, to), self.margin_now(finding, dearest), way);
        let to = nearest(first)?;
        let holds = first == Cost::Slow || margin(Cost::Slow, to).is_some_and(|margin| margin >= 0.0);
        if holds { Some(to) } else { nearest(Cost::Slow) }
    }

    /// A change that clears a violation, with what else it does.
    fn remedy(&self, key: &str, from: String, value: Value, to: String) -> Option<Remedy> {
        let design = self.design(Cost::Slow, key, &value)?;
        let masses = mass::table(&design);
        // What was violated before is no news, unless it is further from its limit now.
        let before =
            |f: &Finding| self.found.iter().find(|k| k.verdict == Verdict::Violated && (&k.rule, &k.subject) == (&f.rule, &f.subject));
        let known = |f: &Finding| before(f).is_some_and(|k| f.margin >= k.margin - WORSE * k.limit.abs());
        let found = checks::check_by(&all_but_the_fold(), Cost::Slow, &design, &masses);
        let new: Vec<&Finding> = found.iter().filter(|f| f.verdict == Verdict::Violated && !known(f)).collect();
        let breaks = new.first().map(|f| {
            let more = if new.len() > 1 { format!(" and {} more", new.len() - 1) } else { String::new() };
            let does = if before(f).is_some() { "worsens" } else { "breaks" };
            format!("{does} {} ({}){more}", f.rule, f.subject)
        });
        Some(Remedy { key: key.into(), from, to, heavier_g: masses.total_g - self.mass_g, breaks })
    }
}

/// Whether one finding counts as another does where a remedy is looked for.
fn is_of_kind(found: &Finding, finding: &Finding) -> bool {
    alike(found, finding) || finding.verdict == Verdict::Note && found.rule == finding.rule && found.levers == finding.levers
}

/// The least margin of the findings of a rule that a change has to clear together with one of them.
fn least_margin(found: &[Finding], finding: &Finding) -> f64 {
    let counts = |f: &&Finding| f.verdict != Verdict::Note || finding.verdict == Verdict::Note;
    let same = |f: &&Finding| is_of_kind(f, finding) || f.rule == finding.rule && f.subject == finding.subject;
    found.iter().filter(counts).filter(same).map(|f| f.margin).fold(f64::INFINITY, f64::min)
}

/// The rules that a change is asked by: a search for a fold takes longer than all others together.
fn all_but_the_fold() -> Vec<&'static Rule> {
    CATALOGUE.into_iter().filter(|rule| rule.id != FOLD_SEQUENCE.id).collect()
}

/// A value as a person types it.
fn plain(value: f64) -> String {
    format!("{}", (value * 1e4).round() / 1e4)
}
