//! What folded hinges say of the strain that a hinge may have: the largest that held, below the least that broke.
//!
//! One sample of each strain, folded in one direction of the layers, by hand, on one day. It says nothing of scatter, of
//! creep over weeks, or of cold. What it replaces is a factor without any source.

use super::hinges::{FOLDS, Hinges};
use crate::frame::fold;
use crate::params::Frame;
use crate::params::lookup::lookup;
use crate::units::Angle;

/// The key that it sets.
pub const KEY: &str = "limits.hinge_strain_factor";

/// How far a thickness in a table may differ from the piece's, mm: less than a digit of what stands on it.
const SAME_MM: f64 = 0.051;

/// A hinge that was folded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldedHinge {
    /// Thickness of its web, mm.
    pub thickness_mm: f64,
    /// How far it was folded, degrees.
    pub fold_deg: f64,
    /// After how many folds it cracked; nothing where it held [`FOLDS`].
    pub cracked_after: Option<u32>,
}

/// A hinge with its strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainedHinge {
    /// What was done to it.
    pub folded: FoldedHinge,
    /// Strain at that fold, %.
    pub strain_percent: f64,
}

/// The limit that follows.
#[derive(Clone, Debug, PartialEq)]
pub struct HingeLimit {
    /// Every hinge, in the order of the table.
    pub hinges: Vec<StrainedHinge>,
    /// The most strained one that held.
    pub held: StrainedHinge,
    /// The least strained one that cracked; nothing where all held, and the true limit is higher.
    pub cracked: Option<StrainedHinge>,
    /// The material's elongation at break, %.
    pub elongation_percent: f64,
    /// What divides it into the strain that held, rounded up to thousandths.
    pub factor: f64,
}

/// A table from which no limit follows.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FoldingError {
    /// No row says anything.
    #[error("no hinge was folded: write into the column `folds` after how many folds each cracked, or `held` where it held {FOLDS}")]
    NothingFolded,
    /// Not a piece of this coupon.
    #[error(
        "the coupon of this frame has no hinge of {thickness_mm} mm, it has {}: give the frame that the coupon was made for",
        .has.map(|mm| format!("{mm:.1}")).join(", ")
    )]
    NotThere {
        /// What was folded, mm.
        thickness_mm: f64,
        /// What there is, mm.
        has: [f64; 3],
    },
    /// What is strained less cracked, what is strained more held.
    #[error(
        "{:.1} mm cracked after {} folds at {:.0} %, but {:.1} mm held at {:.0} %: were two pieces mixed up, or has one a flaw of the print? Print and fold both again",
        .cracked.folded.thickness_mm, .cracked.folded.cracked_after.unwrap_or_default(), .cracked.strain_percent, .held.folded.thickness_mm, .held.strain_percent
    )]
    Contrary {
        /// What cracked.
        cracked: StrainedHinge,
        /// What held.
        held: StrainedHinge,
    },
    /// Nothing held.
    #[error(
        "every hinge cracked, {:.1} mm at {:.0} % as well: raise corner.corner_hinge_thickness_mm or choose another flexible material, and fold a coupon of that frame",
        .least.folded.thickness_mm, .least.strain_percent
    )]
    NoneHeld {
        /// The least strained one.
        least: StrainedHinge,
    },
    /// The factor divides what the material does not state.
    #[error("{KEY} divides elongation_at_break_percent, which the material {material} does not state: state it with its source")]
    NoElongation {
        /// The material.
        material: String,
    },
    /// What follows is no factor.
    #[error(
        "{strain_percent:.0} % held, and {elongation_percent:.0} % is the elongation at break of {material}: {KEY} would be {factor:.3}, beyond its {min} to {max}. State the elongation of your own filament"
    )]
    Beyond {
        /// What held, %.
        strain_percent: f64,
        /// The material.
        material: String,
        /// Its elongation, %.
        elongation_percent: f64,
        /// What would follow.
        factor: f64,
        /// Least.
        min: f64,
        /// Most.
        max: f64,
    },
}

impl HingeLimit {
    /// The limit that folded hinges of a frame's coupon ask for.
    ///
    /// # Errors
    /// [`FoldingError`] with the place in the list of what it is about, where it is about one.
    pub fn of(frame: &Frame, hinges: &Hinges, folded: &[FoldedHinge]) -> Result<Self, (Option<usize>, FoldingError)> {
        let mut strained = Vec::new();
        for (at, one) in folded.iter().enumerate() {
            strained.push(placed(frame, hinges, one).map_err(|error| (Some(at), error))?);
        }
        let by_strain = |a: &&StrainedHinge, b: &&StrainedHinge| a.strain_percent.total_cmp(&b.strain_percent);
        let least = *strained.iter().min_by(by_strain).ok_or((None, FoldingError::NothingFolded))?;
        let held = strained.iter().filter(|one| one.folded.cracked_after.is_none()).max_by(by_strain).copied();
        let cracked = strained.iter().filter(|one| one.folded.cracked_after.is_some()).min_by(by_strain).copied();
        let held = held.ok_or((None, FoldingError::NoneHeld { least }))?;
        if let Some(cracked) = cracked.filter(|cracked| cracked.strain_percent <= held.strain_percent) {
            let at = strained.iter().position(|one| *one == cracked);
            return Err((at, FoldingError::Contrary { cracked, held }));
        }
        let (elongation_percent, factor) = factor(frame, held.strain_percent).map_err(|error| (None, error))?;
        Ok(Self { hinges: strained, held, cracked, elongation_percent, factor })
    }
}

fn placed(frame: &Frame, hinges: &Hinges, folded: &FoldedHinge) -> Result<StrainedHinge, FoldingError> {
    let has = hinges.thicknesses_mm;
    let piece = has.into_iter().find(|mm| (mm - folded.thickness_mm).abs() < SAME_MM);
    let thickness_mm = piece.ok_or(FoldingError::NotThere { thickness_mm: folded.thickness_mm, has })?;
    let strain_percent = fold::web_strain_percent(frame, thickness_mm, Angle::deg(folded.fold_deg));
    Ok(StrainedHinge { folded: FoldedHinge { thickness_mm, ..*folded }, strain_percent })
}

/// The material's elongation at break, %, and what divides it into a strain.
fn factor(frame: &Frame, strain_percent: f64) -> Result<(f64, f64), FoldingError> {
    let material = frame.flexible.name.clone();
    let Some(elongation_percent) = frame.flexible.material.elongation_at_break_percent else {
        return Err(FoldingError::NoElongation { material });
    };
    // Up, so that what is allowed is not more than what held.
    let factor = (1e3 * elongation_percent / strain_percent).ceil() / 1e3;
    match lookup(KEY) {
        Ok(known) if !(known.min..=known.max).contains(&factor) => {
            Err(FoldingError::Beyond { strain_percent, material, elongation_percent, factor, min: known.min, max: known.max })
        }
        _ => Ok((elongation_percent, factor)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::skeleton::{Closure, strut_fold_deg};
    use crate::params::FrameFile;

    fn frame() -> Frame {
        Frame::resolve(&FrameFile::load("cognifly").expect("is a preset")).expect("resolves")
    }

    /// The limit of pieces with what became of each, at the coupon's own fold.
    fn limit(frame: &Frame, of: &[(f64, Option<u32>)]) -> Result<HingeLimit, (Option<usize>, FoldingError)> {
        let hinges = Hinges::of(frame).expect("closes");
        let folded = |(thickness_mm, cracked_after): &(f64, Option<u32>)| FoldedHinge {
            thickness_mm: *thickness_mm,
            fold_deg: hinges.fold_deg,
            cracked_after: *cracked_after,
        };
        HingeLimit::of(frame, &hinges, &of.iter().map(folded).collect::<Vec<_>>())
    }

    #[test]
    fn analytic_the_largest_strain_that_held_is_allowed() {
        let frame = frame();
        let found = limit(&frame, &[(1.7, Some(23)), (2.9, None), (3.8, None)]).expect("a limit");
        // r = 2.9 mm and t = 2.9 mm: half of 114 degrees.
        assert!((found.held.strain_percent - 50.0 * 114f64.to_radians()).abs() < 1e-9, "{found:?}");
        assert!((found.cracked.expect("one").strain_percent - 50.0 * 2.9 / 1.7 * 114f64.to_radians()).abs() < 1e-9, "{found:?}");
        let allowed = 580.0 / found.factor;
        assert!(allowed <= found.held.strain_percent && allowed > 0.999 * found.held.strain_percent, "{found:?}");
    }

    #[test]
    fn analytic_a_frame_whose_own_hinge_held_keeps_its_limit() {
        for preset in ["cognifly", "cognifly-mini", "cognifly-v8"] {
            let frame = Frame::resolve(&FrameFile::load(preset).expect("is a preset")).expect("resolves");
            let hinges = Hinges::of(&frame).expect("closes");
            let [thin, own, thick] = hinges.thicknesses_mm;
            assert!(thin < own && own < thick, "{hinges:?}");
            let found = limit(&frame, &[(own, None), (thin, Some(1))]).expect("a limit");
            let tilt = Closure::solve(&frame).expect("closes").strut_tilt.to_deg();
            let folded = fold::web(&frame, Angle::deg(strut_fold_deg(tilt))).strain_percent;
            assert!(folded <= found.elongation_percent / found.factor, "{preset}: {folded} {found:?}");
        }
    }

    #[test]
    fn analytic_tables_from_which_no_limit_follows() {
        let frame = frame();
        let error = |of: &[(f64, Option<u32>)]| limit(&frame, of).expect_err("is refused");
        assert_eq!(error(&[]), (None, FoldingError::NothingFolded));
        assert!(matches!(error(&[(2.9, None), (2.0, None)]), (Some(1), FoldingError::NotThere { .. })));
        assert!(matches!(error(&[(1.7, None), (2.9, Some(80))]), (Some(1), FoldingError::Contrary { .. })));
        assert!(matches!(error(&[(2.9, None), (2.9, Some(80))]), (Some(1), FoldingError::Contrary { .. })));
        assert!(matches!(error(&[(1.7, Some(1)), (3.8, Some(99))]), (None, FoldingError::NoneHeld { .. })));
        let mut unknown = frame.clone();
        unknown.flexible.material.elongation_at_break_percent = None;
        assert!(matches!(limit(&unknown, &[(2.9, None)]), Err((None, FoldingError::NoElongation { .. }))));
        unknown.flexible.material.elongation_at_break_percent = Some(50.0);
        assert!(matches!(limit(&unknown, &[(2.9, None)]), Err((None, FoldingError::Beyond { .. }))));
    }
}
