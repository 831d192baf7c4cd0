//! A model file of the drop as typed: every value with the place it was typed at.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use super::files::{Disk, Files};
use super::frame_file::{Entry, Value, read_from, read_source, typed_entries};
use super::load_error::LoadError;
use super::preset::{IMPACTS, MECHANICS};
use super::refusal::{Place, Reason, Refusal, Source, nearest, unit_after};

/// All entries of a model file by dotted key.
#[derive(Clone, Debug)]
pub struct ImpactFile {
    /// Name of the model: the file's.
    pub name: String,
    /// The entries.
    pub entries: BTreeMap<String, Entry>,
    kind: Kind,
    source: Arc<Source>,
}

/// What a file describes.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// A drop.
    Model,
    /// The mechanics of frames.
    Mechanics,
    /// Synthetic drops.
    Plan,
}

impl Kind {
    /// Where its keys are explained.
    fn keys(self) -> &'static str {
        match self {
            Self::Model => "docs/physics.md lists the keys of a model file",
            Self::Mechanics => "params/mechanics.toml has every key of a file of the mechanics; docs/mechanics.md explains them",
            Self::Plan => "docs/diagnosis.md lists the keys of a plan, docs/physics.md those of its model",
        }
    }
}

impl ImpactFile {
    /// The names of the models that come with the program, the default first.
    pub fn names() -> impl Iterator<Item = &'static str> {
        IMPACTS.iter().map(|(name, _)| *name)
    }

    /// Reads a model: a path to a TOML file, or the name of one that comes with the program.
    ///
    /// # Errors
    /// When there is none, when it cannot be read, or when it is not TOML.
    pub fn load(model: &str) -> Result<Self, LoadError> {
        Self::load_from(model, &Disk)
    }

    /// The same with files from somewhere else than the disk.
    ///
    /// # Errors
    /// When there is none, when it cannot be read, or when it is not TOML.
    pub fn load_from(model: &str, files: &dyn Files) -> Result<Self, LoadError> {
        if model.ends_with(".toml") {
            let (name, source) = read_from(PathBuf::from(model), files)?;
            return Ok(Self::read(name, source)?);
        }
        let known = IMPACTS.iter().find(|(name, _)| *name == model);
        let Some((name, text)) = known else {
            return Err(LoadError::NoSuchModel { name: model.into(), models: Self::names().collect::<Vec<_>>().join(", ") });
        };
        let source = Source { name: format!("params/impact/{name}.toml"), text: (*text).into() };
        Ok(Self::read((*name).into(), Arc::new(source))?)
    }

    /// Reads a plan of synthetic drops: a path to a TOML file.
    ///
    /// # Errors
    /// When there is none, when it cannot be read, or when it is not TOML.
    pub fn plan(path: &str) -> Result<Self, LoadError> {
        if !path.ends_with(".toml") {
            return Err(LoadError::NoSuchPlan { name: path.into() });
        }
        let (name, source) = read_source(PathBuf::from(path))?;
        Ok(Self { kind: Kind::Plan, ..Self::read(name, source)? })
    }

    /// Reads the numbers of the frame's mechanics: a path to a TOML file, or those that come with the program.
    ///
    /// # Errors
    /// When the file cannot be read, or is not TOML.
    pub fn mechanics(path: Option<&str>, files: &dyn Files) -> Result<Self, LoadError> {
        let (name, source) = match path {
            Some(path) => read_from(PathBuf::from(path), files)?,
            None => ("mechanics".into(), Arc::new(Source { name: "params/mechanics.toml".into(), text: MECHANICS.into() })),
        };
        Ok(Self { kind: Kind::Mechanics, ..Self::read(name, source)? })
    }

    /// Reads a model from text.
    ///
    /// # Errors
    /// When it is not TOML.
    pub fn parse(name: &str, text: &str) -> Result<Self, Refusal> {
        Self::read(name.into(), Arc::new(Source { name: name.into(), text: text.into() }))
    }

    fn read(name: String, source: Arc<Source>) -> Result<Self, Refusal> {
        let entries = typed_entries(&source, 0)?;
        Ok(Self { name, entries, kind: Kind::Model, source })
    }

    /// A refusal that points at a key; where the file lacks it, at the last line of its table, or else at the file's end.
    pub fn refuse(&self, key: &str, reason: Reason) -> Refusal {
        let end = self.source.text.len();
        let missing = || Place { source: Arc::clone(&self.source), span: end.saturating_sub(1)..end };
        let stated = self.entries.get(key).map(|entry| &entry.place);
        let place = stated.or_else(|| self.last_of_table(key)).cloned().unwrap_or_else(missing);
        Refusal { reason: Box::new(reason), place: Some(place) }
    }

    /// The last entry of the table that a key belongs to.
    fn last_of_table(&self, key: &str) -> Option<&Place> {
        let table = &key[..=key.rfind('.')?];
        let of_table = self.entries.iter().filter(|(other, _)| other.starts_with(table));
        of_table.map(|(_, entry)| &entry.place).max_by_key(|place| place.span.end)
    }

    /// A number that has to lie within bounds; `None` when it is not stated.
    ///
    /// # Errors
    /// When it is no number, or outside.
    pub fn number(&self, key: &str, bounds: [f64; 2], unit: &str) -> Result<Option<f64>, Refusal> {
        let [min, max] = bounds;
        match self.entries.get(key).map(|entry| &entry.value) {
            None => Ok(None),
            Some(Value::Number(value)) if (min..=max).contains(value) => Ok(Some(*value)),
            Some(Value::Number(value)) => {
                Err(self.refuse(key, Reason::OutOfBounds { key: key.into(), value: *value, min, max, unit: unit.into() }))
            }
            Some(other) => {
                let expected = if unit == "1" { "a number".into() } else { format!("a number in {unit}") };
                Err(self.refuse(key, Reason::WrongType { key: key.into(), found: other.kind().into(), expected }))
            }
        }
    }

    /// A number that has to be stated, within bounds.
    ///
    /// # Errors
    /// When it is missing, no number, or outside.
    pub fn stated(&self, key: &str, bounds: [f64; 2], unit: &str) -> Result<f64, Refusal> {
        let missing = || {
            let remedy = format!("state it: a number from {} to {}{}", bounds[0], bounds[1], unit_after(unit));
            self.refuse(key, Reason::Impossible { message: format!("`{key}` is not stated"), remedy })
        };
        self.number(key, bounds, unit)?.ok_or_else(missing)
    }

    /// A list of numbers that has to be stated, each within bounds.
    ///
    /// # Errors
    /// When it is missing, no such list, empty, or holds a number outside.
    pub fn numbers(&self, key: &str, bounds: [f64; 2], unit: &str) -> Result<Vec<f64>, Refusal> {
        let [min, max] = bounds;
        let expected = || format!("a list of numbers from {min} to {max}{}", unit_after(unit));
        let Some(entry) = self.entries.get(key) else {
            let remedy = format!("state it: {}", expected());
            return Err(self.refuse(key, Reason::Impossible { message: format!("`{key}` is not stated"), remedy }));
        };
        let number = |value: &toml::Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
        let list = match &entry.value {
            Value::Other(toml::Value::Array(list)) if !list.is_empty() => list.iter().map(number).collect::<Option<Vec<f64>>>(),
            _ => None,
        };
        match list {
            Some(list) => match list.iter().find(|value| !(min..=max).contains(*value)) {
                Some(value) => Err(self.refuse(key, Reason::OutOfBounds { key: key.into(), value: *value, min, max, unit: unit.into() })),
                None => Ok(list),
            },
            None => Err(self.refuse(key, Reason::WrongType { key: key.into(), found: entry.value.kind().into(), expected: expected() })),
        }
    }

    /// A list of texts; `None` when it is not stated.
    ///
    /// # Errors
    /// When it is no such list, or empty.
    pub fn texts(&self, key: &str) -> Result<Option<Vec<String>>, Refusal> {
        let Some(entry) = self.entries.get(key) else { return Ok(None) };
        let list = match &entry.value {
            Value::Other(toml::Value::Array(list)) if !list.is_empty() => {
                list.iter().map(|value| value.as_str().map(String::from)).collect::<Option<Vec<String>>>()
            }
            _ => None,
        };
        let wrong = || Reason::WrongType { key: key.into(), found: entry.value.kind().into(), expected: "a list of texts".into() };
        list.map(Some).ok_or_else(|| self.refuse(key, wrong()))
    }

    /// The same file with those keys alone for which the answer is yes.
    #[must_use]
    pub fn part(&self, keep: impl Fn(&str) -> bool) -> Self {
        let entries = self.entries.iter().filter(|(key, _)| keep(key)).map(|(key, entry)| (key.clone(), entry.clone())).collect();
        Self { entries, ..self.clone() }
    }

    /// The index of a word among those allowed; the first when it is not stated.
    ///
    /// # Errors
    /// When it is no word, or none of them.
    pub fn word(&self, key: &str, words: &[&str]) -> Result<usize, Refusal> {
        let expected = || words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(" or ");
        let Some(entry) = self.entries.get(key) else { return Ok(0) };
        let at = match &entry.value {
            Value::Text(text) => words.iter().position(|word| word == text),
            _ => None,
        };
        let found = match &entry.value {
            Value::Text(text) => format!("\"{text}\""),
            other => other.kind().into(),
        };
        at.ok_or_else(|| self.refuse(key, Reason::WrongType { key: key.into(), found, expected: expected() }))
    }

    /// Refuses every key that is not among the known ones.
    ///
    /// # Errors
    /// The first such key.
    pub fn only(&self, known: &[String], effects: &[&str]) -> Result<(), Refusal> {
        let Some(key) = self.entries.keys().find(|key| !known.contains(key)) else { return Ok(()) };
        let listed = key.strip_prefix("effects.").and_then(|rest| rest.split('.').next());
        let reason = match listed.filter(|id| !effects.contains(id)) {
            Some(id) => match nearest(id, effects.iter().copied()) {
                near if near.is_empty() => Reason::Impossible {
                    message: format!("there is no effect called `{id}`"),
                    remedy: format!("the effects are {}", effects.join(", ")),
                },
                near => Reason::UnknownName { kind: "effect".into(), name: id.into(), nearest: near },
            },
            None => match nearest(key, known.iter().map(String::as_str)) {
                near if near.is_empty() => Reason::Impossible { message: format!("unknown key `{key}`"), remedy: self.kind.keys().into() },
                near => Reason::UnknownKey { key: key.clone(), nearest: near },
            },
        };
        Err(self.refuse(key, reason))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_a_missing_key_is_told_in_its_table() {
        let file = ImpactFile::parse("own", "mass = 1.0\n[sensor]\norder = 1.0\n[effects.linear_spring]\nk = 2.0\n").expect("TOML");
        let line = |key: &str| {
            let refusal = file.stated(key, [0.0, 1.0], "g").expect_err("is missing");
            refusal.place.expect("a place").line_column()[0]
        };
        assert_eq!([line("sensor.limit_g"), line("effects.linear_spring.k_b"), line("effects.bottoming.k_b")], [3, 5, 5]);
    }
}
