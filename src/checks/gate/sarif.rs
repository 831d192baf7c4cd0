//! SARIF 2.1.0 (OASIS standard): what code scanning services read.

use serde_json::{Value, json};

use super::blame::Spot;
use super::outcome::{CheckedFrame, Judged, Outcome, Refused};
use super::policy::Standing;
use crate::checks::Rule;

/// What is reported of a file that gives no frame: identifier, name and sentence.
const REFUSED: [&str; 3] = ["refused", "Refused", "The frame file can be read, and describes a possible frame."];

/// The log as JSON text. The rules are those that the findings are of.
pub fn log(outcomes: &[Outcome], rules: &[&Rule]) -> String {
    let results: Vec<Value> = outcomes
        .iter()
        .flat_map(|outcome| match &outcome.result {
            Ok(held) => of_frame(&outcome.asked, held, rules),
            Err(refused) => vec![of_refusal(&outcome.asked, refused, rules)],
        })
        .collect();
    let described = |id: &str, name: &str, text: &str| json!({ "id": id, "name": name, "shortDescription": { "text": text } });
    let refused = described(REFUSED[0], REFUSED[1], REFUSED[2]);
    let described = rules.iter().map(|rule| described(rule.id, rule.title, &rule.sentence()));
    let driver = json!({
        "name": "flexframe",
        "semanticVersion": env!("CARGO_PKG_VERSION"),
        "rules": std::iter::once(refused).chain(described).collect::<Vec<_>>(),
    });
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{ "tool": { "driver": driver }, "columnKind": "unicodeCodePoints", "results": results }],
    });
    format!("{log:#}\n")
}

fn of_frame(asked: &str, held: &CheckedFrame, rules: &[&Rule]) -> Vec<Value> {
    let reported = held.findings.iter().filter(|judged| judged.standing != Standing::Good);
    reported.map(|judged| result(asked, held, judged, rules)).collect()
}

fn result(asked: &str, held: &CheckedFrame, judged: &Judged, rules: &[&Rule]) -> Value {
    let Judged { finding, standing, spots, made_of, .. } = judged;
    let level = match standing {
        Standing::Fails => "error",
        Standing::Accepted => "note",
        Standing::Good | Standing::Warning => "warning",
    };
    let text = format!("{}: {}{made_of}", held.frame, judged.message());
    let mut result = json!({
        "ruleId": finding.rule,
        "level": level,
        "message": { "text": text },
        "locations": spots.first().map(location).into_iter().collect::<Vec<_>>(),
        "relatedLocations": spots.iter().skip(1).map(location).collect::<Vec<_>>(),
        // The same finding in the next run, whatever its numbers and whatever other frames are checked. Of two frames of one name the file differs.
        "partialFingerprints": {
            "frameRuleSubject/v1": format!("{}/{}/{}", held.frame, finding.rule, finding.subject),
            "frameFile/v1": asked,
        },
        "properties": { "frame": asked, "value": finding.value, "limit": finding.limit, "margin": finding.margin, "unit": finding.unit },
    });
    number_rule(&mut result, rules);
    if *standing == Standing::Accepted {
        result["suppressions"] = json!([{ "kind": "external", "justification": "in the list of accepted findings" }]);
    }
    result
}

fn of_refusal(asked: &str, refused: &Refused, rules: &[&Rule]) -> Value {
    let Refused { message, remedy, spot, .. } = refused;
    let mut result = json!({
        "ruleId": REFUSED[0],
        "level": "error",
        "message": { "text": format!("{asked}: {message}. {remedy}") },
        "locations": spot.iter().map(location).collect::<Vec<_>>(),
    });
    number_rule(&mut result, rules);
    result
}

/// Where a result's rule stands in the list; `refused` is the first.
fn number_rule(result: &mut Value, rules: &[&Rule]) {
    let mut listed = std::iter::once(REFUSED[0]).chain(rules.iter().map(|rule| rule.id));
    if let Some(at) = listed.position(|id| result["ruleId"] == id) {
        result["ruleIndex"] = json!(at);
    }
}

fn location(spot: &Spot) -> Value {
    let mut location = json!({
        "physicalLocation": {
            "artifactLocation": { "uri": uri(&spot.file) },
            "region": { "startLine": spot.line, "startColumn": spot.column },
        },
    });
    if !spot.key.is_empty() {
        location["message"] = json!({ "text": spot.key });
    }
    location
}

/// A path as a relative reference of RFC 3986; an absolute one as a `file:` URI.
fn uri(path: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte);
    let path = path.replace('\\', "/");
    let escaped: String = path.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect();
    if path.starts_with('/') { format!("file://{escaped}") } else { escaped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_paths_become_uris() {
        assert_eq!(uri("frames/light.toml"), "frames/light.toml");
        assert_eq!(uri("/tmp/a b.toml"), "file:///tmp/a%20b.toml");
        assert_eq!(uri("c:d%é.toml"), "c%3Ad%25%C3%A9.toml");
    }
}
