//! Annotations of GitHub Actions: workflow commands that mark lines of a pull request.
//!
//! Form: docs.github.com, "Workflow commands for GitHub Actions": `::error file=F,line=L,col=C,title=T::MESSAGE`, with `%`,
//! line feeds and carriage returns escaped in messages, in properties `:` and `,` too.

use super::blame::Spot;
use super::outcome::{CheckedFrame, Judged, Outcome, Refused};
use super::policy::Standing;

/// One line an annotation, errors first; none for frames that pass.
pub fn annotations(outcomes: &[Outcome]) -> String {
    let mut lines = Vec::new();
    for outcome in outcomes {
        match &outcome.result {
            // Nothing has to be done about a frame that passes.
            Ok(held) if held.count(Standing::Fails) == 0 => {}
            Ok(held) => lines.extend(of_frame(held)),
            Err(refused) => lines.push((0, of_refusal(&outcome.asked, refused))),
        }
    }
    lines.sort_by_key(|(rank, _)| *rank);
    lines.into_iter().map(|(_, line)| line + "\n").collect()
}

fn of_refusal(asked: &str, refused: &Refused) -> String {
    let Refused { message, remedy, spot, .. } = refused;
    command("error", spot.as_ref(), "refused", &format!("{asked}: {message}. {remedy}"))
}

fn of_frame(held: &CheckedFrame) -> Vec<(u8, String)> {
    let mut lines = Vec::new();
    for judged in &held.findings {
        let Judged { finding, standing, spots, made_of, .. } = judged;
        let (rank, word) = match standing {
            Standing::Good => continue,
            Standing::Fails => (0, "error"),
            Standing::Warning => (1, "warning"),
            Standing::Accepted => (2, "notice"),
        };
        let accepted = if *standing == Standing::Accepted { " (accepted)" } else { "" };
        let title = format!("{}: {}", held.frame, finding.rule);
        lines.push((rank, command(word, spots.first(), &title, &format!("{}{accepted}{made_of}", judged.message()))));
        if *standing == Standing::Fails {
            lines.extend(
                spots.iter().skip(1).map(|spot| (2, command("notice", Some(spot), &title, &format!("`{}` drives this, too", spot.key)))),
            );
        }
    }
    lines
}

fn command(word: &str, spot: Option<&Spot>, title: &str, message: &str) -> String {
    let title = property(title);
    let place = spot.map_or(String::new(), |spot| format!("file={},line={},col={},", property(&spot.file), spot.line, spot.column));
    format!("::{word} {place}title={title}::{}", data(message))
}

fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_nothing_in_a_name_ends_a_command() {
        let spot = Spot { file: "a,b:c\n::error::.toml".into(), line: 3, column: 1, key: String::new() };
        let line = command("error", Some(&spot), "t", "100 %\nnew");
        assert_eq!(line, "::error file=a%2Cb%3Ac%0A%3A%3Aerror%3A%3A.toml,line=3,col=1,title=t::100 %25%0Anew");
    }
}
