//! Where a frame file drives a finding.
//!
//! What the rule's record blames comes first, then the levers, then what drives the part that the subject names, then the limit.
//! A value that the file itself states comes before one of its bases', but for a sum of masses, whose largest come first. A
//! preset that comes with the program is no file that anybody could change, so nothing points there.

use std::sync::Arc;

use crate::checks::{Blame, Finding, Rule};
use crate::frame::assembly::mass::{LineKind, MassLine, MassTable};
use crate::params::refusal::Place;
use crate::params::{FrameFile, follows, parameters};

/// How many places are named at most.
const MOST: usize = 3;
/// How many of the heaviest lines are to blame for a mass; the messages name as many.
const HEAVIEST: usize = 3;

/// A place in a file that a person can change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spot {
    /// The file, as it was asked for.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The key that stands there; empty for none.
    pub key: String,
}

impl Spot {
    /// Where a key was typed.
    pub fn at(key: &str, place: &Place) -> Self {
        let [line, column] = place.line_column();
        Self { file: plain(&place.source.name), line, column, key: key.into() }
    }
}

/// A path without `.` and `..` where that can be had without looking at the disk: readers of reports know files by such paths.
fn plain(name: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    let (root, rest) = name.strip_prefix('/').map_or(("", name), |rest| ("/", rest));
    for part in rest.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    format!("{root}{}", parts.join("/"))
}

/// Where a frame file drives a finding, the first most. None when there is no file to change.
pub fn spots(finding: &Finding, rule: Option<&Rule>, file: &FrameFile, masses: &MassTable) -> Vec<Spot> {
    let own = |place: &Place| file.files.iter().any(|source| Arc::ptr_eq(source, &place.source));
    let mut stated: Vec<(usize, Spot)> = Vec::new();
    for key in drivers(finding, rule, masses) {
        let Some(entry) = file.entries.get(&key).filter(|entry| own(&entry.place)) else { continue };
        let spot = Spot::at(&key, &entry.place);
        if stated.iter().all(|(_, known)| *known != spot) {
            stated.push((entry.depth, spot));
        }
    }
    if rule.is_some_and(is_sum_of_masses) {
        // The heaviest comes first wherever it stands, unless the limit is what the nearer file changed.
        let limit = rule.and_then(|rule| rule.limit_key(&finding.subject)).unwrap_or_default();
        let nearest = stated.iter().filter(|(_, spot)| spot.key != limit).map(|(depth, _)| *depth).min();
        stated.sort_by_key(|(depth, spot)| spot.key != limit || nearest.is_some_and(|nearest| *depth >= nearest));
    } else {
        stated.sort_by_key(|(depth, _)| *depth);
    }
    let mut spots: Vec<Spot> = stated.into_iter().map(|(_, spot)| spot).take(MOST).collect();
    if spots.is_empty() {
        spots.extend(file.base.as_ref().filter(|place| own(place)).map(|place| Spot::at("base", place)));
    }
    if spots.is_empty() {
        spots.extend(file.files.first().map(|source| Spot { file: plain(&source.name), line: 1, column: 1, key: String::new() }));
    }
    spots
}

/// Keys that drive a finding, the first most.
fn drivers(finding: &Finding, rule: Option<&Rule>, masses: &MassTable) -> Vec<String> {
    let mut keys: Vec<String> = match rule.map(|rule| rule.blame) {
        Some(Blame::Masses { .. }) => mass_keys(masses),
        Some(Blame::Keys(by_subject)) => {
            let fits = by_subject.iter().find(|(subject, _)| finding.subject.starts_with(subject));
            fits.into_iter().flat_map(|(_, keys)| keys.iter()).map(|key| key.to_string()).collect()
        }
        Some(Blame::Levers) | None => Vec::new(),
    };
    for lever in finding.levers.iter() {
        keys.extend(std::iter::once(lever.clone().into_owned()).chain(followed(lever, masses)));
    }
    let named = |p: &&crate::params::parameter::Parameter| p.drives.iter().any(|part| finding.names(*part));
    keys.extend(parameters().filter(named).map(|p| format!("{}.{}", p.table, p.key)));
    keys.extend(rule.and_then(|rule| rule.limit_key(&finding.subject)).map(String::from));
    keys
}

/// Whether the value of a rule's findings is a sum of masses.
fn is_sum_of_masses(rule: &Rule) -> bool {
    rule.blame == Blame::Masses { summed: true }
}

/// The largest masses, as a clause that goes after a message; empty for a rule whose value is no sum of masses.
pub(super) fn masses_named(rule: &Rule, masses: &MassTable) -> String {
    if !is_sum_of_masses(rule) {
        return String::new();
    }
    let mut lines: Vec<_> = masses.lines.iter().collect();
    lines.sort_by(|a, b| b.total_g.total_cmp(&a.total_g).then_with(|| a.name.cmp(&b.name)));
    let named: Vec<String> = lines.iter().take(HEAVIEST).map(|line| format!("{} {:.1} g", line.name, line.total_g)).collect();
    format!("; the largest are {}", named.join(", "))
}

/// Where a lever that no file states comes from: the bought part that it follows, its own figures first.
fn followed(lever: &str, masses: &MassTable) -> Vec<String> {
    let bought = |role: &str| masses.bought(role);
    let Some(role) = follows::role_among(lever.rsplit('.').next().unwrap_or(lever), |role| bought(role).is_some()) else {
        return Vec::new();
    };
    let part = bought(role).map(|line| &line.material);
    let figures = part.map(|part| ["size_mm", "mass_g"].map(|figure| format!("override.parts.{part}.{figure}")));
    figures.into_iter().flatten().chain([format!("bought.{role}")]).collect()
}

/// Keys of the heaviest lines first.
fn mass_keys(masses: &MassTable) -> Vec<String> {
    let mut lines: Vec<&MassLine> = masses.lines.iter().filter(|line| line.total_g > 0.0).collect();
    lines.sort_by(|a, b| b.total_g.total_cmp(&a.total_g).then_with(|| a.name.cmp(&b.name)));
    lines.truncate(HEAVIEST);
    lines.into_iter().flat_map(line_keys).collect()
}

fn line_keys(line: &MassLine) -> Vec<String> {
    let MassLine { name, material, .. } = line;
    match line.kind {
        LineKind::Bought if name == "battery" => {
            vec![format!("override.parts.{material}.mass_g"), "battery.battery_mass_g".into(), "bought.battery".into()]
        }
        LineKind::Bought => vec![format!("override.parts.{material}.mass_g"), format!("bought.{name}")],
        LineKind::Extra => vec![format!("extras.{name}.mass_g")],
        LineKind::Rod => rod_keys(name).into_iter().chain(["bought.rod".into()]).collect(),
        LineKind::Printed => {
            vec![format!("override.materials.{material}.print_factor"), format!("override.materials.{material}.density_g_cm3")]
        }
    }
}

/// What states the length of the rods of a line. That of legs follows from the ring, and the sides of a ring are stated as a ratio.
fn rod_keys(line: &str) -> Vec<String> {
    match line {
        "leg_rod" => vec!["rods.cage_rod_length_mm".into()],
        "cage_side_rod" => vec!["rods.cage_side_ratio".into(), "rods.cage_rod_length_mm".into()],
        _ => vec![format!("rods.{line}_length_mm")],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::Planted;
    use crate::params::roles::ROLES;

    #[test]
    fn analytic_each_mass_is_blamed_on_keys_that_a_file_can_state() {
        let names = |key: &str| match key.split_once('.') {
            Some(("bought", role)) => ROLES.iter().any(|(known, ..)| *known == role),
            Some(("extras" | "override", rest)) => rest.contains('.'),
            _ => parameters().any(|p| key == format!("{}.{}", p.table, p.key)),
        };
        let long = Planted::frame(|frame| frame.rods.cage_side_ratio = 1.15);
        for masses in [Planted::preset("cognifly").masses, long.masses] {
            for line in &masses.lines {
                let keys = line_keys(line);
                let unknown: Vec<&String> = keys.iter().filter(|key| !names(key)).collect();
                assert!(!keys.is_empty() && unknown.is_empty(), "{}: {unknown:?}", line.name);
            }
        }
        let masses = Planted::preset("cognifly").masses;
        let heaviest = masses.lines.iter().max_by(|a, b| a.total_g.total_cmp(&b.total_g)).expect("has lines");
        assert_eq!(mass_keys(&masses)[..line_keys(heaviest).len()], line_keys(heaviest));
    }
}
