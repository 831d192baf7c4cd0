//! `flexframe diagnose`: what a model lacks, from measured drops.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::bounded::{count, number, seed};
use super::candidates;
use super::failure::Failure;
use super::failure::mechanics_refused;
use super::given_drops::{compared_model, file_format, frame_and_paths, read_drops, with_body_of};
use super::options::{ChannelOption, Common, DropsOption, FormatOptions, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::figures::{PARAMETER_DIGITS, hundredths, significant};
use crate::frame::assembly::{Design, mass};
use crate::impact::diagnose::{ComparedAxes, Diagnosis, EffectEstimate, Gap, Stage, Verdict};
use crate::impact::effects::{Model, PAYLOAD_MODE};
use crate::impact::frame_fit::{CURVE_MM, reduced_model};
use crate::impact::measured::{DropSet, DropTable, StaticTest};
use crate::impact::request::{Compared, DiagnosisRequest, MOST_EFFECTS, RequestError, usual_model};
use crate::impact::sim::HEIGHTS_M;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::result::static_curve::StaticCurve;
use crate::mechanics::settings::MechanicsSettings as Mechanics;
use crate::report::data::diagnosis_data;
use crate::report::page::diagnosis_page;
use crate::report::page::document::{Block, html, markdown};

/// Find where a model and measured drops disagree, name the missing effect, add it, and report the remaining gap.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe diagnose soft_050cm soft_100cm\n  flexframe diagnose drops.csv --model paper --hold-out-heights 2.0 --max-effects 2 --seed 1 --json\n\nA preset's name or a .toml file among the drops is the frame. Its mass and gap replace those of the model.\nExit code 0: nothing is missing; 1: something is. docs/diagnosis.md explains the method."
)]
pub(super) struct Args {
    /// Which drops.
    #[command(flatten)]
    pub drops: DropsOption,
    /// Impact model: `paper`, `paper-corrected` or a TOML file; its k and c are starting values [default: `paper-corrected` for drops with
    /// lateral axes, or else `paper`].
    #[arg(long, value_name = "MODEL", add = candidates::models())]
    pub model: Option<String>,
    /// Add the static force curve of this frame to the candidates; its share is fitted to the drops.
    #[arg(long, value_name = "FRAME", add = candidates::frames())]
    pub frame: Option<String>,
    /// With --frame: file with the numbers of the mechanics, instead of the built-in ones.
    #[arg(long, value_name = "TOML", requires = "frame")]
    pub mechanics: Option<String>,
    /// Heights that no fit uses, m. The gap there shows how well the result generalises.
    #[arg(long, value_delimiter = ',', value_name = "HEIGHT,…", value_parser = number(HEIGHTS_M, "m"))]
    pub hold_out_heights: Vec<f64>,
    /// A static test of the same frame, CSV of `displacement_mm,force_n`: compared with each model, not fitted.
    #[arg(long, value_name = "CSV")]
    pub static_test: Option<PathBuf>,
    /// Covariates that may explain the variation between drops of one height: a column of the drops' tables, or a CSV file with `trial`,
    /// `height_m` if trials are numbered anew at each height, and further columns. Touch times, slope, order and session are always tested.
    #[arg(long, value_delimiter = ',', value_name = "COLUMN|CSV,…")]
    pub covariate: Vec<String>,
    /// Most effects on top of spring and damper, 1 to 3.
    #[arg(long, default_value_t = MOST_EFFECTS, value_name = "N", value_parser = count([1, MOST_EFFECTS as u32]))]
    pub max_effects: usize,
    /// Seed of the simulated data.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = seed())]
    pub seed: u64,
    /// Which axes are used.
    #[arg(long, value_enum, default_value = "auto", value_name = "CHANNEL")]
    pub channel: ChannelOption,
    /// How the files are written.
    #[command(flatten)]
    pub format: FormatOptions,
    /// Folder in which to write the folder `diagnose-MODEL`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Diagnoses drops and writes a folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    DiagnosisRequest::bounds(args.max_effects).map_err(usage)?;
    let (frame, paths) = frame_and_paths(&args.drops)?;
    let named = args.model.as_deref().map(compared_model).transpose()?;
    let most = args.max_effects;
    let working = Progress::staged("diagnosing", Stage::count(most), common);
    let (set, covariates) = drops(args, &paths)?;
    let model = named.map_or_else(|| compared_model(usual_model(&set)), Ok)?;
    let mut model = with_body_of(frame.clone(), model, common)?;
    if let Some(frame) = &args.frame {
        let own = reduced(frame, args.mechanics.as_deref(), common)?;
        model.frame_mode = own.value(PAYLOAD_MODE.id, "mu").zip(own.value(PAYLOAD_MODE.id, "f_hz")).map(|(mu, f_hz)| [mu, f_hz]);
        model.frame_curve = own.frame_curve;
    }
    let static_test = args.static_test.as_deref().map(StaticTest::read).transpose()?;
    let request = DiagnosisRequest {
        model,
        drops: &set,
        axes: args.channel.wanted(),
        hold_out_heights_m: &args.hold_out_heights,
        static_test: static_test.as_ref(),
        covariates: &covariates,
        max_effects: most,
        seed: args.seed,
    };
    let name = request.model.name.clone();
    let stage = |stage: Stage| working.stage(stage.before(most), stage.words());
    let (found, compared) = request.diagnosed(&stage).map_err(usage)?;
    let json = diagnosis_data::json(&found, &compared);
    // The steps of a design are kept: it is made once.
    let drawn = args.frame.clone().or(frame).filter(|_| compared.landing.is_some());
    let design = drawn.map(|frame| session::design(&FrameOption { frame, rigid: None }, common)).transpose()?;
    let files = files(&found, &compared, design.as_ref(), &json)?;
    drop(working);
    let place = output::write_folder(&args.output, &format!("diagnose-{name}"), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        let usual =
            if args.model.is_none() { format!("model {name}, the default for such drops; --model names another\n") } else { String::new() };
        terminal::print(&format!("{usual}{}{}: {} files\n", summary(&found, &compared), place.display(), files.len()))?;
    }
    Ok(if found.verdict == Verdict::NothingMissing { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// The drops with what else is known of them, and the names of that.
fn drops(args: &Args, paths: &[PathBuf]) -> Result<(DropSet, Vec<String>), Failure> {
    let (files, mut names): (Vec<String>, Vec<String>) =
        args.covariate.iter().cloned().partition(|given| Path::new(given).extension().is_some_and(|end| end.eq_ignore_ascii_case("csv")));
    let mut format = file_format(&args.format)?;
    format.table.kept.clone_from(&names);
    let mut set = read_drops(paths, &args.format, &format)?;
    for file in files {
        let table = DropTable::read(Path::new(&file))?;
        let (without, all) = (table.add_to(&mut set), set.records().count());
        if without == all {
            return Err(Failure::Usage { message: format!("--covariate {file}: none of its rows is of a drop that was read") });
        }
        names.extend(table.columns);
    }
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    Ok((set, names))
}

/// A frame reduced to one coordinate.
fn reduced(frame: &str, mechanics: Option<&str>, common: &Common) -> Result<Model, Failure> {
    let settings = Mechanics::load(mechanics)?;
    let design = session::design(&FrameOption { frame: frame.into(), rigid: None }, common)?;
    let masses = mass::table(&design);
    settings.doubt(&design.frame.flexible).iter().for_each(|doubt| terminal::tell(doubt));
    let quarter = FrameModel::new(&design, &masses, &settings, Extent::Quarter).map_err(mechanics_refused)?;
    let curve = StaticCurve::new(&quarter, CURVE_MM, &[]).map_err(mechanics_refused)?;
    reduced_model(&design, &masses, &quarter, &curve, &settings).map_err(mechanics_refused)
}

fn usage(error: RequestError) -> Failure {
    Failure::Usage { message: error.to_string() }
}

fn files(
    found: &Diagnosis,
    compared: &Compared,
    design: Option<&Design>,
    json: &serde_json::Value,
) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let blocks = diagnosis_page::blocks(found, compared, design)?;
    let title = diagnosis_page::title(found, compared);
    let mut files = vec![
        ("diagnosis.json".to_string(), format!("{json:#}\n").into_bytes()),
        ("report.html".to_string(), html(&title, &blocks).into_bytes()),
        ("report.md".to_string(), markdown(&title, &blocks).into_bytes()),
        ("model.toml".to_string(), diagnosis_data::model_file(found, compared).into_bytes()),
    ];
    for block in blocks {
        match block {
            Block::Figure { name, svg, .. } => files.push((format!("{name}.svg"), svg.into_bytes())),
            Block::Picture { name, png, .. } => files.push((format!("{name}.png"), png)),
            _ => {}
        }
    }
    Ok(files)
}

fn summary(found: &Diagnosis, compared: &Compared) -> String {
    let body = &found.base.model().body;
    let mut text = format!("mass {:.1} g and gap {:.1} mm of {}\n", body.mass_kg * 1e3, body.gap_m * 1e3, body.origin);
    let drops: Vec<String> = compared.drops.iter().map(|(height_m, count)| format!("{count} from {height_m} m")).collect();
    let axes = if compared.channel == ComparedAxes::All.word() { "axial and lateral" } else { compared.channel };
    text += &format!("{axes} acceleration of {}\n", drops.join(", "));
    for sentence in compared.left_out().into_iter().chain(compared.early_end()).chain(compared.free_fall()) {
        text += &format!("{sentence}\n");
    }
    for sentence in compared.observed().into_iter().chain(compared.landings()) {
        text += &format!("{sentence}\n");
    }
    text += &format!("{}\n", compared.channel_reason);
    if let Some(lateral) = &compared.lateral_axes {
        text += &format!("note: {lateral}\n");
    }
    for sentence in compared.sampling() {
        text += &format!("{sentence}\n");
    }
    text += &format!("\nverdict: {}\n", found.verdict.id());
    for reason in &found.reasons {
        text += &format!("  {reason}\n");
    }
    for sentence in compared.explained() {
        text += &format!("  {sentence}\n");
    }
    text += &gaps(found, compared);
    text += &estimates("parameter", &found.estimates);
    text += &diagnosis_data::held_rows(found)
        .into_iter()
        .map(|[name, value, why]| format!("{name:<32} {value:>10}   {why}").trim_end().to_string() + "\n")
        .collect::<String>();
    if let Some(landings) = compared.landings_beside() {
        text += &estimates(&format!("parameter of {}", landings.ids().join(" + ")), &landings.estimates);
    } else if let Some(next) = found.experiments.first() {
        text += &format!("\nnext: {} (distinguishes {} from {})\n", next.what, next.between[0], next.between[1]);
    }
    text.push('\n');
    text
}

/// Gaps without and with the effects along the vertical, and with random slopes beside them.
fn gaps(found: &Diagnosis, compared: &Compared) -> String {
    let (before, after, landings) = (&found.before, &found.after, compared.landings_beside());
    let row = |what: &str, before: &Gap, after: &Gap, beside: Option<&Gap>| {
        let beside = beside.map_or_else(String::new, |gap| format!("   {}", hundredths(gap.net_g)));
        format!("{what:<14} {:>8} {:>8} {:>8}{beside}\n", hundredths(before.net_g), hundredths(after.net_g), hundredths(before.floor_g))
    };
    let beside = landings.map_or_else(String::new, |landings| format!("   {}", landings.ids().join(" + ")));
    let head = format!("\ngap, g           before    after    floor{beside}\n");
    let fitted = row("fitted", &before.fitted, &after.fitted, landings.map(|landings| &landings.gaps.fitted));
    let note = compared.before(found).map_or(String::new(), |note| format!("{note}\n"));
    head + &fitted + &row("held out", &before.held_out, &after.held_out, landings.map(|landings| &landings.gaps.held_out)) + &note
}

/// A table of parameters with their intervals.
fn estimates(head: &str, estimates: &[EffectEstimate]) -> String {
    let mut text = format!("\n{head:<32} {:>10}   95 %\n", "value");
    for one in estimates {
        let [low, high] = one.ci95;
        let [value, low, high] = [one.value, low, high].map(|value| significant(value, PARAMETER_DIGITS));
        let (unit, bound) = (if one.unit == "1" { "" } else { one.unit }, if one.at_bound { ", at its bound" } else { "" });
        text += format!("{:<32} {value:>10}   {low} to {high} {unit}", format!("{}.{}", one.effect, one.key)).trim_end();
        text += &format!("{bound}\n");
    }
    text
}
