//! Texts of a frame file that would be obeyed by who reads a report: markup, links, formulas, commands of a log, escape sequences.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::cargo_bin;

/// A text that is markup, a link, a command and an escape sequence.
const HOSTILE: &str = r#"<script>alert(1)</script> <img src=x onerror=alert(1)> ![p](http://e/p) | \n::error::injected\u001b]0;title\u0007 ' \" &amp; ]]> %0A::warning::x"#;

/// The same for names, which have one line.
const NAME: &str = r#"<script>alert(1)</script> <img src=x onerror=alert(1)> ![p](http://e/p) | ' \" &amp; ]]> %0A::warning::x"#;

/// A frame whose every free text is hostile.
fn frame() -> String {
    format!(
        "base = \"cognifly\"\nname = \"hostile\"\ndescription = \"{HOSTILE}\"\n[materials]\nrigid = \"=1+1|{NAME}\"\n[bought]\nbattery = \"@SUM(A1)\"\n\
         [override.materials.\"=1+1|{NAME}\"]\nkind = \"printed\"\ndensity_g_cm3 = 1.2\nprint_factor = 1.0\ncolour = [0.5, 0.5, 0.5, 1.0]\nsource = \"{HOSTILE}\"\n\
         price_per_kg = 20.0\ncurrency = \"=A1|{NAME}\"\nprice_source = \"{HOSTILE}\"\n\
         [override.parts.\"@SUM(A1)\"]\nkind = \"battery\"\nsize_mm = [55.0, 31.0, 16.0]\nmass_g = 58.0\nmass_basis = \"measured\"\nsource = \"=HYPERLINK(1) {HOSTILE}\"\n\
         price = 3.0\ncurrency = \"=A1\"\nprice_source = \"{HOSTILE}\"\n\
         [extras.\"+1 {NAME}\"]\nmass_g = 1.0\nmass_basis = \"measured\"\nsource = \"{HOSTILE}\"\n"
    )
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(cargo_bin("flexframe"));
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1");
    let output = command.output().expect("the program starts");
    assert!(matches!(output.status.code(), Some(0 | 1)), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

/// What no text may hold, whoever reads it.
fn is_harmless(what: &str, text: &str) {
    let controls = |c: char| c.is_control() && c != '\n' && c != '\t';
    assert!(!text.contains(controls), "{what} holds a control character");
    assert!(!text.lines().any(|line| line.trim_start().starts_with("::error::injected")), "{what} holds a command of a log: {text}");
}

fn is_harmless_markup(what: &str, text: &str) {
    // A bracket behind a backslash is a sign like any other.
    let lower = text.to_lowercase().replace("\\\\", "").replace("\\]", "");
    let link = if what.ends_with(".html") || what.ends_with(".svg") || what == "junit" { "<a href" } else { "](http" };
    let obeyed = ["<script>alert", "<img src=x", link].into_iter().find(|part| lower.contains(part));
    assert!(obeyed.is_none(), "{what} holds {obeyed:?}: {text}");
}

/// Fields of a table that a spreadsheet would compute.
fn formulas(csv: &str) -> Vec<String> {
    let mut fields = Vec::new();
    let (mut field, mut quoted) = (String::new(), false);
    for c in csv.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' | '\n' if !quoted => fields.push(std::mem::take(&mut field)),
            _ => field.push(c),
        }
    }
    let computed = |field: &String| field.len() > 1 && field.starts_with(['=', '+', '-', '@', '\t', '\r']) && field.parse::<f64>().is_err();
    fields.into_iter().filter(computed).collect()
}

#[test]
fn planted_texts_in_a_built_folder_are_not_obeyed() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("frame.toml"), frame()).expect("can be written");
    let built = run(folder.path(), &["build", "frame.toml", "--no-pictures", "-o", "o"]);
    is_harmless("the terminal", &String::from_utf8_lossy(&built.stdout));
    is_harmless("the messages", &String::from_utf8_lossy(&built.stderr));
    let read = |name: &str| fs::read_to_string(folder.path().join("o/hostile").join(name)).expect("is there");
    let report = read("report.md");
    assert!(report.contains("&lt;script>"), "the text itself is there: {report}");
    is_harmless_markup("report.md", &report);
    let settings = read("print-settings.md");
    assert!(settings.contains("a kilogram"), "its price is there: {settings}");
    is_harmless_markup("print-settings.md", &settings);
    let bill = read("bom.csv");
    assert!(formulas(&bill).is_empty() && bill.contains("'@SUM(A1)"), "{:?}", formulas(&bill));
    let plates = fs::read_dir(folder.path().join("o/hostile/plates")).expect("is there").map(|entry| entry.expect("is there").path());
    let plates: Vec<_> = plates.filter(|path| path.extension().is_some_and(|end| end == "3mf")).collect();
    let told: usize = plates.iter().map(|path| says_script_in_text_only(path)).sum();
    assert!(plates.len() == 2 && told > 0, "the text itself is in a plate");
    run(folder.path(), &["export", "frame.toml", "-o", "o", "-q"]);
    let model = read_of_export(&folder.path().join("o"), "model.config");
    assert!(roxmltree::Document::parse(&model).expect("is XML").descendants().all(|node| !node.has_tag_name("script")), "{model}");
    assert!(model.contains("&lt;script"), "the text itself is there: {model}");
    run(folder.path(), &["fold", "frame.toml", "-o", "o", "-q"]);
    let page = fs::read_to_string(folder.path().join("o/hostile-fold/instructions.html")).expect("is there");
    assert!(page.contains("&lt;script"), "the text itself is there");
    is_harmless_markup("instructions.html", &page);
}

/// The file of this name that `export` wrote somewhere below a folder.
fn read_of_export(folder: &Path, name: &str) -> String {
    let below = |folder: &Path| fs::read_dir(folder).expect("is there").map(|entry| entry.expect("is there").path()).collect::<Vec<_>>();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for path in below(&next) {
            if path.is_dir() {
                folders.push(path);
            } else if path.file_name().is_some_and(|own| own == name) {
                return fs::read_to_string(path).expect("UTF-8");
            }
        }
    }
    panic!("no {name}");
}

/// How often the files of a plate say "<script>" in their texts, as another reader of XML has them; no element is one.
fn says_script_in_text_only(plate: &Path) -> usize {
    let mut archive = zip::ZipArchive::new(fs::File::open(plate).expect("is there")).expect("an archive");
    let names: Vec<String> = archive.file_names().map(|name| name.expect("is text").into_owned()).collect();
    assert!(names.iter().all(|name| !name.contains("..") && !name.starts_with('/')), "{names:?}");
    let mut told = 0;
    for name in names.iter().filter(|name| !name.ends_with(".png")) {
        let mut text = String::new();
        archive.by_name(name).expect("is there").read_to_string(&mut text).expect("is text");
        is_harmless(name, &text);
        let tree = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        for node in tree.descendants().filter(roxmltree::Node::is_element) {
            assert!(!["script", "img"].contains(&node.tag_name().name()), "{name}");
            let texts = node.text().into_iter().chain(node.attributes().map(|attribute| attribute.value()));
            told += texts.filter(|text| text.contains("<script>")).count();
        }
    }
    told
}

#[test]
fn planted_texts_in_printed_reports_are_not_obeyed() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("frame.toml"), frame()).expect("can be written");
    let printed = |arguments: &[&str]| {
        let output = run(folder.path(), arguments);
        let text = String::from_utf8(output.stdout).expect("UTF-8");
        is_harmless(&format!("{arguments:?}"), &text);
        is_harmless(&format!("messages of {arguments:?}"), &String::from_utf8_lossy(&output.stderr));
        text
    };
    for format in ["markdown", "csv"] {
        let text = printed(&["bom", "frame.toml", "--format", format]);
        if format == "csv" { assert_eq!(formulas(&text), [""; 0]) } else { is_harmless_markup("bom", &text) }
    }
    is_harmless_markup("diff", &printed(&["diff", "cognifly", "frame.toml", "--format", "markdown"]));
    is_harmless_markup("check", &printed(&["check", "frame.toml", "--all", "--format", "markdown"]));
    for format in ["github", "junit", "sarif", "json"] {
        let text = printed(&["check", "frame.toml", "--format", format]);
        match format {
            "github" => assert!(
                text.lines().all(|line| ["::error ", "::warning ", "::notice "].iter().any(|word| line.starts_with(word))),
                "{text}"
            ),
            "junit" => is_harmless_markup(format, &text),
            _ => drop(serde_json::from_str::<serde_json::Value>(&text).expect("JSON")),
        }
    }
    printed(&["check", "frame.toml", "--all"]);
    printed(&["explain", "battery_mass_g", "frame.toml"]);
}

#[test]
fn planted_texts_of_drops_are_not_obeyed_in_tables_and_charts() {
    let folder = tempfile::tempdir().expect("a folder");
    let drops = crate::drops::csv(&crate::drops::model(6000.0, 30.0), 6, crate::drops::Seen::Varied);
    // Sessions are named by whoever measured.
    let (head, rows) = drops.split_once('\n').expect("has lines");
    let sessions: String = rows.lines().map(|row| format!("\"=1+1 <script>alert(1)</script>\u{1b}]0;t\u{7}\",{row}\n")).collect();
    fs::write(folder.path().join("drops.csv"), format!("session,{head}\n{sessions}")).expect("can be written");
    let output = run(folder.path(), &["measure", "drops.csv", "-o", "o"]);
    is_harmless("measure", &String::from_utf8_lossy(&output.stdout));
    is_harmless("messages of measure", &String::from_utf8_lossy(&output.stderr));
    for entry in fs::read_dir(folder.path().join("o/measure")).expect("was made") {
        let path = entry.expect("is there").path();
        let Ok(text) = fs::read_to_string(&path) else { continue };
        match path.extension().and_then(|end| end.to_str()) {
            Some("svg") => is_harmless_markup(&path.display().to_string(), &text),
            Some("csv") => assert_eq!(formulas(&text), [""; 0], "{}", path.display()),
            _ => {}
        }
    }
}

#[test]
fn planted_names_of_several_lines_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let entries =
        ["extras.\"a\\n::error::b\"", "override.parts.\"a\\u001b]0;t\"", "override.materials.\"a\\rb\"", "override.printers.\"a\\u0085b\""];
    for entry in entries {
        fs::write(folder.path().join("frame.toml"), format!("base = \"cognifly\"\n[{entry}]\nkind = \"x\"\nsource = \"s\"\n"))
            .expect("can be written");
        let output =
            Command::new(cargo_bin("flexframe")).args(["check", "frame.toml"]).current_dir(folder.path()).output().expect("starts");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains("control"), "{entry}: {said}");
        is_harmless(entry, &said);
    }
}
