//! Every subcommand is documented, and every format of a frame's folder is what the manifest lists.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;
use flexframe::export;

fn flexframe(arguments: &[&str]) -> Output {
    Command::new(cargo_bin("flexframe")).args(arguments).env("NO_COLOR", "1").output().expect("the program starts")
}

/// The names in the groups of the help: lines with an indent of two, above the options.
fn commands() -> Vec<String> {
    let help = String::from_utf8(flexframe(&["--help"]).stdout).expect("UTF-8");
    let list = help.split("Options:\n").next().expect("the help lists the commands");
    let grouped = || list.lines().filter(|line| line.starts_with("  "));
    assert!(grouped().all(|line| line.chars().count() <= 80), "{list}");
    let named = grouped().filter(|line| !line.starts_with("   "));
    named.filter_map(|line| line.split_whitespace().next()).map(String::from).collect()
}

/// README and every page below `docs/`.
fn documentation() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut text = fs::read_to_string(root.join("README.md")).expect("is there");
    for entry in fs::read_dir(root.join("docs")).expect("is there") {
        let path = entry.expect("can be read").path();
        if path.extension().is_some_and(|extension| extension == "md") {
            text += &fs::read_to_string(path).expect("UTF-8");
        }
    }
    text
}

#[test]
fn regress_every_command_has_help_and_stands_in_the_documentation() {
    let (commands, documentation) = (commands(), documentation());
    assert!(commands.len() > 20, "{commands:?}");
    for command in &commands {
        let help = flexframe(&[command, "--help"]);
        assert_eq!(help.status.code(), Some(0), "{command}");
        let text = String::from_utf8(help.stdout).expect("UTF-8");
        let about = text.lines().next().unwrap_or_default();
        assert!(about.len() > 15 && !about.starts_with("Usage"), "{command} says what it does first: {about:?}");
        assert!(text.contains("Example") || ["completions", "man"].contains(&command.as_str()), "{command} has an example:\n{text}");
        assert!(documentation.contains(&format!("flexframe {command}")), "no page names `flexframe {command}`");
    }
}

#[test]
fn regress_a_built_folder_holds_what_the_catalogue_of_formats_makes() {
    let documentation = documentation();
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("UTF-8");
    assert_eq!(flexframe(&["build", "cognifly", "--no-pictures", "--step", "-q", "-o", out]).status.code(), Some(0));
    let manifest = fs::read(folder.path().join("cognifly/manifest.json")).expect("is there");
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).expect("JSON");
    let paths = |list: &serde_json::Value| -> Vec<String> {
        list.as_array().expect("a list").iter().map(|file| file["path"].as_str().expect("a path").to_string()).collect()
    };
    let endings: BTreeSet<String> =
        paths(&manifest["files"]).iter().filter_map(|path| Some(path.rsplit_once('.')?.1.to_string())).collect();
    let mut named = BTreeSet::new();
    for format in export::CATALOGUE {
        assert!(named.insert(format.extension), "two formats with the ending {}", format.extension);
        assert!(endings.contains(format.extension), "no .{} in {endings:?}", format.extension);
        assert!(documentation.contains(&format!(".{}", format.extension)), "no page names .{}", format.extension);
        assert!(format.sentence.ends_with('.'), "{}", format.sentence);
    }
    for part in manifest["parts"].as_array().expect("a list") {
        let name = part["name"].as_str().expect("a name");
        let own: Vec<&str> = part["files"].as_array().expect("a list").iter().map(|file| file.as_str().expect("a path")).collect();
        assert_eq!(own, [format!("parts/{name}.stl"), format!("parts/{name}.step")], "{name}");
    }
}

#[test]
fn planted_a_format_of_its_own_reaches_the_manifest() {
    use export::bill::bill;
    use export::{ExportError, Exported, File, Format};
    use flexframe::frame::assembly::compensated::Compensated;
    use flexframe::frame::assembly::{Design, mass};
    use flexframe::params::Frame;

    fn files(of: &Exported) -> Result<Vec<File>, ExportError> {
        Ok(of.design.printed.iter().map(|part| File::of_part(part.name, "toy", part.name.slug().into())).collect())
    }
    const TOY: Format = Format { extension: "toy", sentence: "A part's name.", always: true, files };

    let design = Design::new(Frame::load("cognifly-mini").expect("a preset").0).expect("closes");
    let (masses, meshes) = (mass::table(&design), Compensated::of(&design).expect("passes the gate"));
    let made =
        (TOY.files)(&Exported { design: &design, masses: &masses, bill: &bill(&design, &masses, None), meshes: &meshes, plates: &[] })
            .expect("makes its files");
    let manifest = export::manifest::manifest(&design, &meshes, &masses, &made);
    for part in &manifest.parts {
        assert_eq!(part.files, [format!("parts/{}.toy", part.name)]);
    }
    assert_eq!(manifest.files.len(), design.printed.len());
}
