//! SARIF 2.1.0 (OASIS standard): what code scanning services read.

use serde_json::{Value, json};

use super::blame::Spot;
use super::github::why;
use super::outcome::{Held, Judged, Outcome, Refused, Standing};

/// Rules with a sentence each, in the order of the checks; `refused` is that of files that do not read.
const RULES: [(&str, &str); 20] = [
    ("refused", "The frame file cannot be read, or says what no frame can be."),
    ("envelope", "The frame's bounding box is no larger than its limits."),
    ("mass_budget", "The frame takes off with no more than its budget."),
    ("centre_of_mass", "The centre of mass is near the middle of the motors, in plan."),
    ("propeller_clearance", "Propellers stay clear of everything but their motors."),
    ("part_clearance", "Rods stay clear of each other and of parts that do not hold them."),
    ("socket_seating", "Each end of a rod sits in a bore, deep enough."),
    ("interference", "Bodies share no volume beyond the meant press fits."),
    ("ground_clearance", "What hangs lowest stays off the ground."),
    ("hinge_strain", "Folded hinges are strained by less than their material bears."),
    ("fold_sequence", "There is a way to put the frame together."),
    ("thinnest_wall", "No wall is thinner than the nozzle can print."),
    ("narrowest_gap", "No gap is narrower than a printed line."),
    ("battery_slide", "The battery slides out and meets its stops."),
    ("printer_bed", "Each part fits the printer's bed."),
    ("footing", "Each part stands on its first layer while it is printed."),
    ("layer_direction", "No hinge is strained across its layers."),
    ("overhang", "Nothing leans far out over air as printed."),
    ("island", "No layer has a piece that begins in the air."),
    ("bridge", "Bridges are no longer than their material spans."),
];

/// The log as JSON text.
pub fn log(outcomes: &[Outcome]) -> String {
    let results: Vec<Value> = outcomes
        .iter()
        .flat_map(|outcome| match &outcome.result {
            Ok(held) => of_frame(&outcome.asked, held),
            Err(refused) => vec![of_refusal(&outcome.asked, refused)],
        })
        .collect();
    let rule = |(id, text): &(&str, &str)| json!({ "id": id, "shortDescription": { "text": text } });
    let driver = json!({
        "name": "flexframe",
        "semanticVersion": env!("CARGO_PKG_VERSION"),
        "rules": RULES.iter().map(rule).collect::<Vec<_>>(),
    });
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{ "tool": { "driver": driver }, "columnKind": "unicodeCodePoints", "results": results }],
    });
    format!("{log:#}\n")
}

fn of_frame(asked: &str, held: &Held) -> Vec<Value> {
    held.findings.iter().filter(|judged| judged.standing != Standing::Good).map(|judged| result(asked, held, judged)).collect()
}

fn result(asked: &str, held: &Held, judged: &Judged) -> Value {
    let Judged { finding, standing, spots } = judged;
    let level = match standing {
        Standing::Fails => "error",
        Standing::Accepted => "note",
        Standing::Good | Standing::Warning => "warning",
    };
    let text = format!("{}: {}{}", held.frame, finding.message, why(held, judged));
    let mut result = json!({
        "ruleId": finding.rule,
        "level": level,
        "message": { "text": text },
        "locations": spots.first().map(location).into_iter().collect::<Vec<_>>(),
        "relatedLocations": spots.iter().skip(1).map(location).collect::<Vec<_>>(),
        // The same finding in the next run, whatever its numbers.
        "partialFingerprints": { "frameRuleSubject/v1": format!("{}/{}/{}", held.frame, finding.rule, finding.subject) },
        "properties": { "frame": asked, "value": finding.value, "limit": finding.limit, "margin": finding.margin, "unit": finding.unit },
    });
    number_rule(&mut result);
    if *standing == Standing::Accepted {
        result["suppressions"] = json!([{ "kind": "external", "justification": "in the list of accepted findings" }]);
    }
    result
}

fn of_refusal(asked: &str, refused: &Refused) -> Value {
    let Refused { message, remedy, spot, .. } = refused;
    let mut result = json!({
        "ruleId": "refused",
        "level": "error",
        "message": { "text": format!("{asked}: {message}. {remedy}") },
        "locations": spot.iter().map(location).collect::<Vec<_>>(),
    });
    number_rule(&mut result);
    result
}

fn number_rule(result: &mut Value) {
    if let Some(at) = RULES.iter().position(|(id, _)| result["ruleId"] == *id) {
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
