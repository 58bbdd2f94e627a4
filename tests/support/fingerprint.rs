//! A hash of all bytes of a result: the same on every platform, or the result is not.

use chamfer::{Blend, Chamfered};

/// FNV-1a over everything that a call returns.
pub fn fingerprint(result: &Chamfered) -> u64 {
    let mut hash = Fnv(0xcbf2_9ce4_8422_2325);
    let mesh = &result.mesh;
    hash.floats(mesh.positions.as_flattened());
    hash.floats(mesh.normals.as_flattened());
    hash.floats(mesh.tangents.as_flattened());
    hash.floats(mesh.colors.as_flattened());
    mesh.uvs.iter().for_each(|uv| hash.floats(&uv.values));
    hash.words(mesh.indices.iter().copied());
    hash.words(mesh.submesh_index_counts.iter().copied());
    for source in result.vertex_sources.iter() {
        let blends = [&source.surface, &source.chart, &source.owner];
        blends.into_iter().for_each(|blend| hash.blend(blend));
        hash.words([source.owner_channels]);
    }
    hash.words(result.triangle_sources.iter().flat_map(|s| [s.kind as u32, s.index]));
    for verdict in &result.verdicts {
        hash.words(verdict.vertices);
        hash.words([verdict.outcome as u32, verdict.reason as u32]);
        hash.floats(&verdict.widths);
    }
    hash.0
}

struct Fnv(u64);

impl Fnv {
    fn words(&mut self, words: impl IntoIterator<Item = u32>) {
        for byte in words.into_iter().flat_map(u32::to_le_bytes) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn floats(&mut self, values: &[f32]) {
        self.words([values.len() as u32]);
        self.words(values.iter().map(|value| value.to_bits()));
    }

    fn blend(&mut self, blend: &Blend) {
        self.words(blend.vertices);
        self.words(blend.weights.map(f32::to_bits));
    }
}
