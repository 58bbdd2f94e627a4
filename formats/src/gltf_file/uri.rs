//! URIs of buffers and images. A file may only name what lies in its own folder or below.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;

use crate::paths::read_beside;

/// Exporters differ in whether they pad.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// What a URI names.
#[derive(Debug, PartialEq)]
pub enum Target {
    /// The bytes that a data URI holds.
    Data(Vec<u8>),
    /// A file, relative to the model's folder and not above it.
    Inside(PathBuf),
    /// A file relative to the model's folder, but above it.
    Above,
    /// An absolute path, or a scheme such as `https`.
    Elsewhere,
}

/// Sorts a URI by what it names.
///
/// # Errors
/// Where a data URI or an escape in a path cannot be decoded.
pub fn target(uri: &str) -> Result<Target> {
    match scheme(uri) {
        Some("data") => Ok(Target::Data(data(uri)?)),
        Some(_) => Ok(Target::Elsewhere),
        None => relative(uri),
    }
}

fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let fits = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
    (!scheme.is_empty() && scheme.chars().all(fits)).then_some(scheme)
}

fn data(uri: &str) -> Result<Vec<u8>> {
    let (head, body) = uri.split_once(',').context("a data URI has no comma")?;
    let body: Vec<u8> = percent_decode_str(body).collect();
    if !head.ends_with(";base64") {
        return Ok(body);
    }
    BASE64.decode(body).context("a data URI is not valid base64")
}

fn relative(uri: &str) -> Result<Target> {
    let path = percent_decode_str(uri).decode_utf8().context("an escaped path is not UTF-8")?;
    // A backslash is a folder on some systems and part of a name on others.
    if path.starts_with(['/', '\\']) {
        return Ok(Target::Elsewhere);
    }
    let parts: Vec<&str> =
        path.split(['/', '\\']).filter(|part| !matches!(*part, "" | ".")).collect();
    if parts.contains(&"..") {
        return Ok(Target::Above);
    }
    if parts.is_empty() || path.contains(['\0', ':']) {
        bail!("the URI {uri:?} names no file");
    }
    Ok(Target::Inside(parts.iter().collect()))
}

/// The bytes that a URI names, from memory or from the model's folder.
///
/// # Errors
/// Where the URI leaves the folder, or the file is not there.
pub fn read(uri: &str, folder: &Path) -> Result<Vec<u8>> {
    match target(uri)? {
        Target::Data(bytes) => Ok(bytes),
        Target::Inside(path) => {
            read_beside(folder, &path).with_context(|| folder.join(path).display().to_string())
        }
        Target::Above | Target::Elsewhere => bail!(
            "the URI {uri:?} leaves the model's folder: put the file beside the model and name it relatively"
        ),
    }
}

/// A data URI of a buffer.
pub fn write_data(bytes: &[u8]) -> String {
    format!("data:application/octet-stream;base64,{}", BASE64.encode(bytes))
}

/// A file name as a URI.
pub fn write_name(name: &str) -> String {
    use percent_encoding::{AsciiSet, CONTROLS, utf8_percent_encode};
    const RESERVED: &AsciiSet = &CONTROLS
        .add(b' ')
        .add(b'"')
        .add(b'#')
        .add(b'%')
        .add(b':')
        .add(b'<')
        .add(b'>')
        .add(b'?')
        .add(b'[')
        .add(b'\\')
        .add(b']')
        .add(b'^')
        .add(b'`')
        .add(b'{')
        .add(b'|')
        .add(b'}');
    utf8_percent_encode(name, RESERVED).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_is_decoded_with_and_without_padding() {
        for uri in ["data:application/octet-stream;base64,AQI=", "data:;base64,AQI", "data:,%01%02"]
        {
            assert_eq!(target(uri).unwrap(), Target::Data(vec![1, 2]), "{uri}");
        }
    }

    #[test]
    fn paths_stay_in_the_folder() {
        for uri in ["../a.bin", "a/../../b.bin", "%2e%2e/a.bin", "..\\a.bin"] {
            assert_eq!(target(uri).unwrap(), Target::Above, "{uri}");
        }
        for uri in ["/etc/passwd", "\\\\host\\a", "file:///a", "https://a.b/c", "C:/a.bin"] {
            assert_eq!(target(uri).unwrap(), Target::Elsewhere, "{uri}");
        }
        assert_eq!(target("./a%20b.bin").unwrap(), Target::Inside("a b.bin".into()));
        assert!(target("").is_err());
    }

    #[test]
    fn a_name_survives_the_way_out_and_in() {
        let name = "50 % [röd]#1.bin";
        assert_eq!(target(&write_name(name)).unwrap(), Target::Inside(name.into()));
    }
}
