//! A JUnit report: a suite a frame, a case a rule. Without times, so the same frames give the same bytes.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::blame::Spot;
use super::outcome::{CheckedFrame, Judged, Outcome, Refused};
use super::policy::Standing;

/// The report as XML.
///
/// # Errors
/// When the XML cannot be written.
pub fn xml(outcomes: &[Outcome]) -> Result<String, quick_junit::SerializeError> {
    let mut report = Report::new("flexframe check");
    for (outcome, name) in told_apart(outcomes) {
        report.add_test_suite(match &outcome.result {
            Ok(held) => suite(&outcome.asked, name, held),
            Err(refused) => refused_suite(&outcome.asked, refused),
        });
    }
    report.to_string()
}

/// What each outcome is called where a reader joins by names: the frame's name, or what was asked for where another frame has the same.
fn told_apart(outcomes: &[Outcome]) -> impl Iterator<Item = (&Outcome, &str)> {
    let name = |outcome: &Outcome| outcome.result.as_ref().ok().map(|held| held.frame.clone());
    outcomes.iter().map(move |outcome| {
        let own = outcome.result.as_ref().map_or(outcome.asked.as_str(), |held| held.frame.as_str());
        let alike = outcomes.iter().filter(|other| name(other).is_some_and(|other| other == own)).count();
        (outcome, if alike > 1 { outcome.asked.as_str() } else { own })
    })
}

fn suite(asked: &str, name: &str, held: &CheckedFrame) -> TestSuite {
    let mut suite = TestSuite::new(name);
    suite.add_property(("frame", asked));
    suite.add_property(("mass_g", format!("{:.3}", held.masses.total_g).as_str()));
    let mut rules: Vec<&str> = Vec::new();
    for judged in &held.findings {
        if !rules.contains(&&*judged.finding.rule) {
            rules.push(&judged.finding.rule);
        }
    }
    suite.add_test_cases(rules.into_iter().map(|rule| case(name, held, rule)));
    suite
}

/// A rule: it fails by what fails, then it is skipped by what is accepted; what is noted stands in its output.
fn case(name: &str, held: &CheckedFrame, rule: &str) -> TestCase {
    let of = |standing: Standing| held.findings.iter().filter(move |judged| judged.standing == standing && judged.finding.rule == rule);
    let lines = |standing: Standing| of(standing).map(text).collect::<Vec<_>>().join("\n");
    let (fails, accepted, warnings) = (of(Standing::Fails).next(), of(Standing::Accepted).next(), lines(Standing::Warning));
    let status = match (fails, accepted) {
        (Some(first), _) => failed(NonSuccessKind::Failure, rule, &first.message(), &lines(Standing::Fails)),
        (None, Some(_)) => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(format!("accepted: {}", lines(Standing::Accepted)));
            status
        }
        (None, None) => TestCaseStatus::success(),
    };
    let mut case = TestCase::new(rule, status);
    case.set_classname(format!("flexframe.{name}"));
    if let Some(spot) = fails.or(accepted).and_then(|judged| judged.spots.first()) {
        case.extra.insert("file".into(), spot.file.as_str().into());
        case.extra.insert("line".into(), spot.line.to_string().into());
    }
    if !warnings.is_empty() {
        case.set_system_out(format!("warning: {warnings}"));
    }
    case
}

fn text(judged: &Judged) -> String {
    format!("{}{}{}", judged.message(), judged.made_of, place(judged.spots.first()))
}

fn refused_suite(asked: &str, refused: &Refused) -> TestSuite {
    let Refused { message, remedy, spot, .. } = refused;
    let text = format!("{message}. {remedy}{}", place(spot.as_ref()));
    let mut case = TestCase::new("reads", failed(NonSuccessKind::Error, "refused", message, &text));
    case.set_classname(format!("flexframe.{asked}"));
    let mut suite = TestSuite::new(asked);
    suite.add_test_case(case);
    suite
}

fn failed(kind: NonSuccessKind, word: &str, message: &str, text: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(word).set_message(message).set_description(text);
    status
}

fn place(spot: Option<&Spot>) -> String {
    spot.map_or(String::new(), |spot| format!("\n{}:{}:{}", spot.file, spot.line, spot.column))
}
