//! A model file as all readers hand it over: meshes to chamfer, and all the rest to keep.

use std::path::{Path, PathBuf};

use anyhow::Result;
use chamfer::{Chamfered, MeshBuffers};

/// The formats of model files. What there is to know of each stands in
/// [`FORMATS`](crate::FORMATS).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF in one binary file.
    Glb,
    /// glTF as JSON, with its buffers beside it or inside.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography triangles, ASCII or binary.
    Stl,
    /// Autodesk's FBX, binary or ASCII.
    Fbx,
    /// Stanford's polygons, ASCII or binary.
    Ply,
    /// Geomview's object file format, in text.
    Off,
}

/// One mesh of a file, in the layout of the core.
#[derive(Clone)]
pub struct SourceMesh {
    /// As the file calls it, or its kind and number.
    pub name: String,
    /// Its streams; submeshes are the file's primitives, groups or materials.
    pub mesh: MeshBuffers,
}

/// The transform of a mesh that stands where its file has it; column-major.
pub const IDENTITY: [[f32; 4]; 4] =
    [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// One placed mesh of a file's scene; its mesh is one of [`Document::meshes`].
pub use chamfer::Placed as Instance;

/// A file to be written: nothing is on disk before every file of a document is encoded.
pub struct OutputFile {
    /// Where it goes.
    pub path: PathBuf,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// A document that was encoded.
#[derive(Default)]
pub struct Encoded {
    /// The file of the path asked for, then those that belong to it.
    pub files: Vec<OutputFile>,
    /// What is otherwise than one may expect, or was lost: a sentence each.
    pub notes: Vec<String>,
}

impl From<Vec<OutputFile>> for Encoded {
    fn from(files: Vec<OutputFile>) -> Encoded {
        Encoded { files, notes: Vec::new() }
    }
}

/// How to read a file. Further options may come: start from the default.
#[derive(Clone, Copy, Debug)]
pub struct ReadOptions {
    /// For models without normals: faces that meet at up to this angle, in degrees, shade as one.
    /// 30 by default.
    pub smoothing_angle: f32,
    /// Which vertices become one; by default those at the very same place.
    pub weld: Weld,
    /// Which normals count; by default those of the file.
    pub normals: Normals,
}

impl Default for ReadOptions {
    fn default() -> Self {
        ReadOptions { smoothing_angle: 30.0, weld: Weld::Equal, normals: Normals::Keep }
    }
}

/// Which vertices of a mesh become one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Weld {
    /// Those whose positions are equal to the bit.
    #[default]
    Equal,
    /// Those at most so far from each other, in mesh units.
    Within(f32),
    /// Those that only rounding may have set apart.
    Auto,
}

/// Which normals of a file count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Normals {
    /// Those that it has; the others are made by the smoothing angle.
    #[default]
    Keep,
    /// None: all are made by the smoothing angle.
    Angle,
}

/// What reading did to the normals of a mesh.
#[derive(Clone, Debug, Default)]
pub struct NormalsRead {
    /// Whether some are not in the file, but made by the smoothing angle.
    pub computed: bool,
    /// Those in the file that are plainly not unit length, by vertex. The mesh has others there.
    pub repaired: Vec<(u32, [f32; 3])>,
}

/// Says that normals point nowhere; others were made.
pub fn no_direction(count: usize) -> Option<String> {
    (count > 0).then(|| format!("{count} normals have no direction: they were made from the faces"))
}

/// What vertices have beside what the core carries, to compare two files by it.
#[derive(Clone, Debug, Default)]
pub struct Further {
    /// Each kind and name once.
    pub streams: Vec<VertexStream>,
    /// What there is, but cannot be compared, and why.
    pub left_out: Vec<(&'static str, &'static str)>,
}

/// A further value of every vertex.
#[derive(Clone, Debug)]
pub struct VertexStream {
    /// What it is for.
    pub kind: StreamKind,
    /// What it is called, the same in all files: of a skin, the joint that pulls.
    pub name: String,
    /// Floats per vertex.
    pub components: usize,
    /// `#vertices by components`; zeros where a vertex has none.
    pub values: Vec<f32>,
}

/// What a further stream is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum StreamKind {
    /// How much a joint pulls.
    Skin,
    /// How far a morph target moves or turns.
    Morph,
    /// A colour beside the first.
    Color,
    /// Any other quantity.
    Number,
}

/// Something that stands in the scene, or that a bone is bound by.
#[derive(Clone, Debug)]
pub struct Place {
    /// What it is called, the same in all files.
    pub name: String,
    /// Column-major.
    pub transform: [[f32; 4]; 4],
}

/// What the meshes of a file look like, as far as pictures of them show it.
#[derive(Clone, Debug, Default)]
pub struct Looks {
    /// Files of pictures, PNG or JPEG; empty where one cannot be read.
    pub pictures: Vec<Vec<u8>>,
    /// `#meshes by #submeshes`.
    pub meshes: Vec<Vec<Look>>,
}

/// What a submesh looks like.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Red, green and blue (0 to 1), linear, which the picture is multiplied by.
    pub color: [f32; 3],
    /// The number of its picture, by the first UV channel.
    pub picture: Option<usize>,
    /// Whether v counts from below.
    pub flips: bool,
}

impl Default for Look {
    fn default() -> Self {
        Look { color: [1.0; 3], picture: None, flips: false }
    }
}

/// A model file that was read.
pub trait Document {
    /// The meshes to chamfer.
    fn meshes(&self) -> &[SourceMesh];

    /// What became of the normals of each mesh (`#meshes`).
    fn normals(&self) -> &[NormalsRead];

    /// Where the meshes stand in the scene: each once and where it is, if the format has none.
    fn instances(&self) -> Vec<Instance> {
        (0..self.meshes().len()).map(|mesh| Instance { mesh, transform: IDENTITY }).collect()
    }

    /// `#meshes by #submeshes`: the names of their materials; nothing where the format has none.
    fn materials(&self) -> Vec<Vec<Option<String>>> {
        Vec::new()
    }

    /// What the vertices of a mesh have beside what the core carries; none where the reader does not
    /// tell.
    fn further(&self, _mesh: usize) -> Option<Further> {
        None
    }

    /// Where all nodes of the scene stand, and what bones are bound by; nothing where the reader does
    /// not tell.
    fn places(&self) -> Vec<Place> {
        Vec::new()
    }

    /// Whether the second texture coordinate of its meshes counts from below, as in OBJ, rather than from
    /// above.
    fn counts_from_below(&self) -> bool {
        false
    }

    /// Whether its units are metres; most formats do not say what theirs are.
    fn counts_metres(&self) -> bool {
        false
    }

    /// Gives some objects of one mesh, by their numbers among the instances, a copy of it of their
    /// own, behind all meshes. Nothing where the format has no objects: then there is one of each.
    fn give_own(&mut self, _objects: &[usize]) {}

    /// `#meshes`: whether each is in the file that is written. A copy that came out as its original is
    /// not.
    fn are_written(&self, chamfered: &[Chamfered]) -> Vec<bool> {
        vec![true; chamfered.len()]
    }

    /// What its meshes look like; nothing where the format does not say.
    fn looks(&self) -> Looks {
        Looks::default()
    }

    /// What the user should know of what was read: a sentence each.
    fn notes(&self) -> Vec<String> {
        Vec::new()
    }

    /// The file with `chamfered[i]` in the place of mesh `i`, in one of the formats that it can have:
    /// the file of the path `output` first, then those that belong to it.
    ///
    /// # Errors
    /// Where the result does not fit the format.
    fn encode(&self, format: Format, output: &Path, chamfered: &[Chamfered]) -> Result<Encoded>;
}
