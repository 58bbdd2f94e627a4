//! Materials by name, with their colour and its picture.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use ufbx::{Material, MaterialMap, Scene, Texture};

use crate::parts::Parts;
use crate::paths::read_beside;
use crate::pictures::Picture;

/// The lists of a glTF that materials need.
#[derive(Default)]
pub struct Materials {
    pub materials: Vec<Value>,
    pub textures: Vec<Value>,
    pub images: Vec<Value>,
}

impl Materials {
    /// The materials of a scene, in its order. Pictures are in the file or beside it.
    pub fn of(
        scene: &Scene,
        folder: &Path,
        parts: &mut Parts,
        notes: &mut Vec<String>,
    ) -> Materials {
        let mut lists = Materials::default();
        let mut texture_of = vec![None; scene.textures.len()];
        for (number, texture) in scene.textures.iter().enumerate() {
            let is_used = scene.materials.iter().any(|material| {
                let maps = &material.pbr;
                let drawn = [&maps.base_color, &maps.normal_map, &maps.emission_color];
                drawn.into_iter().filter_map(texture_on).any(|used| used == number)
            });
            match picture(texture, folder) {
                _ if !is_used => {}
                Ok(picture) => texture_of[number] = Some(lists.add(&picture, parts)),
                Err(what) => notes.push(what),
            }
        }
        lists.materials =
            scene.materials.iter().map(|material| write_material(material, &texture_of)).collect();
        lists
    }

    fn add(&mut self, picture: &Picture, parts: &mut Parts) -> usize {
        let view = parts.view(picture.bytes.iter().copied(), None);
        let image = json!({"name": picture.name, "mimeType": picture.kind, "bufferView": view});
        self.images.push(image);
        self.textures.push(json!({"source": self.images.len() - 1}));
        self.textures.len() - 1
    }
}

/// The number of the texture on a map.
fn texture_on(map: &MaterialMap) -> Option<usize> {
    let texture = map.texture.as_ref().filter(|_| map.texture_enabled);
    texture.map(|texture| texture.element.typed_id as usize)
}

/// The number of a map, 0 to 1.
fn share(map: &MaterialMap, usual: f64) -> f32 {
    let value = if map.has_value { map.value_vec4.x } else { usual };
    if value.is_finite() { value.clamp(0.0, 1.0) as f32 } else { usual as f32 }
}

/// A map's colour times a factor, red, green and blue, each within 0 to 1; none where there is no number.
fn color_of(map: &MaterialMap, factor: f32) -> Option<[f32; 3]> {
    let value = map.value_vec4;
    let channels = [value.x, value.y, value.z].map(|channel| channel as f32 * factor);
    let is_finite = channels.iter().all(|channel| channel.is_finite());
    (map.has_value && is_finite).then(|| channels.map(|channel| channel.clamp(0.0, 1.0)))
}

/// How little light a material lets through, 0 to 1. The materials of old have a color of what goes
/// through, and a factor. Some exporters leave both at 1 for what is not transparent at all.
fn opacity_of(material: &Material) -> f32 {
    let own = &material.pbr.opacity;
    let (color, factor) = (&material.fbx.transparency_color, &material.fbx.transparency_factor);
    let through = color_of(color, if factor.has_value { share(factor, 0.0) } else { 1.0 });
    match through {
        _ if own.has_value => share(own, 1.0),
        Some(through) if through != [1.0; 3] => 1.0 - through.into_iter().sum::<f32>() / 3.0,
        _ => 1.0,
    }
}

fn write_material(material: &Material, texture_of: &[Option<usize>]) -> Value {
    let maps = &material.pbr;
    let drawn = |map: &MaterialMap| {
        texture_on(map).and_then(|used| texture_of[used]).map(|index| json!({"index": index}))
    };
    let mut color = [1.0; 4];
    // A picture takes the place of the colour.
    let picture = drawn(&maps.base_color);
    let own = color_of(&maps.base_color, share(&maps.base_factor, 1.0));
    if let (None, Some(own)) = (&picture, own) {
        color[..3].copy_from_slice(&own);
    }
    color[3] = opacity_of(material);
    let mut surface = json!({
        "baseColorFactor": color,
        "metallicFactor": share(&maps.metalness, 0.0),
        "roughnessFactor": share(&maps.roughness, 1.0),
    });
    if let Some(picture) = picture {
        surface["baseColorTexture"] = picture;
    }
    let mut value = json!({"name": &*material.element.name, "pbrMetallicRoughness": surface});
    if let Some(picture) = drawn(&maps.normal_map) {
        value["normalTexture"] = picture;
    }
    let strength = share(&maps.emission_factor, 1.0);
    if let Some(picture) = drawn(&maps.emission_color) {
        (value["emissiveTexture"], value["emissiveFactor"]) =
            (picture, json!([strength, strength, strength]));
    } else if let Some(glow) = color_of(&maps.emission_color, strength)
        && glow != [0.0; 3]
    {
        value["emissiveFactor"] = json!(glow);
    }
    if color[3] < 1.0 {
        value["alphaMode"] = "BLEND".into();
    }
    value
}

/// The picture of a texture, or why it does not go along.
fn picture(texture: &Texture, folder: &Path) -> Result<Picture, String> {
    let named = texture.relative_filename.replace('\\', "/");
    let name = named.rsplit('/').next().unwrap_or_default().to_owned();
    let shown = if name.is_empty() { texture.element.name.to_string() } else { name.clone() };
    let inside = texture.content.as_ref();
    let bytes = match inside.is_empty() {
        false => inside.to_vec(),
        true => beside(folder, &named, &name)
            .ok_or_else(|| format!("the picture {shown:?} is neither in the file nor beside it"))?,
    };
    Picture::new(shown.clone(), bytes)
        .ok_or_else(|| format!("{shown} is no PNG or JPEG, which glTF needs: it was left out"))
}

/// Where the file names it, or by its name alone; in the model's folder or below only.
fn beside(folder: &Path, named: &str, name: &str) -> Option<Vec<u8>> {
    let is_below = |path: &&str| {
        !path.is_empty() && !path.split('/').any(|part| part == "..") && !path.contains(':')
    };
    let paths = [named, name].into_iter().filter(is_below).map(PathBuf::from);
    paths.filter(|path| path.is_relative()).find_map(|path| read_beside(folder, &path).ok())
}
