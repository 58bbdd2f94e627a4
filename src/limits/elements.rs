//! Elements: source triangles, strips and fills, and the sectors that they depend on.

use std::cmp::Ordering;

use crate::error::Error;
use crate::flaps;
use crate::ids::{Corner, Edge, Few, Ring, Sector, Triangle};
use crate::strips;
use crate::watch::{Watch, sort, stretches};

use crate::given::Given;

/// Anything that can go bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    Surface(Triangle),
    Strip(Edge),
    Fill(Ring),
    /// By its place among the ends that part sectors.
    Flap(u32),
}

impl Element {
    /// Orders elements, by kind and number, with a single comparison.
    pub fn key(self) -> u64 {
        let (kind, number) = match self {
            Element::Surface(triangle) => (0, triangle.0),
            Element::Strip(edge) => (1, edge.0),
            Element::Fill(ring) => (2, ring.0),
            Element::Flap(place) => (3, place),
        };
        kind << 32 | u64::from(number)
    }
}

impl Ord for Element {
    fn cmp(&self, other: &Element) -> Ordering {
        self.key().cmp(&other.key())
    }
}

impl PartialOrd for Element {
    fn partial_cmp(&self, other: &Element) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The sectors that an element's corners stand on.
pub fn sectors_of(given: &Given, element: Element) -> Few<Sector> {
    let sector_of = |corner: Corner| given.chamfers.sectors.sector_of[corner];
    match element {
        Element::Surface(triangle) => {
            triangle.corners().into_iter().map(sector_of).filter(|s| s.is_some()).collect()
        }
        Element::Strip(edge) => {
            strips::corners(&given.chamfers.edges.hard[edge]).into_iter().map(sector_of).collect()
        }
        Element::Fill(ring) => Few::from_slice(given.chamfers.sectors.ring(ring)),
        Element::Flap(place) => {
            let sectors = flap_joints(given, place).into_iter().map(sector_of);
            sectors.filter(|sector| sector.is_some()).collect()
        }
    }
}

/// Everything that depends on the sectors, each once, in order.
///
/// # Errors
/// [`Error::Cancelled`] where the watch stops it.
pub fn around(given: &Given, sectors: &[Sector], watch: &dyn Watch) -> Result<Vec<Element>, Error> {
    let mut elements = Vec::new();
    for stretch in stretches(sectors.len(), watch) {
        elements.extend(sectors[stretch?].iter().flat_map(|&sector| elements_of(given, sector)));
    }
    sort(&mut elements, watch)?;
    elements.dedup();
    Ok(elements)
}

/// Everything that depends on one sector.
pub fn elements_of<'a>(given: &'a Given<'a>, sector: Sector) -> impl Iterator<Item = Element> + 'a {
    let fan = &given.chamfers.sectors.fans[sector];
    let surface = given.chamfers.sectors.corners(given.surface.topology, sector);
    let sides = [fan.first, fan.last.prev()].map(|side| given.chamfers.edges.chamfered_at[side]);
    surface
        .map(|corner| Element::Surface(corner.triangle()))
        .chain(sides.into_iter().filter(|edge| edge.is_some()).map(Element::Strip))
        .chain(std::iter::once(Element::Fill(fan.ring)))
        .chain(flaps_of(given, sector))
}

/// The joints of a flap.
pub fn flap_joints(given: &Given, place: u32) -> [Corner; 3] {
    flaps::joints(given.surface.topology, &given.chamfers.edges.parted[place as usize])
}

/// The flaps that depend on a sector.
fn flaps_of(given: &Given, sector: Sector) -> Few<Element> {
    let (parted, twin) = (&given.chamfers.edges.parted, &given.surface.topology.twin);
    if parted.is_empty() {
        return Few::new();
    }
    let sectors = given.chamfers.sectors;
    let last = sectors.fans[sector].last.prev();
    let corners = sectors.corners(given.surface.topology, sector);
    let ends = corners.flat_map(|corner| [corner, twin[corner]]).chain([twin[last]]);
    let place = |end: Corner| parted.binary_search_by_key(&end, |parted| parted.corner).ok();
    ends.filter_map(place).map(|place| Element::Flap(place as u32)).collect()
}
