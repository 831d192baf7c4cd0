//! The skeleton: nodes, rods and sockets, closed analytically. The only source of positions and axes.
//!
//! Axes: X right, Y front, Z up; the origin is where the hub's axis crosses the plane of the arms. A module is what
//! lies along one diagonal; the four modules are one, turned about Z and, in a frame that is longer than wide, moved apart along Y.
//! So the frame is symmetric by construction.

mod accessories;
mod battery_axes;
pub mod centre;
mod closing_lengths;
mod closure;
mod corner_pivots;
mod graph;
mod module;
pub mod placement;
mod rotor;
mod stack;

pub use accessories::{Accessories, SLOT_MM};
pub use battery_axes::BatteryAxes;
pub use centre::Centre;
pub use closing_lengths::closing_lengths;
pub use closure::{BELOW_MM, Closure, ClosureError, Envelope, lengths_for, strut_fold_deg};
pub use corner_pivots::CornerPivots;
pub use graph::{Node, Rod, RodRole, SAWN_MM, Skeleton, Socket, laid_along};
pub use module::{MODULE_NAMES, MODULE_WORDS, ModulePlaces, module_turn};
pub use rotor::{ROTORS, Rotor, Spin};
pub use stack::Stack;
