//! Players for every platform compile and link, whether the package has a library for it or not.

use crate::mono;

/// The entry points of the library are named in an assembly only if it imports them.
fn imports(assembly: &[u8], name: &str) -> bool {
    assembly.windows(name.len()).any(|bytes| bytes == name.as_bytes())
}

#[test]
fn only_players_with_a_library_import_it() {
    let Some(program) = mono::program() else { return };
    assert!(imports(&program.player(&["UNITY_STANDALONE"]), "chamfer_run"));
    for platform in mono::platforms_without_library() {
        assert!(!imports(&program.player(&[platform]), "chamfer_"), "{platform}");
        let added = program.player(&mono::with_added_library(platform));
        assert!(imports(&added, "chamfer_run"), "{platform}");
    }
}

/// Where everything is linked into one file, there is no library to load.
#[test]
fn added_libraries_are_found_where_the_platform_has_them() {
    let Some(program) = mono::program() else { return };
    for (platform, internal) in
        [("UNITY_IOS", true), ("UNITY_WEBGL", true), ("UNITY_ANDROID", false)]
    {
        let added = program.player(&mono::with_added_library(platform));
        assert_eq!(imports(&added, "__Internal"), internal, "{platform}");
    }
}

#[test]
fn a_player_without_a_library_says_so() {
    let Some(program) = mono::program() else { return };
    let printed = program.chamfer_in_player("UNITY_IOS");
    assert!(printed.starts_with("LibraryMissingException: "), "{printed}");
    assert!(printed.contains("CHAMFER_LIBRARY"), "{printed}");
}

/// A build ships one mesh, not two: players have no field for the originals.
#[test]
fn players_know_nothing_of_originals() {
    let Some(program) = mono::program() else { return };
    let player = program.player(&["UNITY_STANDALONE"]);
    assert!(imports(&player, "ChamferModifier"));
    assert!(!imports(&player, "ChamferedMesh") && !imports(&player, "MeshUtility"));
}
