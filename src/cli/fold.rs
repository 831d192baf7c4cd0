//! `flexframe fold`: how a frame is put together, as data, as motion, and on paper.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use rayon::prelude::*;
use serde_json::Value;

use super::bounded::count;
use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::checks::{Cost, FOLD_SEQUENCE, Finding, Verdict, check, check_by};
use crate::export::{fold_glb, fold_json};
use crate::frame::assembly::{Design, mass};
use crate::frame::fold::{FoldSequence, sweeps};
use crate::report::booklet::content::{AllSteps, Booklet};
use crate::report::booklet::{booklet_html, booklet_pdf};
use crate::report::picture::fold_scene::Picture;

/// Write the assembly of a frame: steps, animation, instructions; exits 1 when it cannot be assembled.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe fold cognifly-v8 -o folds\n  flexframe fold --step 15\n  flexframe fold --step 15 --png")]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Tell one step only: what to take, what to do, what to take care of.
    #[arg(long, value_name = "N", value_parser = count([1, 1000]))]
    pub step: Option<usize>,
    /// With --step: write its pictures, too, into `FRAME-step-N`.
    #[arg(long, requires = "step")]
    pub png: bool,
    /// Folder in which to write the folder `FRAME-fold`, or with --png `FRAME-step-N`; `out` if not given.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

impl Args {
    fn folder(&self) -> &Path {
        self.output.as_deref().unwrap_or(Path::new("out"))
    }
}

/// Width of what is printed.
const COLUMNS: usize = 80;

/// The file with the steps.
const STEPS: &str = "fold.json";

/// Writes `FRAME-fold`: the steps, the animation and the instructions; or tells one step.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    if args.step.is_some() && !args.png && args.output.is_some() {
        return Err(Failure::Usage { message: "--step alone writes nothing: give --png, too, or leave -o out".into() });
    }
    let working = Progress::of("folding", common);
    let design = session::design(&args.frame, common)?;
    let sequence = match FoldSequence::new(&design.frame, &design.skeleton) {
        Ok(sequence) => sequence,
        Err(error) => return Err(Failure::Impossible { message: format!("{} cannot be folded: {error}", design.frame.name) }),
    };
    let broken = broken(&design);
    if let Some(number) = args.step {
        one_step(args, common, &AllSteps::new(&design, &sequence), number, working)?;
        return Ok(told(&broken, &args.frame.frame));
    }
    let files = everything(&design, &sequence)?;
    drop(working);
    let place = output::write_folder(args.folder(), &format!("{}-fold", design.frame.name), &files)?;
    if common.json {
        let steps = files.iter().find(|(path, _)| path == STEPS).map_or_else(Cow::default, |(_, steps)| String::from_utf8_lossy(steps));
        terminal::print(&steps)?;
    } else if !common.quiet {
        let all = AllSteps::new(&design, &sequence).titles().into_iter().enumerate();
        let lines = all.map(|(at, (repeats, title))| format!("{:>2}  {repeats} x  {title}\n", at + 1));
        terminal::print(&format!("{}{}: {} files\n", lines.collect::<String>(), place.display(), files.len()))?;
    }
    Ok(told(&broken, &args.frame.frame))
}

/// What is wrong with the sequence: a step in whose way something is, a notch that is too narrow, parts that do not lie flat.
fn broken(design: &Design) -> Vec<Finding> {
    let found = check_by(&[&FOLD_SEQUENCE], Cost::Slow, design, &mass::table(design));
    found.into_iter().filter(|finding| finding.verdict == Verdict::Violated).collect()
}

/// Says on standard error what is wrong, and with the exit code that something is.
fn told(broken: &[Finding], frame: &str) -> ExitCode {
    for finding in broken {
        terminal::tell(&format!(
            "VIOLATED {}: {}; `flexframe check {frame} --remedies` looks for what helps",
            finding.rule, finding.message
        ));
    }
    if broken.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) }
}

/// Tells one step, as its page does, and writes its pictures where they are asked for.
fn one_step(args: &Args, common: &Common, all: &AllSteps, number: usize, working: Progress) -> Result<(), Failure> {
    let last = all.titles().len();
    let step =
        all.one(number).ok_or_else(|| Failure::Usage { message: format!("there is no step {number}: steps go from 1 to {last}") })?;
    let files: Vec<(String, Vec<u8>)> =
        if args.png { step.pictures().into_iter().map(|(name, picture)| (beside(&name), picture.png())).collect() } else { Vec::new() };
    drop(working);
    let mut told: String = if common.json {
        let mut steps: Value = serde_json::from_slice(&steps_as_json(all.design, all.fold)?).map_err(|error| failed(error.into()))?;
        let mut step = steps["steps"][number - 1].take();
        step["schema_version"] = steps["schema_version"].take();
        format!("{step:#}\n")
    } else {
        step.paragraphs().iter().map(|line| textwrap::fill(line, COLUMNS) + "\n").collect()
    };
    if args.png {
        let place = output::write_folder(args.folder(), &format!("{}-step-{number}", all.design.frame.name), &files)?;
        if !common.quiet && !common.json {
            told += &format!("{}: {} files\n", place.display(), files.len());
        }
    }
    terminal::print(&told)
}

/// The name of a step's picture without the folder that it has among the others.
fn beside(name: &str) -> String {
    name.rsplit('/').next().unwrap_or(name).into()
}

fn failed(error: std::io::Error) -> Failure {
    Failure::Machine { what: "cannot write the fold".into(), error }
}

fn steps_as_json(design: &Design, sequence: &FoldSequence) -> Result<Vec<u8>, Failure> {
    fold_json::fold_json(design, sequence, &sweeps(design, sequence)).map_err(|error| failed(error.into()))
}

/// Every picture of the instructions, by the name of its file.
fn named_pictures(booklet: &Booklet) -> Vec<(String, &Picture)> {
    let mut pictures = vec![("exploded.png".to_string(), &booklet.apart)];
    pictures.extend(booklet.pages.iter().flat_map(|page| page.picture_names().into_iter().zip(&page.pictures)));
    pictures.extend(booklet.alone.iter().map(|(part, picture)| (booklet_html::part_name(part), picture)));
    pictures.extend(booklet.assemblies.iter().map(|of| (booklet_html::assembly_name(of.name), &of.picture)));
    pictures.extend(booklet.before.iter().chain(&booklet.after).map(|panel| (panel.picture_name(), &panel.picture)));
    pictures
}

fn instructions(design: &Design, sequence: &FoldSequence) -> Booklet {
    let masses = mass::table(design);
    Booklet::new(design, &masses, sequence, &check(design, &masses))
}

fn everything(design: &Design, sequence: &FoldSequence) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let steps = steps_as_json(design, sequence)?;
    // The steps come first: the booklet reads what was compared for them.
    let (motion, booklet) = rayon::join(|| fold_glb::fold(design, sequence), || instructions(design, sequence));
    let pictures = named_pictures(&booklet);
    let ((page, paper), encoded) = rayon::join(
        || rayon::join(|| booklet_html::html(&booklet), || booklet_pdf::pdf(&booklet)),
        || pictures.into_par_iter().map(|(name, picture)| (name, picture.png())).collect::<Vec<_>>(),
    );
    let mut files = vec![
        (STEPS.to_string(), steps),
        ("fold.glb".into(), motion.map_err(|error| failed(std::io::Error::other(error)))?),
        ("instructions.html".into(), page.into_bytes()),
        ("instructions.pdf".into(), paper.map_err(|error| failed(std::io::Error::other(error)))?),
    ];
    files.extend(encoded);
    Ok(files)
}
