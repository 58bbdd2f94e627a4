//! Surface: the triangles of the source, how they are joined, and which way they face.

use crate::faces::Faces;
use crate::topology::Topology;
use crate::view::View;

/// The values of the first stages, which nearly all others read together.
#[derive(Clone, Copy)]
pub struct Surface<'a> {
    pub view: &'a View<'a>,
    pub topology: &'a Topology,
    pub faces: &'a Faces,
}
