//! `flexframe export`: a frame for simulators.

use std::path::PathBuf;
use std::process::ExitCode;

use super::failure::{Failure, mechanics_refused};
use super::given_drops::FRAME_MODEL;
use super::options::{Common, FrameOption};
use super::output;
use super::progress::Progress;
use super::session;
use super::terminal;
use crate::export::simulator::{self, LegSpring, Motor, SimulatorFormat, SimulatorModel};
use crate::figures::decimals;
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::{self, MassTable};
use crate::impact::effects::{Model, UNILATERAL_CONTACT};
use crate::impact::frame_fit::CURVE_MM;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::result::reduction::Reduction;
use crate::mechanics::result::static_curve::StaticCurve;
use crate::mechanics::settings::MechanicsSettings;

/// Write a frame for simulators: MuJoCo, PyBullet, Gazebo; masses, contact shapes, motors, sensor, legs as springs.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  flexframe export cognifly-v8 --mjcf\n  flexframe export my-frame.toml --urdf --sdf -o models\n  flexframe export cognifly-v8 --mjcf --model paper\n\nWithout a format all three are written. docs/simulators.md describes the content of each."
)]
pub(super) struct Args {
    /// Which frame.
    #[command(flatten)]
    pub frame: FrameOption,
    /// For MuJoCo: frame.xml, and scene.xml with a floor.
    #[arg(long)]
    pub mjcf: bool,
    /// For PyBullet, ROS and others: frame.urdf. It has no springs.
    #[arg(long)]
    pub urdf: bool,
    /// For Gazebo: model.sdf and model.config.
    #[arg(long)]
    pub sdf: bool,
    /// Stiffness and damping of the legs: `frame`, the frame's own geometry, or those of an impact model, `paper`,
    /// `paper-corrected` or a TOML file.
    #[arg(long, default_value = FRAME_MODEL, value_name = "MODEL")]
    pub model: String,
    /// With --model frame: file with the numbers of the mechanics, instead of the built-in ones.
    #[arg(long, value_name = "TOML")]
    pub mechanics: Option<String>,
    /// Folder in which to write the folder `FRAME-simulators`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

/// Writes the folder.
pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    if args.model != FRAME_MODEL && args.mechanics.is_some() {
        return Err(Failure::Usage { message: "--mechanics goes with --model frame, the frame's own geometry".into() });
    }
    let working = Progress::of("exporting", common);
    let design = session::design(&args.frame, common)?;
    let masses = mass::table(&design);
    let given = if args.model == FRAME_MODEL { None } else { Some(Model::load(&args.model)?) };
    let legs = given.as_ref().map_or_else(|| own_legs(&design, &masses, args), |given| Ok(legs_of(given)))?;
    let model = simulator::model(&design, &masses, legs);
    let files = simulator::files(&model, &formats(args))
        .map_err(|error| Failure::Machine { what: format!("cannot make {}", error.what), error: error.error })?;
    let json =
        serde_json::to_value(&model).map_err(|error| Failure::Machine { what: "cannot make the JSON".into(), error: error.into() })?;
    drop(working);
    model.legs.doubt.iter().for_each(|doubt| terminal::tell(doubt));
    given.iter().filter_map(left_out).for_each(|warning| terminal::tell(&warning));
    pulling(&model).iter().for_each(|warning| terminal::tell(warning));
    let place = output::write_folder(&args.output, &format!("{}-simulators", design.frame.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}{}: {} files\n", table(&model), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The formats that are asked for; all where none is.
fn formats(args: &Args) -> Vec<SimulatorFormat> {
    let asked = |format: &SimulatorFormat| match format {
        SimulatorFormat::Mjcf => args.mjcf,
        SimulatorFormat::Urdf => args.urdf,
        SimulatorFormat::Sdf => args.sdf,
    };
    let chosen: Vec<SimulatorFormat> = SimulatorFormat::ALL.into_iter().filter(asked).collect();
    if chosen.is_empty() { SimulatorFormat::ALL.to_vec() } else { chosen }
}

/// Spring and damper of the frame's own geometry in an impact.
fn own_legs(design: &Design, masses: &MassTable, args: &Args) -> Result<LegSpring, Failure> {
    let settings = MechanicsSettings::load(args.mechanics.as_deref())?.for_material(&design.frame.flexible.material);
    let quarter = FrameModel::new(design, masses, &settings, Extent::Quarter).map_err(mechanics_refused)?;
    let curve = StaticCurve::new(&quarter, CURVE_MM, &[]).map_err(mechanics_refused)?;
    let reduction = Reduction::of(&quarter, &curve, masses.total_g * 1e-3, &settings).map_err(mechanics_refused)?;
    let doubt = settings.doubt(&design.frame.flexible);
    Ok(LegSpring { from: FRAME_MODEL.into(), stiffness_n_m: reduction.stiffness_n_mm * 1e3, damping_n_s_m: reduction.damping_n_s_m, doubt })
}

/// Spring and damper of an impact model; effects on top of them have no place in a simulator's files.
fn legs_of(model: &Model) -> LegSpring {
    let [stiffness_n_m, damping_n_s_m] = model.stiffness_and_damping();
    LegSpring { from: model.name.clone(), stiffness_n_m, damping_n_s_m, doubt: None }
}

/// What no motor can do in a hover: pull down, where the centre of mass is far from the middle.
fn pulling(model: &SimulatorModel) -> Vec<String> {
    let cannot = model.motors.iter().filter(|motor| motor.hover_thrust_n <= 0.0);
    let words = |motor: &Motor| {
        format!(
            "warning: a hover takes {:.3} N of {}, and no propeller pulls down: the centre of mass is too far from the middle, and the frame cannot hover",
            motor.hover_thrust_n, motor.name
        )
    };
    cannot.map(words).collect()
}

/// What of an impact model the files do not have. Feet push and never pull in every simulator.
fn left_out(model: &Model) -> Option<String> {
    let effects: Vec<&str> = model.acting().map(|(spec, _)| spec.id).filter(|id| *id != UNILATERAL_CONTACT.id).collect();
    (!effects.is_empty())
        .then(|| format!("warning: {} of {} is left out: a simulator's legs are a spring and a damper", effects.join(" and "), model.name))
}

/// Summary of the exported model.
fn table(model: &SimulatorModel) -> String {
    let SimulatorModel { whole, legs, motors, .. } = model;
    let [x, y, z] = whole.centre_m.map(|value| decimals(value * 1e3, 1));
    let mut text = format!("mass {:.1} g, centre {x}, {y}, {z} mm (x front, y left, z up)\n", whole.mass_kg * 1e3);
    text += &format!("legs {:.0} N/m and {:.1} N s/m ({})\n", legs.stiffness_n_m, legs.damping_n_s_m, legs.from);
    for motor in motors {
        let spin = motor.spin.abbreviation();
        text += &format!("{}  Betaflight's motor {}, {spin:<3}, {:.3} N in a hover\n", motor.name, motor.number, motor.hover_thrust_n);
    }
    text
}
