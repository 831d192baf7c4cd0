//! Tables for a terminal: readable without colour, coloured only on one.

use std::borrow::Cow;
use std::io::IsTerminal;

use super::terminal::PAINT;
use crate::checks::{Finding, Tightest, Verdict};

/// Findings, violations marked, with value, limit and margin.
pub(super) fn findings(findings: &[Tightest]) -> String {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let width = findings.iter().map(|shown| shown.finding.subject.chars().count()).max().unwrap_or(0).min(48);
    let mut text = String::new();
    for Tightest { finding, of } in findings {
        let among = if *of > 1 { format!("  tightest of {of}") } else { String::new() };
        text += &format!(
            "{word}  {:<19} {:<width$}  {:>8} {unit:<4} limit {:>7} {unit:<4} margin {:>7}{among}\n",
            finding.rule,
            one_line(&finding.subject),
            finding.figures()[0],
            finding.figures()[1],
            finding.figures()[2],
            word = verdict(finding, colour),
            unit = finding.unit
        );
        if finding.verdict == Verdict::Violated {
            let mend = if finding.levers.is_empty() { String::new() } else { format!("; try {}", one_of(&finding.levers)) };
            text += &format!("          {}{mend}\n", one_line(&finding.message));
        }
        if finding.verdict == Verdict::Note && finding.margin < 0.0 {
            text += &format!("          {}\n", one_line(&finding.message));
        }
    }
    text
}

/// A text without line breaks: what begins a line of a log may be a command to whoever reads the log.
fn one_line(text: &str) -> String {
    text.replace(['\n', '\r'], " ")
}

/// Keys as alternatives: `a, b or c`.
fn one_of(keys: &[Cow<'static, str>]) -> String {
    match keys {
        [] => String::new(),
        [key] => key.clone().into_owned(),
        [first @ .., last] => format!("{} or {last}", first.join(", ")),
    }
}

fn verdict(finding: &Finding, colour: bool) -> String {
    let (word, paint) = match finding.verdict {
        Verdict::Holds => ("holds   ", PAINT[1]),
        Verdict::Violated => ("VIOLATED", PAINT[0]),
        Verdict::Note => ("note    ", PAINT[2]),
    };
    if colour { format!("{paint}{word}{}", PAINT[3]) } else { word.to_string() }
}
