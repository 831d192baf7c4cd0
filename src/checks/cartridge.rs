//! The battery changes quickly: lid, battery, plug and magnet slide out of the sleeve in one piece, to the rear or to the right, in the
//! assembled frame, and pushed in again they meet what they belong to. They are one piece by the tape between battery and lid, for which the
//! battery lies over the lid's floor.
//!
//! The way out is tested in two steps. Until the lid has left the bracket the cartridge is moved in small steps and cut
//! with what its path touches; after that each piece's convex hull, swept on to the end of the way, is (which is more
//! than the piece sweeps, so it errs to the safe side). The battery, a convex body, is swept over the whole way.

use nalgebra::{Isometry3, Vector3};
use rayon::prelude::*;

use super::finding::{Finding, Verdict};
use super::interference::{MAGNET_TOWER, SENSOR, UNDER_RODS};
use super::measure::Measure;
use super::rule::{Blame, Found, InSearch, Levers, Pass, Rule};
use super::scene::{Placed, Scene};
use crate::figures::told_apart;
use crate::frame::assembly::BodyKind;
use crate::frame::assembly::press_fit::TOUCH_MM3;
use crate::frame::skeleton::centre::LEAST_IN_LID_MM;
use crate::memo::Memo;
use crate::params::PartName;

const CLEARANCES: &[&str] = &["battery.battery_clearance_across_mm", "battery.battery_clearance_up_mm", "lid.lid_slide_clearance_mm"];
const BOARDS: &[&str] = &["bracket.bay_height_mm", "sleeve.sleeve_direction"];
const IN_LID: &[&str] = &["lid.lid_reach_mm", "battery.battery_length_mm"];
const RIMS: &[&str] = &["lid.lid_reach_mm", "lid.lid_clearance_mm"];
const MAGNETS: &[&str] = &["bracket.magnet_gap_mm"];
const CONNECTOR: &[&str] = &["bracket.connector_width_mm"];

pub static RULE: Rule = Rule {
    id: "battery_slide",
    title: "Battery change",
    requires: "the battery slides out and meets its stops",
    units: &["mm3", "mm"],
    limits: &[],
    levers: Levers::Sets(&[CLEARANCES, UNDER_RODS, SENSOR, BOARDS, MAGNET_TOWER, IN_LID, RIMS, MAGNETS, CONNECTOR]),
    blame: Blame::Levers,
    in_search: InSearch::Constraints { subjects: &[""], binds: false },
    found: Found::By(&[Pass::quick(check)]),
};

/// What slides: by kind.
const CARTRIDGE: [&str; 3] = ["battery", "connector_lid", "magnet_lid"];
/// Step while the lid is at the bracket, mm.
const STEP_MM: f64 = 2.0;
/// First step, that frees faces in contact, mm.
const FIRST_MM: f64 = 0.05;
/// Faces nearer than this meet, mm.
const MEET_MM: f64 = 0.1;

/// What is in the cartridge's way.
#[derive(Clone, Debug, PartialEq)]
pub struct CartridgePassage {
    /// Its piece and what that meets, when something is in the way.
    pub pair: Option<[String; 2]>,
    /// The volume that they share, mm³.
    pub shared_mm3: f64,
    /// Length of the way out, mm.
    pub way_mm: f64,
    /// The side of the frame that it leads to.
    pub side: &'static str,
    /// The keys that drive it.
    pub levers: &'static [&'static str],
}

impl CartridgePassage {
    fn finding(&self) -> Finding {
        let Self { pair, shared_mm3, way_mm, side, levers } = self;
        let measure = Measure { rule: RULE.id, value: *shared_mm3, limit: TOUCH_MM3, unit: "mm3", levers };
        let (subject, message) = match pair {
            Some([piece, other]) => (
                format!("{piece} past {other}"),
                format!("{piece} meets {other} on its way out of the sleeve: {shared_mm3:.2} mm3 in common"),
            ),
            None => ("way out".into(), format!("the cartridge slides {way_mm:.0} mm to the {side} and meets nothing")),
        };
        measure.at_most(subject, message)
    }
}

/// How two faces meet when the cartridge is home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CartridgeMeeting {
    /// What meets.
    pub what: &'static str,
    /// Distance, mm.
    pub gap_mm: f64,
    /// What it should be, mm.
    pub meant_mm: f64,
    /// How far it may be off, mm.
    pub tolerance_mm: f64,
    /// The keys that drive it.
    pub levers: &'static [&'static str],
}

impl CartridgeMeeting {
    fn finding(&self) -> Finding {
        let Self { what, gap_mm, meant_mm, tolerance_mm, levers } = *self;
        let value = (gap_mm - meant_mm).abs();
        let measure = Measure { rule: RULE.id, value, limit: tolerance_mm, unit: "mm", levers };
        let [gap, meant] = told_apart(gap_mm, meant_mm, 2);
        measure.at_most(format!("end stop: {what}"), format!("{what} are {gap} mm apart when the cartridge is home, {meant} mm are meant"))
    }
}

fn slides(body: &Placed) -> bool {
    body.is_part(PartName::BatteryLid) || matches!(body.shape.kind, BodyKind::Bought(name) if CARTRIDGE.contains(&name))
}

/// The way out: where it leads, how far the lid is beside the bracket, and how far it goes, mm.
struct WayOut {
    out: Vector3<f64>,
    free_mm: f64,
    way_mm: f64,
}

/// The volume that a piece shares with another body on its way, mm³.
fn met_mm3(memo: &Memo, piece: &Placed, other: &Placed, way: &WayOut) -> f64 {
    let WayOut { out, free_mm, way_mm } = *way;
    let moved = |by_mm: f64| piece.bounds.shifted(&(out * by_mm));
    let touched = |from: f64, to: f64| moved(from).around(&moved(to)).distance_mm(&other.bounds) <= 0.0;
    let convex = piece.shape.kind == BodyKind::Bought("battery") || piece.shape.kind == BodyKind::Bought("magnet_lid");
    let near = if convex { FIRST_MM } else { free_mm };
    let steps = if convex { 1 } else { (free_mm / STEP_MM).ceil() as u32 + 1 };
    let mut places: Vec<f64> = (0..steps).map(|step| (f64::from(step) * STEP_MM).clamp(FIRST_MM, near)).collect();
    places.retain(|at| touched(*at, *at));
    let rest = touched(near, way_mm).then_some([near, way_mm]);
    if places.is_empty() && rest.is_none() {
        return 0.0;
    }
    let (name, poses) = (format!("{} past {}", piece.body.name, other.body.name), [piece.body.pose, other.body.pose]);
    let inputs = ([piece, other].map(|body| body.shape.solid.key()), poses, &places, rest, out);
    *memo.get("battery slide", &name, &inputs, || {
        let [piece, other] = [piece, other].map(|body| body.shape.solid.placed(&body.body.pose));
        let back = |by_mm: f64| piece.placed(&Isometry3::from_parts((out * by_mm).into(), Default::default()));
        let swept = rest.map(|[from, to]| back(from).hull_with(&back(to)));
        let all = places.iter().map(|at| back(*at)).chain(swept);
        all.map(|solid| solid.intersection(&other).volume_mm3()).fold(0.0, f64::max)
    })
}

/// The keys that move an obstacle out of the way.
fn levers_of(obstacle: &Placed) -> &'static [&'static str] {
    match obstacle.shape.kind {
        // What belongs to a module is beside or under the sleeve's height: no clearance inside of the sleeve moves it.
        _ if obstacle.body.module.is_some() => UNDER_RODS,
        BodyKind::Bought("flow_sensor") => SENSOR,
        BodyKind::Bought("tie") => MAGNET_TOWER,
        BodyKind::Bought("flight_controller" | "motor_controller") => BOARDS,
        _ => CLEARANCES,
    }
}

fn passage(scene: &Scene) -> Vec<Finding> {
    let Some(lid) = scene.part(PartName::BatteryLid, None) else { return Vec::new() };
    let axes = scene.design.centre.battery_axes;
    let (out, side) = (axes.way_out(), axes.open_side());
    let farthest = scene.placed.iter().map(|p| p.bounds.reach_mm(&out)[1]).fold(f64::NEG_INFINITY, f64::max);
    let (pieces, rest): (Vec<&Placed>, Vec<&Placed>) = scene.placed.iter().partition(|p| slides(p));
    let hindmost = pieces.iter().map(|p| p.bounds.reach_mm(&out)[0]).fold(f64::INFINITY, f64::min);
    let way_mm = farthest - hindmost;
    let inside_mm = -lid.bounds.reach_mm(&out)[0] - scene.design.centre.rim_y_mm;
    let free_mm = scene.design.frame.lid.lid_reach_mm + inside_mm.max(0.0);
    let way = WayOut { out, free_mm, way_mm };
    let pairs: Vec<(&Placed, &Placed)> = pieces.iter().flat_map(|piece| rest.iter().map(|other| (*piece, *other))).collect();
    let met: Vec<f64> = pairs.par_iter().map(|(piece, other)| met_mm3(&scene.design.memo, piece, other, &way)).collect();
    let names = |piece: &Placed, other: &Placed| Some([piece.body.name.clone(), other.body.name.clone()]);
    let in_the_way: Vec<Finding> = pairs
        .iter()
        .zip(&met)
        .filter(|(_, met)| **met > TOUCH_MM3)
        .map(|((piece, other), met)| {
            CartridgePassage { pair: names(piece, other), shared_mm3: *met, way_mm, side, levers: levers_of(other) }.finding()
        })
        .collect();
    if in_the_way.is_empty() {
        let shared_mm3 = met.iter().copied().fold(0.0, f64::max);
        return vec![CartridgePassage { pair: None, shared_mm3, way_mm, side, levers: CLEARANCES }.finding()];
    }
    in_the_way
}

fn meetings(scene: &Scene) -> Vec<Finding> {
    let rims = [PartName::BatteryLid, PartName::BatterySleeve].map(|name| scene.part(name, None));
    let magnets = ["magnet_lid", "magnet_bracket"].map(|name| scene.bought(name));
    let plugs = ["connector_lid", "connector_bracket"].map(|name| scene.bought(name));
    let magnet_gap = scene.design.frame.bracket.magnet_gap_mm;
    let expected: [(_, _, _, _, &'static [&'static str]); 3] = [
        ("the rims of lid and sleeve", rims, 0.0, 0.01, RIMS),
        ("the magnets", magnets, magnet_gap, 0.01, MAGNETS),
        ("the connector's halves", plugs, 0.0, MEET_MM, CONNECTOR),
    ];
    expected
        .into_iter()
        .filter_map(|(what, pair, meant_mm, tolerance_mm, levers)| {
            let [Some(a), Some(b)] = pair else { return None };
            let gap_mm = a.gap_mm(b, meant_mm + 5.0);
            Some(CartridgeMeeting { what, gap_mm, meant_mm, tolerance_mm, levers }.finding())
        })
        .collect()
}

/// A battery that no tape can hold to its lid: pulling the lid would leave it behind.
fn loose_from_lid(scene: &Scene) -> Option<Finding> {
    let (lid, battery) = (scene.part(PartName::BatteryLid, None)?, scene.bought("battery")?);
    let out = scene.design.centre.battery_axes.way_out();
    let beyond_rim_mm = battery.bounds.reach_mm(&out)[1] - lid.bounds.reach_mm(&out)[0];
    let value = beyond_rim_mm.min(scene.design.centre.lid_cover_mm);
    let measure = Measure { rule: RULE.id, value, limit: LEAST_IN_LID_MM, unit: "mm", levers: IN_LID };
    let [reach, least] = measure.figures(1);
    let message =
        format!("the battery reaches into its lid by {reach} mm, at least {least} mm are needed for the tape that holds both together");
    Some(measure.at_least("battery in its lid".into(), message)).filter(|finding| finding.verdict == Verdict::Violated)
}

pub(super) fn check(scene: &Scene) -> Vec<Finding> {
    let mut found = passage(scene);
    found.extend(meetings(scene));
    found.extend(loose_from_lid(scene));
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::planted::{Planted, violated};
    use crate::frame::skeleton::Centre;
    use crate::params::Frame;
    use crate::params::sleeve_direction::SleeveDirection;

    #[test]
    fn planted_a_sensor_behind_the_sleeve() {
        let mut frame = Planted::preset("cognifly");
        assert_eq!(violated(&frame.found(check)), []);
        frame.move_body("flow_sensor", [0.0, -110.0, -5.0]);
        let found = frame.found(check);
        let battery = found.iter().find(|f| f.subject == "battery past flow_sensor").expect("meets it");
        assert!(battery.verdict == Verdict::Violated && battery.levers == SENSOR, "{found:?}");
        assert!(violated(&found).iter().any(|f| f.subject == "battery_lid past flow_sensor"), "{found:?}");
    }

    #[test]
    fn planted_a_lid_that_stays_open() {
        let mut frame = Planted::preset("cognifly");
        frame.move_body("battery_lid", [0.0, -0.5, 0.0]);
        frame.move_body("magnet_lid", [0.0, -0.5, 0.0]);
        let found = frame.found(check);
        let broken: Vec<_> = violated(&found).iter().map(|f| f.subject.clone()).collect();
        assert_eq!(broken, ["end stop: the rims of lid and sleeve", "end stop: the magnets"]);
    }

    /// The default battery reaches into its lid by 13.1 mm.
    #[test]
    fn planted_a_battery_in_front_of_its_lid() {
        let moved = |by_mm: f64| {
            let mut frame = Planted::preset("cognifly");
            frame.move_body("battery", [0.0, by_mm, 0.0]);
            loose_from_lid(&Scene::new(&frame.design, &frame.masses))
        };
        assert_eq!(moved(4.0), None);
        let found = moved(20.0).expect("is loose");
        assert!(found.value < -6.0 && found.levers == IN_LID, "{found:?}");
    }

    /// Hubs that are longer than the battery, along and across, and short batteries: where it lies to the front, it is out of the lid.
    #[test]
    fn regress_a_battery_shorter_than_its_bracket_is_in_its_lid() {
        for (ratio, length_mm, turned) in
            [(1.14, 58.0, false), (1.25, 58.0, false), (1.14, 58.0, true), (1.0, 45.0, false), (1.0, 40.0, false)]
        {
            let mut frame = Frame::load("cognifly").expect("a preset").0;
            (frame.rods.cage_side_ratio, frame.battery.battery_length_mm) = (ratio, length_mm);
            if turned {
                frame.sleeve_direction = SleeveDirection::Across;
            }
            let centre = Centre::new(&frame);
            let [rear, front] = centre.battery_y_mm;
            assert!(centre.rim_y_mm - rear >= LEAST_IN_LID_MM && front <= centre.front_y_mm, "{ratio} {length_mm}");
            assert!((front - rear - length_mm).abs() < 1e-9 && rear >= centre.rim_y_mm - centre.lid_cover_mm - 1e-9, "{ratio} {length_mm}");
        }
    }

    #[test]
    fn planted_a_lid_caught_by_the_bracket() {
        let mut frame = Planted::preset("cognifly");
        frame.move_body("battery_bracket", [0.0, 0.0, -1.0]);
        let found = frame.found(check);
        assert!(violated(&found).iter().any(|f| f.subject == "battery_lid past battery_bracket"), "{found:?}");
    }
}
