//! What two frames differ in, as data.

use serde_json::{Value, json};

use crate::variant::{Difference, MECHANICS_CAVEAT, PEAK_CAVEAT};

/// Everything as JSON, with how far its predictions can be trusted.
pub fn json(difference: &Difference) -> Value {
    let mut value = json!(difference);
    value["schema_version"] = 1.into();
    value["peak"] = PEAK_CAVEAT.into();
    if difference.measures.iter().any(|change| change.name == "stiffness") {
        value["mechanics"] = MECHANICS_CAVEAT.into();
    }
    value
}
