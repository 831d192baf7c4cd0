//! How a list of accepted findings follows a run.

use super::baseline::{Accepted, Baseline};
use super::outcome::{CheckedFrame, Outcome};
use super::policy::Standing;

fn checked(outcomes: &[Outcome]) -> impl Iterator<Item = &CheckedFrame> {
    outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok())
}

/// A list of all that fails, or would without a list; of frames that were not checked, what a former list has.
pub fn renewed(outcomes: &[Outcome], former: Option<Baseline>) -> Baseline {
    let failing = checked(outcomes).flat_map(|frame| {
        let failing = frame.findings.iter().filter(|judged| judged.standing >= Standing::Accepted);
        failing.map(|judged| (frame.frame.as_str(), &judged.finding))
    });
    let frames: Vec<&str> = checked(outcomes).map(|frame| frame.frame.as_str()).collect();
    Baseline::of(failing).with_other_frames(former, &frames)
}

/// Entries of frames that were checked and no longer have such a finding.
pub fn no_longer_failing<'a>(list: &'a Baseline, outcomes: &[Outcome]) -> Vec<&'a Accepted> {
    let fails = |entry: &Accepted, frame: &CheckedFrame| {
        frame.findings.iter().any(|judged| judged.standing >= Standing::Accepted && entry.is(&frame.frame, &judged.finding))
    };
    let of_frame = |entry: &Accepted| checked(outcomes).find(|frame| frame.frame == entry.frame);
    list.entries().iter().filter(|entry| of_frame(entry).is_some_and(|frame| !fails(entry, frame))).collect()
}
