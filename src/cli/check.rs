//! `flexframe check`: the gate.

use std::process::ExitCode;

use super::arguments::{CheckOptions, Common};
use super::progress::Progress;
use super::session::{self, Failure};
use super::table;
use crate::assembly::mass;
use crate::checks::{self, Tightest, Verdict};

/// Prints the findings; exits 1 when a limit is violated.
pub(super) fn check(options: &CheckOptions, common: &Common) -> Result<ExitCode, Failure> {
    let working = Progress::of("checking", common);
    let design = session::design(&options.frame)?;
    let masses = mass::table(&design);
    let findings = checks::check(&design, &masses);
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
        let text = serde_json::to_string_pretty(&report)
            .map_err(|error| Failure::Machine { what: "cannot print the findings".into(), error: error.into() })?;
        println!("{text}");
    } else if !common.quiet {
        let every = findings.iter().map(|finding| Tightest { finding, of: 1 }).collect();
        print!("{}", table::findings(&if options.all { every } else { checks::tightest(&findings) }));
        println!("{}: {:.1} g; {violated} of {} findings violate a limit", design.frame.name, masses.total_g, findings.len());
    }
    if common.quiet && !common.json {
        for finding in findings.iter().filter(|finding| finding.verdict == Verdict::Violated) {
            eprintln!("{}", finding.message);
        }
    }
    Ok(if violated > 0 { ExitCode::from(1) } else { ExitCode::SUCCESS })
}
