//! Studies: many frames over ranges of parameters, or many sets of drops with a hidden effect; one row for each.
//!
//! A [`Study`] is read from a plan file. Row `n` of a study is a pure function of the plan and of `n`, so rows can be evaluated in
//! any order, by any number of processes, and again after an interruption; the table is the same. No file is opened for writing here.

mod axis;
mod bill_figure;
mod column;
mod evaluate;
mod frame_key;
mod front;
mod journal;
mod outcomes;
#[cfg(feature = "parquet")]
mod parquet_table;
mod plan;
mod plan_file;
mod plan_keys;
pub mod recovery;
mod samples;
mod sampling;
mod sobol_indices;
mod table;

pub use axis::{Axis, Input};
pub use bill_figure::BillFigure;
pub use column::Column;
pub use evaluate::Evaluator;
pub use front::{FrontError, front};
pub use journal::{Journal, JournalError, KEY_OF_STUDY, begun, line};
pub use outcomes::{Outcome, Outcomes};
#[cfg(feature = "parquet")]
pub use parquet_table::parquet;
pub use plan::{Frames, Study, Subject};
pub use plan_file::{KEYS, SAMPLES, load};
pub use plan_keys::{KINDS, PlanKey, Takes};
pub use samples::samples;
pub use sampling::{Sampling, most_rows};
pub use sobol_indices::{Index, Indices, IndicesError, indices};
pub use table::csv;
