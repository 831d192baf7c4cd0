//! Plates as 3MF, by the core specification of the 3MF Consortium, version 1.3: objects with names and colours, placed on the
//! bed, in millimetres; the settings of each object for PrusaSlicer, for Orca Slicer and Bambu Studio, and for Cura, each where it looks
//! for them.
//!
//! Every copy is an object that refers to the part's mesh. PrusaSlicer reads that as instances of the part, as it writes them itself.
//! Orca, which makes instances in files of other programs into objects of their own before it applies settings, finds one object
//! with settings for each copy (`src/libslic3r/Format/bbs_3mf.cpp` of OrcaSlicer 00fcb7e5).

use std::io::{Cursor, Write};

use nalgebra::Isometry3;
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};
use rayon::prelude::*;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::colour::curved;
use super::format::{ExportError, Exported, File, Format};
use crate::frame::assembly::Design;
use crate::frame::assembly::compensated::Compensated;
use crate::params::PartName;
use crate::params::catalogue::Printer;
use crate::params::frame::NamedMaterial;
use crate::printing::plates::{Plate, PrintSettings, SlicerFamily};
use crate::solid::Mesh;

/// The plates, each with its picture beside it.
pub const FORMAT: Format = Format {
    extension: "3mf",
    sentence: "A plate for the slicer: every copy in its place on the printer's bed, with its print settings.",
    always: true,
    files,
};

fn files(of: &Exported) -> Result<Vec<File>, ExportError> {
    let files = |(on, picture): &(Plate, Vec<u8>)| {
        let name = on.name();
        let bytes = plate(of.design, of.meshes, on, picture).map_err(ExportError::of(format!("{name}.3mf")))?;
        Ok([File::new(format!("plates/{name}.3mf"), bytes), File::new(format!("plates/{name}.png"), picture.clone())])
    };
    Ok(of.plates.par_iter().map(files).collect::<Result<Vec<_>, ExportError>>()?.into_iter().flatten().collect())
}

/// Core namespace.
const CORE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
/// Namespace of PrusaSlicer's version of the model: with it instances of an object stay instances.
const SLIC3R: &str = "http://schemas.slic3r.org/3mf/2017/06";
/// Namespace of Cura's settings, which are metadata of the mesh (libSavitar d2e6c28f, `src/Namespace.cpp`).
const CURA: &str = "http://software.ultimaker.com/xml/cura/3mf/2015/10";
/// Id of the material.
const MATERIAL: &str = "1";

const TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/><Default Extension="png" ContentType="image/png"/><Default Extension="config" ContentType="application/xml"/></Types>
"#;

const RELATIONS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel-1" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/><Relationship Target="/Metadata/thumbnail.png" Id="rel-2" Type="http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail"/></Relationships>
"#;

/// Something on a plate.
pub struct Object<'a> {
    /// Its name.
    pub name: &'a str,
    /// What is printed, in its own axes, mm.
    pub mesh: &'a Mesh,
    /// Where each copy of it lies: from those axes to the bed's.
    pub poses: Vec<Isometry3<f64>>,
    /// How it is printed.
    pub settings: PrintSettings,
}

/// What a file holds.
pub struct Contents<'a> {
    /// What it is called.
    pub title: String,
    /// The printer that it is laid out for.
    pub printer: &'a Printer,
    /// What all of it is printed of.
    pub material: &'a NamedMaterial,
    /// What lies on it.
    pub objects: Vec<Object<'a>>,
}

/// An object with its id, and the id and place of each copy.
struct Numbered<'a> {
    id: String,
    object: &'a Object<'a>,
    copies: Vec<(String, &'a Isometry3<f64>)>,
}

/// A plate's file; `meshes` are what is printed, `thumbnail` is a PNG.
///
/// # Errors
/// When the archive cannot be made; it is made in memory.
pub fn plate(design: &Design, meshes: &Compensated, plate: &Plate, thumbnail: &[u8]) -> std::io::Result<Vec<u8>> {
    let object = |(name, _): &(PartName, usize)| {
        let part = design.part(*name)?;
        let poses = plate.items.iter().filter(|item| item.part == *name).map(|item| item.pose(part)).collect();
        let settings = PrintSettings::of_part(plate.supported.contains(name), &plate.material.material, &design.frame.printer);
        Some(Object { name: part.name.slug(), mesh: meshes.mesh(*name)?, poses, settings })
    };
    let contents = Contents {
        title: format!("{} {}", design.frame.name, plate.name()),
        printer: &design.frame.printer,
        material: &plate.material,
        objects: plate.quantities().iter().filter_map(object).collect(),
    };
    archive(&contents, thumbnail)
}

/// The file of what lies on a plate; `thumbnail` is a PNG.
///
/// # Errors
/// When the archive cannot be made; it is made in memory.
pub fn archive(contents: &Contents, thumbnail: &[u8]) -> std::io::Result<Vec<u8>> {
    let objects = numbered(contents);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let files: [(&str, Vec<u8>); 6] = [
        ("[Content_Types].xml", TYPES.into()),
        ("_rels/.rels", RELATIONS.into()),
        ("3D/3dmodel.model", model(contents, &objects)?),
        ("Metadata/Slic3r_PE_model.config", prusa_settings(&objects)?),
        ("Metadata/model_settings.config", orca_settings(&objects)?),
        ("Metadata/thumbnail.png", thumbnail.to_vec()),
    ];
    for (name, bytes) in files {
        // The same input gives the same bytes: no date of today.
        let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated).last_modified_time(DateTime::default());
        archive.start_file(name, options).map_err(std::io::Error::other)?;
        archive.write_all(&bytes)?;
    }
    Ok(archive.finish().map_err(std::io::Error::other)?.into_inner())
}

/// What lies on a plate. Id 1 is the material's; the meshes come next, then the copies.
fn numbered<'a>(contents: &'a Contents) -> Vec<Numbered<'a>> {
    let mut ids = (2..).map(|id: usize| id.to_string());
    let meshes: Vec<(String, &Object)> = ids.by_ref().zip(&contents.objects).collect();
    meshes.into_iter().map(|(id, object)| Numbered { id, object, copies: ids.by_ref().zip(&object.poses).collect() }).collect()
}

type Xml = Writer<Cursor<Vec<u8>>>;

fn model(contents: &Contents, objects: &[Numbered]) -> std::io::Result<Vec<u8>> {
    let mut xml = begun()?;
    let top = [("unit", "millimeter"), ("xml:lang", "en-US"), ("xmlns", CORE), ("xmlns:slic3rpe", SLIC3R), ("xmlns:cura", CURA)];
    xml.create_element("model").with_attributes(top).write_inner_content(|xml| {
        for (name, text) in [
            ("slic3rpe:Version3mf", "1".to_string()),
            ("Title", contents.title.clone()),
            ("Description", format!("printed of {}, laid out for {}", contents.material.name, contents.printer.name)),
            ("Application", format!("flexframe {}", env!("CARGO_PKG_VERSION"))),
        ] {
            xml.create_element("metadata").with_attribute(("name", name)).write_text_content(BytesText::new(&text))?;
        }
        xml.create_element("resources").write_inner_content(|xml| resources(xml, contents, objects))?;
        xml.create_element("build").write_inner_content(|xml| {
            for object in objects {
                for (id, pose) in &object.copies {
                    let place = [("objectid", id.as_str()), ("transform", &transform(pose)), ("partnumber", object.object.name)];
                    xml.create_element("item").with_attributes(place).write_empty()?;
                }
            }
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(xml.into_inner().into_inner())
}

fn begun() -> std::io::Result<Xml> {
    let mut xml = Writer::new(Cursor::new(Vec::new()));
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    Ok(xml)
}

fn resources(xml: &mut Xml, contents: &Contents, objects: &[Numbered]) -> std::io::Result<()> {
    let colour = display_colour(contents.material.material.colour);
    xml.create_element("basematerials").with_attribute(("id", MATERIAL)).write_inner_content(|xml| {
        let base = [("name", contents.material.name.as_str()), ("displaycolor", &colour)];
        xml.create_element("base").with_attributes(base).write_empty()?;
        Ok(())
    })?;
    for object in objects {
        let name = object.object.name;
        let about =
            [("id", object.id.as_str()), ("type", "model"), ("name", name), ("partnumber", name), ("pid", MATERIAL), ("pindex", "0")];
        xml.create_element("object").with_attributes(about).write_inner_content(|xml| {
            xml.create_element("metadatagroup").write_inner_content(|xml| {
                for (key, value) in object.object.settings.of(SlicerFamily::Cura) {
                    let name = format!("cura:{key}");
                    xml.create_element("metadata").with_attribute(("name", name.as_str())).write_text_content(BytesText::new(value))?;
                }
                Ok(())
            })?;
            xml.create_element("mesh").write_inner_content(|xml| mesh(xml, object.object.mesh))?;
            Ok(())
        })?;
    }
    for object in objects {
        for (id, _) in &object.copies {
            let about = [("id", id.as_str()), ("type", "model"), ("name", object.object.name)];
            xml.create_element("object").with_attributes(about).write_inner_content(|xml| {
                xml.create_element("components").write_inner_content(|xml| {
                    xml.create_element("component").with_attribute(("objectid", object.id.as_str())).write_empty()?;
                    Ok(())
                })?;
                Ok(())
            })?;
        }
    }
    Ok(())
}

fn mesh(xml: &mut Xml, mesh: &Mesh) -> std::io::Result<()> {
    xml.create_element("vertices").write_inner_content(|xml| {
        for vertex in &mesh.vertices {
            // The shortest decimals that give the same f32 again.
            let [x, y, z] = vertex.map(|value| value.to_string());
            xml.create_element("vertex").with_attributes([("x", x.as_str()), ("y", &y), ("z", &z)]).write_empty()?;
        }
        Ok(())
    })?;
    xml.create_element("triangles").write_inner_content(|xml| {
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.map(|corner| corner.to_string());
            xml.create_element("triangle").with_attributes([("v1", a.as_str()), ("v2", &b), ("v3", &c)]).write_empty()?;
        }
        Ok(())
    })?;
    Ok(())
}

/// Rows of the matrix that a row vector is multiplied by, then the shift, mm.
fn transform(pose: &Isometry3<f64>) -> String {
    let matrix = pose.to_homogeneous();
    let columns = (0..4).flat_map(|column| (0..3).map(move |row| (row, column)));
    let number = |(row, column)| {
        let value: f64 = (matrix[(row, column)] * 1e6_f64).round() / 1e6;
        (if value == 0.0 { 0.0 } else { value }).to_string()
    };
    columns.map(number).collect::<Vec<_>>().join(" ")
}

/// Linear red, green, blue, alpha as sRGB in hexadecimals.
fn display_colour(linear: [f32; 4]) -> String {
    let byte = |share: f64| (share * 255.0).round() as u8;
    let [r, g, b] = [0, 1, 2].map(|channel| byte(curved(linear[channel])));
    format!("#{r:02X}{g:02X}{b:02X}{:02X}", byte(f64::from(linear[3])))
}

/// PrusaSlicer's settings of each object.
fn prusa_settings(objects: &[Numbered]) -> std::io::Result<Vec<u8>> {
    let mut xml = begun()?;
    xml.create_element("config").write_inner_content(|xml| {
        for object in objects {
            let copies = object.copies.len().to_string();
            let name = object.object.name;
            xml.create_element("object").with_attributes([("id", object.id.as_str()), ("instances_count", &copies)]).write_inner_content(
                |xml| {
                    metadata(xml, Some("object"), "name", name)?;
                    for (key, value) in object.object.settings.of(SlicerFamily::Prusa) {
                        metadata(xml, Some("object"), key, value)?;
                    }
                    let last = (object.object.mesh.triangles.len() - 1).to_string();
                    xml.create_element("volume").with_attributes([("firstid", "0"), ("lastid", &last)]).write_inner_content(|xml| {
                        metadata(xml, Some("volume"), "name", name)?;
                        metadata(xml, Some("volume"), "volume_type", "ModelPart")
                    })?;
                    Ok(())
                },
            )?;
        }
        Ok(())
    })?;
    Ok(xml.into_inner().into_inner())
}

/// Settings of each copy for Orca Slicer and Bambu Studio.
fn orca_settings(objects: &[Numbered]) -> std::io::Result<Vec<u8>> {
    let mut xml = begun()?;
    xml.create_element("config").write_inner_content(|xml| {
        for (object, (id, _)) in objects.iter().flat_map(|object| object.copies.iter().map(move |copy| (object, copy))) {
            let name = object.object.name;
            xml.create_element("object").with_attribute(("id", id.as_str())).write_inner_content(|xml| {
                metadata(xml, None, "name", name)?;
                for (key, value) in object.object.settings.of(SlicerFamily::Orca) {
                    metadata(xml, None, key, value)?;
                }
                let part = [("id", object.id.as_str()), ("subtype", "normal_part")];
                xml.create_element("part").with_attributes(part).write_inner_content(|xml| metadata(xml, None, "name", name))?;
                Ok(())
            })?;
        }
        Ok(())
    })?;
    Ok(xml.into_inner().into_inner())
}

fn metadata(xml: &mut Xml, kind: Option<&str>, key: &str, value: &str) -> std::io::Result<()> {
    let kind = kind.map(|kind| ("type", kind));
    xml.create_element("metadata").with_attributes(kind).with_attributes([("key", key), ("value", value)]).write_empty()?;
    Ok(())
}
