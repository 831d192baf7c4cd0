//! The experiment that separates what the drops cannot: the height from what changed together with it.

use serde::Serialize;

use crate::impact::diagnose::{Confounding, Diagnosis, POWER, drops_to_see};
use crate::impact::fit::Waves;
use crate::impact::landing::LandingAssessment;

/// What to do, and how often.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeparatingExperiment {
    /// What the drops cannot separate.
    pub separates: String,
    /// What to do, in plain words.
    pub what: String,
    /// From these heights, m.
    pub heights_m: Vec<f64>,
    /// Drops from each height, by simulated experiments; `None` where two hundred are too few, or nothing is left to be seen.
    pub drops: Option<usize>,
}

impl SeparatingExperiment {
    /// The experiment for what is confounded; `None` where nothing is.
    pub fn of(
        confounding: &[Confounding],
        fitted: &Waves,
        diagnosis: &Diagnosis,
        landing: Option<&LandingAssessment>,
        seed: u64,
    ) -> Option<Self> {
        let with: Vec<&str> = confounding.iter().map(|one| one.with.as_str()).collect();
        let with = (!with.is_empty()).then(|| with.join(" and "))?;
        let touched = landing.filter(|landing| landing.evidence.feet_in_one_plane()).and_then(|landing| landing.separating);
        Some(match touched {
            Some(touched) => Self::of_landings(&with, touched.heights_m, touched.drops),
            None => Self::of_waves(&with, fitted, diagnosis, seed),
        })
    }

    fn of_landings(with: &str, heights_m: [f64; 2], drops: Option<usize>) -> Self {
        let [low, high] = heights_m;
        Self {
            separates: format!("slopes that grow with the fall, and releases or mountings that differ between heights ({with})"),
            what: format!(
                "in one session with one mounting, drop the frame {} times each from {low} and {high} m, in mixed order, and read the touch times of \
                 the feet: a turning rate gives the same times from both heights, a slope at release gives times in proportion to 1/v0",
                count(drops)
            ),
            heights_m: heights_m.to_vec(),
            drops,
        }
    }

    /// As many drops as show a difference between two sessions that is as large as what the best model leaves, beyond the error of the mean wave itself.
    fn of_waves(with: &str, fitted: &Waves, diagnosis: &Diagnosis, seed: u64) -> Self {
        let largest = fitted.groups.iter().map(|group| (group, Left::of(diagnosis, group.height_m)));
        let largest = largest.max_by(|a, b| a.1.net_g.total_cmp(&b.1.net_g)).filter(|(_, left)| left.net_g > 0.0);
        let drops = largest.as_ref().and_then(|(group, left)| drops_to_see(group, &left.wave_g, seed));
        let what = match &largest {
            Some((_, Left { net_g, .. })) => format!(
                "in one session with one mounting, drop the frame {} times from each height, in mixed order: so many show a difference from \
                 the drops at hand as large as what the best model leaves of them, {net_g:.1} g, in {:.0} % of simulated experiments",
                count(drops),
                1e2 * POWER
            ),
            None => "in one session with one mounting, drop the frame from each height, in mixed order; how often cannot be said, as the best model \
                     leaves no more than the errors of the mean waves"
                .into(),
        };
        Self {
            separates: format!("what the height does, and what differs between heights for another reason ({with})"),
            what,
            heights_m: fitted.groups.iter().map(|group| group.height_m).collect(),
            drops,
        }
    }

    /// In two sentences.
    pub fn sentences(&self) -> [String; 2] {
        [format!("the drops cannot separate {}", self.separates), format!("what would separate them: {}", self.what)]
    }
}

/// What the best model leaves of the mean wave of a height.
struct Left {
    /// Sample by sample, made as small as its size beyond the error of the mean wave, g.
    wave_g: Vec<f64>,
    /// That size: root of the mean square less that of the error, g; 0 where it is no larger.
    net_g: f64,
}

impl Left {
    fn of(diagnosis: &Diagnosis, height_m: f64) -> Self {
        let own: Vec<_> = diagnosis.chosen_points.iter().filter(|point| point.height_m == height_m).collect();
        let wave_g: Vec<f64> = own.iter().map(|point| point.measured_g - point.model_g).collect();
        let square = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>() / own.len().max(1) as f64;
        let (all, error) = (square(&mut wave_g.iter().copied()), square(&mut own.iter().map(|point| point.error_g)));
        let net_g = (all - error).max(0.0).sqrt();
        let share = if all > 0.0 { net_g / all.sqrt() } else { 0.0 };
        Self { wave_g: wave_g.into_iter().map(|left| share * left).collect(), net_g }
    }
}

fn count(drops: Option<usize>) -> String {
    drops.map_or("more than 200".into(), |drops| drops.to_string())
}
