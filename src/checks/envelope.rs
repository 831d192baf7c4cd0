//! The frame fits the envelope: its bounding box is no wider, deeper or higher than the frame file says.
//!
//! The limit is the user's (a class, a box, a doorway). It is the frame's without propellers; with them the size is
//! stated as a note, for a propeller may be turned out of the way.

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::{Scene, bounds_of};

const SOLVED_HEIGHT: &[&str] = &["target.height_mm"];
const HEIGHT: &[&str] = &["rods.strut_rod_length_mm", "rods.arm_rod_length_mm", "rods.cage_rod_length_mm"];
/// What a long frame is deep by, first.
const DEPTH: &[&str] = &["rods.cage_side_ratio", "rods.cage_rod_length_mm", "corner.corner_node_to_bottom_mm"];
const SOLVED_WIDTH: &[&str] = &["target.width_mm"];
const WIDTH: &[&str] = &["rods.cage_rod_length_mm", "corner.corner_node_to_bottom_mm", "corner.corner_wall_mm"];

/// Rods first, then what else makes the frame high.
const MAKE_HIGH: &[&str] = &[
    "target.height_mm",
    "rods.strut_rod_length_mm",
    "rods.arm_rod_length_mm",
    "rods.cage_rod_length_mm",
    "target.strut_tilt_deg",
    "bracket.bay_height_mm",
];
/// Rods first, then what else makes the frame wide.
const MAKE_WIDE: &[&str] = &[
    "target.width_mm",
    "rods.cage_rod_length_mm",
    "rods.arm_rod_length_mm",
    "rods.strut_rod_length_mm",
    "corner.corner_node_to_bottom_mm",
    "corner.corner_wall_mm",
];

/// The same along the frame.
const MAKE_DEEP: &[&str] = &[
    "target.width_mm",
    "rods.cage_rod_length_mm",
    "rods.arm_rod_length_mm",
    "rods.strut_rod_length_mm",
    "corner.corner_node_to_bottom_mm",
    "corner.corner_wall_mm",
    "rods.cage_side_ratio",
];

pub static RULE: Rule = Rule {
    id: "envelope",
    title: "Envelope",
    requires: "the bounding box is no larger than its limits",
    units: &["mm"],
    limits: &[
        Limit::Key { subject: "width", key: "limits.envelope_width_mm" },
        Limit::Key { subject: "depth", key: "limits.envelope_depth_mm" },
        Limit::Key { subject: "height", key: "limits.envelope_height_mm" },
    ],
    levers: Levers::Sets(&[SOLVED_HEIGHT, HEIGHT, SOLVED_WIDTH, WIDTH, DEPTH]),
    blame: Blame::Keys(&[("height", MAKE_HIGH), ("depth", MAKE_DEEP), ("", MAKE_WIDE)]),
    in_search: InSearch::Constraints { subjects: &["width", "depth", "height"], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// The size of the frame along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// `width`, `depth` or `height`.
    pub name: &'static str,
    /// Whether the discs that the propellers sweep are in it.
    pub with_propellers: bool,
    /// Size, mm.
    pub size_mm: f64,
    /// Largest, mm.
    pub limit_mm: f64,
    /// Whether the frame file states a size that the rods' lengths were solved for.
    pub solved: bool,
    /// Whether the frame is longer than wide.
    pub long: bool,
}

impl Extent {
    fn finding(&self) -> Finding {
        let Self { name, with_propellers, size_mm, limit_mm, solved, long } = *self;
        let levers = match (name, solved) {
            ("height", true) => SOLVED_HEIGHT,
            ("height", false) => HEIGHT,
            ("depth", _) if long => DEPTH,
            (_, true) => SOLVED_WIDTH,
            (_, false) => WIDTH,
        };
        let measure = Measure { rule: &RULE, value: size_mm, limit: limit_mm, unit: "mm", levers };
        let [size, most] = measure.figures(2);
        let which = if with_propellers { "with propellers" } else { "without propellers" };
        let message = format!("the frame's {name} {which} is {size} mm, the envelope {most} mm");
        let subject = format!("{name} {which}");
        if with_propellers { measure.note(subject, message) } else { measure.at_most(subject, message) }
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let limits = &scene.design.frame.limits;
    let solved = scene.design.frame.target.is_some();
    let long = scene.design.skeleton.closure.places.are_apart();
    let mut found = Vec::new();
    for with_propellers in [false, true] {
        let Some(bounds) = bounds_of(scene.placed.iter().filter(|p| with_propellers || !p.is_propeller())) else { continue };
        for (axis, name) in ["width", "depth", "height"].into_iter().enumerate() {
            let limit_mm = [limits.envelope_width_mm, limits.envelope_depth_mm, limits.envelope_height_mm][axis];
            found.push(Extent { name, with_propellers, size_mm: bounds.high[axis] - bounds.low[axis], limit_mm, solved, long }.finding());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::frame::assembly::{Design, mass};
    use crate::params::Frame;
    use crate::params::frame::TargetSize;

    #[test]
    fn measured_the_real_frame_is_too_wide_by_1_93_mm() {
        let found = Planted::preset("cognifly-v8").found(check);
        let broken = violated(&found);
        assert_eq!(broken.iter().map(|f| f.subject.as_str()).collect::<Vec<_>>(), ["width without propellers", "depth without propellers"]);
        assert!(broken.iter().all(|f| (f.value - 211.93).abs() < 0.02 && (f.margin + 1.93).abs() < 0.02), "{broken:?}");
    }

    #[test]
    fn regress_the_default_frame_fits() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 6, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(3), ..ProptestConfig::default() })]

        /// Steep struts have the knees outermost, flat ones the corners. What stands on the hub is lower than all of these.
        #[test]
        fn analytic_a_target_is_an_upper_limit(width_mm in 190.0..260.0_f64, height_mm in 105.0..125.0_f64, tilt_deg in 10.0..33.0_f64) {
            let (mut frame, _) = Frame::load("cognifly").expect("a preset");
            frame.target = Some(TargetSize { width_mm, height_mm, strut_tilt_deg: tilt_deg });
            let design = Design::new(frame);
            prop_assume!(design.is_ok());
            let frame = Planted { masses: mass::table(design.as_ref().expect("is one")), design: design.expect("is one") };
            for f in &frame.found(check)[..3] {
                let target = if f.subject.starts_with("height") { height_mm } else { width_mm };
                prop_assert!(f.value <= target && f.value > target - 0.02, "{} for {}", f.message, target);
            }
        }
    }

    #[test]
    fn planted_a_frame_that_is_too_high() {
        let found = Planted::frame(|frame| frame.limits.envelope_height_mm = 100.0).found(check);
        assert_eq!(violated(&found)[0].subject, "height without propellers");
    }
}
