//! What a frame file chooses by name: materials, bought parts and the printer, from the catalogues and its own entries.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use super::carried::is_carried;
use super::catalogue::{Bed, BoughtPart, Material, Printer};
use super::figure::within_bounds;
use super::frame::{BoughtItem, NamedMaterial};
use super::frame_file::{FrameFile, Value};
use super::hung_boards::spacers_needed;
use super::kind_fields::kinds_of;
use super::preset;
use super::read::{bad_entry, in_one_line, stated_text, text, to_blame};
use super::refusal::{Reason, Refusal, nearest};
use super::roles::{ACCESSORIES, BRACKET_TIES, NEEDED, ROLES};

/// The catalogues, by their tables within `override`.
pub(super) const CATALOGUES: [&str; 3] = ["parts", "materials", "printers"];

/// Kinds of materials, and what a message calls them.
const MATERIAL_KINDS: [(&str, &str); 2] = [("printed", "a material that is printed"), ("rod", "a material of rods")];

/// The fields that entries may have, made once: a search reads a frame many times.
static PART_FIELDS: LazyLock<Vec<String>> = LazyLock::new(fields::<BoughtPart>);
static MATERIAL_FIELDS: LazyLock<Vec<String>> = LazyLock::new(fields::<Material>);
static PRINTER_FIELDS: LazyLock<Vec<String>> = LazyLock::new(fields::<Printer>);

/// The shipped catalogues, read once: that takes longer than all else of reading a frame.
static SHIPPED: LazyLock<Catalogues> = LazyLock::new(Catalogues::shipped);

/// The catalogues with the frame file's own entries on top.
#[derive(Clone)]
pub(super) struct Catalogues {
    parts: toml::Table,
    materials: toml::Table,
    printers: toml::Table,
}

impl Catalogues {
    fn shipped() -> Self {
        let shipped = |text: &str| -> toml::Table { toml::from_str(text).unwrap_or_default() };
        let within = |text: &str, table: &str| shipped(text).get(table).and_then(|t| t.as_table()).cloned().unwrap_or_default();
        let printers = preset::PRINTERS.iter().map(|(name, text)| (name.to_string(), toml::Value::Table(shipped(text)))).collect();
        Self { parts: within(preset::BOUGHT, "parts"), materials: within(preset::MATERIALS, "materials"), printers }
    }

    /// The shipped catalogues under the file's overrides.
    ///
    /// # Errors
    /// When an override is none of its kind, or says what cannot be.
    pub fn read(file: &FrameFile) -> Result<Self, Refusal> {
        let texts: BTreeSet<&str> = file.entries.values().filter_map(|entry| entry.value.text()).collect();
        let mut all = SHIPPED.clone();
        for (key, entry) in file.entries.iter().filter(|(key, _)| key.starts_with("override.")) {
            // A name may have dots in it, as in [override.printers."generic-0.4"]; a table's and a field's have none.
            let table = key.split('.').nth(1).unwrap_or_default();
            if matches!(&entry.value, Value::Other(toml::Value::Table(_))) {
                continue;
            }
            let place = key.strip_prefix(&format!("override.{table}.")).and_then(|rest| rest.rsplit_once('.'));
            let (catalogue, figures, fields, name, field) = match (table, place) {
                ("parts", Some((name, field))) => (&mut all.parts, &BoughtPart::FIGURES[..], &PART_FIELDS, name, field),
                ("materials", Some((name, field))) => (&mut all.materials, &Material::FIGURES[..], &MATERIAL_FIELDS, name, field),
                ("printers", Some((name, field))) => (&mut all.printers, &Printer::FIGURES[..], &PRINTER_FIELDS, name, field),
                _ => return Err(file.refuse(key, Reason::UnknownKey { key: key.clone(), nearest: in_a_catalogue(key) })),
            };
            // A new entry is named by the frame, or says what it is: a base's own battery may be replaced by its variants.
            let named = texts.contains(name);
            let whole = file.entries.contains_key(&format!("override.{table}.{name}.kind"));
            if !catalogue.contains_key(name) && !named && !whole {
                let nearest = nearest(name, catalogue.keys().map(String::as_str));
                return Err(file.refuse(key, Reason::UnknownName { kind: format!("entry of {table}"), name: name.into(), nearest }));
            }
            let kind = if table == "parts" { "bought part" } else { table.trim_end_matches('s') };
            in_one_line(file, key, kind, name)?;
            if !fields.iter().any(|known| known == field) {
                let near = nearest(field, fields.iter().map(String::as_str));
                let nearest = near.iter().map(|field| format!("override.{table}.{name}.{field}")).collect();
                return Err(file.refuse(key, Reason::UnknownKey { key: key.clone(), nearest }));
            }
            within_bounds(figures, field, file, key, &entry.value)?;
            if table == "parts" && field == "kind" {
                known_kind(file, key, &entry.value)?;
            }
            let own = catalogue.entry(name).or_insert_with(|| toml::Value::Table(toml::Table::new()));
            if let Some(own) = own.as_table_mut() {
                own.insert(field.into(), entry.value.to_toml());
            }
        }
        all.parts_have_fields_of_their_kind(file)?;
        Ok(all)
    }

    /// Refuses a field that no part of that kind has: it would change nothing.
    fn parts_have_fields_of_their_kind(&self, file: &FrameFile) -> Result<(), Refusal> {
        for key in file.entries.keys() {
            let Some((name, field)) = key.strip_prefix("override.parts.").and_then(|rest| rest.rsplit_once('.')) else { continue };
            let kind = self.parts.get(name).and_then(|part| part.get("kind")).and_then(toml::Value::as_str);
            if let (Some(kinds), Some(kind)) = (kinds_of(field), kind)
                && !kinds.contains(&kind)
            {
                let message = format!("`{key}`: a part of the kind \"{kind}\" has no `{field}`, only {} has", of_kinds(kinds));
                let remedy = format!("leave `{field}` out, or correct the part's `kind`; `flexframe schema bought` explains the keys");
                return Err(file.refuse(key, Reason::Impossible { message, remedy }));
            }
        }
        Ok(())
    }

    /// The bought parts that a frame file names, by role.
    ///
    /// # Errors
    /// When the file names a part that there is not, or one of another kind.
    pub fn bought(&self, file: &FrameFile) -> Result<BTreeMap<String, BoughtItem>, Refusal> {
        let mut items = BTreeMap::new();
        for (role, quantity, kind) in ROLES {
            let key = format!("bought.{role}");
            let Some(name) = text(file, &key)?.filter(|name| name != "none") else { continue };
            let part: BoughtPart = entry(&self.parts, file, &key, "bought part", "parts", &name)?;
            if part.kind != kind {
                let (found, expected, fits) = (format!("a {}", part.kind), format!("a {kind}"), self.parts_for(role, kind));
                return Err(file.refuse(&key, Reason::WrongKind { key: key.clone(), name, found, expected, fits }));
            }
            if !part.is_priced_whole() {
                return Err(bad_override(file, &key, "bought part", "parts", &name, "its price lacks currency or price_source"));
            }
            if let Some((field, message)) = part.contradiction() {
                let stated = format!("override.parts.{name}.{field}");
                let at = if file.entries.contains_key(&stated) { stated.as_str() } else { &key };
                return Err(bad_override(file, at, "bought part", "parts", &name, &message));
            }
            items.insert(role.into(), BoughtItem { name, quantity, part });
        }
        for (role, _, kind) in ROLES {
            let key = format!("bought.{role}");
            if !NEEDED.contains(&role) || items.contains_key(role) {
                continue;
            }
            let reason = match file.entries.get(&key) {
                None => Reason::Missing { key: key.clone() },
                Some(_) => Reason::Impossible {
                    message: format!("`{key}` = \"none\": a frame cannot be without a {role}"),
                    remedy: format!("name one: {}", listed(&self.parts_for(role, kind))),
                },
            };
            return Err(file.refuse(&key, reason));
        }
        let is_laid_on_hub = items.contains_key("computer") || ACCESSORIES.iter().any(|role| items.contains_key(*role));
        let screws = items.get("motor").map(|motor: &BoughtItem| motor.quantity * motor.part.motor_holes());
        if let (Some(item), Some(screws)) = (items.get_mut("motor_screw"), screws) {
            item.quantity = screws;
        }
        if let (Some(item), false) = (items.get_mut("tie"), is_laid_on_hub) {
            item.quantity = BRACKET_TIES;
        }
        let spacers = spacers_needed(|role| items.get(role).map(|item: &BoughtItem| &item.part));
        match items.get_mut("stack_spacer") {
            Some(item) if spacers > 0 => item.quantity = spacers,
            // Nothing hangs on the screws.
            _ => drop(items.remove("stack_spacer")),
        }
        Ok(items)
    }

    /// The names of the bought parts of a kind that a frame can carry in a role.
    fn parts_for(&self, role: &str, kind: &str) -> Vec<String> {
        let is_carried = |entry: &toml::Table| {
            let part: Option<BoughtPart> = toml::Value::Table(entry.clone()).try_into().ok();
            part.is_none_or(|part| is_carried(role, &part))
        };
        fitting(&self.parts, |entry| is(entry, kind) && is_carried(entry))
    }

    /// The material of the joints; it has to say how far it stretches, or their hinges could not be checked.
    ///
    /// # Errors
    /// When there is no such material, or its elongation at break is not stated.
    pub fn flexible(&self, file: &FrameFile) -> Result<NamedMaterial, Refusal> {
        let key = "materials.flexible";
        let named = self.material(file, key, stated_text(file, key)?, "printed")?;
        if named.material.elongation_at_break_percent.is_some() {
            return Ok(named);
        }
        let name = &named.name;
        let fits = fitting(&self.materials, |m| is(m, "printed") && m.contains_key("elongation_at_break_percent"));
        let message = format!("`{key}` = \"{name}\" does not say its elongation_at_break_percent: the hinges could not be checked");
        let remedy = format!("state elongation_at_break_percent in [override.materials.{name}], or choose one of {}", listed(&fits));
        Err(file.refuse(key, Reason::Impossible { message, remedy }))
    }

    /// The material of the rigid centre.
    ///
    /// # Errors
    /// When there is no such material.
    pub fn rigid(&self, file: &FrameFile) -> Result<NamedMaterial, Refusal> {
        let key = "materials.rigid";
        self.material(file, key, stated_text(file, key)?, "printed")
    }

    /// The material of the rods, which the bought rod names.
    ///
    /// # Errors
    /// When the rod names none, or one that there is not.
    pub fn rod_material(&self, file: &FrameFile, bought: &BTreeMap<String, BoughtItem>) -> Result<NamedMaterial, Refusal> {
        let rod = bought.get("rod").map_or("", |item| item.name.as_str());
        let own = format!("override.parts.{rod}.material");
        let key = if file.entries.contains_key(&own) { own.as_str() } else { "bought.rod" };
        match bought.get("rod").and_then(|item| item.part.material.clone()) {
            Some(name) => self.material(file, key, name, "rod"),
            None => Err(bad_override(file, key, "bought part", "parts", rod, "missing field `material`")),
        }
    }

    /// A material of a kind; `key` is where it was named.
    fn material(&self, file: &FrameFile, key: &str, name: String, kind: &str) -> Result<NamedMaterial, Refusal> {
        let material: Material = entry(&self.materials, file, key, "material", "materials", &name)?;
        if !MATERIAL_KINDS.iter().any(|(known, _)| *known == material.kind) {
            let message = format!("`kind` is \"{}\", it is \"printed\" or \"rod\"", material.kind);
            return Err(bad_override(file, key, "material", "materials", &name, &message));
        }
        if material.kind != kind {
            let words = |kind: &str| MATERIAL_KINDS.iter().find(|(known, _)| *known == kind).map_or("", |(_, words)| words).to_string();
            let (found, expected, fits) = (words(&material.kind), words(kind), fitting(&self.materials, |m| is(m, kind)));
            return Err(file.refuse(key, Reason::WrongKind { key: key.into(), name, found, expected, fits }));
        }
        if let (Some(least), Some(usual)) = (material.least_nozzle_c, material.nozzle_c)
            && usual < least
        {
            let message = format!("`nozzle_c` = {usual} is less than `least_nozzle_c` = {least}, the least heat at which it prints, °C");
            return Err(bad_override(file, key, "material", "materials", &name, &message));
        }
        if !material.is_priced_whole() {
            return Err(bad_override(file, key, "material", "materials", &name, "its price lacks price_per_kg, currency or price_source"));
        }
        Ok(NamedMaterial { name, material })
    }

    /// The printer that a frame file names.
    ///
    /// # Errors
    /// When there is no such printer.
    pub fn printer(&self, file: &FrameFile) -> Result<Printer, Refusal> {
        let name = stated_text(file, "printer")?;
        let printer: Printer = entry(&self.printers, file, "printer", "printer", "printers", &name)?;
        let [x, y] = printer.size_mm;
        if printer.bed == Bed::Round && x != y {
            let message = format!("`size_mm` = [{x}, {y}]: a round bed has one diameter, which is stated twice, mm");
            return Err(bad_override(file, "printer", "printer", "printers", &name, &message));
        }
        Ok(printer)
    }
}

/// Refuses a kind of bought part that no role takes.
fn known_kind(file: &FrameFile, key: &str, value: &Value) -> Result<(), Refusal> {
    let kinds: BTreeSet<&str> = ROLES.iter().map(|(_, _, kind)| *kind).collect();
    let Some(kind) = value.text().filter(|kind| !kinds.contains(kind)) else { return Ok(()) };
    let near = nearest(kind, kinds.iter().copied());
    let meant = near.first().map_or(String::new(), |near| format!("did you mean \"{near}\"? "));
    let known: Vec<&str> = kinds.into_iter().collect();
    let message = format!("`{key}` is \"{kind}\", no kind of bought part");
    Err(file.refuse(key, Reason::Impossible { message, remedy: format!("{meant}the kinds are {}", known.join(", ")) }))
}

/// Kinds in a sentence.
fn of_kinds(kinds: &[&str]) -> String {
    kinds.iter().map(|kind| format!("a \"{kind}\"")).collect::<Vec<_>>().join(" or ")
}

/// Whether an entry is of a kind.
fn is(entry: &toml::Table, kind: &str) -> bool {
    entry.get("kind").and_then(toml::Value::as_str) == Some(kind)
}

/// The names of a catalogue's entries that fit.
fn fitting(catalogue: &toml::Table, fits: impl Fn(&toml::Table) -> bool) -> Vec<String> {
    catalogue.iter().filter(|(_, entry)| entry.as_table().is_some_and(&fits)).map(|(name, _)| name.clone()).collect()
}

/// Names in a sentence.
fn listed(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// A named entry of a catalogue; `key` names it in the frame file.
fn entry<T: serde::de::DeserializeOwned + schemars::JsonSchema>(
    catalogue: &toml::Table,
    file: &FrameFile,
    key: &str,
    kind: &str,
    table: &str,
    name: &str,
) -> Result<T, Refusal> {
    let Some(entry) = catalogue.get(name) else {
        let nearest = nearest(name, catalogue.keys().map(String::as_str));
        return Err(file.refuse(key, Reason::UnknownName { kind: kind.into(), name: name.into(), nearest }));
    };
    entry.clone().try_into().map_err(|e: toml::de::Error| {
        let missing = missing::<T>(entry);
        let message = if missing.len() > 1 { format!("it lacks {}", listed(&missing)) } else { e.message().to_string() };
        let at = to_blame::<T>(entry, file, &format!("override.{table}.{name}."));
        bad_override(file, at.as_deref().unwrap_or(key), kind, table, name, &message)
    })
}

/// The fields that an entry may have.
pub(super) fn fields<T: schemars::JsonSchema>() -> Vec<String> {
    let schema = schemars::schema_for!(T);
    schema.get("properties").and_then(serde_json::Value::as_object).into_iter().flat_map(serde_json::Map::keys).cloned().collect()
}

/// What an entry lacks of the fields that each entry has.
fn missing<T: schemars::JsonSchema>(entry: &toml::Value) -> Vec<String> {
    let schema = schemars::schema_for!(T);
    let needed = schema.get("required").and_then(serde_json::Value::as_array).into_iter().flatten().filter_map(serde_json::Value::as_str);
    needed.filter(|field| entry.get(field).is_none()).map(String::from).collect()
}

/// A catalogue's entry that does not read: what the frame file changed in it is to blame, unless `key` is one of its fields.
fn bad_override(file: &FrameFile, key: &str, kind: &str, table: &str, name: &str, message: &str) -> Refusal {
    let own = format!("override.{table}.{name}.");
    if key.starts_with(&own) {
        return bad_entry(file, key, kind, name, message);
    }
    let changed: Vec<&String> = file.entries.keys().filter(|key| key.starts_with(&own)).collect();
    let named = changed.iter().find(|key| key.strip_prefix(&own).is_some_and(|field| message.contains(&format!("`{field}`"))));
    let at = named.or(changed.first()).map_or(key, |key| key.as_str());
    bad_entry(file, at, kind, name, message)
}

/// What a key of `override` was probably meant to be that names no catalogue: the same field in each that has it.
fn in_a_catalogue(key: &str) -> Vec<String> {
    let typed = key.strip_prefix("override.").unwrap_or(key);
    let (within, field) = typed.rsplit_once('.').unwrap_or(("NAME", typed));
    // A table that is none stands before a name, which may have dots in it.
    let name = within.split_once('.').map_or(within, |(_, name)| name);
    let fields = [&PART_FIELDS, &MATERIAL_FIELDS, &PRINTER_FIELDS];
    let has = CATALOGUES.iter().zip(fields).filter(|(_, fields)| fields.iter().any(|known| known == field));
    let meant: Vec<String> = has.map(|(table, _)| format!("override.{table}.{name}.{field}")).collect();
    if meant.is_empty() { CATALOGUES.map(|table| format!("override.{table}.{name}")).into() } else { meant }
}
