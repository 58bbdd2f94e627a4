//! Placement: where every corner stands when each sector takes a share of its offset.

use std::borrow::Cow;

use glam::{DVec3, Vec3};

use crate::error::Error;
use crate::foot::Foot;
use crate::ids::{Corner, Id, IdVec, Sector};
use crate::offsets::Offset;
use crate::ranks::Ranks;
use crate::resample::{blended_normal, chart_foot, surface_foot};
use crate::sectors::Sectors;
use crate::surface::Surface;
use crate::threads::Threads;
use crate::watch::{Watch, collect, each_of};

/// Positions as they will be stored, so that what is checked is what comes out.
#[derive(Clone)]
pub struct Placement<'a> {
    surface: Surface<'a>,
    sectors: &'a Sectors,
    offsets: Cow<'a, IdVec<Sector, Offset>>,
    /// What is not to come together; none where nothing does.
    pub apart: Option<&'a Ranks>,
    /// `#sectors`: 0 (stays) to 1 (full width).
    pub share: IdVec<Sector, f64>,
    /// `#sectors`: the position of the sector's vertices.
    pub point: IdVec<Sector, DVec3>,
    /// `#sectors`: the normals at the sector's first and at its last corner.
    pub normals: IdVec<Sector, [DVec3; 2]>,
}

impl<'a> Placement<'a> {
    /// Every sector at a share of its offset, and some apart; `share: #sectors`.
    pub fn new(
        surface: Surface<'a>,
        sectors: &'a Sectors,
        (offsets, apart): (&'a IdVec<Sector, Offset>, Option<&'a Ranks>),
        share: IdVec<Sector, f64>,
        (threads, watch): (&Threads, &dyn Watch),
    ) -> Result<Placement<'a>, Error> {
        let (point, normals) = (IdVec::default(), IdVec::default());
        let offsets = Cow::Borrowed(offsets);
        let mut placement = Placement { surface, sectors, offsets, apart, share, point, normals };
        let count = placement.share.len();
        placement.point =
            threads.map(count, watch, |s| placement.point_at(s, placement.share[s]))?;
        placement.normals = threads.map(
            count,
            watch,
            #[inline(always)]
            |sector| placement.normals_of(sector),
        )?;
        Ok(placement)
    }

    /// Moves a sector's vertex to a share of its offset.
    pub fn set(&mut self, sector: Sector, share: f64) {
        self.share[sector] = share;
        self.point[sector] = self.point_at(sector, share);
        self.normals[sector] = self.normals_of(sector);
    }

    /// Moves the vertices of some sectors, each to a share of another offset.
    ///
    /// # Errors
    /// What `watch` gives: all offsets may have to be copied before.
    pub fn turn(
        &mut self,
        turned: &[(Sector, Offset, f64)],
        watch: &dyn Watch,
    ) -> Result<(), Error> {
        if let Cow::Borrowed(offsets) = self.offsets {
            let own = collect(offsets.len(), watch, |place| offsets[Sector::new(place)])?;
            self.offsets = Cow::Owned(IdVec::from_vec(own));
        }
        let offsets = self.offsets.to_mut();
        turned.iter().for_each(|&(sector, offset, _)| offsets[sector] = offset);
        each_of(turned, watch, |&(sector, _, share)| self.set(sector, share))
    }

    /// Whether the sector's vertices stand elsewhere than in the source.
    #[inline(always)]
    pub fn has_moved(&self, sector: Sector) -> bool {
        self.point[sector] != self.base(sector)
    }

    /// Where the sector's vertices stand in the source.
    #[inline]
    pub fn base(&self, sector: Sector) -> DVec3 {
        self.surface.view.position_at(self.sectors.fans[sector].first)
    }

    /// Where the sector's vertices are stored, before they are rounded.
    #[inline(always)]
    pub fn stored(&self, sector: Sector) -> DVec3 {
        if self.surface.view.stored.is_none() && self.apart.is_none() {
            return self.point[sector];
        }
        self.stored_elsewhere(sector)
    }

    /// The same where that is not where they are measured, or they are told apart.
    #[inline(never)]
    fn stored_elsewhere(&self, sector: Sector) -> DVec3 {
        let view = self.surface.view;
        let vertex = view.vertex_at(self.sectors.fans[sector].first);
        let stored = view.stored_from(vertex, self.point[sector]);
        let Some(apart) = self.apart else { return stored };
        apart.moved(sector, Vec3::from(view.stored_positions()[vertex.index()]).as_dvec3(), stored)
    }

    /// Where a point is stored that is none of a sector's vertices, but is told apart as they are. What is
    /// measured as it is stored has its rank there.
    pub fn stored_by(&self, sector: Sector, point: DVec3) -> DVec3 {
        let view = self.surface.view;
        let (stored, is_mapped) = (view.stored(point), view.stored.is_some());
        let apart = self.apart.filter(|_| is_mapped);
        apart.map_or(stored, |apart| apart.point(sector, stored))
    }

    /// Where a corner is stored.
    #[inline]
    pub fn stored_at(&self, corner: Corner) -> [f32; 3] {
        let (view, sector) = (self.surface.view, self.sectors.sector_of[corner]);
        if sector.is_none() {
            return view.stored_positions()[view.vertex_at(corner).index()];
        }
        self.stored(sector).as_vec3().to_array()
    }

    /// Where a corner of the source mesh stands now.
    #[inline]
    pub fn position_at(&self, corner: Corner) -> DVec3 {
        let sector = self.sectors.sector_of[corner];
        if sector.is_none() { self.surface.view.position_at(corner) } else { self.point[sector] }
    }

    /// The point and the normal at a corner that is the first (0) or the last (1) one of its sector.
    #[inline(always)]
    pub fn at_end(&self, corner: Corner, end: usize) -> (DVec3, DVec3) {
        let (view, sector) = (self.surface.view, self.sectors.sector_of[corner]);
        if sector.is_none() {
            return (view.position_at(corner), view.normal_at(corner));
        }
        (self.point[sector], self.normals[sector][end])
    }

    /// The normal at a corner; between the first and the last corner of a sector, the last one's.
    #[inline(always)]
    pub fn normal_at(&self, corner: Corner) -> DVec3 {
        let sector = self.sectors.sector_of[corner];
        if sector.is_none() {
            return self.surface.view.normal_at(corner);
        }
        let is_first = self.sectors.fans[sector].first == corner;
        self.normals[sector][usize::from(!is_first)]
    }

    /// Where a sector goes at full width.
    pub fn offset(&self, sector: Sector) -> &Offset {
        &self.offsets[sector]
    }

    /// The way that a corner of a sector goes at full width, on the surface where it stands: see
    /// [`surface_foot`].
    pub fn surface_foot(&self, sector: Sector, corner: Corner) -> Foot {
        let way = (&self.offsets[sector], self.share[sector]);
        surface_foot(self.surface, self.sectors, way, corner)
    }

    /// The same in the corner's own texture chart: see [`chart_foot`].
    pub fn chart_foot(&self, sector: Sector, corner: Corner) -> Foot {
        chart_foot(self.surface, self.sectors, &self.offsets[sector], corner)
    }

    fn point_at(&self, sector: Sector, share: f64) -> DVec3 {
        let (base, way) = (self.base(sector), self.offsets[sector].vector * share);
        self.apart.map_or_else(|| narrow(base + way), |apart| apart.moved(sector, base, base + way))
    }

    /// The normals where a sector stands, at its first and at its last corner.
    #[inline(always)]
    fn normals_of(&self, sector: Sector) -> [DVec3; 2] {
        let offset = &self.offsets[sector];
        if offset.is_plain && self.has_moved(sector) {
            return [self.normal_on(&offset.foot, sector); 2];
        }
        self.normals_of_parts(sector)
    }

    /// The same where they may be of several parts, or stay.
    #[inline(never)]
    fn normals_of_parts(&self, sector: Sector) -> [DVec3; 2] {
        let (view, fan) = (self.surface.view, &self.sectors.fans[sector]);
        // A move that rounding swallows leaves the vertex, and so its normal, as it was.
        if !self.has_moved(sector) {
            return [fan.first, fan.last].map(|corner| view.normal_at(corner));
        }
        let at = |corner: Corner| self.normal_on(&self.surface_foot(sector, corner), sector);
        let first = at(fan.first);
        let is_one = !fan.is_broken && view.vertex_at(fan.first) == view.vertex_at(fan.last);
        [first, if is_one { first } else { at(fan.last) }]
    }

    /// The normal at a sector's share of a way.
    #[inline(always)]
    fn normal_on(&self, foot: &Foot, sector: Sector) -> DVec3 {
        let view = self.surface.view;
        let [a, b, c] = foot.corner.triangle().corners().map(|corner| view.vertex_at(corner));
        // Most faces are flat: nothing is to be blended.
        if view.has_one_normal(a, b) && view.has_one_normal(a, c) {
            return view.normal(a);
        }
        blended_normal(view, &foot.blend(view, self.share[sector]))
    }
}

/// Rounded to single precision.
#[inline]
fn narrow(point: DVec3) -> DVec3 {
    point.as_vec3().as_dvec3()
}
