//! Tables for a terminal: readable without colour, coloured only on one.

use std::borrow::Cow;
use std::io::IsTerminal;

use super::terminal::PAINT;
use crate::checks::gate::{Judged, Standing};
use crate::checks::{Finding, Verdict};

/// Whether standard output is a terminal that shows colours, and nobody asked for none.
fn shows_colour() -> bool {
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    std::io::stdout().is_terminal() && !is_dumb && std::env::var_os("NO_COLOR").is_none()
}

/// Findings, violations marked, with value, limit and margin.
pub(super) fn findings(all: &[Judged]) -> String {
    let colour = shows_colour();
    let width = all.iter().map(|judged| judged.finding.subject.chars().count()).max().unwrap_or(0).min(48);
    let mut text = String::new();
    for judged in all {
        let finding = &judged.reported();
        text += &format!(
            "{word}  {:<19} {:<width$}  {:>8} {unit:<4} limit {:>7} {unit:<4} margin {:>7}\n",
            finding.rule,
            one_line(&finding.subject),
            finding.figures()[0],
            finding.figures()[1],
            finding.figures()[2],
            word = verdict(judged, colour),
            unit = finding.unit
        );
        if finding.verdict == Verdict::Violated {
            text += &format!("          {}{}\n", one_line(&finding.message), drivers(judged));
        }
        if finding.warns() {
            text += &format!("          {}\n", one_line(&finding.message));
        }
    }
    text
}

/// What drives a violation that fails, as a clause after its message.
fn drivers(judged: &Judged) -> String {
    let levers = judged.reported().levers;
    let is_open = judged.finding.verdict == Verdict::Violated && judged.standing != Standing::Accepted;
    if is_open && !levers.is_empty() { format!("; driven by {}", one_of(&levers)) } else { String::new() }
}

/// Columns of the brief table: what a terminal has at least. The rule's name and its finding's subject have so many of them.
const COLUMNS: usize = 80;
const RULE: usize = 19;
const SUBJECT: usize = 28;
/// Lines of a terminal: a frame without violations fits. Its last lines are the program's.
const ROWS: usize = 24;
const LAST_ROWS: usize = 4;
/// Rules that hold are told of at least so many, where there are so many warnings that all else would go.
const LEAST_RULES: usize = 4;

/// What a person has to read of a frame: every violation with its remedies, then what is accepted and the warnings, of warnings of one rule
/// and unit the first, then the tightest finding of each rule that holds, a line each; the rules with the most room are left out where a
/// screen has no more room. No line is longer than [`COLUMNS`].
///
/// With `strict` a note that exceeds its limit fails, so each is reported, and before what holds.
pub(super) fn brief(all: &[Judged], strict: bool) -> String {
    let colour = shows_colour();
    let is_violated = |judged: &&Judged| judged.finding.verdict == Verdict::Violated;
    let (accepted, open): (Vec<&Judged>, Vec<&Judged>) =
        all.iter().filter(is_violated).partition(|judged| judged.standing == Standing::Accepted);
    let mut text: String = open.into_iter().chain(accepted).map(|judged| told(judged, 0, colour)).collect();
    let mut groups: Vec<(&Judged, usize)> = Vec::new();
    for judged in all.iter().filter(|judged| judged.finding.warns()) {
        let alike = |first: &Judged| (&first.finding.rule, &first.finding.unit) == (&judged.finding.rule, &judged.finding.unit);
        match groups.iter_mut().find(|(first, _)| !strict && alike(first)) {
            Some((_, more)) => *more += 1,
            None => groups.push((judged, 0)),
        }
    }
    text.extend(groups.into_iter().map(|(judged, more)| told(judged, more, colour)));
    let room = ROWS.saturating_sub(LAST_ROWS + text.lines().count());
    let findings: Vec<Finding> = all.iter().map(Judged::reported).collect();
    text + &holding(&findings, room)
}

/// A violation or a warning, with how many more like it there are.
fn told(judged: &Judged, more: usize, colour: bool) -> String {
    let finding = judged.reported();
    let (word, paint) = match (judged.standing, finding.warns()) {
        (Standing::Accepted, _) => ("accepted", PAINT[2]),
        (_, true) => ("WARNING ", PAINT[2]),
        _ => ("VIOLATED", PAINT[0]),
    };
    let more = if more > 0 { format!("; {more} more like it") } else { String::new() };
    let message = format!("{word} {}: {}{}{more}", finding.rule, one_line(&finding.message), drivers(judged));
    let lines = textwrap::wrap(&message, textwrap::Options::new(COLUMNS).subsequent_indent("         ")).join("\n") + "\n";
    if colour { lines.replacen(word, &format!("{paint}{word}{}", PAINT[3]), 1) } else { lines }
}

/// The tightest finding of each rule that no finding violates, as far as there is room for so many lines.
fn holding(findings: &[Finding], room: usize) -> String {
    let mut rules: Vec<&str> = Vec::new();
    let is_violated = |rule: &str| findings.iter().any(|finding| finding.rule == rule && finding.verdict == Verdict::Violated);
    for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Holds && !is_violated(&finding.rule)) {
        if !rules.contains(&&*finding.rule) {
            rules.push(&finding.rule);
        }
    }
    let tightest: Vec<&Finding> = rules.iter().filter_map(|rule| tightest_of(rule, findings)).collect();
    let mut by_room: Vec<&Finding> = tightest.clone();
    by_room.sort_by(|a, b| share(a).total_cmp(&share(b)));
    let (mut shown, mut lines): (Vec<&str>, usize) = (Vec::new(), 0);
    for finding in by_room {
        lines += row(finding).lines().count();
        if lines <= room || shown.len() < LEAST_RULES {
            shown.push(&finding.rule);
        }
    }
    let rows: String = tightest.iter().filter(|finding| shown.contains(&&*finding.rule)).map(|finding| row(finding)).collect();
    let left = tightest.len() - shown.len();
    match left {
        0 => rows,
        1 => format!("{rows}1 more rule holds with more room; --all tells every finding\n"),
        _ => format!("{rows}{left} more rules hold with more room; --all tells every finding\n"),
    }
}

/// How much room a finding leaves: its margin as a share of the limit. What is held to zero has no share; it comes after what has one, by
/// its margin.
fn share(finding: &Finding) -> f64 {
    if finding.limit == 0.0 { 1e6 + finding.margin } else { finding.margin / finding.limit.abs() }
}

/// The tightest finding of a rule that holds.
fn tightest_of<'f>(rule: &str, findings: &'f [Finding]) -> Option<&'f Finding> {
    let of_rule = findings.iter().filter(|f| f.rule == rule && f.verdict == Verdict::Holds);
    of_rule.min_by(|a, b| share(a).total_cmp(&share(b)))
}

/// A finding that holds as a line.
fn row(f: &Finding) -> String {
    let [value, limit, _] = f.figures();
    // A long subject goes on below, in its column.
    let subject = one_line(&f.subject);
    let mut pieces = textwrap::wrap(&subject, SUBJECT).into_iter();
    let first = pieces.next().unwrap_or_default();
    let line = format!("{:<RULE$} {first:<SUBJECT$} {value:>7} {:<8} {limit:>7} {}", f.rule, side(f), f.unit);
    let mut text = line.trim_end().to_string() + "\n";
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

fn verdict(judged: &Judged, colour: bool) -> String {
    let (word, paint) = match (judged.standing, judged.finding.verdict) {
        (Standing::Accepted, _) => ("accepted", PAINT[2]),
        (_, Verdict::Holds) => ("holds   ", PAINT[1]),
        (_, Verdict::Violated) => ("VIOLATED", PAINT[0]),
        (_, Verdict::Note) => ("note    ", PAINT[2]),
    };
    if colour { format!("{paint}{word}{}", PAINT[3]) } else { word.to_string() }
}
