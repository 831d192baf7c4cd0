//! A frame in a few numbers for a model of one coordinate: its static curve, the mode that swings against the centre, its loss.
//!
//! Two masses stand for the frame's symmetric modes: the centre's share on the frame's spring, and one that rides on it. Share μ
//! and frequency f of the rider are those with which the two masses have the frequencies of the bounce and of the next mode
//! that moves most mass, and the ratio of their effective masses: with S and P sum and product of the squares of both circular
//! frequencies, the squares of the base's own and the rider's are the roots of z² - S (1 - μ) z + P (1 - μ). The spring is the base's own:
//! the whole mass times the smaller root. That of slow pressing is a third softer, as it goes with the part of the mass that the bounce
//! moves; only the shape of the curve is taken from it.
//!
//! *When it is wrong:* the curve is that of slow pressing, the modes are those about rest; more than two modes take part in
//! an impact, and both change with the compression. From 1 m the peaks of eight frames lie from 24 % below to 13 % above those of the beam model,
//! that of the default frame 15 % below.

use super::static_curve::StaticCurve;
use crate::mechanics::model::frame_model::FrameModel;
use crate::mechanics::model::model_error::ModelError;
use crate::mechanics::settings::MechanicsSettings;
use crate::mechanics::solve::modes::{Mode, Modes};

/// The numbers.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Reduction {
    /// Stiffness at rest, in an impact, N/mm: that with which the whole mass has the frequencies of the frame's modes.
    pub stiffness_n_mm: f64,
    /// Displacement, mm, and static force over the static stiffness at rest, mm.
    pub curve_mm: Vec<[f64; 2]>,
    /// Rider: share of the mass, and its frequency on a frame that is held, Hz, in an impact.
    pub rider: Option<[f64; 2]>,
    /// Damping of the bounce, N s/m: the material's loss at its frequency.
    pub damping_n_s_m: f64,
}

/// Time of an impact at which the modulus is taken, ms.
const IMPACT_MS: f64 = 4.0;
/// Symmetric modes that are looked at.
const MODES: usize = 6;
/// Largest share of a rider. The damper acts on what the rider rides on, from first touch on, and brakes that alone: with riders of half of the
/// mass the peaks from 1 m were three to four times those of the beam model. Such a frame is one mass.
const MOST_RIDES: f64 = 0.2;

impl Reduction {
    /// Of a quarter of a frame, its curve and the mass of the whole frame, kg.
    ///
    /// # Errors
    /// When the quarter has no modes.
    pub fn of(quarter: &FrameModel, curve: &StaticCurve, mass_kg: f64, settings: &MechanicsSettings) -> Result<Self, ModelError> {
        let modes = Modes::new(quarter, MODES)?.modes;
        let relaxation = settings.relaxation();
        let gain = relaxation.modulus(IMPACT_MS);
        let rest = curve.initial_n_mm();
        // The first point is the one that the stiffness at rest is from: on the line by definition.
        let steps = curve.points.iter().filter(|point| point.displacement_mm == 0.0 || point.displacement_mm > 0.5);
        let curve_mm = steps.map(|point| [point.displacement_mm, point.force_n / rest]).collect();
        let bounce = modes.iter().max_by(|a, b| a.share_up.total_cmp(&b.share_up));
        let bounce_hz = bounce.map_or(0.0, |mode| mode.frequency_hz) * gain.sqrt();
        let loss = relaxation.loss_factor(bounce_hz * 1e-3);
        let rider = bounce.and_then(|bounce| TwoMasses::of(bounce, &modes));
        let base_hz = rider.map_or(bounce_hz, |masses| masses.base_hz * gain.sqrt());
        let stiffness_n_mm = mass_kg * (std::f64::consts::TAU * base_hz).powi(2) * 1e-3;
        let damping_n_s_m = if bounce_hz > 0.0 { loss * stiffness_n_mm * 1e3 / (std::f64::consts::TAU * bounce_hz) } else { 0.0 };
        let rider = rider.map(|masses| [masses.share, masses.rider_hz * gain.sqrt()]);
        Ok(Self { stiffness_n_mm, curve_mm, rider, damping_n_s_m })
    }
}

/// A mass on a spring, and one that rides on it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct TwoMasses {
    /// The rider's share of the whole mass.
    share: f64,
    /// Its frequency while the other is held, Hz.
    rider_hz: f64,
    /// Frequency of the whole mass on the spring, Hz.
    base_hz: f64,
}

impl TwoMasses {
    /// Of the bounce and the next mode; none when no mode above the bounce moves mass.
    fn of(bounce: &Mode, modes: &[Mode]) -> Option<Self> {
        let above = modes.iter().filter(|mode| mode.frequency_hz > bounce.frequency_hz);
        let second = above.max_by(|a, b| a.share_up.total_cmp(&b.share_up)).filter(|mode| mode.share_up > 1e-6)?;
        two_masses([bounce.frequency_hz, second.frequency_hz], second.share_up / (second.share_up + bounce.share_up))
    }
}

/// The two masses that give two frequencies and the second's part of the effective mass.
fn two_masses(f_hz: [f64; 2], second: f64) -> Option<TwoMasses> {
    let squares = f_hz.map(|f| f * f);
    let (sum, product) = (squares[0] + squares[1], squares[0] * squares[1]);
    let own = |share: f64| {
        let left = 1.0 - share;
        let root = (sum * sum * left * left - 4.0 * product * left).max(0.0).sqrt();
        0.5 * (sum * left + root)
    };
    // Effective mass of the second mode: the rider moves β times as far as what it rides on.
    let part = |share: f64| {
        let beta = own(share) / (own(share) - squares[1]);
        let moved = 1.0 - share + share * beta;
        moved * moved / (1.0 - share + share * beta * beta)
    };
    let (mut low, mut high) = (1e-6, MOST_RIDES.min(1.0 - 4.0 * product / (sum * sum)));
    if high <= low || part(high) < second || part(low) > second {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if part(middle) < second { low = middle } else { high = middle }
    }
    let own = own(low);
    Some(TwoMasses { share: low, rider_hz: own.sqrt(), base_hz: (product * (1.0 - low) / own).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_two_masses_are_found_again() {
        // Base 1 - μ on K, rider μ: frequencies of [[K + μ w, -μ w], [-w, w]] by its characteristic polynomial.
        for (share, base, own) in [(0.1, 1800.0, 14_000.0), (0.18, 1700.0, 20_000.0), (0.02, 1500.0, 90_000.0)] {
            let left = 1.0 - share;
            let (sum, product) = (base / left + own / left, base / left * own);
            let root = f64::sqrt(sum * sum - 4.0 * product);
            let squares = [0.5 * (sum - root), 0.5 * (sum + root)];
            let beta = own / (own - squares[1]);
            let moved = left + share * beta;
            let part = moved * moved / (left + share * beta * beta);
            let found = two_masses(squares.map(f64::sqrt), part).expect("has two masses");
            let [f, on_spring] = [found.rider_hz, found.base_hz].map(|f| f * f);
            assert!((found.share / share - 1.0).abs() < 1e-6 && (f / own - 1.0).abs() < 1e-6, "{share}: {found:?}");
            assert!((on_spring / base - 1.0).abs() < 1e-6, "{share}: {found:?}");
        }
        // No rider of less than a fifth of the mass takes half of it into the upper mode.
        assert_eq!(two_masses([40.0, 120.0], 0.5), None);
    }
}
