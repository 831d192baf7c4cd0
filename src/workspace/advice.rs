//! What a person reads of the remedies for what is violated.
//!
//! A change that takes back what the user's file asks for comes last, and is called so; before it stands what follows from the wish (`wishes`). Of
//! warnings those are looked at that another choice of material or printer clears.

use std::sync::Arc;

use super::bench::Bench;
use super::remedy::{alike, asks};
use crate::checks::Finding;
use crate::memo::Memo;
use crate::params::FrameFile;

/// Groups of violations that are looked at; the first are the report's first.
const GROUPS: usize = 8;

/// What a person reads of the remedies for each finding, in their order: empty for what is not violated, or was not looked at.
pub fn advice(file: &FrameFile, findings: &[Finding], memo: &Arc<Memo>) -> Vec<String> {
    let Some(bench) = Bench::new(file, memo).filter(|_| findings.iter().any(asks)) else {
        return vec![String::new(); findings.len()];
    };
    let (mut groups, mut told): (Vec<(&Finding, String)>, Vec<String>) = (Vec::new(), Vec::new());
    for finding in findings {
        let known = groups.iter().find(|(known, _)| alike(known, finding)).map(|(_, text)| text.clone());
        told.push(match known {
            _ if !asks(finding) || !bench.sees(finding) => String::new(),
            Some(text) => text,
            None if groups.len() >= GROUPS => not_looked_at(finding),
            None => {
                let text = bench.sentence(finding);
                groups.push((finding, text.clone()));
                text
            }
        });
    }
    told
}

/// What is said of a violation beyond the groups that are looked at.
fn not_looked_at(finding: &Finding) -> String {
    let levers = if finding.levers.is_empty() { String::new() } else { format!("driven by {}; ", finding.levers.join(", ")) };
    format!("{levers}no remedy was looked for: it is for the first {GROUPS} kinds of violation, ask again when these are mended")
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use super::super::remedy::Remedy;
    use super::*;
    use crate::checks::Verdict;
    use crate::params::frame_file::Value;

    /// Parts and findings of the tests: they look at much the same frames.
    static MEMO: LazyLock<Arc<Memo>> = LazyLock::new(Arc::default);

    /// The file with a remedy in it.
    fn mended(file: &FrameFile, remedy: &Remedy) -> FrameFile {
        let value = remedy.to.parse().map_or_else(|_| Value::Text(remedy.to.clone()), Value::Number);
        let mut file = file.clone();
        file.set(&remedy.key, value);
        file
    }

    /// Each remedy for the first violation of a rule, applied, clears it; the keys.
    fn keys(text: &str, rule: &str) -> Vec<String> {
        let file = FrameFile::parse("own.toml", text).expect("reads");
        let bench = Bench::new(&file, &MEMO).expect("can be designed");
        let violated = |found: &[Finding], of: &Finding| found.iter().any(|f| f.verdict == Verdict::Violated && alike(f, of));
        let broken = bench.found.iter().find(|f| f.rule == rule && f.verdict == Verdict::Violated).expect("is violated");
        let remedies = bench.remedies(broken);
        for remedy in &remedies {
            let mended = mended(&file, remedy);
            let after = Bench::new(&mended, &MEMO).expect("can be designed");
            assert!(!violated(&after.found, broken), "{remedy}");
            assert!((after.mass_g - bench.mass_g - remedy.heavier_g).abs() < 1e-6, "{remedy}");
        }
        remedies.into_iter().map(|remedy| remedy.key).collect()
    }

    #[test]
    fn planted_rods_of_4_mm_ask_for_a_wider_cheek_gap() {
        let narrow = "base = \"cognifly\"\nbought.rod = \"rod-carbon-4\"\n[fork]\nfork_bar_height_mm = 5.6\nfork_cheek_gap_mm = 6.13\n";
        let found = keys(narrow, "interference");
        assert!(found.contains(&"fork.fork_cheek_gap_mm".to_string()), "{found:?}");
    }

    /// A camera of 40 mm height meets five bodies, and the plate most of all, until it stands 22 mm above it: the joint that is asked about first
    /// is clear before.
    #[test]
    fn regress_a_key_that_clears_the_worst_of_a_kind_last_is_named() {
        let board = "base = \"cognifly\"\n[bought]\ncomputer = \"none\"\ncamera = \"none\"\nfpv_camera = \"own\"\n[override.parts.own]\n\
                     kind = \"fpv_camera\"\nsize_mm = [27, 40.5, 15]\nmass_g = 10\nmass_basis = \"datasheet\"\nsource = \"its maker\"\n";
        let found = keys(board, "interference");
        assert!(found.contains(&"accessories.fpv_above_mm".to_string()), "{found:?}");
    }

    /// What a person reads of the remedies of the first violation of a rule.
    fn told(text: &str, rule: &str) -> String {
        let file = FrameFile::parse("own.toml", text).expect("reads");
        let bench = Bench::new(&file, &MEMO).expect("can be designed");
        let finding = bench.found.iter().find(|f| f.rule == rule && asks(f)).expect("is found");
        bench.sentence(finding)
    }

    #[test]
    fn planted_a_wish_is_kept_by_another_base_or_by_what_moves_with_it() {
        let propeller = told("base = \"cognifly\"\nbought.propeller = \"propeller-4-inch\"\n", "propeller_clearance");
        assert!(propeller.starts_with("to keep what the file asks for: base = \"cognifly-1106\" keeps every limit"), "{propeller}");
        assert!(!propeller.contains("propeller-3-inch"), "{propeller}");
        let long = told("base = \"cognifly\"\nrods.cage_side_ratio = 1.15\n", "envelope");
        assert!(long.contains("rods.cage_rod_length_mm 192") && long.contains("together keep every limit"), "{long}");
        assert!(!long.contains("cage_side_ratio"), "{long}");
    }

    /// A longer strut lifts the battery, and the frame beyond its height.
    #[test]
    fn planted_a_battery_that_is_too_high_keeps_its_longer_struts_in_sight() {
        let own = "base = \"cognifly\"\nbought.battery = \"own\"\n[override.parts.own]\nkind = \"battery\"\nsize_mm = [75, 35, 28]\n\
                   mass_g = 95\nmass_basis = \"measured\"\nsource = \"own\"\ncells = 3\ncapacity_mah = 1000\n";
        let told = told(own, "ground_clearance");
        assert!(told.starts_with("rods.strut_rod_length_mm 50.03 -> ") && told.contains("but breaks envelope"), "{told}");
        assert!(told.contains("; or, against what the file asks for: bought.battery own -> "), "{told}");
    }

    #[test]
    fn planted_a_warning_of_heat_names_another_material_and_another_printer() {
        let heat = told("base = \"cognifly\"\nprinter = \"ender-3\"\n", "printer_heat");
        assert!(heat.starts_with("materials.rigid abs -> pla clears it (+5.5 g)") && heat.contains("; or printer ender-3 -> "), "{heat}");
        // A printer that states no heat is not known to be hot enough.
        assert!(!heat.contains("generic"), "{heat}");
    }

    /// The skirt of its mount cannot be thicker beside the motor's screws.
    #[test]
    fn planted_a_wall_that_is_too_thin_for_a_wide_nozzle_asks_for_another_printer() {
        let wide = "base = \"cognifly\"\nprinter = \"generic-0.4\"\n[override.printers.\"generic-0.4\"]\nnozzle_mm = 0.6\n";
        assert_eq!(keys(wide, "thinnest_wall").last().map(String::as_str), Some("printer"));
    }

    #[test]
    fn analytic_what_is_not_looked_at_says_so_with_its_levers() {
        let file = FrameFile::load("cognifly").expect("a preset");
        let bench = Bench::new(&file, &MEMO).map(|bench| bench.found).expect("can be designed");
        let mut finding = bench.into_iter().find(|f| f.rule == "envelope").expect("is looked at");
        finding.levers = vec!["a.b".into(), "c.d".into()];
        assert!(not_looked_at(&finding).starts_with("driven by a.b, c.d; no remedy was looked for"));
        finding.levers.clear();
        assert!(not_looked_at(&finding).starts_with("no remedy was looked for"));
    }

    /// The diameter is that of the propeller which is bought, unless the file states its own.
    #[test]
    fn planted_a_propeller_that_is_too_large_is_replaced_by_a_smaller_one() {
        let chosen = "base = \"cognifly\"\nbought.propeller = \"propeller-4-inch\"\n";
        assert_eq!(keys(chosen, "propeller_clearance").first().map(String::as_str), Some("bought.propeller"));
        let stated = "base = \"cognifly\"\nmotor_mount.propeller_diameter_mm = 101.6\n";
        let found = keys(stated, "propeller_clearance");
        assert!(
            found.contains(&"motor_mount.propeller_diameter_mm".to_string()) && !found.contains(&"bought.propeller".into()),
            "{found:?}"
        );
    }

    /// Its last step, to 103 mm, leaves no frame; from 92 mm on the propellers are clear.
    #[test]
    fn planted_a_motor_position_short_of_where_there_is_no_frame() {
        let wide = "base = \"cognifly\"\nbought.propeller = \"propeller-4-inch\"\nbought.motor = \"motor-1404\"\n\
                    [target]\nwidth_mm = 300\nheight_mm = 140\nstrut_tilt_deg = 24\n\
                    [limits]\nenvelope_width_mm = 300\nenvelope_height_mm = 140\nmass_budget_g = 350\n";
        let told = told(wide, "propeller_clearance");
        assert!(told.starts_with("motor_mount.motor_position_mm 78 -> 91.") && !told.contains("bought.propeller"), "{told}");
    }

    /// Rods that follow from a target size are not changed: the size is.
    #[test]
    fn planted_a_target_size_is_what_is_changed_in_place_of_its_rods() {
        let high = "base = \"cognifly\"\n[target]\nwidth_mm = 205\nheight_mm = 124\nstrut_tilt_deg = 24\n";
        assert_eq!(keys(high, "envelope"), ["target.height_mm"]);
        let low =
            "base = \"cognifly\"\n[target]\nwidth_mm = 205\nheight_mm = 104\nstrut_tilt_deg = 24\n[limits]\nground_clearance_mm = 12\n";
        let found = keys(low, "ground_clearance");
        assert!(!found.is_empty() && found.iter().all(|key| !key.starts_with("rods.")), "{found:?}");
    }

    #[test]
    fn analytic_nothing_is_said_of_a_frame_that_keeps_its_limits() {
        let file = FrameFile::load("cognifly").expect("a preset");
        let bench = Bench::new(&file, &MEMO).expect("can be designed");
        assert!(advice(&file, &bench.found, &MEMO).iter().all(String::is_empty));
    }
}
