//! Tables for a terminal: readable without colour, coloured only on one.

use std::borrow::Cow;
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
            "{word}  {:<19} {:<width$}  {:>8} {unit:<4} limit {:>7} {unit:<4} margin {:>7}{among}\n",
            finding.rule,
            finding.subject,
            finding.figures()[0],
            finding.figures()[1],
            finding.figures()[2],
            word = verdict(finding, colour),
            unit = finding.unit
        );
        if finding.verdict == Verdict::Violated {
            let mend = if finding.levers.is_empty() { String::new() } else { format!("; try {}", one_of(&finding.levers)) };
            text += &format!("          {}{mend}\n", finding.message);
        }
        if finding.verdict == Verdict::Note && finding.margin < 0.0 {
            text += &format!("          {}\n", finding.message);
        }
    }
    text
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
        Verdict::Holds => ("holds   ", "\x1b[32m"),
        Verdict::Violated => ("VIOLATED", "\x1b[31m"),
        Verdict::Note => ("note    ", "\x1b[33m"),
    };
    if colour { format!("{paint}{word}\x1b[0m") } else { word.to_string() }
}
