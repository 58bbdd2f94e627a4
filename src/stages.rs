//! The values of all stages before the limits, for tests of what comes after.

use crate::attributes::{Attributes, attributes};
use crate::chamfers::Chamfers;
use crate::charts::{Charts, charts};
use crate::contacts::contacts;
use crate::edges::{Edges, edges};
use crate::evenness::evenness;
use crate::faces::{Faces, faces};
use crate::given::{Given, deep};
use crate::ids::{Cluster, IdVec, Sector, Triangle};
use crate::limits::{Limits, limits};
use crate::mesh::{Mesh, MeshBuffers};
use crate::offsets::{Offset, go_along, narrow_all, offsets};
use crate::options::{Options, Verify, Width};
use crate::patches::{Patches, patches};
use crate::placement::Placement;
use crate::rests::{Most, Rests, rests};
use crate::room::{plenty, room};
use crate::scale::Space;
use crate::sectors::{Sectors, sectors};
use crate::selection::selection;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::topology::{Topology, topology};
use crate::vanishing::{Vanishing, vanishing};
use crate::view::{View, view};
use crate::watch::{Unwatched, Watch};
use crate::weld::{Weld, weld};

/// What each stage has made of a mesh.
pub struct Stages<'a> {
    pub view: View<'a>,
    pub weld: Weld,
    pub topology: Topology,
    pub faces: Faces,
    pub edges: Edges,
    pub sectors: Sectors,
    pub offsets: IdVec<Sector, Offset>,
    pub vanishing: Vanishing,
    /// With what each edge of a sector has room for.
    pub narrowed: IdVec<Sector, Offset>,
    /// `#triangles`: see [`crate::room::Room`].
    pub plenty: IdVec<Triangle, bool>,
    /// How far each sector may go for the room that there is.
    pub shares: IdVec<Sector, f64>,
    pub rests: Rests,
    pub deep: IdVec<Cluster, bool>,
    pub threads: Threads,
}

/// The stages of a sound mesh for a width in mesh units.
pub fn stages_of(mesh: &MeshBuffers, width: f32) -> Stages<'_> {
    stages_with(mesh, &Options { width: Width::Units(width), ..Options::default() })
}

/// The stages of a sound mesh.
pub fn stages_with<'a>(mesh: &'a MeshBuffers, options: &Options) -> Stages<'a> {
    stages_of_mesh(mesh.as_mesh(), options)
}

/// The same with all that belongs to a mesh beside its streams.
pub fn stages_of_mesh<'a>(mesh: Mesh<'a>, options: &Options) -> Stages<'a> {
    let threads = Threads::default();
    let view = view(&mesh, options).unwrap();
    let weld = weld(&view.mesh, &Unwatched).unwrap();
    let topology = topology(&view, &weld, &Unwatched).unwrap();
    let faces = faces(&view, &topology, (&threads, &Unwatched)).unwrap();
    let contacts = contacts(&view, &topology, &faces, &Unwatched).unwrap();
    let selection = selection(&view, &weld, options);
    let work: (&Threads, &dyn Watch) = (&threads, &Unwatched);
    let edges = edges(&view, (&topology, &faces), &contacts, &selection, work).unwrap();
    let sectors = sectors(&view, &topology, &edges, &contacts, &Unwatched).unwrap();
    let surface = Surface { view: &view, topology: &topology, faces: &faces };
    let chamfers = Chamfers { edges: &edges, sectors: &sectors };
    let mut offsets = offsets(surface, chamfers, None, (&threads, &Unwatched)).unwrap();
    let mut plenty = plenty(surface, &sectors, &offsets, work).unwrap();
    let vanishing = vanishing(surface, chamfers, (&mut offsets, &mut plenty), work).unwrap();
    go_along(surface, &sectors, (&mut offsets, Some(&mut plenty)), &Unwatched).unwrap();
    let deep = deep(&topology, &sectors, &Unwatched).unwrap();
    let (narrowed, shares) = {
        let (offsets, rests, deep, threads) = (&offsets, &Rests::default(), &deep, &threads);
        let (vanishing, apart, known) = (&vanishing, None, &plenty.clone());
        let given = &Given {
            surface,
            chamfers,
            offsets,
            vanishing,
            apart,
            rests,
            deep,
            plenty: known,
            threads,
        };
        let room = room(given, &Unwatched).unwrap();
        let room = evenness(given, room, options.evenness.into(), &Unwatched).unwrap();
        let mut narrowed = offsets.clone();
        let all = (&mut narrowed, &mut plenty);
        narrow_all(surface, &sectors, all, &room.fronts, &Unwatched).unwrap();
        let shares = room.shares(&Given { offsets: &narrowed, ..*given }, &Unwatched).unwrap();
        (narrowed, shares)
    };
    let most = Most { offsets: &narrowed, shares: &shares };
    let rests = rests(surface, chamfers, &contacts, most, (&threads, &Unwatched)).unwrap();
    Stages {
        view,
        weld,
        topology,
        faces,
        edges,
        sectors,
        offsets,
        vanishing,
        narrowed,
        shares,
        rests,
        deep,
        plenty,
        threads,
    }
}

impl Stages<'_> {
    pub fn surface(&self) -> Surface<'_> {
        Surface { view: &self.view, topology: &self.topology, faces: &self.faces }
    }

    pub fn chamfers(&self) -> Chamfers<'_> {
        Chamfers { edges: &self.edges, sectors: &self.sectors }
    }

    /// All sectors at one share of their offsets, whether there is room or not.
    pub fn placed(&self, share: f64) -> Placement<'_> {
        let share = IdVec::filled(share, self.sectors.fans.len());
        Placement::new(
            self.surface(),
            &self.sectors,
            (&self.offsets, None),
            share,
            (&self.threads, &Unwatched),
        )
        .unwrap()
    }

    pub fn limits(&self, verify: Verify) -> Limits<'_> {
        let (surface, chamfers) = (self.surface(), self.chamfers());
        let Stages { narrowed, vanishing, shares, rests, deep, plenty, threads, .. } = self;
        let given = &Given {
            surface,
            chamfers,
            offsets: narrowed,
            vanishing,
            apart: None,
            rests,
            deep,
            plenty,
            threads,
        };
        limits(given, shares, verify, &Unwatched).unwrap()
    }

    pub fn space(&self) -> Space<'_> {
        Space { source: &self.view, measured: &self.view, scale: None }
    }

    pub fn patches(&self, placement: &Placement) -> Patches {
        patches(&self.view, self.chamfers(), placement, (&self.threads, &Unwatched)).unwrap()
    }

    pub fn attributes(&self, placement: &Placement) -> Attributes {
        let work: (&Threads, &dyn Watch) = (&self.threads, &Unwatched);
        attributes(self.space(), self.surface(), &self.weld, self.chamfers(), placement, work)
            .unwrap()
    }

    pub fn charts(&self, placement: &Placement) -> Charts {
        let (patches, attributes) = (self.patches(placement), self.attributes(placement));
        let (surface, chamfers) = (self.surface(), self.chamfers());
        charts(surface, chamfers, placement, &patches, &attributes, (&self.threads, &Unwatched))
            .unwrap()
    }

    /// All sectors where the limits leave them.
    pub fn placement(&self) -> Placement<'_> {
        self.limits(Verify::Fast).placement
    }
}

/// Points and triangles of a cone without floor. Its foot runs out and in again, so that the boxes of very
/// many of its borders overlap.
///
/// ```text
///      .
///     / \
///    /\/\/\
/// ```
pub fn zigzag_cone(sides: u32) -> (Vec<[f32; 3]>, Vec<u32>) {
    let foot = |step: u32| {
        let (sin, cos) = (f64::from(step) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
        let radius = 1.0 + f64::from(step % 2) / 8.0;
        [(cos * radius) as f32, 0.0, (-sin * radius) as f32]
    };
    let points = (0..sides).map(foot).chain([[0.0, 1.0, 0.0]]).collect();
    (points, (0..sides).flat_map(|k| [sides, k, (k + 1) % sides]).collect())
}

/// The mesh over `#vertices by 3` points and `#triangles by 3` indices, split at folds of more than a
/// degree.
pub fn split(points: &[[f32; 3]], indices: &[u32]) -> MeshBuffers {
    let smoothed = crate::split_by_angle(points, indices, 1.0).unwrap();
    MeshBuffers {
        positions: smoothed.source_of.iter().map(|&point| points[point as usize]).collect(),
        normals: smoothed.normals,
        submesh_index_counts: vec![indices.len() as u32],
        indices: smoothed.indices,
        ..MeshBuffers::default()
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use crate::error::Error;
    use crate::shapes;
    use crate::view::view_watched;

    /// Stops when it is told for the last time that it bears.
    struct Bears(Cell<usize>);

    impl Watch for Bears {
        fn worked(&self, _: usize) -> Result<(), Error> {
            self.0.set(self.0.get() - 1);
            if self.0.get() > 0 { Ok(()) } else { Err(Error::Cancelled) }
        }
    }

    /// How often a stage tells its watch; whenever it does, it can be stopped.
    #[track_caller]
    fn times<T>(stage: impl Fn(&dyn Watch) -> Result<T, Error>) -> usize {
        let all = Bears(Cell::new(usize::MAX));
        assert!(stage(&all).is_ok());
        let times = usize::MAX - all.0.get();
        for last in 1..=times {
            assert!(matches!(stage(&Bears(Cell::new(last))), Err(Error::Cancelled)), "{last}");
        }
        times
    }

    /// A plate that is too thin for the width, so that each stage has something to do.
    #[test]
    fn each_stage_that_may_take_long_tells_its_watch() {
        let plate = shapes::plate();
        let stages = stages_of(&plate, 0.5);
        let Stages { view, topology, faces, weld, .. } = &stages;
        let contacts_of = |watch: &dyn Watch| contacts(view, topology, faces, watch);
        let found = contacts_of(&Unwatched).unwrap();
        let selection = selection(view, weld, &Options::default());
        let (surface, chamfers) = (stages.surface(), stages.chamfers());
        let Stages { offsets: vectors, vanishing, rests: held, deep, plenty, threads, .. } =
            &stages;
        let given = &Given {
            surface,
            chamfers,
            offsets: vectors,
            vanishing,
            apart: None,
            rests: held,
            deep,
            plenty,
            threads,
        };
        let open = &stages.shares;
        let found_edges = |watch: &dyn Watch| {
            super::edges(view, (topology, faces), &found, &selection, (threads, watch))
        };
        assert_eq!(times(found_edges), 3, "for all sides, those that are hard, and all corners");
        assert_eq!(times(|watch| offsets(surface, chamfers, None, (threads, watch))), 1);
        assert!(times(|watch| room(given, watch)) > 1);
        let evened = |watch: &dyn Watch| evenness(given, room(given, &Unwatched)?, 0.5, watch);
        assert!(times(evened) > 1);
        let limited = |verify| times(|watch| limits(given, open, verify, watch));
        assert!(limited(Verify::Fast) > 8);
        assert!(limited(Verify::Full) > limited(Verify::Fast));
    }

    /// How many steps a stage tells in all.
    fn steps<T>(stage: impl Fn(&dyn Watch) -> Result<T, Error>) -> usize {
        struct Sum(Cell<usize>);
        impl Watch for Sum {
            fn worked(&self, steps: usize) -> Result<(), Error> {
                self.0.set(self.0.get() + steps);
                Ok(())
            }
        }
        let sum = Sum(Cell::new(0));
        assert!(stage(&sum).is_ok());
        sum.0.get()
    }

    /// Of two thin plates each pass over triangles, corners, edges or sectors tells twice as much as of
    /// one, so none is told of less than there is; and the sum of all falls where one tells nothing.
    #[test]
    fn what_is_told_grows_with_all_that_is_passed_over() {
        let told = |plates: u32| {
            let mut mesh = MeshBuffers::default();
            for plate in 0..plates {
                let (first, one) = (mesh.positions.len() as u32, shapes::plate());
                let moved = |[x, y, z]: [f32; 3]| [x + 8.0 * plate as f32, y, z];
                mesh.positions.extend(one.positions.iter().copied().map(moved));
                mesh.normals.extend(&one.normals);
                mesh.indices.extend(one.indices.iter().map(|index| first + index));
            }
            mesh.submesh_index_counts = vec![mesh.indices.len() as u32];
            let stages = stages_of(&mesh, 0.5);
            let Stages { view, topology, faces, weld, offsets: vectors, .. } = &stages;
            let Stages { vanishing, rests: held, deep, plenty, threads, shares: open, .. } =
                &stages;
            let (surface, chamfers) = (stages.surface(), stages.chamfers());
            let given = &Given {
                surface,
                chamfers,
                offsets: vectors,
                vanishing,
                rests: held,
                deep,
                plenty,
                threads,
                apart: None,
            };
            let found = contacts(view, topology, faces, &Unwatched).unwrap();
            let selection = selection(view, weld, &Options::default());
            let of_edges = |watch: &dyn Watch| {
                super::edges(view, (topology, faces), &found, &selection, (threads, watch))
            };
            let (again, options) =
                (super::weld(&view.mesh, &Unwatched).unwrap(), Options::default());
            let shape =
                crate::pipeline::shape(view, again, &[], &options, (threads, &mut |_| Ok(())));
            let shape = &shape.unwrap();
            [
                steps(|watch| contacts(view, topology, faces, watch)),
                steps(of_edges),
                steps(|watch| crate::closers::closers(view, shape, watch)),
                steps(|watch| crate::refine::refine(view, shape, vectors, watch)),
                steps(|watch| offsets(surface, chamfers, None, (threads, watch))),
                steps(|watch| room(given, watch)),
                steps(|watch| evenness(given, room(given, &Unwatched)?, 0.5, watch)),
                steps(|watch| limits(given, open, Verify::Fast, watch)),
                steps(|watch| limits(given, open, Verify::Full, watch)),
            ]
        };
        let [one, two] = [1, 2].map(told);
        assert_eq!(two, one.map(|told| 2 * told));
        // Stored anew where a stage passes over less than before.
        let least = [36, 168, 12, 12, 96, 52, 152, 3736, 4527];
        assert!(one.iter().zip(least).all(|(told, least)| *told >= least), "{one:?}");
    }

    /// At the tip of a slice of cake one sector has all triangles of the top, and one all below. Of few no
    /// more is told than of others.
    #[test]
    fn a_sector_of_many_corners_tells_of_them() {
        let told = |steps_of_arc: u32| {
            let arc = (0..=steps_of_arc).map(|step| {
                let turn = f64::from(step) / f64::from(steps_of_arc) * std::f64::consts::FRAC_PI_2;
                [turn.cos() as f32, turn.sin() as f32]
            });
            let mut slice = shapes::Builder::default();
            slice.prism(&std::iter::once([0.0; 2]).chain(arc).collect::<Vec<_>>(), -1.0, 1.0);
            let slice = slice.finish();
            let stages = stages_of(&slice, 0.001);
            let (surface, chamfers) = (stages.surface(), stages.chamfers());
            let of_offsets =
                |watch: &dyn Watch| offsets(surface, chamfers, None, (&stages.threads, watch));
            let all = Bears(Cell::new(usize::MAX));
            assert!(of_offsets(&all).is_ok());
            let (words, sectors) = (usize::MAX - all.0.get(), stages.sectors.fans.len());
            // Of all sectors it is told in stretches.
            (words - sectors.div_ceil(256), steps(of_offsets) - 4 * sectors)
        };
        assert_eq!(told(1000), (0, 0));
        let (words, corners) = told(20_000);
        assert!(corners >= 2 * 2 * 20_000, "{corners}");
        assert!(words >= 2 * 4, "stretch by stretch: {words}");
    }

    #[test]
    fn validating_a_mesh_and_telling_its_solids_apart_can_be_stopped() {
        let (cube, options) = (shapes::cube(1.0), Options::default());
        let mesh = cube.as_mesh();
        let streams = 4 + crate::mesh::UV_CHANNELS;
        assert_eq!(times(|watch| view_watched(&mesh, &options, watch)), 1 + streams);
        let stages = stages_of(&cube, 0.1);
        let solids = |watch: &dyn Watch| crate::topology::solids(&stages.topology, watch);
        assert_eq!(times(solids), 2, "once what is joined, once its labels");
    }

    #[test]
    fn what_may_rest_on_something_is_gathered_and_asked_under_a_watch() {
        let open = shapes::open_box();
        let stages = stages_of(&open, 0.05);
        let Stages { view, topology, faces, shares, narrowed, threads, .. } = &stages;
        let (surface, chamfers) = (stages.surface(), stages.chamfers());
        assert!(times(|watch| contacts(view, topology, faces, watch)) >= 1);
        let found = contacts(view, topology, faces, &Unwatched).unwrap();
        let most = Most { offsets: narrowed, shares };
        let asked = times(|watch| rests(surface, chamfers, &found, most, (threads, watch)));
        assert_eq!(asked, 2, "once what is near, once what rests");
    }
}
