//! From the file as typed to the frame as meant.

use std::collections::{BTreeMap, BTreeSet};

use super::carried::carrier;
use super::choice::{CATALOGUES, Catalogues, fields};
use super::figure::within_bounds;
use super::follows;
use super::frame::{BoughtItem, Extra, Frame, catalogue};
use super::frame_file::{FrameFile, Value};
use super::groups::*;
use super::load_error::LoadError;
use super::parameter::Parameter;
use super::read::{bad_entry, in_one_line, stated_text, text, to_blame};
use super::refusal::{ROLE, Reason, Refusal, nearest};
use super::roles::{NEEDED, ROLES};
use super::sleeve_direction::SleeveDirection;
use super::{bought_relation, layer_height, relation, renamed, target};

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

    /// Checks a frame as typed.
    ///
    /// # Errors
    /// The first thing in it that is refused.
    pub fn resolve(file: &FrameFile) -> Result<Self, Refusal> {
        known_keys(file)?;
        text(file, "name")?;
        file.hold_name()?;
        let catalogues = Catalogues::read(file)?;
        let bought = catalogues.bought(file)?;
        let number = |p: &Parameter| number(file, &bought, p);
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
            sleeve_direction: sleeve_direction(file)?,
            bracket: BracketParameters::read(number)?,
            lid: LidParameters::read(number)?,
            camera: CameraParameters::read(number)?,
            accessories: AccessoryParameters::read(number)?,
            limits: LimitParameters::read(number)?,
            target: target::read(file)?,
            flexible: catalogues.flexible(file)?,
            rigid: catalogues.rigid(file)?,
            rod_material: catalogues.rod_material(file, &bought)?,
            printer: catalogues.printer(file)?,
            printer_name: stated_text(file, "printer")?,
            bought,
            extras: extras(file)?,
        };
        bought_relation::hold(&frame).and_then(|()| relation::hold(&frame)).map_err(|broken| file.refuse(broken.key, *broken.reason))?;
        layer_height::hold(file, &frame)?;
        covered_once(file, &frame)?;
        Ok(frame)
    }
}

/// Version of a frame file's form.
const SCHEMA: f64 = 1.0;

/// Tables in which a frame file may name what it likes.
const FREE_TABLES: [&str; 2] = ["extras", "override"];

/// Tables of a frame file beside the numeric ones.
const OTHER_KEYS: [&str; 7] = ["schema", "name", "description", "printer", "materials.flexible", "materials.rigid", SleeveDirection::KEY];

fn known_keys(file: &FrameFile) -> Result<(), Refusal> {
    let mut known: Vec<String> = catalogue().map(|p| format!("{}.{}", p.table, p.key)).collect();
    known.extend(OTHER_KEYS.iter().map(|key| key.to_string()));
    known.extend(target::KEYS.map(|key| key.key.to_string()));
    known.extend(ROLES.iter().map(|(role, ..)| format!("bought.{role}")));
    for (key, entry) in &file.entries {
        let free = key.starts_with("extras.") || key.starts_with("override.");
        let empty = matches!(&entry.value, Value::Other(toml::Value::Table(_)));
        let table = empty && is_table_key(key, &known);
        if free || table || known.contains(key) {
            continue;
        }
        if is_table_key(key, &known) {
            let expected = format!("a table: [{key}], and its keys on the lines below");
            return Err(file.refuse(key, Reason::WrongType { key: key.clone(), found: entry.value.kind().into(), expected }));
        }
        let inside = known.iter().find(|k| key.strip_prefix(k.as_str()).is_some_and(|rest| rest.starts_with('.')));
        let reason = match inside {
            _ if key == "base" => base_is_typed(),
            Some(parent) => Reason::TableForValue { key: key.clone(), parent: parent.clone(), expected: expected(parent) },
            None => match renamed::now(key) {
                Some(now) => Reason::Renamed { key: key.clone(), now: now.into() },
                None => Reason::UnknownKey { key: key.clone(), nearest: meant(key, &known) },
            },
        };
        return Err(file.refuse(key, reason));
    }
    match file.entries.get("schema").map(|entry| &entry.value) {
        None | Some(Value::Number(SCHEMA)) => Ok(()),
        Some(stated) => {
            let message = format!("`schema` is {}, this flexframe reads schema {SCHEMA}", stated.to_toml());
            let remedy =
                format!("write schema = {SCHEMA} if the file is meant for this version, or read it with the version it was written for");
            Err(file.refuse("schema", Reason::Impossible { message, remedy }))
        }
    }
}

/// A base is read with the file that names it; it is no value that can be set.
fn base_is_typed() -> Reason {
    let message = "`base` cannot be set: it is read with the file that names it".into();
    Reason::Impossible { message, remedy: "state base in the frame file's text, or begin with another frame".into() }
}

/// Whether a key is the name of a table.
fn is_table_key(key: &str, known: &[String]) -> bool {
    FREE_TABLES.contains(&key) || known.iter().any(|known| known.strip_prefix(key).is_some_and(|rest| rest.starts_with('.')))
}

/// What a known key takes.
fn expected(key: &str) -> String {
    let number = catalogue().find(|p| key == format!("{}.{}", p.table, p.key));
    match (number, key) {
        (Some(p), _) => p.expected(),
        (None, "schema") => format!("{SCHEMA}"),
        (None, key) => target::key(key).map_or_else(|| "a text in quotes".into(), |target| format!("a number in {}", target.unit)),
    }
}

/// What an unknown key was probably meant to be: one of the same name in another table, one in a table of a similar
/// name, or one that looks alike.
fn meant(key: &str, known: &[String]) -> Vec<String> {
    let bare = key.rsplit('.').next();
    let same_name: Vec<String> = known.iter().filter(|k| k.rsplit('.').next() == bare).cloned().collect();
    if !same_name.is_empty() {
        return same_name;
    }
    let (table, rest) = key.split_once('.').unwrap_or((key, ""));
    if CATALOGUES.contains(&table) && !rest.is_empty() {
        return vec![format!("override.{key}")];
    }
    let tables = known.iter().filter_map(|k| k.split('.').next()).chain(FREE_TABLES);
    match nearest(table, tables).first() {
        Some(near) if rest.is_empty() => vec![near.clone()],
        Some(near) if FREE_TABLES.contains(&near.as_str()) && table != near => vec![format!("{near}.{rest}").trim_end_matches('.').into()],
        _ => nearest(key, known.iter().map(String::as_str)),
    }
}

/// A number as typed, or what a bought part says of it.
fn number(file: &FrameFile, bought: &BTreeMap<String, BoughtItem>, p: &Parameter) -> Result<f64, Refusal> {
    let key = format!("{}.{}", p.table, p.key);
    let value = match file.entries.get(&key).map(|entry| &entry.value) {
        Some(Value::Number(number)) => *number,
        Some(other) => {
            let reason = Reason::WrongType { key: key.clone(), found: other.kind().into(), expected: p.expected() };
            return Err(file.refuse(&key, reason));
        }
        None => match follows::same_as(p.key).and_then(parameter_called) {
            Some(other) => return number(file, bought, other),
            None => from_bought(file, bought, p)?,
        },
    };
    if (p.min..=p.max).contains(&value) {
        return Ok(value);
    }
    let (min, max, unit) = (p.min, p.max, p.unit().to_string());
    let followed = follows::role_in(bought, p.key).and_then(|role| Some((role, bought.get(role)?)));
    match followed.filter(|_| !file.entries.contains_key(&key)) {
        None => Err(file.refuse(&key, Reason::OutOfBounds { key: key.clone(), value, min, max, unit })),
        Some((role, item)) => {
            // Of a part that the file describes itself, that figure; else the choice of the part.
            let field = follows::field_of(bought, p.key).filter(|field| file.entries.contains_key(field));
            let at = field.clone().unwrap_or_else(|| format!("bought.{role}"));
            let (name, carrier) = (item.name.clone(), carrier(role).into());
            Err(file.refuse(&at, Reason::NotCarried { role: role.into(), name, carrier, field, key, value, min, max, unit }))
        }
    }
}

/// What a bought part says of a number, and the number that it grows with.
fn from_bought(file: &FrameFile, bought: &BTreeMap<String, BoughtItem>, p: &Parameter) -> Result<f64, Refusal> {
    let followed = follows::from_bought(bought, p.key).ok_or_else(|| not_stated(file, bought, p))?;
    match follows::grows_with(p.key).and_then(|(other, usual)| Some((parameter_called(other)?, usual))) {
        Some((other, usual)) => Ok(follows::grown_mm(followed, number(file, bought, other)?, usual)),
        None => Ok(followed),
    }
}

/// The parameter of a key with its table.
fn parameter_called(key: &str) -> Option<&'static Parameter> {
    catalogue().find(|p| key == format!("{}.{}", p.table, p.key))
}

/// A number that neither the file states nor the bought part that it follows from.
fn not_stated(file: &FrameFile, bought: &BTreeMap<String, BoughtItem>, p: &Parameter) -> Refusal {
    let key = format!("{}.{}", p.table, p.key);
    let Some((role, fields)) = follows::lacking(bought, p.key) else { return file.refuse(&key, Reason::Missing { key: key.clone() }) };
    let name = bought.get(role).map_or("", |item| item.name.as_str());
    let fields = fields.iter().map(|field| format!("`{field}`")).collect::<Vec<_>>().join(" and ");
    let message = format!("the bought part `{name}` lacks {fields}, from which `{key}` follows");
    let remedy = format!("state {fields} in [override.parts.{name}]{}; `flexframe schema bought` explains the keys", left_out(role));
    let own = format!("override.parts.{name}.");
    let at = file.entries.keys().find(|key| key.starts_with(&own)).cloned().unwrap_or_else(|| format!("bought.{role}"));
    file.refuse(&at, Reason::Impossible { message, remedy })
}

/// What to do with a part that lacks what its place needs, such as a board without mounting holes.
fn left_out(role: &str) -> String {
    if NEEDED.contains(&role) {
        return String::new();
    }
    format!(
        "; a part that has none is fastened otherwise: write {role} = \"none\" in [bought], and make it an entry of [extras] with covers = [\"{role}\"]"
    )
}

/// How a file says that the sleeve lies; along where it says nothing.
fn sleeve_direction(file: &FrameFile) -> Result<SleeveDirection, Refusal> {
    let Some(word) = text(file, SleeveDirection::KEY)? else { return Ok(SleeveDirection::default()) };
    SleeveDirection::of_word(&word).ok_or_else(|| {
        let near = nearest(&word, SleeveDirection::WORDS);
        let nearest = if near.is_empty() { SleeveDirection::WORDS.map(String::from).into() } else { near };
        file.refuse(SleeveDirection::KEY, Reason::UnknownName { kind: "direction of the sleeve".into(), name: word, nearest })
    })
}

/// Most letters of a name that stands in a remedy.
const MOST_LETTERS: usize = 60;

fn in_short(name: &str) -> String {
    if name.chars().count() > MOST_LETTERS { "NAME".into() } else { name.into() }
}

fn extras(file: &FrameFile) -> Result<BTreeMap<String, Extra>, Refusal> {
    let mut tables: BTreeMap<String, toml::Table> = BTreeMap::new();
    for (key, entry) in &file.entries {
        let Some(rest) = key.strip_prefix("extras.") else { continue };
        // A name may have dots in it, a field's name has none.
        match (rest.rsplit_once('.'), &entry.value) {
            (Some((name, field)), _) => {
                in_one_line(file, key, "extra", name)?;
                within_bounds(&Extra::FIGURES, field, file, key, &entry.value)?;
                tables.entry(name.into()).or_default().insert(field.into(), entry.value.to_toml());
            }
            (None, Value::Other(toml::Value::Table(_))) => drop(tables.entry(rest.into()).or_default()),
            // A field of an extra whose name was forgotten, or an extra that is no table.
            (None, _) if fields::<Extra>().iter().any(|field| field == rest) => {
                let nearest = vec![format!("extras.NAME.{rest}")];
                return Err(file.refuse(key, Reason::UnknownKey { key: key.clone(), nearest }));
            }
            (None, value) => {
                let expected = format!("a table: [extras.{}] with mass_g, mass_basis and source", in_short(rest));
                return Err(file.refuse(key, Reason::WrongType { key: key.clone(), found: value.kind().into(), expected }));
            }
        }
    }
    let read = |(name, table): (String, toml::Table)| {
        let table = toml::Value::Table(table);
        let extra: Extra = table.clone().try_into().map_err(|e: toml::de::Error| bad_extra(file, &name, &table, e.message()))?;
        if let Some(role) = extra.covers.iter().find(|role| ROLES.iter().all(|(known, ..)| known != role)) {
            let reason = Reason::UnknownName {
                kind: ROLE.into(),
                name: role.clone(),
                nearest: nearest(role, ROLES.iter().map(|(known, ..)| *known)),
            };
            return Err(file.refuse(&format!("extras.{name}.covers"), reason));
        }
        Ok((name, extra))
    };
    tables.into_iter().map(read).collect()
}

/// Refuses a role of which something is bought in the masses of two extras: it would be counted twice.
fn covered_once(file: &FrameFile, frame: &Frame) -> Result<(), Refusal> {
    let mut covering: BTreeMap<&str, &str> = BTreeMap::new();
    for (name, extra) in frame.extras.iter().filter(|(_, extra)| extra.mass_g > 0.0) {
        let own: BTreeSet<&str> = extra.covers.iter().map(String::as_str).filter(|role| frame.bought.contains_key(*role)).collect();
        for role in own {
            if let Some(first) = covering.insert(role, name) {
                let message = format!("the extras `{first}` and `{name}` both cover `{role}`, which would be counted twice");
                let remedy = format!("take \"{role}\" out of the `covers` of one of them");
                // The one of the frame file itself, before one of a base.
                let depth = |key: &String| file.entries.get(key).map_or(usize::MAX, |entry| entry.depth);
                let keys = [name, first].map(|name| format!("extras.{name}.covers"));
                let key = keys.iter().min_by_key(|key| depth(key)).unwrap_or(&keys[0]);
                return Err(file.refuse(key, Reason::Impossible { message, remedy }));
            }
        }
    }
    Ok(())
}

/// An extra that does not read: the key whose value is to blame, else the first that the file states of it.
fn bad_extra(file: &FrameFile, name: &str, table: &toml::Value, message: &str) -> Refusal {
    let table_key = format!("extras.{name}");
    let own = format!("{table_key}.");
    match to_blame::<Extra>(table, file, &own) {
        Some(key) => {
            let field = format!("`{}`", key.strip_prefix(&own).unwrap_or(&key));
            let message = if message.contains(&field) { message.to_string() } else { format!("{field}: {message}") };
            bad_entry(file, &key, "extra", name, &message)
        }
        None => {
            let stated = file.entries.keys().find(|key| **key == table_key || key.starts_with(&own));
            bad_entry(file, stated.map_or(table_key.as_str(), String::as_str), "extra", name, message)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::files::Memory;
    use super::*;

    #[test]
    fn planted_a_nut_ties_nothing_and_a_strap_holds_no_board() {
        for (text, words) in [
            ("bought.tie = \"nut-m2\"", "`bought.tie` is `nut-m2`, which goes onto a thread"),
            ("bought.tie = \"damper-m2\"", "`bought.tie` is `damper-m2`"),
            ("bought.stack_nut = \"zip-tie\"", "`bought.stack_nut` is `zip-tie`, which is a strap"),
        ] {
            let refusal = resolved(text).expect_err(text);
            assert!(refusal.message().contains(words), "{}", refusal.message());
        }
    }

    #[test]
    fn planted_an_extra_that_is_no_table_and_a_field_without_a_name() {
        let no_table = resolved("extras.vtx = 5.0").expect_err("is a number");
        assert!(no_table.remedy().contains("[extras.vtx] with mass_g"), "{}", no_table.remedy());
        let no_name = resolved("extras.mass_g = 5.0").expect_err("has no name");
        assert!(no_name.remedy().contains("`extras.NAME.mass_g`"), "{}", no_name.remedy());
        let no_role = resolved("bought.vtx = \"x\"").expect_err("is no role");
        assert!(no_role.remedy().contains("an entry of [extras]"), "{}", no_role.remedy());
    }

    #[test]
    fn planted_entries_are_refused_in_the_words_of_a_frame_file() {
        let own = |field: &str| {
            format!(
                "bought.battery = \"mine\"\n[override.parts.mine]\nkind = \"battery\"\nmass_g = 50.0\nmass_basis = \"measured\"\nsource = \"scale\"\n{field}\n"
            )
        };
        for (field, words) in
            [("size_mm = [62.0, 26.0]", "a list of 2, expected three numbers"), ("size_mm = \"62x26x18\"", "a text, \"62x26x18\"")]
        {
            let refusal = resolved(&own(field)).expect_err(field);
            assert!(refusal.message().contains(words) && refusal.remedy().contains("length, width and height"), "{}", refusal.message());
        }
    }

    fn resolved(text: &str) -> Result<Frame, Refusal> {
        let text = format!("base = \"cognifly\"\n{text}");
        Frame::resolve(&FrameFile::load_from("f.toml", &Memory([("f.toml".into(), text.into())].into())).expect("reads"))
    }

    #[test]
    fn planted_values_in_the_place_of_tables_and_kinds_that_no_part_is_of() {
        for (text, says) in [
            ("rods = 5", "`rods`"),
            ("limits = []", "`limits`"),
            ("bought = \"none\"", "`bought`"),
            ("[override.parts.mine]\nkind = \"tail\"", "is \"tail\", no kind of bought part"),
            ("[override.parts.propeller-65mm]\ncells = 2", "a part of the kind \"propeller\" has no `cells`, only a \"battery\" has"),
            ("[override.parts.battery-3s-650]\nmass_g = 0.058", "g/cm³, less than any part has: state it in grams"),
            ("[battery]\nbattery_mass_g = 0.058", "g/cm³, it must have at least 0.05 g/cm³"),
        ] {
            let refusal = resolved(text).err().unwrap_or_else(|| panic!("{text} is accepted"));
            assert!(refusal.reason.to_string().contains(says), "{text}: {}", refusal.reason);
            assert_eq!(refusal.place.map(|place| place.line_column()[0]), Some(text.lines().count() + 1), "{text}");
        }
        assert!(resolved("[rods]\n[override]\n[extras]").is_ok(), "tables with nothing in them");
        let dotted = "[extras.\"rx.v2\"]\nmass_g = 2\nmass_basis = \"estimate\"\nsource = \"a guess\"\nposition_mm = [0, 0, 0]";
        assert!(resolved(dotted).is_ok_and(|frame| frame.extras.contains_key("rx.v2")), "a name with a dot in it");
        assert!(resolved("[battery]\nbattery_mass_g = 0").is_ok(), "a battery that is weighed with something else");
    }

    #[test]
    fn planted_a_role_that_two_extras_cover_is_refused() {
        let extra = |name: &str, mass_g: f64| {
            format!(
                "[extras.{name}]\nmass_g = {mass_g}\nmass_basis = \"estimate\"\nsource = \"a guess\"\ncovers = [\"battery\", \"tie\"]\n"
            )
        };
        let twice = resolved(&(extra("pack", 30.0) + &extra("rest", 5.0))).expect_err("is counted twice");
        assert!(twice.to_string().contains("`pack` and `rest` both cover `battery`"), "{twice}");
        assert!(resolved(&(extra("pack", 30.0) + &extra("rest", 0.0))).is_ok(), "one that weighs nothing counts nothing");
        let none = "[bought]\ncamera = \"none\"\n";
        let of_none = extra("left", 6.0) + &extra("right", 6.0);
        assert!(
            resolved(&(none.to_string() + &of_none.replace("\"battery\", \"tie\"", "\"camera\""))).is_ok(),
            "of what is not bought nothing is counted"
        );
    }

    /// What nothing else does, unless an extra stands for it.
    #[test]
    fn planted_what_cannot_be_left_out_unless_an_extra_covers_it() {
        for (role, does) in [
            ("tie", "holds the bracket"),
            ("motor_screw", "holds the motors"),
            ("stack_screw", "holds the boards"),
            ("stack_nut", "holds the boards"),
            ("stack_spacer", "keeps the boards where they are"),
            ("connector", "connects the battery"),
            ("magnet", "holds the battery's lid"),
            ("flight_controller", "flies the frame: `esc-4in1-20x20` is a motor controller alone"),
            ("motor_controller", "drives the motors beside the flight controller"),
        ] {
            let refusal = resolved(&format!("[bought]\n{role} = \"none\"")).err().unwrap_or_else(|| panic!("{role} is not missed"));
            assert!(refusal.reason.to_string().contains(&format!("leaves nothing that {does}")), "{}", refusal.reason);
            assert!(refusal.remedy().contains(&format!("covers = [\"{role}\"]")), "{}", refusal.remedy());
            assert_eq!(refusal.place.map(|place| place.line_column()[0]), Some(3), "{role}");
            let extra = format!(
                "[bought]\n{role} = \"none\"\n[extras.glue]\nmass_g = 1\nmass_basis = \"estimate\"\nsource = \"a guess\"\nposition_mm = [0, 0, 0]\ncovers = [\"{role}\"]"
            );
            assert!(resolved(&extra).is_ok(), "{role}");
        }
    }

    #[test]
    fn planted_a_board_without_mounting_holes_may_be_an_extra() {
        let own = "[bought]\nflight_controller = \"own\"\n[override.parts.own]\nkind = \"board\"\nsize_mm = [61, 17.8, 5]\nmass_g = 10\n\
                   mass_basis = \"datasheet\"\nsource = \"its maker\"\n";
        let remedy = resolved(own).expect_err("has no holes").remedy();
        assert!(remedy.contains("state `hole_pattern_mm`") && remedy.contains("covers = [\"flight_controller\"]"), "{remedy}");
    }

    #[test]
    fn planted_one_board_is_both_controllers_where_its_entry_says_so() {
        let one =
            |board: &str, more: &str| resolved(&format!("[bought]\nflight_controller = \"none\"\nmotor_controller = \"{board}\"\n{more}"));
        assert!(one("aio-20x20", "").is_ok_and(|frame| frame.is_all_in_one()));
        assert!(one("esc-4in1-20x20", "[override.parts.esc-4in1-20x20]\nall_in_one = true").is_ok());
        let refusal = one("aio-20x20", "[override.parts.aio-20x20]\nall_in_one = false").expect_err("nothing flies it");
        assert!(refusal.remedy().contains("state all_in_one = true in [override.parts.aio-20x20]"), "{}", refusal.remedy());
        let neither = resolved("[bought]\nflight_controller = \"none\"\nmotor_controller = \"none\"").expect_err("has no board");
        assert!(neither.reason.to_string().contains("leaves nothing that"), "{}", neither.reason);
    }

    #[test]
    fn planted_figures_of_a_material_and_of_a_printer_that_do_not_go_together() {
        let cold = resolved("[override.materials.abs]\nnozzle_c = 200").expect_err("is colder than it prints at");
        assert!(cold.reason.to_string().contains("`nozzle_c` = 200 is less than `least_nozzle_c` = 240"), "{}", cold.reason);
        assert!(resolved("[override.materials.abs]\nnozzle_c = 240").is_ok());
        let on = |size_mm: &str| resolved(&format!("printer = \"flsun-qqs-pro\"\n[override.printers.flsun-qqs-pro]\nsize_mm = {size_mm}"));
        let oval = on("[260, 200]").expect_err("is no circle");
        assert!(oval.reason.to_string().contains("a round bed has one diameter"), "{}", oval.reason);
        assert!(on("[240, 240]").is_ok());
    }

    #[test]
    fn planted_a_motor_whose_shaft_ends_in_its_base_needs_no_hole() {
        let frame = resolved("[override.parts.motor-1104]\nshaft_hole_diameter_mm = 0").expect("is allowed");
        assert_eq!(frame.motor_mount.motor_shaft_hole_mm, 0.0);
        let refusal = resolved("[override.parts.motor-1104]\nshaft_hole_diameter_mm = -0.1").expect_err("is no hole");
        assert!(refusal.reason.to_string().contains("0 to 50 mm"), "{}", refusal.reason);
    }

    /// At most 0.8 of the nozzle: 0.2 mm of both materials from 0.25 mm on.
    #[test]
    fn planted_layers_that_are_as_high_as_the_nozzle_is_wide() {
        let on = |nozzle_mm: f64, more: &str| resolved(&format!("[override.printers.\"generic-0.4\"]\nnozzle_mm = {nozzle_mm}\n{more}"));
        assert!(on(0.25, "").is_ok());
        let thin =
            |layer_mm: f64| format!("[override.materials.tpu-95a]\nlayer_mm = {layer_mm}\n[override.materials.abs]\nlayer_mm = {layer_mm}");
        assert!(on(0.2, &thin(0.16)).is_ok());
        for (refused, line, says) in [
            (on(0.2, ""), 3, "layers of 0.20 mm of tpu-95a are too high for a nozzle of 0.2 mm: 0.16 mm at most"),
            (on(0.24, ""), 3, "layers of 0.20 mm of tpu-95a are too high for a nozzle of 0.24 mm: 0.19 mm at most"),
            (on(0.2, &thin(0.17)), 5, "layers of 0.17 mm of tpu-95a are too high for a nozzle of 0.2 mm: 0.16 mm at most"),
            (on(0.2, "[override.materials.tpu-95a]\nlayer_mm = 0.1"), 3, "layers of 0.20 mm of abs"),
        ] {
            let refusal = refused.err().unwrap_or_else(|| panic!("{says} is not said"));
            assert!(refusal.reason.to_string().contains(says), "{}", refusal.reason);
            assert_eq!(refusal.place.as_ref().map(|place| place.line_column()[0]), Some(line), "{says}");
            assert!(refusal.remedy().contains("in [override.materials."), "{}", refusal.remedy());
        }
    }

    /// Centimetres for millimetres, in a part of one's own and in one of the catalogue.
    #[test]
    fn planted_a_size_that_is_out_of_bounds_is_told_at_the_part_that_states_it() {
        let own = "[bought]\nbattery = \"mine\"\n[override.parts.mine]\nkind = \"battery\"\nmass_g = 60\nsize_mm = [7.5, 3.5, 2.6]\n\
                   mass_basis = \"datasheet\"\nsource = \"its maker\"";
        for (text, line) in [(own, 7), ("[override.parts.battery-3s-650]\nsize_mm = [5.8, 3.0, 1.9]", 3)] {
            let refusal = resolved(text).err().unwrap_or_else(|| panic!("{text} is accepted"));
            assert!(refusal.reason.to_string().contains("battery_length_mm"), "{}", refusal.reason);
            assert_eq!(refusal.place.map(|place| place.line_column()[0]), Some(line), "{text}");
        }
    }
}
