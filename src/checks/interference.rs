//! No two bodies share volume beyond the press fits that are meant.
//!
//! Measured by the kernel's boolean intersection. What is meant is in [`press_fit`](crate::frame::assembly::press_fit).
//! Swept discs are the propeller rule's.

use rayon::prelude::*;

use super::finding::Finding;
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Pass, Rule};
use super::scene::{Placed, Scene};
use crate::frame::assembly::BodyKind;
use crate::frame::assembly::press_fit::{ROUNDING, TOUCH_MM3, gripped_mm3, plugs_mm3};
use crate::frame::assembly::screw_solids::threads_mm3;
use crate::params::PartName;
use crate::params::roles::{ACCESSORIES, HUNG};

const ROD_FIT: &[&str] = &["fit.grip_clearance_mm", "fit.slide_clearance_mm", "rods.rod_diameter_mm"];
pub(super) const PLUG_FIT: &[&str] = &["fit.plug_clearance_mm", "hub_joint.plug_length_mm"];
/// What drives the fit of knee and fork.
pub(super) const KNEE_WINDOW: &[&str] =
    &["fork.fork_cheek_gap_mm", "knee.knee_window_clearance_height_mm", "knee.knee_window_clearance_depth_mm"];
pub(super) const SLEEVE: &[&str] =
    &["battery.battery_clearance_across_mm", "battery.battery_clearance_up_mm", "sleeve.channel_clearance_mm"];
const OTHER: &[&str] = &["motor_mount.motor_position_mm", "hub_joint.arm_pitch_mm", "bracket.bay_height_mm"];
pub(super) const MOTOR_SCREWS: &[&str] = &["motor_mount.motor_skirt_wall_mm", "motor_mount.motor_plate_diameter_mm", "bought.motor_screw"];
pub(super) const STACK: &[&str] = &["bracket.bay_height_mm", "bought.flight_controller", "bought.stack_screw"];
/// The same where the board is the motor controller, or the only one.
pub(super) const LOWER_STACK: &[&str] = &["bracket.bay_height_mm", "bought.motor_controller", "bought.stack_screw"];
/// What is on the screws of the stack, and the screws.
const STACK_BODIES: [&str; 7] =
    ["flight_controller", "motor_controller", "stack_screw", "stack_nut", "stack_spacer_hub", "stack_spacer_boards", "damper"];
/// A board that is too long for the bay may have the room across it.
pub(super) const BAY: &[&str] = &["sleeve.sleeve_direction", "bracket.bay_height_mm", "bought.flight_controller"];
pub(super) const LOWER_BAY: &[&str] = &["sleeve.sleeve_direction", "bracket.bay_height_mm", "bought.motor_controller"];
pub(super) const COMPUTER: &[&str] = &["bought.computer", "camera.camera_reach_mm", "pi_carrier.carrier_thickness_mm"];
pub(super) const CAMERA: &[&str] = &["camera.camera_reach_mm", "camera.camera_lift_mm", "bought.camera"];
pub(super) const ACCESSORY: &[&str] = &["accessories.accessory_side_mm", "accessories.mast_back_mm", "accessories.fpv_above_mm"];
/// What widens the holes of a tie, or is a narrower one.
pub(super) const TIE_HOLES: &[&str] = &["bought.tie", "hub.hub_tie_hole_diameter_mm", "bracket.tie_slot_width_mm"];
/// What raises the tower of the lid's magnet, under the ties that run over the bracket's posts.
pub(super) const MAGNET_TOWER: &[&str] = &["bracket.magnet_wall_mm", "bracket.bracket_roof_mm"];
pub(super) const SENSOR: &[&str] = &["sleeve.sensor_reach_mm", "bought.flow_sensor"];
/// What lifts the rods over the battery, or lowers what is under them.
pub(super) const UNDER_RODS: &[&str] = &["rods.strut_rod_length_mm", "battery.battery_height_mm", "bought.battery"];

pub static RULE: Rule = Rule {
    id: "interference",
    title: "Interference",
    requires: "bodies share no volume beyond the intended press fits",
    units: &["mm3"],
    limits: &[],
    levers: Levers::Sets(&[
        ROD_FIT,
        PLUG_FIT,
        KNEE_WINDOW,
        SLEEVE,
        OTHER,
        MOTOR_SCREWS,
        STACK,
        LOWER_STACK,
        BAY,
        LOWER_BAY,
        COMPUTER,
        CAMERA,
        SENSOR,
        TIE_HOLES,
        MAGNET_TOWER,
        ACCESSORY,
    ]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: false },
    found: Found::By(&[Pass::quick_where_bent(check, None)]),
};

/// What two bodies share.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedVolume {
    /// The two.
    pub pair: [String; 2],
    /// Shared, mm³.
    pub volume_mm3: f64,
    /// What is meant, and rounding, mm³.
    pub limit_mm3: f64,
    /// What drives the fit.
    pub levers: &'static [&'static str],
}

impl SharedVolume {
    fn finding(&self) -> Finding {
        let Self { pair: [a, b], volume_mm3: value, limit_mm3: limit, levers } = self;
        let measure = Measure { rule: RULE.id, value: *value, limit: *limit, unit: "mm3", levers };
        let [shared, meant] = measure.figures(3);
        measure.at_most(format!("{a} and {b}"), format!("{a} and {b} share {shared} mm3, {meant} mm3 are meant"))
    }

    fn is_press_fit(&self) -> bool {
        self.limit_mm3 > TOUCH_MM3
    }
}

fn meant(scene: &Scene, a: &Placed, b: &Placed) -> (f64, &'static [&'static str]) {
    let frame = &scene.design.frame;
    for (rod, part) in [(a, b), (b, a)] {
        let (BodyKind::Rod(_), BodyKind::Printed(name)) = (&rod.shape.kind, &part.shape.kind) else { continue };
        let rods = scene.design.skeleton.rods.iter().filter(|r| r.name == rod.body.name);
        let ring: f64 = rods.map(|r| gripped_mm3(r, frame.rods.rod_diameter_mm, *name, part.body.module)).sum();
        return (ring * ROUNDING, ROD_FIT);
    }
    let is = |name| a.is_part(name) || b.is_part(name);
    let has = |name: &str| [a, b].iter().any(|p| matches!(p.shape.kind, BodyKind::Bought(bought) if bought == name));
    let is_lower = has("motor_controller") || !frame.bought.contains_key("flight_controller");
    let (stack, bay) = if is_lower { (LOWER_STACK, LOWER_BAY) } else { (STACK, BAY) };
    let [in_motor, in_hub] = threads_mm3(frame, &scene.design.centre).map(|thread| thread * ROUNDING);
    match () {
        () if has("motor_screw") => {
            (if a.shape.kind == BodyKind::Motor || b.shape.kind == BodyKind::Motor { in_motor } else { 0.0 }, MOTOR_SCREWS)
        }
        () if has("stack_screw") && is(PartName::Hub) => (in_hub, stack),
        () if HUNG.into_iter().any(has) && is(PartName::BatteryBracket) => (0.0, bay),
        () if STACK_BODIES.into_iter().any(has) => (0.0, stack),
        () if has("tie") && is(PartName::BatteryLid) => (0.0, MAGNET_TOWER),
        () if has("tie") => (0.0, TIE_HOLES),
        () if has("camera") => (0.0, CAMERA),
        () if has("computer") => (0.0, COMPUTER),
        () if has("flow_sensor") => (0.0, SENSOR),
        () if ACCESSORIES.into_iter().any(has) => (0.0, ACCESSORY),
        () if is(PartName::Hub) && is(PartName::HubJoint) => (plugs_mm3(frame) * ROUNDING, PLUG_FIT),
        () if is(PartName::Knee) && is(PartName::Fork) => (0.0, KNEE_WINDOW),
        () if is(PartName::BatterySleeve) => (0.0, SLEEVE),
        () => (0.0, OTHER),
    }
}

/// What drives the places of two bodies with these names; `None` where a rod is one of them, or nothing of their own does.
pub(super) fn levers_of(scene: &Scene, names: &[String; 2]) -> Option<&'static [&'static str]> {
    let [a, b] = names.each_ref().map(|name| scene.placed.iter().find(|placed| placed.body.name == *name));
    let (a, b) = (a?, b?);
    let is_rod = [a, b].iter().any(|placed| matches!(placed.shape.kind, BodyKind::Rod(_)));
    let (_, levers) = meant(scene, a, b);
    (!is_rod && levers != OTHER).then_some(levers)
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let near: Vec<_> = scene
        .pairs()
        .into_iter()
        .filter(|(a, b)| !a.is_propeller() && !b.is_propeller() && a.bounds.distance_mm(&b.bounds) <= 0.0)
        .collect();
    let shared: Vec<SharedVolume> = near
        .par_iter()
        .map(|(a, b)| {
            let (press_fit, levers) = meant(scene, a, b);
            let pair = [a.body.name.clone(), b.body.name.clone()];
            SharedVolume { pair, volume_mm3: a.shared_mm3(b), limit_mm3: press_fit + TOUCH_MM3, levers }
        })
        .collect();
    let (fits, rest): (Vec<_>, Vec<_>) = shared.into_iter().partition(SharedVolume::is_press_fit);
    let (clear, broken): (Vec<_>, Vec<_>) = rest.into_iter().partition(|s| s.volume_mm3 <= s.limit_mm3);
    let mut found: Vec<Finding> = broken.iter().chain(&fits).map(SharedVolume::finding).collect();
    let most = clear.iter().map(|s| s.volume_mm3).fold(0.0, f64::max);
    let measure = Measure { rule: RULE.id, value: most, limit: TOUCH_MM3, unit: "mm3", levers: &[] };
    let (count, [most, limit]) = (clear.len(), measure.figures(3));
    let message =
        format!("of {count} other pairs of bodies that are near each other none shares more than {most} mm3, {limit} mm3 are rounding");
    found.push(measure.at_most("other near pairs".into(), message));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::params::Frame;

    #[test]
    fn planted_a_motor_in_its_mount() {
        let mut frame = Planted::preset("cognifly");
        assert_eq!(violated(&frame.found(check)), []);
        frame.move_body("motor_FR", [0.0, 0.0, -0.5]);
        let found = frame.found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| f.subject.clone()).collect();
        assert_eq!(broken, ["motor_mount_FR and motor_FR", "motor_FR and motor_screw_FR"]);
    }

    #[test]
    fn planted_a_rod_pushed_too_deep() {
        let mut frame = Planted::preset("cognifly");
        frame.move_body("cage_FR_top", [-1.0, 0.0, 0.0]);
        assert!(violated(&frame.found(check)).iter().any(|f| f.subject.contains("cage_FR_top")));
    }

    #[test]
    fn planted_a_flight_controller_that_is_larger_than_its_bay() {
        let large = |frame: &mut Frame| frame.bought.get_mut("flight_controller").expect("has one").part.size_mm = [90.0, 90.0, 60.0];
        let found = Planted::frame(large).found(check);
        for meets in ["battery_bracket and flight_controller", "battery_sleeve and flight_controller"] {
            assert!(violated(&found).iter().any(|f| f.subject == meets && f.value > 100.0), "{meets}: {found:?}");
        }
    }

    #[test]
    fn planted_a_board_that_meets_something_is_among_what_drives_that() {
        for (role, levers) in [("flight_controller", [BAY, STACK]), ("motor_controller", [LOWER_BAY, LOWER_STACK])] {
            let large = |frame: &mut Frame| frame.bought.get_mut(role).expect("has one").part.size_mm = [90.0, 90.0, 60.0];
            let found = Planted::frame(large).found(check);
            for (other, levers) in ["battery_bracket", "battery_sleeve"].into_iter().zip(levers) {
                let met = violated(&found).into_iter().find(|f| f.subject == format!("{other} and {role}")).expect("meet");
                assert_eq!(met.levers, levers, "{}", met.subject);
            }
        }
    }

    /// Both of its levers lower the tower, or lift the ties: tried.
    #[test]
    fn planted_a_magnet_tower_that_meets_the_tie_names_what_raises_it() {
        let tall = |wall_mm: f64, roof_mm: f64| {
            let found = Planted::frame(|frame| {
                let bracket = &mut frame.bracket;
                (bracket.magnet_width_mm, bracket.magnet_clearance_mm) = (5.9, 0.4);
                (bracket.magnet_wall_mm, bracket.bracket_roof_mm) = (wall_mm, roof_mm);
            });
            violated(&found.found(check)).into_iter().map(|finding| finding.levers.concat()).collect::<Vec<_>>()
        };
        assert_eq!(tall(3.0, 2.0), [MAGNET_TOWER.concat()]);
        assert_eq!(tall(1.5, 2.0), Vec::<String>::new());
        assert_eq!(tall(3.0, 3.0), Vec::<String>::new());
    }

    /// The bores of the arms ended where their sockets do, and an arch that reaches beyond these stood in the way of the rods.
    #[test]
    fn regress_a_wide_arch_lets_the_arms_pass() {
        let wide = Planted::frame(|frame| (frame.hub_joint.arch_width_mm, frame.hub_joint.hub_leg_root_mm) = (8.0, 9.04));
        assert_eq!(violated(&wide.found(check)), []);
    }

    #[test]
    fn planted_screw_heads_in_the_skirt_of_the_mount() {
        // Two lines of 0.6 mm: the heads of M2 screws on a circle of 9 mm need 1.1 mm at most.
        let found = Planted::frame(|frame| frame.motor_mount.motor_skirt_wall_mm = 1.2).found(check);
        assert!(violated(&found).iter().any(|f| f.subject == "motor_mount_FR and motor_screw_FR"), "{found:?}");
    }

    #[test]
    fn analytic_the_hub_turns_with_the_modules() {
        let frame = Planted::preset("cognifly");
        let hub = &frame.design.part(PartName::Hub).expect("has a hub").folded;
        let turn = nalgebra::UnitQuaternion::from_axis_angle(&nalgebra::Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        let turned = hub.placed(&nalgebra::Isometry3::from_parts(Default::default(), turn));
        // Some of its faces are sunk by hundredths of a millimetre to keep them apart, not the same ones on all sides.
        assert!(hub.minus(&turned).volume_mm3() < 1e-3 * hub.volume_mm3(), "{}", hub.minus(&turned).volume_mm3());
    }
}
