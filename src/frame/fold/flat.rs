//! The flat state: all that a module is made of, on a table, as it is printed and cut, before the first step.
//!
//! A module as a whole is flat at no time: the leg has to be bent away before anything comes onto the arms, and the fork stands
//! across the knee. So its parts lie beside each other, each printed one as in its STL.

use std::sync::Arc;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use serde::Serialize;

use super::member::Member;
use crate::frame::assembly::press_fit::TOUCH_MM3;
use crate::frame::assembly::{BodyKind, Design};
use crate::solid::{Mesh, MeshSolid};

/// The table: a sheet of A3, mm.
pub const TABLE_MM: [f64; 2] = [420.0, 297.0];
/// Room between what lies on it, mm.
const ROOM_MM: f64 = 4.0;

/// Something on the table.
#[derive(Clone)]
pub struct Lying {
    /// Body of the first module.
    pub body: String,
    /// Its mesh, as it is written when it is printed.
    pub mesh: Arc<Mesh>,
    /// Where it lies.
    pub at: Isometry3<f64>,
}

/// A module on the table.
#[derive(Clone)]
pub struct FlatState {
    /// What lies there.
    pub lying: Vec<Lying>,
}

/// What is wrong with a flat state.
#[derive(Clone, Debug, PartialEq, Serialize, thiserror::Error)]
pub enum FlatError {
    /// Over the edge.
    #[error("{body} lies {over_mm:.1} mm beyond the edge of the table of {} x {} mm", TABLE_MM[0], TABLE_MM[1])]
    OffTable {
        /// The body.
        body: String,
        /// By how much, mm.
        over_mm: f64,
    },
    /// In or above the table.
    #[error("{body} does not lie on the table: its lowest point is at {lowest_mm:.2} mm")]
    NotResting {
        /// The body.
        body: String,
        /// Height of its lowest point, mm.
        lowest_mm: f64,
    },
    /// Two in one place.
    #[error("{} and {} lie in each other: they share {shared_mm3:.2} mm3", bodies[0], bodies[1])]
    Overlap {
        /// The two.
        bodies: [String; 2],
        /// Volume in common, mm³.
        shared_mm3: f64,
    },
    /// Not what is printed.
    #[error("{body} is not the mesh that is written as {part}.stl")]
    NotAsPrinted {
        /// The body.
        body: String,
        /// The part.
        part: &'static str,
    },
}

impl FlatState {
    /// Lays the first module's parts and rods in rows, the longest first.
    pub fn new(design: &Design) -> Self {
        let mut lying: Vec<Lying> = design.bodies.iter().filter(|body| body.module == Some(0)).filter_map(|b| laid(design, b)).collect();
        lying.sort_by(|a, b| b.mesh.size_mm()[0].total_cmp(&a.mesh.size_mm()[0]).then(a.body.cmp(&b.body)));
        let (mut x, mut y, mut depth) = (ROOM_MM, ROOM_MM, 0.0_f64);
        for item in &mut lying {
            let [low, high] = item.mesh.bounds_mm();
            if x + high[0] - low[0] + ROOM_MM > TABLE_MM[0] {
                (x, y, depth) = (ROOM_MM, y + depth + ROOM_MM, 0.0);
            }
            item.at = Isometry3::translation(x - low[0], y - low[1], 0.0);
            x += high[0] - low[0] + ROOM_MM;
            depth = depth.max(high[1] - low[1]);
        }
        Self { lying }
    }

    /// Length and width of the table that it takes, mm.
    pub fn size_mm(&self) -> [f64; 2] {
        let high = self.lying.iter().map(|l| l.mesh.placed(&l.at).bounds_mm()[1]);
        high.fold([0.0; 2], |most, high| [0, 1].map(|i| most[i].max(high[i] + ROOM_MM)))
    }

    /// What is wrong with it.
    pub fn check(&self, design: &Design) -> Vec<FlatError> {
        let mut found = Vec::new();
        for item in &self.lying {
            let [low, high] = item.mesh.placed(&item.at).bounds_mm();
            let body = || item.body.clone();
            let over_mm = (0..2).map(|i| (high[i] - TABLE_MM[i]).max(-low[i])).fold(0.0, f64::max);
            if over_mm > 0.0 {
                found.push(FlatError::OffTable { body: body(), over_mm });
            }
            if low[2].abs() > RESTING_MM {
                found.push(FlatError::NotResting { body: body(), lowest_mm: low[2] });
            }
            let member = Member::ALL.into_iter().find(|m| m.body(0) == item.body);
            if let Some(part) = member.and_then(Member::part).and_then(|name| design.part(name)).filter(|p| p.mesh != item.mesh) {
                found.push(FlatError::NotAsPrinted { body: body(), part: part.name.slug() });
            }
        }
        found.extend(self.overlaps());
        found
    }

    fn overlaps(&self) -> Vec<FlatError> {
        let boxes: Vec<[[f64; 3]; 2]> = self.lying.iter().map(|l| l.mesh.placed(&l.at).bounds_mm()).collect();
        let solid = |l: &Lying| MeshSolid::from_mesh(&l.mesh).map(|solid| solid.placed(&l.at));
        let mut found = Vec::new();
        for (i, a) in self.lying.iter().enumerate() {
            for (j, b) in self.lying.iter().enumerate().skip(i + 1) {
                let apart = (0..3).any(|k| boxes[i][0][k] > boxes[j][1][k] || boxes[j][0][k] > boxes[i][1][k]);
                let Some((p, q)) = (!apart).then(|| solid(a).zip(solid(b))).flatten() else { continue };
                let shared_mm3 = p.intersection(&q).volume_mm3();
                if shared_mm3 > TOUCH_MM3 {
                    found.push(FlatError::Overlap { bodies: [a.body.clone(), b.body.clone()], shared_mm3 });
                }
            }
        }
        found
    }
}

/// How far off the table's surface what lies on it may be, mm.
const RESTING_MM: f64 = 0.01;

/// A body as it lies: a printed part as printed, a rod along x. Motors and propellers come last and are left out.
fn laid(design: &Design, body: &crate::frame::assembly::Body) -> Option<Lying> {
    let shape = design.shape(body);
    let mesh = match &shape.kind {
        BodyKind::Printed(name) => design.part(*name)?.mesh.clone(),
        BodyKind::Rod(_) => {
            let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
            let laid = shape.solid.placed(&Isometry3::from_parts(Default::default(), down));
            Arc::new(laid.placed(&Isometry3::translation(0.0, 0.0, -laid.bounds_mm()[0][2])).mesh())
        }
        _ => return None,
    };
    Some(Lying { body: body.name.clone(), mesh, at: Isometry3::identity() })
}
