//! The tests that slopes, and what is named beside them, have to pass.

use super::assessment::LandingAssessment;
use super::gate::Gate;
use super::height_peaks::HeightPeaks;
use super::parameter::{PARAMETERS, Parameter};
use super::sensor_attitude::ATTITUDE_SENSOR;
use super::touch_adequacy::TouchAdequacy;
use crate::figures::p_value;
use crate::impact::diagnose::{Diagnosis, EffectEstimate, RARE, UNSTEADY, Verdict, joined};

/// What is said of a test that needs heights that no fit saw.
const ONE_HEIGHT: &str = "not tested, as all drops are from one height: drops from a second one would test it";

/// Whether the interval of friction, of the feet's or the mount's number ends at a bound that is not its absence. Light feet, no friction and
/// hardly any damping are values that they can have.
fn is_open(estimate: &EffectEstimate) -> bool {
    let own = |parameter: &&Parameter| parameter.key == estimate.key && parameter.kind.is_beside_slopes();
    let Some(parameter) = PARAMETERS.iter().find(own) else { return false };
    let ([low, high], [min, max]) = (estimate.ci95, parameter.bounds);
    high >= max * (1.0 - 1e-6) || parameter.unit == "Hz" && low <= min * (1.0 + 1e-6)
}

fn beyond_words(peaks: &HeightPeaks) -> String {
    let HeightPeaks { height_m, upper_quartile_g, largest_g, .. } = peaks;
    format!(
        "a quarter of the drops from {height_m} m read {upper_quartile_g:.0} g or more, where no landing on these legs reads more than {largest_g:.0} g: a \
         force is missing, as that of a stop"
    )
}

impl LandingAssessment {
    /// Each test, beside the best set of effects along the vertical.
    pub(super) fn gates(&self, diagnosis: &Diagnosis) -> Vec<Gate> {
        vec![
            self.touches(),
            self.held_out(diagnosis),
            self.drops(),
            self.constant(),
            self.plausible(diagnosis),
            self.enough(),
            self.spread(),
        ]
    }

    /// Whether the touch times are those of feet in one plane.
    fn touches(&self) -> Gate {
        let touched = &self.evidence;
        let found = format!(
            "{} of {} drops show the touch of each foot; the first lies along a diagonal in {:.0} % (p = {:.1e}), and the times are those of \
             feet in one plane within {:.2} ms, permuted {:.2} ms (p = {})",
            touched.seen,
            touched.drops,
            1e2 * touched.along_diagonals,
            touched.along_diagonals_p,
            1e3 * touched.deviation_s,
            1e3 * touched.permuted_deviation_s,
            p_value(touched.plane_p)
        );
        Gate { id: "touches", passed: touched.feet_in_one_plane(), found }
    }

    /// Whether slopes come nearer to heights that no fit saw than no effect and than the best set along the vertical.
    fn held_out(&self, diagnosis: &Diagnosis) -> Gate {
        let gaps = &self.gaps;
        let (base, best) = (diagnosis.before.held_out.net_g, diagnosis.after.held_out.net_g);
        let found = if gaps.held_out.net_g.is_finite() {
            let interval = gaps
                .held_out_ci95_g
                .map_or(String::new(), |[least, most]| format!(" ({least:.1} to {most:.1} g by how well the fitted heights tell them)"));
            format!(
                "the gap to heights that no fit saw is {:.2} g with random slopes{interval}, {base:.2} g without, {best:.2} g with {} instead; \
                 {:.2} g with the slopes that their own touch times show",
                gaps.held_out.net_g,
                joined(&diagnosis.chosen),
                gaps.own_slopes.net_g
            )
        } else {
            ONE_HEIGHT.into()
        };
        // A set that its own tests refuse is no explanation: it bars slopes only where it is nearer by more than the heights tell, as far as they tell
        // that slopes come nearer than nothing at all.
        let is_refused = diagnosis.verdict == Verdict::NoneSuffices;
        let beats = |best: f64| gaps.held_out_ci95_g.is_some_and(|[least, most]| is_refused && best >= least && most < base);
        let nearer = gaps.held_out.net_g < best || beats(best);
        Gate { id: "held_out", passed: gaps.held_out.net_g < base && nearer, found }
    }

    /// Whether single drops are predicted from their touches.
    fn drops(&self) -> Gate {
        let gaps = &self.gaps;
        let found = if gaps.given_touches.records_g.is_finite() {
            format!(
                "single drops are predicted from their touches within {:.1} g, {:.1} g by the mean of their own height, {:.1} g with touches \
                 of other drops (p = {})",
                gaps.given_touches.records_g,
                gaps.held_out.template_g,
                gaps.dealt_g,
                p_value(gaps.dealt_p)
            )
        } else {
            ONE_HEIGHT.into()
        };
        Gate { id: "drops", passed: self.touches_tell_drops(), found }
    }

    /// Whether the turning rate, and the numbers of the effects beside it, are the same at all fitted heights.
    fn constant(&self) -> Gate {
        let steady_p = self.slopes_steady_p;
        let effects = self.ids()[1..].iter().filter(|id| **id != ATTITUDE_SENSOR).copied().collect::<Vec<_>>().join(" + ");
        let left = if steady_p >= UNSTEADY { "leaves" } else { "does not leave" };
        let of_slopes = match self.heights.len() {
            0 | 1 => "not tested: one height was fitted".into(),
            _ => format!("one turning rate for all fitted heights {left} the touch times within their errors (p = {steady_p:.1e})"),
        };
        let found = match self.effects_steady_p {
            None => of_slopes,
            Some(p) if p < UNSTEADY => format!("{of_slopes}, and {effects} differs from height to height (p = {p:.1e})"),
            Some(p) => format!("{of_slopes}, and {effects} is the same at all fitted heights (p = {p:.1e})"),
        };
        let passed = steady_p >= UNSTEADY && self.effects_steady_p.is_none_or(|p| p >= UNSTEADY);
        Gate { id: "constant", passed, found }
    }

    /// Whether slopes and what is named beside them leave no more than trial variation.
    fn enough(&self) -> Gate {
        Gate { id: "enough", passed: self.adequacy.p >= RARE && self.given_touches.p >= RARE, found: self.left_over() }
    }

    /// Whether single drops spread as those of random slopes do.
    fn spread(&self) -> Gate {
        let spread = format!(
            "peaks, impulses and their half times of single drops spread as those of random slopes do with p = {}",
            p_value(self.spread_p)
        );
        let beyond: Vec<String> = self.peaks.iter().filter(|peaks| peaks.are_beyond()).map(beyond_words).collect();
        let found = std::iter::once(spread).chain(beyond.iter().cloned()).collect::<Vec<_>>().join("; ");
        Gate { id: "spread", passed: self.spread_p >= RARE && beyond.is_empty(), found }
    }

    /// Whether the drops tell every parameter within its bounds.
    fn plausible(&self, diagnosis: &Diagnosis) -> Gate {
        let keys = |those: &dyn Fn(&EffectEstimate) -> bool| -> Vec<&str> {
            self.estimates.iter().filter(|estimate| those(estimate)).map(|estimate| estimate.key).collect()
        };
        let (at_bound, open) = (keys(&|estimate| estimate.at_bound), keys(&is_open));
        let found = match (&at_bound[..], &open[..]) {
            ([], []) => "no parameter ended at its bound".into(),
            ([], open) => format!("the 95 % interval of {} ends at a bound: the drops do not tell it", open.join(", ")),
            (at_bound, _) => format!("{} ended at its bound{}", at_bound.join(", "), self.undamped(diagnosis)),
        };
        Gate { id: "plausible", passed: at_bound.is_empty() && open.is_empty(), found }
    }

    /// Why legs may seem to have no damping, as a clause: a filter that the sensor does not have takes its place.
    fn undamped(&self, diagnosis: &Diagnosis) -> String {
        let is_least = |estimate: &EffectEstimate| estimate.key == "c" && estimate.at_bound && estimate.value <= estimate.ci95[0];
        if !self.estimates.iter().any(is_least) {
            return String::new();
        }
        format!("; the model's filter of {:.0} Hz smooths as damping does: is it the sensor's?", diagnosis.base.model().sensor.cutoff_hz)
    }

    /// What is left of mean waves, and of single drops given their touches, in a sentence.
    fn left_over(&self) -> String {
        let TouchAdequacy { p, height_m, at_s, left_g, error_g } = self.given_touches;
        format!(
            "what {} leaves of the mean waves has p = {} under trial variation; of single drops, given their touches, it leaves at most {left_g:.1} \
             ± {error_g:.1} g in mean, {:.0} ms behind the trigger from {height_m} m (p = {})",
            self.ids().join(" + "),
            p_value(self.adequacy.p),
            1e3 * at_s,
            p_value(p)
        )
    }
}
