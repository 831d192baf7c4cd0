//! `flexframe fit`: a model's parameters from measured drops.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::arguments::{Aim, Common, FitOptions, FrameOption};
use super::measure::calibration;
use super::output;
use super::progress::Progress;
use super::session::{self, Failure};
use super::terminal;
use crate::frame::assembly::mass;
use crate::impact::body::Body;
use crate::impact::effects::{Channel, Model};
use crate::impact::fit;
use crate::impact::fit::{Chosen, Fit, Keep, Layout, LeftOut, Likelihood, Paper, Unfit};
use crate::impact::measured;
use crate::params::preset;
use crate::report::chart::fit_plots;
use crate::report::data::{drop_data, fit_data};

/// Bootstrap samples at the most.
const MOST_SAMPLES: usize = 100_000;

/// Fits and writes a folder.
pub(super) fn fit(options: &FitOptions, common: &Common) -> Result<ExitCode, Failure> {
    if options.bootstrap > MOST_SAMPLES {
        return Err(Failure::Usage { message: format!("--bootstrap takes at most {MOST_SAMPLES} samples") });
    }
    let (frame, paths) = frame_and_paths(&options.drops)?;
    let mut model = Model::load(&options.model)?;
    let working = Progress::of("fitting", common);
    if let Some(frame) = frame {
        let design = session::design(&FrameOption { frame, rigid: None })?;
        model.body = Body::of(&design, &mass::table(&design));
    }
    let set = measured::read(&paths, &calibration(&options.calibration)?)?;
    let layout = layout(model, &options.free).map_err(usage)?;
    let keep = if options.objective == Aim::Paper || options.all { Keep::Every } else { Keep::Clean };
    let chosen = Chosen::of(&set, layout.model.sensor.channel, keep).map_err(usage)?;
    let (fitted, numbers) = fitted(options, &chosen, &layout).map_err(usage)?;
    let run = fit_data::Run {
        fit: &fitted,
        chosen: &chosen,
        objective: options.objective.name(),
        numbers,
        bootstrap: options.bootstrap,
        seed: options.seed,
    };
    let json = fit_data::json(&run);
    let mut files = fit_plots::plots(&run)
        .map_err(|error| Failure::Machine { what: "cannot make the plots".into(), error: std::io::Error::other(error) })?;
    files.push(("model.toml".into(), fitted.model.to_toml().into_bytes()));
    files.push(("fit.json".into(), format!("{json:#}\n").into_bytes()));
    drop(working);
    let place = output::write_folder(&options.output, &format!("fit-{}", fitted.model.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        let notes: String = set.notes.iter().map(|note| format!("note: {note}\n")).collect();
        terminal::print(&format!("{}{notes}{}: {} files\n", table(&fitted, &chosen, options, numbers), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn usage(error: Unfit) -> Failure {
    Failure::Usage { message: error.to_string() }
}

/// A frame among the drops: a preset's name that is no path, or a TOML file.
pub(super) fn frame_and_paths(drops: &[PathBuf]) -> Result<(Option<String>, Vec<PathBuf>), Failure> {
    let is_frame = |path: &Path| {
        let name = path.to_string_lossy();
        name.ends_with(".toml") || (preset::names().any(|preset| preset == name) && !path.exists())
    };
    let (frames, paths): (Vec<PathBuf>, Vec<PathBuf>) = drops.iter().cloned().partition(|path| is_frame(path));
    if paths.is_empty() {
        return Err(Failure::Usage { message: "name the drops: .csv tables, .bin files or folders".into() });
    }
    match &frames[..] {
        [] => Ok((None, paths)),
        [frame] => Ok((Some(frame.to_string_lossy().into_owned()), paths)),
        _ => Err(Failure::Usage { message: "name one frame, or none".into() }),
    }
}

/// Which parameters are free.
fn layout(model: Model, free: &[String]) -> Result<Layout, Unfit> {
    let known: Vec<String> = Layout::of(model.clone()).free.iter().map(|free| free.key().to_string()).collect();
    let every = || model.effects.iter().flat_map(|listed| listed.spec.parameters).map(|parameter| parameter.key);
    if let Some(key) = free.iter().find(|key| every().all(|known| known != *key)) {
        return Err(Unfit::NoParameter { key: key.clone(), known: every().collect::<Vec<_>>().join(", ") });
    }
    let keys: Vec<&str> = free.iter().map(String::as_str).collect();
    Layout::named(model, &keys).ok_or_else(|| Unfit::NoParameter { key: free.join(","), known: known.join(", ") })
}

/// The fit, and how many numbers were compared where they are independent.
fn fitted(options: &FitOptions, chosen: &Chosen, layout: &Layout) -> Result<(Fit, Option<usize>), Unfit> {
    match options.objective {
        Aim::Paper => Ok((fit::fit(&Paper::of(chosen), layout, options.bootstrap, options.seed)?, None)),
        Aim::Ml => {
            let likelihood = Likelihood::of(chosen)?;
            let fit = fit::fit(&likelihood, layout, options.bootstrap, options.seed)?;
            Ok((fit, Some(likelihood.numbers())))
        }
    }
}

fn table(fit: &Fit, chosen: &Chosen, options: &FitOptions, numbers: Option<usize>) -> String {
    let Body { mass_kg, gap_m, .. } = &fit.model.body;
    let mut text = format!("mass {:.1} g and gap {:.1} mm of {}\n", mass_kg * 1e3, gap_m * 1e3, drop_data::origin(&fit.model.body));
    let channel = match fit.model.sensor.channel {
        Channel::Axial => "acceleration along the axis",
        Channel::Magnitude if chosen.lacks_axes() => "magnitude of the one axis there is",
        Channel::Magnitude => "magnitude of all axes",
    };
    text += &format!("{channel} of {} drops, {} left out\n", chosen.drops.len(), chosen.left_out.len());
    for LeftOut { trial, reason } in &chosen.left_out {
        text += &format!("left out  {trial}: {reason}\n");
    }
    if chosen.impulses_kept && options.objective == Aim::Ml && !options.all {
        text += "impossible impulses are kept: most drops of a height have one, so they are no accident of single drops\n";
    }
    let [start, end] = fit.objective;
    text += &match numbers {
        Some(numbers) => {
            let free = numbers - fit.estimates.len();
            let verdict = if end > 2.0 * free as f64 { ": far more than chance, the model lacks something" } else { "" };
            format!("\nwhitened distance of the mean waves: {start:.1}, fitted {end:.1}, {free} degrees of freedom{verdict}\n")
        }
        None => format!("\nthe paper's objective: {start:.4}, fitted {end:.4}\n"),
    };
    text += &format!("\nparameter        unit              start       fitted   95 % of {} resampled fits\n", fit.resampled);
    for estimate in &fit.estimates {
        let interval = estimate.ci95.map_or("-".into(), |[low, high]| format!("{low:.4} to {high:.4}"));
        let bound = if estimate.at_bound { "   at its bound" } else { "" };
        text +=
            &format!("{:<16} {:<12} {:>10.4} {:>12.4}   {interval}{bound}\n", estimate.key, estimate.unit, estimate.start, estimate.value);
    }
    text.push('\n');
    text
}
