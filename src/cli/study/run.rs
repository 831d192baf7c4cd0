//! `flexframe study run`.

use std::ops::ControlFlow;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use super::journal_file::JournalFile;
use super::study_option::{PARQUET_TABLE, REPORT, StudyOption, TABLE, journal_of};
use super::{hq, local};
use crate::cli::bounded;
use crate::cli::failure::Failure;
use crate::cli::interrupt::Finishing;
use crate::cli::options::Common;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::terminal;
use crate::study::{Study, csv};

/// Evaluate the rows that are missing, and write the table when none is.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    study: StudyOption,
    /// Where the rows are evaluated.
    #[arg(long, value_enum, default_value_t = Engine::Local)]
    engine: Engine,
    /// Time limit on this machine, such as 90s, 10m or 2h; a later run continues.
    #[arg(long, value_name = "TIME", value_parser = bounded::duration)]
    budget: Option<Duration>,
    /// Discard the existing rows.
    #[arg(long)]
    restart: bool,
    /// Cores of this machine that are used [default: all].
    #[arg(long, value_name = "N", value_parser = bounded::count([1, 1024]))]
    cores: Option<usize>,
    /// With --engine hq: number of rows of a task.
    #[arg(long, value_name = "ROWS", default_value = "50", value_parser = bounded::count([1, 1_000_000]))]
    block: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Engine {
    /// The cores of this machine.
    Local,
    /// A HyperQueue server that is running: the program `hq`, or else Python's module `hyperqueue`.
    Hq,
}

pub(super) fn run(args: &Args, common: &Common) -> Result<ExitCode, Failure> {
    if args.engine == Engine::Hq && (args.budget.is_some() || args.cores.is_some()) {
        let message = "--budget and --cores are of this machine: with --engine hq the server and its workers decide";
        return Err(Failure::Usage { message: message.into() });
    }
    let study = args.study.load()?;
    let folder = args.study.folder(&study);
    let failed = |error| Failure::Machine { what: format!("cannot make the folder {}", folder.display()), error };
    std::fs::create_dir_all(&folder).map_err(failed)?;
    let mut journal = JournalFile::open(&journal_of(&folder), &study, args.restart)?;
    if journal.outcomes.known() == 0 {
        // Where no row is known, a table and a report are of another plan.
        output::remove_result(&folder, &[TABLE, PARQUET_TABLE])?;
        output::remove_result(&folder.join(REPORT), &[])?;
    }
    hq::gather(&folder, &study, &mut journal)?;
    let before = journal.outcomes.known();
    let begun = Instant::now();
    let interrupted = match args.engine {
        Engine::Local => on_this_machine(args, &study, &mut journal, common)?,
        Engine::Hq => {
            hq::run(&args.study.plan, &folder, &study, &mut journal, args.block, common)?;
            None
        }
    };
    let spent = begun.elapsed();
    let whole = journal.outcomes.known() == study.rows();
    if whole {
        output::write_result(&folder, &tables(&study, &journal)?)?;
    }
    let table = folder.join(TABLE);
    tell(&study, &journal, whole.then_some(&*table), before, spent, common)?;
    Ok(interrupted.filter(|_| !whole).map_or(ExitCode::SUCCESS, ExitCode::from))
}

/// The table as CSV, and, where this program can, as Parquet.
fn tables(study: &Study, journal: &JournalFile) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let csv = csv(study, &journal.outcomes)?;
    let tables = vec![(TABLE.to_string(), csv.into_bytes())];
    #[cfg(feature = "parquet")]
    let tables = {
        let failed = |error| Failure::Machine { what: "cannot make the Parquet table".into(), error: std::io::Error::other(error) };
        let parquet = crate::study::parquet(study, &journal.outcomes).map_err(failed)?;
        [tables, vec![(PARQUET_TABLE.to_string(), parquet)]].concat()
    };
    Ok(tables)
}

/// Evaluates what is missing; the exit code of an interruption where there was one.
fn on_this_machine(args: &Args, study: &Study, journal: &mut JournalFile, common: &Common) -> Result<Option<u8>, Failure> {
    let missing = journal.outcomes.missing();
    let progress = Progress::staged("rows", study.rows(), common);
    let (finishing, begun) = (Finishing::begin(), Instant::now());
    let cores = args.cores.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let mut done = 0;
    local::evaluate(study, &missing, cores, |row, outcome| {
        journal.keep(row, outcome)?;
        done += 1;
        let rate = done as f64 / begun.elapsed().as_secs_f64();
        let left_s = (missing.len() - done) as f64 / rate;
        let refused = journal.outcomes.refused();
        progress.stage(study.rows() - missing.len() + done, format!("{rate:.1} a second, {left_s:.0} s left, {refused} refused"));
        let too_late = args.budget.is_some_and(|budget| begun.elapsed() >= budget);
        Ok(if too_late || finishing.is_asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    })?;
    Ok(finishing.exit_code())
}

fn tell(
    study: &Study,
    journal: &JournalFile,
    table: Option<&Path>,
    before: usize,
    spent: Duration,
    common: &Common,
) -> Result<(), Failure> {
    let (known, refused, rows) = (journal.outcomes.known(), journal.outcomes.refused(), study.rows());
    if common.json {
        return terminal::print_json(&serde_json::json!({
            "schema_version": 1,
            "study": study.name,
            "rows": rows,
            "known": known,
            "evaluated": known - before,
            "refused": refused,
            "table": table.map(|path| path.display().to_string()),
        }));
    }
    if common.quiet {
        return Ok(());
    }
    let rate = if known > before { format!(", {:.2} s a row", spent.as_secs_f64() / (known - before) as f64) } else { String::new() };
    let end = match table {
        Some(table) => format!("{}: written\n", table.display()),
        None => format!("{} of {rows} rows are missing: run it again to go on\n", rows - known),
    };
    terminal::print(&format!("{} rows evaluated{rate}; {known} of {rows} known, {refused} refused\n{end}", known - before))
}
