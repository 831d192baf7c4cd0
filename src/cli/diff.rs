//! `flexframe diff`: what two frames differ in.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use super::cache;
use super::candidates;
use super::failure::{Failure, mechanics_refused};
use super::options::{Common, MechanicsOption, PageFormat};
use super::output;
use super::progress::Progress;
use super::revision::Revision;
use super::session;
use super::terminal;
use crate::checks;
use crate::mechanics::settings::MechanicsSettings;
use crate::memo::Memo;
use crate::params::FrameFile;
use crate::params::files::{Disk, Files};
use crate::report::data::difference_data;
use crate::report::page::diff_page;
use crate::report::picture::side_by_side;
use crate::variant::{Difference, Evaluation, Increase, Side, why_not_compared};

/// Compare two frames, or two revisions of a frame: the differences, and which are better or worse.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe diff cognifly light.toml\n  flexframe diff --git HEAD~1 light.toml --format markdown --fail-on-increase mass=2g\n  flexframe diff cognifly cognifly-mini -o out\n  flexframe diff cognifly light.toml --strength --fail-on-increase design_drop.peak=5g\n\n`flexframe solve --help` lists the measures for --fail-on-increase."
)]
pub(super) struct Args {
    /// Two presets' names or TOML files; one file with --git.
    #[arg(required = true, num_args = 1..=2, value_name = "FRAME", add = candidates::frames())]
    pub frames: Vec<String>,
    /// Compare a file with its version at this revision of its git repository.
    #[arg(long, value_name = "REVISION")]
    pub git: Option<String>,
    /// Exit 1 when a measure increases by more than this; may be given several times.
    #[arg(long, value_name = "MEASURE=AMOUNT", add = candidates::measures_with_values())]
    pub fail_on_increase: Vec<String>,
    /// Format of the comparison; --json is the same as --format json.
    #[arg(long, value_enum, value_name = "FORMAT", conflicts_with = "json")]
    pub format: Option<PageFormat>,
    /// Whether the mechanics are computed.
    #[command(flatten)]
    pub mechanics: MechanicsOption,
    /// Write diff.md, diff.json and a picture of both frames into the folder `diff-A-B` of this one.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

impl Args {
    /// Whether JSON is asked for by the format.
    pub fn wants_json(&self) -> bool {
        self.format == Some(PageFormat::Json)
    }
}

/// Says what differs; exits 1 when a measure grew by more than allowed.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let increases = args.fail_on_increase.iter().map(|text| Increase::parse(text)).collect::<Result<Vec<_>, _>>();
    let increases = increases.map_err(|error| Failure::Usage { message: format!("--fail-on-increase: {error}") })?;
    let settings = session::mechanics(&args.mechanics)?;
    if let Some(increase) = increases.iter().find(|increase| increase.measure.is_mechanics() && settings.is_none()) {
        return Err(Failure::Usage { message: format!("--fail-on-increase: {} is only known with --strength", increase.measure.name) });
    }
    let working = Progress::of("comparing", common);
    let sides = sides(args, settings.as_ref(), &cache::memo(common))?;
    let difference = Difference::of(&sides);
    drop(working);
    let page = diff_page::markdown(&difference);
    let exceeded: Vec<Exceeded> = increases.iter().filter_map(|increase| Exceeded::of(increase, &sides)).collect();
    let mut json = difference_data::json(&difference);
    if !exceeded.is_empty() {
        json["increased"] = exceeded.iter().map(Exceeded::json).collect();
    }
    let place = match &args.output {
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
    match args.format.unwrap_or(PageFormat::Text) {
        _ if common.json => terminal::print(&format!("{json:#}\n"))?,
        PageFormat::Json => terminal::print(&format!("{json:#}\n"))?,
        PageFormat::Markdown => terminal::print(&page)?,
        PageFormat::Text if common.quiet => {}
        PageFormat::Text => {
            let written = place.map_or(String::new(), |place| format!("{}: diff.md, diff.json, diff.png\n", place.display()));
            terminal::print(&format!("{}{written}", diff_page::text(&difference)))?;
        }
    }
    exceeded.iter().for_each(|exceeded| terminal::tell(&exceeded.message));
    Ok(if exceeded.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn sides(args: &Args, settings: Option<&MechanicsSettings>, memo: &Arc<Memo>) -> Result<[Side; 2], Failure> {
    match (&args.git, args.frames.as_slice()) {
        (None, [a, b]) => Ok([side(a, &Disk, "", settings, memo)?, side(b, &Disk, "", settings, memo)?]),
        (Some(name), [frame]) => {
            session::needs_file(frame, "--git compares a file with its former self")?;
            let revision = Revision::of(Path::new(frame), name)?;
            Ok([side(frame, &revision, &format!("@{}", revision.short()), settings, memo)?, side(frame, &Disk, "", settings, memo)?])
        }
        (None, _) => Err(Failure::Usage { message: "give two frames, or one and --git REVISION".into() }),
        (Some(_), _) => Err(Failure::Usage { message: "give one frame with --git REVISION".into() }),
    }
}

fn side(frame: &str, files: &dyn Files, suffix: &str, settings: Option<&MechanicsSettings>, memo: &Arc<Memo>) -> Result<Side, Failure> {
    let (frame, file) = session::resolved(FrameFile::load_from(frame, files)?)?;
    let name = format!("{}{suffix}", frame.name);
    let mut evaluation = Evaluation::of(session::designed(frame, &file, memo)?);
    if let Some(settings) = settings {
        evaluation = evaluation.strengthened(settings).map_err(mechanics_refused)?;
        let predicted = evaluation
            .prediction
            .iter()
            .flat_map(|found| checks::strength(&evaluation.design, &evaluation.masses, &settings.limits, found));
        let predicted: Vec<_> = predicted.collect();
        evaluation.findings.extend(predicted);
    }
    Ok(Side { name, evaluation })
}

fn folder_name(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect()
}

/// A measure that grew by more than `--fail-on-increase` allows, or of which that cannot be told.
struct Exceeded<'a> {
    increase: &'a Increase,
    /// By how much it grew, in its unit; negative where its lower figure is no better one.
    found: Option<f64>,
    message: String,
}

impl<'a> Exceeded<'a> {
    /// What became of an allowed increase; none where it is kept. Growth counts as it is printed: one of 0.00 mm is none.
    /// A lower figure that leaves out a harder impact is no better one, so it fails, too.
    fn of(increase: &'a Increase, sides: &[Side; 2]) -> Option<Self> {
        let Increase { measure, most } = increase;
        let [before, after] = sides.each_ref().map(|side| measure.of(&side.evaluation));
        let why = why_not_compared(measure, sides.each_ref().map(Side::named));
        if let Some(why) = why.as_ref().filter(|_| after < before) {
            let message = format!("{why}; whether the second frame is worse cannot be told");
            return Some(Self { increase, found: after.zip(before).map(|(after, before)| after - before), message });
        }
        let grown = increase.exceeded(before, after)?;
        let (name, unit, formatted) = (measure.name, measure.unit, measure.reported(Some(grown)));
        if formatted.parse::<f64>().is_ok_and(|formatted| formatted <= *most) {
            return None;
        }
        let softer = why.map_or(String::new(), |why| format!(" ({why})"));
        let message = format!(
            "{name} grew by {formatted} {unit}, from {} to {} {unit}; {most} {unit} are allowed{softer}",
            measure.reported(before),
            measure.reported(after)
        );
        Some(Self { increase, found: Some(grown), message })
    }

    fn json(&self) -> serde_json::Value {
        let Increase { measure, most } = self.increase;
        serde_json::json!({
            "measure": measure.name,
            "unit": measure.unit,
            "allowed": most,
            "found": self.found,
            "message": self.message,
        })
    }
}
