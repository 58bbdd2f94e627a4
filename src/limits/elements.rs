//! Elements: source triangles, strips and fills, and the sectors that they depend on.

use crate::ids::{Corner, Edge, Few, Ring, Sector, Triangle};
use crate::strips;

use crate::given::Given;

/// Anything that can go bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    Surface(Triangle),
    Strip(Edge),
    Fill(Ring),
}

impl Element {
    /// Orders elements, by kind and number, with a single comparison.
    pub fn key(self) -> u64 {
        let (kind, number) = match self {
            Element::Surface(triangle) => (0, triangle.0),
            Element::Strip(edge) => (1, edge.0),
            Element::Fill(ring) => (2, ring.0),
        };
        kind << 32 | u64::from(number)
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
    }
}

/// Everything that depends on the sectors, each once.
pub fn around(given: &Given, sectors: &[Sector]) -> Vec<Element> {
    let mut elements: Vec<Element> =
        sectors.iter().flat_map(|&sector| elements_of(given, sector)).collect();
    elements.sort_unstable_by_key(|element| element.key());
    elements.dedup();
    elements
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
}
