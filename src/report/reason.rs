//! Why edges are not as wide as asked for: the one list of reasons. `tests/header.rs` holds that of
//! the C header to it, and `tests/package.rs` that of C#.

use std::ffi::CStr;
use std::ops::{Index, IndexMut};

macro_rules! reasons {
    ($($(#[$doc:meta])* $reason:ident = $number:literal, $name:literal;)*) => {
        /// Why a hard edge is narrower than asked for, or not chamfered.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[non_exhaustive]
        #[repr(u32)]
        pub enum Reason {
            $($(#[$doc])* $reason = $number,)*
        }

        impl Reason {
            /// Every reason, in the order of their numbers.
            pub const ALL: &[Reason] = &[$(Reason::$reason),*];

            /// A short name in lower case with underscores, for C.
            pub(crate) fn c_name(self) -> &'static CStr {
                match self {
                    $(Reason::$reason => $name,)*
                }
            }
        }
    };
}

reasons! {
    /// It has full width.
    None = 0, c"none";
    /// A face beside it has no room: it would fold or lose its area.
    NoRoom = 1, c"no_room";
    /// The strip, or the fill at an end, would fold.
    Folds = 2, c"folds";
    /// An end lies in a corner so sharp that the full distance would shoot out as a spike.
    Miter = 3, c"miter";
    /// The chamfer would cut through the mesh.
    Intersects = 4, c"intersects";
    /// Nothing can be pulled at either end: both lie inside smooth areas or on borders.
    NoEnd = 5, c"no_end";
    /// The faces beside it lie back to back.
    ZeroThickness = 6, c"zero_thickness";
    /// A triangle beside it has no area.
    NoArea = 7, c"no_area";
    /// The width is too small for the precision of the positions here.
    TooFine = 8, c"too_fine";
    /// Something rests on the edge, or on a face right beside it: light would show behind a chamfer.
    Contact = 9, c"contact";
    /// It is not among the edges that were asked for, by angle, convexity, factor or list.
    NotSelected = 10, c"not_selected";
    /// A vertex of one side lies in the middle of the other, so that the surface is open along it.
    TJunction = 11, c"t_junction";
    /// A face beside it is wound against the other one, or against its own normals.
    Winding = 12, c"winding";
}

impl Reason {
    /// A short name in lower case with underscores, for reports.
    pub fn name(self) -> &'static str {
        self.c_name().to_str().unwrap_or_default()
    }
}

/// A count for each [`Reason`]: `counts[Reason::NoRoom]`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ByReason([u32; Reason::ALL.len()]);

impl ByReason {
    /// Each reason with its count, in the order of their numbers.
    pub fn iter(&self) -> impl Iterator<Item = (Reason, u32)> {
        Reason::ALL.iter().copied().zip(self.0)
    }

    /// Of all reasons together.
    pub fn total(&self) -> u32 {
        self.0.iter().sum()
    }
}

impl Index<Reason> for ByReason {
    type Output = u32;

    fn index(&self, reason: Reason) -> &u32 {
        &self.0[reason as usize]
    }
}

impl IndexMut<Reason> for ByReason {
    fn index_mut(&mut self, reason: Reason) -> &mut u32 {
        &mut self.0[reason as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_count_up_and_names_differ() {
        for (number, reason) in Reason::ALL.iter().enumerate() {
            assert_eq!(*reason as usize, number);
            let same = Reason::ALL.iter().filter(|other| other.name() == reason.name());
            assert_eq!(same.count(), 1, "{reason:?}");
        }
    }

    #[test]
    fn counts_are_kept_by_reason() {
        let mut counts = ByReason::default();
        counts[Reason::NoRoom] += 2;
        counts[Reason::Contact] += 1;
        assert_eq!(counts.total(), 3);
        let named: Vec<_> = counts.iter().filter(|(_, count)| *count > 0).collect();
        assert_eq!(named, [(Reason::NoRoom, 2), (Reason::Contact, 1)]);
    }
}
