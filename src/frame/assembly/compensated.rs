//! What is written for a printer that prints holes too small and first layers too wide.
//!
//! The nominal part is what the frame is made of: its mass, its checks and its place in the assembly are those. Only the
//! files that are printed differ: round bores are drawn wider by the profile's `hole_undersize_mm`, whichever way
//! they lie, and what lies in the first layer is drawn in by its `elephant_foot_mm`, from outer outlines and from
//! holes alike. Without either the mesh is the part's own.

use std::borrow::Cow;
use std::collections::BTreeMap;

use rayon::prelude::*;

use super::design::{Design, DesignError};
use super::printed::{Printed, first_good, laid};
use crate::params::PartName;
use crate::params::catalogue::Printer;
use crate::solid::gate::{self, GateError};
use crate::solid::{Mesh, MeshSolid, Region};

/// The meshes that are printed.
pub struct Compensated<'a>(BTreeMap<PartName, Cow<'a, Mesh>>);

impl<'a> Compensated<'a> {
    /// Those of every printed part.
    ///
    /// # Errors
    /// When a part does not pass the export gate once it is changed.
    pub fn of(design: &'a Design) -> Result<Self, DesignError> {
        Self::some(design, |_| true)
    }

    /// Those of the printed parts that are asked for: what is not written need not be made.
    ///
    /// # Errors
    /// When one of them does not pass the export gate once it is changed.
    pub fn some(design: &'a Design, is_wanted: impl Fn(PartName) -> bool) -> Result<Self, DesignError> {
        let printer = &design.frame.printer;
        let mesh = |part: &'a Printed| {
            let layer_mm = printer.layer_mm(&design.material_of(part.name).material);
            let mesh = mesh(part, printer, layer_mm).map_err(|error| DesignError::Part { part: part.name, error })?;
            Ok((part.name, mesh))
        };
        let wanted: Vec<&Printed> = design.printed.iter().filter(|part| is_wanted(part.name)).collect();
        let meshes = wanted.into_par_iter().map(mesh).collect::<Result<Vec<_>, DesignError>>()?;
        Ok(Self(meshes.into_iter().collect()))
    }

    /// That of a part of the design.
    pub fn mesh(&self, name: PartName) -> Option<&Mesh> {
        self.0.get(&name).map(AsRef::as_ref)
    }
}

/// Cutters reach this far beyond the part, mm.
const PAST_MM: f64 = 1.0;

/// Detail that is simplified away, mm, in the order in which it is tried: where the border of a cut grazes a facet, more has to go.
const DETAILS_MM: [f64; 7] = [0.001, 0.002, 0.004, 0.008, 0.0005, 0.0002, 0.0001];
/// Finest detail of an outline that is drawn in, mm, and how far its layer's top is moved, mm, in the order in which they are tried: a
/// cut that runs along a facet's edge can leave facets without area, another one then does not. A printer places 0.01 mm at best.
const CUTS_MM: [[f64; 2]; 6] = [[0.001, 0.0], [0.001, 0.003], [0.004, 0.0], [0.004, -0.003], [0.01, 0.0], [0.01, 0.005]];

/// The mesh of a part that is printed; `layer_mm` is the height of the first layer.
///
/// # Errors
/// When it does not pass the export gate: the profile takes away what the part is made of.
pub fn mesh<'a>(part: &'a Printed, printer: &Printer, layer_mm: f64) -> Result<Cow<'a, Mesh>, GateError> {
    let [hole_mm, foot_mm] = [printer.hole_undersize_mm, printer.elephant_foot_mm].map(|mm| mm.unwrap_or(0.0));
    if hole_mm == 0.0 && foot_mm == 0.0 {
        return Ok(Cow::Borrowed(&part.mesh));
    }
    let solid = if hole_mm == 0.0 {
        part.printed()
    } else {
        let feature = part.feature.with_wider_bores(0.5 * hole_mm);
        laid(&MeshSolid::build(&feature).simplified(), &part.print_pose.rotation)?.0
    };
    drawn_in_below(&solid, foot_mm, layer_mm).map(Cow::Owned)
}

/// The mesh of a solid that stands on z = 0, its first layer of this height drawn in by so much, mm; as it is where that is 0.
///
/// # Errors
/// When it does not pass the export gate.
pub fn drawn_in_below(solid: &MeshSolid, foot_mm: f64, layer_mm: f64) -> Result<Mesh, GateError> {
    if foot_mm == 0.0 {
        return sound(solid);
    }
    let mut refused = GateError::Empty;
    for [fine_mm, moved_mm] in CUTS_MM {
        match sound(&drawn_in(solid, foot_mm, layer_mm + moved_mm, fine_mm)) {
            Ok(mesh) => return Ok(mesh),
            Err(error) => refused = error,
        }
    }
    Err(refused)
}

/// The mesh of a solid without detail. The upright walls of a cut meet slopes of the part in corners that lie on one line: what has no
/// area there is taken out, as no other amount of detail or place of the cut does that for every figure.
fn sound(solid: &MeshSolid) -> Result<Mesh, GateError> {
    first_good(solid, &DETAILS_MM, |solid| {
        if solid.is_empty() {
            return Err(GateError::Empty);
        }
        let mesh = solid.mesh();
        let mesh = match gate::pass(&mesh) {
            Err(GateError::ZeroArea { .. }) => mesh.without_flat_facets(),
            _ => mesh,
        };
        gate::pass(&mesh).map(|_| mesh)
    })
}

/// The solid whose first layer has its outline drawn in; what is finer than `fine_mm` is left out of the outline.
fn drawn_in(solid: &MeshSolid, by_mm: f64, layer_mm: f64, fine_mm: f64) -> MeshSolid {
    let [low, high] = solid.bounds_mm();
    let around = Region::rectangle([[low[0], low[1]], [high[0], high[1]]], PAST_MM);
    let kept = solid.slice(0.5 * layer_mm).grown(-by_mm).simplified(fine_mm);
    solid.minus(&around.minus(&kept).drawn_up(-PAST_MM, layer_mm))
}
