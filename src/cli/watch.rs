//! `flexframe watch`: what each save of a frame file changes.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use notify::{RecursiveMode, Watcher};

use super::bounded::count;
use super::cache;
use super::failure::Failure;
use super::options::{Common, FrameOption};
use super::session;
use super::terminal;
use crate::checks::Verdict;
use crate::memo::Memo;
use crate::params::LoadError;
use crate::report::page::diff_page;
use crate::variant::{Difference, Evaluation, Side};

/// Report the effect of every save of a frame file.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  flexframe watch light.toml")]
pub(super) struct Args {
    /// Which frame: a TOML file.
    #[command(flatten)]
    pub frame: FrameOption,
    /// End after this number of saves.
    #[arg(long, value_name = "N", value_parser = count([1, 1_000_000]))]
    pub saves: Option<usize>,
}

/// How long nothing has to happen before a save is over: editors write a file, or another one and rename it.
const QUIET: Duration = Duration::from_millis(40);

/// Holds the frame again at every save, with the parts that are the same as before, and says what changed; ends when it is
/// interrupted, or after so many saves.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    common.refuse_json("lines for a person until it is ended (`flexframe diff --json` compares two frames)")?;
    session::needs_file(&args.frame.frame, "watch a file")?;
    let memo = cache::memo(common);
    let (mut last, mut files) = match evaluated(&args.frame, &memo) {
        Ok((evaluation, files)) => (Some(evaluation), files),
        Err(failure @ (Failure::Machine { .. } | Failure::Input(LoadError::Unreadable { .. }))) => return Err(failure),
        Err(failure) => {
            terminal::tell(failure.render().trim_end());
            (None, vec![PathBuf::from(&args.frame.frame)])
        }
    };
    let saves = Saves::new()?;
    let mut watched = saves.follow(Vec::new(), &files)?;
    terminal::print(&format!("{}\nwatching {}\n", last.as_ref().map_or("refused".into(), state), named(&files)))?;
    let mut count = 0;
    while args.saves.is_none_or(|most| count < most) {
        let Some(saved) = saves.next(&files) else { break };
        // Some editors delete a file before they write it anew: that is no save.
        count += usize::from(files.iter().all(|file| file.exists()));
        match evaluated(&args.frame, &memo) {
            Ok((evaluation, now)) => {
                (last, files) = (Some(tell(last, evaluation, saved, common)?), now);
                watched = saves.follow(watched, &files)?;
            }
            Err(failure) => {
                terminal::tell(failure.render().trim_end());
                terminal::print(&format!("refused after {:.2} s\n", saved.elapsed().as_secs_f64()))?;
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The frame by all rules but the slow one, and the files that it is made of.
fn evaluated(option: &FrameOption, memo: &Arc<Memo>) -> Result<(Evaluation, Vec<PathBuf>), Failure> {
    let (frame, file) = session::load(option)?;
    let files = file.files.iter().map(|source| PathBuf::from(&source.name)).collect();
    let evaluation = Evaluation::quick(frame, memo).map_err(|error| session::refused(&file, &error))?;
    Ok((evaluation, files))
}

/// Says what a save changed.
fn tell(last: Option<Evaluation>, now: Evaluation, saved: Instant, common: &Common) -> Result<Evaluation, Failure> {
    let now = match last {
        Some(last) => {
            let sides = [Side { name: "before".into(), evaluation: last }, Side { name: "now".into(), evaluation: now }];
            let difference = Difference::of(&sides);
            if !common.quiet {
                terminal::print(&diff_page::changes(&difference))?;
            }
            let [_, Side { evaluation, .. }] = sides;
            evaluation
        }
        None => now,
    };
    terminal::print(&format!("{}; {:.2} s after the save\n{}", state(&now), saved.elapsed().as_secs_f64(), violations(&now)))?;
    Ok(now)
}

/// What is violated, a line each, whether it was before or not.
fn violations(evaluation: &Evaluation) -> String {
    let broken = evaluation.findings.iter().filter(|finding| finding.verdict == Verdict::Violated);
    broken.map(|finding| format!("violated: {}\n", finding.message)).collect()
}

fn state(evaluation: &Evaluation) -> String {
    let violated = evaluation.findings.iter().filter(|f| f.verdict == Verdict::Violated).count();
    let (name, mass_g) = (&evaluation.design.frame.name, evaluation.masses.total_g);
    let limits = if violated == 1 { "limit" } else { "limits" };
    format!("{name}: {mass_g:.1} g, {violated} {limits} violated (`check` moves the parts through the fold, too)")
}

fn named(files: &[PathBuf]) -> String {
    files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>().join(", ")
}

/// Saves of files, as the system reports them.
struct Saves {
    events: Receiver<notify::Result<notify::Event>>,
    watcher: std::cell::RefCell<notify::RecommendedWatcher>,
}

impl Saves {
    fn new() -> Result<Self, Failure> {
        let (sender, events) = channel();
        let watcher = notify::recommended_watcher(sender).map_err(|error| machine("cannot watch files", error))?;
        Ok(Self { events, watcher: std::cell::RefCell::new(watcher) })
    }

    /// Watches the folders of the files: an editor that renames a new file into place leaves a watch of the old one behind.
    fn follow(&self, watched: Vec<PathBuf>, files: &[PathBuf]) -> Result<Vec<PathBuf>, Failure> {
        let mut watched = watched;
        for folder in files.iter().map(|file| folder(file)) {
            if !watched.contains(&folder) {
                let done = self.watcher.borrow_mut().watch(&folder, RecursiveMode::NonRecursive);
                done.map_err(|error| machine(&format!("cannot watch {}", folder.display()), error))?;
                watched.push(folder);
            }
        }
        Ok(watched)
    }

    /// When one of the files was saved next; none when no event can come any more.
    fn next(&self, files: &[PathBuf]) -> Option<Instant> {
        let ours = |event: &notify::Result<notify::Event>| {
            let Ok(event) = event else { return false };
            !event.kind.is_access() && event.paths.iter().any(|path| files.iter().any(|file| file.file_name() == path.file_name()))
        };
        loop {
            let event = self.events.recv().ok()?;
            if !ours(&event) {
                continue;
            }
            let mut saved = Instant::now();
            loop {
                match self.events.recv_timeout(QUIET) {
                    Ok(event) if ours(&event) => saved = Instant::now(),
                    Ok(_) => {}
                    Err(RecvTimeoutError::Timeout) => return Some(saved),
                    Err(RecvTimeoutError::Disconnected) => return None,
                }
            }
        }
    }
}

fn folder(file: &Path) -> PathBuf {
    file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_path_buf()
}

fn machine(what: &str, error: notify::Error) -> Failure {
    Failure::Machine { what: what.into(), error: std::io::Error::other(error) }
}
