//! One file from reading to writing.

use std::collections::{BTreeMap, BTreeSet};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use anyhow::{Result, bail};
use chamfer::Chamfered;
use chamfer_formats as formats;
use chamfer_formats::paths::identity;
use chamfer_formats::weld;
use chamfer_formats::{Document, Encoded, OutputFile, ReadOptions, SourceMesh};
use glam::{Mat4, Vec3};

use crate::budget::{Count, count, within};
use crate::chamfering::chamfer_document;
use crate::fit::{Wish, unmet};
use crate::jobs::Job;
use crate::nothing;
use crate::report::MeshReport;
use crate::stretch;
use crate::write::{self, Written};

/// What is the same for every file of a run.
pub struct Settings {
    /// For the readers.
    pub read: ReadOptions,
    /// What is asked of the meshes.
    pub wish: Wish,
    /// Whether the report lists every hard edge.
    pub report_edges: bool,
    /// Whether results are compressed.
    pub compresses: bool,
    /// How many triangles a file may have.
    pub max_triangles: Option<u64>,
    /// Whether nothing is written.
    pub is_dry: bool,
    /// Files that must not be written, and those that were.
    pub taken: Taken,
}

/// A file that was read, chamfered and written.
pub struct Processed {
    /// As it was read.
    pub document: Box<dyn Document + Send>,
    /// `#meshes`.
    pub chamfered: Vec<Chamfered>,
    /// For each mesh that is written.
    pub reports: Vec<MeshReport>,
    /// What the user should know.
    pub notes: Vec<String>,
    /// Kept until the file is told of; none where nothing is written.
    pub written: Option<Written>,
}

/// Chamfers one file. `progress` is told the share done (0 to 1).
///
/// # Errors
/// Whatever is wrong with the file, the options or the place of the result.
pub fn process(job: &Job, settings: &Settings, progress: &dyn Fn(f32)) -> Result<Processed> {
    let mut document = formats::read(&job.input, &settings.read)?;
    let mut notes = document.notes();
    notes.extend(unmet(&*document, &settings.wish));
    if !settings.wish.per_mesh {
        notes.extend(stretch::part(&mut *document));
    }
    if document.meshes().iter().all(|mesh| mesh.mesh.indices.is_empty()) {
        notes.push("there are no triangles in it: nothing was chamfered".into());
    }
    let (chamfered, reports) = chamfer_all(&*document, settings, progress, &mut notes)?;
    let far_out = document.meshes().iter().zip(&chamfered).filter_map(too_far_out);
    let apart = document.meshes().iter().filter_map(nearly_touching);
    let reasons: Vec<String> =
        far_out.chain(apart).chain(meshes_that_touch(&*document, &chamfered)).collect();
    if reasons.is_empty() && nothing::is_untouched(&chamfered) {
        notes.extend(nothing::no_hard_edges(&*document, settings.read.smoothing_angle));
    }
    notes.extend(reasons);
    notes.extend(nothing::little(&reports));
    if settings.is_dry {
        let Count { triangles, vertices } = count(&*document, &chamfered);
        notes.push(format!("not written: {triangles} triangles, {vertices} vertices"));
        let mut told = BTreeSet::new();
        notes.retain(|note| told.insert(note.clone()));
        return Ok(Processed { document, chamfered, reports, notes, written: None });
    }
    let mut encoded = formats::encode(&*document, &job.output, &chamfered)?;
    if settings.compresses {
        formats::compress(&mut encoded)?;
    }
    let Encoded { files, notes: lost } = encoded;
    notes.extend(lost);
    // What is said of a mesh is said of its copies too.
    let mut told = BTreeSet::new();
    notes.retain(|note| told.insert(note.clone()));
    settings.taken.claim(job, &files)?;
    let written = Some(write::model(&files)?);
    Ok(Processed { document, chamfered, reports, notes, written })
}

/// Says where edges may be open that nobody sees.
fn nearly_touching(SourceMesh { name, mesh }: &SourceMesh) -> Option<String> {
    let (count, distance) = weld::nearly_touching(&mesh.positions, &mesh.indices);
    (count > 0).then(|| {
        format!(
            "mesh {name}: {count} vertices are not where others are, but within {distance:.1e} of them: \
             edges between them may be open, and stay as they are then; --weld auto joins them"
        )
    })
}

/// Says that edges between meshes stay, where there are no others.
fn meshes_that_touch(document: &dyn Document, chamfered: &[Chamfered]) -> Option<String> {
    let instances = document.instances();
    if instances.len() < 2 || chamfered.iter().any(|result| !result.verdicts.is_empty()) {
        return None;
    }
    let mut places: Vec<([u32; 3], usize)> = Vec::new();
    for (number, instance) in instances.iter().enumerate() {
        let transform = Mat4::from_cols_array_2d(&instance.transform);
        let positions = document.meshes()[instance.mesh].mesh.positions.iter();
        let place = |&at: &[f32; 3]| transform.transform_point3(Vec3::from(at)) + Vec3::ZERO;
        places.extend(positions.map(|at| (place(at).to_array().map(f32::to_bits), number)));
    }
    places.sort_unstable();
    places.dedup();
    let shared = places.chunk_by(|(one, _), (other, _)| one == other);
    let count = shared.filter(|same| same.len() > 1).count();
    (count > 1).then(|| {
        format!(
            "no mesh has a hard edge of its own, but {count} places belong to several: edges between \
             meshes are not chamfered, so join the meshes first"
        )
    })
}

/// A chamfer that is so few steps of its coordinates wide is bent by rounding, and held back.
const LEAST_STEPS: f32 = 16.0;

/// Says where a mesh lies too far from the origin for its chamfers.
fn too_far_out((SourceMesh { name, mesh }, result): (&SourceMesh, &Chamfered)) -> Option<String> {
    let farthest = mesh.positions.as_flattened().iter().fold(0.0f32, |most, at| most.max(at.abs()));
    let step = farthest * f32::EPSILON;
    let is_fine = result.verdicts.is_empty() || result.width >= LEAST_STEPS * step;
    (!is_fine && result.width > 0.0).then(|| {
        format!(
            "mesh {name} lies so far from the origin ({farthest}) that its coordinates go in steps \
             of {step}, too coarse for chamfers of {}: move it there, and let its node's transform \
             say where it stands",
            result.width
        )
    })
}

/// Chamfers the meshes of a file together, as they stand in its scene.
fn chamfer_all(
    document: &dyn Document,
    settings: &Settings,
    progress: &dyn Fn(f32),
    notes: &mut Vec<String>,
) -> Result<(Vec<Chamfered>, Vec<MeshReport>)> {
    let start = Instant::now();
    let scene = match settings.max_triangles {
        None => chamfer_document(document, &settings.wish, progress)?,
        Some(most) => {
            let (scene, told) = within(document, &settings.wish, most, progress)?;
            notes.push(told);
            scene
        }
    };
    if !scene.leaks.is_empty() {
        notes.push(format!(
            "light still shows in {} places after {} tries: see \"chamfer check\"",
            scene.leaks.len(),
            scene.rounds
        ));
    }
    let time = start.elapsed() / document.meshes().len().max(1) as u32;
    let extent =
        document.meshes().iter().map(|mesh| extent(&mesh.mesh.positions)).fold(0.0, f64::max);
    let report = |(SourceMesh { name, mesh }, result): (&SourceMesh, &Chamfered)| {
        let report = MeshReport::new(name, mesh, result, time, extent);
        if settings.report_edges { report.with_edges(mesh, result) } else { report }
    };
    let is_written = document.are_written(&scene.meshes);
    let meshes = document.meshes().iter().zip(&scene.meshes).zip(is_written);
    let reports =
        meshes.filter(|(_, is_written)| *is_written).map(|(mesh, _)| report(mesh)).collect();
    Ok((scene.meshes, reports))
}

/// The largest side of the box around points.
fn extent(positions: &[[f32; 3]]) -> f64 {
    let bound = |axis: usize, start: f32, choose: fn(f32, f32) -> f32| {
        f64::from(positions.iter().map(|at| at[axis]).fold(start, choose))
    };
    let side = |axis| bound(axis, f32::MIN, f32::max) - bound(axis, f32::MAX, f32::min);
    (0..3).map(side).fold(0.0, f64::max)
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
    fn chamfers_far_from_the_origin_are_told_of() {
        let note = |shift: f32, width: f32| {
            let mut mesh = chamfer::shapes::plain_cube(1.0);
            mesh.positions.iter_mut().for_each(|position| position[0] += shift);
            let options = chamfer::Options::default().with_width(chamfer::Width::Units(width));
            let result = chamfer::chamfer(&mesh.as_mesh(), &options).unwrap();
            too_far_out((&SourceMesh { name: "a".into(), mesh }, &result))
        };
        assert_eq!(note(0.0, 0.01), None);
        assert_eq!(note(5e4, 0.0), None);
        assert!(note(5e4, 0.01).unwrap().starts_with("mesh a lies so far from the origin (50000"));
        assert_eq!(note(5e4, 0.1), None);
    }

    #[test]
    fn a_companion_cannot_replace_a_model() {
        let taken = Taken::new(&[job("a.gltf"), job("b.glb")]);
        assert!(taken.claim(&job("a.gltf"), &[file("out/b.glb", "")]).is_err());
        assert!(taken.claim(&job("a.gltf"), &[file("b.glb", "")]).is_err());
    }
}
