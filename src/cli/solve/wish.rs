//! What `solve` is asked for, read from the command line.

use super::arguments::Args;
use crate::cli::choice::{self, Choice};
use crate::cli::failure::Failure;
use crate::mechanics::settings::MechanicsSettings;
use crate::params::refusal::nearest;
use crate::params::{Frame, FrameFile};
use crate::variant::{Aim, Better, Goal, Measure, NameChoice, measure, measure_names, value_of};

/// How many goals a front may have.
const GOALS: std::ops::RangeInclusive<usize> = 2..=3;

/// What is looked for.
pub(super) enum Wanted {
    /// A frame.
    Frame {
        /// What is made small.
        aim: Aim,
        /// The measure in it.
        of: &'static Measure,
        /// What it is, for the file that is written.
        doc: String,
    },
    /// A front of these goals.
    Front(Vec<&'static Measure>),
}

impl Wanted {
    /// Reads `--minimise`, `--aim` or `--pareto`: one of them is there.
    pub fn read(args: &Args) -> Result<Self, Failure> {
        if let Some(name) = &args.minimise {
            let of = named("--minimise", name)?;
            return Ok(Self::Frame { aim: Aim::least(of), of, doc: format!("{} made small", of.doc) });
        }
        if let Some(text) = &args.aim {
            let usage = |message: String| Failure::Usage { message: format!("--aim {text}: {message}") };
            let (name, value) = text.split_once('=').ok_or_else(|| usage("give a measure and its value, such as stiffness=10".into()))?;
            let of = named("--aim", name.trim())?;
            let value = value_of(text, value, of).map_err(|error| Failure::Usage { message: format!("--aim: {error}") })?;
            return Ok(Self::Frame {
                aim: Aim::Toward(of, value),
                of,
                doc: format!("{} as near as possible to {value} {}", of.doc, of.unit),
            });
        }
        let goals = args.pareto.iter().map(|name| named("--pareto", name.trim())).collect::<Result<Vec<_>, _>>()?;
        if let Some(goal) = goals.iter().find(|goal| goal.better == Better::Neither) {
            let message = format!(
                "--pareto: neither less nor more of {} is better, so it is no goal; `--aim {}=VALUE` asks for a value, `--subject-to` for a limit",
                goal.name, goal.name
            );
            return Err(Failure::Usage { message });
        }
        let twice = goals.iter().enumerate().find(|(at, goal)| goals[..*at].iter().any(|other| other.name == goal.name));
        match twice {
            Some((_, goal)) => Err(Failure::Usage { message: format!("--pareto: {} stands there twice", goal.name) }),
            None if !GOALS.contains(&goals.len()) => {
                Err(Failure::Usage { message: "--pareto: give two or three measures, with commas between".into() })
            }
            None => Ok(Self::Front(goals)),
        }
    }

    /// The measures that it asks for.
    pub fn measures(&self) -> Vec<&'static Measure> {
        match self {
            Self::Frame { of, .. } => vec![of],
            Self::Front(goals) => goals.clone(),
        }
    }
}

fn named(option: &str, name: &str) -> Result<&'static Measure, Failure> {
    measure(name)
        .ok_or_else(|| Failure::Usage { message: format!("{option}: there is no measure `{name}`; there are {}", measure_names()) })
}

/// The limits besides the frame's.
pub(super) fn goals(args: &Args) -> Result<Vec<Goal>, Failure> {
    let goals = args.subject_to.iter().map(|text| Goal::parse(text)).collect::<Result<Vec<_>, _>>();
    goals.map_err(|error| Failure::Usage { message: format!("--subject-to: {error}") })
}

/// The mechanics' numbers, where a measure of theirs is asked for.
pub(super) fn mechanics(args: &Args, wanted: &Wanted, goals: &[Goal]) -> Result<Option<MechanicsSettings>, Failure> {
    let asked = wanted.measures().iter().any(|m| m.is_mechanics()) || goals.iter().any(|goal| goal.measure.is_mechanics());
    if args.mechanics.is_some() && !asked {
        let message =
            "--mechanics: neither aim nor goal is one of the mechanics: stiffness, design_drop.peak, .strike, .travel, .strain".into();
        return Err(Failure::Usage { message });
    }
    Ok(asked.then(|| MechanicsSettings::load(args.mechanics.as_deref())).transpose()?)
}

/// The names to choose from: `bought.battery`, or `bought.battery=battery-2s-850|battery-3s-450`.
pub(super) fn choices(args: &Args, frame: &Frame, file: &FrameFile) -> Result<Vec<NameChoice>, Failure> {
    args.choose.iter().map(|text| chosen_from(text, frame, file)).collect()
}

fn chosen_from(text: &str, frame: &Frame, file: &FrameFile) -> Result<NameChoice, Failure> {
    let usage = |message: String| Failure::Usage { message: format!("--choose {text}: {message}") };
    let (key, names) = text.split_once('=').map_or((text, None), |(key, names)| (key, Some(names)));
    let known = choice::of(key.trim(), frame, file)?
        .ok_or_else(|| usage("choose bought parts, materials or the printer by name, such as bought.battery".into()))?;
    if known.key == "base" {
        return Err(usage("another base is another frame; solve that one".into()));
    }
    let names = match names {
        None => known.names,
        Some(names) => names.split('|').map(|name| one_of(name.trim(), &known).map_err(usage)).collect::<Result<Vec<_>, _>>()?,
    };
    if let Some((_, twice)) = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name)) {
        return Err(usage(format!("{twice} stands there twice")));
    }
    Ok(NameChoice { key: known.key, names })
}

/// A name that a key can hold.
fn one_of(name: &str, known: &Choice) -> Result<String, String> {
    // What the frame cannot carry is refused by the frame, with the reason.
    if known.names.iter().chain(&known.not_carried).any(|own| own == name) || known.without && name == "none" {
        return Ok(name.into());
    }
    let near =
        nearest(name, known.names.iter().map(String::as_str)).first().map_or(String::new(), |near| format!(", did you mean `{near}`?"));
    Err(format!("there is no `{name}`{near}; there are {}", known.names.join(", ")))
}
