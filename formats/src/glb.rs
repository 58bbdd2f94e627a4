//! A binary glTF of one mesh, for models that come from formats without normals or materials.

use std::collections::HashMap;

use anyhow::Result;
use chamfer::{MeshBuffers, UvBuffer};
use serde_json::{Value, json};

use crate::gltf_file::write_glb;
use crate::parts::Parts;
use crate::pictures::Picture;

/// What is known of a material beside its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Material {
    /// As submeshes name it.
    pub name: String,
    /// Red, green, blue and opacity (0 to 1), which a texture is multiplied by.
    pub color: [f32; 4],
    /// How matte it is (0 to 1).
    pub roughness: f32,
    /// The picture on it.
    pub texture: Option<Picture>,
}

/// Encodes a mesh as .glb. `materials` names the material of each submesh (`#submeshes`; those
/// missing have none); the submeshes of one material become one primitive. What `library` knows of
/// a material goes along.
///
/// # Errors
/// Where the file would be larger than the 4 GiB that the format allows.
pub fn encode(
    name: &str,
    mesh: &MeshBuffers,
    materials: &[Option<String>],
    library: &[Material],
) -> Result<Vec<u8>> {
    let mut builder = Builder { library, ..Builder::default() };
    let groups = by_material(mesh, materials);
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "chamfer" },
        "scene": 0,
        "scenes": [{}],
    });
    if !groups.is_empty() {
        let attributes = builder.attributes(mesh);
        let primitives = builder.primitives(&groups, &attributes);
        root["scenes"] = json!([{ "nodes": [0] }]);
        root["nodes"] = json!([{ "mesh": 0, "name": name }]);
        root["meshes"] = json!([{ "name": name, "primitives": primitives }]);
        root["accessors"] = Value::Array(builder.parts.accessors);
        root["bufferViews"] = Value::Array(builder.parts.views);
        root["buffers"] = json!([{ "byteLength": builder.parts.binary.len() }]);
        for (key, items) in [
            ("materials", builder.materials),
            ("textures", builder.textures),
            ("images", builder.images),
        ] {
            if !items.is_empty() {
                root[key] = Value::Array(items);
            }
        }
    }
    write_glb(&serde_json::to_vec(&root)?, &builder.parts.binary, &[])
}

/// The indices of all submeshes of one material.
struct Group<'a> {
    material: Option<&'a str>,
    indices: Vec<u32>,
}

/// In the order of first use; groups without triangles are left out.
fn by_material<'a>(mesh: &MeshBuffers, materials: &'a [Option<String>]) -> Vec<Group<'a>> {
    let mut groups: Vec<Group> = Vec::new();
    let mut group_of = HashMap::new();
    let mut rest = mesh.indices.as_slice();
    for (submesh, &count) in mesh.submesh_index_counts.iter().enumerate() {
        let (indices, after) = rest.split_at((count as usize).min(rest.len()));
        rest = after;
        let material = materials.get(submesh).and_then(Option::as_deref);
        let group = *group_of.entry(material).or_insert(groups.len());
        if group == groups.len() {
            groups.push(Group { material, indices: Vec::new() });
        }
        groups[group].indices.extend(indices);
    }
    groups.retain(|group| !group.indices.is_empty());
    groups
}

/// The parts of a glTF that refer to each other by number.
#[derive(Default)]
struct Builder<'a> {
    library: &'a [Material],
    parts: Parts,
    materials: Vec<Value>,
    textures: Vec<Value>,
    images: Vec<Value>,
}

impl Builder<'_> {
    /// The number of a new material.
    fn material(&mut self, name: &str) -> usize {
        let mut material = json!({ "name": name });
        let library = self.library;
        if let Some(known) = library.iter().find(|known| known.name == name) {
            let mut surface = json!({
                "baseColorFactor": known.color,
                "metallicFactor": 0.0,
                "roughnessFactor": known.roughness,
            });
            if let Some(picture) = &known.texture {
                surface["baseColorTexture"] = json!({ "index": self.texture(picture) });
            }
            material["pbrMetallicRoughness"] = surface;
            if known.color[3] < 1.0 {
                material["alphaMode"] = json!("BLEND");
            }
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// The number of a texture; one that is there already for a picture of that name.
    fn texture(&mut self, picture: &Picture) -> usize {
        let known = self.images.iter().position(|image| image["name"] == picture.name.as_str());
        known.unwrap_or_else(|| {
            let view = self.parts.view(picture.bytes.iter().copied(), None);
            let image =
                json!({ "name": picture.name, "mimeType": picture.kind, "bufferView": view });
            self.images.push(image);
            self.textures.push(json!({ "source": self.images.len() - 1 }));
            self.textures.len() - 1
        })
    }

    fn attributes(&mut self, mesh: &MeshBuffers) -> Value {
        let mut attributes = json!({});
        attributes["POSITION"] = json!(self.parts.positions(&mesh.positions));
        attributes["NORMAL"] = json!(self.parts.floats("VEC3", mesh.normals.as_flattened()));
        if !mesh.tangents.is_empty() {
            attributes["TANGENT"] = json!(self.parts.floats("VEC4", mesh.tangents.as_flattened()));
        }
        if !mesh.colors.is_empty() {
            attributes["COLOR_0"] = json!(self.parts.floats("VEC4", mesh.colors.as_flattened()));
        }
        // glTF numbers its channels without gaps.
        let present = mesh.uvs.iter().filter(|uv| uv.components > 0);
        for (number, uv) in present.enumerate() {
            let accessor = self.parts.floats("VEC2", &first_two(uv));
            attributes[format!("TEXCOORD_{number}")] = json!(accessor);
        }
        attributes
    }

    fn primitives(&mut self, groups: &[Group], attributes: &Value) -> Vec<Value> {
        let mut primitives = Vec::new();
        for group in groups {
            let indices = self.parts.indices(&group.indices);
            let mut primitive = json!({ "attributes": attributes, "indices": indices });
            if let Some(name) = group.material {
                primitive["material"] = json!(self.material(name));
            }
            primitives.push(primitive);
        }
        primitives
    }
}

/// glTF texture coordinates are pairs; further components are dropped.
fn first_two(uv: &UvBuffer) -> Vec<f32> {
    uv.values.chunks_exact(uv.components as usize).flat_map(|uv| [uv[0], uv[1]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> MeshBuffers {
        MeshBuffers {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            indices: vec![0, 1, 2],
            submesh_index_counts: vec![3],
            ..MeshBuffers::default()
        }
    }

    /// The JSON of a .glb, after a look at its frame.
    fn json_of(file: &[u8]) -> Value {
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&file[..4], word(4), word(8)), (b"glTF".as_slice(), 2, file.len()));
        assert_eq!(&file[16..20], b"JSON");
        serde_json::from_slice(&file[20..20 + word(12)]).unwrap()
    }

    #[test]
    fn a_triangle_has_bounds_and_one_primitive() {
        let json = json_of(&encode("tri", &triangle(), &[Some("red".into())], &[]).unwrap());
        assert_eq!(json["accessors"][0]["max"], json!([1.0, 2.0, 0.0]));
        assert_eq!(json["accessors"][0]["count"], 3);
        assert_eq!(json["meshes"][0]["primitives"].as_array().unwrap().len(), 1);
        assert_eq!(json["meshes"][0]["primitives"][0]["material"], 0);
        assert_eq!(json["materials"], json!([{ "name": "red" }]));
        assert_eq!(json["buffers"][0]["byteLength"], 3 * 12 + 3 * 12 + 3 * 4);
    }

    #[test]
    fn what_is_known_of_a_material_goes_along() {
        let png = Picture::new("a.png".into(), b"\x89PNG\r\n\x1A\n".to_vec());
        assert!(png.is_some() && Picture::new("a.tga".into(), vec![0; 8]).is_none());
        let red = Material {
            name: "red".into(),
            color: [1.0, 0.0, 0.0, 0.5],
            roughness: 0.25,
            texture: png,
        };
        let json = json_of(&encode("tri", &triangle(), &[Some("red".into())], &[red]).unwrap());
        let material = &json["materials"][0];
        let surface = &material["pbrMetallicRoughness"];
        assert_eq!(surface["baseColorFactor"], json!([1.0, 0.0, 0.0, 0.5]));
        assert_eq!(
            (&surface["roughnessFactor"], &material["alphaMode"]),
            (&json!(0.25), &json!("BLEND"))
        );
        assert_eq!(surface["baseColorTexture"]["index"], 0);
        assert_eq!(json["images"][0]["mimeType"], "image/png");
        let view = &json["bufferViews"][json["images"][0]["bufferView"].as_u64().unwrap() as usize];
        assert_eq!((&view["byteLength"], view.get("target")), (&json!(8), None));
    }

    #[test]
    fn submeshes_of_one_material_become_one_primitive() {
        let mut mesh = triangle();
        mesh.indices = vec![0, 1, 2, 2, 1, 0, 1, 0, 2];
        mesh.submesh_index_counts = vec![3, 3, 0, 3];
        let names = ["a", "b", "c", "a"].map(|name| Some(name.to_string()));
        let json = json_of(&encode("tri", &mesh, &names, &[]).unwrap());
        let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
        assert_eq!(primitives.len(), 2);
        assert_eq!(
            json["accessors"][primitives[0]["indices"].as_u64().unwrap() as usize]["count"],
            6
        );
    }

    #[test]
    fn channels_are_numbered_without_gaps_and_cut_to_two_components() {
        let mut mesh = triangle();
        mesh.uvs[2] = UvBuffer { components: 3, values: vec![0.5; 9] };
        let json = json_of(&encode("tri", &mesh, &[], &[]).unwrap());
        let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
        let uv = &json["accessors"][attributes["TEXCOORD_0"].as_u64().unwrap() as usize];
        assert_eq!((uv["type"].as_str(), uv["count"].as_u64()), (Some("VEC2"), Some(3)));
    }

    #[test]
    fn a_mesh_without_triangles_is_an_empty_scene() {
        let json = json_of(&encode("none", &MeshBuffers::default(), &[], &[]).unwrap());
        assert_eq!(json["scenes"], json!([{}]));
        assert!(json.get("meshes").is_none());
    }
}
