//! `flexframe stiffness`: what the frame's own geometry says about pressing it down.

use std::path::PathBuf;
use std::process::ExitCode;

use super::candidates;
use super::failure::{Failure, mechanics_refused};
use super::options::{Common, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::checks;
use crate::export::deformed_glb;
use crate::frame::assembly::mass::MassTable;
use crate::frame::assembly::{Design, mass};
use crate::impact::frame_fit::reduced_model;
use crate::impact::measured::read_static_test;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::parts::parts_plan::part_models;
use crate::mechanics::result::calibration::{Calibration, calibrate, rms_n};
use crate::mechanics::result::deformed::Bound;
use crate::mechanics::result::ratio::{Ratio, ratios};
use crate::mechanics::result::static_curve::{DOWN_MM, INSIDE_MM, MOST_DOWN_MM, StaticCurve};
use crate::mechanics::settings::MechanicsSettings;
use crate::mechanics::solve::modes::{Modes, REPORTED};
use crate::report::chart::stiffness_plots;
use crate::report::data::beam_model_data;
use crate::report::data::stiffness_data;
use crate::report::data::stiffness_data::Stiffness;
use crate::report::picture::deformed_scene;
use crate::report::picture::image::View;

/// Compute the stiffness of a frame from its geometry: force over displacement, distribution of energy, strains, modes.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe stiffness cognifly-v8 --compare params/static/cognifly-v8.csv\n  flexframe stiffness cognifly-v8 --calibrate params/static/cognifly-v8.csv\n  flexframe stiffness my-frame.toml --mechanics out/cognifly-v8-stiffness/mechanics.toml\n\nA static test is a CSV table with the columns displacement_mm,force_n. docs/mechanics.md describes the model."
)]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// TOML file with the numbers of the mechanics, instead of the built-in ones.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// Fit the flexible material's modulus to a static test; the result goes into mechanics.toml.
    #[arg(long, value_name = "CSV", conflicts_with = "compare")]
    pub calibrate: Option<PathBuf>,
    /// Compare the curve with a static test.
    #[arg(long, value_name = "CSV")]
    pub compare: Option<PathBuf>,
    /// Report ratios to another frame of the same material, a preset's name or a TOML file, each with its band over the guesses of the
    /// mechanics. Takes some ten seconds.
    #[arg(long, value_name = "FRAME", add = candidates::frames())]
    pub reference: Option<String>,
    /// How far the centre is pressed down, mm; farther where a test that it is compared with went farther.
    #[arg(long, default_value_t = DOWN_MM, value_name = "MM", value_parser = down_mm)]
    pub down: f64,
    /// Leave out the modes.
    #[arg(long)]
    pub no_modes: bool,
    /// Write beam-model.json, too: nodes, beams, ties, feet, curve and modes, for programs of finite elements.
    #[arg(long)]
    pub beam_model: bool,
    /// Leave out pictures and animations.
    #[arg(long)]
    pub no_pictures: bool,
    /// Folder in which to write the folder `FRAME-stiffness`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// A displacement within its bounds: 2 to 60 mm.
fn down_mm(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(down) if (2.0..=MOST_DOWN_MM).contains(&down) => Ok(down),
        _ => Err(format!("give 2 to {MOST_DOWN_MM} mm")),
    }
}

/// Largest displacement of a mode in pictures, mm.
const SWING_MM: f64 = 15.0;
/// Length of an animation, s.
const ANIMATED_S: f64 = 4.0;

/// Pictures and animations of the frame pressed down and in its modes.
fn deformed_files(
    design: &Design,
    bound: &Bound,
    whole: &FrameModel,
    quarter: &FrameModel,
    curve: &StaticCurve,
    modes: Option<&Modes>,
) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let failed = |error| Failure::Machine { what: "cannot write the animation".into(), error: std::io::Error::other(error) };
    let rest = bound.deformed(&whole.system.rest());
    let mut files = Vec::new();
    let shapes: Vec<_> = curve.states.iter().map(|(_, state)| bound.deformed(&whole.unfolded(quarter, state))).collect();
    let pictures = deformed_scene::pictures_on_ground(design, &shapes, View::Right);
    // 16 mm and 16.3 mm are two pictures.
    let named = |down_mm: f64| if down_mm.fract() == 0.0 { format!("{down_mm:02.0}") } else { format!("{down_mm}") };
    let named = |((down_mm, _), picture): (&(f64, _), Vec<u8>)| (format!("pictures/down_{}_mm.png", named(*down_mm)), picture);
    files.extend(curve.states.iter().zip(pictures).map(named));
    // One shape after the other, and back.
    let count = shapes.len();
    let stops: Vec<usize> = (0..=count).chain((0..count).rev()).collect();
    let weights = |stop: usize| (1..=count).map(|at| if at == stop { 1.0 } else { 0.0 }).collect();
    let step_s = ANIMATED_S / stops.len().max(2) as f64;
    let keys: Vec<deformed_glb::Key> = stops.iter().enumerate().map(|(at, stop)| (step_s * at as f64, weights(*stop))).collect();
    files.push(("pressed.glb".into(), deformed_glb::deformed(design, "the centre pressed down", &rest, &shapes, &keys).map_err(failed)?));
    let Some(modes) = modes else { return Ok(files) };
    for (at, mode) in modes.modes.iter().enumerate() {
        let bodies = bound.deformed(&modes.state(mode, SWING_MM));
        let name = format!("mode_{}_{:.0}_hz", at + 1, mode.frequency_hz);
        files.push((format!("pictures/{name}.png"), deformed_scene::picture(design, &bodies, View::Perspective)));
        let most = modes.modes.iter().all(|other| other.share_up <= mode.share_up);
        if most {
            let turn = |at: i32| std::f64::consts::TAU * f64::from(at) / 16.0;
            let keys: Vec<deformed_glb::Key> = (0..=32).map(|at| (ANIMATED_S * f64::from(at) / 32.0, vec![libm::sin(turn(at))])).collect();
            files.push((format!("{name}.glb"), deformed_glb::deformed(design, &name, &rest, &[bodies], &keys).map_err(failed)?));
        }
    }
    Ok(files)
}

/// A reference's name, and the frame's ratios to it.
fn reference(
    name: &str,
    design: &Design,
    masses: &MassTable,
    [stated, settings]: [&MechanicsSettings; 2],
) -> Result<(String, Vec<Ratio>), Failure> {
    let (frame, file) = session::load(&FrameOption { frame: name.into(), rigid: None })?;
    let other = session::designed(frame, &file, &design.memo)?;
    let weighed = mass::table(&other);
    let [own, others] = [design, &other].map(|design| &design.frame.flexible);
    let moduli = own.material.tensile_modulus_mpa.zip(others.material.tensile_modulus_mpa);
    if moduli.is_some_and(|(own, others)| own != others) {
        terminal::tell(&format!(
            "{} is of {}, {} of {}: ratios contain that of their moduli, and bands leave out how well it is known",
            design.frame.name, own.name, other.frame.name, others.name
        ));
    }
    stated.doubt(others).iter().for_each(|doubt| terminal::tell(doubt));
    let found = ratios((design, masses), (&other, &weighed), settings).map_err(mechanics_refused)?;
    Ok((other.frame.name.clone(), found))
}

/// Head of the file of numbers.
fn remark(frame: &str, calibration: Option<&Calibration>) -> String {
    let Some(Calibration { settings, interval_mpa: [low, high], rms_n, points, .. }) = calibration else {
        return "The numbers that this result was computed with.".into();
    };
    format!(
        "Calibrated on a static test of {frame}: E = {:.1} MPa, 95 % interval {low:.1} to {high:.1} MPa, rms {rms_n:.2} N over {points} points above 0 mm.\n\
         Holds for this material and print together with the joints' numbers below.",
        settings.young_mpa
    )
}

/// Presses a frame down and writes its folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let stated = MechanicsSettings::load(args.mechanics.as_deref())?;
    let path = args.calibrate.as_ref().or(args.compare.as_ref());
    let measured = path.map(|path| read_static_test(path)).transpose()?;
    let working = Progress::of("pressing", common);
    let design = session::design(&args.frame, common)?;
    let masses = mass::table(&design);
    let mut settings = stated.for_material(&design.frame.flexible.material);
    let parts = part_models(&design, &settings).map_err(mechanics_refused)?;
    let mut calibration: Option<Calibration> = None;
    if let Some(points) = measured.as_ref().filter(|_| args.calibrate.is_some()) {
        let found = calibrate(&design, &parts, &masses, &settings, points).map_err(mechanics_refused)?;
        settings = found.settings.clone();
        calibration = Some(found);
    }
    let quarter = FrameModel::of_parts(&design, &parts, &masses, &settings, Extent::Quarter).map_err(mechanics_refused)?;
    // As far as was measured, too: what is not reached is not compared.
    let farthest_mm = measured.iter().flatten().map(|[x, _]| *x).fold(args.down, f64::max);
    let curve = StaticCurve::new(&quarter, farthest_mm.min(MOST_DOWN_MM), &INSIDE_MM).map_err(mechanics_refused)?;
    let whole = FrameModel::of_parts(&design, &parts, &masses, &settings, Extent::Whole).map_err(mechanics_refused)?;
    let modes = if args.no_modes { None } else { Some(Modes::new(&whole, REPORTED).map_err(mechanics_refused)?) };
    let reference = args.reference.as_ref().map(|name| reference(name, &design, &masses, [&stated, &settings])).transpose()?;
    let rms = measured.as_ref().and_then(|points| rms_n(&curve, points));
    let found = Stiffness {
        frame: &design.frame.name,
        settings: &settings,
        curve: &curve,
        gap_mm: checks::ground_clearance(&design, &masses).map(|ground| ground.clearance_mm),
        modes: modes.as_ref(),
        measured: measured.as_deref().unwrap_or(&[]),
        rms_n: rms,
        calibrated: calibration.is_some(),
        ratios: reference.as_ref().map(|(name, ratios)| (name.as_str(), ratios.as_slice())),
    };
    let json = stiffness_data::json(&found);
    let mut files = stiffness_plots::plots(&found)?;
    files.push(("curve.csv".into(), stiffness_data::curve_csv(&found)?.into_bytes()));
    files.push(("stiffness.json".into(), format!("{json:#}\n").into_bytes()));
    if args.beam_model {
        let model = beam_model_data::json(&design.frame.name, &quarter, &curve, &whole, modes.as_ref());
        files.push(("beam-model.json".into(), format!("{model}\n").into_bytes()));
    }
    let remark = remark(&design.frame.name, calibration.as_ref());
    if let Some(bound) = Bound::new(&design, &whole).filter(|_| !args.no_pictures) {
        files.extend(deformed_files(&design, &bound, &whole, &quarter, &curve, modes.as_ref())?);
    }
    let reduced = reduced_model(&design, &masses, &quarter, &curve, &settings).map_err(mechanics_refused)?;
    files.push(("model.toml".into(), reduced.to_toml().into_bytes()));
    files.push(("mechanics.toml".into(), settings.to_toml(&remark).into_bytes()));
    drop(working);
    settings.doubt(&design.frame.flexible).iter().for_each(|doubt| terminal::tell(doubt));
    let place = output::write_folder(&args.output, &format!("{}-stiffness", design.frame.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}{}: {} files\n", stiffness_data::table(&found), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}
