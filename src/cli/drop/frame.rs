//! `flexframe drop --model frame`: the impact from the frame's own geometry.

use std::process::ExitCode;

use super::arguments::Args;
use crate::checks;
use crate::cli::failure::{Failure, mechanics_refused};
use crate::cli::options::{Common, FrameOption};
use crate::cli::progress::Progress;
use crate::cli::{output, session, terminal};
use crate::frame::assembly::mass;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::parts::parts_plan::part_models;
use crate::mechanics::result::deformed::Bound;
use crate::mechanics::result::impact::{Impact, Run};
use crate::mechanics::result::underside::Underside;
use crate::mechanics::settings::MechanicsSettings;
use crate::mechanics::system::structure::State;
use crate::report::chart::impact_plots;
use crate::report::data::impact_data;
use crate::report::data::impact_data::Impacts;
use crate::report::picture::deformed_scene;
use crate::report::picture::image::View;
use crate::units::Angle;

/// The frame that is dropped.
pub(super) fn frame(args: &Args) -> Result<FrameOption, Failure> {
    let Some(frame) = &args.frame else {
        return Err(Failure::Usage { message: "--model frame needs a frame: flexframe drop cognifly --model frame".into() });
    };
    Ok(FrameOption { frame: frame.clone(), rigid: args.rigid.clone() })
}

/// Drops a frame's own model and writes its folder.
pub(super) fn run(args: &Args, heights_m: &[f64], common: &Common) -> Result<ExitCode, Failure> {
    let frame = frame(args)?;
    let stated = MechanicsSettings::load(args.mechanics.as_deref())?;
    let working = Progress::of("dropping", common);
    let design = session::design(&frame, common)?;
    let masses = mass::table(&design);
    let settings = stated.for_material(&design.frame.flexible.material);
    settings.doubt(&design.frame.flexible).iter().for_each(|doubt| terminal::tell(doubt));
    let parts = part_models(&design, &settings).map_err(mechanics_refused)?;
    let tilt = tilt(args)?;
    let is_tilted = args.tilt.iter().any(|degrees| *degrees != 0.0);
    let (extent, run) = if is_tilted { (Extent::Whole, Run::tilted(tilt)) } else { (Extent::Quarter, Run::default()) };
    let model = FrameModel::of_parts(&design, &parts, &masses, &settings, extent).map_err(mechanics_refused)?;
    let drop = |height_m: &f64| Impact::new(&model, &settings, *height_m, &run).map_err(mechanics_refused);
    let impacts = heights_m.iter().map(drop).collect::<Result<Vec<_>, _>>()?;
    let underside = checks::ground_clearance(&design, &masses).map(|ground| Underside::of(&design, &model, ground.clearance_mm));
    let tilt_deg = <[f64; 2]>::try_from(args.tilt.as_slice()).unwrap_or_default();
    let found = Impacts { frame: &design.frame.name, settings: &settings, mass_g: masses.total_g, underside, tilt_deg, impacts: &impacts };
    let json = impact_data::json(&found, args.trace);
    let mut files = impact_plots::plots(&found)?;
    files.push(("trace.csv".into(), impact_data::trace_csv(&found)?.into_bytes()));
    files.push(("impact.json".into(), format!("{json:#}\n").into_bytes()));
    if let Some(highest) = impacts.iter().max_by(|a, b| a.height_m.total_cmp(&b.height_m)) {
        let whole = FrameModel::of_parts(&design, &parts, &masses, &settings, Extent::Whole).map_err(mechanics_refused)?;
        let shown: Vec<_> = highest.states.iter().step_by(2).collect();
        if let Some(bound) = Bound::new(&design, &whole) {
            let shapes: Vec<_> = shown.iter().map(|(_, state)| bound.deformed(&whole.unfolded(&model, state))).collect();
            let pictures = deformed_scene::pictures_on_ground(&design, &shapes, View::Right);
            let named =
                |((t_ms, _), picture): (&&(f64, State), Vec<u8>)| (format!("pictures/{}_m_{t_ms:02.0}_ms.png", highest.height_m), picture);
            files.extend(shown.iter().zip(pictures).map(named));
        }
    }
    std::mem::drop(working);
    let place = output::write_folder(&args.output, &format!("drop-frame-{}", design.frame.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}{}: {} files\n", impact_data::table(&found), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// How the frame is turned when it touches.
fn tilt(args: &Args) -> Result<[Angle; 2], Failure> {
    match args.tilt[..] {
        [] => Ok([Angle::deg(0.0); 2]),
        [x, y] => Ok([Angle::deg(x), Angle::deg(y)]),
        _ => Err(Failure::Usage { message: "--tilt takes two angles about X and Y: --tilt 5,0".into() }),
    }
}
