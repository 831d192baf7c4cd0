//! Tables for a terminal: readable without colour, coloured only on one.

use std::io::IsTerminal;

use crate::checks::{Finding, Verdict};

/// The findings, violations marked, with value, limit and margin.
pub(super) fn findings(findings: &[Finding]) -> String {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let width = findings.iter().map(|finding| finding.subject.chars().count()).max().unwrap_or(0).min(48);
    let mut text = String::new();
    for finding in findings {
        let (word, paint) = match finding.verdict {
            Verdict::Holds => ("holds   ", "\x1b[32m"),
            Verdict::Violated => ("VIOLATED", "\x1b[31m"),
            Verdict::Note => ("note    ", "\x1b[33m"),
        };
        let word = if colour { format!("{paint}{word}\x1b[0m") } else { word.to_string() };
        text += &format!(
            "{word}  {:<22} {:<width$}  {:>9.2} {unit:<4} limit {:>8.2} {unit:<4} margin {:>8.2}\n",
            finding.rule,
            finding.subject,
            finding.value,
            finding.limit,
            finding.margin,
            unit = finding.unit
        );
        if finding.verdict == Verdict::Violated {
            text += &format!("          {}; driven by {}\n", finding.message, finding.parameter);
        }
    }
    text
}
