//! `flexframe check`: the gate.

use std::fs;
use std::process::ExitCode;

use super::arguments::{CheckFormat, CheckOptions, Common, FrameOption};
use super::cache::{Cache, Kept};
use super::progress::Progress;
use super::session::{self, Failure};
use super::{frames, output, stiffness, table, terminal};
use crate::checks::gate::{Baseline, CheckedFrame, Outcome, Policy, Refused, Standing, acceptance, github, junit, markdown, sarif};
use crate::checks::{self, Finding, Tightest};
use crate::frame::assembly::mass;
use crate::mechanics::result::prediction::predict;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::frame_file::read_source;
use crate::params::{Frame, FrameFile, LoadError};

/// Holds frames against their limits; exits 1 when one is violated, 2 when one does not read.
pub(super) fn check(options: &CheckOptions, common: &Common) -> Result<ExitCode, Failure> {
    let names = frames::expand(&options.frames)?;
    let known = baseline(options)?;
    let (baseline, former) = if options.update_baseline { (None, known) } else { (known, None) };
    let policy = Policy { strict: options.strict, baseline: baseline.as_ref(), ..Policy::default() };
    let cache = Cache::new(!options.no_cache);
    let working = Progress::of("checking", common);
    let mut told = Vec::new();
    let outcomes: Vec<Outcome> = names
        .into_iter()
        .map(|asked| {
            let result = hold(&asked, options, policy, &cache).map_err(|failure| {
                told.push(failure.render());
                refused(&failure)
            });
            Outcome { asked, result }
        })
        .collect();
    drop(working);
    for message in &told {
        terminal::tell(message.trim_end());
    }
    if options.baseline.is_some() {
        told_apart(&outcomes)?;
    }
    if options.update_baseline {
        return update(options, common, &outcomes, former);
    }
    say(options, common, &outcomes)?;
    if let (Some(list), Some(path)) = (&baseline, &options.baseline) {
        for done in acceptance::no_longer_failing(list, &outcomes) {
            let line =
                format!("note: {}: {} of {} no longer fails; remove it from {}", done.frame, done.rule, done.subject, path.display());
            terminal::tell(&line);
        }
    }
    Ok(ExitCode::from(outcomes.iter().map(Outcome::exit_code).max().unwrap_or(0)))
}

/// One frame's findings, kept ones where there are any.
fn hold(asked: &str, options: &CheckOptions, policy: Policy, cache: &Cache) -> Result<CheckedFrame, Failure> {
    let (frame, file) = session::load(&FrameOption { frame: asked.into(), rigid: options.rigid.clone() })?;
    let Kept { findings, masses } = match cache.get(&frame) {
        Some(kept) => kept,
        None => {
            let design = session::designed(frame.clone(), &file)?;
            let masses = mass::table(&design);
            let kept = Kept { findings: checks::check(&design, &masses), masses };
            cache.put(&frame, &kept);
            kept
        }
    };
    let mut findings = findings;
    if let Some(settings) = session::mechanics(&options.mechanics)? {
        findings.extend(strength(frame.clone(), &file, &settings)?);
    }
    Ok(CheckedFrame::new(&frame, &file, findings, masses, policy))
}

/// What the design drop of the frame's own model does to it.
fn strength(frame: Frame, file: &FrameFile, settings: &MechanicsSettings) -> Result<Vec<Finding>, Failure> {
    let design = session::designed(frame, file)?;
    let found = predict(&design, &mass::table(&design), settings).map_err(stiffness::refused)?;
    Ok(checks::strength(&design, &settings.limits, &found))
}

fn refused(failure: &Failure) -> Refused {
    match failure {
        Failure::Input(LoadError::Refused(refusal)) => Refused::of(refusal),
        other => Refused {
            message: other.to_string(),
            remedy: "`flexframe check --help` says what a frame is".into(),
            spot: None,
            machine: other.exit_code() == 3,
        },
    }
}

/// The list of accepted findings, when there is one to read.
fn baseline(options: &CheckOptions) -> Result<Option<Baseline>, Failure> {
    let Some(path) = options.baseline.as_ref().filter(|path| !options.update_baseline || path.exists()) else { return Ok(None) };
    let (_, source) = read_source(path.clone())?;
    let wrong = |error| Failure::Usage {
        message: format!("{} is no list of accepted findings: {error}; remove it, and --update-baseline writes one", path.display()),
    };
    // A list that is replaced still has to be one: the path may be a slip.
    Baseline::parse(&source.text).map(Some).map_err(wrong)
}

/// A list knows frames by name: two of one name would answer for each other.
fn told_apart(outcomes: &[Outcome]) -> Result<(), Failure> {
    let held: Vec<(&str, &str)> = outcomes
        .iter()
        .filter_map(|outcome| outcome.result.as_ref().ok().map(|held| (held.frame.as_str(), outcome.asked.as_str())))
        .collect();
    for (at, (name, asked)) in held.iter().enumerate() {
        if let Some((_, other)) = held[..at].iter().find(|(other, _)| other == name) {
            let message = format!("--baseline: {other} and {asked} are both called `{name}`; give one of them another `name`");
            return Err(Failure::Usage { message });
        }
    }
    Ok(())
}

/// Writes the list of what fails now; frames that are not among these keep their entries. A frame that does not read keeps the list from being written.
fn update(options: &CheckOptions, common: &Common, outcomes: &[Outcome], former: Option<Baseline>) -> Result<ExitCode, Failure> {
    let Some(path) = &options.baseline else { return Ok(ExitCode::SUCCESS) };
    if let Some(code) = outcomes.iter().map(Outcome::exit_code).filter(|code| *code > 1).max() {
        return Ok(ExitCode::from(code));
    }
    let list = acceptance::renewed(outcomes, former);
    let failed = |error| Failure::Machine { what: format!("cannot write {}", path.display()), error };
    if let Some(parent) = path.parent().filter(|parent| !parent.as_os_str().is_empty()) {
        fs::create_dir_all(parent).map_err(failed)?;
    }
    output::replace_file(path, list.text().as_bytes()).map_err(failed)?;
    if !common.quiet {
        terminal::print(&format!("{}: written\n", path.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn say(options: &CheckOptions, common: &Common, outcomes: &[Outcome]) -> Result<(), Failure> {
    let format = if common.json { CheckFormat::Json } else { options.format.unwrap_or(CheckFormat::Text) };
    let xml =
        || junit::xml(outcomes).map_err(|e| Failure::Machine { what: "cannot make the report".into(), error: std::io::Error::other(e) });
    match format {
        CheckFormat::Text if common.quiet => {
            for held in outcomes.iter().filter_map(|outcome| outcome.result.as_ref().ok()) {
                let name = if outcomes.len() > 1 { format!("{}: ", held.frame) } else { String::new() };
                held.of(Standing::Fails).for_each(|judged| terminal::tell(&format!("{name}{}", judged.finding.message)));
            }
            Ok(())
        }
        CheckFormat::Text => terminal::print(&text(options, outcomes)),
        CheckFormat::Json => terminal::print_json(&json(outcomes)),
        CheckFormat::Junit => terminal::print(&xml()?),
        CheckFormat::Github => terminal::print(&github::annotations(outcomes)),
        CheckFormat::Markdown => terminal::print(&markdown::page(outcomes)),
        CheckFormat::Sarif => terminal::print(&sarif::log(outcomes, &checks::CATALOGUE)),
    }
}

fn text(options: &CheckOptions, outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for Outcome { asked, result } in outcomes {
        if outcomes.len() > 1 {
            text += &format!("== {asked}\n");
        }
        text += &match result {
            Ok(held) => frame_text(options, held),
            Err(refused) => format!("refused: {}\n", refused.message),
        };
    }
    if outcomes.len() > 1 {
        let of = |code: u8| outcomes.iter().filter(|outcome| outcome.exit_code() == code).count();
        let (good, over, bad) = (of(0), of(1), of(2) + of(3));
        text += &format!("{} frames: {good} keep their limits, {over} violate one, {bad} do not read\n", outcomes.len());
    }
    text
}

fn frame_text(options: &CheckOptions, held: &CheckedFrame) -> String {
    let findings: Vec<Finding> = held.findings.iter().map(|judged| judged.finding.clone()).collect();
    let every: Vec<Tightest> = findings.iter().map(|finding| Tightest { finding, of: 1 }).collect();
    let table = table::findings(&if options.all { every } else { checks::tightest(&findings) });
    let [fails, accepted] = [Standing::Fails, Standing::Accepted].map(|standing| held.count(standing));
    let (frame, mass_g, count) = (&held.frame, held.masses.total_g, findings.len());
    let known = if accepted > 0 { format!(", {accepted} more are accepted") } else { String::new() };
    let how = if options.strict { "violate a limit or warn" } else { "violate a limit" };
    format!("{table}{frame}: {mass_g:.1} g; {fails} of {count} findings {how}{known}\n")
}

fn json(outcomes: &[Outcome]) -> serde_json::Value {
    let finding = |judged: &crate::checks::gate::Judged| {
        let mut value = serde_json::json!(judged.finding);
        value["fails"] = (judged.standing == Standing::Fails).into();
        value["accepted"] = (judged.standing == Standing::Accepted).into();
        let place = |spot: &crate::checks::gate::Spot| serde_json::json!({ "file": spot.file, "line": spot.line, "column": spot.column, "key": spot.key });
        value["places"] = judged.spots.iter().map(place).collect::<Vec<_>>().into();
        value
    };
    let frame = |outcome: &Outcome| match &outcome.result {
        Ok(held) => serde_json::json!({
            "asked": outcome.asked,
            "frame": held.frame,
            "violations": held.count(Standing::Fails),
            "findings": held.findings.iter().map(finding).collect::<Vec<_>>(),
            "masses": held.masses,
        }),
        Err(refused) => {
            let place =
                refused.spot.as_ref().map(|spot| serde_json::json!({ "file": spot.file, "line": spot.line, "column": spot.column }));
            serde_json::json!({ "asked": outcome.asked, "refused": refused.message, "remedy": refused.remedy, "place": place })
        }
    };
    serde_json::json!({ "schema_version": 2, "frames": outcomes.iter().map(frame).collect::<Vec<_>>() })
}
