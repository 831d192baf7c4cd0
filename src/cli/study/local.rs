//! Rows on the cores of this machine.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use crate::cli::failure::Failure;
use crate::study::{Evaluator, Outcome, Study};

/// Evaluates rows side by side, one a core, and hands each to `finished` as it comes; ends between rows when that says so.
pub(super) fn evaluate(
    study: &Study,
    rows: &[usize],
    cores: usize,
    mut finished: impl FnMut(usize, Outcome) -> Result<ControlFlow<()>, Failure>,
) -> Result<(), Failure> {
    let (next, ended) = (AtomicUsize::new(0), AtomicBool::new(false));
    // A row is handed over before its core takes the next, so that a slow disk leaves none that nobody has seen.
    let (send, receive) = mpsc::sync_channel(0);
    let pools = (0..cores).map(|_| rayon::ThreadPoolBuilder::new().num_threads(1).build()).collect::<Result<Vec<_>, _>>();
    let pools = pools.map_err(|error| Failure::Machine { what: "cannot begin a thread".into(), error: std::io::Error::other(error) })?;
    std::thread::scope(|scope| {
        let (next, ended) = (&next, &ended);
        for pool in &pools {
            let send = send.clone();
            scope.spawn(move || {
                // Rows on one core have no results in common with those on others, as waiting for them would cost more.
                let evaluator = Evaluator::new(study);
                while !ended.load(Ordering::Relaxed) {
                    let Some(row) = rows.get(next.fetch_add(1, Ordering::Relaxed)) else { return };
                    if send.send((*row, pool.install(|| evaluator.row(*row)))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(send);
        for (row, outcome) in receive {
            match finished(row, outcome) {
                Ok(ControlFlow::Continue(())) => {}
                Ok(ControlFlow::Break(())) => ended.store(true, Ordering::Relaxed),
                // Rows that are under way go with it: what cannot be kept is not worth waiting for.
                Err(error) => {
                    ended.store(true, Ordering::Relaxed);
                    return Err(error);
                }
            }
        }
        Ok(())
    })
}
