//! How a list of accepted findings follows a run.

use super::baseline::{Accepted, Baseline};
use super::outcome::{CheckedFrame, Judged, Outcome};
use super::policy::Standing;
use crate::checks::CATALOGUE;

fn checked(outcomes: &[Outcome]) -> impl Iterator<Item = &CheckedFrame> {
    outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok())
}

/// What a run says about an entry of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Said {
    /// Nothing: its frame was not checked, its rule not run, or its finding is a warning, which fails only where warnings do.
    Nothing,
    /// That there still is such a finding.
    Fails,
    /// That there is none any more.
    NoLonger,
}

/// What a run says about an entry. `drop_simulated`: whether the rules of the drop were run, which they are on request only.
fn said(entry: &Accepted, outcomes: &[Outcome], drop_simulated: bool) -> Said {
    let not_run = !drop_simulated && CATALOGUE.iter().any(|rule| rule.id == entry.rule && rule.needs_prediction());
    let Some(frame) = checked(outcomes).find(|frame| entry.is_of(frame.listed())).filter(|_| !not_run) else { return Said::Nothing };
    let standings = frame.findings.iter().filter(|judged| entry.is(&judged.finding)).map(|judged| judged.standing);
    match standings.max() {
        Some(Standing::Fails | Standing::Accepted) => Said::Fails,
        Some(Standing::Warning) => Said::Nothing,
        Some(Standing::Good) | None => Said::NoLonger,
    }
}

/// A list of all that fails, or would without a list, and of what a former list has and this run says nothing about.
pub fn renewed(outcomes: &[Outcome], drop_simulated: bool, former: Option<&Baseline>) -> Baseline {
    let failing = checked(outcomes).flat_map(|frame| {
        let failing = frame.findings.iter().filter(|judged| judged.standing >= Standing::Accepted);
        failing.map(|judged| (frame.listed(), &judged.finding))
    });
    let kept = former.into_iter().flat_map(Baseline::entries).filter(|entry| said(entry, outcomes, drop_simulated) == Said::Nothing);
    Baseline::of(failing).with(kept.cloned())
}

/// Entries of which this run says that there is no such finding any more.
pub fn no_longer_failing<'a>(list: &'a Baseline, outcomes: &[Outcome], drop_simulated: bool) -> Vec<&'a Accepted> {
    list.entries().iter().filter(|entry| said(entry, outcomes, drop_simulated) == Said::NoLonger).collect()
}

/// Findings that fail and are accepted of a frame of the same name in another file: frame, finding, and what the list has.
pub fn accepted_of_another_file<'a>(list: &'a Baseline, outcomes: &'a [Outcome]) -> Vec<(&'a CheckedFrame, &'a Judged, &'a Accepted)> {
    let of_another = |frame: &'a CheckedFrame| {
        let failing = frame.of(Standing::Fails);
        failing.filter_map(move |judged| {
            let is = |entry: &&Accepted| entry.frame == frame.frame && !entry.is_of(frame.listed()) && entry.is(&judged.finding);
            list.entries().iter().find(is).map(|entry| (frame, judged, entry))
        })
    };
    checked(outcomes).flat_map(of_another).collect()
}
