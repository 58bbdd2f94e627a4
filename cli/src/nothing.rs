//! Why nothing, or not much, became of a model, and what to do about it.

use std::collections::HashMap;

use chamfer::{Chamfered, MeshBuffers, Reason};
use chamfer_formats::{Document, NormalsRead};
use glam::Vec3;

use crate::report::{Counts, MeshReport, mean_width};

/// Faces that meet at less are one flat face, but for rounding.
const FLAT_DEGREES: f32 = 1.0;

/// A model that gets a smaller share of the width asked for looks otherwise than was meant.
const LEAST_SHARE: f32 = 1.0 / 3.0;

/// Why a model has no hard edges, where no other note says it.
pub fn no_hard_edges(document: &dyn Document, smoothing_angle: f32) -> Option<String> {
    let sharpest = document.meshes().iter().map(|mesh| sharpest(&mesh.mesh)).fold(0.0, f32::max);
    if sharpest < FLAT_DEGREES {
        return Some("it has no hard edges: no two faces meet at an angle".into());
    }
    let computed = document.normals().iter().any(|normals: &NormalsRead| normals.computed);
    let at = format!("it has no hard edges: faces meet at up to {sharpest:.0} degrees, but ");
    Some(match computed {
        true if sharpest > smoothing_angle => "its smoothing groups shade all of it as one: have \
             its normals made by angle, by --normals angle"
            .into(),
        true => format!(
            "it came without normals, and those made shade all of it as one: give a \
             --smoothing-angle under that, {smoothing_angle} is too much"
        ),
        false => "all its normals are smooth there. Chamfers go where the normals of two faces \
                  differ: shade it flat, or mark its sharp edges, before it is exported; or have \
                  its normals made anew, by --normals angle and --smoothing-angle"
            .into(),
    })
    .map(|why: String| at + &why)
}

/// The largest angle at which two faces meet, in degrees.
fn sharpest(mesh: &MeshBuffers) -> f32 {
    let mut normal_at: HashMap<[[u32; 3]; 2], Vec3> = HashMap::new();
    let mut least_cosine = 1.0f32;
    for triangle in mesh.indices.chunks_exact(3) {
        let corners = [0, 1, 2].map(|c| Vec3::from(mesh.positions[triangle[c] as usize]));
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        if normal == Vec3::ZERO {
            continue;
        }
        // Negative zeros are zeros.
        let places = corners.map(|corner| (corner + Vec3::ZERO).to_array().map(f32::to_bits));
        for side in 0..3 {
            let mut edge = [places[side], places[(side + 1) % 3]];
            edge.sort_unstable();
            match normal_at.get(&edge) {
                Some(other) => least_cosine = least_cosine.min(normal.dot(*other)),
                None => {
                    normal_at.insert(edge, normal);
                }
            }
        }
    }
    least_cosine.clamp(-1.0, 1.0).acos().to_degrees()
}

/// Says where all hard edges stayed, or most of the width.
pub fn little(reports: &[MeshReport]) -> Option<String> {
    let counts = Counts::sum(reports.iter());
    if counts.hard_edges == 0 {
        return None;
    }
    if counts.full + counts.narrowed == 0 {
        let (skipped, why) = (counts.skipped.text(), why_skipped(&counts));
        return Some(format!("none of its hard edges is chamfered: {skipped}{why}"));
    }
    let mean = mean_width(reports.iter());
    (mean < LEAST_SHARE).then(|| {
        format!(
            "its chamfers have {:.0} % of the width asked for on average, under a third: ask for \
             less, or see the reasons with --verbose",
            mean * 100.0
        )
    })
}

/// What the reason that most edges have comes from.
fn why_skipped(counts: &Counts) -> &'static str {
    let most = Reason::ALL.iter().max_by_key(|reason| counts.skipped.0[**reason as usize]);
    match most {
        Some(Reason::ZeroThickness) => {
            "; its faces lie back to back, so there is no solid to soften: give it a thickness"
        }
        Some(Reason::Folds) => "; chamfers would fold over: ask for less",
        Some(Reason::Winding) => {
            "; faces beside them are inside out: make all normals and windings agree"
        }
        Some(Reason::TJunction) => {
            "; vertices of one side lie in the middle of the other: join the sides there"
        }
        Some(Reason::TooFine) => {
            "; the width, or the faces, are finer than its coordinates: ask for more, or move it to the origin"
        }
        Some(Reason::Contact) => "; other parts rest on all of them",
        _ => "",
    }
}

/// Whether nothing at all was found to chamfer, though there are triangles.
pub fn is_untouched(chamfered: &[Chamfered]) -> bool {
    chamfered.iter().any(|result| !result.mesh.indices.is_empty())
        && chamfered.iter().all(|result| result.totals.hard_edges == 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use chamfer::shapes;

    #[test]
    fn the_sharpest_angle_is_that_of_faces_whatever_their_normals() {
        let mut cube = shapes::plain_cube(1.0);
        assert!((sharpest(&cube) - 90.0).abs() < 1e-3);
        cube.normals.fill([0.0, 0.0, 1.0]);
        assert!((sharpest(&cube) - 90.0).abs() < 1e-3);
        cube.indices.truncate(6);
        assert_eq!(sharpest(&cube), 0.0);
    }
}
