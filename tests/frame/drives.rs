//! Every parameter drives what `flexframe params` says it drives, and in the direction that its meaning asks for.
//!
//! `tests/reference/drives.txt` has a line for each parameter: the step by which the default frame is changed, and what
//! follows. The printed parts that follow are exactly those of the parameter's `drives`.

use crate::common;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::sync::Arc;
use std::sync::OnceLock;

use flexframe::checks;
use flexframe::frame::assembly::{Design, Printed, mass};
use flexframe::frame::parts::catalogue;
use flexframe::frame::skeleton::Centre;
use flexframe::frame::skeleton::Skeleton;
use flexframe::memo::Key;
use flexframe::params::{Frame, LoadError, PartName, parameters};
use flexframe::solid::{Feature, Mesh, MeshSolid, gate};
use rayon::prelude::*;

/// The frame that is changed, and what is added to it where a line says `on:accessories`.
const BASE: &str = "cognifly";
const ACCESSORIES: &str = r#"
[bought]
computer = "none"
camera = "none"
receiver = "receiver-nano"
buzzer = "buzzer-9mm"
gps = "gps-22x20"
fpv_camera = "fpv-camera-14"
"#;

/// Relative change of a volume, and change of a length in mm, that is rounding.
const ROUNDING: f64 = 1e-6;

/// A line of the table.
struct Line {
    key: &'static str,
    step: f64,
    /// The frame that it changes.
    base: Base,
    /// Other keys that have to go along, and by how much.
    with: Vec<(&'static str, f64)>,
    effects: Vec<Effect>,
}

/// What follows: `part.volume+` or `kind:name.measure-`.
#[derive(Clone, Copy, Debug)]
struct Effect {
    subject: &'static str,
    measure: &'static str,
    grows: bool,
}

impl Line {
    fn parse(text: &'static str) -> Self {
        let mut words = text.split_whitespace();
        let mut word = |what: &str| words.next().unwrap_or_else(|| panic!("{what} is missing in {text:?}"));
        let (key, step) = (word("the key"), number(word("the step")));
        let (mut base, mut with, mut effects) = (Base::Default, Vec::new(), Vec::new());
        for word in words {
            if word == "on:accessories" {
                base = Base::Accessories;
                continue;
            }
            match word.strip_prefix("with:") {
                Some(change) => {
                    let at = change.find(['+', '-']).unwrap_or_else(|| panic!("no step in {word:?}"));
                    with.push((&change[..at], number(&change[at..])));
                }
                None => effects.push(Effect::parse(word)),
            }
        }
        Self { key, step, base, with, effects }
    }

    /// The base with this line's change.
    fn frame(&self) -> Frame {
        let all = std::iter::once((self.key, self.step)).chain(self.with.iter().copied());
        let changes: Vec<(String, f64)> = all.map(|(key, step)| (key.to_string(), base_value(key) + step)).collect();
        self.base.with(&changes).unwrap_or_else(|error| panic!("{}: {error}", self.key))
    }
}

impl Effect {
    fn parse(word: &'static str) -> Self {
        let grows = word.ends_with('+');
        let (subject, measure) =
            word.strip_suffix(['+', '-']).and_then(|rest| rest.split_once('.')).unwrap_or_else(|| panic!("{word:?} is no effect"));
        Self { subject, measure, grows }
    }
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text:?} is no number"))
}

fn table() -> Vec<Line> {
    let lines = include_str!("../reference/drives.txt").lines().filter(|line| !line.starts_with('#') && !line.trim().is_empty());
    lines.map(Line::parse).collect()
}

fn base_value(key: &str) -> f64 {
    let (table, name) = key.split_once('.').expect("a key has a table");
    base().frame.value(table, name).unwrap_or_else(|| panic!("there is no parameter {key}"))
}

/// The features of every printed part of a frame, before they are made.
fn features(frame: &Frame, skeleton: &Skeleton, centre: &Centre) -> BTreeMap<PartName, Feature> {
    catalogue()
        .into_iter()
        .filter(|part| (part.needed)(frame))
        .map(|part| (part.name, (part.feature)(frame, &skeleton.closure, centre)))
        .collect()
}

/// A frame before its change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Base {
    /// The preset.
    Default,
    /// The preset with everything that the accessory plate carries, and without computer and camera.
    Accessories,
}

impl Base {
    const ALL: [Self; 2] = [Self::Default, Self::Accessories];

    /// The frame with these changes.
    fn with(self, changes: &[(String, f64)]) -> Result<Frame, LoadError> {
        let text = common::toml(BASE, changes);
        common::resolve(&if self == Self::Accessories { text + ACCESSORIES } else { text })
    }

    /// Designed once for all tests. A test asks for it before it works in parallel: a thread that makes it must not take up work that
    /// waits for it.
    fn design(self) -> &'static Design {
        static DESIGNS: [OnceLock<Design>; 2] = [OnceLock::new(), OnceLock::new()];
        DESIGNS[self as usize].get_or_init(|| design(self.with(&[]).expect("a preset is valid")))
    }
}

/// The preset before its change.
fn base() -> &'static Design {
    Base::Default.design()
}

fn design(frame: Frame) -> Design {
    Design::with(frame, common::memo()).expect("the frame can be made")
}

/// Numbers of a mesh that a parameter can move.
fn measures(mesh: &Mesh) -> BTreeMap<&'static str, f64> {
    let ([low, high], (centre, inertia)) = (mesh.bounds_mm(), mesh.moments());
    let volume = mesh.volume_mm3();
    BTreeMap::from([
        ("volume", volume),
        // As printed: z is up from the bed.
        ("x", high[0] - low[0]),
        ("y", high[1] - low[1]),
        ("z", high[2] - low[2]),
        ("centre_x", centre.x),
        ("centre_y", centre.y),
        ("centre_z", centre.z),
        // Mean distance of the material from its centre: falls when a hole of the same size moves outwards.
        ("spread", libm::sqrt(0.5 * inertia.trace() / volume)),
    ])
}

fn moved(before: f64, after: f64) -> bool {
    (after - before).abs() > ROUNDING * before.abs().max(1.0)
}

/// Whether two meshes differ by more than rounding.
fn differ(before: &Mesh, after: &Mesh) -> bool {
    if before == after {
        return false;
    }
    let (before, after) = (measures(before), measures(after));
    before.iter().any(|(name, value)| moved(*value, after[name]))
}

/// What a line's change does to the printed parts: the parts that differ, made anew.
fn changed_parts(base: Base, frame: &Frame) -> BTreeMap<PartName, Arc<Mesh>> {
    let skeleton = Skeleton::new(frame).expect("the frame closes");
    let centre = Centre::new(frame);
    let before: BTreeMap<PartName, &Printed> = base.design().printed.iter().map(|part| (part.name, part)).collect();
    let mut changed = BTreeMap::new();
    for (name, feature) in features(frame, &skeleton, &centre) {
        if feature != before[&name].feature {
            let after = Printed::make(name, frame, &skeleton, &centre, common::memo()).unwrap_or_else(|error| panic!("{name}: {error}"));
            if differ(&before[&name].mesh, &after.mesh) {
                changed.insert(name, after.mesh);
            }
        }
    }
    changed
}

/// What a line says of the printed parts, against what happens: the differences in words.
fn wrong_parts(line: &Line) -> Vec<String> {
    let changed = changed_parts(line.base, &line.frame());
    let mut wrong = Vec::new();
    let stated: BTreeSet<&str> = line.effects.iter().map(|effect| effect.subject).filter(|subject| !subject.contains(':')).collect();
    for (name, mesh) in &changed {
        let before = measures(&line.base.design().part(*name).expect("every part is made").mesh);
        let after = measures(mesh);
        for effect in line.effects.iter().filter(|effect| effect.subject == name.slug()) {
            let [old, new] = [&before, &after].map(|m| *m.get(effect.measure).unwrap_or_else(|| panic!("{effect:?} measures nothing")));
            if !moved(old, new) || (new > old) != effect.grows {
                wrong.push(format!("{}: {effect:?}: {old} became {new}", line.key));
            }
        }
        if !stated.contains(name.slug()) {
            let seen = before.iter().filter(|(m, v)| moved(**v, after[*m])).map(|(m, v)| format!("{m}{:+.5}", after[m] - v));
            wrong.push(format!("{} {:+}: {name} is not in the table: {}", line.key, line.step, seen.collect::<Vec<_>>().join(" ")));
        }
    }
    let unmoved = stated.iter().filter(|subject| changed.keys().all(|name| name.slug() != **subject));
    wrong.extend(unmoved.map(|subject| format!("{} {:+}: {subject} does not change", line.key, line.step)));
    wrong
}

/// What a line says beside the printed parts, against what happens.
fn wrong_elsewhere(line: &Line) -> Vec<String> {
    let elsewhere: Vec<&Effect> = line.effects.iter().filter(|effect| effect.subject.contains(':')).collect();
    if elsewhere.is_empty() {
        return Vec::new();
    }
    let frame = line.frame();
    // Only a body and a mass need the whole design.
    let needs_design = elsewhere.iter().any(|effect| effect.subject.starts_with("body:") || effect.subject.starts_with("mass:"));
    let changed = needs_design.then(|| design(frame.clone()));
    let skeleton = Skeleton::new(&frame).expect("the frame closes");
    elsewhere
        .iter()
        .filter(|effect| !effect.subject.starts_with("limit:"))
        .filter_map(|effect| {
            let old = line.base.design();
            let read = |design, skeleton| reading(effect, design, skeleton).unwrap_or_else(|| panic!("{effect:?} measures nothing"));
            let (old, new) = (read(old, &old.skeleton), read(changed.as_ref().unwrap_or(old), &skeleton));
            let right = moved(old, new) && (new > old) == effect.grows;
            (!right).then(|| format!("{}: {effect:?}: {old} became {new}", line.key))
        })
        .collect()
}

/// A number of a design or a skeleton that an effect names.
fn reading(effect: &Effect, design: &Design, skeleton: &Skeleton) -> Option<f64> {
    let (kind, name) = effect.subject.split_once(':')?;
    match (kind, effect.measure) {
        ("rod", "length") => skeleton.rods.iter().find(|rod| rod.role.slug() == name).map(|rod| rod.length_mm()),
        ("node", "out") => skeleton.node(&format!("{name}_FR")).map(|at| libm::hypot(at.x, at.y)),
        ("node", "up") => skeleton.node(&format!("{name}_FR")).map(|at| at.z),
        ("body", measure) => {
            let [low, high] = design.placed(design.bodies.iter().find(|body| body.name == name)?).bounds_mm();
            Some(match measure {
                "up" => 0.5 * (low[2] + high[2]),
                "y" => high[1] - low[1],
                _ => high[0] - low[0],
            })
        }
        ("mass", "total") => mass::table(design).lines.iter().find(|line| line.name == name).map(|line| line.total_g),
        _ => None,
    }
}

/// What the findings of each rule are held against.
fn limits(design: &Design) -> BTreeMap<String, f64> {
    let mut limits = BTreeMap::new();
    for finding in checks::check(design, &mass::table(design)) {
        *limits.entry(finding.rule.into_owned()).or_insert(0.0) += finding.limit;
    }
    limits
}

#[test]
fn analytic_every_parameter_has_a_line_and_no_line_is_left_over() {
    let mut lines: Vec<&str> = table().iter().map(|line| line.key).collect();
    lines.dedup();
    let keys: Vec<String> = parameters().map(|p| format!("{}.{}", p.table, p.key)).collect();
    let missing: Vec<&String> = keys.iter().filter(|key| !lines.contains(&key.as_str())).collect();
    assert!(missing.is_empty(), "tests/reference/drives.txt has no line for {missing:?}");
    assert_eq!(lines, keys, "the lines stand in the order of `flexframe params`");
    let mute: Vec<&str> = table().iter().filter(|line| line.effects.is_empty()).map(|line| line.key).collect();
    assert!(mute.is_empty(), "nothing follows from {mute:?}");
}

#[test]
fn analytic_parameters_list_the_parts_that_the_table_shows() {
    let lines = table();
    for p in parameters() {
        let key = format!("{}.{}", p.table, p.key);
        let shown: BTreeSet<&str> =
            lines.iter().filter(|line| line.key == key).flat_map(|line| &line.effects).map(|effect| effect.subject).collect();
        let shown: BTreeSet<&str> = shown.into_iter().filter(|subject| !subject.contains(':')).collect();
        let listed: BTreeSet<&str> = p.drives.iter().map(|part| part.slug()).collect();
        assert_eq!(listed, shown, "{key}: what `flexframe params` lists, and what tests/reference/drives.txt shows");
    }
}

#[test]
fn analytic_these_features_are_those_that_are_printed() {
    for design in Base::ALL.map(Base::design) {
        for (name, feature) in features(&design.frame, &design.skeleton, &design.centre) {
            assert!(design.part(name).is_some_and(|part| part.feature == feature), "{name}");
        }
    }
}

#[test]
fn analytic_each_parameter_changes_its_parts_and_no_other_and_the_right_way() {
    Base::ALL.iter().for_each(|base| _ = base.design());
    let wrong: Vec<String> = table().par_iter().flat_map_iter(|line| wrong_parts(line).into_iter().chain(wrong_elsewhere(line))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn analytic_each_limit_moves_what_its_rule_is_held_against_and_no_other() {
    let lines: Vec<Line> = table().into_iter().filter(|line| line.key.starts_with("limits.")).collect();
    let mut design = design(base().frame.clone());
    let before = limits(&design);
    for line in &lines {
        design.frame.limits = line.frame().limits;
        let after = limits(&design);
        let moved: Vec<(&str, bool)> = before
            .iter()
            .filter(|(rule, limit)| moved(**limit, after[rule.as_str()]))
            .map(|(rule, limit)| (rule.as_str(), after[rule.as_str()] > *limit))
            .collect();
        let stated: Vec<(&str, bool)> =
            line.effects.iter().map(|effect| (effect.subject.trim_start_matches("limit:"), effect.grows)).collect();
        assert_eq!(moved, stated, "{}", line.key);
    }
}

/// The parts that this one number changes, before they are made; none where it is refused.
fn changed_features(base: Base, key: &str, value: f64) -> Vec<(PartName, Feature)> {
    let Ok(frame) = base.with(&[(key.to_string(), value)]) else { return Vec::new() };
    let Ok(skeleton) = Skeleton::new(&frame) else { return Vec::new() };
    let all = features(&frame, &skeleton, &Centre::new(&frame));
    all.into_iter().filter(|(name, feature)| base.design().part(*name).is_none_or(|part| part.feature != *feature)).collect()
}

#[test]
fn analytic_each_parameter_may_go_to_its_bounds_or_is_refused() {
    Base::ALL.iter().for_each(|base| _ = base.design());
    let mut changed = Vec::new();
    for base in Base::ALL {
        for (p, value) in parameters().flat_map(|p| [p.min, p.max].map(|value| (p, value))) {
            let key = format!("{}.{}", p.table, p.key);
            changed.extend(changed_features(base, &key, value).into_iter().map(|made| (format!("{key} = {value}"), made)));
        }
    }
    // Most parts are the same on both bases.
    let mut known = HashSet::new();
    changed.retain(|(_, (_, feature))| known.insert(Key::of("part", feature)));
    assert!(changed.len() > 300, "{} parts", changed.len());
    let unprintable = |(change, (name, feature)): &(String, (PartName, Feature))| {
        let error = gate::pass(&MeshSolid::build_from(feature, common::memo()).to_mesh()).err()?;
        Some(format!("{change}: {name}: {error}"))
    };
    let bad: Vec<String> = changed.par_iter().filter_map(unprintable).collect();
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}
