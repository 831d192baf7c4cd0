//! Whole frames against every rule.

use super::planted::{Planted, violated};
use super::*;

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
        "thinnest_wall: motor_mount",
        "thinnest_wall: battery_bracket",
    ];
    assert_eq!(broken("cognifly-v8"), known);
}

#[test]
fn regress_the_other_presets_hold() {
    for preset in ["cognifly", "cognifly-1106", "cognifly-bamboo", "cognifly-mini", "cognifly-2s2000"] {
        assert_eq!(broken(preset), Vec::<String>::new(), "{preset}");
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
    let rules: std::collections::BTreeSet<&str> = once.iter().map(|f| &*f.rule).collect();
    // The fold has two: whether there is a way, and whether it is free. Walls find gaps, too; printing has four names.
    assert_eq!(rules.len() + 1, RULES.len() + 1 + 3);
}

#[test]
fn analytic_margin_and_verdict_agree() {
    let frame = Planted::preset("cognifly-v8");
    for f in check(&frame.design, &frame.masses) {
        assert!(f.value.is_finite() && f.limit.is_finite(), "{f:?}");
        assert!(f.verdict == Verdict::Note || (f.verdict == Verdict::Holds) == (f.margin >= 0.0), "{f:?}");
    }
}
