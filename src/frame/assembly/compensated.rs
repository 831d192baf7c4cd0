//! What is written for a printer that prints holes too small and first layers too wide.
//!
//! The nominal part is what the frame is made of: its mass, its checks and its place in the assembly are those. Only the
//! files that are printed differ: round bores are drawn wider by the profile's `hole_undersize_mm`, whichever way
//! they lie, and what lies in the first layer is drawn in by its `elephant_foot_mm`, from outer outlines and from
//! holes alike; by less, in quarters of it, where less than a line of a wall would be left. Without either the mesh is the part's own.

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
    drawn_in_below(&solid, printer, layer_mm).map(Cow::Owned)
}

/// The mesh of a solid that stands on z = 0, its first layer of this height drawn in as the printer needs it; as it is where that is by
/// nothing.
///
/// # Errors
/// When it does not pass the export gate.
pub fn drawn_in_below(solid: &MeshSolid, printer: &Printer, layer_mm: f64) -> Result<Mesh, GateError> {
    let foot_mm = printer.elephant_foot_mm.unwrap_or(0.0);
    if foot_mm == 0.0 {
        return sound(solid);
    }
    let outline = narrowed(&solid.slice(0.5 * layer_mm), foot_mm, printer.line_mm());
    let mut refused = GateError::Empty;
    for [fine_mm, moved_mm] in CUTS_MM {
        match sound(&cut_below(solid, &outline.simplified(fine_mm), layer_mm + moved_mm)) {
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

/// The solid of whose first layer this outline is left.
fn cut_below(solid: &MeshSolid, outline: &Region, layer_mm: f64) -> MeshSolid {
    let [low, high] = solid.bounds_mm();
    let around = Region::rectangle([[low[0], low[1]], [high[0], high[1]]], PAST_MM);
    solid.minus(&around.minus(outline).drawn_up(-PAST_MM, layer_mm))
}

/// Shares of the whole by which walls are drawn in that would have less than a line left otherwise, the largest first.
const SHARES: [f64; 4] = [0.75, 0.5, 0.25, 0.0];

/// An outline drawn in by so much. Of a wall at least a line is left, where it is as wide as that: a slicer lays nothing of what is narrower than half of a
/// line, and leaves the walls above without what they stand on.
fn narrowed(outline: &Region, by_mm: f64, line_mm: f64) -> Region {
    let opened = |figure: &Region, width_mm: f64| figure.grown(-0.5 * width_mm).grown(0.5 * width_mm);
    let mut too_much_mm = by_mm;
    let mut left = outline.grown(-by_mm);
    for share in SHARES {
        // What is no wall but the corner of something wide is smaller than half of a line.
        let walls = opened(&outline.minus(&opened(outline, line_mm + 2.0 * too_much_mm)), 0.5 * line_mm);
        if walls.is_empty() {
            break;
        }
        too_much_mm = share * by_mm;
        // As far as into what they end in, which is drawn in by more.
        let reaching = walls.grown(by_mm + 0.5 * line_mm);
        left = left.union(&outline.grown(-too_much_mm).intersection(&reaching));
    }
    left
}
