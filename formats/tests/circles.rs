//! No module imports one that imports it: leaves come first, and the registry last.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Modules as paths of names, each with those that it uses.
type Uses = BTreeMap<Vec<String>, BTreeSet<Vec<String>>>;

#[test]
fn no_modules_import_each_other_in_a_circle() {
    let uses = uses(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")));
    assert!(uses.len() > 20 && uses.values().any(|used| used.len() > 5), "{uses:?}");
    assert_eq!(circular(uses), Uses::new());
}

#[test]
fn a_circle_is_found() {
    let name = |name: &str| vec![name.to_owned()];
    let mut uses = Uses::from([
        (name("a"), [name("b")].into()),
        (name("b"), [name("c")].into()),
        (name("c"), BTreeSet::new()),
    ]);
    assert_eq!(circular(uses.clone()), Uses::new());
    uses.insert(name("c"), [name("b")].into());
    assert_eq!(circular(uses).len(), 3, "two of the circle and one on top");
}

/// What is left once modules that use none of those left are taken away, again and again.
fn circular(mut uses: Uses) -> Uses {
    loop {
        let names: BTreeSet<Vec<String>> = uses.keys().cloned().collect();
        uses.retain(|_, used| used.iter().any(|other| names.contains(other)));
        if uses.len() == names.len() {
            return uses;
        }
    }
}

fn uses(source: &Path) -> Uses {
    let mut texts = BTreeMap::new();
    collect(source, &mut Vec::new(), &mut texts);
    let modules: BTreeSet<Vec<String>> = texts.keys().cloned().collect();
    let used = |module: &Vec<String>, text: &String| {
        let paths = imports(text).flat_map(|path| absolute(module, &path));
        let found = paths.filter_map(|path| longest_known(&modules, path));
        found.filter(|other| other != module).collect()
    };
    texts.iter().map(|(module, text)| (module.clone(), used(module, text))).collect()
}

/// The text of each file above its tests; `lib.rs` only lists the others.
fn collect(folder: &Path, module: &mut Vec<String>, texts: &mut BTreeMap<Vec<String>, String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            module.push(stem);
            collect(&path, module, texts);
            module.pop();
        } else if stem != "lib" {
            let text = fs::read_to_string(&path).unwrap();
            let above = text.split("#[cfg(test)]").next().unwrap_or_default().to_owned();
            let name = (stem != "mod").then_some(stem);
            texts.insert(module.iter().cloned().chain(name).collect(), above);
        }
    }
}

/// The paths behind `use`, one for each name in braces; and `self::x` for `mod x`.
fn imports(text: &str) -> impl Iterator<Item = Vec<String>> {
    let statements = text.split(';').filter_map(|part| {
        let line = part.rsplit('\n').find(|line| starts(line).is_some())?;
        let rest = &part[part.find(line)? + line.len() - starts(line)?.len()..];
        Some((line.contains("mod "), rest.split_whitespace().collect::<String>()))
    });
    statements.flat_map(|(is_child, path)| {
        let (stem, names) = path.split_once('{').unwrap_or((&path, ""));
        let names: Vec<String> = names.trim_end_matches('}').split(',').map(String::from).collect();
        let stem = if is_child { format!("self::{stem}") } else { stem.to_owned() };
        names.into_iter().map(move |name| {
            format!("{stem}{name}").split("::").map(String::from).collect::<Vec<_>>()
        })
    })
}

fn starts(line: &str) -> Option<&str> {
    let line = line.strip_prefix("pub(crate) ").or(line.strip_prefix("pub ")).unwrap_or(line);
    line.strip_prefix("use ").or(line.strip_prefix("mod "))
}

/// From the crate's root; of nothing outside of it.
fn absolute(module: &[String], path: &[String]) -> Option<Vec<String>> {
    let (start, rest) = match path[0].as_str() {
        "crate" => (&[][..], &path[1..]),
        "self" => (module, &path[1..]),
        "super" => (&module[..module.len() - 1], &path[1..]),
        _ => (module, path),
    };
    Some([start, rest].concat())
}

/// The module that a path names, or names a part of.
fn longest_known(modules: &BTreeSet<Vec<String>>, mut path: Vec<String>) -> Option<Vec<String>> {
    while !path.is_empty() && !modules.contains(&path) {
        path.pop();
    }
    modules.get(&path).cloned()
}
