//! Given: what rounded patches are made from.

use crate::chamfers::Chamfers;
use crate::placement::Placement;
use crate::view::View;

/// The arguments of [`rounding`](super::rounding), for the files of this stage alone.
#[derive(Clone, Copy)]
pub struct Given<'a> {
    pub view: &'a View<'a>,
    pub chamfers: Chamfers<'a>,
    pub placement: &'a Placement<'a>,
    pub profile: f64,
}
