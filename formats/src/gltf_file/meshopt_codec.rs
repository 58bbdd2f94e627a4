//! Unpacks buffer views that meshoptimizer compressed. The codec is that of the library itself, whose
//! decoders are made for input that nobody vouches for; what they do not check is checked here.

use anyhow::{Context, Result, bail, ensure};
use serde_json::Value;

use super::json;

/// A compressed byte can stand for at most so many: a group of sixteen zeros takes two bits, for up
/// to four bytes of an element at a time.
const MOST_PER_BYTE: usize = 2048;

/// What the bytes of a view unpack to, as the extension on it says.
///
/// # Errors
/// Where they are none that the codec could have made, or the extension says what it may not.
pub fn decode(extension: &Value, bytes: &[u8], path: &str) -> Result<Vec<u8>> {
    let stride = json::required(extension, "byteStride", path)?;
    let count = json::required(extension, "count", path)?;
    let most = bytes.len().saturating_mul(MOST_PER_BYTE);
    ensure!(
        count.checked_mul(stride).is_some_and(|length| length <= most),
        "{path} should unpack to {count} elements of {stride} bytes, more than its {} bytes can \
         hold",
        bytes.len()
    );
    let word = |key: &str, usual| extension.get(key).map_or(Some(usual), Value::as_str);
    let unpacked = match word("mode", "absent") {
        Some("ATTRIBUTES") => elements(bytes, count, stride),
        Some("TRIANGLES") if count.is_multiple_of(3) => match stride {
            2 => meshopt::decode_index_buffer::<u16>(bytes, count).ok().map(shorts),
            4 => meshopt::decode_index_buffer::<u32>(bytes, count).ok().map(words),
            _ => None,
        },
        Some("INDICES") => match stride {
            2 => meshopt::decode_index_sequence::<u16>(bytes, count).ok().map(shorts),
            4 => meshopt::decode_index_sequence::<u32>(bytes, count).ok().map(words),
            _ => None,
        },
        mode => bail!("{path}.mode is {mode:?}, which is not known for {count} elements"),
    };
    let unpacked = unpacked.with_context(|| {
        format!("{path} cannot be unpacked to {count} elements of {stride} bytes: export it anew")
    })?;
    match word("filter", "NONE") {
        Some("NONE") => Ok(unpacked),
        filter => unfiltered(unpacked, stride, filter.unwrap_or_default())
            .with_context(|| format!("{path}.filter is {filter:?} on {stride} bytes: not known")),
    }
}

/// An element of so many bytes.
#[derive(Clone, Copy)]
struct Element<const N: usize>([u8; N]);

impl<const N: usize> Default for Element<N> {
    fn default() -> Self {
        Element([0; N])
    }
}

/// The codec knows the size of an element from its type.
macro_rules! by_stride {
    ($bytes:ident, $count:ident, $stride:ident: $($size:literal)*) => {
        match $stride {
            $($size => {
                let elements = meshopt::decode_vertex_buffer::<Element<$size>>($bytes, $count);
                Some(elements.ok()?.iter().flat_map(|element| element.0).collect())
            })*
            _ => None,
        }
    };
}

fn elements(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    by_stride!(bytes, count, stride:
        4 8 12 16 20 24 28 32 36 40 44 48 52 56 60 64 68 72 76 80 84 88 92 96 100 104 108 112 116
        120 124 128 132 136 140 144 148 152 156 160 164 168 172 176 180 184 188 192 196 200 204 208
        212 216 220 224 228 232 236 240 244 248 252 256)
}

fn shorts(numbers: Vec<u16>) -> Vec<u8> {
    numbers.into_iter().flat_map(u16::to_le_bytes).collect()
}

fn words(numbers: Vec<u32>) -> Vec<u8> {
    numbers.into_iter().flat_map(u32::to_le_bytes).collect()
}

/// Undoes what made the elements easier to compress; `None` for a filter that is not known, or
/// elements that it cannot have.
fn unfiltered(bytes: Vec<u8>, stride: usize, filter: &str) -> Option<Vec<u8>> {
    Some(match (filter, stride) {
        ("OCTAHEDRAL", 4) => quads(bytes, i8::from_le_bytes, meshopt::decode_filter_oct),
        ("OCTAHEDRAL", 8) => quads(bytes, i16::from_le_bytes, meshopt::decode_filter_oct),
        ("QUATERNION", 8) => quads(bytes, i16::from_le_bytes, meshopt::decode_filter_quat),
        ("COLOR", 4) => quads(bytes, u8::from_le_bytes, meshopt::decode_filter_color),
        ("COLOR", 8) => quads(bytes, u16::from_le_bytes, meshopt::decode_filter_color),
        ("EXPONENTIAL", _) if stride.is_multiple_of(4) => exponential(bytes),
        _ => return None,
    })
}

/// A number of a filter's elements.
trait Number: Copy + Default {
    fn push(self, bytes: &mut Vec<u8>);
}

macro_rules! numbers {
    ($($number:ty)*) => {
        $(impl Number for $number {
            fn push(self, bytes: &mut Vec<u8>) {
                bytes.extend(self.to_le_bytes());
            }
        })*
    };
}
numbers!(i8 u8 i16 u16);

/// Elements of four numbers each, through a filter.
fn quads<T: Number, const SIZE: usize>(
    bytes: Vec<u8>,
    number: fn([u8; SIZE]) -> T,
    filter: fn(&mut [[T; 4]]),
) -> Vec<u8> {
    let numbers: Vec<T> = bytes.as_chunks::<SIZE>().0.iter().map(|bytes| number(*bytes)).collect();
    let mut elements = numbers.as_chunks::<4>().0.to_vec();
    filter(&mut elements);
    let mut filtered = Vec::with_capacity(bytes.len());
    elements.as_flattened().iter().for_each(|number| number.push(&mut filtered));
    filtered
}

fn exponential(bytes: Vec<u8>) -> Vec<u8> {
    let mut numbers: Vec<[u32; 1]> =
        bytes.as_chunks::<4>().0.iter().map(|word| [u32::from_le_bytes(*word)]).collect();
    meshopt::decode_filter_exp(&mut numbers);
    words(numbers.concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn unpack(mode: &str, stride: usize, count: usize, bytes: &[u8]) -> Result<Vec<u8>> {
        decode(&json!({"mode": mode, "byteStride": stride, "count": count}), bytes, "view")
    }

    #[test]
    fn elements_of_every_size_are_read() {
        let numbers: Vec<[f32; 3]> = (0..50).map(|n| [n as f32, 0.5, -1.0]).collect();
        let packed = meshopt::encode_vertex_buffer(&numbers).unwrap();
        let bytes = unpack("ATTRIBUTES", 12, 50, &packed).unwrap();
        let expected: Vec<u8> =
            numbers.as_flattened().iter().flat_map(|n| n.to_le_bytes()).collect();
        assert_eq!(bytes, expected);
        let wide = vec![Element([7u8; 256]); 3];
        let packed = meshopt::encode_vertex_buffer(&wide).unwrap();
        assert_eq!(unpack("ATTRIBUTES", 256, 3, &packed).unwrap(), [7; 768]);
    }

    #[test]
    fn indices_are_read_in_both_modes_and_sizes() {
        let indices = [0, 1, 2, 2, 1, 3];
        let packed = meshopt::encode_index_buffer(&indices, 4).unwrap();
        assert_eq!(unpack("TRIANGLES", 2, 6, &packed).unwrap(), shorts(vec![0, 1, 2, 2, 1, 3]));
        let packed = meshopt::encode_index_sequence(&indices, 4).unwrap();
        assert_eq!(unpack("INDICES", 4, 6, &packed).unwrap(), words(indices.to_vec()));
    }

    #[test]
    fn filters_are_undone() {
        let up = meshopt::encode_filter_oct::<i8>(&[[0.0, 0.0, 1.0, 0.0]], 8);
        let mut bytes = Vec::new();
        up.as_flattened().iter().for_each(|number| number.push(&mut bytes));
        assert_eq!(unfiltered(bytes, 4, "OCTAHEDRAL").unwrap(), [0, 0, 127, 0]);
        // Three times two to the power of minus one.
        let packed = ((-1i32 << 24) | 3).to_le_bytes().to_vec();
        assert_eq!(unfiltered(packed, 4, "EXPONENTIAL").unwrap(), 1.5f32.to_le_bytes());
        assert_eq!(unfiltered(vec![0; 12], 12, "QUATERNION"), None);
        assert_eq!(unfiltered(vec![0; 8], 8, "ACME"), None);
    }

    /// Each filter, within a step of what went in: directions, turns, places and colours.
    #[test]
    fn what_went_through_a_filter_comes_back() {
        fn filtered<T: Number + Copy>(encoded: &[[T; 4]], filter: &str) -> Vec<u8> {
            let mut bytes = Vec::new();
            encoded.as_flattened().iter().for_each(|&number| number.push(&mut bytes));
            unfiltered(bytes, 4 * size_of::<T>(), filter).unwrap()
        }
        fn shares<const N: usize>(bytes: &[u8], share: fn([u8; N]) -> f32) -> Vec<f32> {
            bytes.chunks_exact(N).map(|part| share(part.try_into().unwrap())).collect()
        }
        let is_near = |found: &[f32], values: &[f32], step: f32| {
            let is_near = |(a, b): (&f32, &f32)| (a - b).abs() <= step;
            found.len() == values.len() && found.iter().zip(values).all(is_near)
        };
        let byte = |[byte]: [u8; 1]| f32::from(byte as i8) / 127.0;
        let short = |bytes| f32::from(i16::from_le_bytes(bytes)) / 32767.0;
        let directions = [[0.36, -0.48, 0.8, 0.0], [-0.6, 0.0, -0.8, 0.0]];
        let found = filtered(&meshopt::encode_filter_oct::<i8>(&directions, 8), "OCTAHEDRAL");
        assert!(is_near(&shares(&found, byte), directions.as_flattened(), 0.02));
        let found = filtered(&meshopt::encode_filter_oct::<i16>(&directions, 16), "OCTAHEDRAL");
        assert!(is_near(&shares(&found, short), directions.as_flattened(), 1e-4));
        let turns = [[0.5, -0.5, 0.5, 0.5], [0.0, 0.6, 0.0, 0.8]];
        let found = filtered(&meshopt::encode_filter_quat(&turns, 16), "QUATERNION");
        assert!(is_near(&shares(&found, short), turns.as_flattened(), 1e-3));
        let places = [[1.5, -1000.0, 0.001], [0.0, 3.25, -7.0]];
        let mode = meshopt::EncodeExpMode::Separate;
        let encoded = meshopt::encode_filter_exp(&places, 15, mode);
        let found = unfiltered(words(encoded.as_flattened().to_vec()), 12, "EXPONENTIAL").unwrap();
        assert!(is_near(&shares(&found, f32::from_le_bytes), places.as_flattened(), 0.1));
        let colors = [[1.0, 0.5, 0.25, 1.0], [0.0, 0.0, 1.0, 0.5]];
        let found = filtered(&meshopt::encode_filter_color::<u8>(&colors, 8), "COLOR");
        let found = shares(&found, |[byte]: [u8; 1]| f32::from(byte) / 255.0);
        assert!(is_near(&found, colors.as_flattened(), 0.02));
    }

    #[test]
    fn nonsense_is_refused_before_memory_is_asked_for() {
        let error = |mode, stride, count| {
            format!("{:#}", unpack(mode, stride, count, &[0xA0; 40]).unwrap_err())
        };
        assert!(error("ATTRIBUTES", 12, 24).contains("view cannot be unpacked to 24 elements"));
        assert!(error("ATTRIBUTES", 12, usize::MAX).contains("than its 40 bytes can hold"));
        assert!(error("ATTRIBUTES", 5, 4).contains("cannot be unpacked"));
        assert!(error("TRIANGLES", 2, 4).contains("view.mode"));
        assert!(error("TRIANGLES", 3, 3).contains("cannot be unpacked"));
        assert!(error("WHATEVER", 4, 3).contains("view.mode"));
    }
}
