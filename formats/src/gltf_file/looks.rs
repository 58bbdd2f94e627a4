//! What the primitives of a glTF look like: the colour and the picture of their materials.

use serde_json::Value;

use super::geometry::MeshGeometry;
use super::json;
use super::uri;
use crate::document::{Look, Looks};

/// The looks of all meshes. What cannot be read, or is not known here, is left out.
pub fn looks(
    json: &Value,
    buffers: &[Vec<u8>],
    folder: &std::path::Path,
    geometries: &[MeshGeometry],
) -> Looks {
    let pictures = json::list(json, "images").iter();
    let pictures = pictures.map(|image| picture(json, buffers, folder, image).unwrap_or_default());
    let of_mesh = |(mesh, geometry): (&Value, &MeshGeometry)| -> Vec<Look> {
        let primitives = json::list(mesh, "primitives");
        let of = |primitive: usize| look(json, primitives.get(primitive)?);
        let submeshes = geometry.submeshes.iter();
        submeshes.map(|submesh| of(submesh.primitive).unwrap_or_default()).collect()
    };
    let meshes = json::list(json, "meshes").iter().zip(geometries).map(of_mesh).collect();
    Looks { pictures: pictures.collect(), meshes }
}

fn look(json: &Value, primitive: &Value) -> Option<Look> {
    let material = json::integer(primitive.get("material")?)?;
    let surface = json::list(json, "materials").get(material)?.get("pbrMetallicRoughness")?;
    let color = json::floats::<4>(surface, "baseColorFactor", "a material").ok().flatten();
    let texture = surface.get("baseColorTexture");
    // Only the first channel is drawn, and only as it is.
    let is_plain = |texture: &&Value| {
        texture.get("texCoord").and_then(json::integer).unwrap_or(0) == 0
            && texture.get("extensions").is_none()
    };
    let picture = texture.filter(is_plain).and_then(|texture| {
        let number = json::integer(texture.get("index")?)?;
        json::integer(json::list(json, "textures").get(number)?.get("source")?)
    });
    let color = color.map_or([1.0; 3], |[red, green, blue, _]| [red, green, blue]);
    Some(Look { color, picture, flips: false })
}

/// The bytes of a picture, from its view or its file.
fn picture(
    json: &Value,
    buffers: &[Vec<u8>],
    folder: &std::path::Path,
    image: &Value,
) -> Option<Vec<u8>> {
    if let Some(uri) = image.get("uri") {
        return uri::read(uri.as_str()?, folder).ok();
    }
    let view = json::list(json, "bufferViews").get(json::integer(image.get("bufferView")?)?)?;
    let buffer = buffers.get(json::integer(view.get("buffer")?)?)?;
    let start = view.get("byteOffset").and_then(json::integer).unwrap_or(0);
    let length = json::integer(view.get("byteLength")?)?;
    buffer.get(start..start.checked_add(length)?).map(<[u8]>::to_vec)
}
