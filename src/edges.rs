//! Edges: which of them are hard, and which of those are chamfered.

mod noise;
mod parted;

use std::sync::atomic::{AtomicBool, Ordering};

use glam::DVec3;

use crate::breaks::uvs_differ;
use crate::contacts::{ASKED, Contacts};
use crate::error::Error;
use crate::faces::{Faces, is_blurred, long_side};
use crate::ids::{Corner, Edge, Few, Id, IdVec, Triangle, Vertex};
use crate::mesh::UV_CHANNELS;
use crate::report::Reason;
use crate::selection::Selection;
use crate::threads::Threads;
use crate::tolerance::BACK_TO_BACK_COSINE;
use crate::topology::Topology;
use crate::view::View;
use crate::watch::{Times, Watch};
use crate::weld::Weld;

use noise::Ends;
pub use parted::{Parted, parted};

/// A hard edge with two sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HardEdge {
    /// The half-edge of the first triangle that uses the edge, and its twin.
    pub sides: [Corner; 2],
    /// Why it is not chamfered. Such an edge does not separate sectors: both its sides move
    /// together.
    pub skipped: Option<Reason>,
    /// The UV channels that differ across it, as bits.
    pub seams: u8,
    /// The width asked for at the start and at the end of its first side, in mesh units.
    pub widths: [f64; 2],
}

impl HardEdge {
    /// The width asked for where one of its sides starts.
    pub fn width_at_start(&self, side: Corner) -> f64 {
        self.widths[usize::from(side != self.sides[0])]
    }

    /// The width asked for where one of its sides ends.
    pub fn width_at_end(&self, side: Corner) -> f64 {
        self.widths[usize::from(side == self.sides[0])]
    }

    /// The largest width asked for.
    pub fn widest(&self) -> f64 {
        self.widths[0].max(self.widths[1])
    }
}

pub struct Edges {
    /// `#hard edges`, in the order of their first half-edges.
    pub hard: IdVec<Edge, HardEdge>,
    /// `#corners`: the edge that the half-edge is a side of, where it is to be chamfered.
    pub chamfered_at: IdVec<Corner, Edge>,
    /// Corners of lines, between the ends of an edge that is chamfered: each stands on that edge, or
    /// on the line between that and an earlier one.
    pub spanned: Vec<Corner>,
    /// The ends at which edges that stay hard part sectors all the same: see [`parted`]; sorted by
    /// their corners.
    pub parted: Vec<Parted>,
}

impl Edges {
    /// What is parted by the edge of a half-edge where that starts.
    pub fn parted_at(&self, corner: Corner) -> Option<&Parted> {
        if self.parted.is_empty() {
            return None;
        }
        let place = self.parted.binary_search_by_key(&corner, |parted| parted.corner).ok()?;
        Some(&self.parted[place])
    }

    /// Whether sectors end at a half-edge where that starts.
    pub fn parts_at_start(&self, side: Corner) -> bool {
        self.chamfered_at[side].is_some() || self.parted_at(side).is_some()
    }

    /// Whether sectors end at a half-edge where that ends: there its twin starts.
    pub fn parts_at_end(&self, topology: &Topology, side: Corner) -> bool {
        self.chamfered_at[side].is_some() || self.parted_at(topology.twin[side]).is_some()
    }

    /// The largest width asked for of any edge, and at least a given one.
    pub fn widest(&self, least: f64) -> f64 {
        self.hard.iter().map(HardEdge::widest).fold(least, f64::max)
    }
}

/// Whether any edge can be hard: at one position at least, normals differ.
pub fn may_be_hard(view: &View, weld: &Weld) -> bool {
    let differs = |vertex: Vertex| {
        let first = weld.first_vertex[weld.cluster_of[vertex]];
        let [one, other] = [vertex, first].map(|vertex| view.normal(vertex));
        let lengths = (one.length_squared() * other.length_squared()).sqrt();
        // A normal without length is like none.
        first != vertex && one.dot(other) <= view.alike_cosine * lengths
    };
    weld.cluster_of.ids().any(differs)
}

/// Finds them.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn edges(
    view: &View,
    (topology, faces): (&Topology, &Faces),
    contacts: &Contacts,
    selection: &Selection,
    (threads, watch): (&Threads, &dyn Watch),
) -> Result<Edges, Error> {
    let may_be_noise = AtomicBool::new(false);
    let mut sides = threads.filter_watched(
        view.corner_count(),
        watch,
        #[inline(always)]
        |corner: Corner| {
            let twin = topology.twin[corner];
            let ends = (twin.is_some() && corner < twin).then(|| noise::ends(view, [corner, twin]));
            // Most meshes have no such end at all.
            if ends == Some(Ends::MayBeNoise) {
                may_be_noise.store(true, Ordering::Relaxed);
            }
            ends.is_some_and(|ends| ends != Ends::Soft)
        },
    )?;
    if may_be_noise.into_inner() {
        let noise = noise::noise(view, topology, &sides);
        watch.worked(sides.len())?;
        if !noise.is_empty() {
            sides.retain(|&side| !is_noise(view, &noise, [side, topology.twin[side]]));
        }
    }
    let ends = |&side: &Corner| [side, side.next()].map(|corner| view.position_at(corner));
    let channels: Few<usize> = channels(view).collect();
    let near = contacts.near(&sides, |side| (ends(side), 0.0), watch)?;
    let hard = threads.map(sides.len(), &Times(ASKED, watch), |edge: Edge| {
        let side = sides[edge.index()];
        let is_held = || near.may_hold(edge.index()) && contacts.holds(view, topology, faces, side);
        let sides = [side, topology.twin[side]];
        HardEdge {
            seams: seams_in(channels.iter().copied(), view, sides),
            ..hard_edge(view, (topology, faces), selection, sides, is_held)
        }
    })?;
    watch.worked(view.corner_count())?;
    let mut chamfered_at = IdVec::filled(Edge::NONE, view.corner_count());
    for (edge, hard) in hard.ids().zip(hard.iter()).filter(|(_, hard)| hard.skipped.is_none()) {
        hard.sides.iter().for_each(|&side| chamfered_at[side] = edge);
    }
    let spanned = spanned(view, topology, faces, &chamfered_at);
    let parted = parted(view, topology, faces, &hard, &chamfered_at);
    Ok(Edges { hard, chamfered_at, spanned, parted })
}

/// Whether the normals of two sides differ by chance wherever they do.
fn is_noise(view: &View, noise: &[Corner], sides: [Corner; 2]) -> bool {
    let is_soft_at = |side: Corner, other: Corner| {
        let normals = [side, other.next()].map(|corner| view.normal_at(corner));
        noise.binary_search(&side).is_ok() || !view.normals_differ(normals)
    };
    let [side, other] = sides;
    is_soft_at(side, other) && is_soft_at(other, side)
}

/// What is asked of the edge between two half-edges, and why it is not chamfered if so; but for its seams.
fn hard_edge(
    view: &View,
    (topology, faces): (&Topology, &Faces),
    selection: &Selection,
    sides: [Corner; 2],
    is_held: impl FnOnce() -> bool,
) -> HardEdge {
    let widths = selection.widths(topology, faces, sides);
    let skipped = obstacle(view, topology, faces, sides)
        .or(widths.is_none().then_some(Reason::NotSelected))
        .or_else(|| is_held().then_some(Reason::Contact));
    HardEdge { sides, skipped, seams: 0, widths: widths.unwrap_or_default() }
}

/// The corners across from the long sides of lines that reach such a side to a chamfered edge.
fn spanned(
    view: &View,
    topology: &Topology,
    faces: &Faces,
    chamfered_at: &IdVec<Corner, Edge>,
) -> Vec<Corner> {
    let length =
        |side: Corner| view.position_at(side).distance_squared(view.position_at(side.next()));
    let is_long = |side: &Corner| {
        let mut others = [side.next(), side.prev()].into_iter();
        faces.is_line(side.triangle()) && others.all(|other| length(other) < length(*side))
    };
    let lines = faces.lender.ids().filter(|&triangle| faces.is_line(triangle));
    let ends = lines.flat_map(Triangle::corners).filter(|&side| chamfered_at[side].is_some());
    let mut spanned: Vec<Corner> = ends.filter(is_long).map(Corner::prev).collect();
    let mut done = 0;
    while done < spanned.len() {
        let sides = [spanned[done], spanned[done].prev()].map(|side| topology.twin[side]);
        // A line across a short side of this one spans from here to one of its ends.
        let behind = sides
            .into_iter()
            .filter(|side| side.is_some() && chamfered_at[*side].is_none() && is_long(side));
        spanned.extend(behind.map(Corner::prev));
        done += 1;
    }
    spanned
}

/// What keeps a hard edge from being chamfered whatever the width.
fn obstacle(
    view: &View,
    topology: &Topology,
    faces: &Faces,
    [side, other]: [Corner; 2],
) -> Option<Reason> {
    let [one, two] = [side, other].map(|half_edge| faces.normal[half_edge.triangle()]);
    if one == DVec3::ZERO || two == DVec3::ZERO {
        let unknown = [(side, one), (other, two)].into_iter().filter(|(_, n)| *n == DVec3::ZERO);
        let is_blurred = unknown.into_iter().all(|(side, _)| is_blurred(view, side.triangle()));
        let is_closer = |line: Triangle| {
            let has_sides = line.corners().into_iter().all(|side| topology.twin[side].is_some());
            faces.normal[line] == DVec3::ZERO && has_sides && long_side(view, line).is_some()
        };
        let is_closed = || is_closer(side.triangle()) || is_closer(other.triangle());
        return Some(match is_blurred {
            true => Reason::TooFine,
            false if is_closed() => Reason::TJunction,
            false => Reason::NoArea,
        });
    }
    if one.dot(two) < BACK_TO_BACK_COSINE {
        return Some(Reason::ZeroThickness);
    }
    // A chamfer of one solid would let light through to the air behind the contact.
    topology.is_contact(side).then_some(Reason::Contact)
}

/// The UV channels that a mesh has.
fn channels(view: &View) -> impl Iterator<Item = usize> {
    (0..UV_CHANNELS).filter(|&channel| view.mesh.uvs[channel].components > 0)
}

/// The UV channels that differ between two half-edges that are twins, as bits.
pub fn seam_channels(view: &View, side: Corner, other: Corner) -> u8 {
    seams_in(channels(view), view, [side, other])
}

/// The same of some channels.
#[inline(always)]
fn seams_in(channels: impl Iterator<Item = usize>, view: &View, [side, other]: [Corner; 2]) -> u8 {
    let pairs = [[side, other.next()], [side.next(), other]]
        .map(|pair| pair.map(|corner| view.vertex_at(corner)));
    channels.fold(0, |seams, channel| {
        let is_seam = pairs.iter().any(|&pair| uvs_differ(&view.mesh.uvs[channel], pair));
        seams | u8::from(is_seam) << channel
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contacts::contacts;
    use crate::faces::faces;
    use crate::mesh::Mesh;
    use crate::options::Options;
    use crate::selection::selection;
    use crate::shapes;
    use crate::stages::stages_of;
    use crate::threads::Threads;
    use crate::topology::topology;
    use crate::view::view;
    use crate::watch::Unwatched;
    use crate::weld::weld;

    /// A roof of two triangles over the edge 0-1, with the given normals and far corners.
    ///
    /// ```text
    ///    2
    ///  /   \
    /// 0-----1   and 3 on the other side
    /// ```
    fn roof(normals: [[f32; 3]; 2], far: [f32; 3]) -> Vec<Option<Reason>> {
        let positions = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.5, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            far,
        ];
        let [one, other] = normals;
        let mesh = Mesh {
            positions: &positions,
            normals: &[one, one, one, other, other, other],
            indices: &[0, 1, 2, 3, 4, 5],
            submesh_index_counts: &[6],
            ..Mesh::default()
        };
        let view = view(&mesh, &Options::default()).unwrap();
        let weld = weld(&mesh, &Unwatched).unwrap();
        let topology = topology(&view, &weld, &Unwatched).unwrap();
        let faces = faces(&view, &topology, (&Threads::default(), &Unwatched)).unwrap();
        let contacts = contacts(&view, &topology, &faces, &Unwatched).unwrap();
        let selection = selection(&view, &weld, &Options::default());
        let work: (&Threads, &dyn Watch) = (&Threads::default(), &Unwatched);
        let edges = edges(&view, (&topology, &faces), &contacts, &selection, work).unwrap();
        edges.hard.iter().map(|edge| edge.skipped).collect()
    }

    const UP: [f32; 3] = [0.0, 0.0, 1.0];
    const DOWN: [f32; 3] = [0.0, 0.0, -1.0];

    #[test]
    fn normals_decide_what_is_hard() {
        let far = [0.5, -1.0, 0.0];
        assert_eq!(roof([UP, UP], far), []);
        assert_eq!(roof([UP, [0.0, 0.01, 1.0]], far), [], "less than a degree");
        assert_eq!(roof([UP, [0.0, -0.6, 0.8]], far), [None]);
    }

    #[test]
    fn back_to_back_faces_are_hard_but_have_no_width() {
        assert_eq!(roof([UP, DOWN], [0.5, 0.8, 0.0]), [Some(Reason::ZeroThickness)]);
    }

    #[test]
    fn a_triangle_without_area_is_left_alone() {
        assert_eq!(roof([UP, [0.0, -0.6, 0.8]], [0.5, 0.0, 0.0]), [Some(Reason::NoArea)]);
    }

    #[test]
    fn a_channel_that_differs_across_an_edge_is_a_seam_there() {
        let (seamed, plain) = (shapes::cube(1.0), shapes::plain_cube(1.0));
        let channels = |mesh| {
            let stages = stages_of(mesh, 0.1);
            stages.edges.hard.iter().map(|edge| edge.seams).collect::<Vec<_>>()
        };
        assert_eq!(channels(&seamed), [1; 12]);
        assert_eq!(channels(&plain), [0; 12]);
    }
}
