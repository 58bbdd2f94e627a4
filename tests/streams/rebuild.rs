//! Provenance must be enough: every stream is rebuilt from it, and compared with what was stored.

use std::collections::HashMap;

use chamfer::{Blend, Chamfered, Mesh, UV_CHANNELS};
use glam::DVec3;

use crate::tally::Tally;

/// How far a rebuilt position may be off, as a share of the largest coordinate.
const POSITION: f64 = 1e-5;

/// How far a rebuilt direction or colour may be off.
const VALUE: f64 = 1e-5;

/// How far a tangent may be off: where little is left of it across the normal, rounding grows.
const TANGENT: f64 = 1e-3;

pub fn check(name: &str, before: &Mesh, after: &Chamfered, tally: &mut Tally) {
    let middles = middles(after);
    let fan = |vertex: usize| middles.contains_key(&vertex);
    let largest = before.positions.as_flattened().iter().fold(0.0_f32, |m, x| m.max(x.abs()));
    for (vertex, source) in after.vertex_sources.iter().enumerate() {
        let stored = vector(after.mesh.positions[vertex]);
        let rebuilt = blend(&source.surface, |v| vector(before.positions[v]));
        let off = stored.distance(rebuilt) / f64::from(largest);
        let rule = if fan(vertex) { "2 position of middles" } else { "2 position" };
        tally.note(rule, name, (off > POSITION).then(|| format!("{vertex} off by {off:.1e}")));
        if !fan(vertex) {
            check_normal(name, before, after, vertex, tally);
        }
        check_uvs(name, before, after, vertex, tally);
        check_color(name, before, after, vertex, tally);
        check_tangent(name, before, after, vertex, tally);
    }
    check_duplicates(name, before, after, tally);
}

/// Vertices that no source triangle and no strip uses: those inside fills.
fn middles(after: &Chamfered) -> HashMap<usize, ()> {
    let mut in_fill = HashMap::new();
    for (triangle, source) in after.triangle_sources.iter().enumerate() {
        if source.kind == chamfer::TriangleKind::Corner {
            let corners = &after.mesh.indices[3 * triangle..3 * triangle + 3];
            in_fill.extend(corners.iter().map(|&v| (v as usize, ())));
        }
    }
    // In a fan, the middle is where the provenance names one corner and two of its neighbours, and
    // no other vertex stands at the same place.
    let mut at = HashMap::new();
    for position in &after.mesh.positions {
        *at.entry(position.map(f32::to_bits)).or_insert(0) += 1;
    }
    for (triangle, source) in after.triangle_sources.iter().enumerate() {
        if source.kind != chamfer::TriangleKind::Corner {
            for &v in &after.mesh.indices[3 * triangle..3 * triangle + 3] {
                let place = after.mesh.positions[v as usize].map(f32::to_bits);
                at.insert(place, u32::MAX as usize);
            }
        }
    }
    let place = |v: &usize| after.mesh.positions[*v].map(f32::to_bits);
    in_fill.retain(|v, ()| at[&place(v)] < u32::MAX as usize);
    in_fill
}

fn check_normal(name: &str, before: &Mesh, after: &Chamfered, vertex: usize, tally: &mut Tally) {
    let surface = &after.vertex_sources.get(vertex).surface;
    let mixed = blend(surface, |v| vector(before.normals[v]));
    let stored = vector(after.mesh.normals[vertex]);
    let rebuilt = mixed.try_normalize().unwrap_or(stored);
    let is_unit = (stored.length() - 1.0).abs() < 1e-3;
    let off = stored.normalize_or_zero().distance(rebuilt);
    tally.note(
        "2 normal",
        name,
        (is_unit && off > VALUE).then(|| format!("{vertex} by {off:.1e}")),
    );
}

fn check_uvs(name: &str, before: &Mesh, after: &Chamfered, vertex: usize, tally: &mut Tally) {
    let source = after.vertex_sources.get(vertex);
    for channel in (0..UV_CHANNELS).filter(|&channel| before.uvs[channel].components > 0) {
        let owned = source.owner_channels >> channel & 1 == 1;
        let from = if owned { &source.owner } else { &source.chart };
        let components = before.uvs[channel].components as usize;
        for k in 0..components {
            let at = |v: usize| f64::from(before.uvs[channel].values[v * components + k]);
            let rebuilt = number(from, at);
            let stored = f64::from(after.mesh.uvs[channel].values[vertex * components + k]);
            let size = from.vertices.iter().fold(1.0, |m: f64, &v| m.max(at(v as usize).abs()));
            let off = (stored - rebuilt).abs() / size;
            let wrong = (off > 1e-6).then(|| format!("{vertex} channel {channel} by {off:.1e}"));
            tally.note("2 uv", name, wrong);
        }
    }
}

fn check_color(name: &str, before: &Mesh, after: &Chamfered, vertex: usize, tally: &mut Tally) {
    if before.colors.is_empty() {
        return;
    }
    for k in 0..4 {
        let range =
            |pick: fn(f32, f32) -> f32, from| before.colors.iter().map(|c| c[k]).fold(from, pick);
        let low = f64::from(range(f32::min, f32::INFINITY));
        let high = f64::from(range(f32::max, f32::NEG_INFINITY));
        let chart = &after.vertex_sources.get(vertex).chart;
        let rebuilt = number(chart, |v| f64::from(before.colors[v][k])).clamp(low, high);
        let off = (f64::from(after.mesh.colors[vertex][k]) - rebuilt).abs();
        tally.note("2 colour", name, (off > VALUE).then(|| format!("{vertex} by {off:.1e}")));
        let out = !(low..=high).contains(&f64::from(after.mesh.colors[vertex][k]));
        tally.note("5 colour range", name, out.then(|| format!("{vertex}")));
    }
}

/// The way that the provenance's documentation gives: turn the blended tangent along with the
/// normal, then make it orthogonal.
fn check_tangent(name: &str, before: &Mesh, after: &Chamfered, vertex: usize, tally: &mut Tally) {
    if before.tangents.is_empty() {
        return;
    }
    let source = after.vertex_sources.get(vertex);
    let from = if source.owner_channels & 1 == 1 { &source.owner } else { &source.chart };
    let of = |v: usize| before.tangents[v];
    let direction = |t: [f32; 4]| DVec3::new(f64::from(t[0]), f64::from(t[1]), f64::from(t[2]));
    let stored = after.mesh.tangents[vertex];
    let normal = vector(after.mesh.normals[vertex]);
    let sound = |v: &u32| {
        let t = direction(of(*v as usize));
        let is_unit = (t.length() - 1.0).abs() < 1e-3;
        is_unit && t.dot(vector(before.normals[*v as usize])).abs() < 1e-3
    };
    if !from.vertices.iter().all(sound) {
        return;
    }
    let length = (direction(stored).length() - 1.0).abs();
    let lean = direction(stored).dot(normal).abs();
    let wrong = length > TANGENT || lean > TANGENT || stored[3].abs() != 1.0;
    tally.note("4 tangent", name, wrong.then(|| format!("{vertex} {stored:?}")));
    let hand = of(from.vertices[0] as usize)[3];
    tally.note("4 handedness", name, (stored[3] != hand).then(|| format!("{vertex}")));
    let mixed = blend(from, |v| direction(of(v)));
    let own = blend(from, |v| vector(before.normals[v])).normalize_or_zero();
    let turned =
        glam::DQuat::from_rotation_arc(own.normalize_or(normal), normal.normalize()) * mixed;
    let rebuilt = turned - normal * turned.dot(normal);
    // Tangents that cancel out have no direction to compare, opposite normals no turn.
    if rebuilt.length() > 0.1 && own.dot(normal) > -0.99 {
        let off = direction(stored).distance(rebuilt.normalize());
        let wrong = (off > TANGENT).then(|| format!("{vertex} by {off:.1e}"));
        tally.note("4 tangent rebuilt", name, wrong);
    }
}

/// Vertices that are equal in all streams stem from source vertices that already were.
fn check_duplicates(name: &str, before: &Mesh, after: &Chamfered, tally: &mut Tally) {
    let mut first: HashMap<Vec<u32>, usize> = HashMap::new();
    let count = before.positions.len();
    let were_equal =
        |a: usize, b: usize| a < count && b < count && values(before, a) == values(before, b);
    for vertex in 0..after.mesh.positions.len() {
        let known = *first.entry(values(&after.mesh.as_mesh(), vertex)).or_insert(vertex);
        let is_new = known != vertex && !were_equal(known, vertex);
        tally.note("6 duplicates", name, is_new.then(|| format!("{known} and {vertex}")));
    }
}

fn values(mesh: &Mesh, vertex: usize) -> Vec<u32> {
    let mut values: Vec<f32> = Vec::new();
    values.extend(mesh.positions[vertex]);
    values.extend(mesh.normals[vertex]);
    values.extend(mesh.tangents.get(vertex).into_iter().flatten());
    values.extend(mesh.colors.get(vertex).into_iter().flatten());
    for uv in &mesh.uvs {
        let components = uv.components as usize;
        values.extend(&uv.values[vertex * components..(vertex + 1) * components]);
    }
    values.iter().map(|value| (value + 0.0).to_bits()).collect()
}

fn vector(value: [f32; 3]) -> DVec3 {
    DVec3::from(value.map(f64::from))
}

fn blend(blend: &Blend, at: impl Fn(usize) -> DVec3) -> DVec3 {
    let terms = blend.vertices.iter().zip(blend.weights);
    terms.map(|(&vertex, weight)| at(vertex as usize) * f64::from(weight)).sum()
}

fn number(blend: &Blend, at: impl Fn(usize) -> f64) -> f64 {
    let terms = blend.vertices.iter().zip(blend.weights);
    terms.map(|(&vertex, weight)| at(vertex as usize) * f64::from(weight)).sum()
}
