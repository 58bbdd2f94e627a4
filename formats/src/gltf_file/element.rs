//! The types of an accessor's elements, and streams of such elements as numbers.

use anyhow::{Result, bail};
use serde_json::Value;

use super::json;

/// The type of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// The component of a glTF code, such as 5126.
    pub fn of_code(code: usize) -> Option<Component> {
        Some(match code {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    /// The glTF code.
    pub fn code(self) -> u32 {
        match self {
            Component::I8 => 5120,
            Component::U8 => 5121,
            Component::I16 => 5122,
            Component::U16 => 5123,
            Component::U32 => 5125,
            Component::F32 => 5126,
        }
    }

    /// Bytes.
    pub fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// The number that stands for 1 where integers are normalized.
    pub fn one(self) -> f64 {
        match self {
            Component::I8 => f64::from(i8::MAX),
            Component::U8 => f64::from(u8::MAX),
            Component::I16 => f64::from(i16::MAX),
            Component::U16 => f64::from(u16::MAX),
            Component::U32 => f64::from(u32::MAX),
            Component::F32 => 1.0,
        }
    }

    /// Whether it is one of the integers.
    pub fn is_integer(self) -> bool {
        self != Component::F32
    }

    fn read(self, bytes: &[u8]) -> f64 {
        match self {
            Component::I8 => f64::from(bytes[0] as i8),
            Component::U8 => f64::from(bytes[0]),
            Component::I16 => f64::from(i16::from_le_bytes([bytes[0], bytes[1]])),
            Component::U16 => f64::from(u16::from_le_bytes([bytes[0], bytes[1]])),
            Component::U32 => f64::from(u32::from_le_bytes(word(bytes))),
            Component::F32 => f64::from(f32::from_le_bytes(word(bytes))),
        }
    }

    fn write(self, number: f64, bytes: &mut [u8]) {
        match self {
            Component::I8 => bytes[0] = (number.round() as i8) as u8,
            Component::U8 => bytes[0] = number.round() as u8,
            Component::I16 => bytes.copy_from_slice(&(number.round() as i16).to_le_bytes()),
            Component::U16 => bytes.copy_from_slice(&(number.round() as u16).to_le_bytes()),
            Component::U32 => bytes.copy_from_slice(&(number.round() as u32).to_le_bytes()),
            Component::F32 => bytes.copy_from_slice(&(number as f32).to_le_bytes()),
        }
    }
}

fn word(bytes: &[u8]) -> [u8; 4] {
    [bytes[0], bytes[1], bytes[2], bytes[3]]
}

/// How many numbers an element has: columns of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    name: &'static str,
    columns: usize,
    rows: usize,
}

impl Shape {
    pub const SCALAR: Shape = Shape { name: "SCALAR", columns: 1, rows: 1 };
    pub const VEC2: Shape = Shape { name: "VEC2", columns: 1, rows: 2 };
    pub const VEC3: Shape = Shape { name: "VEC3", columns: 1, rows: 3 };
    pub const VEC4: Shape = Shape { name: "VEC4", columns: 1, rows: 4 };
    const MAT2: Shape = Shape { name: "MAT2", columns: 2, rows: 2 };
    const MAT3: Shape = Shape { name: "MAT3", columns: 3, rows: 3 };
    pub const MAT4: Shape = Shape { name: "MAT4", columns: 4, rows: 4 };
    const ALL: [Shape; 7] = [
        Shape::SCALAR,
        Shape::VEC2,
        Shape::VEC3,
        Shape::VEC4,
        Shape::MAT2,
        Shape::MAT3,
        Shape::MAT4,
    ];

    /// Numbers per element.
    pub fn components(self) -> usize {
        self.columns * self.rows
    }

    /// As glTF writes it.
    pub fn name(self) -> &'static str {
        self.name
    }
}

/// The type of an accessor's elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ElementType {
    pub component: Component,
    pub shape: Shape,
    /// Whether integers stand for shares of 1.
    pub normalized: bool,
}

impl ElementType {
    /// Plain floats.
    pub fn floats(shape: Shape) -> ElementType {
        ElementType { component: Component::F32, shape, normalized: false }
    }

    /// The type that an accessor states.
    pub fn of_accessor(accessor: &Value, path: &str) -> Result<ElementType> {
        let code = json::required(accessor, "componentType", path)?;
        let Some(component) = Component::of_code(code) else {
            bail!("{path}.componentType is {code}, which glTF does not have");
        };
        let name = accessor.get("type").and_then(Value::as_str).unwrap_or("absent");
        let Some(shape) = Shape::ALL.into_iter().find(|shape| shape.name == name) else {
            bail!("{path}.type is {name}, which glTF does not have");
        };
        let normalized = accessor.get("normalized").and_then(Value::as_bool).unwrap_or(false);
        Ok(ElementType { component, shape, normalized: normalized && component.is_integer() })
    }

    /// Bytes of an element, with the padding inside of it.
    pub fn size(self) -> usize {
        self.column_stride() * (self.shape.columns - 1) + self.shape.rows * self.component.size()
    }

    /// Columns of a matrix start at multiples of four bytes.
    fn column_stride(self) -> usize {
        let column = self.shape.rows * self.component.size();
        if self.shape.columns > 1 { column.next_multiple_of(4) } else { column }
    }

    fn places(self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let size = self.component.size();
        (0..self.shape.components()).map(move |index| {
            let (column, row) = (index / self.shape.rows, index % self.shape.rows);
            let start = column * self.column_stride() + row * size;
            start..start + size
        })
    }

    /// Appends the numbers of the element at the start of `bytes`.
    pub fn decode(self, bytes: &[u8], numbers: &mut Vec<f64>) {
        let one = if self.normalized { self.component.one() } else { 1.0 };
        let least = if self.normalized { -1.0 } else { f64::NEG_INFINITY };
        for place in self.places() {
            let number = self.component.read(&bytes[place]) / one;
            // `max` would hide a NaN.
            numbers.push(if number < least { least } else { number });
        }
    }

    /// Appends an element; integers are rounded and clamped to what the type can hold.
    pub fn encode(self, numbers: &[f64], bytes: &mut Vec<u8>) {
        let one = if self.normalized { self.component.one() } else { 1.0 };
        let start = bytes.len();
        bytes.resize(start + self.size(), 0);
        for (place, number) in self.places().zip(numbers) {
            let number = if self.normalized { number.clamp(-1.0, 1.0) } else { *number };
            self.component.write(number * one, &mut bytes[start..][place]);
        }
    }
}

/// What an accessor holds, as numbers (normalized integers as shares of 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    pub element: ElementType,
    /// `#elements by components`, flattened.
    pub values: Vec<f64>,
}

impl Stream {
    /// Number of elements.
    pub fn count(&self) -> usize {
        self.values.len() / self.element.shape.components()
    }

    /// The numbers of one element.
    pub fn at(&self, index: usize) -> &[f64] {
        let components = self.element.shape.components();
        &self.values[index * components..][..components]
    }

    /// The elements one by one.
    pub fn elements(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(self.element.shape.components())
    }

    /// Whether the element type holds every value without rounding.
    pub fn is_exact(&self) -> bool {
        let mut bytes = Vec::new();
        let mut numbers = Vec::new();
        self.elements().all(|element| {
            bytes.clear();
            numbers.clear();
            self.element.encode(element, &mut bytes);
            self.element.decode(&bytes, &mut numbers);
            // Compared as floats: the core works in them.
            numbers.iter().zip(element).all(|(a, b)| *a as f32 == *b as f32)
        })
    }

    /// The stream in the same type where that is exact, else in floats.
    pub fn exact_or_floats(self) -> Stream {
        let element =
            if self.is_exact() { self.element } else { ElementType::floats(self.element.shape) };
        Stream { element, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round_trip(element: ElementType, numbers: &[f64]) -> Vec<f64> {
        let (mut bytes, mut back) = (Vec::new(), Vec::new());
        element.encode(numbers, &mut bytes);
        assert_eq!(bytes.len(), element.size());
        element.decode(&bytes, &mut back);
        back
    }

    fn normalized(component: Component) -> ElementType {
        ElementType { component, shape: Shape::SCALAR, normalized: true }
    }

    #[test]
    fn normalized_bytes_are_shares_of_one() {
        let mut numbers = Vec::new();
        normalized(Component::U8).decode(&[255], &mut numbers);
        normalized(Component::I8).decode(&[0x80], &mut numbers);
        assert_eq!(numbers, [1.0, -1.0]);
    }

    #[test]
    fn every_normalized_byte_survives_as_a_float() {
        for byte in 0..=255u8 {
            let (mut numbers, mut bytes) = (Vec::new(), Vec::new());
            normalized(Component::U8).decode(&[byte], &mut numbers);
            normalized(Component::U8).encode(&[f64::from(numbers[0] as f32)], &mut bytes);
            assert_eq!(bytes, [byte]);
        }
    }

    #[test]
    fn integers_are_clamped_to_their_range() {
        assert_eq!(round_trip(normalized(Component::U16), &[1.5]), [1.0]);
        let plain = ElementType { normalized: false, ..normalized(Component::U8) };
        assert_eq!(round_trip(plain, &[300.4]), [255.0]);
    }

    #[test]
    fn matrix_columns_are_padded_to_four_bytes() {
        let element =
            ElementType { component: Component::U8, shape: Shape::MAT3, normalized: false };
        assert_eq!(element.size(), 11);
        let numbers: Vec<f64> = (1..=9).map(f64::from).collect();
        assert_eq!(round_trip(element, &numbers), numbers);
    }

    #[test]
    fn a_stream_that_does_not_fit_its_type_turns_into_floats() {
        let element = ElementType { normalized: false, ..normalized(Component::I16) };
        let whole = Stream { element, values: vec![3.0, -4.0] };
        assert_eq!(whole.clone().exact_or_floats(), whole);
        let halves = Stream { element, values: vec![0.5] };
        assert_eq!(halves.exact_or_floats().element.component, Component::F32);
    }
}
