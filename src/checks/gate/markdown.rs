//! The gate as Markdown: for a pull request's comment or a job's summary.

use std::fmt::Write;

use super::outcome::{CheckedFrame, Outcome, Refused};
use super::policy::Standing;
use crate::checks::{self, Finding, Verdict};
use crate::markdown::{code, inert};

/// A table of frames, then what is wrong with each, then the tightest limits of each.
pub fn page(outcomes: &[Outcome]) -> String {
    let mut page = String::from("| frame | mass g | size mm | fails | warnings | accepted | |\n|---|---|---|---|---|---|---|\n");
    for outcome in outcomes {
        page += &match &outcome.result {
            Ok(held) => row(held),
            Err(_) => format!("| {} | | | | | | **refused** |\n", inert(&outcome.asked)),
        };
    }
    for outcome in outcomes {
        page += &match &outcome.result {
            Ok(held) => section(held),
            Err(refused) => refusal(&outcome.asked, refused),
        };
    }
    page
}

fn row(held: &CheckedFrame) -> String {
    let extent = |axis: &str| {
        let subject = format!("{axis} without propellers");
        held.findings.iter().find(|judged| judged.finding.subject == subject).map_or(0.0, |judged| judged.finding.value)
    };
    let [x, y, z] = ["width", "depth", "height"].map(extent);
    let [fails, warnings, accepted] = [Standing::Fails, Standing::Warning, Standing::Accepted].map(|standing| held.count(standing));
    let word = if fails > 0 { "**fails**" } else { "passes" };
    format!(
        "| {} | {:.1} | {x:.1} x {y:.1} x {z:.1} | {fails} | {warnings} | {accepted} | {word} |\n",
        inert(&held.frame),
        held.masses.total_g
    )
}

fn refusal(asked: &str, refused: &Refused) -> String {
    let Refused { message, remedy, spot, .. } = refused;
    let place = spot.as_ref().map_or(String::new(), |spot| format!(" ({})", code(&format!("{}:{}:{}", spot.file, spot.line, spot.column))));
    format!("\n### {}\n\nRefused{place}: {}. {}\n", inert(asked), inert(message), inert(remedy))
}

fn section(held: &CheckedFrame) -> String {
    let mut text = format!("\n### {}\n\n", inert(&held.frame));
    for (standing, word) in [(Standing::Fails, "**fails**"), (Standing::Warning, "warning"), (Standing::Accepted, "accepted")] {
        for judged in held.of(standing) {
            let place = judged.spots.first().map_or(String::new(), |spot| format!(" ({})", code(&format!("{}:{}", spot.file, spot.line))));
            let _ = writeln!(text, "- {word}: {}{}{place}", inert(&judged.message()), inert(&judged.made_of));
        }
    }
    text += "\n<details><summary>margins</summary>\n\n| rule | of | value | limit | margin |\n|---|---|---|---|---|\n";
    let findings: Vec<Finding> = held.findings.iter().map(|judged| judged.finding.clone()).collect();
    for shown in checks::tightest(&findings).iter().filter(|shown| shown.finding.verdict != Verdict::Note) {
        let f = shown.finding;
        let [value, limit, margin] = f.figures();
        let _ = writeln!(text, "| {} | {} | {value} {unit} | {limit} {unit} | {margin} |", f.rule, inert(&f.subject), unit = f.unit);
    }
    text + "\n</details>\n"
}
