//! Which mesh of one file is which of another.

use std::collections::BTreeMap;

use chamfer_formats::SourceMesh;

/// The meshes of two files, by their numbers.
#[derive(Debug, PartialEq)]
pub struct Pairs {
    /// Those that are in both, in the order of the first file.
    pub both: Vec<[usize; 2]>,
    /// Those that are only in the first.
    pub missing: Vec<usize>,
    /// Those that are only in the second.
    pub added: Vec<usize>,
}

impl Pairs {
    /// By name where a name is unique in both files, the others in their order. What a file calls
    /// its only mesh does not matter.
    pub fn new(before: &[SourceMesh], after: &[SourceMesh]) -> Pairs {
        let names = |meshes: &[SourceMesh]| -> Vec<String> {
            meshes.iter().map(|mesh| mesh.name.clone()).collect()
        };
        Pairs::by_names(&names(before), &names(after))
    }

    fn by_names(before: &[String], after: &[String]) -> Pairs {
        let [unique_before, unique_after] = [before, after].map(unique);
        let mut partner: Vec<Option<usize>> = vec![None; before.len()];
        let mut is_taken = vec![false; after.len()];
        for (name, &mesh) in &unique_before {
            if let Some(&other) = unique_after.get(name) {
                partner[mesh] = Some(other);
                is_taken[other] = true;
            }
        }
        let mut free = (0..after.len()).filter(|&mesh| !is_taken[mesh]);
        for mesh in partner.iter_mut().filter(|partner| partner.is_none()) {
            *mesh = free.next();
        }
        let both = partner.iter().enumerate().filter_map(|(mesh, other)| Some([mesh, (*other)?]));
        let missing = partner.iter().enumerate().filter(|(_, other)| other.is_none());
        Pairs {
            both: both.collect(),
            missing: missing.map(|(mesh, _)| mesh).collect(),
            added: free.collect(),
        }
    }
}

/// The names that are there once, with their places.
fn unique(names: &[String]) -> BTreeMap<&str, usize> {
    let mut places: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (place, name) in names.iter().enumerate() {
        places.entry(name).or_default().push(place);
    }
    let once = places.into_iter().filter(|(_, places)| places.len() == 1);
    once.map(|(name, places)| (name, places[0])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(before: &str, after: &str) -> Pairs {
        let names = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        Pairs::by_names(&names(before), &names(after))
    }

    #[test]
    fn unique_names_come_first_and_order_decides_the_rest() {
        assert_eq!(pairs("a b c", "c a b").both, [[0, 1], [1, 2], [2, 0]]);
        assert_eq!(pairs("a a b", "a b a").both, [[0, 0], [1, 2], [2, 1]]);
        assert_eq!(pairs("chair", "mesh").both, [[0, 0]]);
    }

    #[test]
    fn what_is_in_one_file_only_is_named() {
        let found = pairs("a b", "b");
        assert_eq!((found.both, found.missing, found.added), (vec![[1, 0]], vec![0], vec![]));
        let found = pairs("a", "b a");
        assert_eq!((found.both, found.missing, found.added), (vec![[0, 1]], vec![], vec![0]));
    }
}
