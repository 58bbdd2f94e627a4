//! glTF files in and out, as a program that reads the files sees them.

mod compressed;
mod corpus;
mod damage;
#[path = "../support/draco.rs"]
mod draco;
mod features;
mod files;
mod followers;
mod labels;
mod lenient;
mod many;
mod morphs;
mod quantized;
mod support;
