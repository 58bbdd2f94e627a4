//! The pages agree with the code that they show and explain.

use std::fs;
use std::path::Path;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A README shows an example as it is.
#[track_caller]
fn assert_shown(page: &str, language: &str, path: &str) {
    let example = fs::read_to_string(Path::new(ROOT).join(path)).unwrap();
    assert!(
        page.contains(&format!("```{language}\n{example}```\n")),
        "no README shows {path} as it is: copy the file there"
    );
}

#[test]
fn the_readme_shows_the_examples_that_are_tested() {
    let page = include_str!("../README.md");
    assert_shown(page, "rust", "examples/rust/chamfer_cube.rs");
    assert_shown(page, "c", "examples/c/chamfer_cube.c");
    assert_shown(page, "python", "examples/python/chamfer_cube.py");
    let page = include_str!("../python/README.md");
    assert_shown(page, "python", "examples/python/with_trimesh.py");
}

/// The sections of a page up to a heading: their titles and their texts.
fn sections<'a>(page: &'a str, until: &str) -> Vec<(&'a str, &'a str)> {
    let part = page.split_once(until).map_or(page, |(before, _)| before);
    part.split("\n## ").skip(1).filter_map(|section| section.split_once('\n')).collect()
}

#[test]
fn each_stage_shows_its_figure() {
    let page = include_str!("../docs/pipeline.md");
    let stages = sections(page, "\n# Helpers\n");
    for (title, text) in &stages {
        let link = format!("](figures/{}.svg)", title.to_lowercase());
        assert!(text.contains(&link), "the section {title} of docs/pipeline.md lacks its figure");
    }
    let figures = fs::read_dir(Path::new(ROOT).join("docs/figures")).unwrap();
    assert_eq!(figures.count(), stages.len(), "each figure is shown, and each one shown is there");
}

/// A stage or helper is a file in src whose header begins with its name and a colon.
#[test]
fn the_pipeline_page_has_a_section_for_each_stage() {
    let page = include_str!("../docs/pipeline.md");
    let mut stages = 0;
    for entry in fs::read_dir(Path::new(ROOT).join("src")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let Some((title, _)) = text.strip_prefix("//! ").and_then(|text| text.split_once(':'))
        else {
            continue;
        };
        let stem = path.file_stem().unwrap().to_string_lossy();
        if title.to_lowercase() == stem {
            stages += 1;
            let heading = format!("\n## {title}\n");
            assert!(page.contains(&heading), "docs/pipeline.md lacks a section {title}");
        }
    }
    assert!(stages > 0, "no file in src is headed by its name");
}

/// The address of the project stands in Cargo.toml; the pages follow it.
#[test]
fn pages_name_the_address_of_the_project() {
    let address = env!("CARGO_PKG_REPOSITORY");
    for page in ["README.md", "python/README.md"] {
        let path = Path::new(ROOT).join(page);
        let text = fs::read_to_string(&path).unwrap();
        let told = with_address(&text, address);
        if std::env::var_os("CHAMFER_UPDATE_ADDRESS").is_some() {
            fs::write(&path, &told).unwrap();
        } else {
            assert!(
                told == text,
                "{page} has another address: CHAMFER_UPDATE_ADDRESS=1 cargo test --test pages"
            );
        }
    }
}

/// The page with this address in the place of all that end in /chamfer.
fn with_address(page: &str, address: &str) -> String {
    let mut parts = page.split("https://");
    let first = parts.next().unwrap_or("").to_owned();
    parts.fold(first, |told, part| {
        let end = part.find(char::is_whitespace).unwrap_or(part.len());
        match part[..end].split_once("/chamfer") {
            Some((_, rest)) => told + address + rest + &part[end..],
            None => told + "https://" + part,
        }
    })
}

#[test]
fn an_address_is_found_where_it_stands() {
    let page = "see https://example.org/x and https://a.org/b/chamfer.git#upm now";
    let told = "see https://example.org/x and https://c.org/chamfer.git#upm now";
    assert_eq!(with_address(page, "https://c.org/chamfer"), told);
}
