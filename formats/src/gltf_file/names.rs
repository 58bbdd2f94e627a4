//! Names of attributes: which of them the core carries.

use chamfer::UV_CHANNELS;

/// Whether the core carries the attribute itself.
pub fn is_carried_by_core(name: &str) -> bool {
    matches!(name, "POSITION" | "NORMAL" | "TANGENT" | "COLOR_0") || uv_channel(name).is_some()
}

/// The UV channel of the core that an attribute is.
pub fn uv_channel(name: &str) -> Option<usize> {
    (0..UV_CHANNELS).find(|channel| name == format!("TEXCOORD_{channel}"))
}
