//! Files that are broken or mean harm: an error and nothing else, or a sound result.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use chamfer::shapes;
use chamfer_formats::{ReadOptions, decode, glb};
use tempfile::TempDir;

const KILOBYTE: usize = 1024;

fn read(name: &str, bytes: &[u8]) -> Result<usize, String> {
    let options = ReadOptions::default();
    match decode(Path::new(name), bytes.to_vec(), &options) {
        Ok(document) => Ok(document.meshes().iter().map(|m| m.mesh.indices.len() / 3).sum()),
        Err(error) => Err(format!("{error:#}")),
    }
}

/// The file cut off after each kilobyte, and after the bytes around it.
fn cuts(length: usize) -> impl Iterator<Item = usize> {
    let around = (0..length).step_by(KILOBYTE).flat_map(|at| [at.saturating_sub(1), at, at + 1]);
    around.filter(move |&at| at < length).chain([length - 1])
}

fn cubes_glb() -> Vec<u8> {
    glb::encode("cubes", &shapes::cube_field(12), &[], &[]).unwrap()
}

fn cubes_obj() -> String {
    let mesh = shapes::cube_field(12);
    let point = |[x, y, z]: &[f32; 3]| format!("v {x} {y} {z}\n");
    let face =
        |corners: &[u32]| format!("f {} {} {}\n", corners[0] + 1, corners[1] + 1, corners[2] + 1);
    mesh.positions.iter().map(point).chain(mesh.indices.chunks_exact(3).map(face)).collect()
}

#[test]
fn a_glb_cut_off_anywhere_is_refused() {
    let glb = cubes_glb();
    assert!(glb.len() > 8 * KILOBYTE);
    assert_eq!(read("a.glb", &glb), Ok(144));
    for length in cuts(glb.len()) {
        let error = read("a.glb", &glb[..length]).unwrap_err();
        assert!(!error.is_empty(), "{length} bytes");
    }
}

/// Each number of the header and of the chunks, a little and far too large.
#[test]
fn wrong_lengths_in_a_glb_are_refused_or_harmless() {
    let glb = cubes_glb();
    let json_length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    for place in [8, 12, 20 + json_length] {
        for wrong in [0, 1, 3, glb.len() as u32 - 1, glb.len() as u32 + 1, u32::MAX - 7, u32::MAX] {
            let mut changed = glb.clone();
            changed[place..place + 4].copy_from_slice(&wrong.to_le_bytes());
            let read = read("a.glb", &changed);
            assert!(read.is_err(), "{wrong} at {place}: {read:?}");
        }
    }
}

#[test]
fn an_obj_or_stl_cut_off_anywhere_ends_well() {
    let obj = cubes_obj();
    let stl = {
        let mut bytes = vec![0; 80];
        bytes.extend(200u32.to_le_bytes());
        bytes.resize(84 + 200 * 50, 0);
        bytes
    };
    assert_eq!(read("a.obj", obj.as_bytes()), Ok(144));
    assert_eq!(read("a.stl", &stl), Ok(200));
    for length in cuts(obj.len()) {
        // A text that ends early can be a whole one; no face may point past the vertices.
        assert!(read("a.obj", &obj.as_bytes()[..length]).map_or(true, |faces| faces <= 144));
    }
    for length in cuts(stl.len()) {
        assert!(read("a.stl", &stl[..length]).is_err(), "{length} bytes");
    }
}

/// A folder with a model in `in`, and something beside it that is none of the model's business.
struct Folder(TempDir);

impl Folder {
    fn with_model(name: &str, text: &str) -> Folder {
        let folder = Folder(tempfile::tempdir().unwrap());
        fs::create_dir(folder.path("in")).unwrap();
        fs::write(folder.path("in").join(name), text).unwrap();
        fs::write(folder.path("secret"), [7; 36]).unwrap();
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Chamfers the model into another folder, with little memory where the shell can say so.
    fn run(&self, name: &str) -> Output {
        let chamfer = env!("CARGO_BIN_EXE_chamfer");
        let mut command = match cfg!(target_os = "linux") {
            true => {
                let mut shell = Command::new("sh");
                shell.args(["-c", "ulimit -v 2000000; exec \"$0\" \"$@\"", chamfer]);
                shell
            }
            false => Command::new(chamfer),
        };
        command.args([&format!("in/{name}"), "-o", "out/"]);
        command.current_dir(self.0.path()).output().unwrap()
    }

    /// It fails with one line that says so much, and writes nothing.
    #[track_caller]
    fn refuses(&self, name: &str, reason: &str) {
        let output = self.run(name);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(told.contains(reason) && told.trim_end().lines().count() == 1, "{told}");
        let written = fs::read_dir(self.path("out")).map_or(0, Iterator::count);
        assert_eq!(written, 0, "{told}");
    }
}

/// A triangle whose buffer is at a URI, and an image at another.
fn gltf(buffer: &str, image: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "images": [{{"uri": "{image}"}}],
        "buffers": [{{"byteLength": 36, "uri": "{buffer}"}}]}}"#
    )
}

const DATA: &str =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

#[test]
fn a_buffer_outside_of_the_models_folder_is_refused() {
    for uri in [
        "../secret",
        "%2e%2e/secret",
        "a/../../secret",
        "..\\\\secret",
        "/etc/hostname",
        "file:///etc/hostname",
        "FILE:/etc/hostname",
        "//host/share",
        "https://example.org/a.bin",
        "C:\\\\secret",
    ] {
        let folder = Folder::with_model("a.gltf", &gltf(uri, DATA));
        folder.refuses("a.gltf", "leaves the model's folder");
    }
    Folder::with_model("a.gltf", &gltf("%00", DATA)).refuses("a.gltf", "names no file");
}

#[test]
fn an_image_outside_of_the_models_folder_is_not_copied() {
    let folder = Folder::with_model("a.gltf", &gltf(DATA, "../secret"));
    folder.refuses("a.gltf", "lies above the model's folder");
}

#[cfg(unix)]
#[test]
fn links_that_lead_out_of_the_models_folder_are_refused() {
    use std::os::unix::fs::symlink;
    let leads_out = "a link leads out of the model's folder";
    for (buffer, image) in [("link", DATA), (DATA, "link")] {
        let folder = Folder::with_model("a.gltf", &gltf(buffer, image));
        symlink(folder.path("secret"), folder.path("in/link")).unwrap();
        folder.refuses("a.gltf", leads_out);
    }
    let folder = Folder::with_model("a.obj", "mtllib link\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    symlink(folder.path("secret"), folder.path("in/link")).unwrap();
    folder.refuses("a.obj", leads_out);

    let folder = Folder::with_model("a.gltf", &gltf("link", DATA));
    fs::write(folder.path("in/buffer"), [0; 36]).unwrap();
    symlink("buffer", folder.path("in/link")).unwrap();
    assert_eq!(folder.run("a.gltf").status.code(), Some(0), "a link within the folder is fine");
}

#[test]
fn a_pipe_beside_the_model_does_not_block() {
    let folder = Folder::with_model("a.gltf", &gltf("pipe", DATA));
    if Command::new("mkfifo").arg(folder.path("in/pipe")).status().is_ok_and(|s| s.success()) {
        folder.refuses("a.gltf", "not a file");
    }
}

#[test]
fn gigantic_counts_in_a_small_file_are_refused() {
    let model = gltf(DATA, DATA);
    for (right, wrong, reason) in [
        (r#""count": 3"#, r#""count": 4294967295"#, "past the end"),
        (r#""count": 3"#, r#""count": 1e18"#, "past the end"),
        (r#""bufferView": 0, "#, "", ""),
        (r#""byteLength": 36, "uri""#, r#""byteLength": 99999999999, "uri""#, "cut off"),
        (
            r#""byteLength": 36}]"#,
            r#""byteLength": 36, "byteStride": 9999999999}]"#,
            "past the end",
        ),
    ] {
        let mut changed = model.replacen(right, wrong, 1);
        if wrong.is_empty() {
            changed = changed.replacen(r#""count": 3"#, r#""count": 4000000000"#, 1);
        }
        Folder::with_model("a.gltf", &changed).refuses("a.gltf", reason);
    }
    let stl = [&[0; 80][..], &u32::MAX.to_le_bytes()].concat();
    assert!(read("a.stl", &stl).unwrap_err().contains("announces 4294967295 triangles"));
}

#[test]
fn cyclic_nodes_are_refused() {
    let cycle = gltf(DATA, DATA).replace(r#"[{"mesh": 0}]"#, r#"[{"mesh": 0, "children": [0]}]"#);
    Folder::with_model("a.gltf", &cycle).refuses("a.gltf", "nodes[0]");
}

/// Nested deeper than any stack.
#[test]
fn a_json_of_brackets_is_refused() {
    let deep = "[".repeat(200_000);
    Folder::with_model("a.gltf", &deep).refuses("a.gltf", "JSON");
}
