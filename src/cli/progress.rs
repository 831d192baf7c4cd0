//! Word of what is being done, for work that takes longer than a person waits.

use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::options::Common;

/// How long work may take before it is announced.
const PATIENCE: Duration = Duration::from_secs(1);

/// A bar on standard error for a piece of work that takes over a second; nothing when the work ends before, when standard
/// error is no terminal, or when silence was asked for.
pub(super) struct Progress {
    bar: ProgressBar,
    done: Option<Sender<()>>,
    watcher: Option<JoinHandle<()>>,
}

impl Progress {
    /// Work whose length is not known.
    pub(super) fn of(work: &'static str, common: &Common) -> Self {
        Self::begun(ProgressBar::new_spinner(), "{prefix} … {elapsed}", work, common)
    }

    /// Work of so many stages.
    pub(super) fn staged(work: &'static str, stages: usize, common: &Common) -> Self {
        Self::begun(ProgressBar::new(stages as u64), "{prefix} [{bar:24}] {pos}/{len} {msg} {elapsed}", work, common)
    }

    fn begun(bar: ProgressBar, style: &str, work: &'static str, common: &Common) -> Self {
        bar.set_draw_target(ProgressDrawTarget::hidden());
        if common.quiet || !std::io::stderr().is_terminal() {
            return Self { bar, done: None, watcher: None };
        }
        if let Ok(style) = ProgressStyle::with_template(style) {
            bar.set_style(style.progress_chars("=> "));
        }
        bar.set_prefix(work);
        let (done, ended) = channel::<()>();
        let shown = bar.clone();
        let watcher = std::thread::spawn(move || {
            if ended.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(PATIENCE / 4);
            }
        });
        Self { bar, done: Some(done), watcher: Some(watcher) }
    }

    /// Nothing is shown any more.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// So many stages are done, and this one has begun.
    pub(super) fn stage(&self, before: usize, words: String) {
        self.bar.set_message(words);
        self.bar.set_position(before as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        drop(self.done.take());
        if let Some(watcher) = self.watcher.take() {
            // A watcher that panicked has nothing left to say.
            let _ = watcher.join();
        }
        self.bar.finish_and_clear();
    }
}
