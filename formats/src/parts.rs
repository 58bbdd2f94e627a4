//! The bytes of a glTF in the making, and the views and accessors on them.

use serde_json::{Value, json};

const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// The parts of a glTF that refer to each other by number.
#[derive(Default)]
pub struct Parts {
    pub binary: Vec<u8>,
    pub views: Vec<Value>,
    pub accessors: Vec<Value>,
}

impl Parts {
    /// An accessor of vertex positions, or of displacements of them.
    pub fn positions(&mut self, positions: &[[f32; 3]]) -> usize {
        let accessor = self.floats("VEC3", positions.as_flattened());
        let (low, high) = bounds(positions);
        self.accessors[accessor]["min"] = json!(low);
        self.accessors[accessor]["max"] = json!(high);
        accessor
    }

    /// An accessor of a vertex attribute of that shape.
    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let view =
            self.view(values.iter().flat_map(|value| value.to_le_bytes()), Some(ARRAY_BUFFER));
        self.accessor(view, FLOAT, kind, values.len() / components(kind))
    }

    /// An accessor of the numbers of joints.
    pub fn joints(&mut self, values: &[[u16; 4]]) -> usize {
        let bytes = values.as_flattened().iter().flat_map(|value| value.to_le_bytes());
        let view = self.view(bytes, Some(ARRAY_BUFFER));
        self.accessor(view, UNSIGNED_SHORT, "VEC4", values.len())
    }

    /// An accessor of matrices, column by column.
    pub fn matrices(&mut self, values: &[[f32; 16]]) -> usize {
        let bytes = values.as_flattened().iter().flat_map(|value| value.to_le_bytes());
        let view = self.view(bytes, None);
        self.accessor(view, FLOAT, "MAT4", values.len())
    }

    /// An accessor of triangles.
    pub fn indices(&mut self, indices: &[u32]) -> usize {
        let bytes = indices.iter().flat_map(|index| index.to_le_bytes());
        let view = self.view(bytes, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(view, UNSIGNED_INT, "SCALAR", indices.len())
    }

    /// A view on new bytes.
    pub fn view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let offset = self.binary.len();
        self.binary.extend(bytes);
        let mut view = json!({
            "buffer": 0,
            "byteOffset": offset,
            "byteLength": self.binary.len() - offset,
        });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, view: usize, component: u32, kind: &str, count: usize) -> usize {
        self.accessors.push(json!({
            "bufferView": view,
            "componentType": component,
            "type": kind,
            "count": count,
        }));
        self.accessors.len() - 1
    }
}

fn components(kind: &str) -> usize {
    match kind {
        "VEC2" => 2,
        "VEC3" => 3,
        _ => 4,
    }
}

/// The lowest and highest coordinate on each axis.
fn bounds(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    for position in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
    }
    (low, high)
}
