//! The reader and writer of glTF, on bytes of any kind and on a rich file with arbitrary changes.
#![no_main]

use arbitrary::Arbitrary;
use chamfer_fuzz::documents::read_chamfer_write;
use chamfer_fuzz::edits::Edit;
use chamfer_fuzz::gltf::{rich_binary, rich_json, wrap_in_chunks, wrap_in_json};
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
enum Input {
    Raw(bool, Vec<u8>),
    /// Changes to the JSON, to bytes of the buffer, and whether it is one file of chunks.
    Changed(Vec<Edit>, Vec<(u16, u8)>, bool),
    /// The same, with changes to the bytes of the whole file, cut off after so many.
    Damaged(Vec<Edit>, Vec<(u16, u8)>, Option<u16>),
}

fuzz_target!(|input: Input| {
    match input {
        Input::Raw(chunks, bytes) => read_chamfer_write(extension(chunks), &bytes),
        Input::Changed(edits, damages, chunks) => {
            let json = changed(&edits);
            let mut binary = rich_binary();
            damage(&mut binary, &damages);
            let file =
                if chunks { wrap_in_chunks(&json, &binary) } else { wrap_in_json(json, &binary) };
            read_chamfer_write(extension(chunks), &file);
        }
        Input::Damaged(edits, damages, length) => {
            let mut file = wrap_in_chunks(&changed(&edits), &rich_binary());
            damage(&mut file, &damages);
            file.truncate(length.map_or(file.len(), usize::from));
            read_chamfer_write("glb", &file);
        }
    }
});

fn extension(chunks: bool) -> &'static str {
    if chunks { "glb" } else { "gltf" }
}

fn changed(edits: &[Edit]) -> serde_json::Value {
    let mut json = rich_json();
    edits.iter().take(12).for_each(|edit| edit.apply(&mut json));
    json
}

fn damage(bytes: &mut [u8], damages: &[(u16, u8)]) {
    for &(place, byte) in damages.iter().take(16) {
        let place = usize::from(place) % bytes.len();
        bytes[place] = byte;
    }
}
