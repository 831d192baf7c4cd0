//! Parameters: the frame file with the position of each value, the frame with every value resolved, and the refusals.

#[cfg(feature = "edit")]
pub mod amend;
pub mod bought_relation;
pub mod carried;
pub mod catalogue;
mod choice;
mod contradiction;
pub mod figure;
pub mod files;
pub mod follows;
pub mod frame;
pub mod frame_file;
pub mod frame_name;
pub mod groups;
pub mod hung_boards;
pub mod impact_file;
mod kind_fields;
mod layer_height;
mod load_error;
pub mod lookup;
pub mod parameter;
pub mod part_name;
pub mod preset;
mod read;
pub mod refusal;
mod relation;
mod renamed;
#[cfg(feature = "cli")]
mod rendered;
pub mod resolve;
pub mod roles;
pub mod sleeve_direction;
pub mod target;
pub mod unused;

pub use frame::{Frame, catalogue as parameters};
pub use frame_file::FrameFile;
pub use impact_file::ImpactFile;
pub use load_error::{LoadError, is_of_machine};
pub use part_name::PartName;
pub use relation::{BrokenRelation, lengths_hold};
