//! What is asked of each mesh of a file: a width counts in the scene, where a mesh may stand larger
//! than it is, or stretched.

use anyhow::{Context, Result};
use chamfer::{Factors, Mesh, Options, Width};
use chamfer_formats::{Document, SourceMesh};

use crate::length::{Length, Unit};
use crate::stretch::{Stretch, largest_side, stretches};

/// What is asked of the meshes of any file.
#[derive(Clone, Debug)]
pub struct Wish {
    /// Its width and scale are not looked at.
    pub core: Options,
    pub width: Length,
    /// Whether widths count in the units of each mesh, and hundredths of its own largest side.
    pub per_mesh: bool,
    /// Widths at materials, by name; of one name, the last counts.
    pub material_widths: Vec<(String, Length)>,
    /// The channel of the vertex colours that widths are multiplied by.
    pub mask: Option<usize>,
}

impl Default for Wish {
    fn default() -> Wish {
        Wish {
            core: Options::default(),
            width: Length::percent(1.0),
            per_mesh: false,
            material_widths: Vec::new(),
            mask: None,
        }
    }
}

/// What is asked of the meshes of a file.
pub struct Fit {
    /// `#meshes`.
    pub options: Vec<Options>,
    /// `#meshes`: for each submesh, or none.
    submeshes: Vec<Vec<f32>>,
    /// `#meshes`: for each vertex, or none.
    vertices: Vec<Vec<f32>>,
}

/// Fits what is asked to a file, whose meshes each stand in one stretch only.
///
/// # Errors
/// Where a width has a unit, and the file has none.
pub fn fit(document: &dyn Document, wish: &Wish) -> Result<Fit> {
    let meshes = document.meshes();
    let stretches = match wish.per_mesh {
        true => vec![None; meshes.len()],
        false => stretches(document),
    };
    let side = largest_side(document);
    let mut fit = Fit { options: Vec::new(), submeshes: Vec::new(), vertices: Vec::new() };
    let materials = document.materials();
    for (number, (source, stretch)) in meshes.iter().zip(stretches).enumerate() {
        let ruler = Ruler { own: source.mesh.as_mesh().extent(), side, stretch };
        let named = materials.get(number).map_or(&[][..], Vec::as_slice);
        let widths = ruler.widths(document, wish, named, source)?;
        let options = wish.core.with_width(widths.of_mesh);
        let shape = stretch.and_then(|stretch| stretch.shape());
        fit.options.push(shape.map_or(options, |shape| options.with_scale(shape)));
        fit.submeshes.push(widths.submeshes);
        fit.vertices.push(wish.mask.map_or(Vec::new(), |channel| mask(source, channel)));
    }
    Ok(fit)
}

impl Fit {
    /// The meshes of the file, with what is asked of parts of them.
    pub fn meshes<'a>(&'a self, document: &'a dyn Document) -> Vec<Mesh<'a>> {
        let mesh = |(number, source): (usize, &'a SourceMesh)| {
            let (submeshes, vertices) = (&self.submeshes[number], &self.vertices[number]);
            let factors = Factors { submeshes, vertices, edges: &[] };
            Mesh { factors, ..source.mesh.as_mesh() }
        };
        document.meshes().iter().enumerate().map(mesh).collect()
    }
}

/// What of a wish no mesh of a file has: a sentence each.
pub fn unmet(document: &dyn Document, wish: &Wish) -> Vec<String> {
    let materials = document.materials();
    let known: Vec<&String> = materials.iter().flatten().flatten().collect();
    let is_unknown = |(name, _): &&(String, Length)| !known.contains(&name);
    let unknown = wish.material_widths.iter().filter(is_unknown);
    let mut notes: Vec<String> = unknown
        .map(|(name, _)| {
            let mut known: Vec<String> = known.iter().map(|name| format!("{name:?}")).collect();
            known.sort_unstable();
            known.dedup();
            match known.is_empty() {
                true => format!("--material-width {name}: it names no materials"),
                false => format!("--material-width {name}: its materials are {}", known.join(", ")),
            }
        })
        .collect();
    let has_colors = document.meshes().iter().any(|mesh| !mesh.mesh.colors.is_empty());
    if wish.mask.is_some() && !has_colors {
        notes.push("--mask: it has no vertex colours, so all widths are as asked for".into());
    }
    notes
}

/// Where widths of a mesh are measured.
struct Ruler {
    /// The largest side of the mesh.
    own: f32,
    /// That of the scene.
    side: f64,
    /// None where the mesh is measured by itself.
    stretch: Option<Stretch>,
}

/// The widths of a mesh.
struct Widths {
    of_mesh: Width,
    /// `#submeshes`, or none: how many times that.
    submeshes: Vec<f32>,
}

impl Ruler {
    fn widths(
        &self,
        document: &dyn Document,
        wish: &Wish,
        materials: &[Option<String>],
        source: &SourceMesh,
    ) -> Result<Widths> {
        let units = |width: Length| self.units(width, document.counts_metres());
        let asked = units(wish.width)?;
        // The last of a name counts.
        let known = |name: &String| wish.material_widths.iter().rev().find(|(of, _)| of == name);
        let of_submesh = |submesh: usize| match materials.get(submesh) {
            Some(Some(name)) => known(name).map_or(Ok(asked), |(_, width)| units(*width)),
            _ => Ok(asked),
        };
        let submeshes = 0..source.mesh.submesh_index_counts.len();
        let widths: Vec<f64> = submeshes.map(of_submesh).collect::<Result<_>>()?;
        if widths.iter().all(|width| *width == asked) {
            return Ok(Widths {
                of_mesh: self.core_width(wish.width, asked),
                submeshes: Vec::new(),
            });
        }
        // Where nothing is asked for elsewhere, there is nothing to multiply.
        let whole = if asked > 0.0 { asked } else { widths.iter().copied().fold(0.0, f64::max) };
        let submeshes = widths.iter().map(|width| (width / whole) as f32).collect();
        let of_mesh = match asked > 0.0 {
            true => self.core_width(wish.width, asked),
            false => Width::Units(whole as f32),
        };
        Ok(Widths { of_mesh, submeshes })
    }

    /// A width in units of the mesh, as it is measured.
    fn units(&self, width: Length, are_metres: bool) -> Result<f64> {
        match self.stretch {
            Some(stretch) => Ok(width.in_units(self.side, are_metres)? / stretch.mean()),
            None => width.in_units(f64::from(self.own), are_metres),
        }
        .context("--width")
    }

    /// The same for the core. A percentage of the mesh's own side is told as such, without rounding.
    fn core_width(&self, asked: Length, units: f64) -> Width {
        let is_own = match self.stretch {
            Some(stretch) => (self.side / stretch.mean()) as f32 == self.own,
            None => true,
        };
        match asked.unit {
            Unit::Percent if is_own => Width::PercentOfExtent(asked.value),
            _ => Width::Units(units as f32),
        }
    }
}

/// `#vertices`: a channel of the colours; none without colours. A colour below black is black.
fn mask(source: &SourceMesh, channel: usize) -> Vec<f32> {
    source.mesh.colors.iter().map(|color| color[channel].max(0.0)).collect()
}
