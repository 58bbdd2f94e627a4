//! Chamfers in the texture: inside their chart, with an area, and about as dense as it.

use chamfer::{Chamfered, Mesh, TriangleKind, UV_CHANNELS};

use crate::charts::{Charts, Point, area, signed, uv_at};
use crate::tally::Tally;

/// How far a chamfer may leave its chart, as a share of the chart's size.
const MARGIN: f64 = 1e-4;

/// How much denser or thinner than its chart a chamfer may lie on the texture.
const MOST_STRETCH: f64 = 4.0;

/// A triangle so small, as a share of the extent squared, has no measurable area.
const LEAST_AREA: f64 = 1e-12;

pub fn check(name: &str, before: &Mesh, after: &Chamfered, tally: &mut Tally) {
    for channel in (0..UV_CHANNELS).filter(|&channel| before.uvs[channel].components > 0) {
        let charts = Charts::new(*before, channel);
        for triangle in 0..after.triangle_sources.len() {
            if after.triangle_sources[triangle].kind != TriangleKind::Source {
                check_triangle(name, &charts, before, after, channel, triangle, tally);
            }
        }
    }
}

fn check_triangle(
    name: &str,
    charts: &Charts,
    before: &Mesh,
    after: &Chamfered,
    channel: usize,
    triangle: usize,
    tally: &mut Tally,
) {
    let mesh = after.mesh.as_mesh();
    let corners = [0, 1, 2].map(|k| mesh.indices[3 * triangle + k] as usize);
    let uvs = corners.map(|vertex| uv_at(mesh.uvs[channel], vertex));
    let places = corners.map(|vertex| mesh.positions[vertex]);
    let beside = neighbours(charts, before, after, triangle);
    let told = || {
        let kind = after.triangle_sources[triangle].kind;
        let source = after.triangle_sources[triangle].index;
        format!("{kind:?} {source} channel {channel} at {:?} uvs {uvs:?}", places[0])
    };
    let holds = |&&face: &&usize| {
        samples(uvs).into_iter().all(|point| charts.footprint(face).covers(point, MARGIN))
    };
    let inside: Vec<usize> = beside.iter().filter(holds).copied().collect();
    let far = || {
        let reach = |&face: &usize| {
            let away = samples(uvs).map(|point| charts.footprint(face).distance(point));
            away.into_iter().fold(0.0, f64::max)
        };
        beside.iter().map(reach).fold(f64::MAX, f64::min)
    };
    let left = inside.is_empty().then(|| format!("off by {:.2e}: {}", far(), told()));
    tally.note("1 footprint", name, left);
    let own = if inside.is_empty() { &beside } else { &inside };
    // A face that shows a point or a line of the texture has no measure for a chamfer.
    if own.iter().any(|&face| !charts.has_area(face)) {
        return;
    }
    let densities: Vec<f64> = own.iter().filter_map(|&face| charts.density(face)).collect();
    let (space, texture) = (area(places), signed(uvs));
    let extent = f64::from(before.extent());
    if densities.is_empty() || space < LEAST_AREA * extent * extent {
        return;
    }
    let least = densities.iter().map(|d| d.abs()).fold(f64::MAX, f64::min);
    let is_empty = texture.abs() < least * space * 1e-3;
    tally.note("1 area", name, is_empty.then(told));
    let ratios = densities.iter().map(|density| texture / space / density);
    let fits = ratios.clone().any(|ratio| (1.0 / MOST_STRETCH..=MOST_STRETCH).contains(&ratio));
    let mirrored = ratios.clone().all(|ratio| ratio < 0.0);
    let all: Vec<f64> = ratios.collect();
    tally.note("1 mirrored", name, mirrored.then(|| format!("{all:.3?} {}", told())));
    let thin = !fits && all.iter().all(|ratio| ratio.abs() < 1.0);
    let kind = after.triangle_sources[triangle].kind;
    let rules = match kind {
        TriangleKind::Edge => ["1 thin strip", "1 dense strip"],
        _ => ["1 thin fill", "1 dense fill"],
    };
    tally.note(rules[0], name, thin.then(|| format!("{all:.3?} {}", told())));
    tally.note(rules[1], name, (!fits && !thin).then(|| format!("{all:.3?} {}", told())));
}

/// The source triangles whose charts a new triangle may continue.
fn neighbours(charts: &Charts, before: &Mesh, after: &Chamfered, triangle: usize) -> Vec<usize> {
    let source = after.triangle_sources[triangle];
    match source.kind {
        TriangleKind::Edge => {
            let ends = after.verdicts[source.index as usize].vertices;
            let [one, other] = ends.map(|vertex| before.positions[vertex as usize]);
            match charts.on_edge(one, other) {
                // An edge that is several on its other side.
                [_] | [] => charts.along(one, other),
                both => both.to_vec(),
            }
        }
        _ => charts.at_point(before.positions[source.index as usize]).to_vec(),
    }
}

fn samples(corners: [Point; 3]) -> [Point; 7] {
    let mix = |weights: [f64; 3]| [0, 1].map(|k| (0..3).map(|c| weights[c] * corners[c][k]).sum());
    [
        corners[0],
        corners[1],
        corners[2],
        mix([0.5, 0.5, 0.0]),
        mix([0.0, 0.5, 0.5]),
        mix([0.5, 0.0, 0.5]),
        mix([1.0 / 3.0; 3]),
    ]
}
