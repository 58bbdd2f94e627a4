//! The two wrappers of a glTF: plain JSON, and the chunks of a .glb.

use anyhow::{Context, Result, bail};

use crate::document::Format;
use crate::foreign::check_encoding;

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";
const HEADER_SIZE: usize = 12;
const CHUNK_HEADER_SIZE: usize = 8;

/// A file taken apart.
pub struct Container<'a> {
    pub format: Format,
    pub json: &'a [u8],
    /// The buffer chunk of a .glb.
    pub binary: Option<&'a [u8]>,
    /// Chunks of further kinds as they stand in the file, headers included.
    pub further_chunks: &'a [u8],
}

/// Takes a file apart; a .glb is known by its first bytes, whatever it is called.
pub fn parse(bytes: &[u8]) -> Result<Container<'_>> {
    if bytes.starts_with(MAGIC) { parse_chunks(bytes) } else { parse_plain(bytes) }
}

fn parse_plain(bytes: &[u8]) -> Result<Container<'_>> {
    check_encoding(bytes)?;
    let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if !matches!(json.trim_ascii_start().first(), Some(b'{' | b'[')) {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(SHOWN)]).into_owned();
        bail!("neither a .glb nor the JSON of a .gltf: it begins with {start:?}; export it anew");
    }
    Ok(Container { format: Format::Gltf, json, binary: None, further_chunks: &[] })
}

/// How much of what is no glTF an error shows.
const SHOWN: usize = 16;

fn parse_chunks(bytes: &[u8]) -> Result<Container<'_>> {
    let version = read_u32(bytes, 4).context("the .glb ends inside its header")?;
    let length = read_u32(bytes, 8).context("the .glb ends inside its header")?;
    if version != 2 {
        bail!("the .glb has version {version}: only version 2 can be read");
    }
    let Some(body) = bytes.get(HEADER_SIZE..length as usize) else {
        bail!(
            "the .glb should be {length} bytes long, but has {}: it is cut off, fetch or export it anew",
            bytes.len()
        );
    };
    let (kind, json, rest) = split_chunk(body)?;
    if kind != JSON_CHUNK {
        bail!("the first chunk of the .glb is not JSON");
    }
    let (binary, further_chunks) = match rest.is_empty() {
        true => (None, rest),
        false => match split_chunk(rest)? {
            (BINARY_CHUNK, binary, further) => (Some(binary), further),
            _ => (None, rest),
        },
    };
    Ok(Container { format: Format::Glb, json, binary, further_chunks })
}

fn split_chunk(bytes: &[u8]) -> Result<(&[u8], &[u8], &[u8])> {
    let length = read_u32(bytes, 0).context("a chunk of the .glb is cut off")? as usize;
    let kind = bytes.get(4..CHUNK_HEADER_SIZE).context("a chunk of the .glb is cut off")?;
    let end = CHUNK_HEADER_SIZE.saturating_add(length);
    let Some(content) = bytes.get(CHUNK_HEADER_SIZE..end) else {
        bail!("a chunk of the .glb should hold {length} bytes, but the file ends before");
    };
    Ok((kind, content, &bytes[end..]))
}

fn read_u32(bytes: &[u8], offset: usize) -> Option<u32> {
    let word = bytes.get(offset..offset + 4)?;
    Some(u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
}

/// Puts a .glb together.
///
/// # Errors
/// Where it would be longer than the 4 GiB that its header can say.
pub fn write_glb(json: &[u8], binary: &[u8], further_chunks: &[u8]) -> Result<Vec<u8>> {
    let mut chunks = Vec::new();
    push_chunk(&mut chunks, JSON_CHUNK, json, b' ')?;
    if !binary.is_empty() {
        push_chunk(&mut chunks, BINARY_CHUNK, binary, 0)?;
    }
    chunks.extend_from_slice(further_chunks);
    let mut glb = MAGIC.to_vec();
    glb.extend(2u32.to_le_bytes());
    glb.extend(chunk_length(HEADER_SIZE + chunks.len())?.to_le_bytes());
    glb.append(&mut chunks);
    Ok(glb)
}

fn push_chunk(out: &mut Vec<u8>, kind: &[u8], content: &[u8], padding: u8) -> Result<()> {
    let padded = content.len().next_multiple_of(4);
    out.extend(chunk_length(padded)?.to_le_bytes());
    out.extend(kind);
    out.extend(content);
    out.resize(out.len() + padded - content.len(), padding);
    Ok(())
}

fn chunk_length(length: usize) -> Result<u32> {
    u32::try_from(length).context("the result does not fit the 4 GiB of a .glb: split the model")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let glb = write_glb(b"{}", &[1, 2, 3], &[]).unwrap();
        let container = parse(&glb).unwrap();
        assert_eq!(container.format, Format::Glb);
        assert_eq!(container.json, b"{}  ");
        assert_eq!(container.binary, Some(&[1, 2, 3, 0][..]));
    }

    #[test]
    fn every_cut_of_a_glb_is_an_error() {
        let glb = write_glb(b"{}", &[1, 2, 3], &[]).unwrap();
        for length in 4..glb.len() {
            assert!(parse(&glb[..length]).is_err(), "{length} bytes");
        }
    }

    #[test]
    fn text_that_is_no_json_is_shown() {
        let error = parse(b"solid nothing to see here").err().unwrap().to_string();
        assert!(error.contains("begins with \"solid nothing to\""), "{error}");
        assert!(parse(b"\xEF\xBB\xBF {}").is_ok());
    }

    #[test]
    fn a_chunk_longer_than_the_file_is_an_error() {
        let mut glb = write_glb(b"{}", &[], &[]).unwrap();
        glb[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(parse(&glb).is_err());
    }

    #[test]
    fn a_chunk_of_another_kind_stays() {
        let glb = write_glb(b"{}", &[1], b"\x04\0\0\0XTRAabcd").unwrap();
        assert_eq!(parse(&glb).unwrap().further_chunks, b"\x04\0\0\0XTRAabcd");
    }
}
