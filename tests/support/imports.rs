//! Which modules of a crate import which, read from their `use` lines.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// For each module by its path, such as `limits::room`, those that it imports.
pub type Imports = BTreeMap<String, BTreeSet<String>>;

/// The source files that are not tests, by the path of their module.
pub fn modules(source: &str) -> BTreeMap<String, PathBuf> {
    let mut folders = vec![PathBuf::from(source)];
    let mut modules = BTreeMap::new();
    while let Some(folder) = folders.pop() {
        for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                modules.insert(module_of(Path::new(source), &path), path);
            }
        }
    }
    modules.retain(|name, _| name != "lib" && !name.ends_with("tests"));
    modules
}

fn module_of(source: &Path, path: &Path) -> String {
    let inside = path.strip_prefix(source).unwrap().with_extension("");
    let names: Vec<_> = inside.iter().map(|name| name.to_str().unwrap()).collect();
    let name = names.join("::");
    name.strip_suffix("::mod").map(str::to_owned).unwrap_or(name)
}

/// The paths that the `use` lines of a file name, without those of its tests.
pub fn used(text: &str) -> Vec<String> {
    let text = text.split("#[cfg(test)]").next().unwrap();
    let code: Vec<&str> =
        text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let code = code.join(" ");
    let statements = code.split(';').filter_map(|statement| {
        let (before, path) = statement.rsplit_once("use ")?;
        let starts_line = before.trim_end().is_empty() || before.ends_with([' ', ')', '}']);
        starts_line.then(|| path.to_owned())
    });
    statements.flat_map(|path| unfolded("", path.trim())).collect()
}

/// `a::{b, c::{d, e}}` is `a::b`, `a::c::d` and `a::c::e`.
pub fn unfolded(before: &str, path: &str) -> Vec<String> {
    let Some((start, rest)) = path.split_once('{') else {
        let path = path.split(" as ").next().unwrap().trim();
        return vec![format!("{before}{path}")];
    };
    let inside = rest.trim_end().strip_suffix('}').unwrap_or(rest);
    let (mut depth, mut items) = (0, vec![String::new()]);
    for letter in inside.chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        match (letter, depth) {
            (',', 0) => items.push(String::new()),
            _ => items.last_mut().unwrap().push(letter),
        }
    }
    let before = format!("{before}{}", start.trim());
    let items = items.iter().map(|item| item.trim()).filter(|item| !item.is_empty());
    items.flat_map(|item| unfolded(&before, item)).collect()
}

/// The module that a path in another one leads to; none outside of the core.
pub fn target(from: &str, path: &str, modules: &BTreeMap<String, PathBuf>) -> Option<String> {
    let (mut base, mut rest) = (from.to_owned(), path);
    if let Some(path) = rest.strip_prefix("crate::") {
        (base, rest) = (String::new(), path);
    }
    while let Some(path) = rest.strip_prefix("super::") {
        base = base.rsplit_once("::").map_or(String::new(), |(above, _)| above.to_owned());
        rest = path;
    }
    let rest = rest.strip_prefix("self::").unwrap_or(rest);
    let full = if base.is_empty() { rest.to_owned() } else { format!("{base}::{rest}") };
    let mut name = full.as_str();
    while !modules.contains_key(name) {
        name = name.rsplit_once("::")?.0;
    }
    (name != from).then(|| name.to_owned())
}

/// What each file imports.
pub fn imports(modules: &BTreeMap<String, PathBuf>) -> Imports {
    let targets = |(name, path): (&String, &PathBuf)| {
        let text = std::fs::read_to_string(path).unwrap();
        let targets = used(&text).into_iter().filter_map(|path| target(name, &path, modules));
        (name.clone(), targets.collect())
    };
    modules.iter().map(targets).collect()
}

/// What the files below a module import of its other files below, one level down: at the top, the
/// modules of the core.
pub fn imports_within(folder: &str, modules: &BTreeMap<String, PathBuf>) -> Imports {
    let below = |name: &str| -> Option<String> {
        let rest = match folder {
            "" => name,
            _ => name.strip_prefix(folder)?.strip_prefix("::")?,
        };
        rest.split("::").next().map(str::to_owned)
    };
    let mut within = Imports::new();
    for (name, targets) in imports(modules) {
        let Some(own) = below(&name) else { continue };
        let others = targets.iter().filter_map(|name| below(name)).filter(|other| *other != own);
        within.entry(own.clone()).or_default().extend(others);
    }
    within
}

/// The circles at the top and among the files of one folder, by folder.
pub fn circles_by_folder(modules: &BTreeMap<String, PathBuf>) -> BTreeMap<String, Imports> {
    let above = modules.keys().filter_map(|name| Some(name.rsplit_once("::")?.0.to_owned()));
    let folders: BTreeSet<String> = above.chain([String::new()]).collect();
    let found = folders.into_iter().map(|folder| {
        let circles = circles(imports_within(&folder, modules));
        (folder, circles)
    });
    found.filter(|(_, circles)| !circles.is_empty()).collect()
}

/// The modules that are on a circle, or lead from one to another: what is left when those that
/// import nothing that is left, or that nothing left imports, are taken away.
pub fn circles(mut imports: Imports) -> Imports {
    loop {
        let names: BTreeSet<String> = imports.keys().cloned().collect();
        let imported: BTreeSet<String> = imports.values().flatten().cloned().collect();
        imports.values_mut().for_each(|others| others.retain(|other| names.contains(other)));
        imports.retain(|name, others| !others.is_empty() && imported.contains(name));
        if imports.len() == names.len() {
            return imports;
        }
    }
}
