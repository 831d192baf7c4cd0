//! The STEP files of a frame: each printed part, and the assembly.

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::product::{Context, Product};
use super::shape;
use super::shaped::Shaped;
use super::writer::Writer;
use crate::export::format::{ExportError, Exported, File, Format, Made};
use crate::frame::assembly::{BodyKind, Design, Printed, Shape};
use crate::solid::{Boundary, Feature, Mesh, NotExact};

/// Linear red, green, blue, alpha of a solid without a colour.
const GREY: [f32; 4] = [0.4, 0.4, 0.4, 1.0];

/// A mesh that cannot be a solid.
#[derive(Debug, thiserror::Error)]
#[error("the mesh of {name} is not closed")]
pub struct StepError {
    name: String,
}

/// The printed parts, one file each, and the assembly.
pub const FORMAT: Format = Format {
    extension: "step",
    sentence: "Parts and assembly for a CAD program: STEP AP214, exact where the kernel can, facets elsewhere.",
    always: false,
    files,
};

/// Every printed part in its print orientation, and the assembled frame.
fn files(of: &Exported) -> Result<Vec<File>, ExportError> {
    let design = of.design;
    let parts = design.printed.par_iter().map(|part| printed(design, part)).collect::<Result<Vec<_>, _>>();
    let parts = parts.map_err(ExportError::of("STEP files"))?;
    let shapes = design.shapes.par_iter().map(|shape| assembled(design, shape, &parts)).collect::<Result<Vec<_>, _>>();
    let shapes = shapes.map_err(ExportError::of("STEP files"))?;
    let mut files: Vec<File> = design.printed.par_iter().zip(&parts).map(|(part, shaped)| part_of(part, shaped)).collect();
    let mut assembly = File::new("frame.step", frame_file(design, &shapes));
    assembly.solids = shapes.iter().map(|shape| shape.entry(&assembly.path)).collect();
    files.push(assembly);
    Ok(files)
}

fn part_of(part: &Printed, shaped: &Shaped) -> File {
    let mut file = File::of_part(part.name, FORMAT.extension, part_file(shaped));
    file.solids = vec![shaped.entry(&file.path)];
    file
}

/// How a solid was made.
struct Solid {
    boundary: Boundary,
    made: Made,
    because: Option<String>,
}

/// A mesh as a solid: exact by the first of these meshes that fits the surfaces of the feature, else mixed by the first that does in
/// part, else the last, faceted.
fn solid_of(name: &str, meshes: &[&Mesh], by: Option<(&Feature, Isometry3<f64>)>) -> Result<Solid, StepError> {
    let mut refused: Option<NotExact> = None;
    for (mesh, (feature, pose)) in meshes.iter().zip(by.iter().cycle()) {
        match Boundary::exact(mesh, feature, pose) {
            Ok(boundary) => return Ok(Solid { boundary, made: Made::Exact, because: None }),
            Err(error) => refused = refused.or(Some(error)),
        }
    }
    let because = refused.map(|refused| refused.to_string());
    let mixed = by.and_then(|(feature, pose)| meshes.iter().find_map(|mesh| Boundary::mixed(mesh, feature, &pose)));
    if let Some(boundary) = mixed {
        return Ok(Solid { boundary, made: Made::Mixed, because });
    }
    let boundary = meshes.last().and_then(|mesh| Boundary::faceted(mesh)).ok_or_else(|| StepError { name: name.into() })?;
    Ok(Solid { boundary, made: Made::Faceted, because })
}

fn printed(design: &Design, part: &Printed) -> Result<Shaped, StepError> {
    // What was simplified away can be where two surfaces touch; then a facet of the written mesh stands for both.
    let raw = part.raw().placed(&part.print_pose).mesh();
    let Solid { boundary, made, because } = solid_of(part.name.slug(), &[&raw, &part.mesh], Some((&part.feature, part.print_pose)))?;
    let material = design.material_of(part.name);
    Ok(Shaped {
        name: part.name.slug().into(),
        material: material.name.clone(),
        colour: material.material.colour,
        boundary,
        made,
        because,
        mesh_volume_mm3: part.volume_mm3,
    })
}

/// A shape of the assembly; a part that does not bend is the printed one, turned back.
fn assembled(design: &Design, shape: &Shape, parts: &[Shaped]) -> Result<Shaped, StepError> {
    let (name, material) = (shape.name.clone(), shape.material.clone());
    let (colour, mesh_volume_mm3) = (shape.colour, shape.mesh.volume_mm3());
    let rigid = |(part, _): &(&Printed, &Shaped)| shape.kind == BodyKind::Printed(part.name) && part.bends.is_empty();
    if let Some((part, shaped)) = design.printed.iter().zip(parts).find(rigid) {
        let boundary = shaped.boundary.placed(&part.print_pose.inverse());
        return Ok(Shaped { name, material, colour, boundary, made: shaped.made, because: shaped.because.clone(), mesh_volume_mm3 });
    }
    let by = shape.feature.as_ref().map(|feature| (feature, Isometry3::identity()));
    let Solid { boundary, made, because } = solid_of(&name, &[&shape.mesh], by)?;
    let because = if by.is_none() { Some("it is folded".into()) } else { because };
    Ok(Shaped { name, material, colour, boundary, made, because, mesh_volume_mm3 })
}

/// A file with one solid, grey.
pub fn solid(name: &str, boundary: Boundary, made: Made) -> Vec<u8> {
    let mesh_volume_mm3 = boundary.volume_mm3();
    let (name, material, colour) = (name.into(), String::new(), GREY);
    part_file(&Shaped { name, material, colour, boundary, made, because: None, mesh_volume_mm3 })
}

fn part_file(part: &Shaped) -> Vec<u8> {
    let mut writer = Writer::new(&format!("{}.step", part.name), &about(part));
    let context = Context::new(&mut writer);
    context.part(&mut writer, part);
    writer.finish()
}

fn about(part: &Shaped) -> String {
    match part.made {
        Made::Exact => format!("{}: exact", part.name),
        Made::Mixed => format!(
            "{}: {} of {} faces are facets of the mesh, by the name '{}'",
            part.name,
            part.facets(),
            part.boundary.faces.len(),
            shape::FACET
        ),
        Made::Faceted => format!("{}: faceted, curved faces are narrow plane ones", part.name),
    }
}

/// The assembly; bodies that share a shape share its solid.
fn frame_file(design: &Design, shapes: &[Shaped]) -> Vec<u8> {
    let mut writer = Writer::new("frame.step", &format!("{}: {}", design.frame.name, design.frame.description));
    let context = Context::new(&mut writer);
    let products: Vec<Product> = shapes.iter().map(|shape| context.part(&mut writer, shape)).collect();
    let bodies: Vec<_> = design.bodies.iter().map(|body| (body.name.clone(), body.shape, body.pose)).collect();
    context.assembly(&mut writer, &design.frame.name, &products, &bodies);
    writer.finish()
}
