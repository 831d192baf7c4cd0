//! No file takes a name from a file that, over however many others, takes one from it.
//!
//! The files' imports are read as text: `use` lines and paths that begin with `crate`, `self` or `super`. A name that an index
//! (`mod.rs`) only passes on counts as taken from the file that defines it. Tests at the foot of a file may name anything.

use std::collections::{BTreeMap, BTreeSet};

use crate::layering::sources;

type Module = Vec<String>;

/// The files below `src`, by their modules, and what each passes on under another module's name.
struct Tree {
    text: BTreeMap<Module, String>,
    passed_on: BTreeMap<Module, BTreeMap<String, Module>>,
}

fn module_of(path: &str) -> Module {
    let path = path.trim_end_matches(".rs");
    let path = path.trim_end_matches("/mod");
    if path == "lib" { Vec::new() } else { path.split('/').map(String::from).collect() }
}

/// Without comments and without the tests at its foot.
fn product(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The paths of a `use` tree: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<Module> {
    let tree = tree.trim();
    let Some(open) = tree.find('{') else {
        let path = tree.split(" as ").next().unwrap_or_default();
        return vec![path.split("::").map(|part| part.trim().to_string()).collect()];
    };
    let close = tree.rfind('}').unwrap_or(tree.len());
    let root: Module = tree[..open].split("::").map(str::trim).filter(|part| !part.is_empty()).map(String::from).collect();
    let (mut depth, mut start) = (0, open + 1);
    let mut found = Vec::new();
    for (at, letter) in tree.char_indices().skip(open + 1).take_while(|(at, _)| *at <= close) {
        if (letter == ',' && depth == 0) || at == close {
            let branch = &tree[start..at];
            if !branch.trim().is_empty() {
                found.extend(leaves(branch).into_iter().map(|leaf| [root.clone(), leaf].concat()));
            }
            start = at + 1;
        }
        depth += i32::from(letter == '{') - i32::from(letter == '}');
    }
    found
}

/// The `use` trees of a text, and the text without them: `(passed on, taken, rest)`.
fn uses(text: &str) -> (Vec<Module>, Vec<Module>, String) {
    let (mut passed_on, mut taken, mut rest) = (Vec::new(), Vec::new(), String::new());
    for statement in text.split_inclusive(';') {
        let lines: Vec<&str> = statement.lines().collect();
        let Some(at) = lines.iter().rposition(|line| {
            let line = line.trim_start();
            line.starts_with("use ")
                || (line.starts_with("pub") && line.split_once(" use ").is_some_and(|(before, _)| !before.contains('{')))
        }) else {
            rest.push_str(statement);
            continue;
        };
        rest.push_str(&lines[..at].join("\n"));
        let whole = lines[at..].join(" ");
        let tree = whole.split_once("use ").map_or("", |(_, tree)| tree.trim_end_matches(';'));
        let target = if whole.trim_start().starts_with("pub") { &mut passed_on } else { &mut taken };
        target.extend(leaves(tree));
    }
    (passed_on, taken, rest)
}

/// Paths inside a text that begin with `crate`, `self` or `super`.
fn inline(text: &str) -> Vec<Module> {
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    text.split(|c| !is_path(c))
        .filter(|path| ["crate::", "self::", "super::"].iter().any(|root| path.starts_with(root)))
        .map(|path| path.split("::").map(String::from).collect())
        .collect()
}

impl Tree {
    fn read(sources: &BTreeMap<String, String>) -> Self {
        let text: BTreeMap<Module, String> =
            sources.iter().filter(|(path, _)| *path != "main.rs").map(|(path, text)| (module_of(path), product(text))).collect();
        let mut tree = Self { text, passed_on: BTreeMap::new() };
        for (module, text) in &tree.text {
            let named = uses(text).0.into_iter().filter_map(|path| Some((path.last()?.clone(), tree.absolute(&path, module)?)));
            let named: BTreeMap<String, Module> = named.collect();
            tree.passed_on.insert(module.clone(), named);
        }
        tree
    }

    /// From the root; `None` for another crate's.
    fn absolute(&self, path: &[String], here: &[String]) -> Option<Module> {
        let above = path.iter().take_while(|part| *part == "super").count();
        match path.first()?.as_str() {
            "crate" => Some(path[1..].to_vec()),
            "self" => Some([here, &path[1..]].concat()),
            "super" => Some([here.get(..here.len().checked_sub(above)?)?, &path[above..]].concat()),
            first => {
                let child = [here, &[first.to_string()]].concat();
                self.text.contains_key(&child).then(|| [here, path].concat())
            }
        }
    }

    /// The file in which what a path names is defined.
    fn file(&self, path: &[String], passes: usize) -> Option<Module> {
        let length = (1..=path.len()).rev().find(|length| self.text.contains_key(&path[..*length]))?;
        let module = path[..length].to_vec();
        let on = path.get(length).and_then(|name| self.passed_on[&module].get(name)).filter(|_| passes > 0);
        Some(on.and_then(|on| self.file(on, passes - 1)).unwrap_or(module))
    }

    /// The files that a file takes names from.
    fn taken(&self, module: &Module) -> BTreeSet<Module> {
        let (_, mut paths, rest) = uses(&self.text[module]);
        paths.extend(inline(&rest));
        // An index calls its rooms by their bare names.
        let bare = rest.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).filter(|path| path.contains("::"));
        paths.extend(bare.map(|path| path.split("::").map(String::from).collect::<Module>()));
        let absolute = paths.iter().filter_map(|path| self.absolute(path, module));
        absolute.filter_map(|path| self.file(&path, 5)).filter(|file| file != module).collect()
    }

    /// Files that take names from each other, in groups.
    fn circles(&self) -> Vec<Vec<String>> {
        let taken: BTreeMap<&Module, BTreeSet<Module>> = self.text.keys().map(|module| (module, self.taken(module))).collect();
        let reached = |from: &Module| {
            let (mut seen, mut open) = (BTreeSet::new(), vec![from.clone()]);
            while let Some(module) = open.pop() {
                open.extend(taken[&module].iter().filter(|next| seen.insert((*next).clone())).cloned());
            }
            seen
        };
        let reach: BTreeMap<&Module, BTreeSet<Module>> = self.text.keys().map(|module| (module, reached(module))).collect();
        let mut circles = BTreeSet::new();
        for (module, _) in reach.iter().filter(|(module, reached)| reached.contains(**module)) {
            let circle = reach[module].iter().filter(|other| reach[other].contains(*module));
            circles.insert(circle.map(|module| module.join("/")).collect::<Vec<_>>());
        }
        circles.into_iter().collect()
    }
}

#[test]
fn analytic_no_files_import_each_other() {
    let circles = Tree::read(&sources()).circles();
    assert!(circles.is_empty(), "{}", circles.iter().map(|circle| circle.join(", ")).collect::<Vec<_>>().join("\n"));
}

#[test]
fn planted_circles_are_found_through_an_index_and_over_several_files() {
    let tree = |files: &[(&str, &str)]| Tree::read(&files.iter().map(|(path, text)| (path.to_string(), text.to_string())).collect());
    let index = ("a/mod.rs", "mod x;\nmod y;\npub use x::{X, Other};\npub use y::Y;\n");
    let there = tree(&[index, ("a/x.rs", "use super::Y;\npub struct X;"), ("a/y.rs", "use crate::a::X;\npub struct Y;")]);
    assert_eq!(there.circles(), [["a/x", "a/y"]]);
    let one_way = tree(&[index, ("a/x.rs", "pub struct X;"), ("a/y.rs", "use crate::a::{\n    Other,\n    X,\n};\npub struct Y;")]);
    assert_eq!(one_way.circles(), Vec::<Vec<String>>::new());
    let over_three = tree(&[("a.rs", "use crate::b::B;"), ("b.rs", "fn b() { crate::c::c() }"), ("c.rs", "use super::a::A;")]);
    assert_eq!(over_three.circles(), [["a", "b", "c"]]);
    let in_a_test = tree(&[("a.rs", "use crate::b::B;"), ("b.rs", "pub struct B;\n#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}\n")]);
    assert_eq!(in_a_test.circles(), Vec::<Vec<String>>::new());
    let with_its_index = tree(&[("a/mod.rs", "mod x;\npub struct A;\nfn all() { x::of() }"), ("a/x.rs", "use super::A;")]);
    assert_eq!(with_its_index.circles(), [["a", "a/x"]]);
}
