//! One shape told in other ways: what a chamfer may not depend on.

use chamfer::MeshBuffers;

/// Another way to tell a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Retold {
    /// The triangles of each submesh in another order, by chance.
    Shuffled(u32),
    /// The vertices in another order, by chance.
    Renumbered(u32),
    /// Each triangle begins at its second corner, or third, by chance.
    Turned(u32),
    /// Left and right exchanged.
    Mirrored,
    /// x for y, y for z, z for x.
    Cycled,
    /// Moved by a power of two along each axis, no farther than one extent. Coordinates lose their
    /// last bits there, and so it is another shape: what it is to be compared with is the [`base`],
    /// which has lost them too.
    ///
    /// [`base`]: Retold::base
    Moved,
}

/// Every way, with the same seed for all that goes by chance.
#[allow(dead_code)] // Not all that tell of one use all.
pub fn all(seed: u32) -> [Retold; 6] {
    use Retold::{Cycled, Mirrored, Moved, Renumbered, Shuffled, Turned};
    [Shuffled(seed), Renumbered(seed), Turned(seed), Mirrored, Cycled, Moved]
}

impl Retold {
    /// The same shape, as it was told before.
    pub fn base(self, mesh: &MeshBuffers) -> MeshBuffers {
        let mut base = mesh.clone();
        if self == Retold::Moved {
            translate(&mut base, way(mesh));
            translate(&mut base, -way(mesh));
        }
        base
    }

    /// The same mesh, told so.
    pub fn apply(self, mesh: &MeshBuffers) -> MeshBuffers {
        let mut mesh = mesh.clone();
        match self {
            Retold::Shuffled(seed) => shuffle_triangles(&mut mesh, seed),
            Retold::Renumbered(seed) => return renumbered(&mesh, seed),
            Retold::Turned(seed) => turn_corners(&mut mesh, seed),
            Retold::Mirrored => mirror(&mut mesh),
            Retold::Cycled => cycle_axes(&mut mesh),
            Retold::Moved => {
                let way = way(&mesh);
                translate(&mut mesh, way);
            }
        }
        mesh
    }
}

fn shuffle_triangles(mesh: &mut MeshBuffers, seed: u32) {
    let mut noise = Noise(seed);
    let mut first = 0;
    for &count in &mesh.submesh_index_counts {
        let (triangles, _) = mesh.indices[first..first + count as usize].as_chunks_mut::<3>();
        noise.shuffle(triangles);
        first += count as usize;
    }
}

fn renumbered(mesh: &MeshBuffers, seed: u32) -> MeshBuffers {
    let count = mesh.positions.len();
    let mut old: Vec<u32> = (0..count as u32).collect();
    Noise(seed).shuffle(&mut old);
    let mut new = vec![0; count];
    (0u32..).zip(&old).for_each(|(place, &vertex)| new[vertex as usize] = place);
    let mut told = MeshBuffers {
        positions: picked(&mesh.positions, &old),
        normals: picked(&mesh.normals, &old),
        tangents: picked(&mesh.tangents, &old),
        colors: picked(&mesh.colors, &old),
        indices: mesh.indices.iter().map(|&vertex| new[vertex as usize]).collect(),
        ..mesh.clone()
    };
    for uv in told.uvs.iter_mut().filter(|uv| uv.components > 0) {
        let rows: Vec<&[f32]> = uv.values.chunks(uv.components as usize).collect();
        uv.values = old.iter().flat_map(|&vertex| rows[vertex as usize]).copied().collect();
    }
    told
}

/// An absent stream stays absent.
fn picked<T: Copy>(stream: &[T], order: &[u32]) -> Vec<T> {
    let order = if stream.is_empty() { &[] } else { order };
    order.iter().map(|&vertex| stream[vertex as usize]).collect()
}

fn turn_corners(mesh: &mut MeshBuffers, seed: u32) {
    let mut noise = Noise(seed);
    for triangle in mesh.indices.as_chunks_mut::<3>().0 {
        triangle.rotate_left(noise.below(3));
    }
}

fn mirror(mesh: &mut MeshBuffers) {
    mesh.positions.iter_mut().for_each(|position| position[0] = -position[0]);
    mesh.normals.iter_mut().for_each(|normal| normal[0] = -normal[0]);
    for tangent in &mut mesh.tangents {
        (tangent[0], tangent[3]) = (-tangent[0], -tangent[3]);
    }
    mesh.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|triangle| triangle.swap(1, 2));
}

fn cycle_axes(mesh: &mut MeshBuffers) {
    mesh.positions.iter_mut().for_each(|position| position.rotate_left(1));
    mesh.normals.iter_mut().for_each(|normal| normal.rotate_left(1));
    mesh.tangents.iter_mut().for_each(|tangent| tangent[..3].rotate_left(1));
}

/// The largest power of two that is no longer than the extent.
fn way(mesh: &MeshBuffers) -> f32 {
    let extent = mesh.as_mesh().extent();
    if extent > 0.0 { extent.log2().floor().exp2() } else { 0.0 }
}

fn translate(mesh: &mut MeshBuffers, way: f32) {
    for position in &mut mesh.positions {
        *position = position.map(|along| along + way);
    }
}

/// Numbers by chance, the same for the same seed.
struct Noise(u32);

impl Noise {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as usize % count
    }

    fn shuffle<T>(&mut self, values: &mut [T]) {
        for last in (1..values.len()).rev() {
            let other = self.below(last + 1);
            values.swap(last, other);
        }
    }
}
