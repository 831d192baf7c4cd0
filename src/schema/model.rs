//! Schemas of impact models and of plans of synthetic drops.

use serde_json::{Map, Value, json};

use super::element::{closed, number, put, table};
use crate::impact::effects::{CATALOGUE, CHANNEL, CURVE, PLAIN_NUMBERS, POINTS, REACH_MM, channel_words};
use crate::impact::synthetic::{HEIGHT_BOUNDS_M, HEIGHTS, Hidden, KIND, LAW, PLAN_NUMBERS, PlanNumber, ScatterLaw};

pub(super) fn schema() -> Value {
    closed(keys(), &["mass_kg", "gap_mm", "sensor", "effects"])
}

pub(super) fn plan() -> Value {
    let mut root = keys();
    for PlanNumber { key, bounds, unit, default } in PLAN_NUMBERS {
        put(&mut root, key, number("", unit, bounds, default));
    }
    put(&mut root, LAW, json!({ "enum": ScatterLaw::NAMES, "description": "Size of the noise of the readings." }));
    put(&mut root, KIND, json!({ "enum": Hidden::NAMES, "description": "Effect outside the catalogue." }));
    let heights =
        json!({ "type": "array", "minItems": 1, "items": number("", "m", HEIGHT_BOUNDS_M, None), "description": "Heights of the drops." });
    put(&mut root, HEIGHTS, heights);
    closed(root, &["mass_kg", "gap_mm", "sensor", "effects", "drops"])
}

fn keys() -> Map<String, Value> {
    let mut root = Map::new();
    root.insert("description".into(), json!({ "type": "string", "description": "One line about the model." }));
    for (key, bounds, unit, doc) in PLAIN_NUMBERS {
        put(&mut root, key, number(doc, unit, bounds, None));
    }
    put(&mut root, CHANNEL, json!({ "enum": channel_words(), "description": "What of the acceleration the sensor reads." }));
    let mut effects = Map::new();
    for spec in CATALOGUE {
        let mut own = Map::new();
        for p in spec.parameters {
            own.insert(p.key.into(), number(p.doc, p.unit, [p.min, p.max], p.default));
        }
        if let Some(choice) = spec.choice {
            own.insert(choice.key.into(), json!({ "enum": choice.words }));
        }
        if spec.takes_frame_curve() {
            for (key, bounds) in CURVE.into_iter().zip([REACH_MM, [-REACH_MM[1], REACH_MM[1]]]) {
                let name = key.rsplit('.').next().unwrap_or(key);
                let of = json!({ "type": "array", "minItems": POINTS[0], "maxItems": POINTS[1], "items": number("", "mm", bounds, None) });
                own.insert(name.into(), of);
            }
        }
        effects.insert(spec.id.into(), table(spec.title, own));
    }
    root.insert("effects".into(), table("What acts, one table an effect.", effects));
    root
}
