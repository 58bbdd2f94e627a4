//! The C# compiler and runtime, and the test program that they make.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::{env, fs};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The newest C# that `mcs` compiles without fail; Unity compiles newer.
const STRICT: [&str; 4] = [
    "-nologo",
    "-langversion:7.2",
    "-warnaserror",
    // Fields that only native code or the inspector sets.
    "-nowarn:649",
];
/// The newest editor, and the oldest.
const EDITOR: &[&str] = &[
    "UNITY_EDITOR",
    "UNITY_2021_3_OR_NEWER",
    "UNITY_2022_3_OR_NEWER",
    "UNITY_2023_1_OR_NEWER",
    "UNITY_6000_0_OR_NEWER",
    "UNITY_6000_2_OR_NEWER",
    "UNITY_6000_3_OR_NEWER",
];
const OLDEST_EDITOR: &[&str] = &["UNITY_EDITOR", "UNITY_2021_3_OR_NEWER"];
/// What Unity defines for players that have no library of the package.
const NO_LIBRARY: [&str; 9] = [
    "UNITY_IOS",
    "UNITY_TVOS",
    "UNITY_VISIONOS",
    "UNITY_ANDROID",
    "UNITY_WEBGL",
    "UNITY_WSA",
    "UNITY_SWITCH",
    "UNITY_PS5",
    "UNITY_GAMECORE",
];
/// For whoever added a library of their own.
const ADDED: &str = "CHAMFER_LIBRARY";

/// The compiled tests, beside the assemblies and the native library that they need.
pub struct Program {
    folder: PathBuf,
}

impl Program {
    /// Runs the tests with arguments; returns what they printed.
    pub fn run(&self, arguments: &[&str]) -> String {
        self.run_program("Chamfer.Tests.exe", arguments)
    }

    /// The runtime assembly as a player for a platform has it.
    pub fn player(&self, symbols: &[&str]) -> Vec<u8> {
        let assembly = format!("Player.{}.dll", symbols.join("."));
        compile(&self.folder, &assembly, "unity-package/Runtime", symbols, &["UnityStandIns.dll"]);
        fs::read(self.folder.join(assembly)).unwrap()
    }

    /// What a program prints that chamfers in a player for a platform.
    pub fn chamfer_in_player(&self, symbol: &str) -> String {
        let folder = self.folder.join(symbol);
        fs::create_dir_all(&folder).unwrap();
        let unity = ["UnityStandIns.dll"];
        let player = ["UnityStandIns.dll", "Chamfer.Runtime.dll"];
        compile(&folder, "UnityStandIns.dll", "tests/unity/standins", EDITOR, &[]);
        compile(&folder, "Chamfer.Runtime.dll", "unity-package/Runtime", &[symbol], &unity);
        compile(&folder, "Player.exe", "tests/unity/player", &[symbol], &player);
        Program { folder }.run_program("Player.exe", &[])
    }

    fn run_program(&self, program: &str, arguments: &[&str]) -> String {
        let mut command = Command::new("mono");
        command.current_dir(&self.folder).arg(program).args(arguments);
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

/// The platforms that have no library of the package.
pub fn platforms_without_library() -> [&'static str; 9] {
    NO_LIBRARY
}

/// The symbols of a platform whose user added a library.
pub fn with_added_library(platform: &str) -> [&str; 2] {
    [platform, ADDED]
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

/// Tries Debian's packages, which need the rights of root, where whoever runs the tests asks for it.
fn install() -> bool {
    if env::var_os("CHAMFER_INSTALL").is_none() {
        return false;
    }
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
    let with_own = [&all[..], &["Chamfer.Package.Tests.dll"]].concat();
    compile(&folder, "Chamfer.Package.Tests.dll", "unity-package/Tests", EDITOR, &all);
    compile(&folder, "Chamfer.Tests.exe", "tests/unity/tests", EDITOR, &with_own);
    compile_for_oldest(&folder);
    // Samples are copied into projects, where they see what is public only.
    compile(&folder, "Samples.dll", "unity-package/Samples~", EDITOR, &runtime);

    let library = format!("{DLL_PREFIX}chamfer{DLL_SUFFIX}");
    let built = env::current_exe().unwrap().with_file_name(&library);
    fs::copy(&built, folder.join(&library)).expect("cargo puts the library beside its tests");
    Program { folder }
}

fn compile_for_oldest(folder: &Path) {
    let folder = folder.join("oldest");
    fs::create_dir_all(&folder).unwrap();
    let runtime = ["../UnityStandIns.dll", "Chamfer.Runtime.dll", "System.Core.dll"];
    compile(&folder, runtime[1], "unity-package/Runtime", OLDEST_EDITOR, &runtime[..1]);
    compile(&folder, "Chamfer.Editor.dll", "unity-package/Editor", OLDEST_EDITOR, &runtime);
}

/// Compiles all C# files below a folder of this repository, with symbols defined.
fn compile(folder: &Path, assembly: &str, sources: &str, symbols: &[&str], references: &[&str]) {
    let kind = if assembly.ends_with(".exe") { "exe" } else { "library" };
    let mut mcs = Command::new("mcs");
    mcs.current_dir(folder).args(STRICT).arg(format!("-define:{}", symbols.join(";")));
    // As the assembly definitions of the package say.
    mcs.arg(if assembly == "Chamfer.Editor.dll" { "-unsafe-" } else { "-unsafe+" });
    mcs.args([format!("-target:{kind}"), format!("-out:{assembly}")]);
    mcs.args(references.iter().map(|name| format!("-r:{name}")));
    mcs.arg(format!("-recurse:{ROOT}/{sources}/*.cs"));
    let output = mcs.output().unwrap();
    assert!(output.status.success(), "{mcs:?}\n{}", String::from_utf8_lossy(&output.stderr));
}
