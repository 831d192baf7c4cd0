//! `flexframe fit`: a model's parameters from measured drops.

use std::path::PathBuf;
use std::process::ExitCode;

use super::bounded::{none_or_count, seed};
use super::candidates;
use super::failure::Failure;
use super::given_drops::{compared_model, file_format, frame_and_paths, read_drops, with_body_of};
use super::options::{ChannelOption, Common, DropsOption, FormatOptions};
use super::output;
use super::progress::Progress;
use super::terminal;
use crate::figures::{PARAMETER_DIGITS, p_value, significant};
use crate::impact::body::DropBody;
use crate::impact::diagnose::{ChannelChoice, ComparedAxes, RARE};
use crate::impact::effects::{Channel, Model};
use crate::impact::fit;
use crate::impact::fit::{Chosen, Fit, FitError, Keep, LEAST_RESAMPLED, Layout, LeftOut, Likelihood, PaperObjective};
use crate::impact::measured::DropSet;
use crate::impact::sim::{SolverOptions, System, simulate};
use crate::report::chart::fit_plots;
use crate::report::data::fit_data;

/// Fit parameters of a model to measured drops.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe fit --model paper --objective paper --free c soft_050cm soft_100cm\n  flexframe fit cognifly-v8 --model paper-corrected drops.csv --bootstrap 500 --seed 1 --json\n\nA preset's name or a .toml file among the drops is the frame. Its mass and gap replace those of the model."
)]
pub(super) struct Args {
    /// Which drops.
    #[command(flatten)]
    pub drops: DropsOption,
    /// Impact model: `paper`, `paper-corrected` or a TOML file; its k and c are starting values.
    #[arg(long, default_value = MODEL, value_name = "MODEL", add = candidates::models())]
    pub model: String,
    /// Parameters that are fitted, by their keys in the model file; the others keep their values.
    #[arg(long, value_delimiter = ',', default_value = "k,c", value_name = "KEY,…", add = candidates::parameters_of_model(MODEL))]
    pub free: Vec<String>,
    /// Objective that is minimised.
    #[arg(long, value_enum, default_value = "ml")]
    pub objective: Aim,
    /// Use flagged drops, too, also saturated ones, if they contain a whole impact. The paper's objective always does.
    #[arg(long)]
    pub all: bool,
    /// Number of bootstrap fits for the intervals, at least 19; 0 for no intervals.
    #[arg(long, default_value_t = 200, value_name = "N", value_parser = none_or_count([LEAST_RESAMPLED as u32, MOST_SAMPLES]))]
    pub bootstrap: usize,
    /// Seed of the random numbers of simulated and resampled sets.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = seed())]
    pub seed: u64,
    /// Channel that is compared. The paper's objective uses the one that the model states.
    #[arg(long, value_enum, default_value = "auto", value_name = "CHANNEL")]
    pub channel: ChannelOption,
    /// How the files are written.
    #[command(flatten)]
    pub format: FormatOptions,
    /// Folder in which to write the folder `fit-MODEL`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Objective that a fit minimises.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Aim {
    /// Negative log-likelihood: distance of the mean waves in units of their scatter.
    Ml,
    /// log(1 + sum over heights of the mean squared error up to each drop's peak), as in the paper's notebook.
    Paper,
}

impl Aim {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ml => "ml",
            Self::Paper => "paper",
        }
    }
}

/// The model that is fitted unless another is named.
const MODEL: &str = "paper-corrected";

/// Bootstrap samples at the most.
const MOST_SAMPLES: u32 = 100_000;

/// Fits and writes a folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    if args.channel == ChannelOption::All {
        let message = "--channel all: a fit compares one channel; give axial or magnitude, or use `flexframe diagnose`".into();
        return Err(Failure::Usage { message });
    }
    let (frame, paths) = frame_and_paths(&args.drops)?;
    let model = compared_model(&args.model)?;
    let working = Progress::of("fitting", common);
    let model = with_body_of(frame, model, common)?;
    let set = read_drops(&paths, &args.format, &file_format(&args.format)?)?;
    let mut layout = layout(model, &args.free)?;
    let keep = if args.objective == Aim::Paper || args.all { Keep::Every } else { Keep::Clean };
    let (chosen, reason) = chosen(args, &set, &layout.model, keep).map_err(usage)?;
    layout.model.sensor.channel = chosen.channel;
    let (fitted, numbers) = fitted(args, &chosen, &layout).map_err(usage)?;
    let warnings = warnings(&fitted);
    let run = fit_data::Run {
        fit: &fitted,
        chosen: &chosen,
        objective: args.objective.name(),
        numbers,
        bootstrap: args.bootstrap,
        seed: args.seed,
        warnings: &warnings,
    };
    let json = fit_data::json(&run);
    let mut files = fit_plots::plots(&run)?;
    files.push(("model.toml".into(), fitted.model.to_toml().into_bytes()));
    files.push(("fit.json".into(), format!("{json:#}\n").into_bytes()));
    drop(working);
    let place = output::write_folder(&args.output, &format!("fit-{}", fitted.model.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        let early = (args.objective == Aim::Ml).then(|| chosen.early_end()).flatten().map(|early| early.to_string());
        let notes: String = reason.iter().chain(&early).chain(&set.notes).map(|note| format!("note: {note}\n")).collect();
        terminal::print(&format!(
            "{}{notes}{}: {} files\n",
            table(&fitted, &chosen, args, numbers, &warnings),
            place.display(),
            files.len()
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The drops in the channel that is compared, and why it is.
fn chosen<'a>(args: &Args, set: &'a DropSet, model: &Model, keep: Keep) -> Result<(Chosen<'a>, Option<String>), FitError> {
    let wanted = args.channel.wanted();
    match args.objective {
        Aim::Paper => {
            let chosen = Chosen::of(set, wanted.map_or(model.sensor.channel, ComparedAxes::channel), keep)?;
            Ok((if chosen.channel == Channel::Magnitude { chosen.of_all_axes()? } else { chosen }, None))
        }
        Aim::Ml => ChannelChoice::of(set, model, keep, wanted).map(|choice| (choice.chosen, Some(choice.reason))),
    }
}

fn usage(error: FitError) -> Failure {
    Failure::Usage { message: error.to_string() }
}

/// Which parameters are free.
fn layout(model: Model, free: &[String]) -> Result<Layout, Failure> {
    if let Some((_, twice)) = free.iter().enumerate().find(|(at, key)| free[..*at].contains(key)) {
        return Err(Failure::Usage { message: format!("--free: {twice} stands there twice") });
    }
    let known: Vec<String> = Layout::of(model.clone()).free.iter().map(|free| free.key().to_string()).collect();
    let every = || model.effects.iter().flat_map(|listed| listed.spec.parameters).map(|parameter| parameter.key);
    if let Some(key) = free.iter().find(|key| every().all(|known| known != *key)) {
        return Err(usage(FitError::NoParameter { key: key.clone(), known: every().collect::<Vec<_>>().join(", ") }));
    }
    let keys: Vec<&str> = free.iter().map(String::as_str).collect();
    Layout::named(model, &keys).ok_or_else(|| usage(FitError::NoParameter { key: free.join(","), known: known.join(", ") }))
}

/// The fit, and how many numbers were compared where they are independent.
fn fitted(args: &Args, chosen: &Chosen, layout: &Layout) -> Result<(Fit, Option<usize>), FitError> {
    match args.objective {
        Aim::Paper => Ok((fit::fit(&PaperObjective::of(chosen)?, layout, args.bootstrap, args.seed)?, None)),
        Aim::Ml => {
            let likelihood = Likelihood::of(chosen)?;
            let fit = fit::fit(&likelihood, layout, args.bootstrap, args.seed)?;
            Ok((fit, Some(likelihood.numbers())))
        }
    }
}

/// Fewest drops a height of which a small p says that the model lacks an effect: with 5, 10 of 180 true models had one, about one in twenty, with 20 none of 60.
const FEWEST: usize = 10;

/// Distance over degrees of freedom that is no scatter of few drops: a choice.
const HOPELESS: f64 = 10.0;

/// Drops of the height that has the fewest.
fn fewest(chosen: &Chosen) -> usize {
    let own = |height_m: f64| chosen.drops.iter().filter(|drop| drop.record.height_m == height_m).count();
    chosen.drops.iter().map(|drop| own(drop.record.height_m)).min().unwrap_or(0)
}

/// What the distance says of the model, by so many drops of the height that has the fewest.
fn verdict(fit: &Fit, fewest: usize, degrees_of_freedom: usize) -> String {
    let Some(p) = fit.p else { return String::new() };
    let told = format!(", p = {} by simulated sets", p_value(p));
    // The least that so many sets can say.
    let is_least = p * (fit.resampled + 1) as f64 <= 1.5;
    match () {
        () if p < RARE && fewest < FEWEST && fit.objective[1] < HOPELESS * degrees_of_freedom as f64 => {
            format!("{told}: of so few drops ({fewest} a height) one in twenty true models seems to lack an effect; measure more to see it")
        }
        () if p < RARE => format!("{told}: the model lacks an effect"),
        () if is_least => {
            format!("{told}: none of the {} is that far off; give --bootstrap 200 to see whether the model lacks an effect", fit.resampled)
        }
        () => told,
    }
}

/// What is said below the parameters: whether intervals hold, and how the fitted model is wrong.
fn doubts(fit: &Fit, is_likelihood: bool, warnings: &[(f64, String)]) -> String {
    let mut text = String::new();
    if fit.p.is_some_and(|p| p < RARE) {
        text += "the intervals hold where the model does: `flexframe diagnose` looks for what it lacks\n";
    } else if is_likelihood && fit.resampled == 0 {
        text += "without other fits nothing is said of whether the model holds: --bootstrap 200 does\n";
    }
    for (height_m, warning) in warnings {
        text += &format!("warning  {height_m} m: {warning}\n");
    }
    text
}

/// How the fitted model is wrong, at each height.
fn warnings(fit: &Fit) -> Vec<(f64, String)> {
    let system = System::new(&fit.model);
    let of = |height_m: f64| {
        let warnings = simulate(&system, height_m, &SolverOptions::REPORT).warnings;
        warnings.into_iter().map(move |warning| (height_m, warning.to_string()))
    };
    fit.waves.iter().flat_map(|(height_m, _)| of(*height_m)).collect()
}

fn table(fit: &Fit, chosen: &Chosen, args: &Args, numbers: Option<usize>, warnings: &[(f64, String)]) -> String {
    let DropBody { mass_kg, gap_m, origin, .. } = &fit.model.body;
    let mut text = format!("mass {:.1} g and gap {:.1} mm of {origin}\n", mass_kg * 1e3, gap_m * 1e3);
    let channel = match chosen.channel {
        Channel::Axial => "acceleration along the axis",
        Channel::Magnitude if !chosen.has_all_axes() => "magnitude of the one axis there is",
        Channel::Magnitude => "magnitude of all axes",
    };
    text += &format!("{channel} of {} drops, {} left out\n", chosen.drops.len(), chosen.left_out.len());
    for LeftOut { trial, height_m, reason, .. } in &chosen.left_out {
        text += &format!("left out  {trial} from {height_m} m: {reason}\n");
    }
    if chosen.impulses_kept && args.objective == Aim::Ml && !args.all {
        text += "impossible impulses are kept: most drops of a height have one, so they are systematic\n";
    }
    let [start, end] = fit.objective;
    text += &match numbers {
        Some(numbers) => {
            let free = numbers - fit.estimates.len();
            format!(
                "\nwhitened distance of the mean waves: {start:.1}, fitted {end:.1}, {free} degrees of freedom{}\n",
                verdict(fit, fewest(chosen), free)
            )
        }
        None => format!("\nthe paper's objective: {start:.4}, fitted {end:.4}\n"),
    };
    text += &format!("\nparameter        unit              start       fitted   95 %, of {} other fits\n", fit.resampled);
    for estimate in &fit.estimates {
        let written = |value: f64| significant(value, PARAMETER_DIGITS);
        let interval = estimate.ci95.map_or("-".into(), |[low, high]| format!("{} to {}", written(low), written(high)));
        let bound = if estimate.at_bound { "   at its bound" } else { "" };
        text += &format!(
            "{:<16} {:<12} {:>10} {:>12}   {interval}{bound}\n",
            estimate.key,
            estimate.unit,
            written(estimate.start),
            written(estimate.value)
        );
    }
    text += &doubts(fit, numbers.is_some(), warnings);
    text.push('\n');
    text
}
