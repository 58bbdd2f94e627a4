//! Changes to a JSON document: any value becomes any other, or goes.

use arbitrary::Arbitrary;
use serde_json::{Value, json};

/// One change.
#[derive(Arbitrary, Debug)]
pub struct Edit {
    /// Which value, counted depth first.
    place: u16,
    change: Change,
}

#[derive(Arbitrary, Debug)]
enum Change {
    Small(i8),
    Number(f32),
    Large(u64),
    Text(Text),
    Nothing,
    EmptyList,
    EmptyObject,
    /// As another value of the document.
    Like(u16),
    /// A list of one item more.
    Longer,
    Shorter,
    Member(Text, i8),
}

/// Words that glTF readers know, and some that they should not trust.
const WORDS: [&str; 28] = [
    "POSITION",
    "NORMAL",
    "TANGENT",
    "TEXCOORD_0",
    "TEXCOORD_1",
    "COLOR_0",
    "JOINTS_0",
    "WEIGHTS_0",
    "SCALAR",
    "VEC2",
    "VEC3",
    "VEC4",
    "MAT4",
    "uri",
    "sparse",
    "normalized",
    "byteStride",
    "byteOffset",
    "bufferView",
    "targets",
    "mode",
    "extensions",
    "matrix",
    "data:,%00%01",
    "../secret",
    "file:///etc/passwd",
    "a.png",
    "KHR_draco_mesh_compression",
];

#[derive(Arbitrary, Debug)]
struct Text(u8);

impl Text {
    fn word(&self) -> &'static str {
        WORDS[usize::from(self.0) % WORDS.len()]
    }
}

impl Edit {
    /// Changes the document.
    pub fn apply(&self, document: &mut Value) {
        let count = count(document);
        let other = match self.change {
            Change::Like(place) => nth(document, &mut (usize::from(place) % count)).cloned(),
            _ => None,
        };
        if let Some(value) = nth(document, &mut (usize::from(self.place) % count)) {
            self.change.apply(value, other);
        }
    }
}

impl Change {
    fn apply(&self, value: &mut Value, other: Option<Value>) {
        match self {
            Change::Small(number) => *value = json!(number),
            Change::Number(number) => *value = json!(number),
            Change::Large(number) => *value = json!(number),
            Change::Text(text) => *value = json!(text.word()),
            Change::Nothing => *value = Value::Null,
            Change::EmptyList => *value = json!([]),
            Change::EmptyObject => *value = json!({}),
            Change::Like(_) => *value = other.unwrap_or_default(),
            Change::Longer => {
                if let Some(list) = value.as_array_mut() {
                    list.extend(list.last().cloned());
                }
            }
            Change::Shorter => {
                if let Some(list) = value.as_array_mut() {
                    list.pop();
                } else if let Some(object) = value.as_object_mut() {
                    let last = object.keys().next_back().cloned();
                    last.and_then(|key| object.remove(&key));
                }
            }
            Change::Member(key, number) => {
                if let Some(object) = value.as_object_mut() {
                    object.insert(key.word().to_owned(), json!(number));
                }
            }
        }
    }
}

fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(items) => items.iter().map(count).sum(),
        Value::Object(members) => members.values().map(count).sum(),
        _ => 0,
    }
}

/// The value at a place, counted depth first; `place` counts down.
fn nth<'a>(value: &'a mut Value, place: &mut usize) -> Option<&'a mut Value> {
    if *place == 0 {
        return Some(value);
    }
    *place -= 1;
    match value {
        Value::Array(items) => items.iter_mut().find_map(|item| nth(item, place)),
        Value::Object(members) => members.values_mut().find_map(|item| nth(item, place)),
        _ => None,
    }
}
