//! What may stand on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Flexible, printable drone frames from one parameter file.
#[derive(Debug, Parser)]
#[command(name = "flexframe", version, about, arg_required_else_help = true, after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// How to talk about it.
    #[command(flatten)]
    pub common: Common,
}

/// Options of every command.
#[derive(Debug, Args)]
pub(super) struct Common {
    /// Say nothing but errors.
    #[arg(short, long, global = true)]
    pub quiet: bool,
    /// Print the result as JSON.
    #[arg(long, global = true)]
    pub json: bool,
}

const EXAMPLES: &str = "Examples:
  flexframe build                                  the default frame into out/cognifly
  flexframe build params/frames/cognifly-mini.toml -o /tmp/frames
  flexframe check cognifly-v8                      exits 1: it is 1.92 mm too wide, for one
  flexframe render cognifly
  flexframe drop --model paper --height 0.5,1,1.5
  flexframe params --filter arm

Exit codes: 0 good, 1 a limit is violated, 2 input or usage is wrong, 3 the machine failed";

/// The commands.
#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Write STL, GLB, bill of materials, manifest, report and pictures of a frame.
    #[command(after_help = "Examples:\n  flexframe build\n  flexframe build my-frame.toml -o frames --rigid pla")]
    Build(BuildOptions),
    /// Hold a frame against its limits; exits 1 when one is violated.
    #[command(after_help = "Examples:\n  flexframe check\n  flexframe check my-frame.toml --json")]
    Check(CheckOptions),
    /// Write how a frame is put together: steps, animation, instructions; exits 1 when it cannot be.
    #[command(after_help = "Examples:\n  flexframe fold cognifly-v8 -o folds\n  flexframe fold --step 9 --png")]
    Fold(FoldOptions),
    /// Drop the body of a model, or of a frame, and write peaks, energies and plots.
    #[command(
        after_help = "Examples:\n  flexframe drop --model paper --height 0.3,1,2.62\n  flexframe drop cognifly --model paper-corrected --json"
    )]
    Drop(DropOptions),
    /// Write PNG pictures: assembled from four sides, flat on the bed, each part.
    #[command(after_help = "Example:\n  flexframe render cognifly-mini -o pictures")]
    Render(RenderOptions),
    /// List every parameter with unit, default, bounds and what it drives.
    #[command(
        after_help = "Examples:\n  flexframe params\n  flexframe params cognifly-v8 --filter hinge --json\n  flexframe params --markdown > docs/parameters.md"
    )]
    Params(ParamsOptions),
    /// Print a shell's completion script.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page (roff).
    Man,
}

/// Which frame.
#[derive(Debug, Args)]
pub(super) struct FrameOption {
    /// A preset's name or a TOML file.
    #[arg(default_value = "cognifly")]
    pub frame: String,
    /// Material of the rigid parts instead of the frame file's: a name of params/materials.toml.
    #[arg(long, value_name = "MATERIAL")]
    pub rigid: Option<String>,
}

/// Options of `build`.
#[derive(Debug, Args)]
pub(super) struct BuildOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Folder that takes the frame's folder.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
    /// Leave out the pictures.
    #[arg(long)]
    pub no_pictures: bool,
}

/// Options of `check`.
#[derive(Debug, Args)]
pub(super) struct CheckOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Print every finding, not only the tightest of those that are alike.
    #[arg(long)]
    pub all: bool,
}

/// Options of `fold`.
#[derive(Debug, Args)]
pub(super) struct FoldOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// One step only: its pictures before and after, into `FRAME-step-N`.
    #[arg(long, value_name = "N", requires = "png")]
    pub step: Option<usize>,
    /// With --step: write the pictures.
    #[arg(long, requires = "step")]
    pub png: bool,
    /// Folder that takes the folder `FRAME-fold`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `drop`.
#[derive(Debug, Args)]
pub(super) struct DropOptions {
    /// A preset's name or a TOML file: its mass and gap in place of the model's.
    pub frame: Option<String>,
    /// Material of the frame's rigid parts instead of the frame file's.
    #[arg(long, value_name = "MATERIAL", requires = "frame")]
    pub rigid: Option<String>,
    /// Impact model: `paper`, `paper-corrected` or a TOML file.
    #[arg(long, default_value = "paper", value_name = "MODEL")]
    pub model: String,
    /// Drop heights, m.
    #[arg(long, value_delimiter = ',', default_value = "0.5,1,1.5", value_name = "M,…")]
    pub height: Vec<f64>,
    /// With --json: the sensor's output, too, in steps of 0.05 ms for 60 ms.
    #[arg(long)]
    pub trace: bool,
    /// Folder that takes the folder `drop-MODEL`, or `drop-MODEL-FRAME`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `render`.
#[derive(Debug, Args)]
pub(super) struct RenderOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Folder that takes the folder `FRAME-pictures`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `params`.
#[derive(Debug, Args)]
pub(super) struct ParamsOptions {
    /// Which frame's values to show.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Only keys that contain this.
    #[arg(long, value_name = "TEXT")]
    pub filter: Option<String>,
    /// Print a page of tables, the form of docs/parameters.md.
    #[arg(long, conflicts_with = "json")]
    pub markdown: bool,
}
