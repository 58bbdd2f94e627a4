//! What is in the way of a run, and what a run must not do to files.

#[path = "support/folder.rs"]
mod folder;
#[path = "support/run.rs"]
mod run;

use std::fs;

use chamfer::shapes;
use chamfer_formats::glb;

use folder::Folder;

fn cube_glb() -> Vec<u8> {
    glb::encode("cube", &shapes::plain_cube(1.0), &[], &[]).unwrap()
}

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[test]
fn a_gltf_is_replaced_with_its_buffer_and_no_other_model_loses_its_own() {
    let folder = Folder::with(&[]);
    fs::write(folder.path("cube.glb"), cube_glb()).unwrap();
    let run = |width: &str| folder.run(&format!("cube.glb -o out/a.gltf --width {width}"));
    run("0.1").exits(0);
    let first = fs::read(folder.path("out/a.bin")).unwrap();
    run("0.2").exits(0);
    assert_ne!(fs::read(folder.path("out/a.bin")).unwrap(), first);
    folder.run("check cube.glb out/a.gltf --width 0.2").exits(0);
    assert_eq!(folder.files(), ["cube.glb", "out/a.bin", "out/a.gltf"]);

    fs::copy(folder.path("out/a.gltf"), folder.path("out/other.gltf")).unwrap();
    let told = run("0.1").exits(1).err();
    assert!(told.contains("a.bin is a buffer of") || told.contains("other.gltf too"), "{told}");
    folder.run("check cube.glb out/other.gltf --width 0.2").exits(0);
    folder.run("check cube.glb out/a.gltf --width 0.2").exits(0);
}

#[test]
fn a_file_that_only_has_the_name_of_a_buffer_stays() {
    let folder = Folder::with(&[("out/a.bin", "not a buffer")]);
    fs::write(folder.path("cube.glb"), cube_glb()).unwrap();
    let told = folder.run("cube.glb -o out/a.gltf").exits(1).err();
    assert!(told.contains("out/a.bin is there already with another content"), "{told}");
    assert_eq!(folder.files(), ["cube.glb", "out/a.bin"]);
    assert_eq!(folder.text("out/a.bin"), "not a buffer");
}

#[cfg(unix)]
mod on_unix {
    use super::*;
    use std::ffi::OsStr;
    use std::fs::Permissions;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
    use std::os::unix::process::CommandExt;
    use std::path::Path;
    use std::process::Stdio;
    use std::time::Duration;

    use crate::run::Run;

    /// A user who is not asked on any system, where the tests are run by one who may do all.
    const NOBODY: u32 = 65534;

    #[test]
    fn what_cannot_be_searched_is_named_and_the_rest_is_done() {
        let folder = Folder::with(&[("in/a.obj", TRIANGLE), ("in/deep/b.obj", TRIANGLE)]);
        symlink("nowhere", folder.path("in/notes")).unwrap();
        symlink("..", folder.path("in/deep/up")).unwrap();
        let run = folder.run("in -o out --report r.json").exits(0);
        let told = run.err();
        assert!(told.contains("in/notes: left out, a link that leads nowhere"), "{told}");
        assert!(told.contains("in/deep/up: left out, a link to a folder that it lies in"));
        assert_eq!(folder.json("r.json")["notes"].as_array().unwrap().len(), 2);
        assert!(folder.path("out/a.obj").exists() && folder.path("out/deep/b.obj").exists());

        symlink("nowhere", folder.path("in/gone.obj")).unwrap();
        let told = folder.run("in -o out").exits(1).err();
        assert!(told.contains("in/gone.obj: left out, a link that leads nowhere"), "{told}");
    }

    #[test]
    fn a_folder_that_may_not_be_read_is_named() {
        let folder = Folder::with(&[("in/a.obj", TRIANGLE), ("in/locked/b.obj", TRIANGLE)]);
        fs::set_permissions(folder.path(""), Permissions::from_mode(0o777)).unwrap();
        fs::set_permissions(folder.path("in/locked"), Permissions::from_mode(0o300)).unwrap();
        let mut command = folder.command();
        command.args(["in", "-o", "out"]);
        if fs::metadata(folder.path("")).unwrap().uid() == 0 {
            command.uid(NOBODY);
        }
        let run = Run(command.output().unwrap()).exits(1);
        fs::set_permissions(folder.path("in/locked"), Permissions::from_mode(0o700)).unwrap();
        assert!(run.err().contains("in/locked: left out, cannot be read: "), "{}", run.err());
        assert!(folder.path("out/a.obj").exists());
    }

    #[test]
    fn escape_bytes_do_not_reach_the_terminal() {
        let folder = Folder::with(&[("in/a.obj", TRIANGLE)]);
        let name = OsStr::from_bytes(b"red\x1b[31m\x07\n.obj");
        fs::write(folder.path("in").join(name), TRIANGLE).unwrap();
        fs::write(folder.path("in").join(OsStr::from_bytes(b"bad\x1b[2J.obj")), "f 1 2 3").unwrap();
        let run = folder.run("in -o out").exits(1);
        let all = [run.0.stdout, run.0.stderr].concat();
        assert!(all.iter().all(|&byte| byte == b'\n' || byte >= b' '), "{all:?}");
        assert!(String::from_utf8_lossy(&all).contains(r"in/red\u{1b}[31m\u{7}\n.obj -> "));
    }

    fn resident_kilobytes(process: u32) -> usize {
        let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
        let line = status.lines().find(|line| line.starts_with("VmRSS")).unwrap();
        line.split_whitespace().nth(1).unwrap().parse().unwrap()
    }

    /// The first file is a pipe that says nothing. All other results wait for it to be told of.
    #[test]
    fn a_slow_file_does_not_hold_the_others_in_memory() {
        if !Path::new("/proc/self/status").exists() {
            eprintln!("SKIPPED: this system does not tell the memory of a process");
            return;
        }
        const FILES: usize = 60;
        let folder = Folder::with(&[]);
        let bytes = glb::encode("field", &shapes::cube_field(500), &[], &[]).unwrap();
        let mut names = vec!["slow.obj".to_owned()];
        for number in 0..FILES {
            names.push(format!("{number}.glb"));
            fs::write(folder.path(&names[number + 1]), &bytes).unwrap();
        }
        let pipe = folder.path("slow.obj");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let mut command = folder.command();
        command.args(&names).args(["-o", "out", "--verify", "fast", "--threads", "2"]);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let writer = fs::OpenOptions::new().write(true).open(&pipe).unwrap();
        let count = || fs::read_dir(folder.path("out")).map_or(0, |entries| entries.count());
        let wait = |files: usize| {
            while count() < files {
                std::thread::sleep(Duration::from_millis(10));
            }
            resident_kilobytes(child.id())
        };
        let (few, many) = (wait(FILES / 5), wait(FILES));
        drop(writer);
        child.wait().unwrap();
        eprintln!("{few} kB with {} files, {many} kB with {FILES}", FILES / 5);
        assert!(many < few + few / 2 + 20_000, "{few} kB, then {many} kB");
    }
}
