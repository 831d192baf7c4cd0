//! The frame fits the envelope: its bounding box is no wider, deeper or higher than the frame file says.
//!
//! The limit is the user's (a class, a box, a doorway). It is the frame's without propellers; with them the size is
//! stated as a note, for a propeller may be turned out of the way.

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use super::scene::{Placed, Scene, bounds_of};
use crate::frame::assembly::BodyKind;

const SOLVED_HEIGHT: &[&str] = &["target.height_mm"];
const HEIGHT: &[&str] = &["rods.strut_rod_length_mm", "rods.arm_rod_length_mm", "rods.cage_rod_length_mm"];
/// What stands above the ring: the mast, or the camera for goggles.
const MAST: &[&str] = &["accessories.mast_height_mm"];
const FPV_CAMERA: &[&str] = &["accessories.fpv_above_mm"];
/// What hangs below the feet: the sleeve with its battery.
const HANGING: &[&str] = &["bracket.bay_height_mm", "battery.battery_height_mm", "bought.battery"];
/// The same, where the flow sensor hangs lowest.
const HANGING_SENSOR: &[&str] = &["bought.flow_sensor", "bracket.bay_height_mm"];
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
    "battery.battery_height_mm",
    "bought.battery",
    "bought.flow_sensor",
    "accessories.mast_height_mm",
    "accessories.fpv_above_mm",
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

/// The record of a rule: the frame without propellers fits into its envelope.
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
    levers: Levers::Sets(&[SOLVED_HEIGHT, HEIGHT, MAST, FPV_CAMERA, HANGING, HANGING_SENSOR, SOLVED_WIDTH, WIDTH, DEPTH]),
    blame: Blame::Keys(&[("height", MAKE_HIGH), ("depth", MAKE_DEEP), ("", MAKE_WIDE)]),
    in_search: InSearch::Constraints { subjects: &["width", "depth", "height"], binds: true },
    found: Found::By(&[Pass::quick(check)]),
};

/// The size of the frame along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent<'a> {
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
    /// What of the centre reaches beyond rods and corners, upwards or downwards.
    pub beyond: Option<Beyond<'a>>,
}

/// A body of the centre that makes the frame higher than its modules are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beyond<'a> {
    /// Its name.
    pub body: &'a str,
    /// Whether it is below them.
    pub below: bool,
    /// How far it reaches beyond them, mm.
    pub reach_mm: f64,
}

impl Extent<'_> {
    fn finding(&self) -> Finding {
        let Self { name, with_propellers, size_mm, limit_mm, solved, long, beyond } = *self;
        // Where more is missing than a body of the centre reaches beyond the modules, that body cannot clear it.
        let decides = beyond.filter(|beyond| size_mm - limit_mm <= beyond.reach_mm);
        let levers = match (name, solved, decides.map(|beyond| (beyond.body, beyond.below))) {
            ("height", _, Some(("flow_sensor", true))) => HANGING_SENSOR,
            ("height", _, Some((_, true))) => HANGING,
            ("height", _, Some(("gps", false))) => MAST,
            ("height", _, Some(("fpv_camera", false))) => FPV_CAMERA,
            ("height", true, _) => SOLVED_HEIGHT,
            ("height", false, _) => HEIGHT,
            ("depth", ..) if long => DEPTH,
            (_, true, _) => SOLVED_WIDTH,
            (_, false, _) => WIDTH,
        };
        let measure = Measure { rule: RULE.id, value: size_mm, limit: limit_mm, unit: "mm", levers };
        let [size, most] = measure.figures(2);
        let which = if with_propellers { "with propellers" } else { "without propellers" };
        let reaches = beyond.filter(|_| name == "height").map_or_else(String::new, |Beyond { body, below, .. }| {
            format!("; `{body}` is its {} body", if below { "lowest" } else { "highest" })
        });
        let message = format!("the frame's {name} {which} is {size} mm, the envelope {most} mm{reaches}");
        let subject = format!("{name} {which}");
        if with_propellers { measure.note(subject, message) } else { measure.at_most(subject, message) }
    }
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let limits = &scene.design.frame.limits;
    let solved = scene.design.frame.target.is_some();
    let long = scene.design.skeleton.closure.places.are_apart();
    let beyond = beyond(scene);
    let mut found = Vec::new();
    for with_propellers in [false, true] {
        let Some(bounds) = bounds_of(scene.placed.iter().filter(|p| with_propellers || !p.is_propeller())) else { continue };
        for (axis, name) in ["width", "depth", "height"].into_iter().enumerate() {
            let limit_mm = [limits.envelope_width_mm, limits.envelope_depth_mm, limits.envelope_height_mm][axis];
            let size_mm = bounds.high[axis] - bounds.low[axis];
            found.push(Extent { name, with_propellers, size_mm, limit_mm, solved, long, beyond }.finding());
        }
    }
    found
}

/// The body of the centre that is highest or lowest of all, if one is: the one that reaches further beyond the modules.
fn beyond<'a>(scene: &'a Scene) -> Option<Beyond<'a>> {
    let is_module = |placed: &&Placed| placed.body.module.is_some() || matches!(placed.shape.kind, BodyKind::Rod(_));
    let modules = bounds_of(scene.placed.iter().filter(|placed| !placed.is_propeller()).filter(is_module))?;
    let centre = scene.placed.iter().filter(|placed| !placed.is_propeller() && !is_module(placed));
    let reaches = centre.flat_map(|placed| {
        let name = placed.body.name.as_str();
        let [above_mm, below_mm] = [placed.bounds.high[2] - modules.high[2], modules.low[2] - placed.bounds.low[2]];
        [Beyond { body: name, below: false, reach_mm: above_mm }, Beyond { body: name, below: true, reach_mm: below_mm }]
    });
    // Of two that reach alike the first: the lid is as low as its sleeve.
    reaches.filter(|beyond| beyond.reach_mm > 0.0).reduce(|a, b| if b.reach_mm > a.reach_mm { b } else { a })
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

    /// What makes it high is what is to be changed: the mast of a GPS, the battery below the feet, else the rods, or where more is missing than
    /// these reach beyond.
    #[test]
    fn planted_a_body_of_the_centre_that_makes_the_frame_too_high() {
        let first = |preset: &str, height_mm: f64, change: fn(&mut Frame)| {
            let (mut frame, _) = Frame::load(preset).expect("a frame");
            frame.limits.envelope_height_mm = height_mm;
            change(&mut frame);
            let found = Planted::designed(frame).found(check);
            let height = violated(&found).into_iter().find(|f| f.subject == "height without propellers").expect("is too high");
            (height.levers[0].to_string(), height.message.split_once("; ").map(|(_, body)| body.to_string()))
        };
        assert_eq!(first("cognifly", 100.0, |_| ()), ("rods.strut_rod_length_mm".into(), None));
        let mast =
            |height_mm: f64| first("examples/frames/four-inch-long-range.toml", height_mm, |frame| frame.accessories.mast_height_mm = 90.0);
        let gps = || Some("`gps` is its highest body".to_string());
        assert_eq!(mast(150.0), ("accessories.mast_height_mm".into(), gps()));
        assert_eq!(mast(100.0), ("rods.strut_rod_length_mm".into(), gps()), "rods alone are higher");
        let bay = first("cognifly", 114.5, |frame| frame.bracket.bay_height_mm = 44.0);
        assert_eq!(bay, ("bracket.bay_height_mm".into(), Some("`battery_sleeve` is its lowest body".into())));
    }

    #[test]
    fn planted_a_frame_that_is_too_high() {
        let found = Planted::frame(|frame| frame.limits.envelope_height_mm = 100.0).found(check);
        assert_eq!(violated(&found)[0].subject, "height without propellers");
    }
}
