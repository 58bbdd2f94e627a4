//! Where light shows after chamfering: the scenes of both files, looked through.

use std::cmp::Reverse;
use std::path::Path;

use anyhow::Result;
use chamfer::see_through::{Eyes, Leak, REACH, SceneTriangle, leaks};
use chamfer_formats::Document;
use glam::Vec3;

use crate::close_up::close_up;
use crate::pictures::write_png;
use crate::preview::{LARGE_TILE, Panel, SMALL_TILE, before_after, contact_sheet};
use crate::scene::{placed, scene_triangles};

use super::report::{Place, SeeThrough};

/// How many places a picture shows.
const CLOSE_UPS: usize = 4;

/// Leaks whose places are at most so many widths apart are one: an outline may recede so far.
const SAME_PLACE: f32 = REACH as f32;

/// Looks through two scenes. Without a width only scenes that are the same can be told to be.
pub fn look([before, after]: [&dyn Document; 2], width: Option<f32>) -> SeeThrough {
    let [before, after] = [before, after].map(scene);
    match width {
        None if before == after => SeeThrough::default(),
        None => SeeThrough::not_checked("there are no chamfers to tell the width: give --width"),
        Some(width) => {
            let found = leaks(&before, &after, width, Eyes::default().with_threads(0));
            SeeThrough { width: Some(width), places: merged(found, width), ..SeeThrough::default() }
        }
    }
}

fn scene(document: &dyn Document) -> Vec<SceneTriangle> {
    scene_triangles(document, |mesh| &document.meshes()[mesh].mesh)
}

/// Leaks at one place together, however many views show them. The worst come first: those with
/// nothing behind, then by their samples.
fn merged(mut leaks: Vec<Leak>, width: f32) -> Vec<Place> {
    leaks.sort_by_key(|leak| Reverse((leak.depth.is_infinite(), leak.places.len())));
    let mut places: Vec<Place> = Vec::new();
    for leak in leaks {
        match places.iter_mut().find(|place| are_near(&place.leak, &leak, width * SAME_PLACE)) {
            Some(place) => place.add(&leak),
            None => places.push(Place::new(leak)),
        }
    }
    places
}

/// Whether the middle of one is near any place of the other.
fn are_near(one: &Leak, other: &Leak, distance: f32) -> bool {
    let has = |leak: &Leak, middle: [f32; 3]| {
        let apart = |place: &[f32; 3]| Vec3::from(*place).distance(Vec3::from(middle));
        leak.places.iter().any(|place| apart(place) <= distance)
    };
    has(one, other.middle()) || has(other, one.middle())
}

/// Draws the worst places to a file, or the whole model if there are none.
///
/// # Errors
/// Where the file cannot be written.
pub fn draw(
    path: &Path,
    caption: &str,
    documents: [&dyn Document; 2],
    found: &SeeThrough,
) -> Result<()> {
    let placed = || documents.map(|document| placed(document, |k| &document.meshes()[k].mesh));
    let worst = found.places.iter().take(CLOSE_UPS);
    let close_up = |place: &Place| {
        let caption = format!("{caption}: light shows");
        close_up(caption, placed(), &place.leak, found.width.unwrap_or(0.0))
    };
    let panels: Vec<Panel> = worst.map(close_up).collect();
    let whole = || {
        let [before, after] = placed();
        Panel { caption: caption.into(), before, after, ..Panel::default() }
    };
    write_png(
        path,
        &if panels.is_empty() {
            before_after(&whole(), LARGE_TILE)
        } else {
            contact_sheet(&panels, SMALL_TILE)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each seen from another side.
    fn leak(places: &[[f32; 3]], depth: f32) -> Leak {
        Leak::new([0.0, depth, 1.0], places.to_vec(), depth)
    }

    #[test]
    fn leaks_within_three_widths_are_one_place() {
        let slit: Vec<[f32; 3]> = (0..9).map(|k| [k as f32, 0.0, 0.0]).collect();
        let [at_its_end, apart] = [[8.0, 0.25, 0.0], [8.0, 0.4, 0.0]];
        let end = leak(&[at_its_end], 7.0);
        let found = [end.clone(), end, leak(&slit, 2.0), leak(&[apart], 1.0)];
        let places = merged(found.to_vec(), 0.1);
        let told: Vec<_> = places.iter().map(|p| (p.samples, p.views, p.deeper)).collect();
        assert_eq!(told, [(9, 2, Some(2.0)), (1, 1, Some(1.0))]);
        assert_eq!(places[0].at, [4.0, 0.0, 0.0]);
    }

    #[test]
    fn a_view_with_nothing_behind_is_worse_than_a_larger_one() {
        let places = merged(vec![leak(&[[0.0; 3]; 5], 1.0), leak(&[[0.0; 3]], f32::INFINITY)], 0.1);
        assert_eq!((places.len(), places[0].samples, places[0].deeper), (1, 1, None));
    }
}
