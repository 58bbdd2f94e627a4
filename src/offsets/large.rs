//! Large sectors: what takes long by itself is told of corner by corner.

use super::{Offset, blade, offset};
use crate::chamfers::Chamfers;
use crate::error::Error;
use crate::ids::Sector;
use crate::surface::Surface;
use crate::watch::Watch;

/// A sector of more corners takes long by itself: it is done on the calling thread, which tells of its
/// corners.
pub const MANY_CORNERS: usize = 4096;

/// The offset of a sector of many corners, of which the watch is told.
pub fn offset_of_large(
    surface: Surface,
    chamfers: Chamfers,
    sector: Sector,
    watch: &dyn Watch,
) -> Result<Offset, Error> {
    let (fan, mut spread) = (&chamfers.sectors.fans[sector], Vec::new());
    for corner in chamfers.sectors.corners(surface.topology, sector) {
        spread.push(blade(surface.view, corner, spread.last()));
        if spread.len().is_multiple_of(MANY_CORNERS) {
            watch.worked(MANY_CORNERS)?;
        }
    }
    let offset = offset(surface, chamfers.edges, fan, (&spread, false));
    watch.worked(2 * spread.len())?;
    Ok(offset)
}
