//! How long a fall lasts, compared with others from the same height.

use super::clock_sign::ClockSign;
use super::shorth::Shorth;
use super::spread::Spread;
use crate::units::GRAVITY_M_S2;

/// How much shorter than others a fall must be: deviations, and s.
const SHORT: f64 = 5.0;
const SHORT_S: f64 = 0.008;
/// A weaker sign: deviations, and s.
const RATHER_SHORT: f64 = 2.5;
const RATHER_SHORT_S: f64 = 0.004;
/// How much shorter than the height says, s, where there are too few others.
const SHORT_OF_HEIGHT_S: f64 = 0.025;
/// A fall that is so many times shorter or longer than the height says is one from another height, whatever the clock does.
const OTHER_HEIGHT: f64 = 3.0;
/// Falls that vary by more than this are not compared, s.
const MOST_VARIED_S: f64 = 0.012;
/// Least deviation of falls, s.
const LEAST_FALL_S: f64 = 0.001;
/// Drag over mass of the CogniFly frame in its fall, 1/m: by the falls of the drops of arXiv 2103.04423 against their heights.
const DRAG_1_M: f64 = 0.038;

/// Fewest falls that agree with one another, and the share of all that does, where there are too few for a deviation.
const FEW: usize = 4;
const AGREE: f64 = 0.75;

/// What is usual at a height.
#[derive(Clone, Copy, Debug)]
pub(super) enum UsualFall {
    /// The shortest half of others.
    Of(Shorth),
    /// The median of a few that agree with one another, s.
    OfFew(f64),
    /// The fall from the stated height: there are too few others.
    OfHeight,
}

impl UsualFall {
    /// Of the falls from one height, s.
    pub fn of(falls_s: &[f64]) -> Self {
        if let Some(shorth) = Shorth::of(falls_s.iter().copied()) {
            return Self::Of(shorth);
        }
        let median_s = Spread::of(falls_s.iter().copied()).map_or(f64::NAN, |spread| spread.median);
        let agree = falls_s.iter().filter(|fall_s| (*fall_s - median_s).abs() < SHORT_OF_HEIGHT_S).count();
        if agree >= FEW && agree as f64 >= AGREE * falls_s.len() as f64 { Self::OfFew(median_s) } else { Self::OfHeight }
    }
}

/// How a fall compares with what is usual.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FallLength {
    pub own_s: f64,
    /// Of others, or of the height where there are too few others.
    pub usual_s: f64,
    pub is_of_height: bool,
    /// Shorter beyond doubt.
    pub is_short: bool,
    /// Shorter, which is a weak sign.
    pub is_rather_short: bool,
    pub is_long: bool,
}

impl FallLength {
    /// Compares a fall with the usual one, or with that of the height where there are too few others.
    pub fn of(height_m: f64, own_s: Option<f64>, usual: UsualFall) -> Self {
        let Some(own_s) = own_s else { return Self::default() };
        match usual {
            UsualFall::Of(shorth) if shorth.deviation > MOST_VARIED_S => Self::default(),
            UsualFall::Of(shorth) => {
                let (deviations, missing_s) = (-shorth.above(own_s, LEAST_FALL_S), shorth.middle - own_s);
                Self {
                    own_s,
                    usual_s: shorth.middle,
                    is_of_height: false,
                    is_short: deviations > SHORT && missing_s > SHORT_S,
                    is_rather_short: deviations > RATHER_SHORT && missing_s > RATHER_SHORT_S,
                    is_long: deviations < -SHORT && missing_s < -SHORT_S,
                }
            }
            UsualFall::OfFew(usual_s) => {
                let missing_s = usual_s - own_s;
                let is_short = missing_s > SHORT_OF_HEIGHT_S;
                Self { own_s, usual_s, is_of_height: false, is_short, is_rather_short: is_short, is_long: missing_s < -SHORT_OF_HEIGHT_S }
            }
            UsualFall::OfHeight => {
                let usual_s = fall_in_air_s(height_m);
                if !(1.0 / OTHER_HEIGHT..OTHER_HEIGHT).contains(&(own_s / usual_s)) {
                    return Self::default();
                }
                let (is_rather_short, is_long) = (usual_s - own_s > SHORT_OF_HEIGHT_S, own_s - usual_s > SHORT_OF_HEIGHT_S);
                Self { own_s, usual_s, is_of_height: true, is_short: false, is_rather_short, is_long }
            }
        }
    }

    /// What it says of the clock.
    pub fn sign(&self) -> Option<ClockSign> {
        let unusual = self.is_rather_short || self.is_long;
        let (fall_ms, usual_ms) = (self.own_s * 1e3, self.usual_s * 1e3);
        unusual.then_some(if self.is_of_height {
            ClockSign::FallOfHeight { fall_ms, height_ms: usual_ms }
        } else {
            ClockSign::Fall { fall_ms, usual_ms }
        })
    }
}

/// How long a fall lasts in air, s: v = √(g/β) tanh(√(g β) t), integrated.
pub(super) fn fall_in_air_s(height_m: f64) -> f64 {
    libm::acosh(libm::exp(DRAG_1_M * height_m)) / (GRAVITY_M_S2 * DRAG_1_M).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn analytic_a_fall_in_air_lasts_a_little_longer() {
        let vacuum_s = libm::sqrt(2.0 * 1.5 / GRAVITY_M_S2);
        // To first order by β h / 6.
        assert!((fall_in_air_s(1.5) / vacuum_s - (1.0 + DRAG_1_M * 1.5 / 6.0)).abs() < 1e-4);
    }

    #[test]
    fn planted_a_height_in_another_unit_is_no_stalled_clock() {
        let sign = |height_m: f64| FallLength::of(height_m, Some(0.316), UsualFall::OfHeight).sign();
        assert!(sign(50.0).is_none() && sign(0.005).is_none() && sign(0.5).is_none());
        let told = sign(1.0).expect("is 130 ms short").to_string();
        assert!(told.contains("the fall lasts 316 ms") && !told.contains("usual"), "{told}");
    }
}
