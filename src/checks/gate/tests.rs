//! A rule from outside of the catalogue, through the gate.

use super::{CheckedFrame, Outcome, Policy, junit, sarif};
use crate::checks::planted::{Planted, TOY, table_line};
use crate::checks::{CATALOGUE, Cost, Rule, check_by};
use crate::params::files::Memory;
use crate::params::{Frame, FrameFile};

#[test]
fn planted_a_rule_needs_nothing_but_its_record() {
    let rules: Vec<&'static Rule> = CATALOGUE.into_iter().chain([&TOY]).collect();
    const TEXT: &str = "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 188.0\nstrut_rod_length_mm = 50.0\n";
    let file = FrameFile::load_from("short.toml", &Memory([("short.toml".into(), TEXT.into())].into())).expect("reads");
    let frame = Planted::designed(Frame::resolve(&file).expect("is one"));
    let findings = check_by(&[&TOY], Cost::Quick, &frame.design, &frame.masses);
    let policy = Policy { rules: &rules, ..Policy::default() };
    let checked = CheckedFrame::new(&frame.design.frame, &file, findings, frame.masses, policy);
    let blamed: Vec<&str> = checked.findings[0].spots.iter().map(|spot| spot.key.as_str()).collect();
    assert_eq!(blamed, ["rods.strut_rod_length_mm", "rods.cage_rod_length_mm"]);
    let outcome = |asked: &str| Outcome { asked: asked.into(), result: Ok(checked.clone()) };
    let log = sarif::log(&[outcome("short.toml")], &rules);
    let log: serde_json::Value = serde_json::from_str(&log).expect("JSON");
    let (run, last) = (&log["runs"][0], CATALOGUE.len() + 1);
    let described = &run["tool"]["driver"]["rules"][last];
    assert_eq!((&described["id"], &described["shortDescription"]["text"]), (&"toy".into(), &TOY.sentence().into()));
    assert_eq!((&run["results"][0]["ruleId"], &run["results"][0]["ruleIndex"]), (&"toy".into(), &last.into()));
    // Two frames of one name, which a reader would take for one; and what is the same of one of them in a list without the other.
    let both = [outcome("a/short.toml"), outcome("b/short.toml")];
    let prints = |outcomes: &[Outcome]| {
        let log: serde_json::Value = serde_json::from_str(&sarif::log(outcomes, &rules)).expect("JSON");
        let results = log["runs"][0]["results"].as_array().cloned().unwrap_or_default();
        results.iter().map(|result| result["partialFingerprints"].clone()).collect::<Vec<_>>()
    };
    let of = |file: &str| serde_json::json!({ "frameRuleSubject/v1": "short/toy/ring", "frameFile/v1": file });
    assert_eq!(prints(&both), [of("a/short.toml"), of("b/short.toml")]);
    assert_eq!(prints(&both[..1]), [of("a/short.toml")]);
    let report = junit::xml(&both).expect("writes");
    assert!(["a", "b"].iter().all(|folder| report.contains(&format!("classname=\"flexframe.{folder}/short.toml\""))), "{report}");
    assert_eq!(table_line(&TOY), "| `toy` | the rods of the ring are long enough for a toy | `[limits]` `part_clearance_mm` |");
}
