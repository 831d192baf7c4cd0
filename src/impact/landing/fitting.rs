//! Stiffness, damping, inertia and the spread of slopes, from drops.
//!
//! Each is fitted to what tells it, in turn: the spread of slopes to the touch times ([`TouchedSlopes`]), the legs to single drops, each with
//! the landing that its own touch times show. Mean waves are predicted, not fitted. They depend on the few steepest landings: legs that were
//! fitted to the means of forty records a height came out a third off, where single drops give them within a twentieth.
//!
//! *When it is wrong:* legs that are not alike, or whose springs and dampers are not linear; slopes at release so small that the touch times do not pay for them count as
//! turning.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::fit_step::SLOPES;
use super::foot_mode::FootMode;
use super::legged_body::{LeggedBody, Legs, Slopes, fall};
use super::mount::Mount;
use super::observed::{HeightLandings, ObservedLanding, ObservedLandings};
use super::population::Population;
use super::posterior::given_touches;
use super::table::LandingTable;
use super::touched_slopes::{self, TouchedSlopes, left_of_quartiles};
use crate::impact::diagnose::PRICE;
use crate::impact::effects::Model;
use crate::impact::fit::{FitProblem, Minimum, at_bounds, inverse, minimise};

/// What is fitted.
pub struct Parameter {
    /// Key.
    pub key: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Bounds.
    pub bounds: [f64; 2],
    /// Step of difference quotients, on the scale of the fit.
    step: f64,
    /// Where a fit begins.
    start: f64,
    /// What it belongs to.
    pub kind: Kind,
    /// Standard deviation of what the method itself is off, as a share of the value: what synthetic sets of a generator that shares no
    /// equation with this model show beyond how their drops vary (docs/diagnosis.md). 0 where it was not measured.
    method: f64,
}

/// Legs, feet and mount are fitted as logarithms, friction and slopes as they are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Of the legs and the body on them.
    Leg,
    /// Of the legs' dry friction.
    Friction,
    /// Of the feet's own mass.
    Feet,
    /// Of what carries the sensor.
    Mount,
    /// Of the random slopes.
    Slope,
}

impl Parameter {
    const fn new(key: &'static str, unit: &'static str, bounds: [f64; 2], step: f64, start: f64, kind: Kind) -> Self {
        Self { key, unit, bounds, step, start, kind, method: 0.0 }
    }

    const fn off_by(self, method: f64) -> Self {
        Self { method, ..self }
    }

    /// Standard deviation of what the method is off at a value, both on the scale of the fit.
    pub fn method_at(&self, scaled: f64) -> f64 {
        self.method * self.unit_at(scaled)
    }

    /// A share of a value, on the scale of the fit.
    fn unit_at(&self, scaled: f64) -> f64 {
        if self.is_logarithmic() { 1.0 } else { scaled }
    }

    /// A 95 % interval of changes by how drops vary, widened by what the method is off, in standard deviations, all on the scale of the fit.
    pub fn with_method([low, high]: [f64; 2], deviation: f64) -> [f64; 2] {
        let off = NORMAL_95 * deviation;
        [-libm::hypot(low.min(0.0), off), libm::hypot(high.max(0.0), off)]
    }

    fn inward(&self, value: f64) -> f64 {
        if self.is_logarithmic() { libm::log(value) } else { value }
    }

    /// A value from the scale of the fit.
    pub fn outward(&self, scaled: f64) -> f64 {
        if self.is_logarithmic() { libm::exp(scaled) } else { scaled }
    }

    fn is_logarithmic(&self) -> bool {
        matches!(self.kind, Kind::Leg | Kind::Feet | Kind::Mount)
    }
}

/// Legs, their friction, feet, mount, slopes, in this order; friction, feet and mount may be left out.
static PARAMETERS: [Parameter; 11] = [
    Parameter::new("k", "N/m", [300.0, 5e5], 0.02, 1.5e4, Kind::Leg).off_by(0.03),
    Parameter::new("c", "N s/m", [0.05, 1000.0], 0.02, 25.0, Kind::Leg).off_by(0.07),
    Parameter::new("inertia_kg_m2", "kg m2", [2e-5, 5e-2], 0.02, 1e-3, Kind::Leg).off_by(0.115),
    Parameter::new("f_c_n", "N", [0.0, 200.0], 1.0, 0.0, Kind::Friction),
    Parameter::new("foot_share", "1", [0.01, 0.6], 0.05, FEET[0], Kind::Feet),
    Parameter::new("foot_f_hz", "Hz", [50.0, 500.0], 0.02, 200.0, Kind::Feet),
    Parameter::new("foot_zeta", "1", [0.002, 1.5], 0.1, FEET[1], Kind::Feet),
    Parameter::new("f_hz", "Hz", [50.0, 1500.0], 0.02, 160.0, Kind::Mount),
    Parameter::new("zeta", "1", [0.02, 1.5], 0.02, MOUNT_ZETA, Kind::Mount),
    Parameter::new("sigma_r_rad_s", "rad/s", touched_slopes::BOUNDS[0], touched_slopes::STEPS[0], 0.0, Kind::Slope).off_by(0.06),
    Parameter::new(RELEASE, "rad", touched_slopes::BOUNDS[1], touched_slopes::STEPS[1], 0.0, Kind::Slope),
];
/// Key of the slope at release.
pub const RELEASE: &str = "sigma_0_rad";
/// The place of their damping.
const DAMPING: usize = 1;
/// How many are the legs' without friction, and the place of friction.
const LEGS: usize = 3;
/// How many are the mount's, which stand just before the slopes.
const MOUNTS: usize = 2;
/// Share and damping ratio at which a fit with heavy feet begins, and frequencies, Hz.
const FEET: [f64; 2] = [0.12, 0.1];
const FEET_HZ: [f64; 2] = [150.0, 250.0];
/// What the method is off of friction, and of damping beside it, as a share: the two resist alike, and in 24 synthetic sets with 50 N of friction
/// it is found 30 % too large, and damping 29 % too small.
const BESIDE_FRICTION: f64 = 0.2;
/// Friction at which a fit begins, N.
const FRICTION_N: f64 = 15.0;
/// Damping ratio at which a fit with a mount begins.
const MOUNT_ZETA: f64 = 0.3;
/// Frequencies at which a fit with a mount begins, Hz.
const MOUNTS_HZ: [f64; 2] = [120.0, 200.0];
/// Most steps of the legs' fit.
const MOST_STEPS: usize = 25;
/// Most turns in which slopes and legs are fitted.
const MOST_TURNS: usize = 5;
/// A turn that moves the legs by less, in steps of difference quotients, is the last.
const SETTLED: f64 = 0.5;
/// So many standard deviations on both sides of its mean hold 95 % of a normal law.
const NORMAL_95: f64 = 1.96;

/// What is compared with what.
#[derive(Clone, Debug)]
pub struct LandingProblem<'a> {
    /// What lands.
    pub body: LeggedBody,
    /// Fall and sensor.
    pub model: &'a Model,
    /// Mean waves with their covariance.
    pub waves: &'a FitProblem,
    /// Touches, the same heights.
    pub observed: &'a ObservedLandings,
    /// Whether the legs have dry friction.
    pub rubbing: bool,
    /// Whether the feet have mass of their own.
    pub heavy_feet: bool,
    /// Whether the sensor has a mount that gives way.
    pub mounted: bool,
    /// Whether landings may slope at release, not only by turning while they fall.
    pub at_release: bool,
}

/// A fit.
#[derive(Clone, Debug)]
pub struct LandingFit {
    /// The legs.
    pub legs: Legs,
    /// The slopes.
    pub slopes: Slopes,
    /// On the scale of the fit.
    pub(super) scaled: Vec<f64>,
    /// Which of them ended at a bound.
    pub(super) at_bound: Vec<bool>,
    /// Sum of squares of what it leaves of the drops, in units of their heights' waves.
    sum: f64,
}

/// Of some drops and parameters: the sums of squares of the drops' derivatives, of their scores, and the scores.
struct ScoreSums {
    normal: DMatrix<f64>,
    scatter: DMatrix<f64>,
    right: DVector<f64>,
}

impl<'a> LandingProblem<'a> {
    /// Landings on legs of a spring and a damper, of which nothing else is asked.
    pub fn plain(body: LeggedBody, model: &'a Model, waves: &'a FitProblem, observed: &'a ObservedLandings) -> Self {
        Self { body, model, waves, observed, rubbing: false, heavy_feet: false, mounted: false, at_release: false }
    }
}

impl LandingProblem<'_> {
    /// What numbers on the scale of the fit mean.
    pub fn meaning(&self, scaled: &[f64]) -> (Legs, Slopes) {
        let values: Vec<f64> = self.parameters().iter().zip(scaled).map(|(parameter, scaled)| parameter.outward(*scaled)).collect();
        let (legs, slopes) = values.split_at(values.len() - SLOPES);
        let (own, more) = legs.split_at(LEGS);
        let (friction, more) = more.split_at(usize::from(self.rubbing));
        let (feet, mount) = more.split_at(if self.heavy_feet { 3 } else { 0 });
        let legs = Legs {
            stiffness_n_m: own[0],
            damping_n_s_m: own[1],
            inertia_kg_m2: own[2],
            friction_n: friction.first().copied().unwrap_or(0.0),
            feet: if let [share, f_hz, zeta] = *feet { Some(FootMode { share, f_hz, zeta }) } else { None },
            mount: if let [f_hz, zeta] = *mount { Some(Mount { f_hz, zeta }) } else { None },
        };
        (legs, Slopes { rate_rad_s: slopes[0], at_release_rad: slopes[1] })
    }

    /// What is fitted, in its order.
    pub fn parameters(&self) -> Vec<&'static Parameter> {
        let fitted = |parameter: &&Parameter| match parameter.kind {
            Kind::Friction => self.rubbing,
            Kind::Feet => self.heavy_feet,
            Kind::Mount => self.mounted,
            Kind::Leg | Kind::Slope => true,
        };
        PARAMETERS.iter().filter(fitted).collect()
    }

    /// Standard deviation of what the method is off at a value of a parameter, both on the scale of the fit. Friction and damping trade with each
    /// other.
    pub fn method_at(&self, parameter: &Parameter, scaled: f64) -> f64 {
        let trades = self.rubbing && [PARAMETERS[DAMPING].key, PARAMETERS[LEGS].key].contains(&parameter.key);
        if trades { BESIDE_FRICTION * parameter.unit_at(scaled) } else { parameter.method_at(scaled) }
    }

    /// Bounds on the scale of the fit.
    pub fn bounds(&self) -> Vec<[f64; 2]> {
        self.parameters().iter().map(|parameter| parameter.bounds.map(|bound| parameter.inward(bound))).collect()
    }

    fn steps(&self) -> Vec<f64> {
        self.parameters().iter().map(|parameter| parameter.step).collect()
    }

    /// The landings of the chosen heights.
    pub fn tables(&self, legs: &Legs) -> Option<Vec<LandingTable>> {
        let table =
            |height: &usize| LandingTable::of(&self.body, legs, self.model, &self.waves.expected, self.waves.means[*height].height_m);
        self.waves.chosen.iter().map(table).collect()
    }

    /// The same at some heights alone.
    #[must_use]
    pub fn at<'b>(&'b self, waves: &'b FitProblem) -> LandingProblem<'b> {
        LandingProblem { waves, ..self.clone() }
    }

    /// The chosen heights' drops.
    pub fn heights(&self) -> Vec<&HeightLandings> {
        self.waves.chosen.iter().map(|height| &self.observed.heights[*height]).collect()
    }

    /// Mean windows of the chosen heights, one below the other, g.
    pub fn mean_windows(&self, legs: &Legs, slopes: &Slopes) -> Option<DVector<f64>> {
        let tables = self.tables(legs)?;
        let parts: Vec<f64> =
            tables.iter().flat_map(|table| Population::of(table, slopes).mean_window().iter().copied().collect::<Vec<_>>()).collect();
        Some(DVector::from_vec(parts))
    }

    /// Fits a population, from another fit's end where there is one.
    pub fn fitted(&self, from: Option<&LandingFit>) -> Option<LandingFit> {
        let plain = || self.parameters().iter().map(|parameter| parameter.inward(parameter.start)).collect();
        self.fitted_from(from.map_or_else(plain, |fit: &LandingFit| fit.scaled.clone()), MOST_TURNS)
    }

    /// A population that was not fitted, as the end of a fit.
    pub fn ended_at(&self, legs: Legs, slopes: Slopes) -> LandingFit {
        let mount = legs.mount.iter().flat_map(|mount| [mount.f_hz, mount.zeta]);
        let of_legs = [legs.stiffness_n_m, legs.damping_n_s_m, legs.inertia_kg_m2].into_iter();
        let feet = legs.feet.iter().flat_map(|feet| [feet.share, feet.f_hz, feet.zeta]);
        let values = of_legs
            .chain(self.rubbing.then_some(legs.friction_n))
            .chain(feet)
            .chain(mount)
            .chain([slopes.rate_rad_s, slopes.at_release_rad]);
        let scaled: Vec<f64> = self.parameters().iter().zip(values).map(|(parameter, value)| parameter.inward(value)).collect();
        let at_bound = at_bounds(&scaled, &self.bounds());
        LandingFit { legs, slopes, scaled, at_bound, sum: f64::NAN }
    }

    /// Fits a population from another fit's end, with slopes at release where these explain so much more of the touch times as a parameter
    /// has to.
    pub fn fitted_with_release_if_it_pays(self, from: &LandingFit) -> Option<(Self, LandingFit)> {
        let first = self.fitted(Some(from))?;
        let tables = self.tables(&first.legs)?;
        let left = |at_release: bool| Some(TouchedSlopes::of(&self.heights(), &tables, at_release)?.residual.norm_squared());
        if left(true)? + PRICE >= left(false)? {
            return Some((self, first));
        }
        let released = Self { at_release: true, ..self };
        let fit = released.fitted(Some(&first))?;
        Some((released, fit))
    }

    /// Fits a population whose legs have dry friction from the end of one whose legs have none; `None` where friction does not pay its price.
    pub fn fitted_with_friction_if_it_pays(&self, without: &LandingFit) -> Option<(Self, LandingFit)> {
        let rubbing = Self { rubbing: true, ..self.clone() };
        let fit = rubbing.fitted(Some(&rubbing.begun_with(without, LEGS, &[vec![FRICTION_N]])?))?;
        rubbing.friction_pays(without, &fit)?.then_some((rubbing, fit))
    }

    /// Fits a population whose feet have mass of their own from the end of one without, and one with a mount that gives way, and takes the
    /// better one; `None` where neither pays its price, or their numbers end at a bound. Friction that does not pay any more beside it is left
    /// out.
    pub fn fitted_with_feet_or_mount_if_they_pay(&self, without: &LandingFit) -> Option<(Self, LandingFit)> {
        let (slopes, feet) = (without.scaled.len() - SLOPES, LEGS + usize::from(self.rubbing));
        let heavy = Self { heavy_feet: true, ..self.clone() };
        let starts = FEET_HZ.map(|f_hz| [FEET[0], f_hz, FEET[1]].map(libm::log).to_vec());
        let heavy = heavy.begun_with(without, feet, &starts).map(|fit| (heavy, fit, feet..feet + starts[0].len()));
        let mounted = Self { mounted: true, ..self.clone() };
        let starts = MOUNTS_HZ.map(|f_hz| [f_hz, MOUNT_ZETA].map(libm::log).to_vec());
        let mounted = mounted.begun_with(without, slopes, &starts).map(|fit| (mounted, fit, slopes..slopes + MOUNTS));
        let priced = |(problem, fit, own): &(Self, LandingFit, std::ops::Range<usize>)| {
            problem.by_one(fit).map_or(f64::INFINITY, |by_one| fit.sum + own.len() as f64 * PRICE * by_one)
        };
        let (problem, begun, own) = [heavy, mounted].into_iter().flatten().min_by(|a, b| priced(a).total_cmp(&priced(b)))?;
        let fit = problem.fitted(Some(&begun))?;
        let best = (problem, fit, own);
        if priced(&best) >= without.sum || best.1.at_bound[best.2.clone()].contains(&true) {
            return None;
        }
        let (problem, fit, _) = best;
        if problem.rubbing {
            let smooth = Self { rubbing: false, ..problem.clone() };
            let mut start = fit.scaled.clone();
            start.remove(LEGS);
            let without = smooth.fitted_from(start, MOST_TURNS)?;
            if !problem.friction_pays(&without, &fit)? {
                return Some((smooth, without));
            }
        }
        Some((problem, fit))
    }

    /// A turn of a fit with more parameters from the end of a fit without them: from each start, at this place among the others, the best one.
    fn begun_with(&self, without: &LandingFit, at: usize, starts: &[Vec<f64>]) -> Option<LandingFit> {
        let (before, behind) = without.scaled.split_at(at);
        let fits = starts.iter().filter_map(|start| self.fitted_from([before, start, behind].concat(), 1));
        fits.min_by(|a, b| a.sum.total_cmp(&b.sum))
    }

    /// Whether friction pays its price, and is more than what the method is off of the damper's force at first touch: the two resist alike.
    fn friction_pays(&self, without: &LandingFit, with: &LandingFit) -> Option<bool> {
        let heights = &self.waves.chosen;
        let speeds = heights.iter().map(|height| fall(self.model, self.waves.means[*height].height_m)[0]);
        let speed_m_s = speeds.sum::<f64>() / heights.len() as f64;
        let off_n = NORMAL_95 * PARAMETERS[DAMPING].method * with.legs.damping_n_s_m * speed_m_s;
        let paid = without.sum - with.sum > PRICE * self.by_one(with)?;
        Some(!with.at_bound[LEGS] && with.legs.friction_n > off_n && paid)
    }

    /// What a parameter without meaning takes off the sum of squares of single drops, in mean: by how drops differ, as what is left of one drop
    /// is no white noise (K. Takeuchi's criterion; see H. White, Econometrica 50 (1982) 1).
    fn by_one(&self, fit: &LandingFit) -> Option<f64> {
        let [drops, _] = self.at_fit(fit)?;
        let columns: Vec<usize> = (0..fit.scaled.len() - SLOPES).filter(|column| !fit.at_bound[*column]).collect();
        let count = self.heights().iter().map(|height| height.drops.len()).sum();
        let ScoreSums { normal, scatter, .. } = self.scores(&drops, 0..count, &columns);
        Some((inverse(&normal)? * scatter).trace() / columns.len() as f64)
    }

    /// Slopes and legs in turn, until the legs stay.
    fn fitted_from(&self, mut scaled: Vec<f64>, most_turns: usize) -> Option<LandingFit> {
        let (bounds, steps) = (self.bounds(), self.steps());
        let legs = bounds.len() - SLOPES;
        let mut best = None;
        for _ in 0..most_turns {
            scaled = self.with_touched_slopes(&scaled)?;
            let slopes = scaled[legs..].to_vec();
            let left = |moved: &[f64]| self.left_of_drops(&[moved, &slopes].concat());
            let found = minimise(left, &scaled[..legs], &bounds[..legs], &steps[..legs], MOST_STEPS)?;
            let moved = found.at.iter().zip(&scaled).zip(&steps).map(|((to, from), step)| ((to - from) / step).abs()).fold(0.0, f64::max);
            scaled[..legs].copy_from_slice(&found.at);
            best = Some(found);
            if moved < SETTLED {
                break;
            }
        }
        let Minimum { sum, .. } = best?;
        let scaled = self.with_touched_slopes(&scaled)?;
        let (legs, slopes) = self.meaning(&scaled);
        let at_bound = at_bounds(&scaled, &bounds);
        Some(LandingFit { legs, slopes, scaled, at_bound, sum })
    }

    /// The same legs with the slopes that the touch times show.
    fn with_touched_slopes(&self, scaled: &[f64]) -> Option<Vec<f64>> {
        let tables = self.tables(&self.meaning(scaled).0)?;
        let Slopes { rate_rad_s, at_release_rad } = TouchedSlopes::of(&self.heights(), &tables, self.at_release)?.slopes;
        Some([&scaled[..scaled.len() - SLOPES], &[rate_rad_s, at_release_rad]].concat())
    }

    /// What the predictions from their touches leave of all drops, one below the other, in units of their heights' waves.
    fn left_of_drops(&self, scaled: &[f64]) -> Option<DVector<f64>> {
        let (legs, slopes) = self.meaning(scaled);
        let tables = self.tables(&legs)?;
        let mut all = Vec::new();
        for (height, table) in self.waves.chosen.iter().zip(&tables) {
            let unit_g = self.unit_g(*height);
            all.extend(
                self.left_by_drops(*height, table, &slopes)
                    .iter()
                    .flat_map(|left| left.iter().map(|left| left / unit_g).collect::<Vec<_>>()),
            );
        }
        Some(DVector::from_vec(all))
    }

    /// What the prediction from their touches leaves of the drops of a height, g.
    pub fn left_by_drops(&self, height: usize, table: &LandingTable, slopes: &Slopes) -> Vec<DVector<f64>> {
        let (population, height) = (Population::of(table, slopes), &self.observed.heights[height]);
        let expected = |drop: &ObservedLanding| given_touches(table, &population, &drop.touches, height.read_s()).window;
        height.drops.par_iter().map(|drop| DVector::from_column_slice(&drop.window) - expected(drop)).collect()
    }

    /// Root mean square of a height's mean wave, g: readings vary in proportion to it.
    fn unit_g(&self, height: usize) -> f64 {
        let mean = &self.waves.means[height].wave;
        (mean.iter().map(|reading| reading * reading).sum::<f64>() / mean.len() as f64).sqrt().max(1.0)
    }

    /// Change of the predicted mean windows, g, with each parameter on the scale of the fit.
    pub fn sensitivity(&self, fit: &LandingFit) -> Option<DMatrix<f64>> {
        let mean_windows = |scaled: &[f64]| {
            let (legs, slopes) = self.meaning(scaled);
            Some(-self.mean_windows(&legs, &slopes)?)
        };
        Some(self.looked_at(mean_windows, fit)?.jacobian)
    }

    /// A residual and its difference quotients at a fit.
    fn looked_at(&self, residual: impl Fn(&[f64]) -> Option<DVector<f64>>, fit: &LandingFit) -> Option<Minimum> {
        minimise(residual, &fit.scaled, &self.bounds(), &self.steps(), 0)
    }

    /// What the drops and what the touch times do, at a fit.
    pub fn at_fit(&self, fit: &LandingFit) -> Option<[Minimum; 2]> {
        let touches = |scaled: &[f64]| {
            let (legs, slopes) = self.meaning(scaled);
            left_of_quartiles(&self.heights(), &self.tables(&legs)?, &slopes)
        };
        Some([self.looked_at(|scaled| self.left_of_drops(scaled), fit)?, self.looked_at(touches, fit)?])
    }

    /// Sums over drops, by their places below each other, for some of the parameters.
    fn scores(&self, drops: &Minimum, places: std::ops::Range<usize>, columns: &[usize]) -> ScoreSums {
        let (samples, count) = (self.waves.expected.samples, columns.len());
        let mut sums =
            ScoreSums { normal: DMatrix::zeros(count, count), scatter: DMatrix::zeros(count, count), right: DVector::zeros(count) };
        for place in places {
            let jacobian = drops.jacobian.rows(place * samples, samples).select_columns(columns);
            let score = jacobian.transpose() * drops.residual.rows(place * samples, samples);
            sums.normal += jacobian.transpose() * &jacobian;
            sums.scatter += &score * score.transpose();
            sums.right += score;
        }
        sums
    }

    /// p-value of one friction, one mass of the feet and one mount for all heights: how far a step of the fit to each height's drops alone, with
    /// these numbers free, leads away from their common values. Errors are by how the drops of a height differ. `None` without any of them, or
    /// from one height alone.
    pub fn effects_steady_p(&self, fit: &LandingFit) -> Option<f64> {
        let is_effect = |parameter: &Parameter| matches!(parameter.kind, Kind::Friction | Kind::Feet | Kind::Mount);
        let columns: Vec<usize> = self.parameters().iter().enumerate().filter(|(_, one)| is_effect(one)).map(|(at, _)| at).collect();
        if columns.is_empty() {
            return None;
        }
        let [drops, _] = self.at_fit(fit)?;
        let heights = self.heights();
        let (mut precision_sum, mut weighed_sum) = (DMatrix::zeros(columns.len(), columns.len()), DVector::zeros(columns.len()));
        let (mut chi_squared, mut first) = (0.0, 0);
        for height in &heights {
            let ScoreSums { normal, scatter, right } = self.scores(&drops, first..first + height.drops.len(), &columns);
            first += height.drops.len();
            let step = inverse(&normal)? * right;
            let precision = &normal * inverse(&scatter)? * &normal;
            chi_squared += step.dot(&(&precision * &step));
            weighed_sum += &precision * step;
            precision_sum += precision;
        }
        chi_squared -= weighed_sum.dot(&(inverse(&precision_sum)? * &weighed_sum));
        let freedom = columns.len() * heights.len().checked_sub(1).filter(|free| *free > 0)?;
        Some(ChiSquared::new(freedom as f64).ok()?.sf(chi_squared.max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::by_id;
    use crate::impact::landing::legged_body::COULOMB_FRICTION;

    #[test]
    fn analytic_the_friction_of_legs_is_the_effect_of_the_catalogue() {
        let spec = by_id(COULOMB_FRICTION).expect("is in the catalogue");
        let own = PARAMETERS.iter().find(|parameter| parameter.kind == Kind::Friction).expect("is fitted");
        let [of_catalogue] = spec.parameters else { panic!("has one number") };
        assert_eq!((own.key, own.unit, own.bounds[0]), (of_catalogue.key, of_catalogue.unit, of_catalogue.min));
    }

    #[test]
    fn analytic_what_the_method_is_off_adds_to_an_interval_in_squares() {
        let of = |key: &str| PARAMETERS.iter().find(|parameter| parameter.key == key).expect("is fitted");
        let with_method = |key: &str, spread: [f64; 2], scaled: f64| Parameter::with_method(spread, of(key).method_at(scaled));
        let [low, high] = with_method("k", [-0.04, 0.08], 10.0);
        let off = NORMAL_95 * of("k").method;
        assert!((low * low - 0.04 * 0.04 - off * off).abs() < 1e-12 && low < 0.0);
        assert!((high * high - 0.08 * 0.08 - off * off).abs() < 1e-12);
        assert_eq!(PARAMETERS[DAMPING].key, "c");
        assert_eq!((PARAMETERS[LEGS].key, PARAMETERS[LEGS].unit_at(50.0)), ("f_c_n", 50.0));
        // Of a slope it is a share of the slope.
        let [low, _] = with_method("sigma_r_rad_s", [0.0, 0.0], 0.5);
        assert!((low + 0.5 * NORMAL_95 * of("sigma_r_rad_s").method).abs() < 1e-12);
        assert_eq!(with_method("f_hz", [-0.1, 0.2], 5.0), [-0.1, 0.2]);
    }
}
