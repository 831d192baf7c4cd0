//! Strain of a folded hinge and the moment that holds it.
//!
//! **Webs** turn by θ about the crossing of the rods' axes; the web of thickness t lies on one side of it, from the
//! socket's radius r inwards. A fibre at the distance y is stretched by y θ over the length 2 t (45° to both sides from
//! the notch's apex): ε = y θ / (2 t), most at y = r. The moment is the sum over the web's cut, a part of a disc:
//! M = E θ / (2 t) ∫ 2 y² √(r² − y²) dy from r − t to r.
//!
//! **Necks** twist: shear c t θ / L and moment G K θ / L of each, for a solid rectangle (Roark's Formulas for Stress and
//! Strain, Table 10.1, case 4), L half of the scallop's chord; the principal stretch is γ/2 + √(1 + γ²/4). G = E / 3.
//!
//! Small-strain formulas beyond small strains, and a modulus that falls with strain and time: the moments are what the
//! first fold takes at most, not what is left after an hour.

use serde::Serialize;

use crate::frame::skeleton::{Closure, ClosureError, CornerPivots, strut_fold_deg};
use crate::params::Frame;
use crate::units::Angle;

/// A hinge at a fold.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HingeLoad {
    /// Length that takes the strain, mm.
    pub length_mm: f64,
    /// Largest strain, %.
    pub strain_percent: f64,
    /// Moment that holds the fold, N mm; none without a modulus.
    pub moment_n_mm: Option<f64>,
}

/// A corner's web at a fold.
pub fn web(frame: &Frame, fold: Angle) -> HingeLoad {
    let (radius, thickness) = (CornerPivots::of(frame).radius_mm, frame.corner.corner_hinge_thickness_mm);
    let length_mm = 2.0 * thickness;
    let strain_percent = web_strain_percent(frame, thickness, fold);
    let moment = |modulus: f64| modulus * fold.to_rad() / length_mm * second_moment(radius, radius - thickness);
    HingeLoad { length_mm, strain_percent, moment_n_mm: frame.flexible.material.tensile_modulus_mpa.map(moment) }
}

/// Largest strain of a web of some thickness under the sockets of a frame's corners, %.
pub fn web_strain_percent(frame: &Frame, thickness_mm: f64, fold: Angle) -> f64 {
    100.0 * CornerPivots::of(frame).radius_mm * fold.to_rad() / (2.0 * thickness_mm)
}

/// Largest strain of a frame's webs, %: that of the struts' at the fold of the assembled frame.
///
/// # Errors
/// When the frame does not close, so that nothing says how far they fold.
pub fn largest_web_strain_percent(frame: &Frame) -> Result<f64, ClosureError> {
    let strut = Angle::deg(strut_fold_deg(Closure::solve(frame)?.strut_tilt.to_deg()));
    Ok(web(frame, strut).strain_percent)
}

/// ∫ 2 y² √(r² − y²) dy from a height to r, mm⁴.
fn second_moment(r: f64, from: f64) -> f64 {
    let upto = |y: f64| {
        let root = libm::sqrt((r * r - y * y).max(0.0));
        0.25 * (libm::pow(r, 4.0) * libm::asin((y / r).clamp(-1.0, 1.0)) - y * root * (r * r - 2.0 * y * y))
    };
    upto(r) - upto(from)
}

/// The hub joint's two necks at a twist.
pub fn necks(frame: &Frame, fold: Angle) -> HingeLoad {
    let joint = &frame.hub_joint;
    let chord = 0.5 * joint.arm_pitch_mm - joint.hub_joint_diameter_mm;
    let length_mm = 0.5 * chord;
    let (thickness, width) = (joint.neck_thickness_mm, joint.arch_width_mm);
    let shear = torsion_factor(thickness, width) * thickness * fold.to_rad() / length_mm;
    let stretch = 0.5 * shear + libm::sqrt(1.0 + 0.25 * shear * shear);
    let moment = |modulus: f64| 2.0 * modulus / 3.0 * torsion_constant(thickness, width) * fold.to_rad() / length_mm;
    let moment_n_mm = frame.flexible.material.tensile_modulus_mpa.map(moment);
    HingeLoad { length_mm, strain_percent: 100.0 * (stretch - 1.0), moment_n_mm }
}

/// Stiffness of a twisted rectangular bar over shear modulus and length, mm⁴.
fn torsion_constant(thickness_mm: f64, width_mm: f64) -> f64 {
    let (a, b) = (0.5 * thickness_mm.max(width_mm), 0.5 * thickness_mm.min(width_mm));
    let q = b / a;
    a * libm::pow(b, 3.0) * (16.0 / 3.0 - 3.36 * q * (1.0 - libm::pow(q, 4.0) / 12.0))
}

/// Largest shear of a twisted rectangular bar over thickness and twist per length.
fn torsion_factor(thickness_mm: f64, width_mm: f64) -> f64 {
    let q = thickness_mm.min(width_mm) / thickness_mm.max(width_mm);
    let stiffness = 16.0 / 3.0 - 3.36 * q * (1.0 - libm::pow(q, 4.0) / 12.0);
    let stress = 0.375 * (1.0 + q * (0.6095 + q * (0.8865 + q * (-1.8023 + q * 0.91))));
    0.5 * stiffness * stress
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_torsion_of_a_square_bar() {
        // Timoshenko: largest stress T / (0.208 a^3), stiffness 0.1406 a^4: 0.1406 / 0.208 = 0.676.
        assert!((torsion_factor(1.0, 1.0) - 0.676).abs() < 0.01, "{}", torsion_factor(1.0, 1.0));
        assert!((torsion_constant(1.0, 1.0) - 0.1406).abs() < 0.001, "{}", torsion_constant(1.0, 1.0));
    }

    #[test]
    fn analytic_a_half_disc_has_an_eighth_of_pi_r4() {
        assert!((second_moment(2.0, 0.0) - 2.0 * std::f64::consts::PI).abs() < 1e-12);
    }
}
