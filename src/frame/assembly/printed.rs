//! A printed part: flat as printed, folded as assembled.

use std::sync::Arc;

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde::{Deserialize, Serialize};

use crate::frame::parts::{PrintedPart, record};
use crate::frame::skeleton::Centre;
use crate::frame::skeleton::Skeleton;
use crate::memo::Memo;
use crate::params::{Frame, PartName};
use crate::solid::gate::{self, GateError, Topology};
use crate::solid::{Bend, Brep, Feature, Mesh, MeshSolid};

/// A printed part, made.
#[derive(Clone)]
pub struct Printed {
    /// Which.
    pub name: PartName,
    /// Its record.
    pub part: &'static PrintedPart,
    /// What it is made of, in its own axes.
    pub feature: Feature,
    /// How it bends when the frame is assembled.
    pub bends: Vec<Bend>,
    /// The flat solid, in its own axes.
    pub flat: MeshSolid,
    /// The solid after its bends, in its own axes; the flat one when it has none.
    pub folded: MeshSolid,
    /// From the part's axes to those in which it is printed, resting on z = 0.
    pub print_pose: Isometry3<f64>,
    /// Its nominal mesh, as it lies on the bed; what is written for a printer with compensation follows from it.
    pub mesh: Arc<Mesh>,
    /// What the export gate saw.
    pub topology: Topology,
    /// Volume of the nominal mesh, mm³.
    pub volume_mm3: f64,
    /// Volume by the B-rep kernel, mm³, for parts that it builds without booleans.
    pub exact_volume_mm3: Option<f64>,
}

/// A part as it is printed: all of it but its bends.
#[derive(Clone, Serialize, Deserialize)]
struct Flat {
    solid: MeshSolid,
    print_pose: ([f64; 4], [f64; 3]),
    mesh: Arc<Mesh>,
    topology: Topology,
    volume_mm3: f64,
    exact_volume_mm3: Option<f64>,
}

impl Printed {
    /// Makes a part, with what was computed of former ones where it is the same.
    ///
    /// # Errors
    /// When its mesh does not pass the export gate, or the B-rep kernel makes another solid of it: its parameters
    /// contradict each other.
    pub fn make(name: PartName, frame: &Frame, skeleton: &Skeleton, centre: &Centre, memo: &Memo) -> Result<Self, GateError> {
        let part = record(name);
        Self::by(part, Recipe::of(part, frame, skeleton, centre), memo)
    }

    /// Makes a part by its record and recipe; nothing else enters.
    pub(super) fn by(part: &'static PrintedPart, recipe: Recipe, memo: &Memo) -> Result<Self, GateError> {
        let Recipe { feature, bends } = recipe;
        let turn = (part.print_turn)();
        let flat = memo.try_get("flat part", part.name.slug(), &(&feature, turn), || Flat::of(&feature, &turn, memo))?;
        let folded = match bends[..] {
            [] => flat.solid.clone(),
            _ => {
                let (slug, inputs) = (part.name.slug(), (flat.solid.key(), &bends));
                MeshSolid::clone(&*memo.try_get("folded part", slug, &inputs, || bent(&flat.solid, &bends, slug, memo))?)
            }
        };
        let Flat { solid, print_pose, mesh, topology, volume_mm3, exact_volume_mm3 } = Flat::clone(&flat);
        Ok(Self {
            name: part.name,
            part,
            volume_mm3,
            feature,
            bends,
            flat: solid,
            folded,
            print_pose: pose_of(print_pose),
            mesh,
            topology,
            exact_volume_mm3,
        })
    }

    /// The flat solid in print orientation, resting on z = 0.
    pub fn printed(&self) -> MeshSolid {
        self.flat.placed(&self.print_pose)
    }

    /// The flat solid with all its detail, in its own axes: each facet stands for one surface of the feature.
    pub fn raw(&self) -> MeshSolid {
        MeshSolid::build(&self.feature)
    }
}

impl Flat {
    fn of(feature: &Feature, turn: &UnitQuaternion<f64>, memo: &Memo) -> Result<Self, GateError> {
        let raw = MeshSolid::build_from(feature, memo);
        let made_as = |solid: MeshSolid| {
            let solid = solid.reimported();
            let (printed, pose) = laid(&solid, turn)?;
            let mesh = printed.mesh();
            gate::pass(&mesh).map(|topology| (solid, pose, mesh, topology))
        };
        let made = |solid: MeshSolid| made_as(solid.stout()).or_else(|_| made_as(solid));
        let (solid, pose, mesh, topology) = first_good(&raw, &DETAILS_MM, made)?;
        let volume_mm3 = mesh.volume_mm3();
        let exact_volume_mm3 = Brep::build(feature).map(|brep| brep.volume_mm3());
        exact_volume_mm3.map_or(Ok(()), |exact_mm3| gate::agree(volume_mm3, exact_mm3))?;
        let print_pose = (pose.rotation.coords.into(), pose.translation.vector.into());
        Ok(Self { solid, print_pose, mesh: Arc::new(mesh), topology, volume_mm3, exact_volume_mm3 })
    }
}

/// A pose of the numbers that are kept of it: the same to the last bit.
fn pose_of((rotation, translation): ([f64; 4], [f64; 3])) -> Isometry3<f64> {
    let rotation = UnitQuaternion::new_unchecked(Quaternion::from(nalgebra::Vector4::from(rotation)));
    Isometry3::from_parts(Translation3::from(translation), rotation)
}

/// The solid as it is printed, resting on z = 0, and the way there from its own axes.
pub(super) fn laid(flat: &MeshSolid, print_turn: &UnitQuaternion<f64>) -> Result<(MeshSolid, Isometry3<f64>), GateError> {
    let turn = Isometry3::from_parts(Translation3::identity(), *print_turn);
    let turned = flat.placed(&turn);
    if turned.is_empty() {
        return Err(GateError::Empty);
    }
    let low = turned.bounds_mm()[0];
    let lift = Isometry3::translation(0.0, 0.0, -low[2]);
    Ok((turned.placed(&lift), lift * turn))
}

/// The solid without detail, and its mesh, which passes the gate; the amounts of detail, mm, in the order in which they are tried.
///
/// # Errors
/// What the gate says to the last attempt.
fn simplified(raw: &MeshSolid, details_mm: &[f64]) -> Result<(MeshSolid, Mesh), GateError> {
    first_good(raw, details_mm, |solid| {
        if solid.is_empty() {
            return Err(GateError::Empty);
        }
        let mesh = solid.mesh();
        gate::pass(&mesh).map(|_| (solid, mesh))
    })
}

/// What is made of a solid: of the first of its simplifications of which it can be made. Taking away detail can make facets cross or
/// vanish, in one part of a hundred; then less is taken away. Corners within a few steps of a written mesh's grid are rounded past each
/// other, in one part of some thousands; then they become one.
pub(super) fn first_good<T>(raw: &MeshSolid, details_mm: &[f64], make: impl Fn(MeshSolid) -> Result<T, GateError>) -> Result<T, GateError> {
    let simpler = details_mm.iter().map(|below_mm| raw.without_detail(*below_mm));
    let welded = WELDS_MM.into_iter().map(|within_mm| raw.without_detail(within_mm).welded(within_mm));
    let mut refused = GateError::Empty;
    for solid in simpler.chain(welded) {
        match make(solid) {
            Ok(made) => return Ok(made),
            Err(error) => refused = error,
        }
    }
    Err(refused)
}

/// Detail that is simplified away, mm, in the order in which it is tried: less first, then more, all of it far below what a printer places.
const DETAILS_MM: [f64; 7] = [0.001, 0.0005, 0.0002, 0.0001, 0.00002, 0.002, 0.004];

/// Corners within this of each other become one, mm, in the order in which it is tried. Of 500 frames those that crossed lay at most 0.00013
/// mm apart; the larger is the detail that is taken away of every part.
const WELDS_MM: [f64; 2] = [0.0003, 0.001];

/// How far a hinge is moved out, mm, in the order in which it is tried.
const OFF_CORNER_MM: [f64; 4] = [0.0, 0.01, 0.004, 0.015];

/// The folded solid. A hinge lies where two sockets' mitres end in one point: in one part of a
/// hundred the cut grazes that point, and then the hinge is moved off it.
fn bent(flat: &MeshSolid, bends: &[Bend], part: &str, memo: &Memo) -> Result<MeshSolid, GateError> {
    let mut refused = GateError::Empty;
    for off_mm in OFF_CORNER_MM {
        let fold = |solid: MeshSolid, bend: &Bend| {
            let bend = bend.moved_out(off_mm);
            bend.apply_cut(&solid, || sides(&solid, &bend, part, memo)).reimported()
        };
        match simplified(&bends.iter().fold(flat.clone(), fold), &DETAILS_MM) {
            Ok((solid, _)) => return Ok(solid.reimported()),
            Err(error) => refused = error,
        }
    }
    Err(refused)
}

/// A solid cut at a hinge: what stays where it is when the part is folded there, and what moves. However far it is folded, the cut is
/// the same.
pub fn sides(solid: &MeshSolid, bend: &Bend, part: &str, memo: &Memo) -> [MeshSolid; 2] {
    let cut = || bend.sides(solid).map(|side| side.reimported());
    (*memo.get("sides of a hinge", part, &(solid.key(), bend.unfolded()), cut)).clone()
}

/// A part before it is made: what its record says of it in a frame.
pub(super) struct Recipe {
    feature: Feature,
    bends: Vec<Bend>,
}

impl Recipe {
    /// How a part of a frame is made.
    pub(super) fn of(part: &PrintedPart, frame: &Frame, skeleton: &Skeleton, centre: &Centre) -> Self {
        let closure = &skeleton.closure;
        Self { feature: (part.feature)(frame, closure, centre), bends: part.bends(frame, closure) }
    }
}
