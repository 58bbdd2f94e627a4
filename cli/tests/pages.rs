//! The commands that the pages show are run as they stand, and print what the pages say.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Lines in code blocks that are no runs of `chamfer`, and where they are tried.
const ELSEWHERE: [(&str, &str); 6] = [
    ("python3 -m pip install ./python", "tests/python"),
    ("python3 examples/python/chamfer_cube.py", "tests/python"),
    (
        "cargo run --profile demo -p chamfer-cli --no-default-features -- demo",
        "here, with all features",
    ),
    ("cc -Iinclude examples/c/chamfer_cube.c", "tests/ffi"),
    ("./chamfer_cube", "tests/ffi"),
    ("cargo run --release -p chamfer-cube", "examples/rust/tests"),
];

/// A command, and the lines that it should print; none are shown after some.
type Shown = (String, Vec<String>);

/// Every command in the blocks `sh` and `console` of a page.
fn commands(page: &str) -> Vec<Shown> {
    let mut shown: Vec<Shown> = Vec::new();
    // What an example prints stands in a block without a command, which is of none before it.
    let (mut block, mut first) = ("", 0);
    for line in page.lines() {
        match (line.strip_prefix("```"), block) {
            (Some(language), "") => {
                block = if language.is_empty() { "text" } else { language };
                first = shown.len();
            }
            (Some(_), _) => block = "",
            (None, "sh") => shown.push((line.to_owned(), Vec::new())),
            (None, "console") => match (line.strip_prefix("$ "), shown[first..].last_mut()) {
                (Some(command), _) => shown.push((command.to_owned(), Vec::new())),
                (None, Some((_, printed))) => printed.push(line.to_owned()),
                (None, None) => {}
            },
            _ => {}
        }
    }
    shown
}

/// A line without the time that a run took, which no two share.
fn timeless(line: &str) -> String {
    line.rsplit_once("; ")
        .filter(|(_, time)| time.ends_with(" ms"))
        .map_or(line, |(rest, _)| rest)
        .into()
}

/// A folder with the models that the pages speak of.
fn prepared() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let demo =
        Command::new(env!("CARGO_BIN_EXE_chamfer")).arg("demo").current_dir(&folder).output();
    assert!(demo.unwrap().status.success());
    fs::create_dir(folder.path().join("models")).unwrap();
    for (model, copy) in
        [("table", "chair.glb"), ("bolt", "models/a.glb"), ("cube", "models/b.glb")]
    {
        let from = folder.path().join(format!("chamfer-demo/{model}.before.glb"));
        fs::copy(from, folder.path().join(copy)).unwrap();
    }
    folder
}

fn run_all(page: &str) -> usize {
    let text = fs::read_to_string(Path::new(ROOT).join(page)).unwrap();
    let folder = prepared();
    let mut runs = 0;
    for (command, printed) in commands(&text) {
        let Some(arguments) = command.strip_prefix("chamfer ") else {
            let is_known = ELSEWHERE.iter().any(|(start, _)| command.starts_with(start));
            assert!(is_known, "{page} shows {command:?}, which no test runs");
            continue;
        };
        let arguments: Vec<&str> =
            arguments.split_whitespace().take_while(|word| *word != "#").collect();
        let mut chamfer = Command::new(env!("CARGO_BIN_EXE_chamfer"));
        let output = chamfer.args(&arguments).current_dir(&folder).output().unwrap();
        let [out, told] = [output.stdout, output.stderr]
            .map(|text| String::from_utf8_lossy(&text).replace("\r\n", "\n"));
        assert!(output.status.success(), "{command}\n{out}{told}");
        let found: BTreeMap<String, ()> = out.lines().map(|line| (timeless(line), ())).collect();
        for line in &printed {
            assert!(
                found.contains_key(&timeless(line)),
                "{command}\nprints no {line:?}, but\n{out}"
            );
        }
        runs += 1;
    }
    runs
}

#[test]
fn the_readme_tells_what_happens() {
    assert!(run_all("README.md") >= 5);
}

#[test]
fn the_pages_tell_what_happens() {
    assert_eq!(run_all("docs/width.md") + run_all("docs/nothing-happened.md"), 2);
}
