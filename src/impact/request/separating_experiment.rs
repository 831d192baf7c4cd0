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
    /// Drops from each height, by simulated experiments; `None` where two hundred are too few.
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

    /// As many drops as show a difference between two sessions that is as large as what the best model leaves.
    fn of_waves(with: &str, fitted: &Waves, diagnosis: &Diagnosis, seed: u64) -> Self {
        let left = |height_m: f64| -> Vec<f64> {
            let own = diagnosis.chosen_points.iter().filter(|point| point.height_m == height_m);
            own.map(|point| point.measured_g - point.model_g).collect()
        };
        let size = |left: &[f64]| left.iter().map(|left| left * left).sum::<f64>() / left.len().max(1) as f64;
        let each = fitted.groups.iter().map(|group| (group, left(group.height_m)));
        let largest = each.max_by(|a, b| size(&a.1).total_cmp(&size(&b.1)));
        let (drops, left_g) = largest.map_or((None, 0.0), |(group, left)| (drops_to_see(group, &left, seed), size(&left).sqrt()));
        Self {
            separates: format!("what the height does, and what differs between heights for another reason ({with})"),
            what: format!(
                "in one session with one mounting, drop the frame {} times from each height, in mixed order: so many show a difference from \
                 the drops at hand as large as what the best model leaves of them, {left_g:.1} g, in {:.0} % of simulated experiments",
                count(drops),
                1e2 * POWER
            ),
            heights_m: fitted.groups.iter().map(|group| group.height_m).collect(),
            drops,
        }
    }

    /// In two sentences.
    pub fn sentences(&self) -> [String; 2] {
        [format!("the drops cannot separate {}", self.separates), format!("what would separate them: {}", self.what)]
    }
}

fn count(drops: Option<usize>) -> String {
    drops.map_or("more than 200".into(), |drops| drops.to_string())
}
