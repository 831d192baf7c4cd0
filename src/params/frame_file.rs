//! The frame as typed: a TOML file on its chain of bases, every value with the place it was typed at.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::files::{Disk, Files};
use super::follows;
use super::frame_name;
use super::load_error::{LARGEST_FILE, LoadError};
use super::preset;
use super::refusal::{LONGEST_CHAIN, Place, Reason, Refusal, Source, nearest};

/// The key that names a frame.
const NAME: &str = "name";
/// Longest key with its tables, bytes: each entry has the names of its tables, so a long one would be held as often as it has entries.
const LONGEST_KEY: usize = 300;

/// A value as typed.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// Anything else, in TOML's own form.
    Other(toml::Value),
}

impl Value {
    /// The text that it is.
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Whether it is a table; only one with nothing in it is kept as a value.
    pub fn is_table(&self) -> bool {
        matches!(self, Self::Other(toml::Value::Table(_)))
    }

    /// Out of TOML's own form.
    pub fn of_toml(value: toml::Value) -> Self {
        match value {
            toml::Value::Integer(number) => Self::Number(number as f64),
            toml::Value::Float(number) => Self::Number(number),
            toml::Value::String(text) => Self::Text(text),
            other => Self::Other(other),
        }
    }

    /// In TOML's own form.
    pub fn to_toml(&self) -> toml::Value {
        match self {
            // Counts are read as whole numbers; a length takes either.
            Self::Number(number) if number.fract() == 0.0 && number.abs() < 1e15 => toml::Value::Integer(*number as i64),
            Self::Number(number) => toml::Value::Float(*number),
            Self::Text(text) => toml::Value::String(text.clone()),
            Self::Other(value) => value.clone(),
        }
    }

    /// What it is, for a message.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::Other(toml::Value::Boolean(_)) => "true or false",
            Self::Other(toml::Value::Array(list)) if list.is_empty() => "an empty array",
            Self::Other(toml::Value::Array(_)) => "an array",
            Self::Other(toml::Value::Table(_)) => "a table",
            Self::Other(toml::Value::Datetime(_)) => "a date",
            Self::Other(_) => "something else",
        }
    }
}

/// A value and where it was typed.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// What was typed.
    pub value: Value,
    /// Where.
    pub place: Place,
    /// How many bases lie between the frame file and the file it was typed in; 0 is the frame file.
    pub depth: usize,
}

/// All entries of a frame file and its bases, by dotted key; the nearer file wins.
#[derive(Clone, Debug)]
pub struct FrameFile {
    /// Name of the frame: the file's, unless it states one.
    pub name: String,
    /// The entries.
    pub entries: BTreeMap<String, Entry>,
    /// What was read from disk, the frame file first; presets come with the program and are not among them.
    pub files: Vec<Arc<Source>>,
    /// Where the frame file names its base.
    pub base: Option<Place>,
}

impl FrameFile {
    /// Reads a frame: a path to a TOML file, or the name of a preset.
    ///
    /// # Errors
    /// When there is none, when it cannot be read, or when it is not TOML.
    pub fn load(frame: &str) -> Result<Self, LoadError> {
        Self::load_from(frame, &Disk)
    }

    /// The same with files from somewhere else than the disk.
    ///
    /// # Errors
    /// When there is none, when it cannot be read, or when it is not TOML.
    pub fn load_from(frame: &str, files: &dyn Files) -> Result<Self, LoadError> {
        let (name, source, folder) = open(frame, None, files)?;
        Self::read(name, source, folder, files)
    }

    /// Reads a frame from text; its base, if it has one, is a preset or a file of the working directory.
    ///
    /// # Errors
    /// When it is not TOML or a base cannot be read.
    pub fn parse(name: &str, text: &str) -> Result<Self, LoadError> {
        let source = Arc::new(Source { name: name.into(), text: text.into() });
        Self::read(name.into(), source, None, &Disk)
    }

    fn read(name: String, source: Arc<Source>, folder: Option<PathBuf>, files: &dyn Files) -> Result<Self, LoadError> {
        let mut file = Self { name, entries: BTreeMap::new(), files: Vec::new(), base: None };
        file.stack(source, folder, files, &mut Vec::new())?;
        file.take_name()?;
        Ok(file)
    }

    /// Takes the name that the file states, else that of the file itself; refuses one that no frame can have.
    fn take_name(&mut self) -> Result<(), Refusal> {
        if let Some(Value::Text(name)) = self.entries.get(NAME).map(|entry| &entry.value) {
            self.name = name.clone();
        }
        self.hold_name()
    }

    /// Refuses a name that no frame can have.
    pub(super) fn hold_name(&self) -> Result<(), Refusal> {
        let rule = frame_name::rule();
        let remedy = match self.entries.get(NAME).map(|entry| &entry.value) {
            Some(Value::Text(_)) => rule,
            _ => format!("rename the file, or state another name in it, such as name = \"light\": {rule}"),
        };
        match frame_name::fault(&self.name) {
            Some(message) => Err(self.refuse(NAME, Reason::Impossible { message, remedy })),
            None => Ok(()),
        }
    }

    /// Adds a file's entries where no nearer file has them, then its base's.
    fn stack(&mut self, source: Arc<Source>, folder: Option<PathBuf>, files: &dyn Files, chain: &mut Vec<String>) -> Result<(), LoadError> {
        let depth = chain.len();
        chain.push(source.name.clone());
        if folder.is_some() {
            self.files.push(Arc::clone(&source));
        }
        let mut typed = typed_entries(&source, depth)?;
        let base = typed.remove("base");
        if depth > 0 {
            typed.remove("name");
            typed.remove("description");
        }
        for (key, entry) in typed {
            self.entries.entry(key).or_insert(entry);
        }
        let Some(base) = base else { return Ok(()) };
        if depth == 0 {
            self.base = Some(base.place.clone());
        }
        let Value::Text(base_name) = &base.value else {
            let reason = Reason::WrongType { key: "base".into(), found: base.value.kind().into(), expected: "the name of a frame".into() };
            return Err(Refusal { reason: Box::new(reason), place: Some(base.place) }.into());
        };
        let here = folder.as_deref().map(|folder| Here { folder, file: &source.name });
        let (_, source, folder) = open(base_name, here, files).map_err(|error| match error {
            LoadError::NoSuchFrame { .. } => {
                let reason =
                    Reason::UnknownName { kind: "base".into(), name: base_name.clone(), nearest: nearest(base_name, preset::names()) };
                Refusal { reason: Box::new(reason), place: Some(base.place.clone()) }.into()
            }
            other => other,
        })?;
        if chain.contains(&source.name) || chain.len() == LONGEST_CHAIN {
            let reason = Reason::BaseChain { chain: format!("{} -> {}", chain.join(" -> "), source.name) };
            return Err(Refusal { reason: Box::new(reason), place: Some(base.place) }.into());
        }
        self.stack(source, folder, files, chain)
    }

    /// Sets a value, as if the frame file stated it; a refusal of it still points to where the key was typed. A table sets each of its
    /// keys, and `name` names the frame.
    pub fn set(&mut self, key: &str, value: Value) {
        let typed = self.entries.get(key).map(|entry| entry.place.clone());
        let place = typed.unwrap_or_else(|| Place::of_command_line(format!("{key} = {}", value.to_toml())));
        self.put(key, value, &place);
    }

    /// Sets a value that was asked for on the command line: a refusal points at these words of it.
    pub fn ask(&mut self, key: &str, value: Value, words: String) {
        self.put(key, value, &Place::of_command_line(words));
    }

    fn put(&mut self, key: &str, value: Value, place: &Place) {
        match (key, value) {
            (_, Value::Other(toml::Value::Table(table))) if !table.is_empty() => {
                table.into_iter().for_each(|(name, inner)| self.put(&format!("{key}.{name}"), Value::of_toml(inner), place));
            }
            (_, value) => {
                if let (NAME, Value::Text(name)) = (key, &value) {
                    self.name.clone_from(name);
                }
                self.entries.insert(key.into(), Entry { value, place: place.clone(), depth: 0 });
            }
        }
    }

    /// Sets a number.
    pub fn set_number(&mut self, key: &str, value: f64) {
        self.set(key, Value::Number(value));
    }

    /// A refusal that points at a key; where no file states it, at what the file has to do with it, or at the file's beginning.
    pub fn refuse(&self, key: &str, reason: Reason) -> Refusal {
        let typed = self.entries.get(key);
        let place = match typed {
            Some(entry) if self.is_own(entry) => Some(entry.place.clone()),
            // The value is a preset's, or a bought part's: what the user's own file has to do with it is what can be changed.
            _ => self.own_place(&reason).or_else(|| typed.map(|entry| entry.place.clone())).or_else(|| self.beginning()),
        };
        Refusal { reason: Box::new(reason), place }
    }

    /// The first line of the frame file, where it was read from a file.
    fn beginning(&self) -> Option<Place> {
        let source = self.files.first()?;
        let span = 0..source.text.find('\n').unwrap_or(source.text.len());
        Some(Place { source: Arc::clone(source), span })
    }

    /// Whether an entry stands in a file of the user's, or was asked for.
    fn is_own(&self, entry: &Entry) -> bool {
        entry.depth == 0 || self.files.iter().any(|source| Arc::ptr_eq(source, &entry.place.source))
    }

    /// The place in the user's files nearest to what a refusal speaks of: a key that it names, the choice of the part that such a key
    /// follows from, or the base.
    fn own_place(&self, reason: &Reason) -> Option<Place> {
        let text = format!("{reason} {}", reason.remedy());
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        let named = |key: &str| {
            let last = key.rsplit('.').next().unwrap_or(key);
            let chosen = |word: &&str| key.strip_prefix("bought.").is_some_and(|role| follows::role_of(word) == Some(role));
            words.contains(&last) || words.iter().any(chosen)
        };
        let own = self.entries.iter().filter(|(key, entry)| key.contains('.') && self.is_own(entry) && named(key));
        own.min_by_key(|(_, entry)| entry.depth).map(|(_, entry)| entry.place.clone()).or_else(|| self.base.clone())
    }
}

/// The file that names a base, and its folder.
#[derive(Clone, Copy)]
struct Here<'a> {
    folder: &'a Path,
    file: &'a str,
}

impl Here<'_> {
    /// The file beside this one that a base's name means; a preset's name never means this file itself.
    fn beside(&self, base: &str, files: &dyn Files) -> Option<PathBuf> {
        let whole = base.ends_with(".toml");
        let path = self.folder.join(if whole { base.to_string() } else { format!("{base}.toml") });
        let preset = !whole && preset::text(base).is_some() && path.display().to_string() == self.file;
        (files.is_file(&path) && !preset).then_some(path)
    }
}

/// Finds a frame: its name, its text, and the folder of its bases. One named on the command line is a path or a preset,
/// a base is a file beside the one that names it, or a preset.
fn open(frame: &str, here: Option<Here>, files: &dyn Files) -> Result<(String, Arc<Source>, Option<PathBuf>), LoadError> {
    let path = match here {
        Some(here) => here.beside(frame, files),
        None => frame.ends_with(".toml").then(|| PathBuf::from(frame)),
    };
    if let Some(path) = path {
        let parent = path.parent().map(Path::to_path_buf);
        let (stem, source) = read_from(path, files)?;
        return Ok((stem, source, parent));
    }
    match preset::text(frame) {
        Some(text) => {
            let source = Source { name: format!("params/frames/{frame}.toml"), text: text.to_string() };
            Ok((frame.to_string(), Arc::new(source), None))
        }
        None => Err(LoadError::NoSuchFrame {
            name: frame.into(),
            presets: preset::names().collect::<Vec<_>>().join(", "),
            nearest: nearest(frame, preset::names()).into_iter().next(),
        }),
    }
}

/// A file's stem and its text.
///
/// # Errors
/// When it cannot be read, is larger than a file of parameters, or is not UTF-8.
pub fn read_source(path: PathBuf) -> Result<(String, Arc<Source>), LoadError> {
    read_from(path, &Disk)
}

pub(super) fn read_from(path: PathBuf, files: &dyn Files) -> Result<(String, Arc<Source>), LoadError> {
    let unreadable = |error| LoadError::Unreadable { path: path.clone(), error };
    let bytes = files.bytes(&path, LARGEST_FILE + 1).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(LoadError::TooLarge { path });
    }
    let text = String::from_utf8(bytes).map_err(|error| not_utf8(&path, &error))?;
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    Ok((stem, Arc::new(Source { name: path.display().to_string(), text })))
}

/// Byte order marks of UTF-16, little-endian and big-endian.
const UTF_16_MARKS: [[u8; 2]; 2] = [[0xff, 0xfe], [0xfe, 0xff]];

/// A file that is not UTF-8: the refusal points at the first byte that is none, in the lines as far as they can be read.
fn not_utf8(path: &Path, error: &std::string::FromUtf8Error) -> Refusal {
    let is_utf_16 = UTF_16_MARKS.iter().any(|mark| error.as_bytes().starts_with(mark));
    let (text, message) = if is_utf_16 {
        (String::new(), "this is UTF-16 text, a file of parameters is UTF-8")
    } else {
        (String::from_utf8_lossy(error.as_bytes()).into_owned(), "this is not UTF-8 text: it has another encoding, such as Latin-1")
    };
    let at = if is_utf_16 { 0 } else { error.utf8_error().valid_up_to() };
    let end = text[at..].chars().next().map_or(at, |first| at + first.len_utf8());
    let reason = Reason::Impossible { message: message.into(), remedy: "save the file as UTF-8".into() };
    let source = Source { name: path.display().to_string(), text };
    Refusal { reason: Box::new(reason), place: Some(Place { source: Arc::new(source), span: at..end }) }
}

/// The entries of a TOML text by dotted key, each with its place.
pub(super) fn typed_entries(source: &Arc<Source>, depth: usize) -> Result<BTreeMap<String, Entry>, Refusal> {
    let table = DeTable::parse(&source.text).map_err(|error| {
        let end = source.text.len();
        let span = error.span().unwrap_or(0..end.min(1));
        let place = Place { source: Arc::clone(source), span: span.start.min(end)..span.end.min(end) };
        let has_comma = is_decimal_comma(&source.text, place.span.start);
        Refusal { reason: Box::new(Reason::Syntax { message: error.message().to_string(), has_comma }), place: Some(place) }
    })?;
    let mut typed = BTreeMap::new();
    flatten("", table.get_ref(), source, depth, &mut typed)?;
    Ok(typed)
}

/// Whether a comma stands between two digits at a place of a text.
fn is_decimal_comma(text: &str, at: usize) -> bool {
    let bytes = text.as_bytes();
    let is_digit = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_digit);
    bytes.get(at) == Some(&b',') && is_digit(at.checked_sub(1)) && is_digit(Some(at + 1))
}

fn flatten(
    prefix: &str,
    table: &DeTable<'_>,
    source: &Arc<Source>,
    depth: usize,
    entries: &mut BTreeMap<String, Entry>,
) -> Result<(), Refusal> {
    for (key, value) in table {
        let dotted = if prefix.is_empty() { key.get_ref().to_string() } else { format!("{prefix}.{}", key.get_ref()) };
        if dotted.len() > LONGEST_KEY {
            return Err(too_long(&dotted, Place { source: Arc::clone(source), span: key.span() }));
        }
        if let DeValue::Table(inner) = value.get_ref()
            && !inner.is_empty()
        {
            flatten(&dotted, inner, source, depth, entries)?;
            continue;
        }
        let place = Place { source: Arc::clone(source), span: key.span().start..value.span().end };
        if let DeValue::Array(items) = value.get_ref()
            && items.iter().any(|item| matches!(item.get_ref(), DeValue::Table(_)))
        {
            return Err(a_list_of_tables(&dotted, place));
        }
        let value = typed_value(value)
            .map_err(|message| Refusal { reason: Box::new(Reason::Syntax { message, has_comma: false }), place: Some(place.clone()) })?;
        entries.insert(dotted, Entry { value, place, depth });
    }
    Ok(())
}

fn a_list_of_tables(key: &str, place: Place) -> Refusal {
    let message = format!("`{key}` is a list of tables; here each table has a name of its own");
    let remedy = format!("write [{key}.NAME] in place of [[{key}]]");
    Refusal { reason: Box::new(Reason::Impossible { message, remedy }), place: Some(place) }
}

fn too_long(key: &str, place: Place) -> Refusal {
    let message = format!("a key of {} bytes is too long: {key}", key.len());
    let remedy = format!("give it and its tables shorter names, at most {LONGEST_KEY} bytes together");
    Refusal { reason: Box::new(Reason::Impossible { message, remedy }), place: Some(place) }
}

fn typed_value(value: &Spanned<DeValue<'_>>) -> Result<Value, String> {
    match value.get_ref() {
        DeValue::Integer(integer) => i64::from_str_radix(&integer.as_str().replace('_', ""), integer.radix())
            .map(|number| Value::Number(number as f64))
            .map_err(|error| error.to_string()),
        DeValue::Float(float) => float.as_str().replace('_', "").parse().map(Value::Number).map_err(|e| format!("{e}")),
        DeValue::String(text) => Ok(Value::Text(text.to_string())),
        DeValue::Boolean(flag) => Ok(Value::Other(toml::Value::Boolean(*flag))),
        DeValue::Array(items) => {
            let items: Result<Vec<_>, _> = items.iter().map(|item| typed_value(item).map(|v| v.to_toml())).collect();
            items.map(|items| Value::Other(toml::Value::Array(items)))
        }
        DeValue::Table(inner) if inner.is_empty() => Ok(Value::Other(toml::Value::Table(toml::Table::new()))),
        DeValue::Datetime(date) => Ok(Value::Other(toml::Value::Datetime(*date))),
        other => Err(format!("a {} has no place in a file of parameters", other.type_str())),
    }
}

#[cfg(test)]
mod tests {
    use super::super::files::Memory;
    use super::*;
    use crate::params::Frame;

    /// A preset with values set; what is said of it.
    fn set(values: &[(&str, &str)]) -> Result<Frame, String> {
        let mut file = FrameFile::load("cognifly").expect("a preset");
        for (key, text) in values {
            let table: toml::Table = toml::from_str(&format!("value = {text}")).expect("is TOML");
            file.set(key, Value::of_toml(table["value"].clone()));
        }
        Frame::resolve(&file).map_err(|refusal| refusal.to_string())
    }

    #[test]
    fn analytic_a_table_that_is_set_sets_its_keys() {
        let frame = set(&[("rods", "{ cage_rod_length_mm = 181.0 }"), ("limits", "{}")]).expect("is a frame");
        assert_eq!(frame.rods.cage_rod_length_mm, 181.0);
        let own =
            "{ kind = \"battery\", mass_g = 70.0, mass_basis = \"measured\", size_mm = [60.0, 31.0, 18.0], cells = 3, source = \"scale\" }";
        let frame = set(&[("override.parts", &format!("{{ mine = {own} }}")), ("bought.battery", "\"mine\"")]).expect("is a frame");
        assert_eq!(frame.bought["battery"].part.mass_g, 70.0);
        let said = set(&[("rods", "{ cage_rod_length = 181.0 }")]).expect_err("is no key");
        assert!(said.contains("rods.cage_rod_length"), "{said}");
    }

    #[test]
    fn planted_a_name_that_is_set_is_held_to_the_rules_of_names() {
        assert_eq!(set(&[("name", "\"light\"")]).expect("is a name").name, "light");
        for (key, text, part) in
            [("name", "\"../../x\"", "name"), ("name", "3", "a number"), ("base", "\"cognifly-v8\"", "`base` cannot be set")]
        {
            let said = set(&[(key, text)]).expect_err("is refused");
            assert!(said.contains(part), "{said}");
        }
        let Ok(file) = FrameFile::parse("mine", "base = \"cognifly\"\nname = 3\n") else { panic!("is TOML") };
        assert!(Frame::resolve(&file).expect_err("is no text").to_string().contains("`name` is a number"));
    }

    #[test]
    fn planted_a_list_of_tables_is_told_how_it_is_written() {
        for text in ["base = \"cognifly\"\n[[extras]]\nmass_g = 2\n", "base = \"cognifly\"\nextras = [{ mass_g = 2 }]\n"] {
            let Err(LoadError::Refused(refusal)) = FrameFile::parse("mine", text) else { panic!("{text} is read") };
            assert!(refusal.to_string().contains("`extras` is a list of tables"), "{refusal}");
            assert_eq!(refusal.reason.remedy(), "write [extras.NAME] in place of [[extras]]");
            assert_eq!(refusal.place.map(|place| place.line_column()[0]), Some(2));
        }
    }

    #[test]
    fn analytic_a_decimal_comma_stands_between_two_digits() {
        let commas = |text: &str| (0..=text.len()).filter(|at| is_decimal_comma(text, *at)).collect::<Vec<_>>();
        assert_eq!(commas("2,5"), [1]);
        assert_eq!(commas("a = [1, 2]\nb = 12,34"), [17]);
        for text in ["", ",", ",5", "2,", "2, 5", "2 ,5", "2.5", "a,b"] {
            assert!(commas(text).is_empty(), "{text}");
        }
    }

    #[test]
    fn analytic_a_preset_s_name_never_means_the_file_that_bases_on_it() {
        let text = "base = \"cognifly\"\n[rods]\ncage_rod_length_mm = 188.0\n";
        let read = |name: &str, others: &[(&str, &str)]| {
            let files = others.iter().chain([&(name, text)]).map(|(name, text)| (PathBuf::from(name), text.as_bytes().to_vec())).collect();
            FrameFile::load_from(name, &Memory(files)).expect("reads")
        };
        let depth = |file: &FrameFile, key: &str| file.entries[key].depth;
        let of_preset = read("cognifly.toml", &[]);
        assert_eq!((of_preset.files.len(), depth(&of_preset, "rods.strut_rod_length_mm")), (1, 1));
        let beside = read("mine.toml", &[("cognifly.toml", "base = \"cognifly\"\n[rods]\nstrut_rod_length_mm = 50.0\n")]);
        assert_eq!((beside.files.len(), depth(&beside, "rods.strut_rod_length_mm")), (2, 1));
    }
}
