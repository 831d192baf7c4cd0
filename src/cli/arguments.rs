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
  flexframe measure ../shared/data/crash_landing
  flexframe fit --model paper-corrected ../shared/data/crash_landing/soft_*
  flexframe params --filter arm

Exit codes: 0 good, 1 a limit is violated, 2 input or usage is wrong, 3 the machine failed";

/// The commands.
#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Write STL, GLB, bill of materials, manifest, report and pictures of a frame.
    #[command(after_help = "Examples:\n  flexframe build\n  flexframe build my-frame.toml -o frames --rigid pla")]
    Build(BuildOptions),
    /// Hold frames against their limits; exits 1 when one is violated.
    #[command(
        after_help = "Examples:\n  flexframe check\n  flexframe check my-frame.toml --json\n  flexframe check 'frames/*.toml' --format github --baseline accepted.json\n\nFindings of a frame that was held before by this program are taken from FLEXFRAME_CACHE, else XDG_CACHE_HOME/flexframe,\nelse ~/.cache/flexframe."
    )]
    Check(CheckOptions),
    /// Write how a frame is put together: steps, animation, instructions; exits 1 when it cannot be.
    #[command(after_help = "Examples:\n  flexframe fold cognifly-v8 -o folds\n  flexframe fold --step 9 --png")]
    Fold(FoldOptions),
    /// Simulate drops of an impact model, or of a frame, and write peaks, energies and plots.
    #[command(
        after_help = "Examples:\n  flexframe drop --model paper --height 0.3,1,2.62\n  flexframe drop cognifly --model paper-corrected --json\n  flexframe drop cognifly-v8 --model frame"
    )]
    Drop(DropOptions),
    /// Find where a model and measured drops disagree, name the missing effect, add it, and show the gap shrink.
    #[command(
        after_help = "Examples:\n  flexframe diagnose --model paper ../shared/data/crash_landing/soft_*\n  flexframe diagnose drops.csv --model paper --hold-out-heights 2.0 --max-effects 2 --seed 1 --json\n\nA preset's name or a .toml file among the drops is the frame: its mass and gap hold in place of the model's.\nExit code 0: nothing is missing; 1: something is. docs/diagnosis.md explains the method."
    )]
    Diagnose(DiagnoseOptions),
    /// Write synthetic drops with a known truth, to test a diagnosis on.
    #[command(
        after_help = "Example:\n  flexframe synthesize params/synthetic/bottoming.toml --seed 3\n\nA plan is a model file with the tables drops, scatter, logger and hidden; docs/diagnosis.md lists their keys."
    )]
    Synthesize(SynthesizeOptions),
    /// Fit parameters of a model to measured drops.
    #[command(
        after_help = "Examples:\n  flexframe fit --model paper --objective paper --free c ../shared/data/crash_landing/soft_*\n  flexframe fit cognifly-v8 --model paper-corrected drops.csv --bootstrap 500 --seed 1 --json\n\nA preset's name or a .toml file among the drops is the frame: its mass and gap hold in place of the model's."
    )]
    Fit(FitOptions),
    /// Read measured drops, judge each, and write a table of heights and plots.
    #[command(
        after_help = "Examples:\n  flexframe measure ../shared/data/crash_landing\n  flexframe measure drops.csv soft_050cm acc_b-26.bin --json\n\nA .bin or .bhn file of the logger lies in a folder that names frame and height, as soft_050cm; a .csv table has the columns\ntrial,height_m,t_s,accel_g and may have x,y,z (g). docs/physics.md says how records are judged."
    )]
    Measure(MeasureOptions),
    /// Press a frame down by its own geometry: force over displacement, where the energy sits, strains, modes.
    #[command(
        after_help = "Examples:\n  flexframe stiffness cognifly-v8 --compare params/static/cognifly-v8.csv\n  flexframe stiffness cognifly-v8 --calibrate params/static/cognifly-v8.csv\n  flexframe stiffness my-frame.toml --mechanics out/cognifly-v8-stiffness/mechanics.toml\n\nA static test is a CSV table with the columns displacement_mm,force_n. docs/mechanics.md says what the model holds."
    )]
    Stiffness(StiffnessOptions),
    /// Write PNG pictures: assembled from four sides, flat on the bed, each part.
    #[command(after_help = "Example:\n  flexframe render cognifly-mini -o pictures")]
    Render(RenderOptions),
    /// List every parameter with unit, default, bounds and what it drives.
    #[command(
        after_help = "Examples:\n  flexframe params\n  flexframe params cognifly-v8 --filter hinge --json\n  flexframe params --markdown > docs/parameters.md"
    )]
    Params(ParamsOptions),
    /// Compare two frames, or a frame with its former self: what differs, and what is better or worse.
    #[command(
        after_help = "Examples:\n  flexframe diff cognifly light.toml\n  flexframe diff --git HEAD~1 light.toml --format markdown --fail-on-increase mass=2g\n  flexframe diff cognifly cognifly-mini -o out\n  flexframe diff cognifly light.toml --strength --fail-on-increase design_drop.peak=5g\n\nWhat may not grow is a measure by its name; `flexframe solve --help` lists them."
    )]
    Diff(DiffOptions),
    /// Say what a parameter is, what it drives, and what 5 % less and more of it do.
    #[command(
        after_help = "Examples:\n  flexframe explain arm_pitch_mm\n  flexframe explain arm_rod light.toml --json\n  flexframe explain strut_rod --strength\n  flexframe explain bought.battery"
    )]
    Explain(ExplainOptions),
    /// Write a variant of a frame, with what has to change to keep every limit.
    #[command(
        after_help = "Examples:\n  flexframe new small --from cognifly --propeller propeller-65mm --envelope 190x190x110\n  flexframe new long --battery battery-2s-2000 --mass 260\n\nRods and motors are moved as little as keeps every limit. Exit code 1, and nothing is written, when no such frame is found."
    )]
    New(NewOptions),
    /// Search for the frame with the least of a measure that keeps every limit.
    #[command(
        after_help = "Examples:\n  flexframe solve --minimise mass --vary arm_rod,cage_rod,strut_rod,motor_position -o light\n  flexframe solve cognifly --minimise envelope.volume --subject-to 'clearance.propeller>=3mm' --vary arm_rod=70..90,cage_rod\n\nMeasures: mass, mass.printed, mass.rods, envelope.width, envelope.depth, envelope.height, envelope.volume, clearance.propeller,\nclearance.part, clearance.ground, engagement, hinge.strain, wall, printed.volume, peak; and of the frame's own mechanics, which\ntake a second or two a frame: stiffness, design_drop.peak, design_drop.travel, design_drop.strain. It is a local search: another start may\nlead elsewhere. Exit code 1 when no frame keeps every limit."
    )]
    Solve(SolveOptions),
    /// Say at every save of a frame file what it changed.
    #[command(after_help = "Example:\n  flexframe watch light.toml")]
    Watch(WatchOptions),
    /// Write a small print that tells a printer's clearances; read what was found on it into a frame file.
    #[command(
        after_help = "Examples:\n  flexframe coupon\n  flexframe coupon my-frame.toml --read held=2.8,slides=3.1,window=0.1,plug=0.2 --into my-frame.toml\n\nThe folder's coupon.md says what to look for. A frame file with another one as its base has the clearances of that one."
    )]
    Coupon(CouponOptions),
    /// Compare what parts weigh by volume, in a slicer and on a scale, and fit the print factors to the scale.
    #[command(
        after_help = "Examples:\n  flexframe weigh --slicer\n  flexframe weigh measured.csv\n  flexframe weigh my-frame.toml measured.csv --slicer --into my-frame.toml\n\nReadings are a CSV table with the columns part,mass_g and, where several lay on the scale, quantity. --slicer runs\nPrusaSlicer, which has to be installed. Exit code 1 when the frame, with the fitted factors, is heavier than its limit."
    )]
    Weigh(WeighOptions),
    /// List what to print, to buy and to cut.
    #[command(after_help = "Examples:\n  flexframe bom light.toml\n  flexframe bom light.toml --format csv --kerf 1.5 > bom.csv")]
    Bom(BomOptions),
    /// Print the JSON Schema of a kind of file, for editors.
    #[command(
        after_help = "Example:\n  flexframe schema frame > frame.schema.json\n\nA frame file that begins with the line\n  #:schema ./frame.schema.json\nis then completed and checked by editors with Taplo, such as VS Code with Even Better TOML."
    )]
    Schema(SchemaOptions),
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
    /// Write STEP files, too: one a part, and `frame.step` with everything in its place.
    #[arg(long, conflicts_with = "part")]
    pub step: bool,
    /// Plates of one printed part alone, to print it again, into the folder `FRAME-PART`.
    #[arg(long, value_name = "PART")]
    pub part: Option<String>,
    /// How many of it, 1 when nothing is said.
    #[arg(long, value_name = "N", requires = "part")]
    pub quantity: Option<usize>,
}

/// How `check` says what it found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum CheckFormat {
    /// A table for a person.
    Text,
    /// Everything.
    Json,
    /// JUnit XML: a suite a frame, a case a finding.
    Junit,
    /// Annotations of GitHub Actions.
    Github,
    /// A page for a pull request or a job's summary.
    Markdown,
    /// SARIF 2.1.0, for code scanning.
    Sarif,
}

/// Options of `check`.
#[derive(Debug, Args)]
pub(super) struct CheckOptions {
    /// Presets' names, TOML files, or patterns of files such as 'frames/**/*.toml'.
    #[arg(default_value = "cognifly", value_name = "FRAME")]
    pub frames: Vec<String>,
    /// Material of the rigid parts instead of the frame files': a name of params/materials.toml.
    #[arg(long, value_name = "MATERIAL")]
    pub rigid: Option<String>,
    /// Print every finding, not only the tightest of those that are alike.
    #[arg(long)]
    pub all: bool,
    /// How to say it; --json is the same as --format json.
    #[arg(long, value_enum, value_name = "FORMAT", conflicts_with = "json")]
    pub format: Option<CheckFormat>,
    /// Notes beyond their figure fail, too.
    #[arg(long)]
    pub strict: bool,
    /// A list of accepted findings: only what is not on it, or is worse than there, fails.
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Write what fails now into the list of --baseline; nothing fails then.
    #[arg(long, requires = "baseline")]
    pub update_baseline: bool,
    /// Whether the mechanics are asked.
    #[command(flatten)]
    pub mechanics: MechanicsOption,
    /// Do not keep findings, nor use those that were kept (FLEXFRAME_CACHE=off does the same).
    #[arg(long)]
    pub no_cache: bool,
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

/// Whether a frame's own mechanics are asked.
#[derive(Debug, Args)]
pub(super) struct MechanicsOption {
    /// Ask the frame's own mechanics, too, a second or two a frame: stiffness, and payload, travel, strains and rods in the design drop.
    #[arg(long)]
    pub strength: bool,
    /// With --strength: numbers of the mechanics instead of those that come with the program.
    #[arg(long, value_name = "TOML", requires = "strength")]
    pub mechanics: Option<String>,
}

/// Options of `diff`.
#[derive(Debug, Args)]
pub(super) struct DiffOptions {
    /// Two presets' names or TOML files; one file with --git.
    #[arg(required = true, num_args = 1..=2, value_name = "FRAME")]
    pub frames: Vec<String>,
    /// Compare a file with what it was at this revision of its git repository.
    #[arg(long, value_name = "REVISION")]
    pub git: Option<String>,
    /// Exit 1 when a measure grows by more than this; may be given several times.
    #[arg(long, value_name = "MEASURE=AMOUNT")]
    pub fail_on_increase: Vec<String>,
    /// How to say it; --json is the same as --format json.
    #[arg(long, value_enum, value_name = "FORMAT", conflicts_with = "json")]
    pub format: Option<PageFormat>,
    /// Whether the mechanics are asked.
    #[command(flatten)]
    pub mechanics: MechanicsOption,
    /// Write diff.md, diff.json and a picture of both frames into the folder `diff-A-B` of this one.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
}

/// Options of `explain`.
#[derive(Debug, Args)]
pub(super) struct ExplainOptions {
    /// The parameter: its key with or without table, or a beginning of it; or a key of a name, such as bought.battery.
    #[arg(value_name = "KEY")]
    pub key: String,
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Whether the mechanics are asked.
    #[command(flatten)]
    pub mechanics: MechanicsOption,
}

/// Options of `new`.
#[derive(Debug, Args)]
pub(super) struct NewOptions {
    /// Name of the variant; NAME.toml is written.
    pub name: String,
    /// The frame that it comes from.
    #[arg(long, default_value = "cognifly", value_name = "FRAME")]
    pub from: String,
    /// Another battery: a name of params/bought.toml.
    #[arg(long, value_name = "PART")]
    pub battery: Option<String>,
    /// Another propeller.
    #[arg(long, value_name = "PART")]
    pub propeller: Option<String>,
    /// Another motor.
    #[arg(long, value_name = "PART")]
    pub motor: Option<String>,
    /// Another rod.
    #[arg(long, value_name = "PART")]
    pub rod: Option<String>,
    /// Size to stay within, mm.
    #[arg(long, value_name = "WxDxH")]
    pub envelope: Option<String>,
    /// Mass to stay within, g.
    #[arg(long, value_name = "G")]
    pub mass: Option<f64>,
    /// Most frames to look at.
    #[arg(long, default_value_t = 120, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=5000))]
    pub frames: u16,
}

/// Options of `solve`.
#[derive(Debug, Args)]
pub(super) struct SolveOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// What to make small: a measure.
    #[arg(long, value_name = "MEASURE")]
    pub minimise: String,
    /// What to keep besides the frame's limits, such as 'clearance.propeller>=3mm'; may be given several times.
    #[arg(long, value_delimiter = ',', value_name = "GOAL")]
    pub subject_to: Vec<String>,
    /// What may vary: keys, by 20 % of the frame's value, or within bounds such as arm_rod=70..90.
    #[arg(long, value_delimiter = ',', required = true, value_name = "KEY,…")]
    pub vary: Vec<String>,
    /// With a measure of the mechanics: their numbers instead of those that come with the program.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// Most frames to look at.
    #[arg(long, default_value_t = 150, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=5000))]
    pub frames: u16,
    /// Write the answer as NAME.toml.
    #[arg(short, long, value_name = "NAME")]
    pub output: Option<String>,
}

/// Options of `coupon`.
#[derive(Debug, Args)]
pub(super) struct CouponOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// What was found: held, slides, window, plug, hinge, each with the number on the coupon in mm.
    #[arg(long, value_delimiter = ',', value_name = "WHAT=MM", requires = "into")]
    pub read: Vec<String>,
    /// Write the clearances that follow into a frame file: one that is there is amended, a new one has FRAME as its base.
    #[arg(long, value_name = "TOML", requires = "read")]
    pub into: Option<PathBuf>,
    /// Folder that takes the folder `FRAME-coupon`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `weigh`.
#[derive(Debug, Args)]
pub(super) struct WeighOptions {
    /// A preset's name or a TOML file, and readings of a scale: a CSV table; either may be left out.
    #[arg(num_args = 0..=2, value_names = ["FRAME", "READINGS.csv"])]
    pub given: Vec<String>,
    /// Material of the rigid parts instead of the frame file's: a name of params/materials.toml.
    #[arg(long, value_name = "MATERIAL")]
    pub rigid: Option<String>,
    /// Slice every part; another program than prusa-slicer is given as --slicer=PROGRAM.
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "prusa-slicer", value_name = "PROGRAM")]
    pub slicer: Option<String>,
    /// Write the fitted factors into a frame file: one that is there is amended, a new one has FRAME as its base.
    #[arg(long, value_name = "TOML")]
    pub into: Option<PathBuf>,
}

/// Options of `watch`.
#[derive(Debug, Args)]
pub(super) struct WatchOptions {
    /// Which frame: a TOML file.
    #[command(flatten)]
    pub frame: FrameOption,
    /// End after so many saves.
    #[arg(long, value_name = "N")]
    pub saves: Option<u32>,
}

/// Forms of a bill of materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum BomFormat {
    /// A page.
    Markdown,
    /// A table, as in `bom.csv`.
    Csv,
    /// Everything.
    Json,
}

/// Options of `bom`.
#[derive(Debug, Args)]
pub(super) struct BomOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// How to say it; --json is the same as --format json.
    #[arg(long, value_enum, default_value = "markdown", value_name = "FORMAT")]
    pub format: BomFormat,
    /// Width of a saw cut instead of 1 mm.
    #[arg(long, value_name = "MM")]
    pub kerf: Option<f64>,
}

/// Kinds of files that have a schema.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum SchemaKind {
    /// A frame file.
    Frame,
    /// An impact model.
    Model,
    /// A plan of synthetic drops.
    Plan,
    /// The form of params/bought.toml.
    Bought,
    /// The form of params/materials.toml.
    Materials,
    /// A printer.
    Printer,
    /// A list of accepted findings.
    Baseline,
}

/// Options of `schema`.
#[derive(Debug, Args)]
pub(super) struct SchemaOptions {
    /// Of which kind of file.
    #[arg(value_enum, default_value = "frame")]
    pub kind: SchemaKind,
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
    /// Impact model: `paper`, `paper-corrected` or a TOML file; `frame`: the frame's own geometry.
    #[arg(long, default_value = "paper", value_name = "MODEL")]
    pub model: String,
    /// With --model frame: numbers of the mechanics instead of those that come with the program.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// With --model frame: measured drops, as `measure` reads them, to find modulus and loss in an impact from; writes them as a
    /// file for --mechanics, and predicts each height from the others. Heights are those of the drops.
    #[arg(long, num_args = 1.., value_name = "DROPS", conflicts_with_all = ["tilt", "height", "trace"])]
    pub fit: Vec<PathBuf>,
    /// The logger.
    #[command(flatten)]
    pub calibration: CalibrationOptions,
    /// With --model frame: degrees that the frame is turned about X and Y when it touches, -30 to 30; four to five times as slow.
    #[arg(long, value_delimiter = ',', num_args = 1, allow_hyphen_values = true, value_name = "X,Y")]
    pub tilt: Vec<f64>,
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

/// What a fit makes small.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Aim {
    /// Minus the logarithm of the likelihood: distance of the mean waves in units of their scatter.
    Ml,
    /// log(1 + sum over heights of the mean squared error up to each drop's peak), as in the paper's notebook.
    Paper,
}

impl Aim {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ml => "ml",
            Self::Paper => "paper",
        }
    }
}

/// Options of `fit`.
#[derive(Debug, Args)]
pub(super) struct FitOptions {
    /// Drops, as `measure` reads them; a frame among them brings its mass and gap.
    #[arg(required = true, value_name = "DROPS")]
    pub drops: Vec<PathBuf>,
    /// Impact model: `paper`, `paper-corrected` or a TOML file; its k and c are starting values.
    #[arg(long, default_value = "paper-corrected", value_name = "MODEL")]
    pub model: String,
    /// Parameters that are fitted, by their keys in the model file; the others keep their values.
    #[arg(long, value_delimiter = ',', default_value = "k,c", value_name = "KEY,…")]
    pub free: Vec<String>,
    /// What is made small.
    #[arg(long, value_enum, default_value = "ml")]
    pub objective: Aim,
    /// Use flagged drops, too, as the paper's objective does: all that have a whole impact.
    #[arg(long)]
    pub all: bool,
    /// Resampled fits for the intervals; 0 for none.
    #[arg(long, default_value_t = 200, value_name = "N")]
    pub bootstrap: usize,
    /// Of the resampling.
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub seed: u64,
    /// How the logger counts.
    #[command(flatten)]
    pub calibration: CalibrationOptions,
    /// Folder that takes the folder `fit-MODEL`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `diagnose`.
#[derive(Debug, Args)]
pub(super) struct DiagnoseOptions {
    /// Drops, as `measure` reads them; a frame among them brings its mass and gap.
    #[arg(required = true, value_name = "DROPS")]
    pub drops: Vec<PathBuf>,
    /// Impact model: `paper`, `paper-corrected` or a TOML file; its k and c are starting values.
    #[arg(long, default_value = "paper", value_name = "MODEL")]
    pub model: String,
    /// A frame whose own static curve is a candidate, too: its share is fitted to the drops.
    #[arg(long, value_name = "FRAME")]
    pub frame: Option<String>,
    /// With --frame: numbers of the mechanics instead of those that come with the program.
    #[arg(long, value_name = "TOML", requires = "frame")]
    pub mechanics: Option<String>,
    /// Heights that no fit sees, m: the gap there says what a name is worth.
    #[arg(long, value_delimiter = ',', value_name = "HEIGHT,…")]
    pub hold_out_heights: Vec<f64>,
    /// A static test of the same frame, CSV of `displacement_mm,force_n`: compared with each model, not fitted.
    #[arg(long, value_name = "CSV")]
    pub static_test: Option<PathBuf>,
    /// Most effects on top of spring and damper, 1 to 3.
    #[arg(long, default_value_t = 3, value_name = "N")]
    pub max_effects: usize,
    /// Of the simulated data.
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub seed: u64,
    /// How the logger counts.
    #[command(flatten)]
    pub calibration: CalibrationOptions,
    /// Folder that takes the folder `diagnose-MODEL`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `synthesize`.
#[derive(Debug, Args)]
pub(super) struct SynthesizeOptions {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN")]
    pub plan: String,
    /// Seed instead of the plan's.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Folder that takes the folder `synthesize-PLAN`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Options of `measure`.
#[derive(Debug, Args)]
pub(super) struct MeasureOptions {
    /// Files of the logger, CSV tables, or folders of them.
    #[arg(required = true, value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// How the logger counts.
    #[command(flatten)]
    pub calibration: CalibrationOptions,
    /// Folder that takes the folder `measure`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// How the logger counts.
#[derive(Debug, Args)]
pub(super) struct CalibrationOptions {
    /// Counts of the logger at 0 g, instead of those of the paper's.
    #[arg(long, value_delimiter = ',', value_name = "X,Y,Z")]
    pub offset_counts: Option<Vec<f64>>,
    /// Counts of the logger to one g, instead of those of the paper's.
    #[arg(long, value_delimiter = ',', value_name = "X,Y,Z")]
    pub counts_per_g: Option<Vec<f64>>,
}

/// Options of `stiffness`.
#[derive(Debug, Args)]
pub(super) struct StiffnessOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Numbers of the mechanics instead of those that come with the program: a TOML file.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// Fit the flexible material's modulus to a static test; the result goes into mechanics.toml.
    #[arg(long, value_name = "CSV", conflicts_with = "compare")]
    pub calibrate: Option<PathBuf>,
    /// Hold the curve against a static test.
    #[arg(long, value_name = "CSV")]
    pub compare: Option<PathBuf>,
    /// Ratios to another frame of the same material, each with the band that the guesses of the mechanics leave it: a preset's name
    /// or a TOML file. Takes some ten seconds.
    #[arg(long, value_name = "FRAME")]
    pub reference: Option<String>,
    /// How far the centre is pressed down, mm.
    #[arg(long, default_value_t = 34.0, value_name = "MM", value_parser = down_mm)]
    pub down: f64,
    /// Leave out the modes.
    #[arg(long)]
    pub no_modes: bool,
    /// Leave out pictures and animations.
    #[arg(long)]
    pub no_pictures: bool,
    /// Folder that takes the folder `FRAME-stiffness`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// A way down that can be: 2 to 60 mm.
fn down_mm(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(down) if (2.0..=60.0).contains(&down) => Ok(down),
        _ => Err("give 2 to 60 mm".into()),
    }
}

/// Options of `render`.
#[derive(Debug, Args)]
pub(super) struct RenderOptions {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// Instead, each part as it is printed, from above and from below, with what hangs over air, is too thin or holds badly marked.
    #[arg(long)]
    pub findings: bool,
    /// Folder that takes the folder `FRAME-pictures`, or `FRAME-findings`.
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
