//! For the tests of the rules: sound frames, ones with one thing broken, and the line of a rule in `docs/gate.md`.

use std::sync::{Arc, LazyLock};

use super::finding::{Finding, Verdict};
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::Scene;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass;
use crate::frame::assembly::mass::MassTable;
use crate::memo::Memo;
use crate::params::Frame;

/// What was computed for tests before: most of them change little of one frame.
static MEMO: LazyLock<Arc<Memo>> = LazyLock::new(Arc::default);

/// A frame to be tested, to be broken by hand.
pub struct Planted {
    pub design: Design,
    pub masses: MassTable,
}

impl Planted {
    pub fn preset(name: &str) -> Self {
        Self::designed(Frame::load(name).expect("a preset").0)
    }

    /// The default frame with something changed in its parameters.
    pub fn frame(change: impl FnOnce(&mut Frame)) -> Self {
        let (mut frame, _) = Frame::load("cognifly").expect("a preset");
        change(&mut frame);
        Self::designed(frame)
    }

    pub fn designed(frame: Frame) -> Self {
        let design = Design::with(frame, &MEMO).expect("closes");
        Self { masses: mass::table(&design), design }
    }

    pub fn move_body(&mut self, name: &str, by_mm: [f64; 3]) {
        let body = self.design.bodies.iter_mut().find(|body| body.name == name).expect("a body of the frame");
        body.pose.translation.vector += nalgebra::Vector3::from(by_mm);
    }

    pub(super) fn found(&self, rule: fn(&Scene) -> Vec<Finding>) -> Vec<Finding> {
        rule(&Scene::new(&self.design, &self.masses))
    }
}

pub fn violated(found: &[Finding]) -> Vec<Finding> {
    found.iter().filter(|finding| finding.verdict == Verdict::Violated).cloned().collect()
}

/// A rule that only tests know: the rods of the ring are no shorter than a limit.
pub static TOY: Rule = Rule {
    id: "toy",
    title: "Toy",
    requires: "the rods of the ring are long enough for a toy",
    units: &["mm"],
    limits: &[Limit::Key { subject: "ring", key: "limits.part_clearance_mm" }],
    levers: Levers::Sets(&[TOY_LEVERS]),
    blame: Blame::Keys(&[("ring", &["rods.strut_rod_length_mm"])]),
    in_search: InSearch::Constraints { subjects: &["ring"], binds: true },
    found: Found::By(&[Pass::quick(toy)]),
};

/// The same, asked at the end of a search.
pub static SLOW_TOY: Rule = Rule {
    id: "slow_toy",
    in_search: InSearch::AtTheEnd("it is slow"),
    found: Found::By(&[Pass::slow(slow_toy)]),
    blame: Blame::Levers,
    ..TOY
};

fn slow_toy(scene: &Scene) -> Vec<Finding> {
    toy(scene).into_iter().map(|finding| Finding { rule: SLOW_TOY.id.into(), ..finding }).collect()
}

/// The toy's limit, mm.
pub const TOY_MM: f64 = 190.0;
const TOY_LEVERS: &[&str] = &["rods.cage_rod_length_mm"];

fn toy(scene: &Scene) -> Vec<Finding> {
    let value = scene.design.frame.rods.cage_rod_length_mm;
    let measure = Measure { rule: TOY.id, value, limit: TOY_MM, unit: "mm", levers: TOY_LEVERS };
    vec![measure.at_least("ring".into(), format!("the ring's rods are {value} mm long"))]
}

/// A rule's line of the table in `docs/gate.md`: identifier, what it requires, and where its limit comes from.
pub fn table_line(rule: &Rule) -> String {
    let asked = if matches!(rule.found, Found::FromPrediction) { "with `--strength`: " } else { "" };
    format!("| `{}` | {asked}{} | {} |", rule.id, rule.requires, limit_source(rule))
}

fn limit_source(rule: &Rule) -> String {
    let mut keys: Vec<&str> = Vec::new();
    let mut others: Vec<&str> = Vec::new();
    for limit in rule.limits {
        match limit {
            Limit::Key { key, .. } => keys.extend(key.strip_prefix("limits.").filter(|key| !keys.contains(key))),
            Limit::Printer => others.push("printer"),
            Limit::Material => others.push("material"),
            Limit::Mechanics => others.push("`[limits]` of `params/mechanics.toml`"),
        }
    }
    let keys: Vec<String> = keys.iter().map(|key| format!("`{key}`")).collect();
    let stated = (!keys.is_empty()).then(|| format!("`[limits]` {}", keys.join(", ")));
    let sources: Vec<String> = stated.into_iter().chain(others.into_iter().map(String::from)).collect();
    if sources.is_empty() { "fixed".into() } else { sources.join(", ") }
}
