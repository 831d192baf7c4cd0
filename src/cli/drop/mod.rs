//! `flexframe drop`: drops of an impact model, of a frame's own geometry, or the latter fitted to measured drops.

mod arguments;
mod fit;
mod frame;
mod model;

use std::process::ExitCode;

use super::failure::Failure;
use super::options::Common;
pub(super) use arguments::Args;

/// Drop heights that are allowed, m.
const HEIGHTS_M: [f64; 2] = [0.01, 100.0];
/// The model that is the frame's own.
const FRAME: &str = "frame";
/// How many heights at once.
const MOST_HEIGHTS: usize = 100;

/// Simulates the drops and writes their folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let heights_m = heights(args)?;
    if args.model != FRAME {
        return model::run(args, heights_m, common);
    }
    if args.fit.is_empty() { frame::run(args, heights_m, common) } else { fit::run(args, common) }
}

fn heights(args: &Args) -> Result<&[f64], Failure> {
    let [min, max] = HEIGHTS_M;
    if args.height.len() > MOST_HEIGHTS {
        return Err(Failure::Usage { message: format!("--height takes at most {MOST_HEIGHTS} heights") });
    }
    match args.height.iter().find(|height| !(min..=max).contains(*height)) {
        Some(height) => Err(Failure::Usage { message: format!("--height {height} is out of bounds: give {min} to {max} m") }),
        None => Ok(&args.height),
    }
}
