//! A JUnit report: a suite a frame, a case a finding. Without times, so the same frames give the same bytes.

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
    for outcome in outcomes {
        report.add_test_suite(match &outcome.result {
            Ok(held) => suite(&outcome.asked, held),
            Err(refused) => refused_suite(&outcome.asked, refused),
        });
    }
    report.to_string()
}

fn suite(asked: &str, held: &CheckedFrame) -> TestSuite {
    let mut suite = TestSuite::new(held.frame.as_str());
    suite.add_property(("frame", asked));
    suite.add_property(("mass_g", format!("{:.3}", held.masses.total_g).as_str()));
    suite.add_test_cases(held.findings.iter().map(|judged| case(held, judged)));
    suite
}

fn case(held: &CheckedFrame, judged: &Judged) -> TestCase {
    let Judged { finding, standing, spots, made_of, .. } = judged;
    let text = format!("{}{}{}", finding.message, made_of, place(spots.first()));
    let status = match standing {
        Standing::Good | Standing::Warning => TestCaseStatus::success(),
        Standing::Accepted => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(format!("accepted: {text}"));
            status
        }
        Standing::Fails => failed(NonSuccessKind::Failure, &finding.rule, &finding.message, &text),
    };
    let mut case = TestCase::new(format!("{}: {}", finding.rule, finding.subject), status);
    case.set_classname(format!("flexframe.{}.{}", held.frame, finding.rule));
    if let Some(spot) = spots.first() {
        case.extra.insert("file".into(), spot.file.as_str().into());
        case.extra.insert("line".into(), spot.line.to_string().into());
    }
    if *standing == Standing::Warning {
        case.set_system_out(format!("warning: {text}"));
    }
    case
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
