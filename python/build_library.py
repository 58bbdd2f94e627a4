"""Builds the native library for a wheel, and puts it inside.

CHAMFER_LIBRARY names one that is built already, and CHAMFER_WHEEL_PLATFORM what it runs on, such as
manylinux2014_x86_64: that is how a release makes its wheels. Without them it is built here, for here.
"""

import os
import platform
import subprocess
import sys
import sysconfig
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

NAMES = {"win32": "chamfer.dll", "darwin": "libchamfer.dylib"}


class LibraryHook(BuildHookInterface):
    PLUGIN_NAME = "custom"

    def initialize(self, version, build_data):
        library = os.environ.get("CHAMFER_LIBRARY") or build(Path(self.root).parent)
        runs_on = os.environ.get("CHAMFER_WHEEL_PLATFORM") or this_platform()
        # It is called through ctypes, so any Python will do.
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{runs_on}"
        inside = f"chamfer/{Path(library).name}"
        if version == "editable":
            # The module is read from its own folder then, so the library has to be there.
            inside = os.path.join(self.root, "src", inside)
            build_data["force_include_editable"] = {}
            Path(inside).write_bytes(Path(library).read_bytes())
        else:
            build_data["force_include"][os.path.abspath(library)] = inside


def this_platform():
    """As a wheel's name says it. On macOS, Python itself may be for more processors than the library."""
    if sys.platform == "darwin":
        return f"macosx_{platform.mac_ver()[0].split('.')[0]}_0_{platform.machine()}"
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")


def build(checkout):
    """The library as cargo builds it from the checkout that this folder is in."""
    command = ["cargo", "build", "--release", "--locked", "--package", "chamfer", "--lib"]
    if not (checkout / "Cargo.toml").is_file():
        sys.exit("the library's source is not here: build from a checkout of the repository")
    try:
        subprocess.run(command, cwd=checkout, check=True)
    except FileNotFoundError:
        sys.exit("building needs Rust (https://rustup.rs): there is no cargo on the path")
    target = Path(os.environ.get("CARGO_TARGET_DIR") or checkout / "target")
    return str(checkout / target / "release" / NAMES.get(sys.platform, "libchamfer.so"))
