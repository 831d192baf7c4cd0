//! Reading an STL file, ours or a real one, and comparing two solids.

use std::io::{Read, Seek};
use std::path::{Path, PathBuf};

use flexframe::solid::{Mesh, MeshSolid};
use nalgebra::{Isometry3, Point3};

use super::figures::RealPart;

/// Where the real parts' files are. They carry no licence and are not part of the repository.
pub fn folder() -> PathBuf {
    let data = std::env::var_os("FLEXFRAME_DATA").map_or_else(|| "../shared/data".into(), PathBuf::from);
    Path::new(env!("CARGO_MANIFEST_DIR")).join(data).join("cognifly_v8_stl")
}

/// The facets of an STL file, moved, their corners joined where they are the same.
///
/// # Panics
/// When it is no STL file.
pub fn read(mut file: impl Read + Seek, pose: &Isometry3<f64>) -> Mesh {
    let facets: Vec<stl_io::Triangle> = stl_io::create_stl_reader(&mut file).and_then(Iterator::collect).expect("the file is an STL file");
    let corners = facets.iter().flat_map(|facet| facet.vertices);
    let positions: Vec<Point3<f64>> = corners.map(|v| pose * Point3::from(v.0.map(f64::from))).collect();
    let triangles: Vec<[u32; 3]> = (0..facets.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh::canonical(&positions, &triangles)
}

impl RealPart {
    /// The real part's surface in our part's axes.
    ///
    /// # Panics
    /// When the file cannot be read.
    pub fn mesh(&self) -> Mesh {
        let path = folder().join(&self.file);
        let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        read(std::io::Cursor::new(bytes), &self.pose())
    }

    /// The solid within it: its largest body, as one file has slivers inside.
    ///
    /// # Panics
    /// When it is not closed.
    pub fn solid(&self) -> MeshSolid {
        MeshSolid::from_mesh(&self.mesh()).unwrap_or_else(|| panic!("{} is not closed", self.file)).largest_body()
    }
}

/// Volume that two solids share over the volume of both together.
pub fn overlap(a: &MeshSolid, b: &MeshSolid) -> f64 {
    let shared = a.intersection(b).volume_mm3();
    shared / (a.volume_mm3() + b.volume_mm3() - shared)
}
