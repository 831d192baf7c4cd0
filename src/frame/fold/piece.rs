//! The rigid pieces that a fold moves: bodies, and of those that bend each side of the hinge.

use std::sync::Arc;

use nalgebra::Isometry3;

use super::member::Member;
use super::posture::{Module, bent_by};
use super::task::Task;
use super::timeline::Moment;
use crate::frame::assembly::press_fit::{ROUNDING, TOUCH_MM3, gripped_mm3, plugs_mm3};
use crate::frame::assembly::rod_piece::piece_between;
use crate::frame::assembly::{Body, BodyKind, Design, sides as printed_sides};
use crate::solid::{BoxTree, Mesh, MeshSolid};

/// A rigid piece of a body.
pub(super) struct Piece {
    /// The body.
    pub name: String,
    /// What it is; none for what is mounted on the hub.
    pub member: Option<Member>,
    /// Its module; none in the centre.
    pub module: Option<usize>,
    /// The hinge beyond which it lies.
    hinge: Option<usize>,
    /// Where a body of the centre stands.
    place: Isometry3<f64>,
    kind: BodyKind,
    /// In the body's axes, flat.
    pub solid: MeshSolid,
}

/// The pieces of a design. A propeller's disc is what it sweeps when it turns, not a body that is carried about; screws are turned in when
/// what they hold stands.
pub(super) fn pieces(design: &Design, module: &Module) -> Vec<Piece> {
    // Modules share their shapes: each is cut once.
    let mut cut: Vec<(usize, Vec<Side>)> = Vec::new();
    let mut found = Vec::new();
    let carried = |body: &&Body| !matches!(design.shape(body).kind, BodyKind::Propeller | BodyKind::Bought("motor_screw"));
    for body in design.bodies.iter().filter(carried) {
        let member = Member::ALL.into_iter().find(|m| m.body(body.module.unwrap_or(0)) == body.name);
        if !cut.iter().any(|(shape, _)| *shape == body.shape) {
            cut.push((body.shape, sides(design, body, member, module)));
        }
        let sides = cut.iter().find(|(shape, _)| *shape == body.shape).map_or(&[][..], |(_, sides)| sides);
        found.extend(sides.iter().map(|side| Piece {
            name: body.name.clone(),
            member,
            module: body.module,
            hinge: side.hinge,
            place: body.pose,
            kind: design.shape(body).kind,
            solid: side.solid.clone(),
        }));
    }
    found
}

/// What all bodies of a shape have in common.
struct Side {
    hinge: Option<usize>,
    solid: MeshSolid,
}

/// A body's flat solid, cut at each of its hinges.
fn sides(design: &Design, body: &Body, member: Option<Member>, module: &Module) -> Vec<Side> {
    let shape = design.shape(body);
    let part = member.and_then(Member::part).and_then(|name| design.part(name));
    let (Some(member), Some(part)) = (member, part) else { return vec![Side { hinge: None, solid: shape.solid.clone() }] };
    let mut rest = part.flat.clone();
    let mut found = Vec::new();
    for (index, bend) in module.bends(member).iter().enumerate() {
        let [still, moving] = printed_sides(&rest, bend, part.name.slug(), &design.memo);
        rest = still;
        found.push(Side { hinge: Some(index), solid: moving });
    }
    found.push(Side { hinge: None, solid: rest });
    found
}

/// The mesh of a member of the module with this number when its hinges are folded so far, degrees; of one without hinges its shape's.
pub fn mesh_at(design: &Design, module: &Module, (member, number): (Member, usize), folds_deg: &[f64]) -> Option<Arc<Mesh>> {
    let name = member.body(number);
    let body = design.bodies.iter().find(|body| body.name == name)?;
    let part = member.part().and_then(|name| design.part(name));
    let bends = module.bends(member);
    let assembled = bends.iter().zip(folds_deg).all(|(bend, deg)| (bend.angle().to_deg() - deg).abs() < 1e-3);
    match part.filter(|_| !assembled) {
        Some(part) => {
            let bent = bends.iter().zip(folds_deg).filter(|(_, deg)| **deg > 1e-3);
            Some(Arc::new(bent.fold(part.flat.clone(), |solid, (bend, deg)| bent_by(bend, *deg).apply(&solid)).mesh()))
        }
        None => Some(design.shape(body).mesh.clone()),
    }
}

impl Piece {
    /// Where it stands at a moment.
    pub fn pose(&self, moment: &Moment, of: &Module) -> Isometry3<f64> {
        let (Some(member), Some(module)) = (self.member, self.module) else { return self.place };
        let bend = self.hinge.and_then(|index| of.bends(member).get(index).map(|bend| bent_by(bend, moment.fold_deg(member, index))));
        let folded = bend.map_or_else(Isometry3::identity, |bend| bend.motion());
        of.modules.pose(module, &moment.pose(member)) * folded
    }

    /// Boxes around its facets.
    pub fn boxes(&self) -> &BoxTree {
        self.solid.boxes()
    }

    /// All that its motions and volumes follow from, beside the fold.
    pub fn inputs(&self) -> impl std::fmt::Debug {
        (&self.name, self.hinge, self.place, self.solid.key())
    }

    /// Whether it is a rod.
    pub fn is_rod(&self) -> bool {
        matches!(self.kind, BodyKind::Rod(_))
    }

    /// Volume in common with another in a pose relative to this one's axes, mm³. Of a rod only the length beside this counts.
    pub fn shared_mm3(&self, other: &Self, pose: &Isometry3<f64>) -> f64 {
        if other.is_rod() {
            return other.piece_near(self, pose).map_or(0.0, |piece| self.solid.shared_mm3(&piece, pose));
        }
        self.solid.shared_mm3(&other.solid, pose)
    }

    /// What of this rod can be in another body, of which `pose` is this one's.
    fn piece_near(&self, other: &Self, pose: &Isometry3<f64>) -> Option<MeshSolid> {
        let heights = other.boxes().bounds().map_or([0.0; 8], |bounds| bounds.corners().map(|c| pose.inverse_transform_point(&c).z));
        let least = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let most = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        piece_between(&self.solid, [least, most])
    }

    /// Whether the two are joined when the frame is complete.
    pub fn joins(&self, other: &Self) -> bool {
        let (Some(a), Some(b)) = (self.member, other.member) else { return false };
        let far_corner = |rod: Member, part: Member| matches!((rod, part), (Member::Cage(up), Member::Corner(top)) if up == top);
        let contact = |pair: (Member, Member)| pair == (a, b) || pair == (b, a);
        far_corner(a, b) || far_corner(b, a) || Task::ALL.iter().flat_map(|task| task.contacts()).any(contact)
    }

    /// What the two may share, mm³: a press fit's ring, and rounding.
    pub fn meant_mm3(&self, other: &Self, design: &Design) -> f64 {
        let frame = &design.frame;
        let ring = |rod: &Self, part: &Self| match &part.kind {
            BodyKind::Printed(name) => {
                let rods = design.skeleton.rods.iter().filter(|r| r.name == rod.name);
                rods.map(|r| gripped_mm3(r, frame.rods.rod_diameter_mm, *name, part.module)).sum()
            }
            _ => 0.0,
        };
        let members = [self.member, other.member];
        let plugs = members == [Some(Member::HubJoint), Some(Member::Hub)] || members == [Some(Member::Hub), Some(Member::HubJoint)];
        let meant = if plugs { plugs_mm3(frame) } else { ring(self, other) + ring(other, self) };
        meant * ROUNDING + TOUCH_MM3
    }
}
