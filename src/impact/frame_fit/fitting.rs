//! The two numbers, from all heights and from some, and what these say of the heights that were left out.

use nalgebra::DVector;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::height::Height;
use super::response_surface::{Response, ResponseSurface, Subject};
use crate::impact::fit::{Minimum, NORMAL_97_5, inverse, minimise};
use crate::mechanics::result::impact::ImpactError;
use crate::mechanics::settings::MechanicsSettings;

/// A number that was found.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct MaterialEstimate {
    /// Its key in the file of numbers.
    pub key: &'static str,
    /// Its value.
    pub value: f64,
    /// 95 % interval, from the medians' standard errors or the misfit, whichever is larger; an effect that the model lacks is not in it.
    pub ci95: [f64; 2],
    /// Whether the search ended at its bound.
    pub at_bound: bool,
}

/// What numbers from some heights say of one.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Predicted {
    /// The heights that the numbers are from, m.
    pub from_m: Vec<f64>,
    /// The predicted height, m.
    pub height_m: f64,
    /// The modulus in an impact, over the law's, from those heights.
    pub impact_modulus: f64,
    /// The loss from those heights.
    pub impact_loss: f64,
    /// Peak, g.
    pub peak_axial_g: f64,
    /// Peak over the measured median, less one, %.
    pub peak_off_percent: f64,
    /// Impulse over the speed before.
    pub impulse_over_v0: f64,
}

/// A fit.
#[derive(Clone, Debug)]
pub struct FrameFit {
    /// The numbers from all heights.
    pub settings: MechanicsSettings,
    /// Both, with their intervals.
    pub estimates: [MaterialEstimate; 2],
    /// Each height by the numbers from all; not predictions.
    pub fitted: Vec<Predicted>,
    /// Each height by the numbers from all others; empty for one height.
    pub from_others: Vec<Predicted>,
    /// Each height by the numbers from each other one alone.
    pub from_one: Vec<Predicted>,
    /// Largest difference between the interpolated answers and the model at the numbers found, as a part of the peak.
    pub interpolation: f64,
}

/// Why nothing can be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FrameFitError {
    /// No height.
    #[error("no height has a drop with an impact and one without a flag")]
    NoHeight,
    /// The search failed.
    #[error("the search for the two numbers found none from {heights} heights")]
    NoMinimum {
        /// How many.
        heights: usize,
    },
    /// The model failed.
    #[error(transparent)]
    Impact(#[from] ImpactError),
}

/// Interpolation is good enough at this, as a part of the peak.
const GOOD: f64 = 3e-3;
/// Most corrections of the interpolation.
const ROUNDS: usize = 3;

/// The numbers with which the surface comes nearest to some of the heights.
fn search(surface: &ResponseSurface, heights: &[Height], used: &[usize]) -> Result<Minimum, FrameFitError> {
    let residual = |at: &[f64]| {
        let of = |height: &usize| {
            let (answered, measured) = (surface.at([at[0], at[1]], *height), &heights[*height]);
            let relative = measured.peak_axial_g.error / measured.peak_axial_g.value;
            [
                (libm::log(measured.peak_axial_g.value) - answered.ln_peak) / relative,
                (measured.impulse_over_v0.value - answered.impulse_over_v0) / measured.impulse_over_v0.error,
            ]
        };
        Some(DVector::from_iterator(2 * used.len(), used.iter().flat_map(of)))
    };
    let found =
        ResponseSurface::starts().into_iter().filter_map(|start| minimise(residual, &start, &ResponseSurface::bounds(), &[1e-4, 1e-4], 60));
    found.min_by(|a, b| a.sum.total_cmp(&b.sum)).ok_or(FrameFitError::NoMinimum { heights: used.len() })
}

fn place(minimum: &Minimum) -> [f64; 2] {
    [minimum.at[0], minimum.at[1]]
}

/// Both numbers of a minimum with their intervals.
fn estimates(minimum: &Minimum) -> [MaterialEstimate; 2] {
    let freedom = minimum.residual.len() - minimum.at.len();
    let (scale, factor) = match freedom {
        0 => (1.0, NORMAL_97_5),
        _ => {
            let student = StudentsT::new(0.0, 1.0, freedom as f64).map_or(NORMAL_97_5, |student| student.inverse_cdf(0.975));
            ((minimum.sum / freedom as f64).max(1.0), student)
        }
    };
    let covariance = inverse(&(minimum.jacobian.transpose() * &minimum.jacobian));
    let [bounds_m, bounds_l] = ResponseSurface::bounds();
    let interval = |i: usize, [low, high]: [f64; 2]| {
        let half = covariance.as_ref().map_or(f64::INFINITY, |c| factor * (scale * c[(i, i)]).sqrt());
        [(minimum.at[i] - half).max(low), (minimum.at[i] + half).min(high)]
    };
    let square = |x: f64| x * x;
    let [u, s] = place(minimum);
    [
        MaterialEstimate {
            key: "impact_modulus",
            value: libm::exp(u),
            ci95: interval(0, bounds_m).map(libm::exp),
            at_bound: minimum.at_bound[0],
        },
        MaterialEstimate { key: "impact_loss", value: square(s), ci95: interval(1, bounds_l).map(square), at_bound: minimum.at_bound[1] },
    ]
}

/// What the model itself, not its surface, says of heights at places.
fn predicted(subject: &Subject, heights: &[Height], asked: &[(Vec<usize>, [f64; 2], usize)]) -> Result<Vec<Predicted>, FrameFitError> {
    let answered: Vec<Response> =
        asked.par_iter().map(|(_, at, height)| subject.run(*at, heights[*height].logged())).collect::<Result<_, _>>()?;
    let row = |((from, at, height), answered): (&(Vec<usize>, [f64; 2], usize), Response)| {
        let (numbers, peak_axial_g) = (subject.numbers(*at), libm::exp(answered.ln_peak));
        Predicted {
            from_m: from.iter().map(|height| heights[*height].height_m).collect(),
            height_m: heights[*height].height_m,
            impact_modulus: numbers.impact_modulus,
            impact_loss: numbers.impact_loss,
            peak_axial_g,
            peak_off_percent: 100.0 * (peak_axial_g / heights[*height].peak_axial_g.value - 1.0),
            impulse_over_v0: answered.impulse_over_v0,
        }
    };
    Ok(asked.iter().zip(answered).map(row).collect())
}

/// Fits the two numbers, with the model's answers for the same heights in the same order.
///
/// # Errors
/// When there is no height, or the model's motion is lost.
pub fn fit(subject: &Subject, mut surface: ResponseSurface, heights: &[Height]) -> Result<FrameFit, FrameFitError> {
    if heights.is_empty() {
        return Err(FrameFitError::NoHeight);
    }
    let every: Vec<usize> = (0..heights.len()).collect();
    let mut best = search(&surface, heights, &every)?;
    let mut interpolation = f64::INFINITY;
    for _ in 0..ROUNDS {
        interpolation = surface.correct(subject, place(&best))?;
        best = search(&surface, heights, &every)?;
        if interpolation < GOOD {
            break;
        }
    }
    let without = |height: usize| -> Vec<usize> { every.iter().copied().filter(|other| *other != height).collect() };
    let mut from_others = Vec::new();
    let mut from_one = Vec::new();
    if heights.len() > 1 {
        for height in every.iter().copied() {
            let others = without(height);
            from_others.push((others.clone(), place(&search(&surface, heights, &others)?), height));
            let alone = place(&search(&surface, heights, &[height])?);
            from_one.extend(others.into_iter().map(|other| (vec![height], alone, other)));
        }
    }
    let all: Vec<_> = every.iter().map(|height| (every.clone(), place(&best), *height)).collect();
    Ok(FrameFit {
        settings: subject.numbers(place(&best)),
        estimates: estimates(&best),
        fitted: predicted(subject, heights, &all)?,
        from_others: predicted(subject, heights, &from_others)?,
        from_one: predicted(subject, heights, &from_one)?,
        interpolation,
    })
}
