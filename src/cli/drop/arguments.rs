//! The arguments of `flexframe drop`.

use std::path::PathBuf;

use crate::cli::bounded::number;
use crate::cli::candidates;
use crate::cli::options::FormatOptions;
use crate::impact::sim::HEIGHTS_M;

/// Largest tilt at first touch, degrees: beyond it more than the feet would touch.
const MOST_TILT_DEG: f64 = 30.0;

/// Simulate drops of an impact model, or of a frame, and write peaks, energies and plots.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe drop --model paper --height 0.3,1,2.62\n  flexframe drop cognifly --model paper-corrected --json\n  flexframe drop cognifly-v8 --model frame"
)]
pub(in crate::cli) struct Args {
    /// A preset's name or a TOML file; its mass and gap replace those of the model.
    #[arg(add = candidates::frames())]
    pub frame: Option<String>,
    /// Material of the frame's rigid parts instead of the frame file's.
    #[arg(long, value_name = "MATERIAL", requires = "frame", add = candidates::materials())]
    pub rigid: Option<String>,
    /// Impact model: `paper`, `paper-corrected` or a TOML file; `frame`: the frame's own geometry.
    #[arg(long, default_value = "paper", value_name = "MODEL", add = candidates::models())]
    pub model: String,
    /// With --model frame: file with the numbers of the mechanics, instead of the built-in ones.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// With --model frame: measured drops, as `measure` reads them. Fits modulus and loss in an impact to them, writes both as a file for
    /// --mechanics, and predicts each height from the others. The heights are those of the drops.
    #[arg(long, num_args = 1.., value_name = "DROPS", conflicts_with_all = ["tilt", "height", "trace"])]
    pub fit: Vec<PathBuf>,
    /// The logger.
    #[command(flatten)]
    pub format: FormatOptions,
    /// With --model frame: tilt of the frame about X and Y at first touch, -30 to 30 degrees. Takes four to five times as long.
    #[arg(long, value_delimiter = ',', num_args = 1, allow_hyphen_values = true, value_name = "X,Y", value_parser = number([-MOST_TILT_DEG, MOST_TILT_DEG], "°"))]
    pub tilt: Vec<f64>,
    /// Drop heights, m.
    #[arg(long, value_delimiter = ',', default_value = "0.5,1,1.5", value_name = "M,…", value_parser = number(HEIGHTS_M, "m"))]
    pub height: Vec<f64>,
    /// With --json: add sensor output, compression and ground force in steps of 0.05 ms over 60 ms; with --model frame, `moments`
    /// and sensor output in steps of 0.1 ms to the end of contact.
    #[arg(long)]
    pub trace: bool,
    /// Folder in which to write the folder `drop-MODEL`, `drop-MODEL-FRAME`, or with --fit `drop-fit-FRAME`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}
