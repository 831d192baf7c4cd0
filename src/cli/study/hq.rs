//! Rows on a cluster, by HyperQueue: one job with a task a block of rows.
//!
//! A task writes its rows as one file into the folder `blocks` beside the journal, on a file system that all nodes see. There are
//! at most a thousand such files at a time, more only where rows that are done lie between the missing ones, and none when the study is done: their rows
//! are gathered into the journal. A task that a worker or the server loses is begun again by HyperQueue, or by the next run, and writes the same.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::journal_file::JournalFile;
use crate::cli::failure::Failure;
use crate::cli::options::Common;
use crate::cli::output;
use crate::cli::terminal;
use crate::study::{Journal, Outcomes, Study};

/// Most files of blocks at a time, where no row between them is done: what a shared file system lists without effort.
const MOST_BLOCKS: usize = 1000;
/// Exit code of a client whose work is done.
const GOOD: i32 = 0;
/// What counts as the exit code of one that a signal ended.
const BY_SIGNAL: i32 = -1;
/// Exit code of the client in Python where its module is not there.
const NO_MODULE: i32 = 67;
/// The same where no server is.
const NO_SERVER: i32 = 68;
/// The client of HyperQueue for machines that have its Python module instead of its program.
const CLIENT: &str = include_str!("hyperqueue.py");

/// First row and the row after the last, as `0-50`.
pub(super) fn block(text: &str) -> Result<(usize, usize), String> {
    let wrong = || format!("{text:?} is no block: give FIRST-END, such as 0-50");
    let (first, end) = text.trim().split_once('-').ok_or_else(wrong)?;
    Ok((first.parse().map_err(|_| wrong())?, end.parse().map_err(|_| wrong())?))
}

/// The name of a block's file.
pub(super) fn file_of((first, end): (usize, usize)) -> String {
    format!("{first}-{end}.jsonl")
}

fn blocks_of(folder: &Path) -> PathBuf {
    folder.join("blocks")
}

/// The blocks of a job, a line each.
fn list_of(folder: &Path) -> PathBuf {
    folder.join("blocks.txt")
}

/// Submits the rows that are missing, waits for them, and gathers them.
pub(super) fn run(
    plan: &str,
    folder: &Path,
    study: &Study,
    journal: &mut JournalFile,
    size: usize,
    common: &Common,
) -> Result<(), Failure> {
    let missing = blocks(&journal.outcomes.missing(), size);
    if missing.is_empty() {
        return Ok(());
    }
    let machine = |what: String| move |error: io::Error| Failure::Machine { what, error };
    let into = blocks_of(folder);
    fs::create_dir_all(&into).map_err(machine(format!("cannot make the folder {}", into.display())))?;
    let absolute = |path: &Path| std::path::absolute(path).map_err(machine(format!("cannot name {}", path.display())));
    let program = std::env::current_exe().map_err(machine("cannot find this program".into()))?;
    let task: Vec<String> = [program, "study".into(), "block".into(), absolute(Path::new(plan))?, "--into".into(), absolute(&into)?]
        .iter()
        .map(|word: &PathBuf| word.display().to_string())
        .collect();
    let entries: String = missing.iter().map(|(first, end)| format!("{first}-{end}\n")).collect();
    let list = list_of(folder);
    output::replace_file(&list, entries.as_bytes()).map_err(machine(format!("cannot write {}", list.display())))?;
    let name = format!("flexframe-{}", study.name);
    let submitted = submit(&name, &list, &task, common);
    gather(folder, study, journal)?;
    let ended = submitted?;
    let left = journal.outcomes.missing().len();
    if ended && left == 0 {
        return Ok(());
    }
    let error = io::Error::other(format!("{left} rows are missing; `hq job list --all` says why, and another run goes on"));
    Err(Failure::Machine { what: "not every task of the study has ended well".into(), error })
}

/// Hands the tasks to HyperQueue and waits; whether all ended well.
fn submit(name: &str, list: &Path, task: &[String], common: &Common) -> Result<bool, Failure> {
    let mut info = Command::new("hq");
    info.args(["server", "info"]).stdout(Stdio::null()).stderr(Stdio::null());
    match ended(info)? {
        Some(GOOD) => {
            let mut hq = Command::new("hq");
            hq.args(["submit", "--wait", "--name", name, "--cpus", "1", "--stdout", "none", "--stderr", "none", "--each-line"]);
            hq.arg(list).arg("--").args(task);
            return Ok(ended(of_job(hq, common))? == Some(GOOD));
        }
        Some(_) => return Err(no_server()),
        None => {}
    }
    let mut python = Command::new("python3");
    python.args(["-c", CLIENT, name]).arg(list).args(task);
    match ended(of_job(python, common))? {
        None | Some(NO_MODULE) => {
            let message = "--engine hq takes the program `hq`, or Python 3 with the module `hyperqueue` (pip install hyperqueue); \
                           docs/studies.md says how to get them";
            Err(Failure::Usage { message: message.into() })
        }
        Some(NO_SERVER) => Err(no_server()),
        Some(code) => Ok(code == GOOD),
    }
}

/// A client as a job has it: one core a task, and no output that is not asked for.
fn of_job(mut client: Command, common: &Common) -> Command {
    client.env("RAYON_NUM_THREADS", "1");
    if common.quiet || common.json {
        client.stdout(Stdio::null());
    }
    client
}

/// Runs a client; its exit code, or none where there is no such program.
fn ended(mut client: Command) -> Result<Option<i32>, Failure> {
    match client.stdin(Stdio::null()).status() {
        Ok(status) => Ok(Some(status.code().unwrap_or(BY_SIGNAL))),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Failure::Machine { what: "cannot run the client of HyperQueue".into(), error }),
    }
}

fn no_server() -> Failure {
    let place = std::env::var_os("HQ_SERVER_DIR")
        .filter(|name| !name.is_empty())
        .map_or_else(|| "~/.hq-server".into(), |folder| PathBuf::from(folder).display().to_string());
    let message = format!(
        "--engine hq: no HyperQueue server of this client's version answers at {place}; start one with `hq server start`, or name its folder \
         by HQ_SERVER_DIR"
    );
    Failure::Usage { message }
}

/// Blocks of rows that follow each other: of the wanted size, or larger when there would be too many files.
fn blocks(rows: &[usize], size: usize) -> Vec<(usize, usize)> {
    let size = size.max(rows.len().div_ceil(MOST_BLOCKS));
    let mut blocks: Vec<(usize, usize)> = Vec::new();
    for row in rows {
        match blocks.last_mut() {
            Some((first, end)) if *end == *row && *end - *first < size => *end += 1,
            _ => blocks.push((*row, row + 1)),
        }
    }
    blocks
}

/// Takes the rows of finished blocks into the journal, and removes their files, and the list of the job. Files of another plan or program
/// are of no use, and removed, too: this says how many there were.
pub(super) fn gather(folder: &Path, study: &Study, journal: &mut JournalFile) -> Result<(), Failure> {
    // That there is none, or that it cannot be removed, changes nothing.
    let _ = fs::remove_file(list_of(folder));
    let (into, mut foreign) = (blocks_of(folder), 0);
    let Ok(listed) = fs::read_dir(&into) else { return Ok(()) };
    let is_block = |path: &PathBuf| {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        name.strip_suffix(".jsonl").is_some_and(|name| block(name).is_ok())
    };
    let mut files: Vec<PathBuf> = listed.filter_map(|entry| Some(entry.ok()?.path())).filter(is_block).collect();
    files.sort();
    for path in files {
        let machine = |error| Failure::Machine { what: format!("cannot take in {}", path.display()), error };
        let text = fs::read(&path).map_err(machine)?;
        match Journal::read(study, &text) {
            Ok(block) => take(&block.outcomes, journal)?,
            Err(_) => foreign += 1,
        }
        fs::remove_file(&path).map_err(machine)?;
    }
    if foreign > 0 {
        let (blocks, are) = if foreign == 1 { ("block", "was") } else { ("blocks", "were") };
        let message = format!(
            "note: {foreign} {blocks} of rows in {} {are} removed: of another plan, base or version of the program, or damaged; missing rows are \
             evaluated again",
            into.display()
        );
        terminal::tell(&message);
    }
    // A folder in which something else lies stays.
    let _ = fs::remove_dir(&into);
    Ok(())
}

/// Takes the rows that a journal lacks.
fn take(block: &Outcomes, journal: &mut JournalFile) -> Result<(), Failure> {
    for row in journal.outcomes.missing() {
        if let Some(outcome) = block.of(row) {
            journal.keep(row, outcome.clone())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn analytic_blocks_are_read_as_they_are_written() {
        assert_eq!(block("0-50\n"), Ok((0, 50)));
        assert_eq!(file_of((0, 50)), "0-50.jsonl");
        for wrong in ["", "5", "a-b", "-1-3", "1-"] {
            assert!(block(wrong).is_err(), "{wrong}");
        }
    }

    proptest! {
        #[test]
        fn analytic_blocks_hold_every_row_once(rows in prop::collection::btree_set(0_usize..5000, 0..400), size in 1_usize..60) {
            let rows: Vec<usize> = rows.into_iter().collect();
            let blocks = blocks(&rows, size);
            let held: Vec<usize> = blocks.iter().flat_map(|(first, end)| *first..*end).collect();
            prop_assert_eq!(held, rows);
            prop_assert!(blocks.iter().all(|(first, end)| end - first <= size));
        }
    }
}
