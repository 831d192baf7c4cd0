//! What became of frames at the gate, as data.

use super::blame::Spot;
use super::outcome::{Judged, Outcome};
use super::policy::Standing;

/// Everything as JSON: each frame's findings with their standing and its masses, or its refusal with remedy and place.
pub fn json(outcomes: &[Outcome]) -> serde_json::Value {
    let finding = |judged: &Judged| {
        let mut value = serde_json::json!(judged.finding);
        value["fails"] = (judged.standing == Standing::Fails).into();
        value["accepted"] = (judged.standing == Standing::Accepted).into();
        let place = |spot: &Spot| serde_json::json!({ "file": spot.file, "line": spot.line, "column": spot.column, "key": spot.key });
        if !judged.advice.is_empty() {
            value["advice"] = judged.advice.as_str().into();
        }
        value["places"] = judged.spots.iter().map(place).collect::<Vec<_>>().into();
        value
    };
    let frame = |outcome: &Outcome| match &outcome.result {
        Ok(held) => serde_json::json!({
            "asked": outcome.asked,
            "frame": held.frame,
            "violations": held.count(Standing::Fails),
            "findings": held.findings.iter().map(finding).collect::<Vec<_>>(),
            "masses": held.masses,
        }),
        Err(refused) => {
            let place =
                refused.spot.as_ref().map(|spot| serde_json::json!({ "file": spot.file, "line": spot.line, "column": spot.column }));
            serde_json::json!({ "asked": outcome.asked, "refused": refused.message, "remedy": refused.remedy, "place": place })
        }
    };
    serde_json::json!({ "schema_version": 2, "frames": outcomes.iter().map(frame).collect::<Vec<_>>() })
}
