//! What a frame file asks for beyond its base, and frames that keep it.
//!
//! A key that a file of the user's states is a wish. A remedy that takes it back is none that a person looks for: what has to follow from the
//! wish is. Two things are tried: the presets, each with the wishes put onto it, and, as that takes longest, rods and motor positions that move
//! together.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::checks::{self, Cost, Rule, Verdict};
use crate::figures::decimals;
use crate::frame::assembly::{Design, mass};
use crate::memo::Memo;
use crate::params::frame_file::{Entry, Value};
use crate::params::{Frame, FrameFile, preset};
use crate::variant::{Request, SearchProgress, Vary, create, movable};

/// Frames that the search for what has to move together looks at, at the most; each takes about a second of processor time. Where there is such a
/// frame, it is found among the first three (docs/performance.md, search); where there is none, all of them are looked at.
const MOST: usize = 12;
/// How many more it looks at once one keeps every limit: rods that are nearer to the frame's own are welcome, but not awaited.
const NEARER: usize = 6;

/// The wishes of a frame file.
pub(super) struct Wishes<'a> {
    file: &'a FrameFile,
    /// The frame that they are put onto; none where a file of the user's is the base.
    base: Option<Frame>,
}

impl<'a> Wishes<'a> {
    /// Those of a file.
    pub(super) fn of(file: &'a FrameFile) -> Self {
        // A preset may have a base of its own: the nearest one.
        let of_preset = |entry: &Entry| presets().find(|(_, text)| entry.place.source.text == *text).map(|preset| (entry.depth, preset));
        let nearest = file.entries.values().filter_map(of_preset).min_by_key(|(depth, _)| *depth);
        let base = nearest.and_then(|(_, (name, text))| Frame::resolve(&FrameFile::parse(name, text).ok()?).ok());
        Self { file, base }
    }

    /// Whether a key is one.
    pub(super) fn has(&self, key: &str) -> bool {
        self.file.entries.get(key).is_some_and(is_own)
    }

    /// Whether another value takes a wish back: another choice than the chosen one, or a number on the way back to the base's.
    pub(super) fn takes_back(&self, key: &str, [now, to]: [Option<f64>; 2]) -> bool {
        let base = || key.split_once('.').and_then(|(table, key)| self.base.as_ref()?.value(table, key));
        let back = |now: f64, to: f64| base().is_none_or(|base| (to - now) * (base - now) > 0.0);
        self.has(key) && now.zip(to).is_none_or(|(now, to)| back(now, to))
    }

    /// What is told where no change was found: which ones were tried.
    pub(super) fn nothing_found(&self) -> String {
        let alone = "no single key was found that clears it";
        let is_searched = self.base.is_some() && self.file.entries.values().any(is_own);
        if is_searched {
            format!("{alone}, and no rods and motor positions that keep every limit together, in a search of at most {MOST} frames")
        } else {
            alone.into()
        }
    }

    /// Frames that have the wishes and keep every limit, in words; none where there are no wishes, or none was found.
    pub(super) fn kept_by(&self, memo: &Arc<Memo>, rules: &[&'static Rule]) -> Option<String> {
        let wishes: Vec<(&String, &Entry)> = self.file.entries.iter().filter(|(_, entry)| is_own(entry)).collect();
        if wishes.is_empty() {
            return None;
        }
        let found = self.on_a_preset(&wishes, memo, rules).or_else(|| self.together(&wishes))?;
        Some(format!("to keep what the file asks for: {found}"))
    }

    /// The first preset, the lightest, that keeps its limits with the wishes put onto it.
    fn on_a_preset(&self, wishes: &[(&String, &Entry)], memo: &Arc<Memo>, rules: &[&'static Rule]) -> Option<String> {
        let names: Vec<(&str, &str)> = presets().collect();
        let keeps = |(name, text): &(&'static str, &'static str)| {
            let mut file = FrameFile::parse(name, text).ok()?;
            wishes.iter().for_each(|(key, entry)| file.set(key, entry.value.clone()));
            let design = Design::with(Frame::resolve(&file).ok()?, memo).ok()?;
            let masses = mass::table(&design);
            let found = checks::check_by(rules, Cost::Slow, &design, &masses);
            found.iter().all(|f| f.verdict != Verdict::Violated).then_some((masses.total_g, *name))
        };
        let fits: Vec<(f64, &str)> = names.par_iter().filter_map(keeps).collect();
        let (mass_g, name) = fits.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(format!("base = \"{name}\" keeps every limit of its own ({} g)", decimals(mass_g, 1)))
    }

    /// Rods and motor positions that keep every limit when they move together; those that are wished stay.
    fn together(&self, wishes: &[(&String, &Entry)]) -> Option<String> {
        let from = self.base.as_ref()?;
        let first = AtomicUsize::new(usize::MAX);
        let follows = |search: &SearchProgress| {
            if search.best.is_some() {
                first.fetch_min(search.looked_at, Ordering::Relaxed);
            }
            if search.looked_at >= first.load(Ordering::Relaxed).saturating_add(NEARER) {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        };
        let free = Request { file: self.file, from, envelope_mm: None, vary: &[], most: MOST, follows: &follows };
        let wished = |vary: &Vary| match wishes.iter().find(|(key, _)| **key == vary.key())?.1.value {
            Value::Number(value) => Some(Vary { bounds: [value; 2], ..*vary }),
            _ => None,
        };
        let vary: Vec<Vary> = movable(&free).iter().filter_map(wished).collect();
        let creation = create(&Request { vary: &vary, ..free }).ok()?;
        if creation.moved.is_empty() {
            return None;
        }
        let moves: Vec<String> = creation
            .moved
            .iter()
            .map(|moved| format!("{} {} -> {}", moved.key, decimals(moved.before, 2), decimals(moved.after, 3)))
            .collect();
        Some(format!("{} together keep every limit ({} g)", moves.join(", "), decimals(creation.evaluation.masses.total_g, 1)))
    }
}

/// Names and texts of the presets.
fn presets() -> impl Iterator<Item = (&'static str, &'static str)> {
    preset::names().filter_map(|name| preset::text(name).map(|text| (name, text)))
}

/// Whether an entry is a user's: it stands in no preset.
fn is_own(entry: &Entry) -> bool {
    presets().all(|(_, text)| entry.place.source.text != text)
}
