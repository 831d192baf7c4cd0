//! Figures of described materials, bought parts, printers and extras: bounds and unit of each.

use super::catalogue::{BoughtPart, Material, Printer};
use super::frame::Extra;
use super::frame_file::{FrameFile, Value};
use super::refusal::{Reason, Refusal};

/// One number of an entry, or each number of a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// Key in the entry.
    pub key: &'static str,
    /// Lowest value allowed.
    pub min: f64,
    /// Highest value allowed.
    pub max: f64,
    /// Unit; empty for a plain number.
    pub unit: &'static str,
}

const fn figure(key: &'static str, [min, max]: [f64; 2], unit: &'static str) -> Figure {
    Figure { key, min, max, unit }
}

impl Material {
    /// Its figures.
    pub const FIGURES: [Figure; 21] = [
        figure("density_g_cm3", [0.05, 25.0], "g/cm³"),
        figure("print_factor", [0.05, 3.0], ""),
        figure("colour", [0.0, 1.0], ""),
        figure("elongation_at_break_percent", [0.1, 2000.0], "%"),
        figure("elongation_across_layers_percent", [0.1, 2000.0], "%"),
        figure("tensile_modulus_mpa", [0.1, 1e6], "MPa"),
        figure("tensile_strength_mpa", [0.1, 1e4], "MPa"),
        figure("most_flow_mm3_s", [0.1, 200.0], "mm³/s"),
        figure("layer_mm", [0.04, 1.0], "mm"),
        figure("perimeters", [1.0, 50.0], ""),
        figure("speed_mm_s", [1.0, 1000.0], "mm/s"),
        figure("nozzle_c", [20.0, 600.0], "°C"),
        figure("least_nozzle_c", [20.0, 600.0], "°C"),
        figure("bed_c", [0.0, 300.0], "°C"),
        figure("softens_c", [20.0, 600.0], "°C"),
        figure("fan_percent", [0.0, 100.0], "%"),
        figure("brim_mm", [0.0, 20.0], "mm"),
        figure("overhang_deg", [1.0, 89.0], "°"),
        figure("ledge_mm", [0.05, 50.0], "mm"),
        figure("bridge_mm", [0.05, 200.0], "mm"),
        figure("price_per_kg", [0.0, 1e5], ""),
    ];
}

impl BoughtPart {
    /// Its figures.
    pub const FIGURES: [Figure; 25] = [
        figure("size_mm", [0.1, 2000.0], "mm"),
        figure("mass_g", [0.0, 5000.0], "g"),
        figure("diameter_mm", [0.1, 500.0], "mm"),
        figure("stock_length_mm", [10.0, 1e4], "mm"),
        figure("wall_mm", [0.1, 20.0], "mm"),
        figure("shaft_diameter_mm", [0.3, 20.0], "mm"),
        figure("board_thickness_mm", [0.1, 10.0], "mm"),
        figure("strap_mm", [0.3, 20.0], "mm"),
        figure("body_diameter_mm", [1.0, 200.0], "mm"),
        figure("height_mm", [0.1, 200.0], "mm"),
        figure("hub_height_mm", [0.1, 50.0], "mm"),
        figure("hole_pcd_mm", [0.5, 200.0], "mm"),
        figure("hole_count", [1.0, 16.0], ""),
        figure("hole_diameter_mm", [0.1, 50.0], "mm"),
        figure("shaft_hole_diameter_mm", [0.0, 50.0], "mm"),
        figure("hole_pattern_mm", [0.5, 500.0], "mm"),
        figure("hole_pitch_mm", [0.5, 500.0], "mm"),
        figure("cells", [1.0, 16.0], ""),
        figure("capacity_mah", [1.0, 1e5], "mAh"),
        figure("thread_mm", [0.5, 20.0], "mm"),
        figure("length_mm", [0.5, 200.0], "mm"),
        figure("head_diameter_mm", [0.5, 50.0], "mm"),
        figure("head_height_mm", [0.1, 50.0], "mm"),
        figure("price", [0.0, 1e5], ""),
        figure("price_most", [0.0, 1e5], ""),
    ];
}

impl Printer {
    /// Its figures. A hole that is off by more than a millimetre is no matter of compensation.
    pub const FIGURES: [Figure; 13] = [
        figure("size_mm", [20.0, 2000.0], "mm"),
        figure("height_mm", [10.0, 2000.0], "mm"),
        figure("kept_clear_mm", [-1000.0, 2000.0], "mm"),
        figure("nozzle_mm", [0.1, 2.0], "mm"),
        figure("filament_mm", [1.0, 4.0], "mm"),
        figure("min_wall_nozzles", [0.5, 10.0], ""),
        figure("hole_undersize_mm", [0.0, 1.0], "mm"),
        figure("elephant_foot_mm", [0.0, 1.0], "mm"),
        figure("least_contact_mm2", [0.01, 1e4], "mm²"),
        figure("least_tip_deg", [0.1, 90.0], "°"),
        figure("most_slender", [0.1, 100.0], ""),
        figure("most_nozzle_c", [20.0, 600.0], "°C"),
        figure("most_bed_c", [0.0, 300.0], "°C"),
    ];
}

impl Extra {
    /// Its figures.
    pub const FIGURES: [Figure; 2] = [figure("mass_g", [0.0, 5000.0], "g"), figure("position_mm", [-500.0, 500.0], "mm")];
}

/// Figures that are counts.
const WHOLE: [&str; 3] = ["perimeters", "hole_count", "cells"];

/// Refuses a typed figure that is out of its bounds, or a count with a fraction; what is no number is left to the reader of the entry.
pub(super) fn within_bounds(figures: &[Figure], field: &str, file: &FrameFile, key: &str, value: &Value) -> Result<(), Refusal> {
    let Some(figure) = figures.iter().find(|figure| figure.key == field) else { return Ok(()) };
    let numbers: Vec<f64> = match value {
        Value::Number(number) => vec![*number],
        Value::Other(other) => numbers(other),
        _ => Vec::new(),
    };
    let Figure { min, max, unit, .. } = *figure;
    if let Some(value) = numbers.iter().copied().find(|value| !(min..=max).contains(value)) {
        return Err(file.refuse(key, Reason::OutOfBounds { key: key.into(), value, min, max, unit: unit.into() }));
    }
    if let Some(part) = numbers.iter().find(|value| WHOLE.contains(&field) && value.fract() != 0.0) {
        let message = format!("`{key}` = {part} is no whole number");
        return Err(file.refuse(key, Reason::Impossible { message, remedy: "give a whole number".into() }));
    }
    Ok(())
}

/// The numbers of a list, and of the lists in it.
fn numbers(value: &toml::Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().flat_map(|one| number(one).map_or_else(|| numbers(one), |number| vec![number])).collect()
}

fn number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Frame, preset};

    /// Tables of `[override]`, the form of an entry as the schema states it, and its figures.
    fn kinds() -> [(&'static str, schemars::Schema, &'static [Figure]); 4] {
        [
            ("override.materials.own", schemars::schema_for!(Material), &Material::FIGURES),
            ("override.parts.own", schemars::schema_for!(BoughtPart), &BoughtPart::FIGURES),
            ("override.printers.own", schemars::schema_for!(Printer), &Printer::FIGURES),
            ("extras.own", schemars::schema_for!(Extra), &Extra::FIGURES),
        ]
    }

    fn is_number(schema: &serde_json::Value) -> bool {
        let kind = schema["type"].to_string();
        kind.contains("number") || kind.contains("integer") || (kind.contains("array") && is_number(&schema["items"]))
    }

    #[test]
    fn analytic_every_number_of_an_entry_has_bounds() {
        for (table, schema, figures) in kinds() {
            let value = schema.to_value();
            let numbers: Vec<&String> =
                value["properties"].as_object().expect("has some").iter().filter(|(_, s)| is_number(s)).map(|(key, _)| key).collect();
            for key in &numbers {
                assert!(figures.iter().any(|figure| figure.key == **key), "{table}.{key} has no bounds");
            }
            assert_eq!(numbers.len(), figures.len(), "{table}: a figure of a key that is not there");
        }
    }

    #[test]
    fn analytic_shipped_entries_are_within_bounds() {
        let table = |text: &str| toml::from_str::<toml::Table>(text).expect("reads");
        let mut entries: Vec<(String, toml::Value, &[Figure])> = Vec::new();
        for (text, inner, figures) in
            [(preset::BOUGHT, "parts", &BoughtPart::FIGURES[..]), (preset::MATERIALS, "materials", &Material::FIGURES)]
        {
            let all = table(text)[inner].as_table().expect("a table").clone();
            entries.extend(all.into_iter().map(|(name, entry)| (name, entry, figures)));
        }
        let printers =
            preset::PRINTERS.iter().map(|(name, text)| (name.to_string(), toml::Value::Table(table(text)), &Printer::FIGURES[..]));
        entries.extend(printers);
        for (name, entry, figures) in entries {
            for figure in figures {
                let numbers: Vec<f64> = match entry.get(figure.key) {
                    Some(list @ toml::Value::Array(_)) => numbers(list),
                    value => value.and_then(number).into_iter().collect(),
                };
                assert!(numbers.iter().all(|value| (figure.min..=figure.max).contains(value)), "{name}: {}", figure.key);
            }
        }
    }

    #[test]
    fn planted_any_number_is_refused_or_within_bounds() {
        let extremes =
            [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, -5e-324, f64::MIN_POSITIVE, 1e308, -1e308, f64::MAX, -1.0, -0.0];
        for (table, _, figures) in kinds() {
            for figure in figures {
                let steps = [figure.min, figure.max].map(|limit| [limit.next_down(), limit, limit.next_up()]);
                for value in extremes.iter().chain(steps.iter().flatten()) {
                    let place = table.replace("own", "cognifly");
                    let list = format!("[{value:?}]").replace("NaN", "nan");
                    for value_text in [list.trim_matches(['[', ']']), &list] {
                        // The entry's name is that of the frame, so that it is looked at though nothing refers to it.
                        let text = format!("base = \"cognifly\"\nname = \"cognifly\"\n[{place}]\n{} = {value_text}\n", figure.key);
                        let file = FrameFile::parse("own.toml", &text).expect("reads");
                        let refused = Frame::resolve(&file).err();
                        let bounds = refused.as_ref().map(|refusal| (*refusal.reason).clone());
                        if (figure.min..=figure.max).contains(value) {
                            assert!(
                                !matches!(bounds, Some(Reason::OutOfBounds { .. })),
                                "{place}.{} = {value_text}: {refused:?}",
                                figure.key
                            );
                        } else {
                            let expected =
                                matches!(&bounds, Some(Reason::OutOfBounds { min, max, .. }) if [*min, *max] == [figure.min, figure.max]);
                            assert!(expected, "{place}.{} = {value_text}: {refused:?}", figure.key);
                        }
                    }
                }
            }
        }
    }
}
