//! `flexframe drop`: drops of an impact model, of a frame's own geometry, or the latter fitted to measured drops.

mod arguments;
mod fit;
mod frame;
mod model;

use std::process::ExitCode;

use super::failure::Failure;
use super::given_drops::FRAME_MODEL;
use super::options::Common;
use crate::impact::sim::check_heights;
pub(super) use arguments::Args;

/// Simulates the drops and writes their folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    let heights_m = &args.height[..];
    check_heights(heights_m).map_err(|error| Failure::Usage { message: error.to_string() })?;
    if let Some(option) = args.format.given().filter(|_| args.fit.is_empty()) {
        return Err(Failure::Usage { message: format!("{option} says how measured drops are written: it goes with --fit") });
    }
    if args.trace && !common.json {
        return Err(Failure::Usage { message: "--trace goes with --json: a written folder has the series anyway".into() });
    }
    if args.model != FRAME_MODEL {
        return model::run(args, heights_m, common);
    }
    if args.fit.is_empty() { frame::run(args, heights_m, common) } else { fit::run(args, common) }
}
