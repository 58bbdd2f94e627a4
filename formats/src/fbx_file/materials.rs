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
                base(material).is_some_and(|used| used.element.typed_id as usize == number)
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

fn base(material: &Material) -> Option<&Texture> {
    let map = &material.pbr.base_color;
    map.texture.as_ref().filter(|_| map.texture_enabled).map(|texture| &**texture)
}

fn write_material(material: &Material, texture_of: &[Option<usize>]) -> Value {
    let share = |map: &MaterialMap, usual: f64| {
        let value = if map.has_value { map.value_vec4.x } else { usual };
        if value.is_finite() { value.clamp(0.0, 1.0) as f32 } else { usual as f32 }
    };
    let maps = &material.pbr;
    let mut color = [1.0; 4];
    // A picture takes the place of the colour.
    let texture = base(material).and_then(|used| texture_of[used.element.typed_id as usize]);
    if texture.is_none() && maps.base_color.has_value {
        let (value, factor) = (maps.base_color.value_vec4, share(&maps.base_factor, 1.0));
        let channels = [value.x, value.y, value.z].map(|channel| channel as f32 * factor);
        let is_finite = channels.iter().all(|channel| channel.is_finite());
        color[..3]
            .copy_from_slice(&channels.map(|c| if is_finite { c.clamp(0.0, 1.0) } else { 1.0 }));
    }
    color[3] = share(&maps.opacity, 1.0);
    let mut surface = json!({
        "baseColorFactor": color,
        "metallicFactor": share(&maps.metalness, 0.0),
        "roughnessFactor": share(&maps.roughness, 1.0),
    });
    if let Some(texture) = texture {
        surface["baseColorTexture"] = json!({"index": texture});
    }
    let mut value = json!({"name": &*material.element.name, "pbrMetallicRoughness": surface});
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
