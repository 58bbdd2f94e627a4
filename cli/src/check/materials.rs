//! Which submeshes of two files have the same material.

/// `#submeshes` of each: the number of its material; none where only one of the two names any, as
/// then nobody can tell. Submeshes without a name have number 0: they may be of any material that
/// has none.
pub fn numbers(names: [&[Option<String>]; 2]) -> Option<[Vec<u32>; 2]> {
    let has_any = names.map(|names| names.iter().any(Option::is_some));
    let has_submeshes = names.iter().all(|names| !names.is_empty());
    if has_any[0] != has_any[1] && has_submeshes {
        return None;
    }
    let mut known: Vec<&String> = names.iter().flat_map(|names| names.iter().flatten()).collect();
    known.sort_unstable();
    known.dedup();
    let number = |name: &Option<String>| match name {
        Some(name) => known.binary_search(&name).map_or(0, |place| place as u32 + 1),
        None => 0,
    };
    Some(names.map(|names| names.iter().map(number).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(before: &str, after: &str) -> Option<[Vec<u32>; 2]> {
        let names = |text: &str| -> Vec<Option<String>> {
            text.split(' ').map(|name| (name != "-").then(|| name.to_owned())).collect()
        };
        numbers([&names(before), &names(after)])
    }

    #[test]
    fn the_same_name_is_the_same_number() {
        assert_eq!(found("wood steel -", "- steel wood"), Some([vec![2, 1, 0], vec![0, 1, 2]]));
        assert_eq!(found("-", "- -"), Some([vec![0], vec![0, 0]]));
    }

    #[test]
    fn names_in_one_file_alone_tell_nothing() {
        assert_eq!(found("wood", "-"), None);
    }
}
