//! Folders of results in which a user keeps files: each command that writes one leaves them as they are.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;

use crate::drops::{self, Seen};

/// What writes a folder, cheaply; the folder's name is what is new in `o`.
const WRITERS: [&[&str]; 16] = [
    &["build", "cognifly", "--no-pictures"],
    &["build", "cognifly", "--part", "knee"],
    &["render", "cognifly"],
    &["render", "cognifly", "--findings"],
    &["fold", "cognifly", "--step", "2", "--png"],
    &["fold", "cognifly"],
    &["coupon", "cognifly"],
    &["stiffness", "cognifly"],
    &["export", "cognifly", "--model", "paper"],
    &["diff", "cognifly", "cognifly-v8"],
    &["drop", "--height", "0.5"],
    &["drop", "cognifly", "--model", "frame", "--height", "0.5"],
    &["synthesize", "plan.toml"],
    &["measure", "drops.csv"],
    &["fit", "drops.csv", "--bootstrap", "0"],
    &["diagnose", "drops.csv", "--max-effects", "1"],
];

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(cargo_bin("flexframe"));
    command.args(arguments).args(["-q", "-o", "o"]).current_dir(folder).env("NO_COLOR", "1");
    command.output().expect("the program starts")
}

/// The only thing in `o`.
fn place(folder: &Path) -> PathBuf {
    let names: Vec<PathBuf> = fs::read_dir(folder.join("o")).expect("was made").map(|entry| entry.expect("is there").path()).collect();
    assert_eq!(names.len(), 1, "{names:?}");
    names[0].clone()
}

/// The folder's own list of what was written.
fn listed(place: &Path) -> (PathBuf, Vec<String>) {
    let list = [".written.json", "manifest.json"].map(|name| place.join(name)).into_iter().find(|list| list.exists()).expect("has a list");
    let text = fs::read(&list).expect("can be read");
    let read: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
    let files = read["files"].as_array().expect("a list").iter().map(|file| file["path"].as_str().expect("a path").to_string());
    (list, files.collect())
}

fn holds(folder: &Path, arguments: &[&str]) {
    let first = run(folder, arguments);
    assert!(matches!(first.status.code(), Some(0 | 1)), "{arguments:?}: {}", String::from_utf8_lossy(&first.stderr));
    let place = place(folder);
    let (list, files) = listed(&place);
    let read = |path: &str| fs::read(place.join(path)).expect("is there");
    let (ours, before) = (&files[0], read(&files[0]));
    fs::write(place.join("mine.txt"), "mine").expect("can be written");
    fs::create_dir_all(place.join("mine/empty")).expect("can be made");
    fs::write(place.join("mine/deep.txt"), "deep").expect("can be written");
    fs::write(place.join(ours), "changed by hand").expect("can be written");
    // What a killed run leaves.
    let name = place.file_name().expect("has one").to_string_lossy().into_owned();
    let left = folder.join("o").join(format!(".{name}.4194303.new"));
    fs::create_dir_all(&left).expect("can be made");
    fs::copy(&list, left.join(list.file_name().expect("has one"))).expect("can be copied");
    let again = run(folder, arguments);
    let said = String::from_utf8_lossy(&again.stderr).into_owned();
    assert_eq!(again.status.code(), first.status.code(), "{arguments:?}: {said}");
    assert_eq!(self::place(folder), place, "{arguments:?}: {said}");
    assert!(said.contains(&format!("{ours}.yours")), "{arguments:?}: {said}");
    assert_eq!([read("mine.txt"), read("mine/deep.txt"), read(&format!("{ours}.yours"))], [&b"mine"[..], b"deep", b"changed by hand"]);
    assert!(place.join("mine/empty").is_dir() && read(ours) == before, "{arguments:?}");
    assert_eq!(listed(&place).1, files, "{arguments:?}");
}

#[test]
fn planted_files_of_the_users_stay_in_every_folder_that_is_written() {
    for arguments in WRITERS {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("drops.csv"), drops::csv(&drops::model(6000.0, 30.0), 6, Seen::Varied)).expect("can be written");
        let plan = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("params/synthetic/bottoming.toml")).expect("is there");
        fs::write(folder.path().join("plan.toml"), plan).expect("can be written");
        holds(folder.path(), arguments);
    }
}

#[cfg(unix)]
#[test]
fn planted_a_read_only_result_stays_as_it_is() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("drops.csv"), drops::csv(&drops::model(6000.0, 30.0), 6, Seen::Varied)).expect("can be written");
    assert_eq!(run(folder.path(), &["measure", "drops.csv"]).status.code(), Some(0));
    let place = place(folder.path());
    let before = fs::read(place.join("drops.csv")).expect("is there");
    fs::set_permissions(&place, fs::Permissions::from_mode(0o555)).expect("is ours");
    fs::write(folder.path().join("drops.csv"), drops::csv(&drops::model(5000.0, 30.0), 6, Seen::Varied)).expect("can be written");
    let refused = run(folder.path(), &["measure", "drops.csv"]);
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(3) && said.contains("is read-only"), "{said}");
    assert_eq!((self::place(folder.path()), fs::read(place.join("drops.csv")).expect("is there")), (place.clone(), before));
    fs::set_permissions(&place, fs::Permissions::from_mode(0o755)).expect("is ours");
}

/// A file of the user's behind a link is written where it is; a read-only one stays, for root too.
#[cfg(unix)]
#[test]
fn planted_a_file_that_is_written_into_keeps_its_link_and_its_permissions() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("real")).expect("can be made");
    fs::write(path("real/frame.toml"), "base = \"cognifly\"\nname = \"own\"\n").expect("can be written");
    fs::write(path("real/list.json"), "{\"schema_version\": 1, \"accepted\": []}").expect("can be written");
    fs::write(path("scale.csv"), "part,mass_g\nhub,9\n").expect("can be written");
    for name in ["frame.toml", "list.json"] {
        symlink(Path::new("real").join(name), path(name)).expect("can be linked");
    }
    let program = |arguments: &[&str]| {
        let mut command = Command::new(cargo_bin("flexframe"));
        let output = command.args(arguments).arg("-q").current_dir(folder.path()).env("NO_COLOR", "1").output().expect("starts");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    for (name, arguments) in [
        ("frame.toml", &["coupon", "--read", "plug=0.2", "--into", "frame.toml"][..]),
        ("frame.toml", &["weigh", "scale.csv", "--into", "frame.toml"]),
        ("list.json", &["check", "frame.toml", "--strict", "--baseline", "list.json", "--update-baseline"]),
    ] {
        let real = path("real").join(name);
        let read = || fs::read(&real).expect("is there");
        let mode = |mode: u32| fs::set_permissions(&real, fs::Permissions::from_mode(mode)).expect("is ours");
        let before = read();
        mode(0o440);
        let (code, said) = program(arguments);
        assert!(code == Some(3) && said.contains(&format!("cannot write {name}: it is read-only")), "{arguments:?}: {code:?} {said}");
        assert_eq!(read(), before, "{arguments:?}");
        mode(0o640);
        let (code, said) = program(arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {said}");
        assert!(path(name).is_symlink() && read() != before, "{arguments:?}");
        assert_eq!(fs::metadata(&real).expect("is there").permissions().mode() & 0o777, 0o640, "{arguments:?}");
    }
    symlink("nowhere.json", path("gone.json")).expect("can be linked");
    let (code, said) = program(&["check", "frame.toml", "--baseline", "gone.json", "--update-baseline"]);
    assert!(code == Some(3) && said.contains("it is a link that leads nowhere"), "{code:?} {said}");
    assert!(path("gone.json").is_symlink() && !path("nowhere.json").exists());
}
