//! What a model looks like in pictures: the colours and pictures of its materials.

use chamfer_formats::{Document, Looks};
use glam::Vec3;
use image::{RgbImage, imageops};

use crate::preview::{Coat, Wardrobe};

/// Larger pictures are drawn smaller: a tile has no more texels to show.
const MOST_TEXELS: u32 = 512;

/// The pictures of a model, decoded.
pub struct Decoded {
    looks: Looks,
    /// `#pictures`; none for what cannot be decoded.
    images: Vec<Option<RgbImage>>,
}

impl Decoded {
    /// Those of a document.
    pub fn new(document: &dyn Document) -> Decoded {
        let looks = document.looks();
        let images = looks.pictures.iter().map(|bytes| decoded(bytes)).collect();
        Decoded { looks, images }
    }

    /// The coats of all that stands in the scene, by instance and submesh.
    pub fn wardrobe(&self, document: &dyn Document) -> Wardrobe<'_> {
        let coats = |mesh: usize| -> Vec<Coat> {
            let looks = self.looks.meshes.get(mesh).into_iter().flatten();
            looks
                .map(|look| Coat {
                    color: Vec3::from(look.color).to_array(),
                    image: look.picture.and_then(|number| self.images.get(number)?.as_ref()),
                    flips: look.flips,
                })
                .collect()
        };
        document.instances().iter().map(|instance| coats(instance.mesh)).collect()
    }
}

fn decoded(bytes: &[u8]) -> Option<RgbImage> {
    let image = image::load_from_memory(bytes).ok()?.into_rgb8();
    let most = image.width().max(image.height());
    if most <= MOST_TEXELS {
        return Some(image);
    }
    let side = |pixels: u32| (pixels * MOST_TEXELS / most).max(1);
    Some(imageops::thumbnail(&image, side(image.width()), side(image.height())))
}
