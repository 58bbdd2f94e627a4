//! Pictures that glTF can have inside of it.

/// A picture in a format that glTF has.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// As its file is called.
    pub name: String,
    /// The type of its content, such as `image/png`.
    pub kind: &'static str,
    /// Its file.
    pub bytes: Vec<u8>,
}

impl Picture {
    /// A picture from the bytes of its file; none of a format that glTF does not have.
    pub fn new(name: String, bytes: Vec<u8>) -> Option<Picture> {
        let kind = picture_kind(&bytes)?;
        Some(Picture { name, kind, bytes })
    }
}

/// What the bytes of a file are, if they are a picture that every reader of glTF knows.
pub fn picture_kind(bytes: &[u8]) -> Option<&'static str> {
    let kinds: [(&[u8], &str); 2] =
        [(b"\x89PNG\r\n\x1A\n", "image/png"), (b"\xFF\xD8\xFF", "image/jpeg")];
    kinds.into_iter().find(|(start, _)| bytes.starts_with(start)).map(|(_, kind)| kind)
}
