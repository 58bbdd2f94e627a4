//! What the `chamfer` command line is made of: model files in and out, and pictures of them.

pub mod document;
pub mod preview;
