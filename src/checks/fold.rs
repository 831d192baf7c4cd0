//! The frame can be put together: an order of steps exists, the triangle of arms, strut and leg closes without leaving its
//! bores, the plugs guide the modules while the rings close, the strut's notch is wide enough for its fold, a module's parts lie
//! flat on a table, and nothing is in the way of a step's motion.

use super::finding::{Finding, Verdict};
use super::hinge::NotchPreload;
use super::interference::{
    self, ACCESSORY, BAY, CAMERA, COMPUTER, KNEE_WINDOW, LOWER_BAY, LOWER_STACK, MAGNET_TOWER, MOTOR_SCREWS, PLUG_FIT, SENSOR, SLEEVE,
    STACK, TIE_HOLES, UNDER_RODS,
};
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Pass, Rule};
use super::scene::Scene;
use crate::frame::fold::{FlatState, FoldError, FoldSequence, LinkageError, MOST_PULLED, fold_inputs, sweeps};
use crate::frame::mounting::Mounting;

const HOLD: &[&str] = &["hub_joint.hub_arm_socket_depth_mm", "fork.fork_socket_depth_mm", "corner.corner_socket_depth_mm"];
const PLUG: &[&str] = &["hub_joint.plug_length_mm", "corner.corner_socket_depth_mm"];
const ORDER: &[&str] = &["rods.strut_rod_length_mm", "motor_mount.motor_position_mm", "corner.corner_node_to_bottom_mm"];
const NOTCH: &[&str] = &["corner.notch_half_angle_deg"];
const WAY: &[&str] = &["motor_mount.motor_position_mm", "rods.strut_rod_length_mm"];
const MOUNTED: &[&str] = &["bracket.bay_height_mm", "camera.camera_reach_mm", "lid.lid_slide_clearance_mm"];
const FLAT: &[&str] = &["rods.arm_rod_length_mm"];

/// The record of a rule: the frame can be folded and mounted, step by step.
pub static RULE: Rule = Rule {
    id: "fold_sequence",
    title: "Fold sequence",
    requires: "a sequence exists in which the frame can be assembled",
    units: &["", "mm", "deg", "mm3", "steps"],
    limits: &[],
    levers: Levers::Sets(&[
        HOLD,
        PLUG,
        ORDER,
        NOTCH,
        WAY,
        KNEE_WINDOW,
        MOUNTED,
        UNDER_RODS,
        FLAT,
        ACCESSORY,
        BAY,
        CAMERA,
        COMPUTER,
        LOWER_BAY,
        LOWER_STACK,
        MAGNET_TOWER,
        MOTOR_SCREWS,
        PLUG_FIT,
        SENSOR,
        SLEEVE,
        STACK,
        TIE_HOLES,
    ]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &["fold: hold", "fold: notch", "fold: flat", "fold"], binds: true },
    found: Found::By(&[Pass::quick(check), Pass::slow(way)]),
};

/// Farthest that a strut may fold beyond the closing of its notch, degrees: a choice; the real frame does 25.
const MOST_PRELOAD_DEG: f64 = 45.0;

/// Farthest that the leg's end may be from its place in the foot, mm.
const CLOSED_MM: f64 = 0.05;

fn measure(value: f64, limit: f64, unit: &'static str, levers: &'static [&'static str]) -> Measure {
    Measure { rule: RULE.id, value, limit, unit, levers }
}

/// Why there is no sequence, as a broken limit.
fn refused(error: &FoldError) -> Finding {
    let (value, limit, unit, levers) = match error {
        FoldError::Linkage(LinkageError::LegTooLong { pulled, .. }) => (*pulled, MOST_PULLED, "", HOLD),
        FoldError::PlugTooShort { needed_mm, plug_mm } => (*needed_mm, *plug_mm, "mm", PLUG),
        FoldError::NoOrder { blocked } => (blocked.len() as f64, 0.0, "steps", ORDER),
        FoldError::Linkage(LinkageError::Lost { .. }) => (1.0, 0.0, "steps", ORDER),
    };
    // However little is missing: there is no sequence.
    let missed = measure(value, limit, unit, levers).at_most("fold".into(), error.to_string());
    Finding { verdict: Verdict::Violated, margin: limit - value, ..missed }
}

fn preload(scene: &Scene) -> Finding {
    let value = NotchPreload::of(&scene.design.frame, &scene.design.skeleton).beyond_deg();
    let measure = measure(value, MOST_PRELOAD_DEG, "deg", NOTCH);
    let [beyond, most] = measure.figures(1);
    measure.at_most("fold: notch".into(), format!("the struts fold {beyond} deg beyond the closing of their notch, {most} deg are allowed"))
}

/// What drives the way of a step on which two bodies meet: their own fit, or where the modules are.
fn way_levers(scene: &Scene, bodies: &[String; 2]) -> &'static [&'static str] {
    interference::levers_of(scene, bodies).unwrap_or(WAY)
}

/// What is in the way of a step.
fn in_the_way(scene: &Scene, fold: &FoldSequence) -> Finding {
    let sweeps = sweeps(scene.design, fold);
    let worst = fold.steps.iter().zip(&sweeps).max_by(|a, b| a.1.beyond_mm3.total_cmp(&b.1.beyond_mm3));
    let value = worst.map_or(0.0, |(_, sweep)| sweep.beyond_mm3);
    let met = worst.and_then(|(step, sweep)| sweep.meetings.first().map(|meeting| (step, meeting)));
    let pairs: usize = sweeps.iter().map(|sweep| sweep.pairs).sum();
    let message = match met {
        Some((step, m)) => {
            let [a, b] = &m.bodies;
            format!("{}: {a} and {b} share {:.2} mm3 on the way, {:.2} mm3 are meant", step.title, m.shared_mm3, m.allowed_mm3)
        }
        None => format!("nothing is in the way of any step: {pairs} pairs of pieces that move to each other"),
    };
    let levers = met.map_or(WAY, |(_, meeting)| way_levers(scene, &meeting.bodies));
    measure(value, 0.0, "mm3", levers).at_most("fold: way".into(), message)
}

/// What drives the way of a mount on which two bodies meet: battery and lid slide in under the rods of the bottom ring, and others have a fit of
/// their own.
fn mount_levers(scene: &Scene, bodies: &[String; 2]) -> &'static [&'static str] {
    let is = |names: &[&str]| bodies.iter().any(|body| names.iter().any(|name| body.starts_with(name)));
    let slides_under = is(&["battery_lid", "battery"]) && is(&["cage_", "strut_", "leg_"]);
    if slides_under { UNDER_RODS } else { interference::levers_of(scene, bodies).unwrap_or(MOUNTED) }
}

/// What is in the way of a mount.
fn mounted(scene: &Scene, fold: &FoldSequence) -> Finding {
    let mounting = Mounting::new(scene.design, fold);
    let worst = mounting.steps().max_by(|a, b| a.sweep.beyond_mm3.total_cmp(&b.sweep.beyond_mm3));
    let value = worst.map_or(0.0, |step| step.sweep.beyond_mm3);
    let pairs: usize = mounting.steps().map(|step| step.sweep.pairs).sum();
    let met = worst.and_then(|step| step.sweep.meetings.first().map(|meeting| (step, meeting)));
    let message = match met {
        Some((step, m)) => {
            let [a, b] = &m.bodies;
            format!("{}: {a} and {b} share {:.2} mm3 on the way into place, {:.2} mm3 are meant", step.title, m.shared_mm3, m.allowed_mm3)
        }
        None => format!("nothing is in the way of what is mounted: {pairs} pairs of bodies"),
    };
    let levers = met.map_or(MOUNTED, |(_, meeting)| mount_levers(scene, &meeting.bodies));
    measure(value, 0.0, "mm3", levers).at_most("mounting: way".into(), message)
}

/// The module on a table, before the first step.
fn flat(scene: &Scene) -> Finding {
    let flat = FlatState::new(scene.design);
    let wrong = flat.check(scene.design);
    let [x, y] = flat.size_mm();
    let message = match wrong.first() {
        Some(error) => error.to_string(),
        None => format!("a module's parts lie flat on {x:.0} x {y:.0} mm, each as it is printed"),
    };
    measure(wrong.len() as f64, 0.0, "", FLAT).at_most("fold: flat".into(), message)
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let design = scene.design;
    let inputs = fold_inputs(&design.frame, &design.skeleton);
    let (exists, mut found) = (*design.memo.get("fold sequence", "fold", &inputs, || of_sequence(scene))).clone();
    found.push(preload(scene));
    if exists {
        let parts: Vec<_> = design.printed.iter().map(|part| (part.name, part.flat.key(), part.print_pose)).collect();
        let lie = || flat(scene);
        found.push(Finding::clone(&design.memo.get(
            "flat state",
            "fold",
            &(parts, &design.frame.rods, design.frame.rod_bore_mm(), inputs),
            lie,
        )));
    }
    found
}

/// Whether there is a sequence; what it says of itself, or why there is none.
fn of_sequence(scene: &Scene) -> (bool, Vec<Finding>) {
    let fold = match FoldSequence::new(&scene.design.frame, &scene.design.skeleton) {
        Ok(fold) => fold,
        Err(error) => return (false, vec![refused(&error)]),
    };
    let pulled = measure(fold.entry.pulled, MOST_PULLED, "", HOLD);
    let text = format!(
        "{} steps; while the triangle closes its rods stand out by {:.0} % of their hold, {:.0} % are allowed",
        fold.steps.len(),
        100.0 * fold.entry.pulled,
        100.0 * MOST_PULLED
    );
    let error_mm = fold.steps.iter().filter_map(|step| step.loop_error_mm).fold(0.0, f64::max);
    let closed = measure(error_mm, CLOSED_MM, "mm", &[]);
    let closes = format!("the triangle of arms, strut and leg closes within {error_mm:.3} mm, {CLOSED_MM} mm are allowed");
    (true, vec![pulled.at_most("fold: hold".into(), text), closed.at_most("fold: closure".into(), closes)])
}

/// Nothing is in the way of a step; without a sequence there is nothing to say.
pub(super) fn way(scene: &Scene) -> Vec<Finding> {
    let fold = FoldSequence::new(&scene.design.frame, &scene.design.skeleton);
    fold.iter().flat_map(|fold| [in_the_way(scene, fold), mounted(scene, fold)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};

    #[test]
    fn planted_a_knee_too_wide_for_its_fork_names_what_drives_their_fit() {
        let found = Planted::frame(|frame| frame.fork.fork_cheek_gap_mm -= 0.2).found(way);
        assert_eq!(violated(&found)[0].levers, KNEE_WINDOW, "{found:?}");
    }

    #[test]
    fn planted_a_battery_that_meets_a_rod_names_what_lifts_the_rod_or_lowers_the_battery() {
        let frame = Planted::preset("cognifly");
        let scene = Scene::new(&frame.design, &frame.masses);
        let meets = |a: &str, b: &str| mount_levers(&scene, &[a.into(), b.into()]);
        assert_eq!(meets("battery_lid", "cage_BL_bottom"), UNDER_RODS);
        assert_eq!(meets("flight_controller", "battery_bracket"), BAY);
        assert_eq!(meets("flow_sensor", "battery_sleeve"), SENSOR);
        assert_eq!(meets("motor_FR", "cage_FR_top"), MOUNTED);
    }

    #[test]
    fn planted_folds_that_cannot_be() {
        assert_eq!(violated(&Planted::preset("cognifly").found(check)), []);
        let narrow = Planted::frame(|frame| frame.corner.notch_half_angle_deg = 32.0).found(check);
        assert_eq!(violated(&narrow)[0].subject, "fold: notch");
        let short = Planted::frame(|frame| frame.hub_joint.plug_length_mm = 5.0).found(check);
        assert!(violated(&short)[0].message.contains("plugs"), "{short:?}");
        // There is no sequence, however little is missing.
        let just_short =
            Planted::frame(|frame| frame.hub_joint.plug_length_mm = 0.5_f64.sqrt() * frame.corner.corner_socket_depth_mm - 0.003)
                .found(check);
        let broken = violated(&just_short);
        assert!(broken.iter().any(|f| f.subject == "fold" && f.margin < 0.0 && f.message.contains("5.303")), "{just_short:?}");
        let deep = Planted::frame(|frame| {
            frame.corner.corner_socket_depth_mm = 12.0;
            frame.hub_joint.hub_arm_socket_depth_mm = 6.0;
            frame.fork.fork_socket_depth_mm = 5.0;
            frame.knee.knee_socket_depth_mm = 5.0;
        });
        let found = deep.found(check);
        assert!(violated(&found).iter().any(|f| f.subject.starts_with("fold") && f.value.is_finite()), "{found:?}");
    }
}
