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
            let mend = if finding.levers.is_empty() { String::new() } else { format!("; driven by {}", one_of(&finding.levers)) };
            text += &format!("          {}{mend}\n", one_line(&finding.message));
        }
        if finding.verdict == Verdict::Note && finding.margin < 0.0 {
            text += &format!("          {}\n", one_line(&finding.message));
        }
    }
    text
}

/// Columns of the brief table: what a terminal has at least.
const COLUMNS: usize = 80;
/// Of these the rule's name and its finding's subject have so many.
const RULE: usize = 19;
const SUBJECT: usize = 28;

/// What a person has to read of a frame: every violation with its remedies, then the tightest finding of each rule that holds, a
/// line each, and how many notes there are. No line is longer than [`COLUMNS`].
///
/// With `strict` a note that exceeds its limit fails, so it is reported, too.
pub(super) fn brief(findings: &[Finding], strict: bool) -> String {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let mut text = String::new();
    let warns = |finding: &Finding| strict && finding.verdict == Verdict::Note && finding.margin < 0.0;
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Violated || warns(finding)) {
        let word = if warns(finding) { "WARNING " } else { "VIOLATED" };
        let mend = if finding.levers.is_empty() { String::new() } else { format!("; driven by {}", one_of(&finding.levers)) };
        let message = format!("{word} {}: {}{mend}", finding.rule, one_line(&finding.message));
        let lines = textwrap::wrap(&message, textwrap::Options::new(COLUMNS).subsequent_indent("         ")).join("\n");
        let painted = format!("{}{word}{}", PAINT[if warns(finding) { 2 } else { 0 }], PAINT[3]);
        text += &if colour { lines.replacen(word, &painted, 1) } else { lines };
        text.push('\n');
    }
    let mut told: Vec<&str> = Vec::new();
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Holds) {
        if !told.contains(&&*finding.rule) {
            told.push(&finding.rule);
            text += &tightest_of(&finding.rule, findings);
        }
    }
    if strict { text } else { text + &notes(findings) }
}

/// The tightest finding of a rule that holds, by its margin as a share of the limit, as a line.
fn tightest_of(rule: &str, findings: &[Finding]) -> String {
    // What is held to zero has no share; it comes after what has one, by its margin.
    let share = |f: &Finding| if f.limit == 0.0 { 1e6 + f.margin } else { f.margin / f.limit.abs() };
    let of_rule = findings.iter().filter(|f| f.rule == rule && f.verdict == Verdict::Holds);
    let Some(f) = of_rule.min_by(|a, b| share(a).total_cmp(&share(b))) else { return String::new() };
    let [value, limit, _] = f.figures();
    // A long subject goes on below, in its column.
    let subject = one_line(&f.subject);
    let mut pieces = textwrap::wrap(&subject, SUBJECT).into_iter();
    let first = pieces.next().unwrap_or_default();
    let mut text = format!("{rule:<RULE$} {first:<SUBJECT$} {value:>7} {:<8} {limit:>7} {}", side(f), f.unit).trim_end().to_string() + "\n";
    for piece in pieces {
        text += &format!("{:RULE$} {piece}\n", "");
    }
    text
}

/// On which side of its limit a value has to be; the limit alone where the two are as good as one.
fn side(finding: &Finding) -> &'static str {
    let above = finding.value - finding.limit;
    match (finding.margin > 0.0).then_some(above > 0.0) {
        Some(true) => "at least",
        Some(false) => "at most",
        None => "limit",
    }
}

/// How many notes there are, by rule.
fn notes(findings: &[Finding]) -> String {
    let mut rules: Vec<(&str, usize)> = Vec::new();
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Note && finding.margin < 0.0) {
        match rules.iter_mut().find(|(rule, _)| *rule == finding.rule) {
            Some((_, count)) => *count += 1,
            None => rules.push((&finding.rule, 1)),
        }
    }
    if rules.is_empty() {
        return String::new();
    }
    let counts = rules.iter().map(|(rule, count)| format!("{count} of {rule}")).collect::<Vec<_>>().join(", ");
    textwrap::fill(&format!("notes: {counts}; --all tells them"), COLUMNS) + "\n"
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
