//! What two frames differ in, as a table for a terminal and as a page for a pull request.

use std::fmt::Write;

use crate::markdown::inert;
use crate::variant::{Changed, Difference, MECHANICS_CAVEAT, Measure, PEAK_CAVEAT, Trend, measure};

/// Titles of the sections, in order.
const TITLES: [&str; 4] = ["measures", "parameters", "masses, g", "printed volumes, mm3"];

fn sections(difference: &Difference) -> [&[Changed]; 4] {
    [&difference.measures, &difference.parameters, &difference.masses, &difference.volumes]
}

/// What changed, a line each, for somebody who watches.
pub fn changes(difference: &Difference) -> String {
    let mut text = String::new();
    let shown = |changes: &[Changed], all: bool| -> Vec<String> {
        let shown = changes.iter().filter(|c| all || c.trend != Trend::Neither);
        shown
            .map(|c| format!("  {} {} -> {} {}{}\n", c.name, c.reported[0], c.reported[1], c.unit, word(c)).replace("  \n", "\n"))
            .collect()
    };
    text += &shown(&difference.parameters, true).concat();
    text += &shown(&difference.measures, false).concat();
    if difference.measures.iter().any(|c| c.name == "peak" && c.trend != Trend::Neither) {
        text += &format!("  ({PEAK_CAVEAT})\n");
    }
    difference.not_compared.iter().for_each(|message| text += &format!("  {message}\n"));
    for (word, messages) in [("broken", &difference.broken), ("mended", &difference.mended)] {
        messages.iter().for_each(|message| text += &format!("  {word}: {message}\n"));
    }
    text
}

/// A table for a terminal.
pub fn text(difference: &Difference) -> String {
    let [a, b] = &difference.names;
    let mut text = format!("a: {a}\nb: {b}\n");
    for (title, changes) in TITLES.into_iter().zip(sections(difference)).filter(|(_, changes)| !changes.is_empty()) {
        let name = changes.iter().map(|c| c.name.chars().count()).max().unwrap_or(0);
        let wide = changes.iter().flat_map(|c| &c.reported).map(|text| text.chars().count()).max().unwrap_or(0).max(8);
        let _ = writeln!(text, "\n{title:<name$}  {:>wide$} {:>wide$} {:>9}", "a", "b", "b - a");
        for change in changes {
            let [before, after] = change.reported.each_ref().map(|text| if text.is_empty() { "-" } else { text });
            let row = format!("{:<name$}  {before:>wide$} {after:>wide$} {:>9} {}", change.name, change.grown_reported(), change.unit);
            let _ = writeln!(text, "{}{}", row.trim_end(), word(change));
        }
    }
    for (word, messages) in [("broken", &difference.broken), ("mended", &difference.mended)] {
        for message in messages {
            let _ = write!(text, "\n{word}: {message}");
        }
    }
    if !(difference.broken.is_empty() && difference.mended.is_empty()) {
        text.push('\n');
    }
    if difference.is_empty() {
        text += "\nno difference\n";
    }
    format!("{text}\n{}", caveats(difference, str::to_string))
}

/// What the predicted figures leave out.
fn caveats(difference: &Difference, written: fn(&str) -> String) -> String {
    let mechanics = difference.measures.iter().any(|change| measure(&change.name).is_some_and(Measure::is_mechanics));
    let not_compared = difference.not_compared.iter().map(|message| written(message));
    let all: Vec<String> = not_compared.chain([PEAK_CAVEAT.into()]).chain(mechanics.then(|| MECHANICS_CAVEAT.into())).collect();
    format!("{}\n", all.join("\n\n"))
}

fn word(change: &Changed) -> &'static str {
    match change.trend {
        Trend::Better => "  better",
        Trend::Worse => "  worse",
        Trend::Neither => "",
    }
}

/// A page in Markdown.
pub fn markdown(difference: &Difference) -> String {
    let [a, b] = difference.names.each_ref().map(|name| inert(name));
    let mut page = format!("## {a} to {b}\n");
    for message in &difference.broken {
        let _ = write!(page, "\n- **broken**: {}", inert(message));
    }
    for message in &difference.mended {
        let _ = write!(page, "\n- mended: {}", inert(message));
    }
    if difference.is_empty() {
        page += "\nNo difference.";
    }
    if !page.ends_with('\n') {
        page.push('\n');
    }
    for (at, (title, changes)) in TITLES.into_iter().zip(sections(difference)).enumerate() {
        let shown: Vec<&Changed> = changes.iter().filter(|c| !c.is_same()).collect();
        if shown.is_empty() {
            continue;
        }
        let folded = at > 1;
        let _ = if folded { write!(page, "\n<details><summary>{title}</summary>\n") } else { write!(page, "\n**{title}**\n") };
        page += "\n| | a | b | b - a | |\n|---|---:|---:|---:|---|\n";
        for change in shown {
            let [before, after] = change.reported.each_ref().map(|text| inert(text));
            // Keys of numbers end in their unit.
            let unitless = change.unit.is_empty() || at == 1;
            let unit = if unitless { String::new() } else { format!(" {}", change.unit) };
            let _ = writeln!(
                page,
                "| {}{unit} | {before} | {after} | {} | {} |",
                inert(&change.name),
                change.grown_reported(),
                word(change).trim()
            );
        }
        if folded {
            page += "\n</details>\n";
        }
    }
    format!("{page}\n{}", caveats(difference, inert))
}
