//! glTF files in and out, as a program that reads the files sees them.

mod compressed;
mod corpus;
mod damage;
mod features;
mod files;
mod followers;
mod lenient;
mod morphs;
mod quantized;
mod support;
