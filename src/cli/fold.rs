//! `flexframe fold`: how a frame is put together, as data, as motion, and on paper.

use std::path::PathBuf;
use std::process::ExitCode;

use super::bounded::count;
use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::export::{fold_glb, fold_json};
use crate::frame::assembly::{Design, mass};
use crate::frame::fold::{FoldSequence, sweeps};
use crate::frame::mounting::{MountStep, Mounting};
use crate::report::booklet::content::Booklet;
use crate::report::booklet::{booklet_html, booklet_pdf};
use crate::report::picture::{fold_scene, mount_scene};

/// Write the assembly of a frame: steps, animation, instructions; exits 1 when it cannot be assembled.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  flexframe fold cognifly-v8 -o folds\n  flexframe fold --step 9 --png")]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Draw one step only, before and after, into `FRAME-step-N`.
    #[arg(long, value_name = "N", requires = "png", value_parser = count([1, 1000]))]
    pub step: Option<usize>,
    /// With --step: write the pictures.
    #[arg(long, requires = "step")]
    pub png: bool,
    /// Folder in which to write the folder `FRAME-fold`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// The file with the steps.
const STEPS: &str = "fold.json";

/// Writes `FRAME-fold`: the steps, the animation and the instructions; or the pictures of one step.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("folding", common);
    let design = session::design(&args.frame, common)?;
    let sequence = match FoldSequence::new(&design.frame, &design.skeleton) {
        Ok(sequence) => sequence,
        Err(error) => {
            terminal::tell(&format!("error: {} cannot be folded: {error}", design.frame.name));
            return Ok(ExitCode::from(1));
        }
    };
    let name = &design.frame.name;
    let (folder, files) = match args.step {
        Some(number) => (format!("{name}-step-{number}"), step_pictures(&design, &sequence, number)?),
        None => (format!("{name}-fold"), everything(&design, &sequence)?),
    };
    drop(working);
    let place = output::write_folder(&args.output, &folder, &files)?;
    if common.json {
        let steps = match files.iter().find(|(path, _)| path == STEPS) {
            Some((_, steps)) => steps.clone(),
            None => steps_as_json(&design, &sequence)?,
        };
        terminal::print(&String::from_utf8_lossy(&steps))?;
    } else if !common.quiet {
        let all = titles(&design, &sequence).into_iter().enumerate().map(|(at, title)| (at + 1, title));
        let lines = all.filter(|(at, _)| args.step.is_none_or(|number| number == *at));
        let lines = lines.map(|(number, (repeats, title))| format!("{number:>2}  {repeats} x  {title}\n"));
        terminal::print(&format!("{}{}: {} files\n", lines.collect::<String>(), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// All steps in their order: how often, and what.
fn titles(design: &Design, sequence: &FoldSequence) -> Vec<(usize, &'static str)> {
    let mounting = Mounting::new(design, sequence);
    let mounts = |steps: &[MountStep]| steps.iter().map(|step| (step.repeats, step.title)).collect::<Vec<_>>();
    let folds = sequence.steps.iter().map(|step| (step.repeats, step.title));
    mounts(&mounting.before).into_iter().chain(folds).chain(mounts(&mounting.after)).collect()
}

fn failed(error: std::io::Error) -> Failure {
    Failure::Machine { what: "cannot write the fold".into(), error }
}

fn steps_as_json(design: &Design, sequence: &FoldSequence) -> Result<Vec<u8>, Failure> {
    fold_json::fold_json(design, sequence, &sweeps(design, sequence)).map_err(|error| failed(error.into()))
}

/// Before and after of one step; of a mount the one picture there is.
fn step_pictures(design: &Design, sequence: &FoldSequence, number: usize) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let mounting = Mounting::new(design, sequence);
    let (before, folds) = (mounting.before.len(), sequence.steps.len());
    let mount = |step: &MountStep| vec![("mount.png".to_string(), mount_scene::mount(design, step).png())];
    let last = before + folds + mounting.after.len();
    match number.checked_sub(1) {
        Some(at) if at < before => Ok(mount(&mounting.before[at])),
        Some(at) if at < before + folds => {
            let pictures = fold_scene::step(design, sequence, at - before);
            let names: &[&str] =
                if pictures.len() == 2 { &["before.png", "after.png"] } else { &["before.png", "between.png", "after.png"] };
            Ok(names.iter().zip(&pictures).map(|(name, picture)| ((*name).to_string(), picture.png())).collect())
        }
        Some(at) if at < last => Ok(mount(&mounting.after[at - before - folds])),
        _ => Err(Failure::Usage { message: format!("there is no step {number}: steps go from 1 to {last}") }),
    }
}

fn everything(design: &Design, sequence: &FoldSequence) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let steps = steps_as_json(design, sequence)?;
    let motion = fold_glb::fold(design, sequence).map_err(|error| failed(std::io::Error::other(error)))?;
    let booklet = Booklet::new(design, &mass::table(design), sequence);
    let paper = booklet_pdf::pdf(&booklet).map_err(|error| failed(std::io::Error::other(error)))?;
    let mut files = vec![
        (STEPS.to_string(), steps),
        ("fold.glb".into(), motion),
        ("instructions.html".into(), booklet_html::html(&booklet).into_bytes()),
        ("instructions.pdf".into(), paper),
        ("exploded.png".into(), booklet.apart.png()),
    ];
    for (index, page) in booklet.pages.iter().enumerate() {
        for (at, picture) in page.pictures.iter().enumerate() {
            files.push((booklet_html::picture_name(index + 1, at, page.pictures.len()), picture.png()));
        }
    }
    files.extend(booklet.alone.iter().map(|(part, picture)| (booklet_html::part_name(part), picture.png())));
    for (panels, after) in [(&booklet.before, false), (&booklet.after, true)] {
        let named = panels.iter().enumerate().map(|(at, panel)| (booklet_html::panel_name(at, after), panel.picture.png()));
        files.extend(named);
    }
    Ok(files)
}
