//! Whole frames against every rule.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::planted::{Planted, table_line, violated};
use super::rule::Found;
use super::*;
use crate::frame::assembly::{Design, mass};
use crate::params::target;
use crate::params::{Frame, PartName, parameters, preset};

fn broken(preset: &str) -> Vec<String> {
    let frame = Planted::preset(preset);
    violated(&check(&frame.design, &frame.masses)).iter().map(|f| format!("{}: {}", f.rule, f.subject)).collect()
}

#[test]
fn measured_the_real_frame_breaks_what_it_is_known_to_break() {
    // Where its CAD has the motors, the front propellers leave less room between them than the camera is wide.
    let known = [
        "envelope: width without propellers",
        "envelope: depth without propellers",
        "propeller_clearance: propeller_FR to camera_connector_left",
        "propeller_clearance: propeller_FL to camera_connector_right",
        "propeller_clearance: propeller_FR to camera",
        "propeller_clearance: propeller_FL to camera",
        "hardware_fit: holes for the computer: thread",
        "thinnest_wall: motor_mount",
        "thinnest_wall: battery_bracket",
    ];
    assert_eq!(broken("cognifly-v8"), known);
}

#[test]
fn regress_the_other_presets_hold() {
    for preset in preset::names().filter(|preset| *preset != "cognifly-v8") {
        assert_eq!(broken(preset), Vec::<String>::new(), "{preset}");
    }
}

#[test]
fn regress_findings_do_not_depend_on_threads() {
    // Each with nothing known: what is kept would be read by the second.
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let (frame, _) = Frame::load("cognifly").expect("a preset");
            let design = Design::with(frame, &Arc::default()).expect("closes");
            check(&design, &mass::table(&design))
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn analytic_margin_and_verdict_agree() {
    let frame = Planted::preset("cognifly-v8");
    for f in check(&frame.design, &frame.masses) {
        assert!(f.value.is_finite() && f.limit.is_finite(), "{f:?}");
        assert!(f.verdict == Verdict::Note || (f.verdict == Verdict::Holds) == (f.margin >= 0.0), "{f:?}");
    }
}

/// Keys of a frame file that choose something whole.
const CHOICES: [&str; 23] = [
    "printer",
    "materials.flexible",
    "materials.rigid",
    "sleeve.sleeve_direction",
    "bought.battery",
    "bought.buzzer",
    "bought.camera",
    "bought.computer",
    "bought.connector",
    "bought.damper",
    "bought.flight_controller",
    "bought.flow_sensor",
    "bought.magnet",
    "bought.motor",
    "bought.motor_controller",
    "bought.motor_screw",
    "bought.propeller",
    "bought.receiver",
    "bought.rod",
    "bought.stack_nut",
    "bought.stack_screw",
    "bought.stack_spacer",
    "bought.tie",
];

fn is_key(key: &str) -> bool {
    CHOICES.contains(&key) || target::key(key).is_some() || parameters().any(|p| key == format!("{}.{}", p.table, p.key))
}

/// The sets of levers that a rule's findings can have.
fn lever_sets(rule: &Rule) -> Vec<&'static [&'static str]> {
    match rule.levers {
        Levers::Sets(sets) => sets.to_vec(),
        Levers::OfPart(levers) => PartName::ALL.into_iter().flat_map(levers).collect(),
    }
}

#[test]
fn analytic_every_rule_says_all_of_itself() {
    let ids: BTreeSet<&str> = CATALOGUE.iter().map(|rule| rule.id).collect();
    assert_eq!(ids.len(), CATALOGUE.len(), "an identifier stands twice");
    for rule in CATALOGUE {
        let id = rule.id;
        assert!(!rule.title.is_empty() && rule.sentence().ends_with('.') && !rule.units.is_empty(), "{id}");
        let sets = lever_sets(rule);
        assert!(sets.iter().all(|set| (1..=3).contains(&set.len())), "{id}: {sets:?}");
        let limits = rule.limits.iter().filter_map(|limit| if let Limit::Key { key, .. } = limit { Some(*key) } else { None });
        let blamed = if let Blame::Keys(keys) = rule.blame { keys.iter().flat_map(|(_, keys)| keys.iter()).collect() } else { Vec::new() };
        for key in sets.iter().copied().flatten().chain(blamed).copied().chain(limits) {
            assert!(is_key(key), "{id}: {key} is no key of a frame file");
        }
        match (&rule.found, rule.in_search) {
            (Found::By(passes), InSearch::Constraints { .. } | InSearch::Sorted { .. }) => {
                assert!(!rule.constraints().is_empty() && passes.iter().any(|pass| pass.cost == Cost::Quick), "{id}: nothing for a search");
            }
            (_, InSearch::Constraints { .. } | InSearch::Sorted { .. }) => {
                assert!(!rule.constraints().is_empty(), "{id}: nothing for a search");
            }
            (Found::By(passes), _) => assert!(passes.iter().all(|pass| pass.cost == Cost::Slow), "{id}: quick, but no constraint"),
            (_, InSearch::AtTheEnd(why) | InSearch::AsGoal(why)) => assert!(!why.is_empty(), "{id}: no constraint, and no reason"),
        }
    }
}

#[test]
fn analytic_the_page_of_the_gate_has_every_rule() {
    let page = include_str!("../../docs/gate.md");
    for rule in CATALOGUE {
        let line = table_line(rule);
        assert!(page.lines().any(|known| known == line), "docs/gate.md lacks this line of its table of rules:\n{line}");
    }
}

/// Rules of which presets have no finding: one is asked for, and no preset names a printer whose heat is known.
const UNMET: [&str; 2] = ["design_drop", "printer_heat"];

#[test]
fn regress_every_finding_of_every_preset_is_by_the_record_of_its_rule() {
    let mut met: BTreeSet<&str> = BTreeSet::new();
    for name in preset::names() {
        let frame = Planted::preset(name);
        for finding in check(&frame.design, &frame.masses) {
            let rule = CATALOGUE.iter().find(|rule| rule.id == finding.rule).expect("a rule of the catalogue");
            assert!(rule.units.contains(&&*finding.unit), "{finding:?}");
            let levers: Vec<&str> = finding.levers.iter().map(|lever| &**lever).collect();
            assert!(levers.is_empty() || lever_sets(rule).contains(&levers.as_slice()), "{finding:?}");
            met.insert(rule.id);
        }
    }
    let missing: Vec<&str> = CATALOGUE.iter().map(|rule| rule.id).filter(|id| !met.contains(id) && !UNMET.contains(id)).collect();
    assert!(missing.is_empty(), "no preset has a finding of {missing:?}");
}
