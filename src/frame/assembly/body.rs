//! Bodies of the assembly: a shape in a place.

use std::borrow::Cow;
use std::sync::Arc;

use nalgebra::Isometry3;

use super::centre_body::CentreBody;
use crate::frame::parts::record;
use crate::frame::skeleton::RodRole;
use crate::params::{Frame, PartName};
use crate::solid::{Feature, Mesh, MeshSolid};

/// What a body is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BodyKind {
    /// A printed part.
    Printed(PartName),
    /// A rod.
    Rod(RodRole),
    /// A motor.
    Motor,
    /// The disc that a propeller sweeps.
    Propeller,
    /// Something bought that sits in the centre, by its name.
    Bought(&'static str),
}

impl BodyKind {
    /// Whether it is a part printed of the flexible material.
    pub fn is_flexible(self) -> bool {
        matches!(self, Self::Printed(name) if record(name).is_flexible())
    }

    /// The line of the bill and of the mass table that it is of.
    pub fn bill_line(self) -> Cow<'static, str> {
        match self {
            Self::Printed(name) => name.slug().into(),
            Self::Rod(role) => format!("{}_rod", role.slug()).into(),
            Self::Motor => "motor".into(),
            Self::Propeller => "propeller".into(),
            Self::Bought(slug) => CentreBody::named(slug).map_or(slug, CentreBody::role).into(),
        }
    }

    /// Its share of the pieces of its line, as a weight among the line's bodies.
    pub fn weight(self, frame: &Frame) -> f64 {
        match self {
            Self::Bought(slug) => CentreBody::named(slug).map_or(1.0, |part| part.weight(frame)),
            _ => 1.0,
        }
    }
}

/// A shape that one or more bodies share, in its own axes.
#[derive(Clone)]
pub struct Shape {
    /// Name: the part's, the rod's role …
    pub name: String,
    /// What it is.
    pub kind: BodyKind,
    /// Material or catalogue name, for tables.
    pub material: String,
    /// Linear red, green, blue, alpha.
    pub colour: [f32; 4],
    /// Solid for booleans and gaps.
    pub solid: MeshSolid,
    /// Mesh for files and pictures.
    pub mesh: Arc<Mesh>,
    /// What the mesh was made of, where it is not folded from something else.
    pub feature: Option<Feature>,
    /// Volume by the B-rep kernel, mm³, where it builds the shape without booleans.
    pub exact_mm3: Option<f64>,
}

/// A shape in its place.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name, unique in the assembly.
    pub name: String,
    /// Index of its shape.
    pub shape: usize,
    /// Module it belongs to; `None` in the centre.
    pub module: Option<usize>,
    /// From the shape's axes to the frame's.
    pub pose: Isometry3<f64>,
}
