//! `flexframe diagnose`: what a model lacks, from measured drops.

use std::process::ExitCode;

use super::arguments::{Common, DiagnoseOptions, FrameOption};
use super::fit::frame_and_paths;
use super::frame_reduction::{self, PRESSED_MM};
use super::measure::calibration;
use super::output;
use super::progress::Progress;
use super::session::{self, Failure};
use super::stiffness::refused;
use super::terminal;
use crate::frame::assembly::mass;
use crate::impact::body::Body;
use crate::impact::diagnose;
use crate::impact::diagnose::{Diagnosis, Settings, Stage, Verdict, observables};
use crate::impact::effects::{Channel, Model};
use crate::impact::fit::{Chosen, Keep, Unfit, Waves};
use crate::impact::measured;
use crate::impact::measured::{Fall, StaticTest};
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::result::static_curve::StaticCurve;
use crate::mechanics::settings::MechanicsSettings as Mechanics;
use crate::report::data::diagnosis_data;
use crate::report::data::diagnosis_data::{Compared, Pressed};
use crate::report::data::drop_data;
use crate::report::data::own_mode::OwnMode;
use crate::report::page::diagnosis_page;
use crate::report::page::document::{Block, html, markdown};

/// Diagnoses drops and writes a folder.
pub(super) fn diagnose(options: &DiagnoseOptions, common: &Common) -> Result<ExitCode, Failure> {
    if !(1..=3).contains(&options.max_effects) {
        return Err(Failure::Usage { message: format!("--max-effects {} is out of bounds: give 1, 2 or 3", options.max_effects) });
    }
    let (frame, paths) = frame_and_paths(&options.drops)?;
    let mut model = Model::load(&options.model)?;
    let most = options.max_effects;
    let working = Progress::staged("diagnosing", Stage::count(most), common);
    if let Some(frame) = frame {
        let design = session::design(&FrameOption { frame, rigid: None })?;
        model.body = Body::of(&design, &mass::table(&design));
    }
    if let Some(frame) = &options.frame {
        let own = reduced(frame, options.mechanics.as_deref())?;
        model.frame_mode = own.value("payload_mode", "mu").zip(own.value("payload_mode", "f_hz")).map(|(mu, f_hz)| [mu, f_hz]);
        model.frame_curve = own.frame_curve;
    }
    let set = measured::read(&paths, &calibration(&options.calibration)?)?;
    let pressed = options.static_test.as_deref().map(StaticTest::read).transpose()?;
    let (waves, mut compared) = compared(&set, &mut model, options).map_err(usage)?;
    let held = |height_m: f64| options.hold_out_heights.iter().any(|out| (out - height_m).abs() < 1e-6);
    if let Some(unknown) =
        options.hold_out_heights.iter().find(|out| waves.groups.iter().all(|group| (group.height_m - **out).abs() >= 1e-6))
    {
        let heights: Vec<String> = waves.groups.iter().map(|group| group.height_m.to_string()).collect();
        return Err(Failure::Usage {
            message: format!("--hold-out-heights {unknown}: there is no drop from there, only from {} m", heights.join(", ")),
        });
    }
    let (fitted, held_out) = (waves.only(|height_m| !held(height_m)), waves.only(held));
    if fitted.groups.is_empty() {
        return Err(Failure::Usage { message: "--hold-out-heights leaves no height to fit".into() });
    }
    let settings = Settings { most_effects: most, seed: options.seed };
    let held_out = (!held_out.groups.is_empty()).then_some(&held_out);
    let stage = |stage: Stage| working.stage(stage.before(most), stage.words());
    let found =
        diagnose::watched(&fitted, held_out, &model, &settings, &stage).map_err(|error| Failure::Usage { message: error.to_string() })?;
    compared.own_mode = model.frame_mode.map(|mode| OwnMode::of(mode, &found));
    compared.static_test = pressed.map(|test| Pressed::of(&test, &found));
    let json = diagnosis_data::json(&found, &compared);
    let files = files(&found, &compared, &json)?;
    drop(working);
    let place = output::write_folder(&options.output, &format!("diagnose-{}", model.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}{}: {} files\n", summary(&found, &compared), place.display(), files.len()))?;
    }
    Ok(if found.verdict == Verdict::NothingMissing { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// A frame reduced to one coordinate.
fn reduced(frame: &str, mechanics: Option<&str>) -> Result<Model, Failure> {
    let settings = Mechanics::load(mechanics)?;
    let design = session::design(&FrameOption { frame: frame.into(), rigid: None })?;
    let masses = mass::table(&design);
    let quarter = FrameModel::new(&design, &masses, &settings, Extent::Quarter).map_err(refused)?;
    let curve = StaticCurve::new(&quarter, PRESSED_MM, &[]).map_err(refused)?;
    frame_reduction::model(&design, &masses, &quarter, &curve, &settings)
}

fn usage(error: Unfit) -> Failure {
    Failure::Usage { message: error.to_string() }
}

fn word(channel: Channel) -> &'static str {
    match channel {
        Channel::Axial => "axial",
        Channel::Magnitude => "magnitude",
    }
}

/// The drops in the channel that can be compared, and how it was chosen: a magnitude whose impulse no vertical impact has
/// holds sideways motion, so the axis is taken where it was measured.
fn compared(set: &measured::DropSet, model: &mut Model, options: &DiagnoseOptions) -> Result<(Waves, Compared), Unfit> {
    let stated = model.sensor.channel;
    let mut chosen = Chosen::of(set, stated, Keep::Evidence)?;
    let mut reason = None;
    if stated == Channel::Magnitude && chosen.lacks_axes() {
        reason = Some("the drops hold one axis only, so that is compared".to_string());
        chosen.channel = Channel::Axial;
    } else if stated == Channel::Magnitude {
        let impossible: Vec<String> = observables(&chosen.waves()?, model)
            .iter()
            .filter(|one| one.impossible)
            .map(|one| format!("{:.2} ± {:.2} v0 at {} m, at most {:.2}", one.impulse_over_v0, one.error, one.height_m, one.most))
            .collect();
        if !impossible.is_empty() {
            reason = Some(format!(
                "the magnitude's impulse is impossible for a vertical impact ({}): it holds sideways motion, so the axis is compared instead",
                impossible.join("; ")
            ));
            chosen.channel = Channel::Axial;
        }
    }
    model.sensor.channel = chosen.channel;
    let waves = chosen.waves()?;
    let compared = Compared {
        channel: word(chosen.channel),
        stated_channel: word(stated),
        channel_reason: reason,
        drops: waves.groups.iter().map(|group| (group.height_m, group.windows.len())).collect(),
        left_out: chosen.left_out.iter().map(|left| (left.trial.clone(), left.reason.clone())).collect(),
        held_out_heights_m: options.hold_out_heights.clone(),
        seed: options.seed,
        falls: Fall::of(set),
        static_test: None,
        own_mode: None,
    };
    Ok((waves, compared))
}

fn files(found: &Diagnosis, compared: &Compared, json: &serde_json::Value) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let blocks = diagnosis_page::blocks(found, compared)
        .map_err(|error| Failure::Machine { what: "cannot make the plots".into(), error: std::io::Error::other(error) })?;
    let title = diagnosis_page::title(found);
    let mut files = vec![
        ("diagnosis.json".to_string(), format!("{json:#}\n").into_bytes()),
        ("report.html".to_string(), html(&title, &blocks).into_bytes()),
        ("report.md".to_string(), markdown(&title, &blocks).into_bytes()),
        ("model.toml".to_string(), found.chosen.model().to_toml().into_bytes()),
    ];
    for block in blocks {
        if let Block::Figure { name, svg, .. } = block {
            files.push((format!("{name}.svg"), svg.into_bytes()));
        }
    }
    Ok(files)
}

fn summary(found: &Diagnosis, compared: &Compared) -> String {
    let body = &found.base.model().body;
    let mut text = format!("mass {:.1} g and gap {:.1} mm of {}\n", body.mass_kg * 1e3, body.gap_m * 1e3, drop_data::origin(body));
    let drops: Vec<String> = compared.drops.iter().map(|(height_m, count)| format!("{count} from {height_m} m")).collect();
    text += &format!("{} acceleration of {}\n", compared.channel, drops.join(", "));
    for sentence in compared.observed() {
        text += &format!("{sentence}\n");
    }
    if let Some(reason) = &compared.channel_reason {
        text += &format!("{reason}\n");
    }
    text += &format!("\nverdict: {}\n", found.verdict.id());
    for reason in &found.reasons {
        text += &format!("  {reason}\n");
    }
    let (before, after) = (&found.before, &found.after);
    text += &format!(
        "\ngap, g           before    after    floor\nfitted         {:>8.2} {:>8.2} {:>8.2}\nheld out       {:>8.2} {:>8.2} {:>8.2}\n",
        before.fitted.net_g,
        after.fitted.net_g,
        before.fitted.floor_g,
        before.held_out.net_g,
        after.held_out.net_g,
        before.held_out.floor_g
    );
    text += "\nparameter                             value   95 %\n";
    for one in &found.estimates {
        let [low, high] = one.ci95;
        text += &format!("{:<32} {:>10.4}   {low:.4} to {high:.4} {}\n", format!("{}.{}", one.effect, one.key), one.value, one.unit);
    }
    if let Some(next) = found.experiments.first() {
        text += &format!("\nnext: {} (tells {} from {})\n", next.what, next.between[0], next.between[1]);
    }
    text.push('\n');
    text
}
