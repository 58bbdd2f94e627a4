//! What the vertices of a result were re-sampled from, in less memory than an array of it takes.

use super::{Blend, VertexSource};
use crate::error::Error;
use crate::memory;

/// `#vertices`: what each was re-sampled from.
///
/// Most vertices have one blend for all that they are, or none; and a copy that continues another
/// chart shares the blends of the vertex that it is a copy of. So each [`VertexSource`] is put
/// together when it is asked for.
#[derive(Clone, Debug, Default)]
pub struct VertexSources {
    blends: Vec<Blend>,
    /// So many vertices at the beginning are those of the source, as they were.
    kept: u32,
    /// The vertices after them, as far as none continues another chart.
    own: Vec<Own>,
    /// All others.
    continuing: Vec<Continuing>,
}

/// Where a vertex has its blends.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Own {
    /// It is a source vertex as it was.
    Kept(u32),
    /// One for all.
    One(u32),
    /// One for the surface, and the next one for the chart.
    Two(u32),
}

impl Own {
    /// The same where so many blends come before.
    fn behind(self, first: u32) -> Own {
        match self {
            Own::Kept(source) => Own::Kept(source),
            Own::One(place) => Own::One(first + place),
            Own::Two(place) => Own::Two(first + place),
        }
    }
}

/// A vertex that may continue another chart.
#[derive(Clone, Copy, Debug)]
struct Continuing {
    own: Own,
    owner: Blend,
    owner_channels: u32,
}

impl VertexSources {
    /// How many vertices there are.
    pub fn len(&self) -> usize {
        self.first_continuing() + self.continuing.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// What one vertex was re-sampled from.
    ///
    /// # Panics
    /// As a slice does where there is no such vertex.
    pub fn get(&self, vertex: usize) -> VertexSource {
        let [surface, chart] = match self.own(vertex) {
            Own::Kept(source) => [Blend::one(source); 2],
            Own::One(blend) => [self.blends[blend as usize]; 2],
            Own::Two(first) => [first, first + 1].map(|blend| self.blends[blend as usize]),
        };
        match vertex.checked_sub(self.first_continuing()) {
            None => VertexSource::new(surface, chart),
            Some(place) => {
                let Continuing { owner, owner_channels, .. } = self.continuing[place];
                VertexSource { surface, chart, owner, owner_channels }
            }
        }
    }

    /// All of them in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = VertexSource> + '_ {
        (0..self.len()).map(|vertex| self.get(vertex))
    }

    /// Those of a mesh as it was.
    pub(crate) fn of_source(vertices: usize) -> VertexSources {
        VertexSources { kept: vertices as u32, ..VertexSources::default() }
    }

    /// None yet, and room for those of a mesh of whose vertices some will move, and some will be copied.
    pub(crate) fn with_room(vertices: usize, moved: usize, copies: usize) -> VertexSources {
        VertexSources {
            blends: Vec::with_capacity(moved),
            kept: 0,
            own: Vec::with_capacity(vertices),
            continuing: Vec::with_capacity(copies),
        }
    }

    /// Room for those of some parts, of which so many vertices have moved, where there were so many of the
    /// source: see [`memory::make_room`].
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] where it is not to be had.
    pub(crate) fn make_room<'a>(
        &mut self,
        parts: impl Iterator<Item = &'a VertexSources> + Clone,
        moved: usize,
        (kept, times): (usize, f64),
    ) -> Result<(), Error> {
        let count = |of: fn(&VertexSources) -> usize| parts.clone().map(of).sum();
        memory::make_room(&mut self.blends, count(|part| part.blends.len()), (0, times))?;
        memory::make_room(&mut self.own, moved, (kept, times))?;
        memory::make_room(&mut self.continuing, count(|part| part.continuing.len()), (0, times))
    }

    /// Appends those of a part of a mesh, in terms of the source vertices that `at` tells of those of the
    /// part, which are so many: these are set where they are, and what is new stands behind.
    pub(crate) fn append_part(
        &mut self,
        part: VertexSources,
        kept: usize,
        at: impl Fn(u32) -> u32,
    ) {
        let first = self.blends.len() as u32;
        let blend = |blend: Blend| Blend { vertices: blend.vertices.map(&at), ..blend };
        let own = |own: Own| match own {
            Own::Kept(source) => Own::Kept(at(source)),
            own => own.behind(first),
        };
        (0..kept).for_each(|vertex| self.own[at(vertex as u32) as usize] = own(part.own(vertex)));
        self.own.extend((kept..part.first_continuing()).map(|vertex| own(part.own(vertex))));
        self.continuing.extend(part.continuing.iter().map(|one| Continuing {
            own: own(one.own),
            owner: blend(one.owner),
            owner_channels: one.owner_channels,
        }));
        self.blends.extend(part.blends.into_iter().map(blend));
    }

    /// Appends a source vertex as it was, before any that continues another chart.
    #[inline]
    pub(crate) fn push_kept(&mut self, source: u32) {
        self.own.push(Own::Kept(source));
    }

    /// Appends a vertex that continues no other chart, before any that does. Its chart may be that of the
    /// surface.
    #[inline]
    pub(crate) fn push_moved(&mut self, surface: Blend, chart: Option<Blend>) {
        let own = self.put(surface, chart);
        self.own.push(own);
    }

    /// Appends others, of which none continue another chart either, and takes them away from there.
    pub(crate) fn append(&mut self, others: &mut VertexSources) {
        let first = self.blends.len() as u32;
        self.own.extend(others.own.drain(..).map(|own| own.behind(first)));
        self.blends.append(&mut others.blends);
    }

    /// Appends a vertex that comes from where an earlier one does, but for some channels.
    #[inline]
    pub(crate) fn push_copy(&mut self, vertex: usize, owner: Blend, channels: u8) {
        let own = self.own(vertex);
        self.continuing.push(Continuing { own, owner, owner_channels: channels.into() });
    }

    /// Which vertices were appended as just such a copy.
    pub(crate) fn copies(
        &self,
        vertex: usize,
        owner: Blend,
        channels: u8,
    ) -> impl Fn(u32) -> bool + '_ {
        let (own, first_continuing) = (self.own(vertex), self.first_continuing());
        move |other: u32| {
            let place = (other as usize).checked_sub(first_continuing);
            place.map(|place| &self.continuing[place]).is_some_and(|copy| {
                copy.own == own && copy.owner_channels == channels.into() && copy.owner == owner
            })
        }
    }

    /// Appends a vertex.
    pub(crate) fn push(&mut self, source: VertexSource) {
        let VertexSource { surface, chart, owner, owner_channels } = source;
        let own = self.put(surface, (chart != surface).then_some(chart));
        self.continuing.push(Continuing { own, owner, owner_channels });
    }

    /// Puts other blends in the place of all.
    pub(crate) fn replace(&mut self, with: impl Fn(Blend) -> Blend) {
        self.blends.iter_mut().for_each(|blend| *blend = with(*blend));
        let owns = self.own.iter_mut().chain(self.continuing.iter_mut().map(|one| &mut one.own));
        for own in owns {
            if let Own::Kept(source) = *own {
                let blend = with(Blend::one(source));
                if blend != Blend::one(source) {
                    *own = Own::One(self.blends.len() as u32);
                    self.blends.push(blend);
                }
            }
        }
        self.continuing.iter_mut().for_each(|one| one.owner = with(one.owner));
    }

    #[inline]
    fn put(&mut self, surface: Blend, chart: Option<Blend>) -> Own {
        let first = self.blends.len() as u32;
        self.blends.push(surface);
        let Some(chart) = chart else { return Own::One(first) };
        self.blends.push(chart);
        Own::Two(first)
    }

    #[inline]
    fn own(&self, vertex: usize) -> Own {
        let (kept, first_continuing) = (self.kept as usize, self.first_continuing());
        match () {
            () if vertex < kept => Own::Kept(vertex as u32),
            () if vertex < first_continuing => self.own[vertex - kept],
            () => self.continuing[vertex - first_continuing].own,
        }
    }

    /// The first vertex that may continue another chart.
    #[inline]
    pub(crate) fn first_continuing(&self) -> usize {
        self.kept as usize + self.own.len()
    }
}

impl FromIterator<VertexSource> for VertexSources {
    fn from_iter<I: IntoIterator<Item = VertexSource>>(sources: I) -> VertexSources {
        let mut all = VertexSources::default();
        sources.into_iter().for_each(|source| all.push(source));
        all
    }
}

impl PartialEq for VertexSources {
    fn eq(&self, other: &VertexSources) -> bool {
        self.iter().eq(other.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: Blend = Blend { vertices: [0, 1, 0], weights: [0.5, 0.5, 0.0] };

    fn own(surface: Blend, chart: Blend) -> VertexSource {
        VertexSource::new(surface, chart)
    }

    #[test]
    fn a_copy_shares_all_but_its_owner() {
        let mut sources = VertexSources::with_room(2, 1, 1);
        sources.push_kept(0);
        sources.push_moved(HALF, Some(Blend::one(1)));
        sources.push_copy(1, Blend::one(7), 0b10);
        let copy =
            VertexSource { owner: Blend::one(7), owner_channels: 0b10, ..own(HALF, Blend::one(1)) };
        let all: Vec<VertexSource> = sources.iter().collect();
        assert_eq!(all, [own(Blend::one(0), Blend::one(0)), own(HALF, Blend::one(1)), copy]);
    }

    #[test]
    fn any_sources_can_be_collected_and_come_out_again() {
        let odd = VertexSource { owner: Blend::one(9), ..own(Blend::one(3), HALF) };
        let all = [odd, own(HALF, HALF), own(Blend::one(5), Blend::one(5))];
        assert!(all.into_iter().collect::<VertexSources>().iter().eq(all));
    }

    #[test]
    fn all_blends_can_be_replaced() {
        let mut sources = VertexSources::with_room(2, 1, 1);
        sources.push_moved(HALF, Some(Blend::one(1)));
        sources.push_kept(1);
        sources.push_copy(1, Blend::one(1), 0b10);
        sources.replace(|blend| if blend == Blend::one(1) { Blend::one(5) } else { blend });
        let one = |source: VertexSource| [source.surface, source.chart, source.owner];
        assert_eq!(one(sources.get(0)), [HALF, Blend::one(5), Blend::one(5)]);
        assert_eq!(one(sources.get(1)), [Blend::one(5); 3]);
        assert_eq!(one(sources.get(2)), [Blend::one(5); 3]);
    }
}
