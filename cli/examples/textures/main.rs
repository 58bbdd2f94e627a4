//! Draws the pictures of textured models in a folder:
//! `cargo run --release --package chamfer-cli --example textures -- docs`.

mod atlas;

use std::error::Error;
use std::path::Path;

use chamfer::{Chamfered, MeshBuffers, Options, Width, chamfer, shapes};
use chamfer_cli::preview::{LARGE_TILE, Panel, Placed, Surface, Zoom, before_after};
use chamfer_formats::IDENTITY;
use image::{RgbImage, imageops};

use atlas::Atlas;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("name the folder for the pictures")?;
    seamed_cube()?.save(Path::new(&folder).join("seamed_cube.png"))?;
    table_atlas()?.save(Path::new(&folder).join("table_atlas.png"))?;
    Ok(())
}

/// A cube each of whose edges is a seam, with a checker texture.
fn seamed_cube() -> Result<RgbImage, Box<dyn Error>> {
    let cube = shapes::cube(1.0);
    let caption = "a checker on a cube whose edges are all seams";
    let panel = Panel { caption: caption.into(), surface: Surface::Checker, ..Panel::default() };
    Ok(before_after(&both(panel, &cube, &chamfered(&cube, 6.0)?), LARGE_TILE))
}

/// A table with an atlas, and below it the atlas with the triangles that lie on it.
fn table_atlas() -> Result<RgbImage, Box<dyn Error>> {
    let mut table = shapes::table();
    let atlas = Atlas::unwrap(&mut table);
    let after = chamfered(&table, 1.5)?;
    let image = atlas.paint();
    let panel = Panel {
        caption: "a table with a chart for each face; what no chart covers is pink".into(),
        surface: Surface::Texture(&image),
        zoom: Some(Zoom { factor: 1.6, focus: Some([0.6, 0.6, 0.4]) }),
        ..Panel::default()
    };
    let models = before_after(&both(panel, &table, &after), LARGE_TILE);
    let [left, right] = [&table, &after.mesh].map(|mesh| atlas::outlined(&image, mesh));
    let (width, height) = models.dimensions();
    let mut picture = RgbImage::new(width, height + left.height());
    imageops::replace(&mut picture, &models, 0, 0);
    imageops::replace(&mut picture, &left, 0, height.into());
    imageops::replace(&mut picture, &right, (width - right.width()).into(), height.into());
    Ok(picture)
}

fn chamfered(mesh: &MeshBuffers, percent: f32) -> Result<Chamfered, chamfer::Error> {
    let width = Width::PercentOfExtent(percent);
    chamfer(&mesh.as_mesh(), &Options::default().with_width(width))
}

fn both<'a>(panel: Panel<'a>, before: &'a MeshBuffers, after: &'a Chamfered) -> Panel<'a> {
    let placed = |mesh: &'a MeshBuffers| vec![Placed { mesh: mesh.as_mesh(), transform: IDENTITY }];
    Panel { before: placed(before), after: placed(&after.mesh), ..panel }
}
