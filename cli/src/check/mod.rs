//! `chamfer check`: is a chamfered file sound? The whole-mesh checker of the core, file by file.

mod expected;
mod extras;
mod light;
mod materials;
mod pairs;
mod report;
mod table;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;

use anyhow::{Result, anyhow, ensure};
use chamfer::check::{Extras, Findings, MeasuredEdge, Rule, compare_with};
use chamfer::{Chamfered, EdgeVerdict, MeshBuffers, Outcome, Reason};
use chamfer_formats as formats;
use chamfer_formats::paths::identity;
use chamfer_formats::weld::nearly_touching;
use chamfer_formats::{Document, Instance, NormalsRead, Place, ReadOptions};

use crate::args::{CheckArgs, CheckDepth};
use crate::batch::{USAGE, name_of};
use crate::choices::Choices;
use crate::console::{say, warn, with_causes};
use crate::preset;
use crate::scene::largest_length;
use crate::stretch::stretches;
use crate::write;

use expected::expected;
use extras::Streams;
use pairs::Pairs;
use report::{CheckReport, MeshCheck, SeeThrough, Verdict};

/// Checks the file that the arguments name.
pub fn run(args: &CheckArgs) -> ExitCode {
    match check(args) {
        Ok(verdict) => ExitCode::from(verdict.exit_code()),
        Err(error) => {
            warn(with_causes(&error));
            ExitCode::from(USAGE)
        }
    }
}

/// Says what was found.
fn check(args: &CheckArgs) -> Result<Verdict> {
    refuse_to_overwrite(args)?;
    let choices = args.options.as_deref().map(preset::choices).transpose()?;
    let reading = choices.as_ref().map_or(args.read_options_before(), Choices::read_options);
    let mut before = read(&args.before, &reading)?;
    let after = read(&args.after, &args.read_options())?;
    part(&mut *before, &*after);
    let pairs = Pairs::new(before.meshes(), after.meshes());
    let expected = expected(&*before, &*after, args, choices.as_ref())?;
    let is_own = args.per_mesh || choices.as_ref().is_some_and(|choices| choices.wish(1).per_mesh);
    let hard_angle = args.hard_angle.or(choices.as_ref().map(|choices| choices.hard_angle));
    let stretches = if is_own { Vec::new() } else { stretches(&*before) };
    let checks = pairs.both.iter().map(|&[source, result]| {
        let wanted = Wanted {
            expected: expected.get(source),
            scale: stretches.get(source).copied().flatten().and_then(|stretch| stretch.shape()),
            hard_angle,
        };
        let source = Side { document: &*before, mesh: source };
        check_pair(source, Side { document: &*after, mesh: result }, wanted, args)
    });
    let mut checks: Vec<MeshCheck> = checks.collect();
    for (check, &[source, _]) in checks.iter_mut().zip(&pairs.both) {
        check.expect_places(&placed_otherwise([&*before, &*after], source));
    }
    let documents = [&*before as &dyn Document, &*after];
    let report = CheckReport::new(
        [&args.before, &args.after],
        missing(&*before, &pairs),
        pairs.added.iter().map(|&mesh| after.meshes()[mesh].name.clone()).collect(),
        see_through(args, documents, &pairs, &checks, &expected),
        (checks, moved(documents)),
    );
    say(table::table(&report));
    if let Some(path) = &args.report {
        write::alone(path, report.to_json()?)?;
    }
    if let Some(path) = &args.preview {
        light::draw(path, &name_of(&args.after), documents, &report.see_through)?;
    }
    Ok(report.verdict)
}

/// How far an entry of a transform may be off, relative to its largest: a few roundings.
const SAME_PLACE: f32 = 1e-5;

/// The objects of a mesh of the source, by their numbers, that stand otherwise in the result. Where
/// there are fewer objects or more, they cannot be told apart by number, and each counts that stands
/// where none does.
fn placed_otherwise([before, after]: [&dyn Document; 2], mesh: usize) -> Vec<usize> {
    let [old, new] = [before.instances(), after.instances()];
    let is_same =
        |one: &Instance, other: &Instance| is_same_place([one.transform, other.transform]);
    let stands = |(number, object): (usize, &Instance)| match old.len() == new.len() {
        true => is_same(object, &new[number]),
        false => new.iter().any(|other| is_same(object, other)),
    };
    let objects = old.iter().enumerate().filter(|(_, object)| object.mesh == mesh);
    objects.filter(|&object| !stands(object)).map(|(number, _)| number).collect()
}

/// The names of the meshes that are gone. One without triangles is nothing to lose: not every format
/// can say that it is there.
fn missing(before: &dyn Document, pairs: &Pairs) -> Vec<String> {
    let meshes = pairs.missing.iter().map(|&mesh| &before.meshes()[mesh]);
    meshes.filter(|mesh| !mesh.mesh.indices.is_empty()).map(|mesh| mesh.name.clone()).collect()
}

fn refuse_to_overwrite(args: &CheckArgs) -> Result<()> {
    let mut taken = vec![identity(&args.before), identity(&args.after)];
    for path in [&args.report, &args.preview].into_iter().flatten() {
        ensure!(!taken.contains(&identity(path)), "{}: named for two files", path.display());
        taken.push(identity(path));
    }
    Ok(())
}

fn see_through(
    args: &CheckArgs,
    documents: [&dyn Document; 2],
    pairs: &Pairs,
    checks: &[MeshCheck],
    expected: &[Chamfered],
) -> SeeThrough {
    if args.no_see_through {
        return SeeThrough::not_checked("left out by --no-see-through");
    }
    let check_of = |mesh: usize| pairs.both.iter().position(|[source, _]| *source == mesh);
    let width = |mesh: usize| match expected.get(mesh) {
        Some(expected) => Some(expected.largest_width),
        None => checks[check_of(mesh)?].width,
    };
    light::look(documents, largest_length(documents[0], width))
}

fn read(path: &Path, options: &ReadOptions) -> Result<Box<dyn Document + Send>> {
    formats::read(path, options).map_err(|error| anyhow!("{}: {error:#}", path.display()))
}

/// A mesh of one of the two files.
#[derive(Clone, Copy)]
struct Side<'a> {
    document: &'a dyn Document,
    mesh: usize,
}

impl Side<'_> {
    fn name(&self) -> &str {
        &self.document.meshes()[self.mesh].name
    }

    fn normals(&self) -> &NormalsRead {
        &self.document.normals()[self.mesh]
    }

    /// `#submeshes`: the names of its materials, where the format has any.
    fn materials(&self) -> Vec<Option<String>> {
        let known = self.document.materials().get(self.mesh).cloned();
        known.unwrap_or_else(|| {
            vec![None; self.document.meshes()[self.mesh].mesh.submesh_index_counts.len()]
        })
    }

    /// The mesh as it is in the file: with the normals that reading repaired, and with texture coordinates
    /// that count from above, whichever way those of the file do.
    fn as_stored(&self) -> MeshBuffers {
        let mut mesh = self.document.meshes()[self.mesh].mesh.clone();
        if self.document.counts_from_below() {
            for uv in mesh.uvs.iter_mut().filter(|uv| uv.components > 1) {
                uv.values
                    .chunks_exact_mut(uv.components as usize)
                    .for_each(|at| at[1] = 1.0 - at[1]);
            }
        }
        for &(vertex, normal) in &self.normals().repaired {
            mesh.normals[vertex as usize] = normal;
        }
        mesh
    }
}

/// Gives objects of one mesh copies of it where the result has several for them, as it has where they
/// stand with different scales.
fn part(before: &mut dyn Document, after: &dyn Document) {
    let known = before.meshes().len();
    let [old, new] = [before.instances(), after.instances()];
    if old.len() != new.len() || after.meshes().len() <= known {
        return;
    }
    let mut objects: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (number, instance) in new.iter().enumerate().filter(|(_, object)| object.mesh >= known) {
        objects.entry(instance.mesh).or_default().push(number);
    }
    let is_of_one = |of: &&Vec<usize>| of.iter().all(|&k| old[k].mesh == old[of[0]].mesh);
    objects.values().take_while(is_of_one).for_each(|of| before.give_own(of));
}

/// What was asked of a mesh.
struct Wanted<'a> {
    /// What chamfering it would give, where that is known.
    expected: Option<&'a Chamfered>,
    /// How it stands in the scene, where it is stretched.
    scale: Option<[[f32; 3]; 3]>,
    /// From where on normals differ, where that is known.
    hard_angle: Option<f32>,
}

fn check_pair(source: Side, result: Side, wanted: Wanted, args: &CheckArgs) -> MeshCheck {
    let expected = wanted.expected;
    let [before, after] = [source.as_stored(), result.as_stored()];
    let numbers = materials::numbers([&source.materials(), &result.materials()]);
    let counts = [&before, &after].map(|mesh| mesh.positions.len());
    let further = [source, result].map(|side| side.document.further(side.mesh));
    let streams = Streams::new(further, counts);
    let extra = streams.extra();
    let mut extras = Extras::default()
        .with_streams(&extra)
        .with_scale(wanted.scale)
        .with_hard_angle(wanted.hard_angle);
    if let Some([source, result]) = &numbers {
        extras = extras.with_materials([source, result]);
    }
    let mut findings =
        compare_with(&before.as_mesh(), &after.as_mesh(), &extras, args.verify.into());
    if numbers.is_none() {
        findings.leave_out(Rule::Materials, "the files do not name them all");
    }
    if result.normals().computed {
        for rule in [Rule::FlatNormal, Rule::HardEdges] {
            findings.leave_out(rule, "the result's normals are not in its file");
        }
    }
    if matches!(args.verify, CheckDepth::Fast) {
        findings.leave_out(Rule::SelfIntersection, "left out by --verify fast");
    }
    let mut unasked = Vec::new();
    if let Some(expected) = expected {
        let unselected = unselected(&expected.verdicts);
        let is_unselected =
            |edge: &mut MeasuredEdge| unselected.binary_search(&edge.vertices).is_ok();
        unasked = findings.edges.extract_if(.., is_unselected).collect();
        unasked.retain(|edge| is_chamfered(edge, expected));
    }
    let mut check = MeshCheck::new(source.name(), &findings);
    streams.not_told.iter().for_each(|(what, reason)| check.leave_out(what, reason));
    if let Some(expected) = expected {
        check.expect(expected.width, &left_without_need(&findings, expected));
        check.expect_widths(&wider_than_asked(&findings, expected));
        check.expect_hard(&unasked.iter().map(|edge| edge.vertices).collect::<Vec<_>>());
    }
    if !check.defects.is_empty() {
        (check.nearly_touching, _) = nearly_touching(&before.positions, &before.indices);
    }
    check
}

/// Both sides of an end are so far from the old edge, as a share of the width asked for, where they
/// were pulled: a width that is less nobody sees.
const LEAST_PULLED: f32 = 0.02;

/// Whether an edge that nobody asked for has a chamfer. At a flap the two sides of an edge that stays
/// hard come apart too, but there one of them stays on it.
fn is_chamfered(edge: &MeasuredEdge, expected: &Chamfered) -> bool {
    let least = LEAST_PULLED * expected.width / least_scale(expected);
    (0..2).any(|end| edge.is_open[end] && edge.distances[end].iter().all(|&side| side > least))
}

/// The edges that nobody asked for, sorted.
fn unselected(verdicts: &[EdgeVerdict]) -> Vec<[u32; 2]> {
    let unselected = verdicts.iter().filter(|verdict| verdict.reason == Reason::NotSelected);
    let mut vertices: Vec<[u32; 2]> = unselected.map(|verdict| verdict.vertices).collect();
    vertices.sort_unstable();
    vertices
}

/// The hard edges that are left although chamfering would not leave them. One that opens in its
/// middle alone, as where something rests on both its ends, is not measured.
fn left_without_need(findings: &Findings, expected: &Chamfered) -> Vec<[u32; 2]> {
    let least = LEAST_PULLED * expected.width;
    let opens_at_an_end = |verdict: &&EdgeVerdict| {
        verdict.outcome != Outcome::Skipped && verdict.widths.iter().any(|&width| width > least)
    };
    let chamfered = expected.verdicts.iter().filter(opens_at_an_end);
    let mut chamfered: Vec<[u32; 2]> = chamfered.map(|verdict| verdict.vertices).collect();
    chamfered.sort_unstable();
    findings
        .edges
        .iter()
        .filter(|edge| !edge.is_chamfered() && !edge.is_parted)
        .filter(|edge| chamfered.binary_search(&edge.vertices).is_ok())
        .map(|edge| edge.vertices)
        .collect()
}

/// So many times as wide as asked a chamfer may be: where its sides are unlike, or an end is cut
/// off, one of them makes up for the other.
const MOST_WIDENED: f32 = 1.3;

/// Widths are asked for in a space in which lengths of the mesh are at least so many times as long.
fn least_scale(expected: &Chamfered) -> f32 {
    expected.scale.map_or(1.0, |axes| {
        let length = |axis: [f32; 3]| axis.iter().map(|part| part * part).sum::<f32>().sqrt();
        axes.map(length).into_iter().fold(f32::INFINITY, f32::min)
    })
}

/// The chamfers that are wider than asked, and than chamfering would make them.
fn wider_than_asked(findings: &Findings, expected: &Chamfered) -> Vec<[u32; 2]> {
    let scaled = least_scale(expected);
    let widest = |verdict: &EdgeVerdict| verdict.widths[0].max(verdict.widths[1]);
    let made: BTreeMap<[u32; 2], f32> =
        expected.verdicts.iter().map(|verdict| (verdict.vertices, widest(verdict))).collect();
    let is_wide = |edge: &&MeasuredEdge| {
        let made = made.get(&edge.vertices).copied().unwrap_or(0.0);
        let most = expected.width.max(made) * MOST_WIDENED;
        edge.widths().into_iter().any(|width| width * scaled > most)
    };
    findings.edges.iter().filter(is_wide).map(|edge| edge.vertices).collect()
}

/// What stands otherwise, of all that both files name; the objects of meshes are told apart
/// elsewhere.
fn moved([before, after]: [&dyn Document; 2]) -> Vec<String> {
    let places = after.places();
    let known: BTreeMap<&str, &Place> = places.iter().map(|p| (p.name.as_str(), p)).collect();
    let is_moved = |place: &Place| {
        let now = known.get(place.name.as_str());
        now.is_some_and(|now| !is_same_place([place.transform, now.transform]))
    };
    before.places().into_iter().filter(is_moved).map(|place| place.name).collect()
}

fn is_same_place(transforms: [[[f32; 4]; 4]; 2]) -> bool {
    let [one, other] = transforms.each_ref().map(|transform| transform.as_flattened());
    let largest = one.iter().fold(0.0, |most: f32, entry| most.max(entry.abs()));
    one.iter().zip(other).all(|(a, b)| (a - b).abs() <= SAME_PLACE * largest)
}
