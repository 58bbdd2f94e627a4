//! The model files that the command line reads and writes.

pub mod document;
pub mod gltf_file;
