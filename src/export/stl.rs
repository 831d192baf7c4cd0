//! Binary STL, mm.

use std::io;

use stl_io::{Normal, Triangle, Vertex};

use super::format::{ExportError, Exported, File, Format};
use crate::frame::assembly::Printed;
use crate::solid::Mesh;

/// The printed parts, one file each.
pub const FORMAT: Format =
    Format { extension: "stl", sentence: "A printed part as it lies on the bed: binary STL, mm.", always: true, files };

fn files(of: &Exported) -> Result<Vec<File>, ExportError> {
    let file = |part: &Printed| {
        let mesh = of.meshes.mesh(part.name).unwrap_or(&part.mesh);
        Ok(File::of_part(part.name, FORMAT.extension, binary(mesh).map_err(ExportError::of(format!("{}.stl", part.name)))?))
    };
    of.design.printed.iter().map(file).collect()
}

/// A mesh as binary STL: facets in the mesh's order, with their outward unit normals.
///
/// # Errors
/// Only those of writing to memory.
pub fn binary(mesh: &Mesh) -> io::Result<Vec<u8>> {
    let facets: Vec<Triangle> = mesh
        .triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = mesh.corners(triangle);
            // A facet without area has no normal; three zeros are none in an STL.
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_default();
            Triangle {
                normal: Normal::new([normal.x as f32, normal.y as f32, normal.z as f32]),
                vertices: triangle.map(|corner| Vertex::new(mesh.vertices[corner as usize])),
            }
        })
        .collect();
    let mut bytes = Vec::with_capacity(84 + 50 * facets.len());
    stl_io::write_stl(&mut bytes, facets.iter())?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::{Feature, MeshSolid};

    #[test]
    fn analytic_a_cube_comes_back_with_its_volume() {
        let mesh = MeshSolid::build(&Feature::cuboid([2.0, 3.0, 4.0])).to_mesh();
        let bytes = binary(&mesh).expect("memory takes it");
        assert_eq!(bytes.len(), 84 + 50 * 12);
        let back = stl_io::read_stl(&mut io::Cursor::new(bytes)).expect("it is an STL");
        back.validate().expect("closed, with outward normals");
        assert_eq!(back.faces.len(), 12);
    }
}
