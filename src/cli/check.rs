//! `flexframe check`: the gate.

use std::process::ExitCode;

use super::arguments::{CheckOptions, Common};
use super::progress::Progress;
use super::session::{self, Failure};
use super::stiffness::refused;
use super::{table, terminal};
use crate::assembly::mass;
use crate::checks::{self, Tightest, Verdict};
use crate::mechanics::prediction::predict;
use crate::mechanics::settings::Settings;

/// Prints the findings; exits 1 when a limit is violated.
pub(super) fn check(options: &CheckOptions, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("checking", common);
    let design = session::design(&options.frame)?;
    let masses = mass::table(&design);
    let mut findings = checks::check(&design, &masses);
    if options.strength {
        let settings = Settings::load(options.mechanics.as_deref())?;
        let found = predict(&design, &masses, &settings).map_err(refused)?;
        findings.extend(checks::strength(&design, &settings.limits, &found));
    }
    drop(working);
    let violated = findings.iter().filter(|finding| finding.verdict == Verdict::Violated).count();
    if common.json {
        let report = serde_json::json!({
            "schema_version": 1,
            "frame": design.frame.name,
            "violations": violated,
            "findings": findings,
            "masses": masses,
        });
        terminal::print_json(&report)?;
    } else if !common.quiet {
        let every = findings.iter().map(|finding| Tightest { finding, of: 1 }).collect();
        let (frame, mass_g, count) = (&design.frame.name, masses.total_g, findings.len());
        let table = table::findings(&if options.all { every } else { checks::tightest(&findings) });
        terminal::print(&format!("{table}{frame}: {mass_g:.1} g; {violated} of {count} findings violate a limit\n"))?;
    }
    if common.quiet && !common.json {
        for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Violated) {
            terminal::tell(&finding.message);
        }
    }
    Ok(if violated > 0 { ExitCode::from(1) } else { ExitCode::SUCCESS })
}
