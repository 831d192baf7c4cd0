//! The real drops diagnosed: the traps in them are not fallen for.

use crate::case;
use crate::case::Study;
use flexframe::impact::diagnose::Verdict;

/// Whether the records are there; says loudly when they are not.
fn is_there(test: &str) -> bool {
    let folder = case::folder();
    if !folder.is_dir() {
        println!("SKIPPED {test}: no folder {}; set FLEXFRAME_DATA", folder.display());
    }
    folder.is_dir()
}

#[test]
fn measured_drops_are_diagnosed_without_falling_for_their_traps() {
    if !is_there("docs/case-study.md") {
        return;
    }
    let study = Study::made();
    // The zero is that of one sensor, and what is left while the frame is held, of which nothing was used, is the weight.
    for (reading, session) in study.compared.free_fall.iter().zip(&study.sessions) {
        let held_g = session.held_g.expect("is held before it is dropped").median;
        assert!((reading.zero_g + 0.151).abs() < 0.006 && (held_g - 1.0).abs() < 0.01, "{reading:?}, held {held_g} g");
    }
    // The magnitude's impulse is impossible, the axis' is not.
    assert!(study.magnitude.iter().any(|one| one.impossible) && study.axial.iter().all(|one| !one.impossible));
    // The damper that goes with the filter, published and derived elsewhere: 46 at 79.6 Hz, 23.2 at 500 Hz.
    assert!((study.damper_at[1].1 - 46.0).abs() < 3.0 && (study.damper_at[4].1 - 23.2).abs() < 2.0, "{:?}", study.damper_at);
    assert!(study.free_cutoff.0 > 400.0, "the drops do not ask for the notebook's 79.6 Hz: {:?}", study.free_cutoff);
    // A stop whose place is a time: refused, with slopes near 1 where it scores well enough to be looked at height by height.
    let mut looked_at = 0;
    for id in ["bottoming", "bilinear_stiffness"] {
        let one = study.all.ranking.iter().find(|one| one.id == id).expect("was fitted");
        assert!(one.reason_rejected.is_some(), "{id}");
        let Some(steady) = one.constancy.as_ref() else { continue };
        looked_at += 1;
        let slope = steady.parameters[0].slope.expect("a slope");
        assert!(steady.p < 1e-4 && (0.6..1.3).contains(&slope), "{id}: {} {slope}", steady.p);
    }
    assert!(looked_at > 0, "neither stop was looked at height by height");
    let same = &study.all.residual_map.same_in;
    assert!(same.t > same.x && same.t > same.v, "{same:?}");
    assert_eq!(study.all.verdict, Verdict::NoneSuffices);
    // Judged on 150 cm, no set of effects along the vertical comes within a tenth of what the mean wave of 150 cm itself leaves. It did
    // while stalled records were in, which raised that scatter from 23 to 32 g: 1.15 is what holds without them (1.14 measured).
    let after = &study.judged.after.held_out;
    assert!(after.records_g <= 1.15 * after.template_g, "{after:?}");
    // Given each drop's own touches, landings on one foot leave less than that mean wave does: 20.2 g is the aim.
    let given = &study.landing.gaps.given_touches;
    assert!(given.records_g < study.landing.gaps.held_out.template_g && given.records_g <= 20.2, "{given:?}");
    // 3.5 g is the aim: 3.13 measured. By plain least squares of the legs, before, it was 3.3 to 5.8 (a bound of 6.0).
    assert!(given.net_g <= 3.5, "the mean of what is left: {given:?}");
    assert!(after.net_g < study.judged.before.held_out.net_g);
    // Landings on one foot, on legs with dry friction, come nearer to 150 cm than any set along the vertical. 6 g is the aim: 5.89 measured (6.05 to 11.6 before, with bounds of 6.1 g and
    // of 0.35 to 0.7 of the gap before).
    let population = study.landing.gaps.held_out.net_g;
    let [least_g, _] = study.landing.gaps.held_out_ci95_g.expect("150 cm is held out");
    let before_g = study.judged.before.held_out.net_g;
    let readme = include_str!("../../README.md");
    assert!(readme.contains(&format!("misses the mean wave of 150 cm by {population:.1} g\n(")), "README.md: the gap is {population:.1} g");
    assert!(
        population <= 6.0 && population < 0.35 * before_g && population < after.net_g && least_g < population,
        "{population} {least_g}"
    );
    // They fail `enough`: what single drops keep once their touches are given has a mean. With a mount of the sensor all tests
    // were passed until that was looked at; the mount does not make it smaller. `constant` is passed by little: friction of 50 and of 100 cm is the same with p = 1.6e-4
    // (5e-5 with the jitter of the trigger that slopes had been taken for, 0.76 with all readings alike).
    let failed: Vec<&str> = study.landing.gates.iter().filter(|gate| !gate.passed).map(|gate| gate.id).collect();
    assert_eq!(failed, ["enough"]);
    assert!(study.landing.rubs() && study.landing.given_touches.p < 0.01 && study.landing.refused.is_some());
    let kept = include_str!("../../docs/case-study.md");
    assert!(study.page() == kept, "docs/case-study.md is out of date: cargo run --release --example case_study");
}
