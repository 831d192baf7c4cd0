//! Which fields of a bought part only some kinds have.

/// Fields that only some kinds of bought part have, and those kinds; every kind has the others.
const KINDS_OF: [(&str, &[&str]); 24] = [
    ("diameter_mm", &["rod", "propeller"]),
    ("stock_length_mm", &["rod"]),
    ("material", &["rod"]),
    ("wall_mm", &["rod"]),
    ("body_diameter_mm", &["motor"]),
    ("height_mm", &["motor"]),
    ("hole_pcd_mm", &["motor"]),
    ("hole_count", &["motor"]),
    ("shaft_hole_diameter_mm", &["motor"]),
    ("shaft_diameter_mm", &["motor"]),
    ("hub_height_mm", &["propeller"]),
    ("hole_diameter_mm", &["motor", "board", "camera", "sensor"]),
    ("hole_pattern_mm", &["board", "camera"]),
    ("hole_pitch_mm", &["sensor"]),
    ("board_thickness_mm", &["board"]),
    ("all_in_one", &["board"]),
    ("digital", &["fpv_camera"]),
    ("cells", &["battery"]),
    ("capacity_mah", &["battery"]),
    ("strap_mm", &["other"]),
    ("thread_mm", &["screw", "other"]),
    ("length_mm", &["screw"]),
    ("head_diameter_mm", &["screw"]),
    ("head_height_mm", &["screw"]),
];

/// The kinds that have a field; `None` where every kind has it.
pub(super) fn kinds_of(field: &str) -> Option<&'static [&'static str]> {
    KINDS_OF.iter().find(|(known, _)| *known == field).map(|(_, kinds)| *kinds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::preset;
    use crate::params::roles::ROLES;

    #[test]
    fn analytic_shipped_parts_state_fields_of_their_kind() {
        let shipped: toml::Table = toml::from_str(preset::BOUGHT).expect("reads");
        for (name, part) in shipped["parts"].as_table().expect("a table") {
            let kind = part["kind"].as_str().expect("a text");
            for field in part.as_table().expect("a table").keys() {
                assert!(kinds_of(field).is_none_or(|kinds| kinds.contains(&kind)), "{name}: a {kind} has {field}");
            }
        }
    }

    #[test]
    fn analytic_fields_of_kinds_are_fields_and_kinds() {
        let schema = schemars::schema_for!(crate::params::catalogue::BoughtPart);
        let fields = schema.get("properties").and_then(serde_json::Value::as_object).expect("fields");
        for (field, kinds) in KINDS_OF {
            assert!(fields.contains_key(field), "{field}");
            assert!(kinds.iter().all(|kind| ROLES.iter().any(|(_, _, known)| known == kind)), "{field}: {kinds:?}");
        }
    }
}
