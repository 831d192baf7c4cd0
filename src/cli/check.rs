//! `flexframe check`: the gate.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use super::cache;
use super::candidates;
use super::failure::{Failure, mechanics_refused};
use super::options::{Common, FrameOption, MechanicsOption};
use super::progress::Progress;
use super::session;
use super::{frame_text, frames, output, table, terminal};
use crate::checks::gate::{
    Accepted, Baseline, CheckedFrame, NO_FRAME_REMEDY, Outcome, Policy, Refused, Standing, acceptance, data, github, junit, markdown, sarif,
};
use crate::checks::{self, Finding};
use crate::frame::assembly::mass;
use crate::mechanics::settings::MechanicsSettings;
use crate::memo::Memo;
use crate::params::frame_file::read_source;
use crate::params::refusal::nearest;
use crate::params::{Frame, FrameFile, LoadError, is_of_machine};
use crate::workspace::advice;

/// Check frames against their limits; exits 1 when one is violated.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe check\n  flexframe check my-frame.toml --json\n  flexframe check 'frames/*.toml' --format github --baseline accepted.json\n\nResults are cached in FLEXFRAME_CACHE, else XDG_CACHE_HOME/flexframe, else ~/.cache/flexframe."
)]
pub(super) struct Args {
    /// Presets' names, TOML files, or patterns of files such as 'frames/**/*.toml'.
    #[arg(default_value = "cognifly", value_name = "FRAME", add = candidates::frames())]
    pub frames: Vec<String>,
    /// Material of the rigid parts instead of the frame files': a name of params/materials.toml.
    #[arg(long, value_name = "MATERIAL", add = candidates::materials())]
    pub rigid: Option<String>,
    /// Print every finding, not only what is violated and the tightest of each rule.
    #[arg(long)]
    pub all: bool,
    /// Format of the report; --json is the same as --format json.
    #[arg(long, value_enum, value_name = "FORMAT", conflicts_with = "json")]
    pub format: Option<CheckFormat>,
    /// Try changes of the frame, and propose those that clear each kind of violation. Takes seconds to two minutes.
    #[arg(long)]
    pub remedies: bool,
    /// Notes whose value exceeds its limit fail, too.
    #[arg(long)]
    pub strict: bool,
    /// A list of accepted findings: a finding fails only if it is not on the list, or is worse than there.
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Write all findings that fail now into the list of --baseline; none fails then.
    #[arg(long, requires = "baseline")]
    pub update_baseline: bool,
    /// Whether the mechanics are computed.
    #[command(flatten)]
    pub mechanics: MechanicsOption,
}

impl Args {
    /// Whether standard output is JSON.
    pub fn wants_json(&self) -> bool {
        self.format == Some(CheckFormat::Json)
    }
}

/// Format of the report of `check`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum CheckFormat {
    /// A table for a person.
    Text,
    /// Everything.
    Json,
    /// JUnit XML: one suite for each frame, one case for each rule.
    Junit,
    /// Annotations of GitHub Actions.
    Github,
    /// A page for a pull request or a job's summary.
    Markdown,
    /// SARIF 2.1.0, for code scanning.
    Sarif,
}

/// Checks frames against their limits; exits 1 when one is violated, 2 when one cannot be read.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let names = frames::expand(&args.frames)?;
    let known = baseline(args)?;
    let (baseline, former) = if args.update_baseline { (None, known) } else { (known, None) };
    let policy = Policy { strict: args.strict, baseline: baseline.as_ref(), ..Policy::default() };
    let memo = cache::memo(common);
    let mechanics = session::mechanics(&args.mechanics)?;
    let working = Progress::of("checking", common);
    let mut messages = Vec::new();
    let outcomes: Vec<Outcome> = names
        .into_iter()
        .map(|asked| {
            let result = hold(&asked, args, mechanics.as_ref(), policy, &memo).map_err(|failure| {
                messages.push(failure.render());
                refused(&failure)
            });
            Outcome { asked, result }
        })
        .collect();
    drop(working);
    for message in &messages {
        terminal::tell(message.trim_end());
    }
    if let Some(list) = baseline.as_ref().or(former.as_ref()) {
        told_apart(list, &outcomes)?;
    }
    if args.update_baseline {
        return update(args, common, outcomes, former);
    }
    say(args, common, &outcomes)?;
    if let (Some(list), Some(path)) = (&baseline, &args.baseline) {
        for done in acceptance::no_longer_failing(list, &outcomes, args.mechanics.strength) {
            terminal::tell(&unmatched(done, path));
        }
        for (frame, judged, entry) in acceptance::accepted_of_another_file(list, &outcomes) {
            let [here, there] = [&frame.file, &entry.file].map(|file| file.as_deref().unwrap_or(&frame.frame));
            let Finding { rule, subject, .. } = &judged.finding;
            let line = format!(
                "note: {here}: {} accepts {rule} of {subject} of `{}` in {there}; if that is the same frame, --update-baseline accepts it here",
                path.display(),
                frame.frame
            );
            terminal::tell(&line);
        }
    }
    Ok(ExitCode::from(outcomes.iter().map(Outcome::exit_code).max().unwrap_or(0)))
}

/// One frame's findings.
fn hold(
    asked: &str,
    args: &Args,
    mechanics: Option<&MechanicsSettings>,
    policy: Policy,
    memo: &Arc<Memo>,
) -> Result<CheckedFrame, Failure> {
    let (frame, file) = session::load(&FrameOption { frame: asked.into(), rigid: args.rigid.clone() })?;
    let found = memo.try_get("findings", &frame.name, &frame, || {
        let design = session::designed(frame.clone(), &file, memo)?;
        let masses = mass::table(&design);
        Ok::<_, Failure>((checks::check(&design, &masses), masses))
    })?;
    let (mut findings, masses) = (*found).clone();
    if let Some(settings) = mechanics {
        findings.extend(strength(frame.clone(), &file, settings, memo)?);
    }
    let listed = args.baseline.as_ref().map(|list| listed_file(asked, list));
    let policy = Policy { file: listed.as_deref(), ..policy };
    let advice = if args.remedies { advice(&file, &findings, memo) } else { Vec::new() };
    Ok(CheckedFrame::new(&frame, &file, findings, masses, policy).advised(advice))
}

/// What is to be said of an accepted finding that none of today's is.
fn unmatched(done: &Accepted, list: &Path) -> String {
    let Accepted { frame, rule, subject, .. } = done;
    if checks::CATALOGUE.iter().any(|known| known.id == *rule) {
        return format!("note: {frame}: {rule} of {subject} no longer fails; remove it from {}", list.display());
    }
    let near = nearest(rule, checks::CATALOGUE.iter().map(|known| known.id));
    let meant = near.first().map(|id| format!(" (did you mean `{id}`?)")).unwrap_or_default();
    format!("note: {frame}: there is no rule `{rule}`{meant}; its entry in {} accepts nothing", list.display())
}

/// What the design drop of the frame's own model does to it.
fn strength(frame: Frame, file: &FrameFile, settings: &MechanicsSettings, memo: &Arc<Memo>) -> Result<Vec<Finding>, Failure> {
    let design = session::designed(frame, file, memo)?;
    let masses = mass::table(&design);
    checks::design_drop(&design, &masses, settings).map_err(mechanics_refused)
}

fn refused(failure: &Failure) -> Refused {
    match failure {
        Failure::Input(error) => Refused::of_load(error),
        other => Refused { message: other.to_string(), remedy: NO_FRAME_REMEDY.into(), spot: None, machine: other.exit_code() == 3 },
    }
}

/// The list of accepted findings, when there is one to read.
fn baseline(args: &Args) -> Result<Option<Baseline>, Failure> {
    let Some(path) = args.baseline.as_ref().filter(|path| !args.update_baseline || path.exists()) else { return Ok(None) };
    let (_, source) = read_source(path.clone()).map_err(|error| no_list(path, error))?;
    let wrong = |error| Failure::Usage {
        message: format!(
            "{} is no list of accepted findings: {error}; mend it, or restore the last good one. Without a list --update-baseline writes one that accepts all that fails now",
            path.display()
        ),
    };
    // A list that is replaced still has to be one: the path may be a slip.
    Baseline::parse(&source.text).map(Some).map_err(wrong)
}

/// A list that cannot be read, which has remedies of its own.
fn no_list(path: &Path, error: LoadError) -> Failure {
    match error {
        LoadError::Refused(_) => error.into(),
        LoadError::Unreadable { error, .. } if is_of_machine(error.kind()) => {
            Failure::Machine { what: format!("cannot read {}", path.display()), error }
        }
        _ => Failure::Usage {
            message: format!("--baseline: {error}; name a list of accepted findings, or write one with --update-baseline"),
        },
    }
}

/// How a list names a frame's file: by the way from the list's folder, wherever the program runs; a preset by its name.
fn listed_file(asked: &str, list: &Path) -> String {
    if Path::new(asked).is_file() { frame_text::named_from(list, asked) } else { asked.into() }
}

/// A list that says no files knows frames by name: two of one name would answer for each other.
fn told_apart(list: &Baseline, outcomes: &[Outcome]) -> Result<(), Failure> {
    let held: Vec<(&str, &str)> = outcomes
        .iter()
        .filter_map(|outcome| outcome.result.as_ref().ok().map(|held| (held.frame.as_str(), outcome.asked.as_str())))
        .filter(|(name, _)| list.is_of_any_file(name))
        .collect();
    for (at, (name, asked)) in held.iter().enumerate() {
        if let Some((_, other)) = held[..at].iter().find(|(other, _)| other == name) {
            let message = format!(
                "--baseline: {other} and {asked} are both called `{name}`, and the list does not say of which file its findings are; \
                 give one of them another `name`"
            );
            return Err(Failure::Usage { message });
        }
    }
    Ok(())
}

/// Writes the list of what fails now; what this run says nothing about keeps its entries: frames that are not among these, rules that did not run. A
/// frame that does not read keeps the list from being written. A report for a program is printed as by any run; it then has all of them accepted.
fn update(args: &Args, common: &Common, outcomes: Vec<Outcome>, former: Option<Baseline>) -> Result<ExitCode, Failure> {
    let Some(path) = &args.baseline else { return Ok(ExitCode::SUCCESS) };
    let is_text = format(args, common) == CheckFormat::Text;
    if let Some(code) = outcomes.iter().map(Outcome::exit_code).filter(|code| *code > 1).max() {
        if !is_text {
            say(args, common, &outcomes)?;
        }
        return Ok(ExitCode::from(code));
    }
    let list = acceptance::renewed(&outcomes, args.mechanics.strength, former.as_ref());
    let failed = |error| Failure::Machine { what: format!("cannot write {}", path.display()), error };
    if let Some(parent) = path.parent().filter(|parent| !parent.as_os_str().is_empty()) {
        fs::create_dir_all(parent).map_err(failed)?;
    }
    output::replace_users_file(path, list.text().as_bytes()).map_err(failed)?;
    let written = format!("{}: written", path.display());
    match is_text {
        true if common.quiet => {}
        true => terminal::print(&(written + "\n"))?,
        false => {
            say(args, common, &outcomes.into_iter().map(Outcome::accepted).collect::<Vec<_>>())?;
            if !common.quiet {
                terminal::tell(&written);
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The format that is asked for.
fn format(args: &Args, common: &Common) -> CheckFormat {
    if common.json { CheckFormat::Json } else { args.format.unwrap_or(CheckFormat::Text) }
}

fn say(args: &Args, common: &Common, outcomes: &[Outcome]) -> Result<(), Failure> {
    let xml =
        || junit::xml(outcomes).map_err(|e| Failure::Machine { what: "cannot make the report".into(), error: std::io::Error::other(e) });
    match format(args, common) {
        CheckFormat::Text if common.quiet => {
            for held in outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok()) {
                let name = if outcomes.len() > 1 { format!("{}: ", held.frame) } else { String::new() };
                held.of(Standing::Fails).for_each(|judged| terminal::tell(&format!("{name}{}", judged.message())));
            }
            Ok(())
        }
        CheckFormat::Text => terminal::print(&text(args, outcomes)),
        CheckFormat::Json => terminal::print_json(&data::json(outcomes)),
        CheckFormat::Junit => terminal::print(&xml()?),
        CheckFormat::Github => terminal::print(&github::annotations(outcomes)),
        CheckFormat::Markdown => terminal::print(&markdown::page(outcomes)),
        CheckFormat::Sarif => terminal::print(&sarif::log(outcomes, &checks::CATALOGUE)),
    }
}

fn text(args: &Args, outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for Outcome { asked, result } in outcomes {
        if outcomes.len() > 1 {
            text += &format!("== {asked}\n");
        }
        text += &match result {
            Ok(held) => frame_text(args, held),
            Err(refused) => format!("refused: {}\n", refused.message),
        };
    }
    if outcomes.len() > 1 {
        let of = |code: u8| outcomes.iter().filter(|outcome| outcome.exit_code() == code).count();
        let (good, over, bad) = (of(0), of(1), of(2) + of(3));
        text += &format!("{} frames: {good} within their limits, {over} beyond a limit, {bad} not read\n", outcomes.len());
    }
    text
}

fn frame_text(args: &Args, held: &CheckedFrame) -> String {
    let table = if args.all { table::findings(&held.findings) } else { table::brief(&held.findings, args.strict) };
    let [fails, accepted] = [Standing::Fails, Standing::Accepted].map(|standing| held.count(standing));
    let (frame, mass_g, count) = (&held.frame, held.masses.total_g, held.findings.len());
    let known = match accepted {
        0 => String::new(),
        1 => ", 1 more is accepted".into(),
        _ => format!(", {accepted} more are accepted"),
    };
    let how = if args.strict { "violate a limit or warn" } else { "violate a limit" };
    let warn = match held.count(Standing::Warning) {
        0 => String::new(),
        1 => ", 1 warns".into(),
        warnings => format!(", {warnings} warn"),
    };
    let drop = if args.mechanics.strength { "" } else { "the drop was not simulated; --strength does it, in a second or two\n" };
    format!("{table}{frame}: {mass_g:.1} g; {fails} of {count} findings {how}{known}{warn}\n{drop}")
}
