//! One number from a static test: the flexible material's modulus, and how well it is known.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::static_curve::{CurveError, MOST_DOWN_MM, StaticCurve};
use crate::frame::assembly::Design;
use crate::frame::assembly::mass::MassTable;
use crate::mechanics::model::frame_model::{Extent, FrameModel};
use crate::mechanics::parts::parts_plan::PartModel;
use crate::mechanics::settings::{MechanicsSettings, YOUNG_MPA};

/// A measured point: displacement, mm, force, N.
pub type Measured = [f64; 2];

/// What a test says.
#[derive(Clone, Debug)]
pub struct Calibration {
    /// Numbers with the modulus found, its band the interval.
    pub settings: MechanicsSettings,
    /// Interval of 95 % from the scatter of the points about the curve, MPa.
    pub interval_mpa: [f64; 2],
    /// Root mean square of force misfits, N, over the points that count.
    pub rms_n: f64,
    /// How many points count: those that are not at rest.
    pub points: usize,
    /// Curve at that modulus.
    pub curve: StaticCurve,
}

/// Why a test cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// Too few points.
    #[error("a calibration takes at least 3 different displacements above 0, there are {points}")]
    TooFew {
        /// How many.
        points: usize,
    },
    /// Displacements that no dynamometer shows.
    #[error("the largest displacement is {farthest_mm} mm, less than {LEAST_MM} mm: are displacements in mm?")]
    Small {
        /// The largest.
        farthest_mm: f64,
    },
    /// Displacements at which the arms are at the lower ring, or beyond the longest curve.
    #[error(
        "the test goes to {farthest_mm} mm and the model to {most_mm:.1} mm, where the arms are at the lower ring or the curve ends: leave out the rows beyond"
    )]
    Far {
        /// The largest.
        farthest_mm: f64,
        /// The model's end.
        most_mm: f64,
    },
    /// The model ends before the data.
    #[error("the model finds no equilibrium at {displacement_mm} mm, which was measured")]
    Short {
        /// Where.
        displacement_mm: f64,
    },
    /// The modulus left its bounds.
    #[error(
        "the points ask for a modulus of {young_mpa:.1} MPa, outside {} to {}: is the force in N, the displacement in mm?", YOUNG_MPA[0], YOUNG_MPA[1]
    )]
    Outside {
        /// The modulus.
        young_mpa: f64,
    },
    /// The modulus still moved.
    #[error("the modulus did not settle in {STEPS} steps: the last one still changed it by a factor of {ratio:.6}")]
    NotSettled {
        /// The last step's factor.
        ratio: f64,
    },
    /// No curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
}

/// Most steps of the modulus.
const STEPS: usize = 8;
/// A test that goes less far than this is one in metres, mm.
const LEAST_MM: f64 = 0.1;

/// Misfit of a curve to the points that it reaches, N: root mean square. `None` where it reaches none.
pub fn rms_n(curve: &StaticCurve, measured: &[Measured]) -> Option<f64> {
    let squares: Vec<f64> = measured.iter().filter_map(|[x, f]| curve.force_n(*x).map(|model| (model - f) * (model - f))).collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// The modulus with which the curve comes nearest to the points. Force goes with the modulus but for the rods' share, so that
/// a ratio is applied until it is one.
///
/// # Errors
/// When there are too few points, or the model cannot follow them.
pub fn calibrate(
    design: &Design,
    parts: &[PartModel],
    masses: &MassTable,
    settings: &MechanicsSettings,
    measured: &[Measured],
) -> Result<Calibration, CalibrationError> {
    // At rest every modulus has no force: such a point says nothing of it, and is none.
    let measured: Vec<Measured> = measured.iter().filter(|[x, _]| *x != 0.0).copied().collect();
    let measured = &measured[..];
    let mut displacements: Vec<f64> = measured.iter().map(|[x, _]| *x).filter(|x| *x > 0.0).collect();
    displacements.sort_by(f64::total_cmp);
    displacements.dedup();
    if displacements.len() < 3 {
        return Err(CalibrationError::TooFew { points: displacements.len() });
    }
    let farthest = displacements[displacements.len() - 1];
    if farthest < LEAST_MM {
        return Err(CalibrationError::Small { farthest_mm: farthest });
    }
    let most_mm = design.skeleton.closure.ring_half_height_mm.min(MOST_DOWN_MM);
    if farthest > most_mm {
        return Err(CalibrationError::Far { farthest_mm: farthest, most_mm });
    }
    let mut settings = settings.for_material(&design.frame.flexible.material);
    let mut ratio = 1.0;
    for _ in 0..STEPS {
        let model = FrameModel::of_parts(design, parts, masses, &settings, Extent::Quarter).map_err(CurveError::from)?;
        let curve = StaticCurve::new(&model, farthest, &[])?;
        let (mut cross, mut square) = (0.0, 0.0);
        for [x, f] in measured {
            let own = curve.force_n(*x).ok_or(CalibrationError::Short { displacement_mm: *x })?;
            cross += own * f;
            square += own * own;
        }
        ratio = cross / square;
        if (ratio - 1.0).abs() < 1e-5 {
            let rms_n = rms_n(&curve, measured).unwrap_or(f64::INFINITY);
            let freedom = (measured.len() - 1) as f64;
            let scatter = rms_n * (measured.len() as f64 / freedom).sqrt();
            // Infinite where there is no such distribution: no freedom is left.
            let student = StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |student| student.inverse_cdf(0.975));
            // Of the logarithm: a modulus is above zero, however much a test scatters.
            let share = student * scatter / square.sqrt();
            let interval_mpa = [-share, share].map(|share| settings.young_mpa * libm::exp(share));
            settings = settings.with_band(interval_mpa);
            settings.tensile_mpa = design.frame.flexible.material.tensile_modulus_mpa;
            return Ok(Calibration { settings, interval_mpa, rms_n, points: measured.len(), curve });
        }
        settings.young_mpa *= ratio;
        if !(YOUNG_MPA[0]..=YOUNG_MPA[1]).contains(&settings.young_mpa) {
            return Err(CalibrationError::Outside { young_mpa: settings.young_mpa });
        }
    }
    Err(CalibrationError::NotSettled { ratio })
}
