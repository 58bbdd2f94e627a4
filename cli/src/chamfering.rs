//! Chamfers the meshes of a file as they stand in its scene.

use std::ops::ControlFlow;

use anyhow::{Context, Result};
use chamfer::see_through::Eyes;
use chamfer::{ChamferedScene, Mesh, Options, Verify, chamfer_scene, chamfer_with_progress};
use chamfer_formats::Document;

use crate::fit::{Wish, fit};

/// Chamfers the meshes of a file as they stand in its scene: what rests on another is left to rest,
/// and with [`Verify::Seen`] the whole is looked at. `progress` is told the share done (0 to 1).
///
/// # Errors
/// Whatever is wrong with a mesh or the options.
pub fn chamfer_document(
    document: &dyn Document,
    wish: &Wish,
    progress: &dyn Fn(f32),
) -> Result<ChamferedScene> {
    let fit = fit(document, wish)?;
    let meshes = fit.meshes(document);
    let Options { verify, threads, .. } = wish.core;
    let eyes = (verify == Verify::Seen).then(|| Eyes::default().with_threads(threads));
    // The scene looks through all meshes together.
    let each = if verify == Verify::Seen { Verify::Full } else { verify };
    let total: usize = meshes.iter().map(|mesh| mesh.indices.len()).sum();
    let mut done = 0;
    let mut run = |number: usize, mesh: &Mesh| {
        let mut tell = |share: f32| {
            let corners = done as f32 + share * mesh.indices.len() as f32;
            progress((corners / total.max(1) as f32).min(1.0));
            ControlFlow::Continue(())
        };
        let options = fit.options[number].with_verify(each);
        let result = chamfer_with_progress(mesh, &options, &mut tell)
            .with_context(|| format!("mesh {}", document.meshes()[number].name))?;
        done += mesh.indices.len();
        Ok(result)
    };
    chamfer_scene(&meshes, &document.instances(), eyes, &mut run)
}
