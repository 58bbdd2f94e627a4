//! The figures of `docs/pipeline.md`: each stage's values on small models, drawn as SVG.
//!
//! `CHAMFER_UPDATE_FIGURES=1 cargo test --lib figures` writes them to `docs/figures`; without that
//! variable the test fails where a committed figure is not what the code draws.

mod contacts;
mod drawing;
mod models;
mod moves;
mod result;
mod rounding;
mod scene;
mod source;
mod texture;
mod widths;

use std::fs;
use std::path::PathBuf;

use drawing::Drawing;

/// What draws a figure.
type Draw = fn() -> Drawing;

/// The stages, in the order of the pipeline.
const FIGURES: [(&str, Draw); 23] = [
    ("view", source::view),
    ("weld", source::weld),
    ("topology", source::topology),
    ("faces", source::faces),
    ("contacts", contacts::contacts),
    ("selection", widths::selection),
    ("edges", source::edges),
    ("sectors", moves::sectors),
    ("offsets", moves::offsets),
    ("refine", contacts::refine),
    ("room", moves::room),
    ("vanishing", moves::vanishing),
    ("evenness", moves::evenness),
    ("limits", moves::limits),
    ("patches", result::patches),
    ("strips", result::strips),
    ("fills", result::fills),
    ("rounding", rounding::rounding),
    ("verdicts", result::verdicts),
    ("flaps", widths::flaps),
    ("attributes", texture::attributes),
    ("charts", texture::charts),
    ("output", result::output),
];

#[test]
fn the_committed_figures_are_what_the_code_draws() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/figures");
    let is_update = std::env::var_os("CHAMFER_UPDATE_FIGURES").is_some();
    for (name, draw) in FIGURES {
        let path = folder.join(name).with_extension("svg");
        let drawn = draw().finish();
        if is_update {
            fs::create_dir_all(&folder).unwrap();
            fs::write(&path, drawn).unwrap();
            continue;
        }
        let committed = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            committed == drawn,
            "docs/figures/{name}.svg is out of date: look at what \
             CHAMFER_UPDATE_FIGURES=1 cargo test --lib figures writes, and commit it"
        );
    }
}
