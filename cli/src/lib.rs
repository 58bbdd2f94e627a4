//! The model files that the command line reads and writes, and pictures of them.

pub mod document;
pub mod gltf_file;
pub mod preview;
