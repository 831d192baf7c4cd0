//! The fold: how a frame is put together flat and closed by bending, as data.
//!
//! [`Task`]s are the joints to close and the hinges to bend. [`Rules`] derive from the geometry which task is possible when.
//! [`FoldSequence`] contains the steps. [`Linkage`] computes the triangle of arms, strut and leg while it closes. [`Module`] gives the pose
//! of every body.

mod cut_rods;
mod depth;
mod flat;
mod hinge;
mod linkage;
mod member;
mod piece;
mod posture;
mod rules;
mod sequence;
mod sweep;
mod task;
mod threading;
mod timeline;
mod tool;

pub use cut_rods::{when_cut, worn};
pub use depth::{Depth, depth};
pub use flat::{FlatError, FlatState, Lying, TABLE_MM};
pub use hinge::{HingeLoad, largest_web_strain_percent, necks, web, web_strain_percent};
pub use linkage::{FREE_WAY, Linkage, LinkageError, MOST_PULLED, Stance};
pub use member::{Member, Side};
pub use piece::mesh_at;
pub use posture::{Module, Posture, bent_by};
pub use rules::{BrokenConstraint, Done, Rules, TOP_BENT};
pub use sequence::{Dependence, FoldBend, FoldError, FoldSequence, Join, NEXT_MODULE, Step, inputs as fold_inputs};
pub use sweep::{FITS_A_WAY, Meeting, Sweep, sweeps};
pub use task::{FoldMotion, Task};
pub use threading::threading;
pub use timeline::{Moment, STEP_S, exploded, moment, moments};
pub use tool::{Tool, in_words};
