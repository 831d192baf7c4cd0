//! Code that `solve` and `new` share: limits of a search, its progress reports, and its end.

use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::bounded;
use super::interrupt::Finishing;
use super::options::Common;
use super::progress::Progress;
use crate::variant::{Ended, SearchProgress};

/// Limits of a search.
#[derive(Debug, clap::Args)]
pub(super) struct SearchOptions {
    /// Largest number of frames to evaluate; a dozen more may be checked by every rule at the end.
    #[arg(long, default_value_t = 150, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=5000))]
    pub frames: u16,
    /// Longest time, such as 90s, 10m or 2h; the answer is then the best so far, and depends on the machine's speed.
    #[arg(long, value_name = "TIME", value_parser = bounded::duration)]
    pub budget: Option<Duration>,
}

/// Somebody who follows a search: a bar on the terminal, a clock, and Ctrl-C.
pub(super) struct Following {
    begun: Instant,
    /// When the former frame was done, and how long the slowest took.
    paces: Mutex<(Instant, Duration)>,
    budget: Option<Duration>,
    unit: &'static str,
    progress: Progress,
    finishing: Finishing,
}

impl Following {
    /// Starts now; the objective is reported in this unit.
    pub fn begin(options: &SearchOptions, unit: &'static str, common: &Common) -> Self {
        let begun = Instant::now();
        Self {
            begun,
            paces: Mutex::new((begun, Duration::ZERO)),
            budget: options.budget,
            unit,
            progress: Progress::staged("frames", usize::from(options.frames), common),
            finishing: Finishing::begin(),
        }
    }

    /// Tells where the search is, and whether it may go on.
    pub fn hears(&self, search: &SearchProgress) -> ControlFlow<()> {
        let spent = self.begun.elapsed();
        let best = match (search.best, &search.missed) {
            (Some(best), _) => format!("best {best:.2} {}", self.unit),
            (None, Some(missed)) => format!("missed yet: {missed}"),
            (None, None) => "no frame yet".into(),
        };
        self.progress.stage(search.looked_at, format!("{best}, at most {:.0} s left", self.left_s(search, spent)));
        // The next frame and the whole check of the answer are yet to come.
        let too_late = self.budget.is_some_and(|budget| spent + 2 * self.slowest() >= budget);
        if too_late || self.finishing.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// The longest time of a frame so far; one has just been done.
    fn slowest(&self) -> Duration {
        let mut paces = self.paces.lock().unwrap_or_else(PoisonError::into_inner);
        *paces = (Instant::now(), paces.1.max(paces.0.elapsed()));
        paces.1
    }

    /// The search is over: the terminal belongs to the answer.
    pub fn ends(&self) {
        self.progress.clear();
    }

    /// At the pace so far, and no longer than the budget.
    fn left_s(&self, search: &SearchProgress, spent: Duration) -> f64 {
        let frames_left = search.most.saturating_sub(search.looked_at) as f64;
        let by_frames_s = spent.as_secs_f64() * frames_left / search.looked_at.max(1) as f64;
        let by_budget_s = self.budget.map_or(f64::INFINITY, |budget| budget.saturating_sub(spent).as_secs_f64());
        by_frames_s.min(by_budget_s)
    }
}

/// How many frames a search looked at and why it ended, for a person.
pub(super) fn summary(count: usize, ended: Ended) -> String {
    let frames = if count == 1 { "1 frame was looked at".into() } else { format!("{count} frames were looked at") };
    format!("{frames}; the search {}", word(ended))
}

/// Why a search ended, in words.
fn word(ended: Ended) -> &'static str {
    match ended {
        Ended::Converged => "converged",
        Ended::Spent => "spent its frames",
        Ended::Stopped => "was ended before it converged",
    }
}

/// Why a search ended, as it stands in JSON.
pub(super) fn id(ended: Ended) -> &'static str {
    match ended {
        Ended::Converged => "converged",
        Ended::Spent => "frames_spent",
        Ended::Stopped => "stopped",
    }
}
