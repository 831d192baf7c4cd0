//! Whole frames against every rule.

use super::planted::{Planted, violated};
use super::*;

fn broken(preset: &str) -> Vec<String> {
    let frame = Planted::preset(preset);
    violated(&check(&frame.design, &frame.masses)).iter().map(|f| format!("{}: {}", f.rule, f.subject)).collect()
}

/// The camera board stands between the front propellers, which leave less room than it is wide.
fn is_the_camera(broken: &str) -> bool {
    broken.starts_with("propeller_clearance") && broken.contains(" to camera")
}

#[test]
fn measured_the_real_frame_breaks_what_it_is_known_to_break() {
    let mut found = broken("cognifly-v8");
    found.retain(|b| !is_the_camera(b));
    let width = ["envelope: width without propellers", "envelope: depth without propellers"];
    assert_eq!(found, [width[0], width[1], "thinnest_wall: motor_mount", "thinnest_wall: battery_bracket"]);
}

#[test]
fn regress_the_other_presets_hold() {
    for preset in ["cognifly", "cognifly-1106", "cognifly-bamboo", "cognifly-mini", "cognifly-2s2000"] {
        let mut found = broken(preset);
        found.retain(|b| !is_the_camera(b));
        assert_eq!(found, Vec::<String>::new(), "{preset}");
    }
}

#[test]
fn regress_findings_do_not_depend_on_threads() {
    let frame = Planted::preset("cognifly");
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| check(&frame.design, &frame.masses))
    };
    let once = on(1);
    assert_eq!(once, on(3));
    let rules: std::collections::BTreeSet<&str> = once.iter().map(|f| f.rule).collect();
    assert_eq!(rules.len(), RULES.len());
}

#[test]
fn analytic_margin_and_verdict_agree() {
    let frame = Planted::preset("cognifly-v8");
    for f in check(&frame.design, &frame.masses) {
        assert!(f.value.is_finite() && f.limit.is_finite(), "{f:?}");
        assert!(f.verdict == Verdict::Note || (f.verdict == Verdict::Holds) == (f.margin >= 0.0), "{f:?}");
    }
}
