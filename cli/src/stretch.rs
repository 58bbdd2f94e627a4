//! How a mesh is stretched where it stands.

use std::collections::BTreeMap;

use chamfer_formats::{Document, Instance};
use glam::{DMat3, DVec3, Mat3, Mat4};

/// Stretches are one that differ by no more than this, as a share: nobody sees such chamfers differ.
const ALIKE: f64 = 1e-2;

/// What node transforms in single precision may be off.
const ROUNDING: f64 = 1e-5;

/// A mesh that keeps less than this share of its volume stands there flat.
const LEAST_VOLUME: f64 = 2e-6;

/// So many corners of meshes may be copied for stretches that differ: a scene that has the same rock a
/// thousand times would grow without end.
const MOST_COPIED: usize = 6_000_000;

/// Where the axes of a mesh go in the scene, but for a turn or a mirror, which change no length:
/// upper triangular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch(DMat3);

impl Stretch {
    /// None where the mesh stands there flat.
    pub fn of(instance: &Instance) -> Option<Stretch> {
        let linear = Mat3::from_mat4(Mat4::from_cols_array_2d(&instance.transform)).as_dmat3();
        let axes = [linear.x_axis, linear.y_axis, linear.z_axis];
        let longest = axes.map(DVec3::length).into_iter().fold(0.0, f64::max);
        let is_solid = linear.determinant().abs() > longest.powi(3) * LEAST_VOLUME;
        is_solid.then(|| Stretch(triangular(axes)))
    }

    /// How many times as long the mesh is there, on the mean of its axes.
    pub fn mean(&self) -> f64 {
        let squares = |axis: DVec3| axis.length_squared();
        let Stretch(to) = self;
        ((squares(to.x_axis) + squares(to.y_axis) + squares(to.z_axis)) / 3.0).sqrt()
    }

    /// The stretch with a mean of 1; none where all axes are as long as the mean and stay at right
    /// angles: then the mesh is only larger, or smaller.
    pub fn shape(&self) -> Option<[[f32; 3]; 3]> {
        let shape = self.0 * (1.0 / self.mean());
        let off =
            |one: DMat3| one.to_cols_array().into_iter().fold(0.0f64, |most, k| most.max(k.abs()));
        let is_plain = off(shape - DMat3::IDENTITY) <= ROUNDING;
        (!is_plain).then(|| shape.as_mat3().to_cols_array_2d())
    }

    /// Whether no length differs by more than the tolerance.
    fn is_like(&self, other: &Stretch) -> bool {
        let between = self.0 * other.0.inverse();
        let off = between.transpose() * between - DMat3::IDENTITY;
        off.to_cols_array().into_iter().all(|entry| entry.abs() <= 2.0 * ALIKE)
    }
}

/// The axes as they are after a turn that lays the first along x and the second into the plane of x
/// and y (Gram and Schmidt). What rounding leaves off the diagonal is none.
fn triangular([x, y, z]: [DVec3; 3]) -> DMat3 {
    let first = x.normalize();
    let second = (y - first * first.dot(y)).normalize();
    let third = first.cross(second);
    let longest = x.length().max(y.length()).max(z.length());
    let clean = |entry: f64| if entry.abs() <= longest * ROUNDING { 0.0 } else { entry };
    DMat3::from_cols(
        DVec3::new(x.length(), 0.0, 0.0),
        DVec3::new(clean(first.dot(y)), second.dot(y), 0.0),
        DVec3::new(clean(first.dot(z)), clean(second.dot(z)), third.dot(z).abs()),
    )
}

/// Gives each mesh that stands in a scene with several stretches a copy for each, so that all of its
/// objects can have chamfers of one width. What there is to say of it, a sentence each.
pub fn part(document: &mut dyn Document) -> Vec<String> {
    let mut left = MOST_COPIED;
    let mut notes = Vec::new();
    for (mesh, groups) in groups(&document.instances()) {
        let corners = document.meshes()[mesh].mesh.indices.len().max(1);
        let further = groups.len() - 1;
        if further * corners <= left {
            left -= further * corners;
            groups[1..].iter().for_each(|(_, objects)| document.give_own(objects));
        } else if further > 0 {
            notes.push(format!(
                "mesh {} stands in the scene with {} scales: too many for a copy each, so all have \
                 the chamfers of the first",
                document.meshes()[mesh].name,
                groups.len()
            ));
        }
    }
    notes
}

/// Objects that stand with one stretch, by their numbers.
type Group = (Stretch, Vec<usize>);

/// By mesh: its objects, but for flat ones.
fn groups(instances: &[Instance]) -> BTreeMap<usize, Vec<Group>> {
    let mut groups: BTreeMap<usize, Vec<Group>> = BTreeMap::new();
    for (number, instance) in instances.iter().enumerate() {
        let Some(stretch) = Stretch::of(instance) else { continue };
        let of_mesh = groups.entry(instance.mesh).or_default();
        match of_mesh.iter_mut().find(|(known, _)| stretch.is_like(known)) {
            Some((_, objects)) => objects.push(number),
            None => of_mesh.push((stretch, vec![number])),
        }
    }
    groups
}

/// `#meshes`: how each stands in the scene; none for one that does not, or flat.
pub fn stretches(document: &dyn Document) -> Vec<Option<Stretch>> {
    let mut stretches = vec![None; document.meshes().len()];
    for instance in document.instances() {
        let known = &mut stretches[instance.mesh];
        *known = known.or_else(|| Stretch::of(&instance));
    }
    stretches
}

/// The largest side of the box around all that stands in the scene.
pub fn largest_side(document: &dyn Document) -> f64 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for instance in document.instances() {
        let transform = Mat4::from_cols_array_2d(&instance.transform).as_dmat4();
        for position in &document.meshes()[instance.mesh].mesh.positions {
            let place = transform.transform_point3(DVec3::from(position.map(f64::from)));
            (low, high) = (low.min(place), high.max(place));
        }
    }
    (high - low).max_element().max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Quat, Vec3};

    fn at(scale: [f32; 3], turn: f32) -> Instance {
        let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), turn);
        let to =
            Mat4::from_scale_rotation_translation(scale.into(), turn, Vec3::new(5.0, 6.0, 7.0));
        Instance { mesh: 0, transform: to.to_cols_array_2d() }
    }

    #[test]
    fn a_turn_and_a_mirror_are_no_stretch() {
        for (scale, turn) in [([1.0; 3], 1.0), ([1.0, -1.0, 1.0], 2.0), ([100.0; 3], 0.5)] {
            let stretch = Stretch::of(&at(scale, turn)).unwrap();
            assert_eq!(stretch.shape(), None);
            assert!((stretch.mean() / f64::from(scale[0].abs()) - 1.0).abs() < 1e-6);
        }
        assert_eq!(Stretch::of(&at([1.0, 1.0, 0.0], 1.0)), None);
    }

    #[test]
    fn a_stretch_is_the_same_however_it_is_turned() {
        let [one, other] = [0.0, 0.7].map(|turn| Stretch::of(&at([10.0, 3.0, 0.2], turn)).unwrap());
        assert!(one.is_like(&other));
        let shape = one.shape().unwrap();
        assert!((shape[0][0] / shape[1][1] - 10.0 / 3.0).abs() < 1e-6, "{shape:?}");
        assert_eq!((shape[1][0], shape[2][0], shape[2][1]), (0.0, 0.0, 0.0));
        let is_near = |a: f32, b: f32| (a - b).abs() <= 1e-5;
        let same = shape.iter().flatten().zip(other.shape().unwrap().into_iter().flatten());
        assert!(same.into_iter().all(|(&a, b)| is_near(a, b)));
    }

    #[test]
    fn more_than_one_percent_is_another() {
        let numbers = |scales: [f32; 4]| {
            let groups = groups(&scales.map(|y| at([2.0, y, 2.0], y)));
            groups[&0].iter().map(|(_, objects)| objects.clone()).collect::<Vec<_>>()
        };
        assert_eq!(numbers([1.0, 1.009, 0.992, 1.0]), [vec![0, 1, 2, 3]]);
        assert_eq!(numbers([1.0, 1.012, 1.0, 1.013]), [vec![0, 2], vec![1, 3]]);
    }
}
