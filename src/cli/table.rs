//! Tables for a terminal: readable without colour, coloured only on one.

use std::io::IsTerminal;

use crate::checks::{Finding, Tightest, Verdict};

/// Findings, violations marked, with value, limit and margin.
pub(super) fn findings(findings: &[Tightest]) -> String {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let width = findings.iter().map(|shown| shown.finding.subject.chars().count()).max().unwrap_or(0).min(48);
    let mut text = String::new();
    for Tightest { finding, of } in findings {
        let among = if *of > 1 { format!("  tightest of {of}") } else { String::new() };
        text += &format!(
            "{word}  {:<19} {:<width$}  {:>8.2} {unit:<4} limit {:>7.2} {unit:<4} margin {:>7.2}{among}\n",
            finding.rule,
            finding.subject,
            finding.value,
            finding.limit,
            finding.margin + 0.0,
            word = verdict(finding, colour),
            unit = finding.unit
        );
        if finding.verdict == Verdict::Violated {
            text += &format!("          {}; driven by {}\n", finding.message, finding.parameter);
        }
    }
    text
}

fn verdict(finding: &Finding, colour: bool) -> String {
    let (word, paint) = match finding.verdict {
        Verdict::Holds => ("holds   ", "\x1b[32m"),
        Verdict::Violated => ("VIOLATED", "\x1b[31m"),
        Verdict::Note => ("note    ", "\x1b[33m"),
    };
    if colour { format!("{paint}{word}\x1b[0m") } else { word.to_string() }
}
