//! Folders of a user's into which results are written.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::record::{RECORD, Record};
use super::{remove_result, replace_folder, write_folder};
use crate::cli::failure::Failure;

fn files(list: &[(&str, &str)]) -> Vec<(String, Vec<u8>)> {
    list.iter().map(|(path, text)| (path.to_string(), text.as_bytes().to_vec())).collect()
}

/// A folder with a first result in `o/r`.
fn bench() -> TempDir {
    let bench = tempfile::tempdir().expect("a folder");
    write(&bench, &[("report.md", "one"), ("pictures/front.png", "picture")]);
    bench
}

fn write(bench: &TempDir, list: &[(&str, &str)]) {
    write_folder(&bench.path().join("o"), "r", &files(list)).expect("is written");
}

/// Replaces the result; gives the notes.
fn notes(bench: &TempDir, list: &[(&str, &str)]) -> String {
    replace_folder(&bench.path().join("o/r"), &files(list)).expect("is written").join("\n")
}

/// Everything below `o/r` but the record, folders with a slash.
fn listed(bench: &TempDir) -> Vec<String> {
    let entries = super::folder::entries(&bench.path().join("o/r")).expect("can be read");
    let shown = |entry: super::folder::Entry| format!("{}{}", entry.path.display(), if entry.is.is_dir() { "/" } else { "" });
    let mut names: Vec<String> = entries.into_iter().map(shown).filter(|name| name != RECORD).collect();
    names.sort();
    names
}

fn hidden(bench: &TempDir) -> Vec<String> {
    let names = fs::read_dir(bench.path().join("o")).expect("is there").map(|entry| entry.expect("is there").file_name());
    names.map(|name| name.to_string_lossy().into_owned()).filter(|name| name.starts_with('.')).collect()
}

fn text(bench: &TempDir, path: &str) -> String {
    super::record::content(&bench.path().join("o/r").join(path))
        .map_or_else(|error| format!("{path}: {error}"), |bytes| String::from_utf8_lossy(&bytes).into())
}

fn put(bench: &TempDir, path: &str, text: &str) {
    let path = bench.path().join(path);
    fs::create_dir_all(path.parent().expect("has one")).expect("can be made");
    fs::write(path, text).expect("can be written");
}

#[test]
fn planted_no_file_is_written_beside_its_folder() {
    for path in ["../up.txt", "/tmp/up.txt", "a/../../up.txt"] {
        let bench = tempfile::tempdir().expect("a folder");
        let refused = write_folder(&bench.path().join("o"), "r", &files(&[("in.txt", "x"), (path, "x")]));
        assert!(refused.is_err_and(|failure| failure.to_string().contains("leads out of the folder")), "{path}");
        let left = super::folder::entries(bench.path()).expect("can be read");
        assert!(left.iter().all(|entry| entry.is.is_dir() && !entry.path.ends_with("r")), "{path}");
    }
}

#[test]
fn planted_what_is_not_ours_stays_and_what_is_no_longer_made_goes() {
    let bench = bench();
    put(&bench, "o/r/mine.txt", "mine");
    put(&bench, "o/r/pictures/my.png", "mine, too");
    put(&bench, "o/r/notes/deep/a.txt", "deep");
    fs::create_dir(bench.path().join("o/r/empty")).expect("can be made");
    assert_eq!(notes(&bench, &[("report.md", "two")]), "");
    let all = ["empty/", "mine.txt", "notes/", "notes/deep/", "notes/deep/a.txt", "pictures/", "pictures/my.png", "report.md"];
    assert_eq!(listed(&bench), all);
    assert_eq!([text(&bench, "report.md"), text(&bench, "mine.txt")], ["two", "mine"]);
    assert_eq!(hidden(&bench), [""; 0]);
    // Nothing more is kept the next time.
    assert_eq!(notes(&bench, &[("report.md", "two")]), "");
    assert_eq!(listed(&bench), all);
}

#[test]
fn planted_changed_files_are_kept_beside_the_new_ones() {
    let bench = bench();
    put(&bench, "o/r/report.md", "mine");
    put(&bench, "o/r/pictures/front.png", "painted");
    let said = notes(&bench, &[("report.md", "two")]);
    assert!(said.contains("report.md.yours") && said.contains("front.png was changed since it was written: it stays"), "{said}");
    assert_eq!(["report.md", "report.md.yours", "pictures/front.png"].map(|path| text(&bench, path)), ["two", "mine", "painted"]);
    put(&bench, "o/r/report.md", "mine again");
    let said = notes(&bench, &[("report.md", "three")]);
    assert!(said.contains("report.md.yours-2"), "{said}");
    assert_eq!(["report.md.yours", "report.md.yours-2"].map(|path| text(&bench, path)), ["mine", "mine again"]);
}

#[test]
fn planted_names_that_are_taken_by_files_and_folders() {
    let bench = bench();
    put(&bench, "o/r/charts", "a file");
    put(&bench, "o/r/table.csv/a.txt", "in a folder");
    put(&bench, "o/r/table.csv/b.txt", "in it, too");
    put(&bench, "o/r/.written.json.yours", "taken");
    notes(&bench, &[("charts/a.svg", "chart"), ("table.csv", "table")]);
    assert_eq!(
        ["charts.yours", "charts/a.svg", "table.csv", "table.csv.yours/a.txt", "table.csv.yours/b.txt"].map(|path| text(&bench, path)),
        ["a file", "chart", "table", "in a folder", "in it, too"]
    );
    // A record that was changed by hand is a file of the user's.
    let record = text(&bench, RECORD);
    put(&bench, "o/r/.written.json", &record.replace("schema_version", "schema_version\" : 1, \"note"));
    notes(&bench, &[("table.csv", "other")]);
    assert!(text(&bench, ".written.json.yours-2").contains("note"), "{:?}", listed(&bench));
}

#[cfg(unix)]
#[test]
fn planted_what_is_no_folder_is_told_as_what_it_is() {
    let bench = tempfile::tempdir().expect("a folder");
    put(&bench, "file", "mine");
    std::os::unix::fs::symlink("nowhere", bench.path().join("dangling")).expect("can be linked");
    for (parent, why) in [("file", "a file is there"), ("dangling", "a link that leads nowhere")] {
        let failed = write_folder(&bench.path().join(parent), "r", &files(&[("a", "a")])).expect_err("is no folder");
        assert!(matches!(&failed, Failure::Machine { error, .. } if error.to_string().contains(why)), "{parent}: {failed:?}");
    }
}

#[test]
fn planted_folders_without_a_record_are_the_users() {
    let bench = tempfile::tempdir().expect("a folder");
    put(&bench, "o/r/report.md", "mine");
    put(&bench, "o/r/same.md", "same");
    let said = notes(&bench, &[("report.md", "new"), ("same.md", "same")]);
    assert_eq!(said.lines().count(), 1, "{said}");
    assert_eq!(listed(&bench), ["report.md", "report.md.yours", "same.md"]);
    assert!(Record::read(&bench.path().join("o/r")).is_ours(&bench.path().join("o/r"), Path::new("same.md")));
}

#[cfg(unix)]
#[test]
fn planted_links_lead_to_the_place_and_are_kept_in_it() {
    let bench = bench();
    fs::rename(bench.path().join("o/r"), bench.path().join("elsewhere")).expect("can be moved");
    std::os::unix::fs::symlink(bench.path().join("elsewhere"), bench.path().join("o/r")).expect("can be linked");
    put(&bench, "outside/precious", "keep");
    std::os::unix::fs::symlink(bench.path().join("outside"), bench.path().join("elsewhere/charts")).expect("can be linked");
    write(&bench, &[("report.md", "two"), ("charts/precious", "new")]);
    assert!(bench.path().join("o/r").is_symlink());
    assert!(bench.path().join("elsewhere/charts.yours").is_symlink());
    assert_eq!([text(&bench, "report.md"), text(&bench, "charts/precious")], ["two", "new"]);
    assert_eq!(text(&bench, "../outside/precious"), "keep");
    std::os::unix::fs::symlink("nowhere", bench.path().join("o/gone")).expect("can be linked");
    let refused = write_folder(&bench.path().join("o"), "gone", &files(&[("a", "a")])).expect_err("leads nowhere");
    assert_eq!(refused.exit_code(), 3);
}

#[cfg(unix)]
#[test]
fn planted_read_only_folders_are_refused_and_stay_whole() {
    use std::os::unix::fs::PermissionsExt;
    for folder in ["o/r", "o/r/pictures"] {
        let bench = bench();
        put(&bench, "o/r/mine.txt", "mine");
        let mode = |mode: u32| fs::set_permissions(bench.path().join(folder), fs::Permissions::from_mode(mode)).expect("is ours");
        mode(0o555);
        let refused = write_folder(&bench.path().join("o"), "r", &files(&[("report.md", "two")])).expect_err("read-only");
        mode(0o755);
        assert_eq!(refused.exit_code(), 3);
        assert!(refused.to_string().contains("is read-only; make it writable"), "{refused}");
        assert_eq!(listed(&bench), ["mine.txt", "pictures/", "pictures/front.png", "report.md"]);
        assert_eq!((text(&bench, "report.md").as_str(), hidden(&bench).len()), ("one", 0));
    }
    // A read-only folder of the user's own is taken along.
    let bench = bench();
    put(&bench, "o/r/archive/a.txt", "a");
    fs::set_permissions(bench.path().join("o/r/archive"), fs::Permissions::from_mode(0o555)).expect("is ours");
    write(&bench, &[("report.md", "two")]);
    assert!(fs::metadata(bench.path().join("o/r/archive")).expect("is there").permissions().readonly());
    assert_eq!((text(&bench, "archive/a.txt").as_str(), hidden(&bench).len()), ("a", 0));
    fs::set_permissions(bench.path().join("o/r/archive"), fs::Permissions::from_mode(0o755)).expect("is ours");
}

#[cfg(unix)]
#[test]
fn planted_folders_of_killed_runs_go_and_what_is_the_users_in_them_comes_back() {
    let bench = bench();
    put(&bench, "o/r/mine.txt", "mine");
    let copy = |from: &str, to: &str| fs::copy(bench.path().join(from), bench.path().join(to)).expect("can be copied");
    // Killed while writing: one file is half, one of the user's was linked already.
    put(&bench, "o/.r.1.new/report.md", "tw");
    copy("o/r/.written.json", "o/.r.1.new/.written.json");
    fs::hard_link(bench.path().join("o/r/mine.txt"), bench.path().join("o/.r.1.new/mine.txt")).expect("can be linked");
    // Killed while the list itself was written, and before.
    put(&bench, "o/.r.2.new/.written.json", "{ \"schema");
    fs::create_dir(bench.path().join("o/.r.3-1.new")).expect("can be made");
    // Killed after the exchange; somebody had just saved a file, and changed another.
    put(&bench, "o/.r.4.old/report.md", "mine now");
    put(&bench, "o/.r.4.old/saved.txt", "saved");
    copy("o/r/.written.json", "o/.r.4.old/.written.json");
    // Of other places, of a run that goes on, and of nobody known.
    put(&bench, "o/.r.x.1.new/a", "a");
    put(&bench, "o/.r.5.new/report.md", "whose?");
    put(&bench, "o/.r.6.old/report.md", "being taken apart");
    let goes_on = fs::File::open(bench.path().join("o/.r.6.old")).expect("is there");
    goes_on.try_lock().expect("is free");
    let said = notes(&bench, &[("report.md", "two")]);
    assert_eq!(listed(&bench), ["mine.txt", "report.md", "report.md.yours", "saved.txt"], "{said}");
    assert_eq!(["report.md", "report.md.yours", "saved.txt"].map(|path| text(&bench, path)), ["two", "mine now", "saved"]);
    let mut left = hidden(&bench);
    left.sort();
    assert_eq!(left, [".r.5.new", ".r.6.old", ".r.x.1.new"], "{said}");
    drop(goes_on);
    // Killed between the two steps of an exchange: nothing is in the place.
    fs::rename(bench.path().join("o/r"), bench.path().join("o/.r.7.old")).expect("can be moved");
    write(&bench, &[("report.md", "three")]);
    assert_eq!([text(&bench, "report.md"), text(&bench, "mine.txt"), text(&bench, "saved.txt")], ["three", "mine", "saved"]);
}

#[test]
fn planted_writers_of_one_folder_all_succeed() {
    let bench = tempfile::tempdir().expect("a folder");
    put(&bench, "o/r/mine.txt", "mine");
    std::thread::scope(|scope| {
        for writer in 0..8 {
            let bench = &bench;
            scope.spawn(move || (0..10).for_each(|turn| write(bench, &[("report.md", &format!("{writer} {turn}")), ("b/c", "c")])));
        }
    });
    assert_eq!(listed(&bench), ["b/", "b/c", "mine.txt", "report.md"]);
    assert_eq!(hidden(&bench), [""; 0]);
}

#[test]
fn planted_a_result_that_is_removed_leaves_what_is_the_users() {
    let parent = tempfile::tempdir().expect("a folder");
    let files = [("report.md".to_string(), b"page".to_vec()), ("plots/a.svg".into(), b"plot".to_vec())];
    let place = write_folder(parent.path(), "report", &files).expect("can be written");
    fs::write(place.join("notes.txt"), "mine").expect("can be written");
    fs::write(place.join("report.md"), "changed").expect("can be written");
    remove_result(&place, &[]).expect("can be removed");
    let mut left: Vec<_> = fs::read_dir(&place).expect("is there").map(|entry| entry.expect("is there").file_name()).collect();
    left.sort();
    assert_eq!(left, ["notes.txt", "report.md.yours"]);
    fs::remove_dir_all(&place).expect("can be removed");
    write_folder(parent.path(), "report", &files).expect("can be written");
    remove_result(&place, &[]).expect("can be removed");
    assert!(!place.exists());
    remove_result(&place, &[]).expect("nothing is there");
}
