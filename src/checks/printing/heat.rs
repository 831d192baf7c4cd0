//! The printer is hot enough for both materials.
//!
//! A nozzle that is colder than the least heat at which a material prints is a violation. One that is hot enough for that, but not for the
//! material's profile, a colder bed and a missing enclosure are warnings: a person may print with them. What is not stated is not judged.

use crate::checks::finding::Finding;
use crate::checks::measure::Measure;
use crate::checks::rule::{Blame, Found, InSearch, Levers, Limit, Pass, Rule};
use crate::checks::scene::Scene;
use crate::printing::heat::{Heater, heats, sentence};

const FLEXIBLE: &[&str] = &["printer", "materials.flexible"];
const RIGID: &[&str] = &["printer", "materials.rigid"];

pub static RULE: Rule = Rule {
    id: "printer_heat",
    title: "Printer's heat",
    requires: "the printer is hot enough for each material",
    units: &["°C", ""],
    limits: &[Limit::Printer],
    levers: Levers::Sets(&[FLEXIBLE, RIGID]),
    blame: Blame::Levers,
    // It moves with the choice of a material only.
    in_search: InSearch::Constraints { subjects: &[""], binds: false },
    found: Found::By(&[Pass::quick(check)]),
};

pub(in crate::checks) fn check(scene: &Scene) -> Vec<Finding> {
    let design = scene.design;
    let of = [(&design.frame.flexible, FLEXIBLE), (&design.frame.rigid, RIGID)];
    let mut found = Vec::new();
    for (material, levers) in of {
        for heat in heats(&material.material, &design.frame.printer) {
            let unit = if heat.of == Heater::Enclosure { "" } else { "°C" };
            let measure = Measure { rule: RULE.id, value: heat.wanted, limit: heat.has, unit, levers };
            let subject = format!("{} {}", material.name, heat.of.words());
            let message = sentence(design, material, &heat);
            let cold = heat.wanted > heat.has && !heat.too_cold;
            found.push(if cold { measure.note(subject, message) } else { measure.at_most(subject, message) });
        }
    }
    found
}

/// Whether a finding says that a printer lacks heat for a material, as a violation or as a warning.
pub fn is_too_cold(finding: &Finding) -> bool {
    finding.rule == RULE.id && finding.margin < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::finding::Verdict;
    use crate::checks::planted::{Planted, violated};
    use crate::params::preset;

    fn on(printer: &str) -> Planted {
        let printer = preset::printers().remove(printer).expect("a printer");
        Planted::frame(|frame| frame.printer = printer)
    }

    fn warnings(found: &[Finding]) -> Vec<&Finding> {
        found.iter().filter(|f| f.verdict == Verdict::Note && f.margin < 0.0).collect()
    }

    #[test]
    fn analytic_a_hot_and_enclosed_printer_and_one_that_states_nothing() {
        let found = on("bambu-p1s").found(check);
        assert_eq!((violated(&found), warnings(&found).len()), (Vec::new(), 0), "{found:?}");
        assert_eq!(found.len(), 6);
        assert_eq!(on("generic-0.4").found(check), []);
    }

    #[test]
    fn planted_abs_on_printers_that_are_too_cold_for_it() {
        let mut frame = on("ender-3");
        let warned = frame.found(check);
        let subjects: Vec<&str> = warnings(&warned).iter().map(|f| f.subject.as_str()).collect();
        assert_eq!((violated(&warned), subjects), (Vec::new(), vec!["abs nozzle", "abs enclosure"]), "{warned:?}");
        frame.design.frame.printer.most_nozzle_c = Some(235.0);
        let found = frame.found(check);
        let refused = violated(&found);
        assert_eq!(refused.iter().map(|f| f.subject.as_str()).collect::<Vec<_>>(), ["abs nozzle"]);
        let message = &refused[0].message;
        assert!(message.contains("pla at 210 °C (+") && message.contains("softens at 55 instead of 90 °C"), "{message}");
        frame.design.frame.printer.most_nozzle_c = Some(190.0);
        let all = violated(&frame.found(check));
        assert_eq!(all.iter().map(|f| f.subject.as_str()).collect::<Vec<_>>(), ["tpu-95a nozzle", "abs nozzle"]);
    }

    /// Whatever its profile sets, and where it has none.
    #[test]
    fn planted_a_printer_below_the_least_heat_of_a_material_is_refused() {
        for (nozzle_c, least_c) in [(None, 300.0), (Some(230.0), 260.0), (Some(280.0), 250.0)] {
            let mut frame = on("ender-3");
            let material = &mut frame.design.frame.rigid.material;
            (material.nozzle_c, material.least_nozzle_c) = (nozzle_c, Some(least_c));
            let refused = violated(&frame.found(check));
            assert_eq!(refused.iter().map(|f| f.subject.as_str()).collect::<Vec<_>>(), ["abs nozzle"], "{nozzle_c:?}, {least_c}");
        }
    }

    #[test]
    fn analytic_the_offer_weighs_what_the_frame_would() {
        let frame = on("ender-3");
        let offered = crate::printing::heat::instead(&frame.design);
        assert_eq!(offered.iter().map(|offer| offer.name).collect::<Vec<_>>(), ["pla", "petg"]);
        for offer in offered {
            let material = preset::materials().remove(offer.name).expect("a material");
            let other = Planted::frame(|frame| frame.rigid.material = material);
            let heavier_g = other.masses.total_g - frame.masses.total_g;
            assert!((offer.heavier_g - heavier_g).abs() < 1e-6, "{}: {} and {heavier_g}", offer.name, offer.heavier_g);
        }
    }
}
