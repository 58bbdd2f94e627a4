//! Patches: strips and fills as they are to be added to the mesh, many at a time.

use crate::attributes::Taken;
use crate::ids::{Corner, Few, Triangle};
use crate::report::TriangleSource;

/// Strips and fills one after the other, in flat arrays that can be used again.
#[derive(Default)]
pub struct Patches {
    patches: Vec<Patch>,
    joints: Vec<Joint>,
    middles: Vec<Middle>,
    triangles: Vec<[u32; 3]>,
}

/// A strip or a fill.
#[derive(Clone, Copy)]
pub struct Patch {
    pub source: TriangleSource,
    /// The face that it continues, and whose submesh it joins.
    pub face: Triangle,
    /// The joint whose vertex is made first: the others follow in turn.
    pub begin: u32,
    /// How many of each it has.
    joints: u32,
    middles: u32,
    triangles: u32,
}

/// Where a patch joins the surface.
pub struct Joint {
    pub corner: Corner,
    /// What its vertex takes from another chart.
    pub taken: Option<Taken>,
}

/// A vertex in the middle of a fill.
pub struct Middle {
    /// The joints that it lies between.
    pub joints: Few<usize>,
    pub taken: Option<Taken>,
}

/// A patch with its parts.
pub struct Parts<'a> {
    pub patch: Patch,
    pub joints: &'a [Joint],
    /// Vertices of its own.
    pub middles: &'a [Middle],
    /// Places in the joints, and past them in the middles.
    pub triangles: &'a [[u32; 3]],
}

impl Patches {
    pub fn clear(&mut self) {
        self.patches.clear();
        self.joints.clear();
        self.middles.clear();
        self.triangles.clear();
    }

    /// Adds a patch.
    pub fn push(
        &mut self,
        source: TriangleSource,
        (face, begin): (Triangle, u32),
        joints: impl IntoIterator<Item = Joint>,
        middles: impl IntoIterator<Item = Middle>,
        triangles: &[[usize; 3]],
    ) {
        let before = [self.joints.len(), self.middles.len()];
        self.joints.extend(joints);
        self.middles.extend(middles);
        self.triangles.extend(triangles.iter().map(|triangle| triangle.map(|place| place as u32)));
        self.patches.push(Patch {
            source,
            face,
            begin,
            joints: (self.joints.len() - before[0]) as u32,
            middles: (self.middles.len() - before[1]) as u32,
            triangles: triangles.len() as u32,
        });
    }

    /// The patches in the order of their coming.
    pub fn iter(&self) -> impl Iterator<Item = Parts<'_>> {
        let (mut joints, mut middles) = (&self.joints[..], &self.middles[..]);
        let mut triangles = &self.triangles[..];
        self.patches.iter().map(move |&patch| Parts {
            patch,
            joints: first(&mut joints, patch.joints),
            middles: first(&mut middles, patch.middles),
            triangles: first(&mut triangles, patch.triangles),
        })
    }
}

/// Takes so many items off a list.
fn first<'a, T>(rest: &mut &'a [T], count: u32) -> &'a [T] {
    let (first, others) = rest.split_at(count as usize);
    *rest = others;
    first
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::TriangleKind;

    #[test]
    fn patches_come_out_one_by_one_with_their_own_parts() {
        let mut patches = Patches::default();
        let source = |index| TriangleSource { kind: TriangleKind::Edge, index };
        let joint = |corner| Joint { corner: Corner(corner), taken: None };
        let middle = Middle { joints: Few::from_slice(&[0, 1, 2]), taken: None };
        patches.push(source(4), (Triangle(1), 0), [7, 8, 9].map(joint), [], &[[0, 1, 2]]);
        patches.push(source(5), (Triangle(2), 1), [5, 6].map(joint), [middle], &[]);
        let corners = |parts: Parts| parts.joints.iter().map(|j| j.corner.0).collect::<Vec<_>>();
        let counts = |parts: Parts| (parts.patch.face, parts.middles.len(), parts.triangles.len());
        assert!(patches.iter().map(counts).eq([(Triangle(1), 0, 1), (Triangle(2), 1, 0)]));
        assert!(patches.iter().map(corners).eq([vec![7, 8, 9], vec![5, 6]]));
        patches.clear();
        assert_eq!(patches.iter().count(), 0);
    }
}
