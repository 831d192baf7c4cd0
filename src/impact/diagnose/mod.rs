//! Where simulation and measurement disagree, which named effect is missing, and what is left when it is added.
//!
//! [`diagnose`] is the whole way: mean waves laid at their trigger and their scatter ([`Ground`]), the base model refitted,
//! whether what it leaves can be chance ([`Adequacy`]), every effect on top of it and sets of them ([`Search`]), and the
//! gates before a name is given. docs/diagnosis.md explains the method.

mod adequacy;
mod candidate;
mod constancy;
mod diagnosis;
mod dictionary;
mod experiment;
mod flat_top;
mod gap;
mod ground;
mod nulls;
mod observable;
mod place;
mod search;
mod stage;
mod surface;
mod trend;

pub use adequacy::{Adequacy, Statistics};
pub use candidate::Candidate;
pub use constancy::{ByHeight, Constancy, constancy};
pub use diagnosis::{Alternative, Diagnosis, Estimate, Gaps, Ranked, Settings, Undiagnosed, Verdict, diagnose, joined, watched};
pub use experiment::Experiment;
pub use flat_top::{FlatTop, flat_top};
pub use gap::{Gap, gap};
pub use ground::Ground;
pub use nulls::{Null, Nulls};
pub use observable::{Observable, observables};
pub use place::{Cell, Phase, Place, Point, SameIn};
pub use search::{Level, RARE, Search, Setting};
pub use stage::Stage;
pub use surface::Patch;
pub use trend::trend_p;
