//! Every rod end sits in its socket: deep enough, along the socket's axis, not through its bottom; and the folded part,
//! in its place, really has its bore there.
//!
//! The first is read from the skeleton. The second is measured on the solid: a pin a little thinner than the bore, laid
//! where the rod is, must meet nothing, and one a little wider must meet the wall all around, wherever along the rod it is cut.

use nalgebra::Point3;
use rayon::prelude::*;

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::{Scene, rounded_pose};
use crate::figures::{decimals, told_apart};
use crate::frame::skeleton::{Rod, RodRole, Socket, laid_along};
use crate::solid::{Feature, MeshSolid};
use crate::units::Angle;

const IN_CORNER: &[&str] = &["corner.corner_socket_depth_mm"];
const IN_KNEE: &[&str] = &["knee.knee_socket_depth_mm"];
const IN_FORK: &[&str] = &["fork.fork_socket_depth_mm", "rods.arm_rod_slack_mm"];
const ARM_IN_HUB_JOINT: &[&str] = &["hub_joint.hub_arm_socket_depth_mm"];
const LEG_IN_HUB_JOINT: &[&str] = &["hub_joint.hub_leg_socket_depth_mm"];
/// What opens bores from the side.
const WALL_OF_CORNER: &[&str] = &["corner.corner_node_to_bottom_mm", "corner.corner_leg_bottom_mm", "corner.corner_wall_mm"];
const WALL_OF_KNEE: &[&str] = &["knee.knee_node_offset_mm", "knee.knee_node_to_bottom_mm", "knee.knee_back_wall_mm"];

/// The record of a rule: rods are held by sockets that are long enough and fit.
pub static RULE: Rule = Rule {
    id: "socket_seating",
    title: "Seating of rods",
    requires: "each end of a rod is in a bore, deep enough",
    units: &["mm", "deg", "mm3", ""],
    limits: &[Limit::Key { subject: "", key: "limits.socket_engagement_mm" }],
    levers: Levers::Sets(&[IN_CORNER, IN_KNEE, IN_FORK, ARM_IN_HUB_JOINT, LEG_IN_HUB_JOINT, WALL_OF_CORNER, WALL_OF_KNEE]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick_where_bent(check, Some(by_skeleton))]),
};

/// Largest angle between rod and socket.
const AXIS_DEG: f64 = 0.1;
/// How much thinner than the bore the pin is that must pass, in diameter, mm.
const THINNER_MM: f64 = 0.02;
/// How much wider the one is that must meet the wall, in diameter, mm.
const WIDER_MM: f64 = 0.8;
/// The pin's ends stay this far from the bore's bottom and mouth, mm.
const END_MM: f64 = 0.05;
/// What the passing pin may meet, mm³: a 0.1° tilt is about this much.
const PASSING_MM3: f64 = 0.1;
/// Least share of the ring around the bore that must be wall, wherever it is cut; chords take a hundredth of a whole one.
const WALL_SHARE: f64 = 0.95;
/// How far apart the ring is cut, mm.
const CUT_MM: f64 = 0.5;

/// A rod's end in its socket, from the skeleton.
#[derive(Clone, Debug, PartialEq)]
pub struct SeatedEnd {
    /// The rod and the part.
    pub pair: [String; 2],
    /// What the rod is sawn to, mm.
    pub sawn_mm: f64,
    /// Length of the rod inside the bore, mm, when all that is sawn off is missing at this end.
    pub engagement_mm: f64,
    /// Least, mm.
    pub limit_mm: f64,
    /// From the bore's bottom to the rod's end, mm; negative when it goes through.
    pub above_bottom_mm: f64,
    /// Angle between rod and socket, degrees.
    pub off_axis_deg: f64,
}

impl SeatedEnd {
    fn of(rod: &Rod, at: usize, limit_mm: f64) -> Self {
        let (socket, end, other) = ends(rod, at);
        let along = (other - end).normalize();
        let off_axis = libm::atan2(along.cross(&socket.axis).norm(), along.dot(&socket.axis));
        Self {
            pair: [rod.name.clone(), socket.body_name()],
            sawn_mm: rod.sawn_mm(),
            engagement_mm: socket.engagement_mm(end) - (rod.length_mm() - rod.sawn_mm()),
            limit_mm,
            above_bottom_mm: socket.axis.dot(&(end - socket.bottom)),
            off_axis_deg: Angle::rad(off_axis).to_deg(),
        }
    }

    fn findings(&self, levers: &'static [&'static str]) -> [Finding; 3] {
        let Self { pair: [rod, part], sawn_mm, engagement_mm, limit_mm, above_bottom_mm, off_axis_deg } = self;
        let measure = |value: f64, limit: f64, unit| Measure { rule: RULE.id, value, limit, unit, levers };
        let engagement = measure(*engagement_mm, *limit_mm, "mm");
        let [depth, least] = engagement.figures(2);
        [
            engagement.at_least(
                format!("{rod} in {part}: engagement"),
                format!("{rod}, sawn to {sawn_mm:.1} mm, sits {depth} mm deep in {part}, {least} mm are needed"),
            ),
            measure(*above_bottom_mm, 0.0, "mm").at_least(
                format!("{rod} in {part}: bottom"),
                format!("{rod} ends {} mm above the bottom of its bore in {part}", decimals(*above_bottom_mm, 2)),
            ),
            measure(*off_axis_deg, AXIS_DEG, "deg").at_most(
                format!("{rod} in {part}: axis"),
                format!("{rod} is {off_axis_deg:.3} deg off the axis of its bore in {part}, {AXIS_DEG} deg are allowed"),
            ),
        ]
    }
}

/// The bore of the folded part around a rod's end, from the solid.
#[derive(Clone, Debug, PartialEq)]
pub struct SocketGeometry {
    /// The rod and the part.
    pub pair: [String; 2],
    /// What the thinner pin meets of the part, mm³.
    pub met_mm3: f64,
    /// Share of the ring around the bore that is wall, where it is least.
    pub wall_share: f64,
}

impl SocketGeometry {
    fn of(scene: &Scene, rod: &Rod, at: usize) -> Option<Self> {
        let (socket, end, other) = ends(rod, at);
        let part = scene.part(socket.part, Some(socket.module))?;
        let along = (other - end).normalize();
        let length = socket.engagement_mm(end) - 2.0 * END_MM;
        let start = end + along * END_MM;
        let pose = rounded_pose(&(laid_along(start, along).inverse() * part.body.pose));
        let pair = [rod.name.clone(), part.body.name.clone()];
        let inputs = (part.shape.solid.key(), socket.bore_mm, length, pose);
        let measured = scene
            .design
            .memo
            .get("seating", &pair.join(" in "), &inputs, || bore_measured(&part.shape.solid.placed(&pose), socket.bore_mm, length));
        let (met_mm3, wall_share) = *measured;
        Some(Self { pair, met_mm3, wall_share })
    }

    fn findings(&self, levers: &'static [&'static str], of_wall: &'static [&'static str]) -> [Finding; 2] {
        let Self { pair: [rod, part], met_mm3, wall_share } = self;
        let measure = |value: f64, limit: f64, unit, levers| Measure { rule: RULE.id, value, limit, unit, levers };
        let [share, least] = told_apart(100.0 * wall_share, 100.0 * WALL_SHARE, 0);
        [
            measure(*met_mm3, PASSING_MM3, "mm3", levers).at_most(
                format!("{rod} in {part}: bore"),
                format!("a pin {THINNER_MM} mm thinner than the bore meets {met_mm3:.3} mm3 of {part} where {rod} is"),
            ),
            measure(*wall_share, WALL_SHARE, "", of_wall).at_least(
                format!("{rod} in {part}: wall"),
                format!("{share} % of the ring around {rod} in {part} is wall where it is least, {least} % are needed"),
            ),
        ]
    }
}

/// Of a part in the axes of a pin along its bore: what a thinner pin meets of it, mm³, and the least share of the ring around the bore that is
/// wall.
fn bore_measured(part: &MeshSolid, bore_mm: f64, length_mm: f64) -> (f64, f64) {
    let pin = |diameter: f64| MeshSolid::build(&Feature::cylinder(0.5 * diameter, length_mm));
    let wall = pin(bore_mm + WIDER_MM).intersection(part);
    let bore = pin(bore_mm).slice(0.5 * length_mm);
    let ring_mm2 = pin(bore_mm + WIDER_MM).slice(0.5 * length_mm).area_mm2() - bore.area_mm2();
    let cuts = (length_mm / CUT_MM).ceil().max(1.0) as usize;
    // Cuts keep off the pin's ends.
    let at = |cut: usize| END_MM + (length_mm - 2.0 * END_MM) * cut as f64 / cuts as f64;
    let share = |cut: usize| wall.slice(at(cut)).minus(&bore).area_mm2() / ring_mm2.max(f64::MIN_POSITIVE);
    let least = (0..=cuts).map(share).fold(f64::INFINITY, f64::min);
    (pin(bore_mm - THINNER_MM).intersection(&wall).volume_mm3(), least)
}

/// A rod's socket, its end there, and its other end.
fn ends(rod: &Rod, at: usize) -> (&Socket, &Point3<f64>, &Point3<f64>) {
    if at == 0 { (&rod.sockets[0], &rod.start, &rod.end) } else { (&rod.sockets[1], &rod.end, &rod.start) }
}

/// The keys of a socket's depth, and of the rod's share of it.
fn levers(role: RodRole, at: usize) -> &'static [&'static str] {
    match (role, at) {
        (RodRole::Cage | RodRole::CageSide, _) | (RodRole::Strut | RodRole::Leg, 1) => IN_CORNER,
        (RodRole::Strut, _) => IN_KNEE,
        (RodRole::Arm, 0) => ARM_IN_HUB_JOINT,
        (RodRole::Arm, _) => IN_FORK,
        (RodRole::Leg, _) => LEG_IN_HUB_JOINT,
    }
}

/// What the wall around a bore follows from.
fn wall_levers(role: RodRole, at: usize) -> &'static [&'static str] {
    match (role, at) {
        (RodRole::Cage | RodRole::CageSide, _) | (RodRole::Strut | RodRole::Leg, 1) => WALL_OF_CORNER,
        (RodRole::Strut, _) => WALL_OF_KNEE,
        _ => levers(role, at),
    }
}

/// Every end by the skeleton; the geometry of the first module's, which the other modules repeat.
pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let per_end = |(rod, at): &(&Rod, usize)| {
        let mut found = seated(scene, rod, *at);
        if rod.sockets[0].module == 0 {
            let (levers, of_wall) = (levers(rod.role, *at), wall_levers(rod.role, *at));
            found.extend(SocketGeometry::of(scene, rod, *at).iter().flat_map(|geometry| geometry.findings(levers, of_wall)));
        }
        found
    };
    let found: Vec<Vec<Finding>> = all_ends(scene).par_iter().map(per_end).collect();
    found.into_iter().flatten().collect()
}

/// Every end by the skeleton, which says nothing of the bores.
fn by_skeleton(scene: &Scene) -> Vec<Finding> {
    all_ends(scene).into_iter().flat_map(|(rod, at)| seated(scene, rod, at)).collect()
}

fn all_ends<'a>(scene: &Scene<'a>) -> Vec<(&'a Rod, usize)> {
    scene.design.skeleton.rods.iter().flat_map(|rod| [(rod, 0), (rod, 1)]).collect()
}

fn seated(scene: &Scene, rod: &Rod, at: usize) -> Vec<Finding> {
    SeatedEnd::of(rod, at, scene.design.frame.limits.socket_engagement_mm).findings(levers(rod.role, at)).into()
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_an_arm_that_hardly_reaches_the_fork() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
        let found = Planted::frame(|frame| frame.rods.arm_rod_slack_mm = 4.0).found(check);
        let broken = violated(&found);
        assert_eq!(broken.len(), 8, "{broken:?}");
        assert!(
            broken.iter().all(|f| f.subject.contains(" in fork_") && f.subject.ends_with(": engagement") && (f.value - 3.5).abs() < 1e-9),
            "{broken:?}"
        );
    }

    #[test]
    fn planted_bores_that_the_notch_or_the_window_opens() {
        let of = |change: fn(&mut crate::params::Frame), part: &str| {
            let found = Planted::frame(change).found(check);
            let broken = violated(&found);
            assert!(!broken.is_empty() && broken.iter().all(|f| f.subject.contains(part) && f.subject.ends_with(": wall")), "{broken:?}");
        };
        of(
            |frame| {
                frame.corner.corner_node_to_bottom_mm = 4.0;
                frame.corner.corner_wall_mm = 2.0;
            },
            "_corner_",
        );
        of(|frame| frame.knee.knee_node_offset_mm = 5.6, " in knee_");
    }

    #[test]
    fn analytic_bores_take_up_what_is_sawn_off() {
        let mut rod = Planted::preset("cognifly").design.skeleton.rods[0].clone();
        let way = (rod.end - rod.start).normalize();
        for (longer, sawn) in [(0.0, 192.0), (0.3, 192.0), (0.49, 192.0), (0.5, 192.5)] {
            rod.end = rod.start + way * (192.0 + longer);
            let end = SeatedEnd::of(&rod, 0, 4.0);
            let whole = rod.sockets[0].engagement_mm(&rod.start);
            assert!((end.sawn_mm - sawn).abs() < 1e-9 && (whole - end.engagement_mm - (192.0 + longer - sawn)).abs() < 1e-9, "{end:?}");
        }
    }

    #[test]
    fn planted_a_knee_off_its_place() {
        let mut frame = Planted::preset("cognifly");
        frame.move_body("knee_FR", [0.2, -0.2, 0.0]);
        let found = frame.found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| f.subject.clone()).collect();
        let of = |rod: &str| ["bore", "wall"].map(|what| format!("{rod} in knee_FR: {what}"));
        assert_eq!(broken, [of("strut_FR_top"), of("strut_FR_bottom")].concat());
    }

    #[test]
    fn planted_a_rod_at_an_angle_and_through_the_bottom() {
        let frame = Planted::preset("cognifly");
        let mut rod = frame.design.skeleton.rods[0].clone();
        let axis = rod.sockets[0].axis.into_inner();
        rod.start -= axis * 0.3;
        rod.end += axis.cross(&Vector3::z()) * (0.005 * rod.length_mm());
        let broken = SeatedEnd::of(&rod, 0, 4.0).findings(&["rods.cage_rod_length_mm"]).map(|f| f.verdict);
        use crate::checks::Verdict::{Holds, Violated};
        assert_eq!(broken, [Holds, Violated, Violated]);
    }
}
