//! Normals: by how much those on the two sides of an edge differ where vertices are split.

use std::collections::HashMap;
use std::fmt;

use chamfer::Mesh;
use glam::DVec3;

/// Degrees at which the classes end; the first holds what differs in texture alone.
const ENDS: [f64; 13] = [0.0, 0.05, 0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 45.0, 90.0, 180.0];

/// How many edges there are of each class, and in how many meshes.
#[derive(Default)]
pub struct Angles {
    edges: [usize; ENDS.len()],
    meshes: [usize; ENDS.len()],
}

impl Angles {
    pub fn add(&mut self, mesh: &Mesh) {
        let mut edges = [0; ENDS.len()];
        for degrees in split_edges(mesh) {
            let class = ENDS.iter().position(|&end| degrees <= end).unwrap_or(ENDS.len() - 1);
            edges[class] += 1;
        }
        for (class, count) in edges.into_iter().enumerate() {
            self.edges[class] += count;
            self.meshes[class] += usize::from(count > 0);
        }
    }
}

impl fmt::Display for Angles {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        writeln!(f, "normals differ by, in degrees    edges  meshes")?;
        for (class, end) in ENDS.iter().enumerate() {
            let [edges, meshes] = [self.edges[class], self.meshes[class]];
            writeln!(f, "{:>24} {end:>7} {edges:>8} {meshes:>7}", "up to")?;
        }
        Ok(())
    }
}

/// For each edge between two triangles that do not share both vertices, the larger angle between
/// the normals at its ends.
fn split_edges(mesh: &Mesh) -> Vec<f64> {
    let mut first = HashMap::new();
    let bits = |at: &[f32; 3]| at.map(|part| (part + 0.0).to_bits());
    let places = mesh.positions.iter().enumerate();
    let place: Vec<usize> = places.map(|(v, at)| *first.entry(bits(at)).or_insert(v)).collect();
    let mut sides: HashMap<[usize; 2], Vec<[usize; 2]>> = HashMap::new();
    for triangle in mesh.indices.chunks_exact(3) {
        for k in 0..3 {
            let [from, to] = [triangle[k], triangle[(k + 1) % 3]].map(|vertex| vertex as usize);
            sides.entry([place[from], place[to]]).or_default().push([from, to]);
        }
    }
    let normal = |v: usize| DVec3::from(mesh.normals[v].map(f64::from)).normalize_or_zero();
    // By the cross product: the cosine of a small angle is hardly told from 1.
    let angle = |[a, b]: [usize; 2]| {
        let [a, b] = [a, b].map(normal);
        if a == b { 0.0 } else { a.cross(b).length().atan2(a.dot(b)).to_degrees() }
    };
    let of_pair = |(ends, one): (&[usize; 2], &Vec<[usize; 2]>)| {
        let other = sides.get(&[ends[1], ends[0]])?;
        let (&[[from, to]], &[[back_from, back_to]]) = (&one[..], &other[..]) else { return None };
        let pairs = [[from, back_to], [to, back_from]];
        let is_split = ends[0] < ends[1] && pairs.iter().any(|[one, other]| one != other);
        is_split.then(|| angle(pairs[0]).max(angle(pairs[1])))
    };
    sides.iter().filter_map(of_pair).collect()
}
