//! Why a frame file is refused: what, where, the value, the limit and the remedy.

use std::ops::Range;
use std::sync::Arc;

use super::roles::NEEDED;

/// A parameter file as read.
#[derive(Debug, PartialEq, Eq)]
pub struct Source {
    /// What to call it in messages.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub source: Arc<Source>,
    /// Bytes of the text.
    pub span: Range<usize>,
}

impl Place {
    /// Words of the command line.
    pub fn of_command_line(words: String) -> Self {
        let span = 0..words.len();
        Self { source: Arc::new(Source { name: "command line".into(), text: words }), span }
    }

    /// Line and column of its first character, both from 1; columns count characters.
    pub fn line_column(&self) -> [usize; 2] {
        let text = &self.source.text;
        let start = (0..=self.span.start.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        [before.matches('\n').count() + 1, before[line_start..].chars().count() + 1]
    }
}

/// Longest chain of bases.
pub(super) const LONGEST_CHAIN: usize = 16;

/// What is wrong with a frame file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Reason {
    /// Not TOML.
    #[error("this is not TOML: {message}")]
    Syntax {
        /// What the parser says.
        message: String,
        /// Whether a comma stands in a number there.
        has_comma: bool,
    },
    /// A key or table that no frame has.
    #[error("unknown key `{key}`")]
    UnknownKey {
        /// The key with its table.
        key: String,
        /// The nearest known ones.
        nearest: Vec<String>,
    },
    /// A key that former versions knew.
    #[error("`{key}` is no key of a frame any more")]
    Renamed {
        /// The key with its table.
        key: String,
        /// What to write instead.
        now: String,
    },
    /// A value of the wrong type.
    #[error("`{key}` is {found}, it must be {expected}")]
    WrongType {
        /// The key with its table.
        key: String,
        /// What was found.
        found: String,
        /// What is wanted.
        expected: String,
    },
    /// A table where a single value belongs.
    #[error("unknown key `{key}`: `{parent}` is a table, it must be {expected}")]
    TableForValue {
        /// The key inside the table.
        key: String,
        /// The key that is no table.
        parent: String,
        /// What is wanted.
        expected: String,
    },
    /// A name of the catalogue, but of something else than what is wanted.
    #[error("`{key}` is `{name}`, {found}; it must be {expected}")]
    WrongKind {
        /// The key with its table.
        key: String,
        /// The name.
        name: String,
        /// What it is.
        found: String,
        /// What is wanted.
        expected: String,
        /// The names that fit.
        fits: Vec<String>,
    },
    /// A number outside its bounds, or not a number.
    #[error("`{key}` = {} is out of bounds: {min} to {max}{}", written(.value), unit_after(.unit))]
    OutOfBounds {
        /// The key.
        key: String,
        /// The value.
        value: f64,
        /// Lowest allowed.
        min: f64,
        /// Highest allowed.
        max: f64,
        /// Unit; empty or 1 for a plain number.
        unit: String,
    },
    /// A bought part from which a number follows that is outside its bounds.
    #[error("there is no {carrier} for the {} `{name}`: `{key}` = {}, which follows from it, is out of bounds: {min} to {max}{}", spaced(.role), written(.value), unit_after(.unit))]
    NotCarried {
        /// The part's role.
        role: String,
        /// Its name.
        name: String,
        /// What carries it.
        carrier: String,
        /// The field of the file's own entry that the number follows from.
        field: Option<String>,
        /// The number's key.
        key: String,
        /// The number.
        value: f64,
        /// Lowest allowed.
        min: f64,
        /// Highest allowed.
        max: f64,
        /// Unit; empty or 1 for a plain number.
        unit: String,
    },
    /// Neither this file nor its bases state it.
    #[error("`{key}` is stated nowhere")]
    Missing {
        /// The key.
        key: String,
    },
    /// A name that its catalogue does not hold.
    #[error("there is no {kind} called `{name}`")]
    UnknownName {
        /// Of what kind.
        kind: String,
        /// The name.
        name: String,
        /// The nearest known ones.
        nearest: Vec<String>,
    },
    /// Bases that name each other, or too long a chain.
    #[error("the chain of bases does not end within {LONGEST_CHAIN} files: {chain}")]
    BaseChain {
        /// The names in order.
        chain: String,
    },
    /// An entry of a catalogue that does not read.
    #[error("the {kind} `{name}` does not read: {message}")]
    BadEntry {
        /// Of what kind.
        kind: String,
        /// The name.
        name: String,
        /// What the reader says.
        message: String,
    },
    /// Numbers that are each allowed but cannot be together.
    #[error("{message}")]
    Impossible {
        /// What cannot be, with its numbers.
        message: String,
        /// What to change.
        remedy: String,
    },
}

/// A unit as it follows a number; nothing for a plain number, whose unit is empty or 1.
pub(super) fn unit_after(unit: &str) -> String {
    if matches!(unit, "" | "1") { String::new() } else { format!(" {unit}") }
}

/// A name in a sentence.
fn spaced(name: &str) -> String {
    name.replace('_', " ")
}

/// A number as a person would write it: without hundreds of zeros.
fn written(value: &f64) -> String {
    if *value == 0.0 || (1e-6..1e12).contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
}

impl Reason {
    /// What to change.
    pub fn remedy(&self) -> String {
        let nearest = |names: &[String]| match names {
            [] => "`flexframe params` lists the keys of all numbers, docs/frame-files.md those of names".to_string(),
            names => format!("did you mean {}?", names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(" or ")),
        };
        match self {
            Self::Syntax { has_comma: true, .. } => "write a decimal number with a point, such as 200.5, or a text in quotes".into(),
            Self::Syntax { .. } => "mend the line; https://toml.io shows the form".into(),
            Self::UnknownKey { key, nearest: n } if n.is_empty() && key.starts_with("override.") => {
                let kind = key.split('.').nth(1).unwrap_or_default();
                keys_of(kind.strip_suffix('s').unwrap_or(kind)).into()
            }
            Self::UnknownKey { key, nearest: n } if key.starts_with("bought.") => {
                let meant = if n.is_empty() { String::new() } else { format!("{} ", nearest(n)) };
                format!("{meant}{}; anything else is an entry of [extras]", known_names(ROLE))
            }
            Self::UnknownKey { nearest: n, .. } => nearest(n),
            Self::Renamed { now, .. } => now.clone(),
            Self::UnknownName { kind, nearest: n, .. } if n.is_empty() => known_names(kind),
            Self::UnknownName { kind, nearest: n, .. } if is_described(kind) => format!("{} {}", nearest(n), known_names(kind)),
            Self::UnknownName { nearest: n, .. } => nearest(n),
            Self::WrongType { expected, .. } | Self::TableForValue { expected, .. } => format!("give {expected}"),
            Self::WrongKind { fits, .. } => match fits[..] {
                [] => "none of the catalogue fits; describe one in [override]".into(),
                _ => format!("these fit: {}", fits.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ")),
            },
            Self::OutOfBounds { value, min, max, unit, .. } if value.is_finite() => {
                let limit = if value < min { min } else { max };
                format!("the nearest allowed value is {limit}{}", unit_after(unit))
            }
            Self::OutOfBounds { .. } => "give a finite number".into(),
            Self::NotCarried { role, field, .. } => {
                let mended = field.as_ref().map_or(String::new(), |field| format!("correct `{field}`, or "));
                let without = match NEEDED.contains(&role.as_str()) {
                    true => String::new(),
                    false => format!(
                        ", or leave it out ({role} = \"none\" in [bought]) and weigh it as an entry of [extras] with covers = [\"{role}\"]"
                    ),
                };
                format!("{mended}choose another {}{without}", spaced(role))
            }
            Self::Missing { key } if key.starts_with("target.") => {
                "a [target] needs all three: width_mm, height_mm and strut_tilt_deg; or leave it out and state the rod lengths".into()
            }
            Self::Missing { key } => format!("state `{key}`, or name a base that does: base = \"cognifly\""),
            Self::BaseChain { .. } => "let one file of the chain stand without a base".into(),
            Self::BadEntry { kind, .. } => format!("mend the entry; {}", keys_of(kind)),
            Self::Impossible { remedy, .. } => remedy.clone(),
        }
    }
}

/// What an extra covers, as a kind of name.
pub(super) const ROLE: &str = "role of a bought part";

/// Whether a frame file may describe one of its own.
fn is_described(kind: &str) -> bool {
    matches!(kind, "material" | "printer" | "bought part")
}

/// Where the names of a kind stand.
fn known_names(kind: &str) -> String {
    match kind {
        "base" => format!(
            "a base is a file beside this one whose name ends in .toml, or a preset: {}",
            super::preset::names().collect::<Vec<_>>().join(", ")
        ),
        "material" => "`flexframe list materials` lists the materials; [override.materials.NAME] describes one of your own".into(),
        "printer" => "`flexframe list printers` lists the printers; [override.printers.NAME] describes one of your own".into(),
        ROLE => format!("the roles are {}", super::roles::ROLES.iter().map(|(role, ..)| *role).collect::<Vec<_>>().join(", ")),
        "entry of printers" => "`flexframe list printers` lists the printers; one of your own is chosen by `printer`".into(),
        "entry of materials" => {
            "`flexframe list materials` lists the materials; one of your own states its `kind`, or is chosen under [materials] or by a rod"
                .into()
        }
        "entry of parts" => {
            "`flexframe list parts` lists the bought parts; one of your own states its `kind`, or is chosen under [bought]".into()
        }
        _ => "`flexframe list parts` lists the bought parts; [override.parts.NAME] describes one of your own".into(),
    }
}

/// Where the keys of a catalogue's entry are explained.
fn keys_of(kind: &str) -> &'static str {
    match kind {
        "extra" => {
            "an extra states mass_g, mass_basis (\"measured\", \"datasheet\" or \"estimate\") and source, and may state \
             position_mm = [x, y, z] and covers = [roles]: docs/frame-files.md"
        }
        "material" => "`flexframe schema materials` explains the keys",
        "printer" => "`flexframe schema printer` explains the keys",
        _ => {
            "`flexframe schema bought` explains the keys, such as size_mm = [62, 26, 18]: length, width and height in mm, of the part as it lies; \
             docs/frame-files.md has examples"
        }
    }
}

/// A refused frame file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct Refusal {
    /// What is wrong.
    pub reason: Box<Reason>,
    /// Where; `None` when it lies in no file.
    pub place: Option<Place>,
}

/// Longest message, bytes: a file may hold a key of a million letters.
const LONGEST_MESSAGE: usize = 600;

/// Longest remedy, bytes: it may list every name that there is.
const LONGEST_REMEDY: usize = 6000;

/// A text with its middle left out where it is longer than so many bytes.
fn shortened(text: &str, longest: usize) -> String {
    if text.len() <= longest {
        return text.into();
    }
    let head: String = text.chars().take(longest / 4).collect();
    let tail: Vec<char> = text.chars().rev().take(longest / 4).collect();
    format!("{head} … {}", tail.into_iter().rev().collect::<String>())
}

impl Refusal {
    /// What is wrong, no longer than a person reads.
    pub fn message(&self) -> String {
        shortened(&self.to_string(), LONGEST_MESSAGE)
    }

    /// What to change, and every name that there is where one was not known.
    pub fn remedy(&self) -> String {
        shortened(&self.reason.remedy(), LONGEST_REMEDY)
    }
}

/// Longest name that is compared with known ones, bytes.
const LONGEST_NAME: usize = 200;
/// A name that is part of a longer one counts from so many letters on.
const LEAST_PART: usize = 5;

/// The known names nearest to a mistyped one, best first, two at the most; capitals, spaces and underscores make no difference.
pub fn nearest<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    // Comparing takes time with the length, and nothing known is that long.
    if wrong.len() > LONGEST_NAME {
        return Vec::new();
    }
    let plain = |name: &str| name.to_lowercase().replace([' ', '_'], "-");
    let wrong = plain(wrong);
    let mut scored: Vec<(f64, &str)> = known.into_iter().map(|name| (strsim::jaro_winkler(&wrong, &plain(name)), name)).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    let is_part = |name: &str| wrong.len() >= LEAST_PART && plain(name).contains(&wrong);
    let named =
        |near: &dyn Fn(&(f64, &str)) -> bool| scored.iter().filter(|one| near(one)).take(2).map(|(_, name)| name.to_string()).collect();
    let alike: Vec<String> = named(&|(score, _)| *score > 0.8);
    if alike.is_empty() { named(&|(_, name)| is_part(name)) } else { alike }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_numbers_are_as_long_as_a_person_writes_them() {
        let shown = [0.0, -1.5, 0.001, 250_000.0, 5e-324, -1e308, f64::INFINITY, f64::NAN].map(|value| written(&value));
        assert_eq!(shown, ["0", "-1.5", "0.001", "250000", "5e-324", "-1e308", "inf", "NaN"]);
    }

    #[test]
    fn analytic_capitals_and_spaces_are_no_other_name() {
        assert_eq!(nearest("PLA", ["abs", "pla", "tpu-95a"]), ["pla"]);
        assert_eq!(nearest("Prusa MK4", ["prusa-mini", "prusa-mk4"])[0], "prusa-mk4");
        assert_eq!(nearest("knee-bend_deg", ["arm_pitch_deg", "knee_bend_deg"])[0], "knee_bend_deg");
        // What is part of a name is meant by it, where nothing looks more like it.
        assert_eq!(nearest("pattern_mm", ["mass_g", "hole_pattern_mm"]), ["hole_pattern_mm"]);
    }

    #[test]
    fn analytic_lines_and_columns_count_from_one() {
        let at = |start: usize| {
            let source = Source { name: "f.toml".into(), text: "a\nµ = 1\n\nb".into() };
            Place { source: Arc::new(source), span: start..start }.line_column()
        };
        assert_eq!([0, 1, 2, 4, 5].map(at), [[1, 1], [1, 2], [2, 1], [2, 2], [2, 3]]);
        assert_eq!([3, 10, 99].map(at), [[2, 1], [4, 1], [4, 2]], "within a character, on a line of its own, and past the end");
    }
}
