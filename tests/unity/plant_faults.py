#!/usr/bin/env python3
"""Plants small faults in copies of the Unity package and counts those that its tests notice.

usage: tests/unity/plant_faults.py [WORD..]

Needs Mono (mcs and mono), and the library that `cargo test --test unity` builds. With words, only
faults whose name or file has one of them are planted. Each fault is a text that stands exactly once
in a file of the package, and what it becomes. Ends with 0 if at least nine in ten are noticed.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SYMBOLS = ";".join(["UNITY_EDITOR"] + [f"UNITY_{v}_OR_NEWER" for v in ("2021_3", "2022_3", "2023_1", "6000_0", "6000_2")])
LEAST_SHARE = 0.9
# A fault may make a test run for ever.
SECONDS = 120


def load_faults():
    """Each fault of faults.txt: its name, its file, the text that goes and the text that comes."""
    faults = []
    for block in (Path(__file__).parent / "faults.txt").read_text().split("\n\n"):
        lines = [line for line in block.strip("\n").split("\n") if not line.startswith("#")]
        if lines != [""] and lines:
            name, file, old, new = lines
            faults.append((name, file, old, "" if new == "(nothing)" else new))
    return faults


def compile_assembly(folder, assembly, sources, references, unsafe):
    kind = "exe" if assembly.endswith(".exe") else "library"
    command = ["mcs", "-nologo", "-langversion:7.2", "-nowarn:649,162,169,219,414", f"-define:{SYMBOLS}"]
    command += [f"-target:{kind}", f"-out:{assembly}", "-unsafe+" if unsafe else "-unsafe-"]
    command += [f"-r:{reference}" for reference in references] + [f"-recurse:{sources}/*.cs"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    return done.returncode == 0 or done.stdout + done.stderr


def compile_package(folder, package, runtime=True):
    unity = ["UnityStandIns.dll"]
    if runtime:
        compiled = compile_assembly(folder, "Chamfer.Runtime.dll", package / "Runtime", unity, True)
        if compiled is not True:
            return compiled
    references = unity + ["Chamfer.Runtime.dll", "System.Core.dll"]
    return compile_assembly(folder, "Chamfer.Editor.dll", package / "Editor", references, False)


def run_tests(folder):
    """The first line that a failing run prints; None if all tests pass."""
    command = ["mono", "Chamfer.Tests.exe", "first"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return "ran for ever"
    return None if done.returncode == 0 else (done.stdout + done.stderr).split("\n")[0]


def prepare(folder):
    libraries = sorted((ROOT / "target/debug/deps").glob("libchamfer.*"), key=lambda path: path.stat().st_mtime)
    for library in libraries:
        if library.suffix in (".so", ".dylib"):
            shutil.copy(library, folder)
    references = ["UnityStandIns.dll", "Chamfer.Runtime.dll", "Chamfer.Editor.dll", "System.Core.dll"]
    tests = ROOT / "tests/unity"
    # Whoever works on meanwhile does not get in the way.
    shutil.copytree(ROOT / "unity-package", folder / "original")
    steps = [
        lambda: compile_assembly(folder, "UnityStandIns.dll", tests / "standins", [], True),
        lambda: compile_package(folder, folder / "original"),
        lambda: compile_assembly(folder, "Chamfer.Package.Tests.dll", ROOT / "unity-package/Tests", references, False),
        lambda: compile_assembly(folder, "Chamfer.Tests.exe", tests / "tests", references + ["Chamfer.Package.Tests.dll"], True),
    ]
    for step in steps:
        result = step()
        if result is not True:
            sys.exit(f"the package as it is does not compile:\n{result}")
    shutil.copy(folder / "Chamfer.Runtime.dll", folder / "Original.Runtime.dll")
    failure = run_tests(folder)
    if failure:
        sys.exit(f"the package as it is fails its tests: {failure}")


def plant(folder, fault):
    """What became of a fault: noticed or not, or why it is none."""
    name, file, old, new = fault
    package = folder / "package"
    shutil.rmtree(package, ignore_errors=True)
    shutil.copytree(folder / "original", package)
    text = (package / file).read_text()
    if text.count(old) != 1:
        return f"stands {text.count(old)} times in the file", None
    (package / file).write_text(text.replace(old, new))
    # The runtime is compiled for faults in it, and is as it was for the others.
    is_in_runtime = file.startswith("Runtime/")
    compiled = compile_package(folder, package, is_in_runtime)
    if compiled is not True:
        shutil.copy(folder / "Original.Runtime.dll", folder / "Chamfer.Runtime.dll")
        return "does not compile: " + compiled.split("\n")[0], None
    failure = run_tests(folder)
    if is_in_runtime:
        shutil.copy(folder / "Original.Runtime.dll", folder / "Chamfer.Runtime.dll")
    return failure or "NOT NOTICED", failure is not None


def main():
    faults = load_faults()
    words = sys.argv[1:]
    if words:
        faults = [f for f in faults if any(word in f[0] or word in f[1] for word in words)]
    noticed, bad = 0, 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        prepare(folder)
        for fault in faults:
            what, is_noticed = plant(folder, fault)
            noticed += is_noticed is True
            bad += is_noticed is None
            print(f"{'ok ' if is_noticed else '-- '} {fault[0]} ({fault[1]}): {what[:120]}", flush=True)
    print(f"{noticed} of {len(faults)} faults noticed")
    return 0 if not bad and noticed >= LEAST_SHARE * len(faults) else 1


if __name__ == "__main__":
    sys.exit(main())
