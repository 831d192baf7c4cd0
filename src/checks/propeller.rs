//! The discs that the propellers sweep stay clear of rods, printed parts, boards, and each other.
//!
//! A propeller bends and the flexible arms swing, so the limit is a distance of the resting frame. The propeller's own
//! motor and motor mount do not count: they are what it stands on. Of each kind the nearest is reported, or all that are
//! too near; what the four modules repeat is reported once.

use nalgebra::Point3;

use super::bounds::Bounds;
use super::finding::Finding;
use super::measure::{Measure, falls_short_mm};
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule, Sort};
use super::scene::{Placed, Scene};
use crate::frame::assembly::BodyKind;
use crate::frame::skeleton::MODULE_NAMES;
use crate::solid::SEGMENTS_PER_TURN;

const LEVERS: &[&str] = &["motor_mount.propeller_diameter_mm", "motor_mount.motor_position_mm", "motor_mount.propeller_height_mm"];

/// The record of a rule: propellers stay clear of everything.
pub static RULE: Rule = Rule {
    id: "propeller_clearance",
    title: "Propeller clearance",
    requires: "propellers are clear of everything but their own motors, mounts and screws",
    units: &["mm"],
    limits: &[Limit::Key { subject: "", key: "limits.propeller_clearance_mm" }],
    levers: Levers::Sets(&[LEVERS]),
    blame: Blame::Levers,
    in_search: InSearch::Sorted {
        sorts: &[Sort { name: "inwards", is_of: |subject| !is_outside(subject) }, Sort { name: "outwards", is_of: is_outside }],
        binds: true,
    },
    found: Found::By(&[Pass::quick(check)]),
};

/// Whether a finding is about what lies outside of the motors, which moves motors inwards: rods, and what holds them. From all else they move outwards.
fn is_outside(subject: &str) -> bool {
    let other = subject.split_once(" to ").map_or("", |(_, other)| other);
    let is_in_module = MODULE_NAMES.iter().any(|quadrant| other.split('_').any(|word| word == *quadrant));
    let is_inside = ["motor", "propeller"].iter().any(|name| other.starts_with(name));
    (is_in_module && !is_inside) || ["rod", "printed part"].contains(&other)
}

/// Distances beyond this are not measured, mm.
const REACH_MM: f64 = 100.0;

/// Corners of a mesh, and with them its box, are rounded by far less than this, mm.
const ROUNDED_MM: f64 = 0.001;

/// The nearest thing of a kind to, or one that is too near to, a propeller's disc.
#[derive(Clone, Debug, PartialEq)]
pub struct PropellerClearance {
    /// What kind of thing.
    pub of: &'static str,
    /// The disc and the body, when one is in reach.
    pub pair: Option<[String; 2]>,
    /// Distance, mm; the reach of the search when nothing is nearer.
    pub gap_mm: f64,
    /// Least distance, mm.
    pub limit_mm: f64,
}

impl PropellerClearance {
    fn finding(&self) -> Finding {
        let Self { of, gap_mm, limit_mm, .. } = *self;
        let measure = Measure { rule: RULE.id, value: gap_mm, limit: limit_mm, unit: "mm", levers: LEVERS };
        let [gap, least] = measure.figures(2);
        let message = match &self.pair {
            Some([disc, other]) => format!("{disc} passes {other} at {gap} mm, {least} mm are needed"),
            None => format!("no {of} is within {gap_mm:.0} mm of a propeller, {least} mm are needed"),
        };
        let subject = match &self.pair {
            Some([disc, other]) if falls_short_mm(gap_mm, limit_mm) => format!("{disc} to {other}"),
            _ => format!("propeller to {of}"),
        };
        measure.at_least(subject, message)
    }
}

fn group(other: &Placed) -> &'static str {
    match other.shape.kind {
        BodyKind::Printed(_) => "printed part",
        BodyKind::Rod(_) => "rod",
        BodyKind::Motor => "motor",
        BodyKind::Propeller => "propeller",
        BodyKind::Bought(_) => "board or battery",
    }
}

/// What a propeller stands on.
fn carries(other: &Placed, propeller: &Placed) -> bool {
    let screws = matches!(other.shape.kind, BodyKind::Bought(_)) && other.body.module.is_some();
    let under = other.shape.kind == BodyKind::Motor || screws || other.is_part(crate::params::PartName::MotorMount);
    under && other.body.module == propeller.body.module
}

/// A distance that the gap of a disc to another body does not exceed, mm: that of the body's nearest corner to the
/// cylinder within the disc's prism. It spares the kernel the search in all that is farther away.
fn no_farther_mm(disc: &Placed, other: &Placed) -> f64 {
    let Bounds { low, high } = disc.bounds;
    let inner = 0.5 * (high[0] - low[0]) * libm::cos(std::f64::consts::PI / f64::from(SEGMENTS_PER_TURN));
    let centre = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let distance = |corner: &[f32; 3]| {
        let p = other.body.pose * Point3::from(corner.map(f64::from));
        let aside = libm::hypot(p.x - centre[0], p.y - centre[1]) - inner;
        libm::hypot(aside.max(0.0), (low[2] - p.z).max(p.z - high[2]).max(0.0))
    };
    // The kernel's distance ends where its search does.
    other.shape.mesh.vertices.iter().map(distance).fold(f64::INFINITY, f64::min) + ROUNDED_MM
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let limit_mm = scene.design.frame.limits.propeller_clearance_mm;
    let mut pairs: Vec<_> = scene
        .pairs()
        .into_iter()
        .filter_map(|(a, b)| match (a.is_propeller(), b.is_propeller()) {
            (true, _) => Some((a, b)),
            (false, true) => Some((b, a)),
            _ => None,
        })
        .filter(|(disc, other)| !carries(other, disc))
        .map(|(disc, other)| (disc.bounds.distance_mm(&other.bounds), disc, other))
        .collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    let by_group = |of: &'static str| {
        let nothing = PropellerClearance { of, pair: None, gap_mm: REACH_MM.max(2.0 * limit_mm), limit_mm };
        let (mut nearest, mut broken) = (nothing.clone(), Vec::new());
        for (apart_mm, disc, other) in pairs.iter().filter(|(.., other)| group(other) == of) {
            let reach_mm = nearest.gap_mm.max(limit_mm);
            // The nearest boxes come first: from here on nothing is in reach.
            if *apart_mm > reach_mm + ROUNDED_MM {
                break;
            }
            let reach_mm = reach_mm.min(no_farther_mm(disc, other));
            let gap_mm = disc.gap_mm(other, reach_mm);
            let found = PropellerClearance { pair: Some([disc.body.name.clone(), other.body.name.clone()]), gap_mm, ..nothing };
            if falls_short_mm(gap_mm, limit_mm) {
                broken.push(found.finding());
            }
            if gap_mm < nearest.gap_mm {
                nearest = found;
            }
        }
        if broken.is_empty() { vec![nearest.finding()] } else { broken }
    };
    ["rod", "printed part", "board or battery", "motor", "propeller"].into_iter().flat_map(by_group).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    /// Each subject is of one constraint of a search: what is near a propeller's outer side moves its motor inwards, the rest outwards.
    #[test]
    fn analytic_sides_of_a_propeller_are_told_apart() {
        let of = |subject: &str| RULE.constraints().into_iter().filter(|name| RULE.concerns(name, subject)).collect::<Vec<_>>();
        for outside in ["strut_FR_top", "knee_FR", "cage_FR_bottom", "top_corner_BL", "rod", "printed part"] {
            assert_eq!(of(&format!("propeller_FR to {outside}")), ["outwards"], "{outside}");
        }
        for inside in ["camera", "camera_connector_left", "propeller_FL", "motor_BR", "board or battery", "propeller", "motor"] {
            assert_eq!(of(&format!("propeller_FR to {inside}")), ["inwards"], "{inside}");
        }
    }

    #[test]
    fn analytic_neighbours_pass_at_the_difference_of_pitch_and_diameter() {
        let found = Planted::preset("cognifly").found(check);
        let mount = &Planted::preset("cognifly").design.frame.motor_mount;
        let expected = mount.motor_position_mm * std::f64::consts::SQRT_2 - mount.propeller_diameter_mm;
        let neighbour = found.iter().find(|f| f.subject == "propeller to propeller").expect("is measured");
        assert!((neighbour.value - expected).abs() < 0.1 && neighbour.margin > 0.0, "{neighbour:?}");
    }

    #[test]
    fn planted_propellers_that_overlap() {
        let found = Planted::frame(|frame| frame.motor_mount.motor_position_mm = 52.0).found(check);
        assert!(violated(&found).iter().any(|f| f.subject == "propeller_FR to propeller_FL" && f.value == 0.0), "{found:?}");
    }
}
