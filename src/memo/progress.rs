//! Where a computation is, and whether its result is still wanted.

use std::ops::ControlFlow;

/// A step of a computation that begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step<'a> {
    /// What is done: a printed part, a rule, a kind of files.
    pub name: &'a str,
    /// How many steps this stage of the computation has at most. Stages follow each other: the parts, the rules, the formats, the pictures.
    pub of: usize,
}

/// Somebody who follows a computation. Steps may begin side by side, in any order.
pub trait Progress: Sync {
    /// A step begins. [`ControlFlow::Break`] ends the computation before it; steps that began are done. The longest, the way of all bodies
    /// into their places, takes about a third of a `check`.
    fn begins(&self, step: Step) -> ControlFlow<()>;
}

impl<F: Fn(Step) -> ControlFlow<()> + Sync> Progress for F {
    fn begins(&self, step: Step) -> ControlFlow<()> {
        self(step)
    }
}

/// Nobody: every computation goes to its end.
#[derive(Clone, Copy, Debug)]
pub struct Unwatched;

impl Progress for Unwatched {
    fn begins(&self, _: Step) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
