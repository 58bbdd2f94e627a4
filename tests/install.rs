//! The line that installs the command, against a release in a folder.
#![cfg(all(unix, any(target_os = "macos", target_arch = "x86_64")))]

use std::fs;
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/install.sh");
const PLATFORM: &str = if cfg!(target_os = "macos") { "macos" } else { "linux" };

fn empty(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn install(home: &Path, release: &Path) -> Output {
    let mut install = Command::new("sh");
    install.arg(SCRIPT).env("HOME", home).env_remove("CHAMFER_BIN");
    install.env("CHAMFER_ADDRESS", format!("file://{}", release.display())).output().unwrap()
}

/// A release whose command says hello, in an archive as the release workflow packs it.
fn release(folder: &Path) {
    let (content, download) = (folder.join("content"), folder.join("releases/latest/download"));
    fs::create_dir_all(&content).unwrap();
    fs::create_dir_all(&download).unwrap();
    for text in ["LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY.md"] {
        fs::write(content.join(text), text).unwrap();
    }
    fs::write(content.join("chamfer"), "#!/bin/sh\necho hello\n").unwrap();
    fs::set_permissions(content.join("chamfer"), fs::Permissions::from_mode(0o755)).unwrap();
    let archive = download.join(format!("chamfer-{PLATFORM}.tar.gz"));
    let tar =
        Command::new("tar").arg("-C").arg(&content).arg("-czf").arg(archive).arg(".").status();
    assert!(tar.unwrap().success());
}

#[test]
fn it_installs_the_command_or_says_why_not() {
    if Command::new("curl").arg("--version").output().is_err() {
        // Not by eprintln, which the test runner keeps to itself.
        let line = b"SKIPPED: no curl, so the line that installs the command is not tried\n";
        std::io::stderr().write_all(line).unwrap();
        return;
    }
    let (home, folder) = (empty("install_home"), empty("install_release"));
    let failed = install(&home, &folder);
    assert!(!failed.status.success() && !home.join(".local").exists());
    let told = String::from_utf8_lossy(&failed.stderr).into_owned();
    assert!(told.contains("was not installed") && told.contains("cannot be had"), "{told}");

    release(&folder);
    let done = install(&home, &folder);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let command = home.join(".local/bin/chamfer");
    assert!(String::from_utf8_lossy(&done.stdout).contains(&command.display().to_string()));
    assert_eq!(Command::new(command).output().unwrap().stdout, b"hello\n");
    assert!(home.join(".local/share/doc/chamfer/THIRD-PARTY.md").is_file());
}
