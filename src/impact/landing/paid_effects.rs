//! What is fitted beside legs and turning slopes, where it explains so much more of the drops as a parameter has to: slopes at release, dry
//! friction of the legs, and mass of the feet or a mount of the sensor.

use super::fit_step::SLOPES;
use super::fitting::{LandingFit, LandingProblem, MOST_TURNS, ModelParts, ROUGH_SUM};
use super::parameter::{FEET_HZ, FEET_START, FRICTION_N, LEGS, MOUNT_ZETA, MOUNTS, MOUNTS_HZ, Parameter};
use super::score_sums::ScoreSums;
use super::touched_slopes::TouchLikelihood;
use crate::impact::diagnose::PRICE;
use crate::impact::fit::inverse;

impl LandingProblem<'_> {
    /// Fits a population from another fit's end, with slopes at release where these explain so much more of the touch times as a parameter
    /// has to.
    pub fn fitted_with_release_if_it_pays(self, from: &LandingFit) -> Option<(Self, LandingFit)> {
        let first = self.fitted(Some(from))?;
        let tables = self.tables(&first.legs, &first.slopes)?;
        let touches = TouchLikelihood::of(&self.heights(), &tables)?;
        if touches.slopes(true).deviance + PRICE >= touches.slopes(false).deviance {
            return Some((self, first));
        }
        let released = self.with(ModelParts { at_release: true, ..self.parts });
        let fit = released.fitted(Some(&first))?;
        Some((released, fit))
    }

    /// Fits a population whose legs have dry friction from the end of one whose legs have none; `None` where friction does not pay its price.
    pub fn fitted_with_friction_if_it_pays(&self, without: &LandingFit) -> Option<(Self, LandingFit)> {
        let rubbing = self.with(ModelParts { rubbing: true, ..self.parts });
        let fit = rubbing.fitted(Some(&rubbing.begun_with(without, LEGS, &[vec![FRICTION_N]])?))?;
        rubbing.friction_pays(without, &fit)?.then_some((rubbing, fit))
    }

    /// Fits a population whose feet have mass of their own from the end of one without, and one with a mount that gives way, and takes the
    /// better one; `None` where neither pays its price, or their numbers end at a bound. Friction that does not pay any more beside it is left
    /// out.
    pub fn fitted_with_feet_or_mount_if_they_pay(&self, without: &LandingFit) -> Option<(Self, LandingFit)> {
        let (slopes, feet) = (without.scaled.len() - SLOPES, LEGS + usize::from(self.parts.rubbing));
        let heavy = self.with(ModelParts { heavy_feet: true, ..self.parts });
        let starts = FEET_HZ.map(|f_hz| [FEET_START[0], f_hz, FEET_START[1]].map(libm::log).to_vec());
        let heavy = heavy.begun_with(without, feet, &starts).map(|fit| (heavy, fit, feet..feet + starts[0].len()));
        let mounted = self.with(ModelParts { mounted: true, ..self.parts });
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
        if problem.parts.rubbing {
            let smooth = problem.with(ModelParts { rubbing: false, ..problem.parts });
            let mut start = fit.scaled.clone();
            start.remove(LEGS);
            let without = smooth.fitted_from(start, MOST_TURNS, ROUGH_SUM)?;
            if !problem.friction_pays(&without, &fit)? {
                let without = smooth.fitted(Some(&without))?;
                return Some((smooth, without));
            }
        }
        Some((problem, fit))
    }

    /// A turn of a fit with more parameters from the end of a fit without them: from each start, at this place among the others, the best one.
    fn begun_with(&self, without: &LandingFit, at: usize, starts: &[Vec<f64>]) -> Option<LandingFit> {
        let (before, behind) = without.scaled.split_at(at);
        let fits = starts.iter().filter_map(|start| self.fitted_from([before, start, behind].concat(), 1, ROUGH_SUM));
        fits.min_by(|a, b| a.sum.total_cmp(&b.sum))
    }

    /// Whether friction pays its price, and is more than what the method is off of the damper's force at first touch: the two resist alike.
    fn friction_pays(&self, without: &LandingFit, with: &LandingFit) -> Option<bool> {
        let heights = &self.waves.chosen;
        let fall = self.model.arrangement().fall;
        let speeds = heights.iter().map(|height| fall.impact_speed_m_s(self.waves.means[*height].height_m));
        let speed_m_s = speeds.sum::<f64>() / heights.len() as f64;
        let off_n = Parameter::damping_off() * with.legs.damping_n_s_m * speed_m_s;
        let paid = without.sum - with.sum > PRICE * self.by_one(with)?;
        Some(!with.at_bound[LEGS] && with.legs.friction_n > off_n && paid)
    }

    /// What a parameter without meaning takes off the sum of squares of single drops, in mean: by how drops differ, as what is left of one drop
    /// is no white noise (K. Takeuchi's criterion; see H. White, Econometrica 50 (1982) 1).
    fn by_one(&self, fit: &LandingFit) -> Option<f64> {
        let drops = self.drops_at_fit(fit)?;
        let columns: Vec<usize> = (0..fit.scaled.len() - SLOPES).filter(|column| !fit.at_bound[*column]).collect();
        let count = self.heights().iter().map(|height| height.drops.len()).sum();
        let ScoreSums { normal, scatter, .. } = ScoreSums::of(&drops, self.waves.expected.samples, 0..count, &columns);
        Some((inverse(&normal)? * scatter).trace() / columns.len() as f64)
    }
}
