//! How the printed parts lie on the printer's bed, as data.

use flexframe::params::catalogue::Bed;
use flexframe::printing::plates::{self, Item, Plate};
use serde_json::{Value, json};

use crate::answer::Refused;
use crate::open_frame::OpenFrame;

/// The bed, and plate by plate what lies where: positions and turns (x, y, z, w) of the parts' STL files, mm.
///
/// # Errors
/// When a part has no room on the bed.
pub fn beds(open: &OpenFrame) -> Result<Value, Refused> {
    let design = &open.design;
    let printer = &design.frame.printer;
    let item = |item: &Item| {
        let pose = item.pose(design.part(item.part)?);
        let (at, turn) = (pose.translation.vector, pose.rotation.coords);
        Some(json!({ "part": item.part.slug(), "at_mm": [at.x, at.y, at.z], "turn": [turn.x, turn.y, turn.z, turn.w] }))
    };
    let plate = |plate: &Plate| json!({ "name": plate.name(), "material": plate.material.name, "items": plate.items.iter().filter_map(item).collect::<Vec<_>>() });
    let plates = plates::arrange(design, &plates::all(design)).map_err(Refused::plain)?;
    let round = printer.bed == Bed::Round;
    Ok(json!({
        "printer": { "name": printer.name, "round": round, "size_mm": printer.size_mm, "height_mm": printer.height_mm },
        "plates": plates.iter().map(plate).collect::<Vec<_>>(),
    }))
}
