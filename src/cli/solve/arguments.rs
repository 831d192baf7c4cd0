//! The words of `solve`.

use crate::cli::candidates;
use crate::cli::options::FrameOption;
use crate::cli::searching::SearchOptions;

/// Search for the frame that keeps every limit and minimises a measure.
#[derive(Debug, clap::Args)]
#[group(skip)]
#[command(
    group(clap::ArgGroup::new("goal").args(["minimise", "aim", "pareto"]).required(true)),
    after_help = "Examples:\n  flexframe solve --minimise mass --vary arm_rod,cage_rod,strut_rod,motor_position -o light\n  flexframe solve cognifly --minimise envelope.volume --subject-to 'clearance.propeller>=3mm' --vary arm_rod=70..90,cage_rod\n  flexframe solve --aim stiffness=9.2 --vary strut_rod\n  flexframe solve --minimise mass --choose bought.battery,materials.rigid --vary cage_rod,arm_rod,strut_rod\n  flexframe solve --pareto mass,envelope.width --vary cage_rod,arm_rod,strut_rod,motor_position -o out\n\nMeasures: mass, mass.printed, mass.rods, centre_of_mass, envelope.width, envelope.depth, envelope.height, envelope.volume,\nclearance.propeller, clearance.part, clearance.ground, engagement, hinge.strain, wall, printed.volume, peak,\npeak.strike; and of the frame's own mechanics, which take a second or two a frame: stiffness, design_drop.peak, design_drop.strike,\ndesign_drop.travel, design_drop.strain. The search is local: another start may\ngive another result. Ctrl-C ends it with the best frame so far. Exit code 1 when no frame keeps every limit."
)]
pub(in crate::cli) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Measure to minimise.
    #[arg(long, value_name = "MEASURE", add = candidates::measures())]
    pub minimise: Option<String>,
    /// Target value of a measure, such as stiffness=9.2.
    #[arg(long, value_name = "MEASURE=VALUE", add = candidates::measures_with_values())]
    pub aim: Option<String>,
    /// Pareto front: frames of which none is better than another in all of two or three measures.
    #[arg(long, value_delimiter = ',', value_name = "MEASURE,…", conflicts_with = "choose", add = candidates::measures())]
    pub pareto: Vec<String>,
    /// Further constraint besides the frame's limits, such as 'clearance.propeller>=3mm'; may be given several times.
    #[arg(long, value_delimiter = ',', value_name = "GOAL")]
    pub subject_to: Vec<String>,
    /// Keys that vary, by 20 % of the frame's value, or within bounds such as arm_rod=70..90.
    #[arg(long, value_delimiter = ',', required_unless_present = "choose", value_name = "KEY,…", add = candidates::numbers_between_commas())]
    pub vary: Vec<String>,
    /// Keys that hold a name and vary, over all names or over some, such as 'bought.battery=battery-2s-850|battery-3s-450'.
    #[arg(long, value_delimiter = ',', value_name = "KEY,…", add = candidates::choices_between_commas())]
    pub choose: Vec<String>,
    /// With a measure of the mechanics: file with their numbers, instead of the built-in ones.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// Limits of the search.
    #[command(flatten)]
    pub search: SearchOptions,
    /// Write the answer as NAME.toml; a front as CSV, JSON and picture into the folder `pareto-FRAME` of this one.
    #[arg(short, long, value_name = "NAME")]
    pub output: Option<String>,
}
