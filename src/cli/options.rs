//! Options that several commands share.

use std::path::PathBuf;

use clap::Args;

use super::bounded::{magnitude, number};
use super::candidates;
use super::failure::Failure;
use crate::impact::diagnose::ComparedAxes;

/// Options of every command.
#[derive(Debug, Args)]
pub(super) struct Common {
    /// Print errors only. bom, explain, fold --step, list, params and schema print what they are asked for.
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Print the result as JSON.
    #[arg(long, global = true)]
    pub json: bool,
    /// Compute everything: neither read nor write cached results (FLEXFRAME_CACHE=off does the same).
    #[arg(long, global = true)]
    pub no_cache: bool,
}

impl Common {
    /// Refuses --json for a command whose output is no JSON; `prints` says what it is.
    pub(super) fn refuse_json(&self, prints: &str) -> Result<(), Failure> {
        if self.json { Err(Failure::Usage { message: format!("--json: this command prints {prints}; leave --json out") }) } else { Ok(()) }
    }
}

/// Which frame.
#[derive(Debug, Args)]
pub(super) struct FrameOption {
    /// A preset's name or a TOML file.
    #[arg(default_value = "cognifly", add = candidates::frames())]
    pub frame: String,
    /// Material of the rigid parts instead of the frame file's: a name of params/materials.toml.
    #[arg(long, value_name = "MATERIAL", add = candidates::materials())]
    pub rigid: Option<String>,
}

/// Whether a frame's own mechanics are computed.
#[derive(Debug, Args)]
pub(super) struct MechanicsOption {
    /// Compute the frame's own mechanics, too: stiffness, and payload, travel, strains and rods in the design drop. Takes a second or two
    /// a frame.
    #[arg(long)]
    pub strength: bool,
    /// With --strength: file with the numbers of the mechanics, instead of the built-in ones.
    #[arg(long, value_name = "TOML", requires = "strength")]
    pub mechanics: Option<String>,
}

/// Which measured drops.
#[derive(Debug, Args)]
pub(super) struct DropsOption {
    /// Drops, as `measure` reads them. A frame among them supplies mass and gap.
    #[arg(required = true, value_name = "DROPS")]
    pub drops: Vec<PathBuf>,
}

/// How files of drops are written.
#[derive(Debug, Args)]
pub(super) struct FormatOptions {
    /// Counts at 0 g of the logger's .bin files, instead of those of the paper's logger.
    #[arg(long, value_delimiter = ',', value_name = "X,Y,Z", value_parser = number([-1e5, 1e5], "counts"))]
    pub offset_counts: Option<Vec<f64>>,
    /// Counts per g of the logger's .bin files, instead of those of the paper's logger. For counts in a table: --units N/g.
    #[arg(long, value_delimiter = ',', value_name = "X,Y,Z", value_parser = magnitude([1e-2, 1e5], "counts"))]
    pub counts_per_g: Option<Vec<f64>>,
    /// Names of a table's columns: trial, session, h (height), v (impact speed, m/s), t, a (along the axis), x, y, z; -NAME changes
    /// the sign. Without a, z is the axis. A NAME may have commas.
    #[arg(long, value_delimiter = ',', value_name = "KEY=NAME,…")]
    pub columns: Vec<String>,
    /// Units of a table: g, mg, m/s2, or N/g for readings in counts, N of them a g, as 2048/g; s, ms or us; m, cm or mm.
    #[arg(long, value_delimiter = ',', value_name = "UNIT,…")]
    pub units: Vec<String>,
    /// What a table's sensor reads in free fall, g, which is taken off the readings: along the axis, or x, y and z, after --columns and
    /// --units. --zero=-1 puts gravity back where it was taken off.
    #[arg(long, value_delimiter = ',', num_args = 1, allow_hyphen_values = true, value_name = "G", value_parser = number([-1e3, 1e3], "g"))]
    pub zero: Vec<f64>,
    /// Angle from the frame's front to the sensor's x, deg, counted toward the left, for sensors that are mounted turned: x and y are turned
    /// back by it. 45 where x points along a leg.
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true, value_name = "DEG", value_parser = number([-360.0, 360.0], "deg"))]
    pub turn: f64,
    /// Sampling rate of a table, Hz, in place of its time stamps.
    #[arg(long, value_name = "HZ", value_parser = number([1.0, 1e6], "Hz"))]
    pub rate: Option<f64>,
}

impl FormatOptions {
    /// The options about tables, each with whether it was given.
    pub(super) fn of_tables(&self) -> [(bool, &'static str); 4] {
        [
            (!self.columns.is_empty(), "--columns"),
            (!self.units.is_empty(), "--units"),
            (!self.zero.is_empty(), "--zero"),
            (self.rate.is_some(), "--rate"),
        ]
    }

    /// The options about the logger's files, each with whether it was given.
    pub(super) fn of_logger(&self) -> [(bool, &'static str); 2] {
        [(self.offset_counts.is_some(), OFFSET_COUNTS), (self.counts_per_g.is_some(), "--counts-per-g")]
    }

    /// What a table has in place of an option about the logger's files.
    pub(super) fn of_tables_instead_of(option: &str) -> &'static str {
        if option == OFFSET_COUNTS { "--zero G" } else { "--units N/g" }
    }

    /// One that was given.
    pub(super) fn given(&self) -> Option<&'static str> {
        let turned = (self.turn != 0.0, "--turn");
        self.of_tables().into_iter().chain(self.of_logger()).chain([turned]).find(|(given, _)| *given).map(|(_, name)| name)
    }
}

const OFFSET_COUNTS: &str = "--offset-counts";

/// Which channel of the readings is compared with a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum ChannelOption {
    /// The channel that the drops support; the result states which, and why.
    Auto,
    /// The component along the frame's axis.
    Axial,
    /// The magnitude of all axes.
    Magnitude,
    /// All axes: the component along the frame's axis is compared with the model, and the lateral axes show each foot's touch and the lean
    /// of the sensor. For `diagnose` alone.
    All,
}

impl ChannelOption {
    /// The axes, if some are requested.
    pub(super) fn wanted(self) -> Option<ComparedAxes> {
        match self {
            Self::Auto => None,
            Self::Axial => Some(ComparedAxes::Axial),
            Self::Magnitude => Some(ComparedAxes::Magnitude),
            Self::All => Some(ComparedAxes::All),
        }
    }
}

/// How a comparison is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum PageFormat {
    /// A table for a person.
    Text,
    /// Everything.
    Json,
    /// A page for a pull request.
    Markdown,
}
