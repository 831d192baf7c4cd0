//! Hinges to be folded until they crack: a socket of the frame's corners, solid, with a notch over a web.
//!
//! The piece lies along x as a corner's strut lies on the bed, its web below, so that the layers lie along the bend as
//! they do in the frame. The notch closes at the frame's largest fold: a piece that is folded until its faces touch is
//! folded as far as the frame's hinge, and no further.

use super::label::two_digits;
use crate::frame::fold;
use crate::frame::skeleton::{Closure, ClosureError, strut_fold_deg};
use crate::params::Frame;
use crate::solid::{Contour, Feature, Profile};
use crate::units::Angle;

/// How often each hinge is folded.
pub const FOLDS: u32 = 100;

/// Thickness of the webs over the frame's own: the thinner one is strained by two thirds more, the thicker one by a quarter less.
const OVER_OWN: [f64; 3] = [0.6, 1.0, 1.3];
/// What a notch takes at least from a socket, mm: else there is no hinge.
const LEAST_NOTCH_MM: f64 = 0.6;
/// By how much the thicker web is thicker at least, mm.
const LEAST_THICKER_MM: f64 = 0.2;
/// How much further a piece folds than the frame at least, degrees: a frame whose own hinge held keeps a limit of rounded figures.
const LEAST_FURTHER_DEG: f64 = 0.2;
/// From the notch's mouth to the end of the piece, mm: what two fingers hold.
const GRIP_MM: f64 = 8.0;
/// Length and half of the width of the tag that carries the number, mm.
const TAG_MM: [f64; 2] = [5.0, 2.4];
/// Height of the tag, mm: two layers.
const TAG_HEIGHT_MM: f64 = 0.4;
/// How far the tag's underside lies over the lowest line of the round piece, so that the line does not lie in it, mm.
const LIFT_MM: f64 = 0.02;

/// Hinges of a frame's section, and how far they are folded.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinges {
    /// Thickness of each web, mm; the second is the frame's own.
    pub thicknesses_mm: [f64; 3],
    /// Fold at which a piece's notch closes, whole degrees, a little beyond the frame's largest.
    pub fold_deg: f64,
    /// Outer radius of the sockets, mm.
    radius_mm: f64,
}

impl Hinges {
    /// The hinges of a frame.
    ///
    /// # Errors
    /// When the frame does not close, so that nothing says how far its hinges fold.
    pub fn of(frame: &Frame) -> Result<Self, ClosureError> {
        let closure = Closure::solve(frame)?;
        let (own_mm, radius_mm) = (frame.corner.corner_hinge_thickness_mm, closure.corner_radius_mm);
        let [thinner, own, thicker] = OVER_OWN.map(|share| share * own_mm);
        let thicker = thicker.min(2.0 * radius_mm - LEAST_NOTCH_MM).max(own_mm + LEAST_THICKER_MM);
        let largest_deg = strut_fold_deg(closure.strut_tilt.to_deg());
        Ok(Self {
            thicknesses_mm: [in_tenths(thinner), own, in_tenths(thicker)],
            fold_deg: (largest_deg + LEAST_FURTHER_DEG).ceil(),
            radius_mm,
        })
    }

    /// The number that stands on a piece: its web's thickness, tenths of a millimetre.
    pub fn number(thickness_mm: f64) -> u32 {
        (10.0 * thickness_mm).round() as u32
    }

    /// Strain of each web at the fold, %, by the formula of the rule `hinge_strain`.
    pub fn strains_percent(&self, frame: &Frame) -> [f64; 3] {
        self.thicknesses_mm.map(|thickness_mm| fold::web_strain_percent(frame, thickness_mm, Angle::deg(self.fold_deg)))
    }

    /// A piece.
    pub(super) fn feature(&self, thickness_mm: f64) -> Feature {
        let r = self.radius_mm;
        let lean = Angle::deg(0.5 * self.fold_deg).tan();
        let end = (2.0 * r - self.thicknesses_mm[0]) * lean + GRIP_MM;
        let rod = Feature::cylinder_between([-end, 0.0, r].into(), [end, 0.0, r].into(), r);
        // Past the piece on every side.
        let high = 2.0 * r + 1.0 - thickness_mm;
        let outline = Contour::polygon(&[[0.0, thickness_mm], [high * lean, thickness_mm + high], [-high * lean, thickness_mm + high]]);
        let notch = Feature::extrude(Profile::new(outline), 2.0 * r + 2.0).turned_x(Angle::deg(90.0)).at(0.0, r + 1.0, 0.0);
        let [long, half] = TAG_MM;
        let tag = Feature::cuboid_between([end - 0.5, -half, LIFT_MM], [end + long, half, TAG_HEIGHT_MM]);
        let digits = two_digits(Self::number(thickness_mm), [end + 0.5 * long, 0.0], TAG_HEIGHT_MM);
        Feature::union([rod.minus([notch]), tag].into_iter().chain(digits))
    }
}

fn in_tenths(mm: f64) -> f64 {
    (10.0 * mm).round() / 10.0
}
