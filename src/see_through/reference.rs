//! The same looks, each step the obvious way: what the fast one is held to.

use glam::DVec3;

use super::raster::{Frame, View};
use super::{Eyes, LEAST_SAMPLES, REACH, SceneTriangle, wide};

/// What [`super::leaks`] finds, without the depth: the places of each leak.
pub fn leaks(
    before: &[SceneTriangle],
    after: &[SceneTriangle],
    width: f32,
    eyes: Eyes,
) -> Vec<Vec<[f32; 3]>> {
    let Some(frame) = Frame::around(before) else { return Vec::new() };
    frame
        .views(eyes.views, eyes.resolution)
        .flat_map(|view| leaks_in(&view, before, after, f64::from(width) * REACH))
        .collect()
}

fn leaks_in(
    view: &View,
    before: &[SceneTriangle],
    after: &[SceneTriangle],
    reach: f64,
) -> Vec<Vec<[f32; 3]>> {
    let [old, new] = [before, after].map(|triangles| depths(view, triangles));
    let radius = (reach / view.sample_size).ceil() as usize + 1;
    let size = view.size;
    let near = |place: usize| place.saturating_sub(radius)..(place + radius + 1).min(size);
    let is_open = |column: usize, row: usize| {
        let windows = near(row).flat_map(|row| near(column).map(move |column| row * size + column));
        windows.map(|sample| old[sample]).fold(f64::NEG_INFINITY, f64::max) + reach
            < new[row * size + column]
    };
    let mut open: Vec<bool> = (0..size * size).map(|s| is_open(s % size, s / size)).collect();
    let groups = (0..open.len()).map(|sample| take_joined(&mut open, size, sample));
    let groups: Vec<_> = groups.filter(|samples| samples.len() >= LEAST_SAMPLES).collect();
    let place = |&s: &usize| view.place(s % size, s / size, old[s]).as_vec3().to_array();
    groups.iter().map(|samples| samples.iter().map(place).collect()).collect()
}

/// `#samples`, row by row.
fn depths(view: &View, triangles: &[SceneTriangle]) -> Vec<f64> {
    let mut depths = vec![f64::INFINITY; view.size * view.size];
    for triangle in triangles {
        let corners = triangle.map(|corner| view.project(wide(corner)));
        for (sample, seen) in depths.iter_mut().enumerate() {
            let [x, y] = [sample % view.size, sample / view.size].map(|place| place as f64 + 0.5);
            *seen = depth(&corners, DVec3::new(x, y, 0.0)).map_or(*seen, |depth| seen.min(depth));
        }
    }
    depths
}

/// Of a triangle that is seen from the front, at a place of the picture.
fn depth(&[a, b, c]: &[DVec3; 3], at: DVec3) -> Option<f64> {
    let area = |a: DVec3, b: DVec3, c: DVec3| (b - a).truncate().perp_dot((c - a).truncate());
    let weights = [area(b, c, at), area(c, a, at), area(a, b, at)];
    let whole = area(a, b, c);
    (whole > 0.0 && weights.into_iter().all(|weight| weight >= 0.0))
        .then(|| (a.z * weights[0] + b.z * weights[1] + c.z * weights[2]) / whole)
}

/// The open samples joined to one, itself included; they are no longer open then.
fn take_joined(open: &mut [bool], size: usize, first: usize) -> Vec<usize> {
    let mut joined = Vec::new();
    if std::mem::take(&mut open[first]) {
        joined.push(first);
    }
    let mut looked = 0;
    while let Some(&sample) = joined.get(looked) {
        looked += 1;
        let (column, row) = (sample % size, sample / size);
        for row in row.saturating_sub(1)..(row + 2).min(size) {
            for column in column.saturating_sub(1)..(column + 2).min(size) {
                if std::mem::take(&mut open[row * size + column]) {
                    joined.push(row * size + column);
                }
            }
        }
    }
    joined
}
