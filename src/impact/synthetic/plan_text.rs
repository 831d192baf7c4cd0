//! A plan of synthetic drops as a file.

use super::{HeavyFeet, Landings, Plan, Stalls};

impl Plan {
    /// The plan as a file that `flexframe synthesize` reads.
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
        if let Some(Stalls { lost_s, sector, catch_up, record_s }) = self.stalls {
            text +=
                &format!("record_s = {record_s:?}\nstall_ms = {:?}\nsector_samples = {sector:?}\ncatch_up = {catch_up:?}\n", lost_s * 1e3);
        }
        text += &self.landings.as_ref().map(landing).unwrap_or_default();
        if let Some(hidden) = &self.hidden {
            text += &format!("\n[hidden]\nkind = \"{}\"\n", hidden.name());
            hidden.numbers().iter().for_each(|(key, value)| text += &format!("{key} = {value:?}\n"));
        }
        text
    }
}

fn landing(landings: &Landings) -> String {
    let feet = landings.heavy_feet.map_or_else(String::new, |HeavyFeet { share, f_hz, zeta }| {
        format!("foot_share = {share:?}\nfoot_f_hz = {f_hz:?}\nfoot_zeta = {zeta:?}\n")
    });
    let [lean_x, lean_y] = landings.sensor_lean_rad.map(f64::to_degrees);
    format!(
        "\n[landing]\nrate_rad_s = {:?}\nat_release_rad = {:?}\ninertia_kg_m2 = {:?}\nfoot_radius_mm = {:?}\nground_friction = {:?}\ntouch_g = {:?}\nringing_g = {:?}\n\
         sensor_lean_x_deg = {lean_x:?}\nsensor_lean_y_deg = {lean_y:?}\n{feet}",
        landings.rate_rad_s,
        landings.at_release_rad,
        landings.inertia_kg_m2,
        landings.foot_radius_m * 1e3,
        landings.ground_friction,
        landings.touch_g,
        landings.ringing_g
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::effects::Model;
    use crate::impact::synthetic::{Hidden, ScatterLaw, TrialVariation, records};
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

    /// The same of lateral axes, of feet with mass, and of a logger whose clock stalls.
    #[test]
    fn analytic_landings_and_whole_records_are_written_too() {
        let plan = |tables: &str| {
            let text = format!(
                "mass_kg = 0.25\ngap_mm = 16.0\n[sensor]\ncutoff_hz = 500.0\norder = 1\nlimit_g = 230.0\n[effects.linear_spring]\nk = 20000.0\n[effects.linear_damper]\nc = 40.0\n\n[drops]\nheights_m = [1.0]\ncount = 3\n{tables}"
            );
            ImpactFile::parse("plan.toml", &text).and_then(|file| Plan::resolve(&file)).expect("reads")
        };
        for tables in [
            "[landing]\nrate_rad_s = 0.3\ntouch_g = 70.0\nfoot_share = 0.125\ninertia_kg_m2 = 2e-3\n",
            "[logger]\nrecord_s = 2.0\nstall_ms = 16.0\n",
        ] {
            let first = plan(tables);
            let read = ImpactFile::parse("plan.toml", &first.to_toml()).and_then(|file| Plan::resolve(&file)).expect("reads");
            assert_eq!(records(&first), records(&read), "{tables}");
        }
    }
}
