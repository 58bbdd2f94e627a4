//! The C# compiler and runtime, and the test program that they make.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::{env, fs};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The newest C# that `mcs` compiles without fail; Unity compiles newer.
const STRICT: [&str; 5] = [
    "-nologo",
    "-langversion:7.2",
    "-unsafe+",
    "-warnaserror",
    // Fields that only native code or the inspector sets.
    "-nowarn:649",
];
const EDITOR: &str = "UNITY_EDITOR";

/// The compiled tests, beside the assemblies and the native library that they need.
pub struct Program {
    folder: PathBuf,
}

impl Program {
    /// Runs the tests with arguments; returns what they printed.
    pub fn run(&self, arguments: &[&str]) -> String {
        let mut command = Command::new("mono");
        command.current_dir(&self.folder).arg("Chamfer.Tests.exe").args(arguments);
        let output = command.output().unwrap();
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        let complaint = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{printed}{complaint}");
        printed
    }
}

/// The test program, made once; none where there is no Mono and none can be installed.
pub fn program() -> Option<&'static Program> {
    static PROGRAM: LazyLock<Option<Program>> = LazyLock::new(|| {
        if is_there() || install() {
            return Some(compile_all());
        }
        skip("no Mono (mcs and mono), so the Unity package is untested");
        None
    });
    PROGRAM.as_ref()
}

/// Tells what is not tested, and not by eprintln, which the test runner keeps to itself.
pub fn skip(why: &str) {
    std::io::stderr().write_all(format!("SKIPPED: {why}\n").as_bytes()).unwrap();
}

fn is_there() -> bool {
    let runs =
        |name| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success());
    runs("mcs") && runs("mono")
}

/// Tries Debian's packages, which need the rights of root.
fn install() -> bool {
    let packages = ["install", "-y", "--no-install-recommends", "mono-mcs", "mono-runtime"];
    let apt = |arguments: &[&str]| {
        Command::new("apt-get").args(arguments).output().is_ok_and(|o| o.status.success())
    };
    (apt(&packages) || apt(&["update"]) && apt(&packages)) && is_there()
}

fn compile_all() -> Program {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("unity");
    fs::create_dir_all(&folder).unwrap();
    let unity = ["UnityStandIns.dll"];
    let runtime = ["UnityStandIns.dll", "Chamfer.Runtime.dll"];
    let all = ["UnityStandIns.dll", "Chamfer.Runtime.dll", "Chamfer.Editor.dll", "System.Core.dll"];
    compile(&folder, "UnityStandIns.dll", "tests/unity/standins", EDITOR, &[]);
    compile(&folder, "Chamfer.Runtime.dll", "unity-package/Runtime", EDITOR, &unity);
    compile(&folder, "Chamfer.Editor.dll", "unity-package/Editor", EDITOR, &runtime);
    compile(&folder, "Chamfer.Tests.exe", "tests/unity/tests", EDITOR, &all);
    // Samples are copied into projects, where they see what is public only.
    compile(&folder, "Samples.dll", "unity-package/Samples~", EDITOR, &runtime);
    for player in ["UNITY_STANDALONE", "UNITY_IOS"] {
        compile(&folder, "Player.dll", "unity-package/Runtime", player, &unity);
    }

    let library = format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}");
    let built = env::current_exe().unwrap().with_file_name(&library);
    fs::copy(&built, folder.join(&library)).expect("cargo puts the library beside its tests");
    Program { folder }
}

/// Compiles all C# files below a folder of this repository, with one symbol defined.
fn compile(folder: &Path, assembly: &str, sources: &str, symbol: &str, references: &[&str]) {
    let kind = if assembly.ends_with(".exe") { "exe" } else { "library" };
    let mut mcs = Command::new("mcs");
    mcs.current_dir(folder).args(STRICT).arg(format!("-define:{symbol}"));
    mcs.args([format!("-target:{kind}"), format!("-out:{assembly}")]);
    mcs.args(references.iter().map(|name| format!("-r:{name}")));
    mcs.arg(format!("-recurse:{ROOT}/{sources}/*.cs"));
    let output = mcs.output().unwrap();
    assert!(output.status.success(), "{mcs:?}\n{}", String::from_utf8_lossy(&output.stderr));
}
