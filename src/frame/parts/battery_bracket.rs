//! The bracket: hangs the battery sleeve under the hub and leaves the electronics bay between its uprights.
//!
//! Frame of reference: x across, y front (of the sleeve, away from the lid), z up; origin between the tie holes, at the top of the uprights. The
//! front upright carries wire holes, the rear one the channel of the power connector and the magnet.

use nalgebra::{UnitQuaternion, Vector3};

use super::outline::{Corner, along_x, along_y, bore, bore_y, face, sharp};
use super::record::{Fold, MaterialClass, PrintedPart, Seat, Wall, always};
use crate::frame::skeleton::centre::Centre;
use crate::params::frame::WIRE_ROWS;
use crate::params::groups::BracketParameters;
use crate::params::{Frame, PartName};
use crate::solid::{Feature, Profile};

/// The record of the part.
pub static PART: PrintedPart = PrintedPart {
    name: PartName::BatteryBracket,
    feature: |frame, _, centre| feature(frame, centre),
    material: MaterialClass::Rigid,
    seat: Seat::Centre(Centre::bracket_pose),
    fold: Fold::Stands,
    print_turn,
    needed: always,
    walls: &[Wall::anywhere(&["bracket.bracket_floor_mm", "bracket.bracket_side_wall_mm", "hub.tie_ring_radius_mm"])],
};

/// Rounding of the two uncut corners of the connector, mm.
const CONNECTOR_ROUND_MM: f64 = 0.65;

/// The bracket of a frame.
pub fn feature(frame: &Frame, centre: &Centre) -> Feature {
    let (half, wide) = (centre.bracket_half_mm, 0.5 * centre.bracket_width_mm);
    let mut cuts = rear_cuts(frame, centre);
    cuts.extend(wire_holes(&frame.bracket, centre, front_face_mm(frame, centre)));
    cuts.extend([1.0, -1.0].map(|side| tie(&frame.bracket, centre.tie_bracket_mm, half, side)));
    along_x(side_view(frame, centre), [-wide, wide]).minus(cuts)
}

/// Printed on its base.
pub fn print_turn() -> UnitQuaternion<f64> {
    UnitQuaternion::identity()
}

/// Outline of the power connector in (x, z) around its middle, smaller by the inset on every side; the cut
/// corners on the left code its polarity.
pub(in crate::frame) fn connector(bracket: &BracketParameters, inset_mm: f64, z_mm: f64) -> Profile {
    let (w, h) = (0.5 * bracket.connector_width_mm - inset_mm, 0.5 * bracket.connector_height_mm - inset_mm);
    let cut = (bracket.connector_chamfer_mm - 0.5 * inset_mm).max(0.0).min(h - 0.2);
    let round = (CONNECTOR_ROUND_MM - 0.5 * inset_mm).max(0.2);
    let corners: Vec<Corner> = if cut > 0.05 {
        let left = [sharp(-w + cut, h), sharp(-w, h - cut), sharp(-w, cut - h), sharp(-w + cut, -h)];
        vec![left[3], ([w, -h], round), ([w, h], round), left[0], left[1], left[2]]
    } else {
        vec![([-w, -h], round), ([w, -h], round), ([w, h], round), ([-w, h], round)]
    };
    face(&corners.into_iter().map(|([x, z], r)| ([x, z + z_mm], r)).collect::<Vec<_>>())
}

/// The inner face of the front upright.
fn front_face_mm(frame: &Frame, centre: &Centre) -> f64 {
    centre.bracket_half_mm - 2.0 * frame.hub.tie_ring_radius_mm
}

/// Base and uprights in (y, z).
fn side_view(frame: &Frame, centre: &Centre) -> Profile {
    let (b, half, low, inner) = (&frame.bracket, centre.bracket_half_mm, -centre.bracket_height_mm, front_face_mm(frame, centre));
    // The channel must be open upwards along the base.
    let open = b.bracket_floor_mm + b.connector_height_mm - b.connector_chamfer_mm - 0.1;
    let base = low + b.bracket_base_mm.min(open);
    face(&[
        sharp(-half, low),
        sharp(half, low),
        sharp(half, 0.0),
        sharp(inner, 0.0),
        sharp(inner, base),
        ([-inner, base], b.bracket_fillet_mm),
        sharp(-inner, 0.0),
        sharp(-half, 0.0),
    ])
}

/// The connector's channel, open along the base, and the magnet's pocket.
fn rear_cuts(frame: &Frame, centre: &Centre) -> Vec<Feature> {
    let (half, z) = (centre.bracket_half_mm, centre.magnet_z_mm);
    let [along, up] = centre.magnet_pocket_mm.map(|edge| 0.5 * edge);
    let channel = along_y(connector(&frame.bracket, 0.0, centre.connector_z_mm), [-half - 1.0, front_face_mm(frame, centre) + 0.05]);
    let bottom = frame.bracket.magnet_thickness_mm - half;
    vec![channel, Feature::cuboid_between([-along, -half - 1.0, z - up], [along, bottom, z + up])]
}

/// Two holes behind the magnet, and the grid in the front upright.
fn wire_holes(bracket: &BracketParameters, centre: &Centre, inner: f64) -> Vec<Feature> {
    let (half, z, across) = (centre.bracket_half_mm, centre.magnet_z_mm, 0.5 * bracket.wire_hole_pitch_across_mm);
    let hole = |x, row: u8, y| bore_y(x, z - f64::from(row) * bracket.wire_hole_pitch_up_mm, bracket.wire_hole_diameter_mm, y);
    [across, -across]
        .into_iter()
        .flat_map(|x| {
            let front = (0..WIRE_ROWS).map(move |row| hole(x, row, [inner - 1.0, half + 1.0]));
            front.chain([hole(x, 0, [-half - 1.0, 1.0 - inner])])
        })
        .collect()
}

/// The hole of a zip tie from above and the slot through which it leaves.
fn tie(bracket: &BracketParameters, tie_mm: f64, half: f64, side: f64) -> Feature {
    let (depth, wide) = (bracket.tie_hole_depth_mm, 0.5 * bracket.tie_slot_width_mm);
    let slot = Feature::cuboid_between([-wide, tie_mm, -depth], [wide, half + 1.0, bracket.tie_slot_height_mm - depth]);
    let tie = Feature::union([bore(0.0, tie_mm, bracket.tie_hole_diameter_mm, [-depth, 1.0]), slot]);
    if side > 0.0 { tie } else { tie.mirrored(Vector3::y()) }
}

#[cfg(test)]
mod tests {
    use super::super::gauges::{Gauged, v8};
    use super::*;

    fn bracket() -> Gauged {
        let (frame, centre) = v8();
        Gauged::new(&feature(&frame, &centre))
    }

    #[test]
    fn measured_bracket_is_like_the_real_one() {
        bracket().like_the_real_one([13.21, 57.824, 21.5], 3699.7, 2.0, 11);
    }

    #[test]
    fn measured_electronics_bay_is_clear() {
        let (window, side) = (0.5 * 43.824, 6.6);
        bracket().pocket([-side, 1.0 - window, -15.9], [side, window, 0.0], "Y");
        bracket().pocket([-side, -window, -15.9], [side, window, 0.0], "yY");
        bracket().pocket([5.6, -10.0, -18.5], [side, 10.0, 0.0], "z");
    }

    #[test]
    fn measured_connector_and_magnet_fit_the_rear_upright() {
        let bracket = bracket();
        bracket.pocket([-5.1, -29.5, -13.2], [5.1, -28.912 + 3.0, -8.0], "xXYzZ");
        bracket.pocket([-3.5, -29.5, -20.65], [5.275 - 0.7, -21.0, -15.1], "zZ");
        bracket.pocket([-5.275, -29.5, -19.0], [5.275, -21.0, -17.0], "xX");
    }

    #[test]
    fn measured_ties_and_wire_holes_are_in_place() {
        let bracket = bracket();
        for y in [25.41, -25.41] {
            bracket.hole([0.0, y, -5.9], [0.0, y, 1.0], 4.0);
        }
        for x in [2.5, -2.5] {
            for row in [0.0, 1.0, 2.0] {
                let z = -10.6 - 4.25 * row;
                bracket.hole([x, 25.0, z], [x, 30.0, z], 3.0);
            }
        }
    }
}
