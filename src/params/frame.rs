//! The frame as meant: every number present and within its bounds, every name resolved.

use std::collections::BTreeMap;

use super::catalogue::{BoughtPart, Material, Printer};
use super::follows;
use super::frame_file::{FrameFile, LoadError, Value};
use super::groups::*;
use super::parameter::Parameter;
use super::preset;
use super::refusal::{Reason, Refusal, nearest};

/// A frame, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Its name: that of its folder in `out/`.
    pub name: String,
    /// One line about it.
    pub description: String,
    /// Rods.
    pub rods: RodParameters,
    /// Clearances.
    pub fit: FitParameters,
    /// Ring corners.
    pub corner: CornerParameters,
    /// Hub joints.
    pub hub_joint: HubJointParameters,
    /// Forks.
    pub fork: ForkParameters,
    /// Knees.
    pub knee: KneeParameters,
    /// Motor mounts and propellers.
    pub motor_mount: MotorMountParameters,
    /// Hub plate.
    pub hub: HubParameters,
    /// Computer carrier.
    pub pi_carrier: CarrierParameters,
    /// Battery size and mass.
    pub battery: BatteryParameters,
    /// Battery sleeve.
    pub sleeve: SleeveParameters,
    /// Battery bracket.
    pub bracket: BracketParameters,
    /// Battery lid.
    pub lid: LidParameters,
    /// Camera connectors.
    pub camera: CameraParameters,
    /// Limits.
    pub limits: LimitParameters,
    /// Size to solve the rod lengths for, when the file gives one instead of lengths.
    pub target: Option<TargetSize>,
    /// Material of the joints.
    pub flexible: NamedMaterial,
    /// Material of the rigid centre.
    pub rigid: NamedMaterial,
    /// Material of the rods.
    pub rod_material: NamedMaterial,
    /// The printer.
    pub printer: Printer,
    /// What is bought, by role.
    pub bought: BTreeMap<String, BoughtItem>,
    /// Masses that belong to no part in the catalogue.
    pub extras: BTreeMap<String, Extra>,
}

/// A wanted size; the rod lengths follow from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetSize {
    /// Width and depth, mm.
    pub width_mm: f64,
    /// Height, mm.
    pub height_mm: f64,
    /// Tilt of the struts, degrees.
    pub strut_tilt_deg: f64,
}

/// A material and its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// Name in the catalogue.
    pub name: String,
    /// What it is.
    pub material: Material,
}

/// A bought part in its role.
#[derive(Clone, Debug, PartialEq)]
pub struct BoughtItem {
    /// Name in the catalogue.
    pub name: String,
    /// How many the frame needs.
    pub quantity: u32,
    /// What it is.
    pub part: BoughtPart,
}

/// A mass that is no part of the catalogue.
#[derive(Clone, Debug, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Extra {
    /// Mass, g.
    pub mass_g: f64,
    /// How it is known.
    pub mass_basis: super::catalogue::MassBasis,
    /// Where it comes from.
    pub source: String,
    /// Where it sits, mm; at the hub when left out.
    #[serde(default)]
    pub position_mm: [f64; 3],
    /// Roles of bought parts whose masses are inside this figure and are not counted again.
    #[serde(default)]
    pub covers: Vec<String>,
}

/// Roles of bought parts, how many of each, and the kind that fits.
pub const ROLES: [(&str, u32, &str); 15] = [
    ("motor", 4, "motor"),
    ("propeller", 4, "propeller"),
    ("battery", 1, "battery"),
    ("rod", 1, "rod"),
    ("computer", 1, "board"),
    ("flight_controller", 1, "board"),
    ("motor_controller", 1, "board"),
    ("camera", 1, "camera"),
    ("flow_sensor", 1, "sensor"),
    ("connector", 1, "connector"),
    ("magnet", 2, "magnet"),
    ("motor_screw", 16, "screw"),
    ("stack_screw", 4, "screw"),
    ("tie", 4, "other"),
    ("damper", 4, "other"),
];

/// All groups' parameters, table by table.
pub fn catalogue() -> impl Iterator<Item = &'static Parameter> {
    [
        RodParameters::CATALOGUE,
        FitParameters::CATALOGUE,
        CornerParameters::CATALOGUE,
        HubJointParameters::CATALOGUE,
        ForkParameters::CATALOGUE,
        KneeParameters::CATALOGUE,
        MotorMountParameters::CATALOGUE,
        HubParameters::CATALOGUE,
        CarrierParameters::CATALOGUE,
        BatteryParameters::CATALOGUE,
        SleeveParameters::CATALOGUE,
        BracketParameters::CATALOGUE,
        LidParameters::CATALOGUE,
        CameraParameters::CATALOGUE,
        LimitParameters::CATALOGUE,
    ]
    .into_iter()
    .flatten()
}

impl Frame {
    /// Reads a frame file or a preset and checks it.
    ///
    /// # Errors
    /// When it cannot be read or something in it is refused.
    pub fn load(frame: &str) -> Result<(Self, FrameFile), LoadError> {
        let file = FrameFile::load(frame)?;
        let frame = Self::resolve(&file)?;
        Ok((frame, file))
    }

    /// One of its numbers, by table and key.
    pub fn value(&self, table: &str, key: &str) -> Option<f64> {
        match table {
            "rods" => self.rods.value(key),
            "fit" => self.fit.value(key),
            "corner" => self.corner.value(key),
            "hub_joint" => self.hub_joint.value(key),
            "fork" => self.fork.value(key),
            "knee" => self.knee.value(key),
            "motor_mount" => self.motor_mount.value(key),
            "hub" => self.hub.value(key),
            "pi_carrier" => self.pi_carrier.value(key),
            "battery" => self.battery.value(key),
            "sleeve" => self.sleeve.value(key),
            "bracket" => self.bracket.value(key),
            "lid" => self.lid.value(key),
            "camera" => self.camera.value(key),
            "limits" => self.limits.value(key),
            _ => None,
        }
    }

    /// Checks a frame as typed.
    ///
    /// # Errors
    /// The first thing in it that is refused.
    pub fn resolve(file: &FrameFile) -> Result<Self, Refusal> {
        known_keys(file)?;
        let catalogues = Catalogues::read(file)?;
        let bought = catalogues.bought(file)?;
        let number = |p: &Parameter| number(file, &bought, p);
        let rod = bought.get("rod").and_then(|item| item.part.material.clone());
        let frame = Self {
            name: file.name.clone(),
            description: text(file, "description")?.unwrap_or_default(),
            rods: RodParameters::read(number)?,
            fit: FitParameters::read(number)?,
            corner: CornerParameters::read(number)?,
            hub_joint: HubJointParameters::read(number)?,
            fork: ForkParameters::read(number)?,
            knee: KneeParameters::read(number)?,
            motor_mount: MotorMountParameters::read(number)?,
            hub: HubParameters::read(number)?,
            pi_carrier: CarrierParameters::read(number)?,
            battery: BatteryParameters::read(number)?,
            sleeve: SleeveParameters::read(number)?,
            bracket: BracketParameters::read(number)?,
            lid: LidParameters::read(number)?,
            camera: CameraParameters::read(number)?,
            limits: LimitParameters::read(number)?,
            target: target(file)?,
            flexible: catalogues.material(file, "materials.flexible", None)?,
            rigid: catalogues.material(file, "materials.rigid", None)?,
            rod_material: catalogues.material(file, "bought.rod", rod)?,
            printer: catalogues.printer(file)?,
            bought,
            extras: extras(file)?,
        };
        super::relation::hold(&frame).map_err(|broken| file.refuse(broken.key, broken.reason))?;
        Ok(frame)
    }
}

/// Tables of a frame file beside the numeric ones.
const OTHER_KEYS: [&str; 8] =
    ["schema", "name", "description", "printer", "materials.flexible", "materials.rigid", "target.width_mm", "target.height_mm"];

fn known_keys(file: &FrameFile) -> Result<(), Refusal> {
    let mut known: Vec<String> = catalogue().map(|p| format!("{}.{}", p.table, p.key)).collect();
    known.extend(OTHER_KEYS.iter().map(|key| key.to_string()));
    known.push("target.strut_tilt_deg".into());
    known.extend(ROLES.iter().map(|(role, ..)| format!("bought.{role}")));
    for key in file.entries.keys() {
        let free = key.starts_with("extras.") || key.starts_with("override.");
        if !free && !known.contains(key) {
            let bare = key.rsplit('.').next().unwrap_or(key);
            let same_name = known.iter().filter(|k| k.rsplit('.').next() == Some(bare)).cloned().collect::<Vec<_>>();
            let nearest = if same_name.is_empty() { nearest(key, known.iter().map(String::as_str)) } else { same_name };
            return Err(file.refuse(key, Reason::UnknownKey { key: key.clone(), nearest }));
        }
    }
    match file.entries.get("schema").map(|entry| &entry.value) {
        None => Ok(()),
        Some(Value::Number(1.0)) => Ok(()),
        Some(_) => {
            let reason = Reason::WrongType { key: "schema".into(), found: "another version".into(), expected: "1".into() };
            Err(file.refuse("schema", reason))
        }
    }
}

/// A text as typed; `None` when no file states it.
fn text(file: &FrameFile, key: &str) -> Result<Option<String>, Refusal> {
    match file.entries.get(key).map(|entry| &entry.value) {
        None => Ok(None),
        Some(Value::Text(text)) => Ok(Some(text.clone())),
        Some(other) => {
            let reason = Reason::WrongType { key: key.into(), found: other.kind().into(), expected: "a text in quotes".into() };
            Err(file.refuse(key, reason))
        }
    }
}

/// A text that has to be stated.
fn stated_text(file: &FrameFile, key: &str) -> Result<String, Refusal> {
    text(file, key)?.ok_or_else(|| file.refuse(key, Reason::Missing { key: key.into() }))
}

/// A number as typed, or what a bought part says of it.
fn number(file: &FrameFile, bought: &BTreeMap<String, BoughtItem>, p: &Parameter) -> Result<f64, Refusal> {
    let key = format!("{}.{}", p.table, p.key);
    let value = match file.entries.get(&key).map(|entry| &entry.value) {
        Some(Value::Number(number)) => *number,
        Some(other) => {
            let reason = Reason::WrongType { key: key.clone(), found: other.kind().into(), expected: format!("a number in {}", p.unit()) };
            return Err(file.refuse(&key, reason));
        }
        None => follows::from_bought(bought, p.key).ok_or_else(|| file.refuse(&key, Reason::Missing { key: key.clone() }))?,
    };
    if (p.min..=p.max).contains(&value) {
        return Ok(value);
    }
    let reason = Reason::OutOfBounds { key: key.clone(), value, min: p.min, max: p.max, unit: p.unit().into() };
    let typed = file.entries.contains_key(&key);
    let chosen = follows::role_of(p.key).map_or_else(|| key.clone(), |role| format!("bought.{role}"));
    Err(file.refuse(if typed { &key } else { &chosen }, reason))
}

fn target(file: &FrameFile) -> Result<Option<TargetSize>, Refusal> {
    const BOUNDS: [(&str, f64, f64); 3] =
        [("target.width_mm", 80.0, 600.0), ("target.height_mm", 40.0, 400.0), ("target.strut_tilt_deg", 10.0, 35.0)];
    if !file.entries.keys().any(|key| key.starts_with("target.")) {
        return Ok(None);
    }
    let mut values = [0.0; 3];
    for (value, (key, min, max)) in values.iter_mut().zip(BOUNDS) {
        let unit = if key.ends_with("deg") { "°" } else { "mm" };
        *value = match file.entries.get(key).map(|entry| &entry.value) {
            Some(Value::Number(number)) if (min..=max).contains(number) => *number,
            Some(Value::Number(number)) => {
                return Err(file.refuse(key, Reason::OutOfBounds { key: key.into(), value: *number, min, max, unit: unit.into() }));
            }
            Some(other) => {
                let reason = Reason::WrongType { key: key.into(), found: other.kind().into(), expected: format!("a number in {unit}") };
                return Err(file.refuse(key, reason));
            }
            None => return Err(file.refuse("target.width_mm", Reason::Missing { key: key.into() })),
        };
    }
    let depth = file.entries.get("target.width_mm").map_or(0, |entry| entry.depth);
    for length in ["rods.cage_rod_length_mm", "rods.arm_rod_length_mm", "rods.strut_rod_length_mm"] {
        if file.entries.get(length).is_some_and(|entry| entry.depth <= depth) {
            let reason = Reason::Impossible {
                message: format!("`{length}` and a target size are both given"),
                remedy: "give the three rod lengths, or [target], not both".into(),
            };
            return Err(file.refuse(length, reason));
        }
    }
    Ok(Some(TargetSize { width_mm: values[0], height_mm: values[1], strut_tilt_deg: values[2] }))
}

/// Farthest that an extra mass may sit from the hub along an axis, mm.
const FARTHEST_EXTRA_MM: f64 = 500.0;

fn extras(file: &FrameFile) -> Result<BTreeMap<String, Extra>, Refusal> {
    let mut tables: BTreeMap<String, toml::Table> = BTreeMap::new();
    for (key, entry) in &file.entries {
        if let Some((name, field)) = key.strip_prefix("extras.").and_then(|rest| rest.split_once('.')) {
            tables.entry(name.into()).or_default().insert(field.into(), entry.value.to_toml());
        }
    }
    let read = |(name, table): (String, toml::Table)| {
        let at = format!("extras.{name}.mass_g");
        let extra: Extra = table.try_into().map_err(|e: toml::de::Error| bad_entry(file, &at, "extra", &name, e.message()))?;
        if extra.position_mm.iter().any(|at| at.abs() > FARTHEST_EXTRA_MM || !at.is_finite()) {
            let at = format!("extras.{name}.position_mm");
            let message = format!("lies further than {FARTHEST_EXTRA_MM} mm from the hub, or is no number");
            return Err(bad_entry(file, &at, "extra", &name, &message));
        }
        if let Some(role) = extra.covers.iter().find(|role| ROLES.iter().all(|(known, ..)| known != role)) {
            let reason = Reason::UnknownName {
                kind: "role of a bought part".into(),
                name: role.clone(),
                nearest: nearest(role, ROLES.iter().map(|(known, ..)| *known)),
            };
            return Err(file.refuse(&format!("extras.{name}.covers"), reason));
        }
        if !(0.0..=5000.0).contains(&extra.mass_g) {
            let (value, unit) = (extra.mass_g, "g".to_string());
            return Err(file.refuse(&at, Reason::OutOfBounds { key: at.clone(), value, min: 0.0, max: 5000.0, unit }));
        }
        Ok((name, extra))
    };
    tables.into_iter().map(read).collect()
}

fn bad_entry(file: &FrameFile, key: &str, kind: &str, name: &str, message: &str) -> Refusal {
    file.refuse(key, Reason::BadEntry { kind: kind.into(), name: name.into(), message: message.trim().into() })
}

/// The catalogues with the frame file's own entries on top.
struct Catalogues {
    parts: toml::Table,
    materials: toml::Table,
    printers: toml::Table,
}

impl Catalogues {
    fn read(file: &FrameFile) -> Result<Self, Refusal> {
        let shipped = |text: &str| -> toml::Table { toml::from_str(text).unwrap_or_default() };
        let within = |text: &str, table: &str| shipped(text).get(table).and_then(|t| t.as_table()).cloned().unwrap_or_default();
        let printers = preset::PRINTERS.iter().map(|(name, text)| (name.to_string(), toml::Value::Table(shipped(text)))).collect();
        let mut all = Self { parts: within(preset::BOUGHT, "parts"), materials: within(preset::MATERIALS, "materials"), printers };
        for (key, entry) in file.entries.iter().filter(|(key, _)| key.starts_with("override.")) {
            // A name may have dots in it, as in [override.printers."generic-0.4"]; a table's and a field's have none.
            let table = key.split('.').nth(1).unwrap_or_default();
            let place = key.strip_prefix(&format!("override.{table}.")).and_then(|rest| rest.rsplit_once('.'));
            let (catalogue, name, field) = match (table, place) {
                ("parts", Some((name, field))) => (&mut all.parts, name, field),
                ("materials", Some((name, field))) => (&mut all.materials, name, field),
                ("printers", Some((name, field))) => (&mut all.printers, name, field),
                _ => {
                    let known = ["override.parts.NAME.mass_g", "override.materials.NAME.print_factor", "override.printers.NAME.nozzle_mm"];
                    return Err(file.refuse(key, Reason::UnknownKey { key: key.clone(), nearest: nearest(key, known) }));
                }
            };
            let named = file.entries.values().any(|entry| matches!(&entry.value, Value::Text(text) if text == name));
            if !catalogue.contains_key(name) && !named {
                let nearest = nearest(name, catalogue.keys().map(String::as_str));
                return Err(file.refuse(key, Reason::UnknownName { kind: format!("entry of {table}"), name: name.into(), nearest }));
            }
            let own = catalogue.entry(name).or_insert_with(|| toml::Value::Table(toml::Table::new()));
            if let Some(own) = own.as_table_mut() {
                own.insert(field.into(), entry.value.to_toml());
            }
        }
        Ok(all)
    }

    fn bought(&self, file: &FrameFile) -> Result<BTreeMap<String, BoughtItem>, Refusal> {
        let mut items = BTreeMap::new();
        for (role, quantity, kind) in ROLES {
            let key = format!("bought.{role}");
            let Some(name) = text(file, &key)?.filter(|name| name != "none") else { continue };
            let part: BoughtPart = entry(&self.parts, file, &key, "bought part", "parts", &name)?;
            if part.kind != kind {
                let reason =
                    Reason::WrongType { key: key.clone(), found: format!("a {}: `{name}`", part.kind), expected: format!("a {kind}") };
                return Err(file.refuse(&key, reason));
            }
            if !part.is_sound() {
                return Err(bad_override(file, &key, "bought part", "parts", &name, "a mass or size of it is negative or no number"));
            }
            items.insert(role.into(), BoughtItem { name, quantity, part });
        }
        for role in ["motor", "propeller", "battery", "rod"] {
            if !items.contains_key(role) {
                let key = format!("bought.{role}");
                return Err(file.refuse(&key, Reason::Missing { key: key.clone() }));
            }
        }
        Ok(items)
    }

    /// The material that a key names, or that something else named for it.
    fn material(&self, file: &FrameFile, key: &str, named: Option<String>) -> Result<NamedMaterial, Refusal> {
        let name = named.map_or_else(|| stated_text(file, key), Ok)?;
        let material: Material = entry(&self.materials, file, key, "material", "materials", &name)?;
        if !material.is_sound() {
            return Err(bad_override(file, key, "material", "materials", &name, "one of its figures is not positive or no number"));
        }
        Ok(NamedMaterial { name, material })
    }

    fn printer(&self, file: &FrameFile) -> Result<Printer, Refusal> {
        let name = stated_text(file, "printer")?;
        let printer: Printer = entry(&self.printers, file, "printer", "printer", "printers", &name)?;
        if !printer.is_sound() {
            return Err(bad_override(file, "printer", "printer", "printers", &name, "one of its sizes is not positive or no number"));
        }
        Ok(printer)
    }
}

/// A named entry of a catalogue; `key` names it in the frame file.
fn entry<T: serde::de::DeserializeOwned>(
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
    entry.clone().try_into().map_err(|e: toml::de::Error| bad_override(file, key, kind, table, name, e.message()))
}

/// A catalogue's entry that does not read: what the frame file changed in it is to blame.
fn bad_override(file: &FrameFile, key: &str, kind: &str, table: &str, name: &str, message: &str) -> Refusal {
    let own = format!("override.{table}.{name}.");
    let changed: Vec<&String> = file.entries.keys().filter(|key| key.starts_with(&own)).collect();
    let named = changed.iter().find(|key| key.strip_prefix(&own).is_some_and(|field| message.contains(&format!("`{field}`"))));
    let at = named.or(changed.first()).map_or(key, |key| key.as_str());
    bad_entry(file, at, kind, name, message)
}
