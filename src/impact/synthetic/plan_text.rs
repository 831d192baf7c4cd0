//! A plan of synthetic drops as a file.

use super::{Hidden, Plan};

impl Plan {
    /// The plan as a file that `flexframe synthesize` reads. Lateral axes and whole records are not in it.
    pub fn to_toml(&self) -> String {
        let heights: Vec<String> = self.heights_m.iter().map(|height_m| format!("{height_m:?}")).collect();
        let scatter = &self.scatter;
        let mut text = self.model.to_toml();
        text += &format!("\n[drops]\nheights_m = [{}]\ncount = {}\nseed = {}\n", heights.join(", "), self.drops, self.seed);
        text += &format!("\n[scatter]\nlaw = \"{}\"\nshare = {:?}\n", scatter.law.name(), scatter.share);
        text += &format!("correlation_ms = {:?}\nstiffness = {:?}\n", scatter.correlation_s * 1e3, scatter.stiffness);
        text += &format!("damping = {:?}\ntilt_deg = {:?}\n", scatter.damping, scatter.tilt_deg);
        text +=
            &format!("\n[logger]\nnoise_g = {:?}\ncounts_per_g = {:?}\nrate_hz = {:?}\n", self.noise_g, self.counts_per_g, self.rate_hz);
        if let Some(hidden) = &self.hidden {
            text += &format!("\n[hidden]\nkind = \"{}\"\n{}", hidden.name(), numbers(hidden));
        }
        text
    }
}

fn numbers(hidden: &Hidden) -> String {
    match hidden {
        Hidden::TwoStage { x1_m, stiffness_n_m, loss } => {
            format!("x1_mm = {:?}\nstiffness_n_m = {stiffness_n_m:?}\nloss = {loss:?}\n", x1_m * 1e3)
        }
        Hidden::TwoModes { shares: [one, two], f_hz: [low, high], zeta } => {
            format!("share_1 = {one:?}\nshare_2 = {two:?}\nf_1_hz = {low:?}\nf_2_hz = {high:?}\nzeta = {zeta:?}\n")
        }
        Hidden::Wear { loss } => format!("loss = {loss:?}\n"),
        Hidden::Snap { x1_m, loss } => format!("x1_mm = {:?}\nloss = {loss:?}\n", x1_m * 1e3),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::Model;
    use crate::impact::synthetic::{ScatterLaw, TrialVariation, records};
    use crate::params::ImpactFile;

    /// What is written is the same plan: it gives the same drops, to the last bit.
    #[test]
    fn analytic_a_plan_that_is_written_gives_the_same_drops() {
        let base = Model::load("paper").expect("comes with the program");
        let strangers = [
            None,
            Some(Hidden::TwoStage { x1_m: 0.006, stiffness_n_m: 9e3, loss: 0.75 }),
            Some(Hidden::TwoModes { shares: [0.125, 0.25], f_hz: [75.5, 190.25], zeta: 0.04 }),
            Some(Hidden::Wear { loss: 0.5 }),
            Some(Hidden::Snap { x1_m: 0.005, loss: 0.5 }),
        ];
        for (hidden, law) in strangers.into_iter().zip(ScatterLaw::ALL) {
            let scatter = TrialVariation { share: 0.5, law, correlation_s: 1.5e-3, stiffness: 0.1, damping: 0.2, tilt_deg: 5.0 };
            let plan = Plan {
                model: base.scaled([1.1, 0.9]),
                hidden,
                heights_m: vec![0.5, 1.25],
                drops: 3,
                scatter,
                noise_g: 0.17,
                counts_per_g: 8.877,
                rate_hz: 1000.0,
                stalls: None,
                landings: None,
                seed: 77,
            };
            let read = ImpactFile::parse("plan.toml", &plan.to_toml()).and_then(|file| Plan::resolve(&file)).expect("reads");
            assert_eq!(records(&plan), records(&read), "{hidden:?}");
        }
    }
}
