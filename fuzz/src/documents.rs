//! Model files: what must hold when one is read, chamfered and written.

use std::path::Path;

use chamfer::{Chamfered, MeshBuffers, Options, Verify, Width, chamfer};
use chamfer_formats::{Document, Encoded, FORMATS, Format, ReadOptions, decode, encode, row_of};

use crate::oracle::chamfer_and_check;

/// Larger meshes are only read: a byte can ask for many triangles, and the core has a target of its
/// own.
const MOST_CHAMFERED: usize = 600;

fn options() -> Options {
    Options::default().with_width(Width::PercentOfExtent(2.0)).with_verify(Verify::Fast)
}

/// Reads a file from memory; where that goes well, chamfers it, writes it in every format that it
/// can have, and reads that again. Nothing is looked for on disk, as the folder does not exist.
///
/// # Panics
/// Where a promise is broken.
pub fn read_chamfer_write(extension: &str, bytes: &[u8]) {
    let path = Path::new("/nowhere/at/all").join("model").with_extension(extension);
    let Some(document) = read(&path, bytes) else { return };
    for (mesh, normals) in document.meshes().iter().zip(document.normals()) {
        check_whole(&mesh.mesh);
        let vertices = mesh.mesh.positions.len();
        assert!(normals.repaired.iter().all(|(vertex, _)| (*vertex as usize) < vertices));
    }
    let meshes = document.meshes().len();
    assert!(document.instances().iter().all(|instance| instance.mesh < meshes));
    let corners: usize = document.meshes().iter().map(|mesh| mesh.mesh.indices.len()).sum();
    if corners > 3 * MOST_CHAMFERED {
        return;
    }
    let chamfered = document.meshes().iter().map(|mesh| chamfer_and_check(&mesh.mesh, &options()));
    let Some(chamfered) = chamfered.collect::<Option<Vec<Chamfered>>>() else { return };
    let from = row_of(&path).expect("the targets give known extensions");
    for to in FORMATS.iter().filter(|to| from.check_conversion(to).is_ok()) {
        write(document.as_ref(), &chamfered, &path.with_extension(to.ending));
    }
}

fn read(path: &Path, bytes: &[u8]) -> Option<Box<dyn Document + Send>> {
    let options = ReadOptions::default();
    match decode(path, bytes.to_vec(), &options) {
        Ok(document) => Some(document),
        Err(error) => {
            assert!(!format!("{error:#}").is_empty());
            None
        }
    }
}

/// What a reader hands over keeps the rules on lengths and indices.
fn check_whole(mesh: &MeshBuffers) {
    let vertices = mesh.positions.len();
    assert_eq!(mesh.normals.len(), vertices);
    assert!(mesh.indices.iter().all(|&index| (index as usize) < vertices));
    let unmoved = options().with_width(Width::Units(0.0));
    if mesh.indices.len() <= 3 * MOST_CHAMFERED {
        let refused = chamfer(&mesh.as_mesh(), &unmoved).err();
        assert!(refused.is_none(), "{refused:?}");
    }
}

fn write(document: &dyn Document, chamfered: &[Chamfered], output: &Path) {
    let Ok(Encoded { files, .. }) = encode(document, output, chamfered) else { return };
    assert_eq!(files[0].path, output);
    let is_alone = files.len() == 1;
    if is_alone && row_of(output).is_some_and(|row| row.format != Format::Gltf) {
        let options = ReadOptions::default();
        let again = decode(output, files[0].bytes.clone(), &options);
        let again = again.map_err(|error| format!("{error:#}")).expect("what is written is read");
        let triangles = |document: &dyn Document| -> usize {
            document.meshes().iter().map(|mesh| mesh.mesh.indices.len() / 3).sum()
        };
        let expected: usize = chamfered.iter().map(|mesh| mesh.mesh.indices.len() / 3).sum();
        assert_eq!(triangles(again.as_ref()), expected, "{}", output.display());
    }
}
