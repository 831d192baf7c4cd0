//! Files of a result in a folder that is not replaced as a whole, because it holds something that grows: the journal of a study.

use std::fs;
use std::io;
use std::path::Path;

use super::file::replace_file;
use super::folder::{self, Entry};
use super::kept;
use super::record::{RECORD, Record, content};
use crate::cli::failure::{Failure, failed};
use crate::cli::interrupt::Step;
use crate::cli::terminal;

/// Writes files beside others, each in one step; one that is as it should be is left alone. A file in their place that the program did
/// not write, or that was changed since, gets another name.
///
/// # Errors
/// [`Failure::Machine`] when something cannot be written.
pub(in crate::cli) fn write_result(folder: &Path, files: &[(String, Vec<u8>)]) -> Result<(), Failure> {
    let _step = Step::begin();
    let is_there = |name: &str, bytes: &[u8]| content(&folder.join(name)).is_ok_and(|found| found == *bytes);
    let record = Record::read(folder);
    for (name, _) in files.iter().filter(|(name, bytes)| !is_there(name, bytes)) {
        set_aside(folder, Path::new(name), &record)?;
    }
    let on_list = |list: io::Result<Vec<u8>>| list.map_err(failed("write", &folder.join(RECORD))).map(|bytes| (RECORD.to_string(), bytes));
    // A list of old and new files first: a run that is killed leaves nothing of its own that is not on it.
    let before = on_list(record.while_replaced_by(files))?;
    let after = on_list(Record::list_of(files))?;
    let is_whole = files.iter().chain([&after]).all(|(name, bytes)| is_there(name, bytes));
    for (name, bytes) in [&before].into_iter().chain(files).chain([&after]).filter(|(name, bytes)| !is_whole && !is_there(name, bytes)) {
        let place = folder.join(name);
        replace_file(&place, bytes).map_err(failed("write", &place))?;
    }
    Ok(())
}

/// Removes what the program wrote into a folder, and the folder when it is empty then. What was changed since gets another name, and so
/// do files of these names that the program did not write; all else stays as it is.
///
/// # Errors
/// [`Failure::Machine`] when something cannot be removed.
pub(in crate::cli) fn remove_result(folder: &Path, names: &[&str]) -> Result<(), Failure> {
    let _step = Step::begin();
    let record = Record::read(folder);
    let entries = match folder::entries(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        found => found.map_err(failed("read", folder))?,
    };
    let list = Path::new(RECORD);
    let is_of_result = |path: &Path| path != list && (record.names(path) || names.iter().any(|name| Path::new(name) == path));
    for Entry { path, .. } in entries.iter().filter(|entry| is_of_result(&entry.path)) {
        match record.is_ours(folder, path) {
            true => fs::remove_file(folder.join(path)).map_err(failed("remove", &folder.join(path)))?,
            false => set_aside(folder, path, &record)?,
        }
    }
    if record.is_ours(folder, list) {
        fs::remove_file(folder.join(list)).map_err(failed("remove", &folder.join(list)))?;
    }
    for Entry { path, .. } in entries.iter().rev().filter(|entry| entry.is.is_dir() && record.made_folder(&entry.path)) {
        // One in which something lies stays.
        let _ = fs::remove_dir(folder.join(path));
    }
    let _ = fs::remove_dir(folder);
    Ok(())
}

/// Gives another name to what is in a place and is not as the program wrote it; says so.
fn set_aside(folder: &Path, path: &Path, record: &Record) -> Result<(), Failure> {
    let is_free = |path: &Path| folder.join(path).symlink_metadata().is_err();
    if is_free(path) || record.is_ours(folder, path) {
        return Ok(());
    }
    let to = kept::names(path).find(|name| is_free(name)).unwrap_or_else(|| path.to_path_buf());
    fs::rename(folder.join(path), folder.join(&to)).map_err(failed("replace", &folder.join(path)))?;
    terminal::tell(&format!("note: {}", kept::note(folder, path, &to, record.names(path))));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(text: &str) -> Vec<(String, Vec<u8>)> {
        vec![("study.csv".into(), text.as_bytes().to_vec())]
    }

    /// Killed before its files are written, or between two of them.
    #[test]
    fn planted_what_an_interrupted_run_left_is_nobody_elses() {
        let two = |text: &str| ["a.csv", "b.csv"].map(|name| (name.to_string(), text.as_bytes().to_vec())).to_vec();
        for written in 0..=2 {
            let folder = tempfile::tempdir().expect("a folder");
            let folder = folder.path();
            write_result(folder, &two("1")).expect("can be written");
            let list = Record::read(folder).while_replaced_by(&two("2")).expect("can be listed");
            fs::write(folder.join(RECORD), list).expect("can be written");
            for (name, bytes) in &two("2")[..written] {
                fs::write(folder.join(name), bytes).expect("can be written");
            }
            write_result(folder, &two("3")).expect("can be written");
            let found = folder::entries(folder).expect("can be read");
            assert_eq!(found.iter().map(|entry| entry.path.display().to_string()).collect::<Vec<_>>(), [RECORD, "a.csv", "b.csv"]);
            assert_eq!(fs::read(folder.join(RECORD)).expect("is there"), Record::list_of(&two("3")).expect("can be listed"));
        }
    }

    #[test]
    fn planted_only_what_the_program_wrote_is_replaced_or_removed() {
        let folder = tempfile::tempdir().expect("a folder");
        let (folder, path) = (folder.path(), |name: &str| folder.path().join(name));
        let read = |name: &str| fs::read_to_string(path(name)).unwrap_or_default();
        fs::write(path("study.csv"), "theirs").expect("can be written");
        fs::write(path("rows.jsonl"), "grows").expect("can be written");
        write_result(folder, &written("1")).expect("can be written");
        write_result(folder, &written("2")).expect("can be written");
        assert_eq!([read("study.csv"), read("study.csv.yours")], ["2", "theirs"]);
        fs::write(path("study.csv"), "changed").expect("can be written");
        write_result(folder, &written("2")).expect("can be written");
        assert_eq!([read("study.csv"), read("study.csv.yours"), read("study.csv.yours-2")], ["2", "theirs", "changed"]);
        fs::write(path("study.parquet"), "theirs").expect("can be written");
        remove_result(folder, &["study.csv", "study.parquet"]).expect("can be removed");
        let mut left: Vec<_> = fs::read_dir(folder).expect("is there").map(|entry| entry.expect("is there").file_name()).collect();
        left.sort();
        assert_eq!(left, ["rows.jsonl", "study.csv.yours", "study.csv.yours-2", "study.parquet.yours"]);
    }
}
