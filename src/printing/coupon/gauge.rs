//! What is tried: bores, windows, tongues that bend, and bosses, side by side behind their numbers.

use super::label::two_digits;
use crate::params::Frame;
use crate::params::lookup::known;
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// Depth of the strip that carries the numbers, mm.
const STRIP_MM: f64 = 3.6;
/// Its height, mm: two layers.
const STRIP_HEIGHT_MM: f64 = 0.4;
/// Wall between two openings, below and above them, mm.
const WALL_MM: f64 = 0.9;
/// The same of the rigid piece, whose bores are those of the hub, mm.
const BOSS_WALL_MM: f64 = 1.6;
/// How deep a rod or bar goes in, mm.
const DEPTH_MM: f64 = 2.0;
/// How deep a plug goes in, mm.
const BOSS_DEPTH_MM: f64 = 3.0;
/// Cutters reach this far past a face, mm.
const PAST_MM: f64 = 1.0;
/// How far the plug stays above the bar's lower face, so that its lowest line does not lie in it, mm.
const LIFT_MM: f64 = 0.02;
/// Free length of a tongue, mm.
const TONGUE_MM: f64 = 4.5;
/// Width of a tongue, mm.
const TONGUE_WIDTH_MM: f64 = 3.0;
/// Least width of a cell, mm: between two numbers there is three times the room that there is between two digits.
const CELL_MM: f64 = 5.2;

/// Bores less rod diameter, tenths of a millimetre: 2.5 to 3.4 mm for rods of 3 mm.
const BORES_TENTHS: std::ops::RangeInclusive<i32> = -5..=4;
/// Clearances of windows, tenths of a millimetre.
pub(super) const WINDOWS_TENTHS: std::ops::RangeInclusive<i32> = 0..=3;
/// Clearances of bosses, tenths of a millimetre.
pub(super) const BOSSES_TENTHS: std::ops::RangeInclusive<i32> = 0..=4;
/// Thinner than the frame's hinges, tenths of a millimetre.
pub(super) const THINNER_TENTHS: [i32; 3] = [8, 4, 0];

/// Key of the thickness of a web that folds.
pub(super) const HINGE: &str = "corner.corner_hinge_thickness_mm";

/// Tenths of a millimetre.
pub(super) fn tenths(mm: f64) -> i32 {
    (10.0 * mm).round() as i32
}

fn mm(tenths: i32) -> f64 {
    0.1 * f64::from(tenths)
}

/// A row in the making.
struct Row {
    x_mm: f64,
    depth_mm: f64,
    solid: Vec<Feature>,
    cuts: Vec<Feature>,
}

impl Row {
    fn new(depth_mm: f64) -> Self {
        Self { x_mm: 0.0, depth_mm, solid: Vec::new(), cuts: Vec::new() }
    }

    /// A cell behind its number, with an opening along y whose outline is drawn around the middle of the cell's face.
    fn cell(&mut self, number: i32, [width_mm, height_mm]: [f64; 2], wall_mm: f64, opening: &dyn Fn([f64; 2]) -> Contour) {
        let width = (width_mm + wall_mm).max(CELL_MM);
        let middle = self.x_mm + 0.5 * width;
        let top = height_mm + 2.0 * wall_mm;
        let back = STRIP_MM + self.depth_mm;
        self.solid.push(Feature::cuboid_between([self.left_mm(), STRIP_MM, 0.0], [self.x_mm + width, back, top]));
        // It ends between the block and the numbers.
        let bore = Feature::extrude(Profile::new(opening([middle, 0.5 * top])), self.depth_mm + PAST_MM + 0.3);
        // From the xy plane upright: what was z runs back along -y.
        self.cuts.push(bore.turned_x(Angle::deg(90.0)).at(0.0, back + PAST_MM, 0.0));
        self.numbered(number, middle, width);
    }

    /// Where a cell begins: within the one before, so that the two are one body.
    fn left_mm(&self) -> f64 {
        (self.x_mm - 0.2).max(0.0)
    }

    /// A tongue that can be folded back.
    fn tongue(&mut self, number: i32, thickness_mm: f64) {
        let (width, middle) = (CELL_MM, self.x_mm + 0.5 * CELL_MM);
        let root = STRIP_MM + self.depth_mm;
        self.solid.push(Feature::cuboid_between([self.left_mm(), STRIP_MM, 0.0], [self.x_mm + width, root, thickness_mm + WALL_MM]));
        let half = 0.5 * TONGUE_WIDTH_MM;
        self.solid.push(Feature::cuboid_between([middle - half, root - 0.5, 0.0], [middle + half, root + TONGUE_MM, thickness_mm]));
        self.numbered(number, middle, width);
    }

    fn numbered(&mut self, number: i32, middle_mm: f64, width_mm: f64) {
        let strip = Feature::cuboid_between([self.left_mm(), 0.0, 0.0], [self.x_mm + width_mm, STRIP_MM + 0.5, STRIP_HEIGHT_MM]);
        self.solid.push(strip);
        self.solid.extend(two_digits(number.unsigned_abs(), [middle_mm, 0.5 * STRIP_MM], STRIP_HEIGHT_MM));
        self.x_mm += width_mm;
    }

    fn feature(self) -> Feature {
        Feature::union(self.solid).minus(self.cuts)
    }
}

/// The bores' diameters, which are their numbers, tenths of a millimetre: whole ones for a rod between two tenths, too.
pub(super) fn bores_tenths(frame: &Frame) -> impl Iterator<Item = i32> {
    let rod = tenths(frame.rods.rod_diameter_mm);
    BORES_TENTHS.map(move |more| rod + more)
}

/// The flexible piece: bores for a rod, windows for the bar, tongues.
pub(super) fn flexible(frame: &Frame) -> Feature {
    let mut row = Row::new(DEPTH_MM);
    for number in bores_tenths(frame) {
        let bore_mm = mm(number);
        row.cell(number, [bore_mm; 2], WALL_MM, &|at| Contour::bore(at, 0.5 * bore_mm));
    }
    let (wide, high) = (frame.fork.fork_bar_height_mm, frame.fork.fork_bar_depth_mm);
    for tenths in WINDOWS_TENTHS {
        let size = [wide + mm(tenths), high + mm(tenths)];
        row.cell(tenths, size, WALL_MM, &|at| Contour::rounded_rectangle(at, size, frame.knee.knee_window_round_mm));
    }
    for thickness_tenths in tongues(frame) {
        row.tongue(thickness_tenths, mm(thickness_tenths));
    }
    row.feature()
}

/// Thicknesses of the tongues, tenths of a millimetre: none is thinner than a web may be.
pub(super) fn tongues(frame: &Frame) -> Vec<i32> {
    let least = known(HINGE).map_or(0, |web| tenths(web.min));
    let all = THINNER_TENTHS.map(|thinner| tenths(frame.corner.corner_hinge_thickness_mm) - thinner);
    all.into_iter().filter(|thickness| *thickness >= least).collect()
}

/// The bar of the fork, with a plug of the hub joint at its end.
pub(super) fn bar(frame: &Frame) -> Feature {
    let (wide, high) = (frame.fork.fork_bar_height_mm, frame.fork.fork_bar_depth_mm);
    let section = Contour::rounded_rectangle([0.0, 0.0], [wide, high], frame.fork.fork_bar_round_mm);
    let long = Feature::extrude(Profile::new(section), DEPTH_MM + 3.0);
    let radius_mm = 0.5 * frame.hub_joint.hub_joint_diameter_mm;
    let plug = Feature::cylinder(radius_mm, BOSS_DEPTH_MM).at(0.0, 0.0, 0.5 - BOSS_DEPTH_MM);
    // Both lie on the bed: the bar is sunk to the plug's lowest line.
    let sunk = long.at(0.0, 0.5 * high - radius_mm - LIFT_MM, 0.0);
    Feature::union([sunk, plug]).turned_x(Angle::deg(90.0)).at(0.0, 0.0, radius_mm + LIFT_MM)
}

/// The rigid piece: bosses for the plug, as in the hub.
pub(super) fn rigid(frame: &Frame) -> Feature {
    let mut row = Row::new(BOSS_DEPTH_MM);
    for tenths in BOSSES_TENTHS {
        let bore_mm = frame.hub_joint.hub_joint_diameter_mm + mm(tenths);
        row.cell(tenths, [bore_mm; 2], BOSS_WALL_MM, &|at| Contour::bore(at, 0.5 * bore_mm));
    }
    row.feature()
}
