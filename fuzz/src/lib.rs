//! What the fuzz targets share: meshes and files made from arbitrary bytes, and what must hold for
//! whatever becomes of them.

pub mod c_interface;
pub mod compressed;
#[path = "../../formats/tests/support/cube_fbx.rs"]
pub mod cube_fbx;
pub mod documents;
pub mod edits;
pub mod gltf;
pub mod meshes;
pub mod noise;
pub mod oracle;
#[path = "../../tests/support/retold.rs"]
pub mod retold;
pub mod shapes;
