//! The values of all stages before the limits, for tests of what comes after.

use crate::attributes::{Attributes, attributes};
use crate::chamfers::Chamfers;
use crate::charts::{Charts, charts};
use crate::contacts::contacts;
use crate::edges::{Edges, edges};
use crate::evenness::evenness;
use crate::faces::{Faces, faces};
use crate::given::{Given, deep};
use crate::ids::{Cluster, IdVec, Sector};
use crate::limits::{Limits, limits};
use crate::mesh::{Mesh, MeshBuffers};
use crate::offsets::{Offset, narrowed, offsets};
use crate::options::{Options, Verify, Width};
use crate::patches::{Patches, patches};
use crate::placement::Placement;
use crate::rests::{Rests, rests};
use crate::room::{Room, room};
use crate::scale::Space;
use crate::sectors::{Sectors, sectors};
use crate::selection::selection;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::topology::{Topology, topology};
use crate::view::{View, view};
use crate::watch::Unwatched;
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
    /// With what each edge of a sector has room for.
    pub narrowed: IdVec<Sector, Offset>,
    pub room: Room,
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
    let weld = weld(&view.mesh);
    let topology = topology(&view, &weld);
    let faces = faces(&view, &topology, &threads);
    let contacts = contacts(&view, &topology, &faces).unwrap();
    let selection = selection(&view, &weld, options);
    let edges = edges(&view, &topology, &faces, &contacts, &selection);
    let sectors = sectors(&view, &topology, &edges, &contacts);
    let surface = Surface { view: &view, topology: &topology, faces: &faces };
    let chamfers = Chamfers { edges: &edges, sectors: &sectors };
    let offsets = offsets(surface, chamfers, None, &threads);
    let rests = rests(&view, &topology, &faces, &edges, &contacts);
    let deep = deep(&topology, &sectors);
    let (room, narrowed) = {
        let (offsets, rests, deep, threads) = (&offsets, &rests, &deep, &threads);
        let given = &Given { surface, chamfers, offsets, rests, deep, threads };
        let room = evenness(given, room(given), options.evenness.into());
        let narrowed = narrowed(surface, &sectors, offsets, &room.fronts).into_owned();
        (room, narrowed)
    };
    Stages {
        view,
        weld,
        topology,
        faces,
        edges,
        sectors,
        offsets,
        narrowed,
        room,
        rests,
        deep,
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
        Placement::new(self.surface(), &self.sectors, &self.offsets, share, &self.threads)
    }

    pub fn limits(&self, verify: Verify) -> Limits<'_> {
        let (surface, chamfers) = (self.surface(), self.chamfers());
        let Stages { narrowed, room, rests, deep, threads, .. } = self;
        let given = &Given { surface, chamfers, offsets: narrowed, rests, deep, threads };
        limits(given, &room.shares(), verify, &Unwatched).unwrap()
    }

    fn space(&self) -> Space<'_> {
        Space { source: &self.view, measured: &self.view, scale: None }
    }

    pub fn patches(&self, placement: &Placement) -> Patches {
        patches(&self.view, self.chamfers(), placement, &self.threads)
    }

    pub fn attributes(&self, placement: &Placement) -> Attributes {
        attributes(self.space(), self.surface(), &self.weld, self.chamfers(), placement)
    }

    pub fn charts(&self, placement: &Placement) -> Charts {
        let (patches, attributes) = (self.patches(placement), self.attributes(placement));
        let (surface, chamfers) = (self.surface(), self.chamfers());
        charts(surface, chamfers, placement, &patches, &attributes, &self.threads)
    }

    /// All sectors where the limits leave them.
    pub fn placement(&self) -> Placement<'_> {
        self.limits(Verify::Fast).placement
    }
}
