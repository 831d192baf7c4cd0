//! What a frame file may say and choose, and what is checked: the library's catalogues as data.

use flexframe::checks::CATALOGUE;
use flexframe::params::bought_relation::is_optional;
use flexframe::params::carried::is_carried;
use flexframe::params::catalogue::{BoughtPart, Material};
use flexframe::params::parameter::Parameter;
use flexframe::params::roles::ROLES;
use flexframe::params::sleeve_direction::SleeveDirection;
use flexframe::params::{follows, parameters, preset};
use serde_json::{Value, json};

/// Numbers with unit, bounds, meaning and what they drive; choices with what there is; rules with what they require.
pub fn catalogue() -> Value {
    let rules: Vec<Value> =
        CATALOGUE.iter().map(|rule| json!({ "id": rule.id, "title": rule.title, "sentence": rule.sentence() })).collect();
    json!({ "parameters": parameters().map(parameter).collect::<Vec<_>>(), "choices": choices(), "rules": rules })
}

fn parameter(p: &Parameter) -> Value {
    json!({
        "key": format!("{}.{}", p.table, p.key),
        "table": p.table,
        "about": p.table_doc.trim(),
        "name": p.key,
        "unit": p.unit(),
        "min": p.min,
        "max": p.max,
        "doc": p.doc.trim(),
        "drives": p.drives.iter().map(|part| part.slug()).collect::<Vec<_>>(),
        "follows": follows::followed(p.key),
    })
}

fn choices() -> Vec<Value> {
    let (parts, materials) = (preset::bought_parts(), preset::materials());
    let part = |(name, part): (&String, &BoughtPart)| json!({ "name": name, "size_mm": part.size_mm, "mass_g": part.mass_g, "source": part.source });
    let material = |(name, material): (&String, &Material)| json!({ "name": name, "density_g_cm3": material.density_g_cm3, "source": material.source });
    let printed: Vec<Value> = materials.iter().filter(|(_, material)| material.kind == "printed").map(material).collect();
    let mut choices: Vec<Value> = ["materials.flexible", "materials.rigid"].map(|key| json!({ "key": key, "of": printed })).into();
    let printers: Vec<Value> = preset::printers()
        .iter()
        .map(|(name, printer)| json!({ "name": name, "title": printer.name, "size_mm": [printer.size_mm[0], printer.size_mm[1], printer.height_mm] }))
        .collect();
    choices.push(json!({ "key": "printer", "of": printers }));
    let directions = SleeveDirection::WORDS.map(|word| json!({ "name": word }));
    choices.push(json!({ "key": SleeveDirection::KEY, "of": directions }));
    for (role, quantity, kind) in ROLES {
        let of: Vec<Value> = parts.iter().filter(|(_, part)| part.kind == kind && is_carried(role, part)).map(part).collect();
        choices
            .push(json!({ "key": format!("bought.{role}"), "quantity": quantity, "kind": kind, "optional": is_optional(role), "of": of }));
    }
    choices
}
