//! Rods stay clear of each other and of every part that does not hold them: a rod that rubs wears, and a joint that
//! folds onto a rod no longer folds. Of each kind of pair the nearest is reported, and all that are too near; what the
//! four modules repeat is reported once.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::finding::Finding;
use super::measure::{Measure, falls_short_mm};
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::{Placed, Scene};
use crate::frame::assembly::BodyKind;
use crate::frame::skeleton::{Rod, RodRole};
use crate::params::PartName;

const LEVERS: &[&str] = &["rods.arm_rod_length_mm", "hub_joint.arm_pitch_mm", "knee.knee_node_offset_mm"];

/// The record of a rule: rods stay clear of each other and of parts that do not hold them.
pub static RULE: Rule = Rule {
    id: "part_clearance",
    title: "Clearance of rods",
    requires: "rods are clear of each other, and of parts that do not hold them",
    units: &["mm"],
    limits: &[Limit::Key { subject: "", key: "limits.part_clearance_mm" }],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// Pairs further apart than this beyond the limit are not listed, mm.
const REACH_MM: f64 = 2.0;

/// The nearest pair of a rod of one role and a kind of body.
#[derive(Clone, Debug, PartialEq)]
pub struct RodClearance {
    /// The rod and the other body.
    pub pair: [String; 2],
    /// Distance, mm; 0 when they touch or overlap.
    pub gap_mm: f64,
    /// Least distance, mm.
    pub limit_mm: f64,
}

impl RodClearance {
    fn finding(&self) -> Finding {
        let Self { gap_mm, limit_mm, .. } = *self;
        let [rod, other] = &self.pair;
        let measure = Measure { rule: RULE.id, value: gap_mm, limit: limit_mm, unit: "mm", levers: LEVERS };
        let [gap, least] = measure.figures(2);
        measure.at_least(format!("{rod} to {other}"), format!("{rod} passes {other} at {gap} mm, {least} mm are needed"))
    }
}

/// Whether a body holds a rod.
fn holds(other: &Placed, rod: &Rod) -> bool {
    let BodyKind::Printed(part) = other.shape.kind else { return false };
    let in_socket = rod.sockets.iter().any(|socket| socket.part == part && other.body.module == Some(socket.module));
    let slides = part == PartName::MotorMount && rod.role == RodRole::Arm && other.body.module == Some(rod.sockets[0].module);
    in_socket || slides
}

fn is_rod(body: &Placed) -> bool {
    matches!(body.shape.kind, BodyKind::Rod(_))
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let limit_mm = scene.design.frame.limits.part_clearance_mm;
    let reach = limit_mm + REACH_MM;
    let rods = &scene.design.skeleton.rods;
    let pairs: Vec<_> = scene
        .pairs()
        .into_iter()
        .map(|(a, b)| if is_rod(a) { (a, b) } else { (b, a) })
        .filter(|(a, b)| is_rod(a) && !b.is_propeller() && a.bounds.distance_mm(&b.bounds) < reach)
        .filter(|(a, b)| !rods.iter().any(|rod| rod.name == a.body.name && holds(b, rod)))
        .collect();
    let gaps: Vec<f64> = pairs.par_iter().map(|(rod, other)| rod.gap_mm(other, reach)).collect();
    let mut broken = Vec::new();
    let mut nearest: BTreeMap<[String; 2], RodClearance> = BTreeMap::new();
    for ((rod, other), gap_mm) in pairs.iter().zip(gaps).filter(|(_, gap)| *gap < reach) {
        let pair = [rod.body.name.clone(), other.body.name.clone()];
        let kinds = [rod.shape.name.clone(), other.shape.name.clone()];
        let found = RodClearance { pair, gap_mm, limit_mm };
        if falls_short_mm(gap_mm, limit_mm) {
            broken.push(found.finding());
        }
        let best = nearest.entry(kinds).or_insert_with(|| found.clone());
        if gap_mm < best.gap_mm {
            *best = found;
        }
    }
    if nearest.is_empty() {
        return vec![nothing_near(reach, limit_mm)];
    }
    broken.extend(nearest.values().filter(|found| !falls_short_mm(found.gap_mm, limit_mm)).map(RodClearance::finding));
    broken
}

/// That no rod has anything but its holders within reach of the search, mm.
fn nothing_near(reach_mm: f64, limit_mm: f64) -> Finding {
    let measure = Measure { rule: RULE.id, value: reach_mm, limit: limit_mm, unit: "mm", levers: LEVERS };
    let [reach, least] = measure.figures(2);
    measure.at_least("rods".into(), format!("nothing that does not hold a rod is within {reach} mm of it, {least} mm are needed"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_a_limit_that_the_fork_breaks() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
        let found = Planted::frame(|frame| frame.limits.part_clearance_mm = 1.5).found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| f.subject.clone()).collect();
        assert_eq!(broken, ["strut_FR_top to fork_FR", "strut_FR_bottom to fork_FR"]);
    }

    #[test]
    fn planted_of_two_rods_of_one_kind_the_nearer_is_reported() {
        for by_mm in [-0.2, 0.2] {
            let mut frame = Planted::frame(|frame| frame.limits.part_clearance_mm = 0.2);
            frame.move_body("strut_FR_top", [0.0, 0.0, by_mm]);
            let found = frame.found(check);
            let told: Vec<_> = found.iter().filter(|f| f.subject.starts_with("strut_") && f.subject.ends_with("to fork_FR")).collect();
            let scene = Scene::new(&frame.design, &frame.masses);
            let body = |name: &str| scene.placed.iter().find(|placed| placed.body.name == name).expect("a body");
            let [top_mm, bottom_mm] = ["strut_FR_top", "strut_FR_bottom"].map(|rod| body(rod).gap_mm(body("fork_FR"), 2.2));
            assert!(told.len() == 1 && top_mm != bottom_mm, "{told:?}: {top_mm} and {bottom_mm} mm");
            assert_eq!(told[0].value, top_mm.min(bottom_mm));
        }
    }

    #[test]
    fn planted_a_knee_on_a_leg() {
        let mut frame = Planted::frame(|frame| frame.limits.part_clearance_mm = 0.2);
        let leg = frame.design.bodies.iter().position(|b| b.name == "leg_FR").expect("has legs");
        frame.design.bodies[leg].pose.translation.vector += nalgebra::Vector3::new(30.0, 30.0, 20.0);
        assert!(!violated(&frame.found(check)).is_empty());
    }
}
