//! One file from reading to writing.

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use anyhow::{Context, Result, bail};
use chamfer::{Chamfered, Options, chamfer_with_progress};

use crate::document::{Document, OutputFile, ReadOptions, SourceMesh};
use crate::format;
use crate::jobs::{Job, identity};
use crate::report::MeshReport;
use crate::write;

/// What is the same for every file of a run.
pub struct Settings {
    /// For the readers.
    pub read: ReadOptions,
    /// For the core.
    pub core: Options,
    /// Whether the report lists every hard edge.
    pub report_edges: bool,
    /// Files that must not be written, and those that were.
    pub taken: Taken,
}

/// A file that was read, chamfered and written.
pub struct Processed {
    /// As it was read.
    pub document: Box<dyn Document + Send>,
    /// `#meshes`.
    pub chamfered: Vec<Chamfered>,
    /// `#meshes`.
    pub reports: Vec<MeshReport>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// Chamfers one file. `progress` is told the share done (0 to 1).
///
/// # Errors
/// Whatever is wrong with the file, the options or the place of the result.
pub fn process(job: &Job, settings: &Settings, progress: &dyn Fn(f32)) -> Result<Processed> {
    let document = format::read(&job.input, &settings.read)?;
    let mut notes = document.notes();
    if document.meshes().iter().all(|mesh| mesh.mesh.indices.is_empty()) {
        notes.push("there are no triangles in it: nothing was chamfered".into());
    }
    let (chamfered, reports) = chamfer_all(document.meshes(), settings, progress)?;
    let files = document.encode(&job.output, &chamfered)?;
    settings.taken.claim(job, &files)?;
    write::together(&files)?;
    Ok(Processed { document, chamfered, reports, notes })
}

fn chamfer_all(
    meshes: &[SourceMesh],
    settings: &Settings,
    progress: &dyn Fn(f32),
) -> Result<(Vec<Chamfered>, Vec<MeshReport>)> {
    let total: usize = meshes.iter().map(|mesh| mesh.mesh.indices.len()).sum();
    let mut done = 0;
    let mut results = (Vec::new(), Vec::new());
    for SourceMesh { name, mesh } in meshes {
        let mut tell = |share: f32| {
            progress((done as f32 + share * mesh.indices.len() as f32) / total.max(1) as f32);
            ControlFlow::Continue(())
        };
        let start = Instant::now();
        let result = chamfer_with_progress(&mesh.as_mesh(), &settings.core, &mut tell)
            .with_context(|| format!("mesh {name}"))?;
        let report = MeshReport::new(name, mesh, &result, start.elapsed());
        results.1.push(match settings.report_edges {
            true => report.with_edges(mesh, &result),
            false => report,
        });
        results.0.push(result);
        done += mesh.indices.len();
    }
    Ok(results)
}

/// Paths that a result must not go to: models of this run, and files that belong to other results.
#[derive(Default)]
pub struct Taken(Mutex<BTreeMap<PathBuf, Content>>);

enum Content {
    /// A model that was given, or the result of one.
    Model,
    /// A file beside a result: a hash of what it holds.
    Companion(u64),
}

impl Taken {
    /// The inputs and outputs of a run.
    pub fn new(jobs: &[Job]) -> Taken {
        let paths = jobs.iter().flat_map(|job| [&job.input, &job.output]);
        Taken(Mutex::new(paths.map(|path| (identity(path), Content::Model)).collect()))
    }

    /// Takes the paths of the files that belong to a result. Several results may share one, such
    /// as a texture, as long as it is the same for all.
    fn claim(&self, job: &Job, files: &[OutputFile]) -> Result<()> {
        let mut taken = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for file in files.iter().filter(|file| file.path != job.output) {
            let mut hasher = DefaultHasher::new();
            file.bytes.hash(&mut hasher);
            let hash = hasher.finish();
            match taken.insert(identity(&file.path), Content::Companion(hash)) {
                None => {}
                Some(Content::Companion(other)) if other == hash => {}
                Some(_) => bail!(
                    "{} belongs to another model of this run: choose different folders",
                    file.path.display()
                ),
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(name: &str) -> Job {
        Job { input: name.into(), output: format!("out/{name}").into() }
    }

    fn file(path: &str, text: &str) -> OutputFile {
        OutputFile { path: path.into(), bytes: text.into() }
    }

    #[test]
    fn results_share_a_file_only_if_it_is_the_same() {
        let (a, b) = (job("a.gltf"), job("b.gltf"));
        let taken = Taken::new(&[a.clone(), b.clone()]);
        let texture = |text| [file("out/a.gltf", ""), file("out/t.png", text)];
        assert!(taken.claim(&a, &texture("red")).is_ok());
        assert!(taken.claim(&b, &texture("red")[1..]).is_ok());
        let error = taken.claim(&b, &texture("blue")[1..]).unwrap_err().to_string();
        assert!(error.contains("t.png belongs to another model"), "{error}");
    }

    #[test]
    fn a_companion_cannot_replace_a_model() {
        let taken = Taken::new(&[job("a.gltf"), job("b.glb")]);
        assert!(taken.claim(&job("a.gltf"), &[file("out/b.glb", "")]).is_err());
        assert!(taken.claim(&job("a.gltf"), &[file("b.glb", "")]).is_err());
    }
}
