//! A frame's stiffness over that of another of the same material, and how far the guesses of the mechanics move that ratio.
//!
//! The modulus cancels but for the rods' share. The guesses are moved together: each to half or to twice its value within its
//! bounds, in the eight rows of Plackett and Burman's design for seven factors (Biometrika 33 (1946) 305), and in the eight
//! with all signs turned, so that no effect of two guesses together hides that of one. The band is that of the seventeen
//! ratios, the one at the guesses themselves included.
//!
//! *When it is wrong:* the band is no interval of confidence: it holds the guesses and not what the model lacks.

use rayon::prelude::*;

use super::static_curve::{CurveError, StaticCurve};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::parts::parts_plan::part_models;
use crate::mechanics::settings::MechanicsSettings;

/// A ratio.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Ratio {
    /// At this displacement, mm; 0 for the stiffness at rest.
    pub displacement_mm: f64,
    /// The ratio with the guesses as they are.
    pub ratio: f64,
    /// Least and most over the design.
    pub band: [f64; 2],
}

/// Displacements of the secants, mm; 0 is the stiffness at rest.
const SECANTS_MM: [f64; 5] = [0.0, 4.0, 8.0, 12.0, 16.0];

/// First row of the design; the next seven are it moved along, and all minus.
const ROW: [bool; 7] = [true, true, true, false, true, false, false];

/// Half or twice a guess.
const AWAY: f64 = 2.0;

/// The settings of the design, the guesses themselves first.
fn design_of(settings: &MechanicsSettings) -> Vec<MechanicsSettings> {
    let row = |at: usize, turned: bool| {
        let high = |factor: usize| at < 7 && ROW[(factor + 7 - at) % 7];
        (0..7).map(|factor| high(factor) != turned).collect::<Vec<bool>>()
    };
    let rows = [false, true].into_iter().flat_map(|turned| (0..8).map(move |at| row(at, turned)));
    std::iter::once(settings.clone())
        .chain(rows.map(|row| settings.with_guesses(|at, guess| if row[at] { guess * AWAY } else { guess / AWAY })))
        .collect()
}

/// Stiffness at the displacements.
fn stiffnesses(design: &Design, masses: &MassTable, settings: &MechanicsSettings) -> Result<Vec<Option<f64>>, CurveError> {
    let parts = part_models(design, settings)?;
    let model = FrameModel::of_parts(design, &parts, masses, settings, Extent::Quarter)?;
    let curve = StaticCurve::new(&model, SECANTS_MM[4], &[])?;
    Ok(SECANTS_MM.iter().map(|x| if *x == 0.0 { Some(curve.initial_n_mm()) } else { curve.secant_n_mm(*x) }).collect())
}

/// Ratios of a frame to a reference, displacement by displacement; one that either frame does not reach is left out.
///
/// # Errors
/// When one of them has no model or no equilibrium somewhere in the design.
pub fn ratios(
    frame: (&Design, &MassTable),
    reference: (&Design, &MassTable),
    settings: &MechanicsSettings,
) -> Result<Vec<Ratio>, CurveError> {
    let of = |settings: &MechanicsSettings| -> Result<Vec<Option<f64>>, CurveError> {
        let own = stiffnesses(frame.0, frame.1, settings)?;
        let other = stiffnesses(reference.0, reference.1, settings)?;
        Ok(own.into_iter().zip(other).map(|(own, other)| Some(own? / other?)).collect())
    };
    let all = design_of(settings).par_iter().map(of).collect::<Result<Vec<_>, _>>()?;
    let reported = |(at, displacement_mm): (usize, &f64)| {
        let values = all.iter().map(|row| row[at]).collect::<Option<Vec<f64>>>()?;
        let band = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)]);
        Some(Ratio { displacement_mm: *displacement_mm, ratio: values[0], band })
    };
    Ok(SECANTS_MM.iter().enumerate().filter_map(reported).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_the_design_moves_each_guess_as_often_up_as_down_and_pairs_alike() {
        let settings = MechanicsSettings::load(None).expect("the program's own numbers are sound");
        let design = design_of(&settings);
        assert_eq!(design.len(), 17);
        let sign = |row: &MechanicsSettings, at: usize| {
            let (mut own, mut guess) = (0.0, 0.0);
            let _ = row.with_guesses(|i, value| {
                if i == at {
                    own = value;
                }
                value
            });
            let _ = settings.with_guesses(|i, value| {
                if i == at {
                    guess = value;
                }
                value
            });
            if own > guess { 1 } else { -1 }
        };
        for a in 0..7 {
            assert_eq!(design[1..].iter().map(|row| sign(row, a)).sum::<i32>(), 0, "{a}");
            for b in 0..a {
                assert_eq!(design[1..].iter().map(|row| sign(row, a) * sign(row, b)).sum::<i32>(), 0, "{a} {b}");
            }
        }
    }
}
