//! `flexframe drop --model frame`: the impact from the frame's own geometry.

use std::process::ExitCode;

use super::arguments::{Common, DropOptions, FrameOption};
use super::output;
use super::progress::Progress;
use super::session::{self, Failure};
use super::stiffness::refused;
use super::terminal;
use crate::assembly::mass;
use crate::checks;
use crate::mechanics::deformed::Bound;
use crate::mechanics::frame_model::{Extent, FrameModel};
use crate::mechanics::impact::{Impact, Run};
use crate::mechanics::parts_plan::part_models;
use crate::mechanics::settings::Settings;
use crate::report::impact_data::{self, Impacts};
use crate::report::picture::View;
use crate::report::{bent_scene, impact_plots};

/// Drops a frame's own model and writes its folder.
pub(super) fn drop_frame(options: &DropOptions, heights_m: &[f64], common: &Common) -> Result<ExitCode, Failure> {
    let Some(frame) = &options.frame else {
        return Err(Failure::Usage { message: "--model frame needs a frame: flexframe drop cognifly --model frame".into() });
    };
    let settings = Settings::load(options.mechanics.as_deref())?;
    let working = Progress::of("dropping", common);
    let design = session::design(&FrameOption { frame: frame.clone(), rigid: options.rigid.clone() })?;
    let masses = mass::table(&design);
    let parts = part_models(&design, &settings).map_err(refused)?;
    let model = FrameModel::of_parts(&design, &parts, &masses, &settings, Extent::Quarter).map_err(refused)?;
    let drop = |height_m: &f64| Impact::new(&model, &settings, *height_m, &Run::default()).map_err(refused);
    let impacts = heights_m.iter().map(drop).collect::<Result<Vec<_>, _>>()?;
    let gap_mm = checks::ground_clearance(&design, &masses).map(|ground| ground.clearance_mm);
    let found = Impacts { frame: &design.frame.name, settings: &settings, mass_g: masses.total_g, gap_mm, impacts: &impacts };
    let json = impact_data::json(&found, options.trace);
    let mut files = impact_plots::plots(&found)
        .map_err(|error| Failure::Machine { what: "cannot make the plots".into(), error: std::io::Error::other(error) })?;
    files.push(("trace.csv".into(), impact_data::trace_csv(&found).into_bytes()));
    files.push(("impact.json".into(), format!("{json:#}\n").into_bytes()));
    if let Some(highest) = impacts.iter().max_by(|a, b| a.height_m.total_cmp(&b.height_m)) {
        let whole = FrameModel::of_parts(&design, &parts, &masses, &settings, Extent::Whole).map_err(refused)?;
        let bound = Bound::new(&design, &whole);
        for (t_ms, state) in highest.states.iter().step_by(2) {
            let Some(bound) = &bound else { continue };
            let bodies = bound.bent(&whole.unfolded(&model, state));
            files.push((format!("pictures/{:02.0}_ms.png", t_ms), bent_scene::picture(&design, &bodies, View::Right)));
        }
    }
    std::mem::drop(working);
    let place = output::write_folder(&options.output, &format!("drop-frame-{}", design.frame.name), &files)?;
    if common.json {
        terminal::print_json(&json)?;
    } else if !common.quiet {
        terminal::print(&format!("{}{}: {} files\n", impact_data::table(&found), place.display(), files.len()))?;
    }
    Ok(ExitCode::SUCCESS)
}
