//! Files of a frame, with the same bytes as the command line writes.

use flexframe::checks;
use flexframe::export::{File, Format, bom, fold_glb, fold_json, glb, step, stl, three_mf};
use flexframe::frame::fold::{FoldSequence, sweeps};
use flexframe::report::booklet::booklet_pdf;
use flexframe::report::booklet::content::Booklet;
use flexframe::report::frame_folder::{self, FolderChoice};
use serde_json::Value;

use crate::answer::Refused;
use crate::open_frame::OpenFrame;
use crate::request::Which;

/// The files that are asked for.
///
/// # Errors
/// When one cannot be made.
pub fn files(open: &OpenFrame, which: &[Which]) -> Result<Vec<File>, Refused> {
    let mut files = Vec::new();
    for which in which {
        files.extend(of(open, *which)?);
    }
    Ok(files)
}

fn of(open: &OpenFrame, which: Which) -> Result<Vec<File>, Refused> {
    let OpenFrame { design, masses, .. } = open;
    let format = |format: &Format| frame_folder::format_files(design, masses, format).map_err(Refused::plain);
    match which {
        Which::Stl => format(&stl::FORMAT),
        // Without what the other formats need: the printer's compensation takes longer than the file.
        Which::Glb => Ok(vec![File::new("frame.glb", glb::frame(design, masses).map_err(Refused::plain)?)]),
        Which::Plates => format(&three_mf::FORMAT),
        Which::Step => format(&step::FORMAT),
        Which::Bill => format(&bom::FORMAT),
        Which::Fold => {
            let sequence = sequence(open)?;
            let json = fold_json::fold_json(design, &sequence, &sweeps(design, &sequence)).map_err(Refused::plain)?;
            Ok(vec![File::new("fold.json", json)])
        }
        Which::FoldMotion => Ok(vec![File::new("fold.glb", fold_glb::fold(design, &sequence(open)?).map_err(Refused::plain)?)]),
        Which::Instructions => {
            let booklet = Booklet::new(design, masses, &sequence(open)?, &checks::check(design, masses));
            Ok(vec![File::new("instructions.pdf", booklet_pdf::pdf(&booklet).map_err(Refused::plain)?)])
        }
        Which::Report => {
            let to_read = |file: &File| file.path.ends_with(".md") || file.path.starts_with("pictures/");
            Ok(folder(open, false)?.into_iter().filter(to_read).collect())
        }
        Which::Folder => folder(open, true),
    }
}

/// What `build` writes.
fn folder(OpenFrame { design, masses, .. }: &OpenFrame, step: bool) -> Result<Vec<File>, Refused> {
    let findings = checks::check(design, masses);
    frame_folder::files(design, masses, &findings, FolderChoice { pictures: true, step }).map_err(Refused::plain)
}

/// The steps of the fold, as `fold.json` has them, without the search for collisions on the way.
///
/// # Errors
/// When the frame cannot be folded.
pub fn fold_steps(open: &OpenFrame) -> Result<Value, Refused> {
    let json = fold_json::fold_json(&open.design, &sequence(open)?, &[]).map_err(Refused::plain)?;
    serde_json::from_slice(&json).map_err(Refused::plain)
}

fn sequence(open: &OpenFrame) -> Result<FoldSequence, Refused> {
    let design = &open.design;
    let cannot = |error| Refused::plain(format!("{} cannot be folded: {error}", design.frame.name));
    FoldSequence::new(&design.frame, &design.skeleton).map_err(cannot)
}
