//! The plan of a study as typed, and what is wrong with it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::axis::Axis;
use super::column::Column;
use super::frame_key::{can_vary, refused_name};
use super::plan::{Frames, Study, Subject};
use super::plan_keys::{KINDS, PlanKey, Takes, each_once, impossible, named, none_of, only_known, plan_key, text, whole};
use super::recovery;
use super::samples::samples;
use super::sampling::{Layers, MOST_ROWS, NAMES, SOBOL_DIMENSIONS, Sampling, most_rows};
use super::sobol_indices::LEAST_GROUPS;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::files::Files;
use crate::params::frame_file::{Entry, Value};
use crate::params::lookup::lookup;
use crate::params::refusal::Refusal;
use crate::params::{Frame, FrameFile, ImpactFile, LoadError, parameters};
use crate::variant::Vary;

/// Rows of a plan that does not say how many.
pub const SAMPLES: usize = 1000;
/// Values of an axis of a grid that does not say how many.
const GRID_POINTS: usize = 5;
/// Most values of an axis of a grid.
const MOST_POINTS: f64 = 10_000.0;
/// Most names of all axes together: the frame's reader looks at each of them.
const MOST_NAMES: usize = 1000;
/// Largest table of samples read, bytes.
const LARGEST_TABLE: u64 = 1 << 30;
/// Bounds of a seed.
const SEED: [f64; 2] = [0.0, u32::MAX as f64];
/// The tables of what varies, beside [`KEYS`].
const TABLES: [&str; 2] = ["vary", "choose"];
/// Keys of a plan of frames, beside the tables `vary` and `choose`.
pub const KEYS: [PlanKey; 10] = [
    plan_key("kind", Takes::Word(&KINDS), "What the rows are."),
    plan_key("base", Takes::Text, "A preset, or a frame file beside the plan."),
    plan_key("sampling", Takes::Word(&NAMES), "How the rows are spread over the ranges."),
    plan_key("samples", Takes::Whole([1.0, MOST_ROWS as f64]), "Rows; with saltelli groups of rows."),
    plan_key("points", Takes::Whole([1.0, MOST_POINTS]), "Values of each range of a grid."),
    plan_key("seed", Takes::Whole(SEED), "Seed of all random numbers."),
    plan_key("measures", Takes::Names(Column::names), "The columns."),
    plan_key("mechanics", Takes::Text, "A file beside the plan with the numbers of the mechanics."),
    plan_key("table", Takes::Text, "A CSV file of samples beside the plan, in place of vary and choose."),
    plan_key("description", Takes::Text, "One line about the plan."),
];
/// What is said of each frame when a plan does not say.
const MEASURES: [&str; 8] =
    ["mass", "envelope.width", "envelope.depth", "envelope.height", "clearance.propeller", "peak", "margins", "violations"];

/// Reads a plan: the path of a TOML file.
///
/// # Errors
/// When it, its base, its table or its mechanics cannot be read, or are refused.
pub fn load(path: &str, files: &dyn Files) -> Result<Study, LoadError> {
    let file = ImpactFile::load_from(path, files)?;
    if KINDS[file.word("kind", &KINDS)?] == "recovery" {
        return of_recovery(file, files);
    }
    of_frames(file, Path::new(path).parent().unwrap_or(Path::new("")), files)
}

/// A study of frames; files are named from the plan's folder.
fn of_frames(file: ImpactFile, folder: &Path, files: &dyn Files) -> Result<Study, LoadError> {
    only_known(&file, &KEYS, &TABLES)?;
    let named = text(&file, "base")?.unwrap_or_else(|| "cognifly".into());
    // A preset's name is no path.
    let base_name = if named.ends_with(".toml") { beside(folder, &named) } else { named };
    let base = FrameFile::load_from(&base_name, files)
        .map_err(|error| at_its_key(&file, "base", error, "name a preset (`flexframe list presets`), or a frame file beside the plan"))?;
    let frame = Frame::resolve(&base)?;
    let columns = columns(&file)?;
    let mechanics_path = text(&file, "mechanics")?.map(|path| beside(folder, &path));
    let asks_mechanics = columns.iter().any(Column::is_mechanics);
    if !asks_mechanics {
        none_of(&file, &["mechanics"], "measures that need no mechanics")?;
    }
    let mechanics = asks_mechanics
        .then(|| MechanicsSettings::load_from(mechanics_path.as_deref(), files))
        .transpose()
        .map_err(|error| at_its_key(&file, "mechanics", error, "name a TOML file beside the plan, or leave the key out"))?;
    let (axes, sampling, listed) = match text(&file, "table")? {
        Some(table) => {
            none_of(&file, &["sampling", "samples", "points", "seed"], "a table")?;
            let listed = read(&beside(folder, &table), files)
                .map_err(|error| at_its_key(&file, "table", error, "name a CSV file of samples beside the plan"))?;
            let (axes, rows) = samples(&file, &table, &listed, &base, &frame)?;
            (axes, Sampling::Table { rows: Arc::new(rows) }, listed)
        }
        None => {
            let axes = axes(&file, &base, &frame)?;
            let sampling = sampling(&file, &axes)?;
            (axes, sampling, String::new())
        }
    };
    let seed = whole(&file, "seed", SEED)?.unwrap_or(1) as u32;
    let text = format!("{}\n{}\n{listed}\n{mechanics:?}", typed(&file.entries), typed(&base.entries));
    let subject = Subject::Frames(Frames { base, base_name, mechanics });
    Ok(Study { name: file.name, subject, axes, sampling, seed, columns, text })
}

/// A study of hidden effects.
fn of_recovery(file: ImpactFile, files: &dyn Files) -> Result<Study, LoadError> {
    let columns = recovery::columns(&file)?.into_iter().map(Column::Recovery).collect();
    let recovery = recovery::setting(&file, files)?;
    let text = format!("{}\n{}", typed(&file.entries), recovery.base.to_toml());
    let (axes, rows) = recovery.rows();
    let sampling = Sampling::Table { rows: Arc::new(rows) };
    Ok(Study { name: file.name, subject: Subject::Recovery(recovery), axes, sampling, seed: 0, columns, text })
}

/// What a file says, in the order of its keys. Its description changes no row.
fn typed(entries: &BTreeMap<String, Entry>) -> String {
    let stated = entries.iter().filter(|(key, _)| *key != "description");
    stated.map(|(key, entry)| format!("{key} = {:?}", entry.value)).collect::<Vec<_>>().join("\n")
}

/// A file named in a plan: a path from the plan's folder.
fn beside(folder: &Path, name: &str) -> String {
    folder.join(name).display().to_string()
}

/// Why a file that the plan names could not be read, at the key that names it. What the file itself says is refused in the file, and a machine that fails
/// is no fault of the plan.
fn at_its_key(plan: &ImpactFile, key: &str, error: LoadError, remedy: &str) -> LoadError {
    match error {
        LoadError::Refused(_) => error,
        other if other.is_of_machine() => other,
        other => plan.refuse(key, impossible(other.to_string(), remedy.into())).into(),
    }
}

/// A table of samples.
fn read(path: &str, files: &dyn Files) -> Result<String, LoadError> {
    let path = PathBuf::from(path);
    let bytes = files.bytes(&path, LARGEST_TABLE + 1).map_err(|error| LoadError::Unreadable { path: path.clone(), error })?;
    if bytes.len() as u64 > LARGEST_TABLE {
        return Err(LoadError::TooLarge { path });
    }
    let not_text = |error| LoadError::Unreadable { path, error: std::io::Error::new(std::io::ErrorKind::InvalidData, error) };
    String::from_utf8(bytes).map_err(not_text)
}

fn columns(file: &ImpactFile) -> Result<Vec<Column>, Refusal> {
    let names = file.texts("measures")?.unwrap_or_else(|| MEASURES.map(String::from).to_vec());
    let known = Column::names();
    let mut columns: Vec<Column> = Vec::new();
    if let Some(name) = names.iter().enumerate().find_map(|(at, name)| names[..at].contains(name).then_some(name)) {
        return Err(file.refuse("measures", impossible(format!("`{name}` is stated twice"), "state each measure once".into())));
    }
    for name in names {
        for column in named(file, "measures", "measure", &name, Column::of(&name), &known)? {
            if columns.iter().all(|known| known.name() != column.name()) {
                columns.push(column);
            }
        }
    }
    Ok(columns)
}

/// What varies: `vary.KEY = [LEAST, MOST]`, then `choose.KEY = ["NAME", …]`.
fn axes(file: &ImpactFile, base: &FrameFile, frame: &Frame) -> Result<Vec<Axis>, Refusal> {
    let (mut axes, mut names): (Vec<Axis>, usize) = (Vec::new(), 0);
    let mut ranges: Vec<(&String, &Entry)> = file.entries.iter().filter(|(key, _)| key.starts_with("vary.")).collect();
    ranges.sort_by_key(|(_, entry)| entry.place.span.start);
    for (key, _) in ranges {
        let axis = number_axis(file, key, frame)?;
        if axes.iter().any(|known| known.key() == axis.key()) {
            let message = format!("`{}` varies twice in the study on {}", axis.key(), frame.name);
            return Err(file.refuse(key, impossible(message, "state each key once, by its whole name or by its short one".into())));
        }
        axes.push(axis);
    }
    // However keys are written: the same plan has the same rows.
    axes.sort_by_cached_key(|axis| parameters().position(|parameter| axis.key() == format!("{}.{}", parameter.table, parameter.key)));
    for key in file.entries.keys().filter(|key| key.starts_with("choose.")) {
        axes.push(name_axis(file, key, base, &mut names)?);
    }
    if axes.is_empty() {
        let remedy = "state ranges, such as vary.arm_rod = [70, 90], names, such as choose.bought.battery = [\"…\", \"…\"], or a table";
        return Err(file.refuse("vary", impossible("nothing varies in this study".into(), remedy.into())));
    }
    Ok(axes)
}

fn number_axis(file: &ImpactFile, key: &str, frame: &Frame) -> Result<Axis, Refusal> {
    let typed = key.strip_prefix("vary.").unwrap_or(key);
    let parameter = lookup(typed).map_err(|error| {
        let remedy = match KEYS.iter().any(|known| known.key == typed) {
            true => format!("`{typed}` is a key of the plan itself: write it above the line [vary]"),
            false => "`flexframe params` lists the keys of numbers".into(),
        };
        file.refuse(key, impossible(error.to_string(), remedy))
    })?;
    can_vary(file, key, parameter, frame)?;
    let no_range = || {
        let message = format!("`{key}` is no range");
        file.refuse(key, impossible(message, format!("give [LEAST, MOST] within {} to {}", parameter.min, parameter.max)))
    };
    if file.entries.get(key).is_some_and(|entry| matches!(entry.value, Value::Text(_) | Value::Number(_))) {
        return Err(no_range());
    }
    let bounds = file.numbers(key, [parameter.min, parameter.max], parameter.unit())?;
    match bounds[..] {
        [least, most] if least <= most => Ok(Axis::Number(Vary { parameter, bounds: [least, most] })),
        _ => Err(no_range()),
    }
}

/// A key of names; the frame's reader says what is wrong with a key or a name. `before` counts the names of all axes.
fn name_axis(file: &ImpactFile, key: &str, base: &FrameFile, before: &mut usize) -> Result<Axis, Refusal> {
    let of_frame = key.strip_prefix("choose.").unwrap_or(key).to_string();
    let names = file.texts(key)?.unwrap_or_default();
    *before += names.len();
    if *before > MOST_NAMES {
        let message = format!("the axes have more than {MOST_NAMES} names");
        return Err(file.refuse(key, impossible(message, "leave some out, or give a table of samples".into())));
    }
    each_once(file, key, &names)?;
    for name in &names {
        if let Some(reason) = refused_name(base, &of_frame, Value::Text(name.clone()), format!("{key} = {name}")) {
            return Err(file.refuse(key, reason));
        }
    }
    Ok(Axis::Name { key: of_frame, names })
}

fn sampling(file: &ImpactFile, axes: &[Axis]) -> Result<Sampling, Refusal> {
    let name = NAMES[file.word("sampling", &NAMES)?];
    let idle: &[&str] = if name == "grid" { &["samples", "seed"] } else { &["points"] };
    none_of(file, idle, &format!("sampling = \"{name}\""))?;
    let least = if name == "saltelli" { LEAST_GROUPS } else { 1 };
    let samples = whole(file, "samples", [least as f64, most_rows(name) as f64])?.unwrap_or(SAMPLES);
    let dimensions = if name == "saltelli" { 2 * axes.len() } else { axes.len() };
    if matches!(name, "sobol" | "saltelli") && dimensions > SOBOL_DIMENSIONS {
        let message = format!("{} axes are too many for Sobol' points", axes.len());
        return Err(file.refuse("sampling", impossible(message, "sampling = \"latin_hypercube\"".into())));
    }
    Ok(match name {
        "sobol" => Sampling::Sobol { samples },
        "saltelli" => Sampling::Saltelli { samples },
        "grid" => grid(file, axes)?,
        _ => Sampling::LatinHypercube { samples, layers: Layers::default() },
    })
}

/// A grid: `points` values of every range, and every name.
fn grid(file: &ImpactFile, axes: &[Axis]) -> Result<Sampling, Refusal> {
    let all = whole(file, "points", [1.0, MOST_POINTS])?.unwrap_or(GRID_POINTS);
    let count = |axis: &Axis| match axis {
        Axis::Name { names, .. } => names.len(),
        Axis::Number(_) | Axis::Listed(_) | Axis::Stated(_) => all,
    };
    let points: Vec<usize> = axes.iter().map(count).collect();
    let most = most_rows("grid");
    match points.iter().try_fold(1_usize, |all, count| all.checked_mul(*count)).filter(|rows| *rows <= most) {
        Some(_) => Ok(Sampling::Grid { points }),
        None => Err(file.refuse("points", impossible(format!("the grid has more than {most} rows"), "take fewer points".into()))),
    }
}
