//! Which study, and where its results are.

use std::path::{Path, PathBuf};

use crate::cli::candidates;
use crate::cli::failure::Failure;
use crate::params::files::Disk;
use crate::study::{self, Study};

/// Which study, and where its results are.
#[derive(Debug, clap::Args)]
pub(super) struct StudyOption {
    /// The plan: a TOML file.
    #[arg(value_name = "PLAN", add = candidates::toml_files())]
    pub plan: String,
    /// Folder in which to write the folder `study-PLAN`.
    #[arg(short, long, default_value = "out", value_name = "DIR")]
    pub output: PathBuf,
}

impl StudyOption {
    /// Reads the plan.
    pub fn load(&self) -> Result<Study, Failure> {
        load(&self.plan)
    }

    /// The folder of its results.
    pub fn folder(&self, study: &Study) -> PathBuf {
        self.output.join(format!("study-{}", study.name))
    }
}

/// Reads a plan.
pub(super) fn load(plan: &str) -> Result<Study, Failure> {
    if !plan.ends_with(".toml") {
        return Err(Failure::Usage { message: format!("{plan} is no plan of a study: give a TOML file") });
    }
    Ok(study::load(plan, &Disk)?)
}

/// The journal of a study's rows in the folder of its results.
pub(super) fn journal_of(folder: &Path) -> PathBuf {
    folder.join("rows.jsonl")
}

/// The table of a study, in the folder of its results.
pub(super) const TABLE: &str = "study.csv";
/// The same as Parquet.
pub(super) const PARQUET_TABLE: &str = "study.parquet";
/// The folder of its report.
pub(super) const REPORT: &str = "report";
