//! `flexframe diff`: what two frames differ in.

use std::path::Path;
use std::process::ExitCode;

use super::arguments::{Common, DiffOptions, PageFormat};
use super::output;
use super::progress::Progress;
use super::revision::Revision;
use super::session::{self, Failure};
use super::stiffness;
use super::terminal;
use crate::checks;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::FrameFile;
use crate::params::files::{Disk, Files};
use crate::report::page::diff_page;
use crate::report::picture::side_by_side;
use crate::variant::{Difference, Evaluation, Increase, MECHANICS_CAVEAT, PEAK_CAVEAT, Side};

/// Says what differs; exits 1 when a measure grew by more than allowed.
pub(super) fn diff(options: &DiffOptions, common: &Common) -> Result<ExitCode, Failure> {
    let increases = options.fail_on_increase.iter().map(|text| Increase::parse(text)).collect::<Result<Vec<_>, _>>();
    let increases = increases.map_err(|error| Failure::Usage { message: format!("--fail-on-increase: {error}") })?;
    let settings = session::mechanics(&options.mechanics)?;
    if let Some(increase) = increases.iter().find(|increase| increase.measure.is_mechanics() && settings.is_none()) {
        return Err(Failure::Usage { message: format!("--fail-on-increase: {} is only known with --strength", increase.measure.name) });
    }
    let working = Progress::of("comparing", common);
    let sides = sides(options, settings.as_ref())?;
    let difference = Difference::of(&sides);
    drop(working);
    let page = diff_page::markdown(&difference);
    let json = json(&difference);
    let place = match &options.output {
        None => None,
        Some(folder) => {
            let designs = sides.each_ref().map(|side| &side.evaluation.design);
            let picture = side_by_side::png(designs, sides.each_ref().map(|side| side.name.as_str()));
            let files = [
                ("diff.md".into(), format!("{page}\n![both frames](diff.png)\n").into_bytes()),
                ("diff.json".into(), format!("{json:#}\n").into_bytes()),
                ("diff.png".into(), picture),
            ];
            let [a, b] = sides.each_ref().map(|side| folder_name(&side.name));
            Some(output::write_folder(folder, &format!("diff-{a}-{b}"), &files)?)
        }
    };
    match options.format.unwrap_or(PageFormat::Text) {
        _ if common.json => terminal::print(&format!("{json:#}\n"))?,
        PageFormat::Json => terminal::print(&format!("{json:#}\n"))?,
        PageFormat::Markdown => terminal::print(&page)?,
        PageFormat::Text if common.quiet => {}
        PageFormat::Text => {
            let written = place.map_or(String::new(), |place| format!("{}: diff.md, diff.json, diff.png\n", place.display()));
            terminal::print(&format!("{}{written}", diff_page::text(&difference)))?;
        }
    }
    let exceeded: Vec<String> = increases.iter().filter_map(|increase| exceeded(increase, &sides)).collect();
    exceeded.iter().for_each(|message| terminal::tell(message));
    Ok(if exceeded.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn sides(options: &DiffOptions, settings: Option<&MechanicsSettings>) -> Result<[Side; 2], Failure> {
    match (&options.git, options.frames.as_slice()) {
        (None, [a, b]) => Ok([side(a, &Disk, "", settings)?, side(b, &Disk, "", settings)?]),
        (Some(name), [frame]) => {
            session::needs_file(frame, "--git compares a file with its former self")?;
            let revision = Revision::of(Path::new(frame), name)?;
            Ok([side(frame, &revision, &format!("@{}", revision.short()), settings)?, side(frame, &Disk, "", settings)?])
        }
        (None, _) => Err(Failure::Usage { message: "give two frames, or one and --git REVISION".into() }),
        (Some(_), _) => Err(Failure::Usage { message: "give one frame with --git REVISION".into() }),
    }
}

fn side(frame: &str, files: &dyn Files, suffix: &str, settings: Option<&MechanicsSettings>) -> Result<Side, Failure> {
    let (frame, file) = session::resolved(FrameFile::load_from(frame, files)?)?;
    let name = format!("{}{suffix}", frame.name);
    let mut evaluation = Evaluation::of(session::designed(frame, &file)?);
    if let Some(settings) = settings {
        evaluation = evaluation.strengthened(settings).map_err(stiffness::refused)?;
        let predicted = evaluation.prediction.iter().flat_map(|found| checks::strength(&evaluation.design, &settings.limits, found));
        let predicted: Vec<_> = predicted.collect();
        evaluation.findings.extend(predicted);
    }
    Ok(Side { name, evaluation })
}

fn folder_name(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect()
}

fn json(difference: &Difference) -> serde_json::Value {
    let mut value = serde_json::json!(difference);
    value["schema_version"] = 1.into();
    value["peak"] = PEAK_CAVEAT.into();
    if difference.measures.iter().any(|change| change.name == "stiffness") {
        value["mechanics"] = MECHANICS_CAVEAT.into();
    }
    value
}

/// What to say when a measure grew by more than allowed. Growth counts as it is told: one of 0.00 mm is none.
fn exceeded(increase: &Increase, sides: &[Side; 2]) -> Option<String> {
    let [before, after] = sides.each_ref().map(|side| increase.measure.of(&side.evaluation));
    let grown = increase.exceeded(before, after)?;
    let Increase { measure, most } = increase;
    let (name, unit, told) = (measure.name, measure.unit, measure.reported(Some(grown)));
    if told.parse::<f64>().is_ok_and(|told| told <= *most) {
        return None;
    }
    Some(format!(
        "{name} grew by {told} {unit}, from {} to {} {unit}; {most} {unit} are allowed",
        measure.reported(before),
        measure.reported(after)
    ))
}
