//! Word of what is being done, for work that takes longer than a person waits.

use std::io::IsTerminal;
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use super::arguments::Common;
use super::terminal;

/// How long work may take before it is announced.
const PATIENCE: Duration = Duration::from_secs(1);

/// Announces a piece of work on standard error when it takes over a second; nothing when the work ends before, when
/// standard error is no terminal, or when silence was asked for.
pub(super) struct Progress {
    done: Option<Sender<()>>,
    watcher: Option<JoinHandle<()>>,
}

impl Progress {
    /// Starts to watch.
    pub(super) fn of(work: &'static str, common: &Common) -> Self {
        if common.quiet || !std::io::stderr().is_terminal() {
            return Self { done: None, watcher: None };
        }
        let (done, ended) = channel::<()>();
        let watcher = std::thread::spawn(move || {
            if ended.recv_timeout(PATIENCE) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
                terminal::tell(&format!("{work} …"));
            }
        });
        Self { done: Some(done), watcher: Some(watcher) }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        drop(self.done.take());
        if let Some(watcher) = self.watcher.take() {
            // A watcher that panicked has nothing left to say.
            let _ = watcher.join();
        }
    }
}
