"""The native library, and the structs of include/chamfer.h."""

from __future__ import annotations

import ctypes
import functools
import os
import sys
from ctypes import POINTER, c_char, c_char_p, c_float, c_int32, c_uint32, c_void_p, sizeof
from typing import Any

import numpy as np

ABI_VERSION = 1
UV_CHANNELS = 8
REASON_SLOTS = 16
FILES = {"win32": "chamfer.dll", "darwin": "libchamfer.dylib"}

#: The names of `outcome` in `VERDICT`.
OUTCOMES = ("full", "narrowed", "skipped")

#: A hard edge: its vertices in the source, its outcome, the reason (see `reason_name`), and the
#: width at each of its ends, and how many segments it has across.
VERDICT = np.dtype(
    [("vertices", "u4", 2), ("outcome", "u4"), ("reason", "u4"), ("widths", "f4", 2), ("segments", "u4")]
)
_BLEND = np.dtype([("vertices", "u4", 3), ("weights", "f4", 3)])
#: What a vertex is a blend of: `surface` in position, normal, skin and morph targets, `chart` in
#: colours, UVs and tangent, except for the UV channels in the bits `owner_channels`: `owner`. With
#: bit 31 the vertex is on a rounded chamfer: its blends do not rebuild its position and normal.
VERTEX_SOURCE = np.dtype(
    [("surface", _BLEND), ("chart", _BLEND), ("owner", _BLEND), ("owner_channels", "u4")]
)
#: `kind` 0: the source triangle `index`; 1: the chamfer of the hard edge `index`; 2: a fill of the
#: corner at the source vertex `index`.
TRIANGLE_SOURCE = np.dtype([("kind", "u4"), ("index", "u4")])

#: A listed edge, as the library reads it.
EDGE_FACTOR = np.dtype([("vertices", "u4", 2), ("factor", "f4")])


class COptions(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("width", c_float),
        ("width_unit", c_uint32),
        ("verify", c_uint32),
        ("submesh_mode", c_uint32),
        ("submesh", c_uint32),
        ("threads", c_uint32),
        ("least_breadth", c_float),
        ("width_mode", c_uint32),
        ("min_angle", c_float),
        ("max_angle", c_float),
        ("convexity", c_uint32),
        ("hard_angle", c_float),
        ("scale", c_float * 9),
        ("evenness", c_float),
        ("segments", c_uint32),
        ("profile", c_float),
    ]


class CUv(ctypes.Structure):
    _fields_ = [("components", c_uint32), ("values", POINTER(c_float))]


class CMesh(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("vertex_count", c_uint32),
        ("positions", POINTER(c_float)),
        ("normals", POINTER(c_float)),
        ("tangents", POINTER(c_float)),
        ("colors", POINTER(c_float)),
        ("uvs", CUv * UV_CHANNELS),
        ("submesh_count", c_uint32),
        ("index_count", c_uint32),
        ("submesh_index_counts", POINTER(c_uint32)),
        ("indices", POINTER(c_uint32)),
        ("held_count", c_uint32),
        ("held", POINTER(c_float)),
        ("submesh_factors", POINTER(c_float)),
        ("vertex_factors", POINTER(c_float)),
        ("edge_factor_count", c_uint32),
        ("edge_factors", c_void_p),
    ]


class CObject(ctypes.Structure):
    _fields_ = [("mesh", c_uint32), ("transform", c_float * 16)]


class CError(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("status", c_int32),
        ("element", c_uint32),
        ("message", c_char * 256),
        ("mesh", c_uint32),
    ]


class CTotals(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("hard_edges", c_uint32),
        ("chamfered", c_uint32),
        ("narrowed", c_uint32),
        ("skipped", c_uint32),
        ("width", c_float),
        ("mean_width", c_float),
        ("skipped_by_reason", c_uint32 * REASON_SLOTS),
    ]


CProgress = ctypes.CFUNCTYPE(c_int32, c_void_p, c_float)


def sized(kind: Any) -> Any:
    """A struct that says how long it is, as each must."""
    return kind(struct_size=sizeof(kind))


@functools.lru_cache(None)
def library() -> Any:
    """The library: what CHAMFER_LIBRARY names, or the one inside the package."""
    inside = os.path.join(os.path.dirname(__file__), FILES.get(sys.platform, "libchamfer.so"))
    path = os.environ.get("CHAMFER_LIBRARY") or inside
    try:
        # Windows finds a file by its whole path only.
        loaded = ctypes.CDLL(os.path.abspath(path))
    except OSError as error:
        raise ImportError(f"chamfer's native library does not load: {error}") from error
    loaded.chamfer_abi_version.restype = c_uint32
    found = loaded.chamfer_abi_version()
    if found != ABI_VERSION:
        raise ImportError(f"{path} has ABI version {found}, this package needs {ABI_VERSION}")
    _declare(loaded)
    return loaded


def _declare(c: Any) -> None:
    out, count = POINTER(c_void_p), POINTER(c_uint32)
    mesh, error, options = POINTER(CMesh), POINTER(CError), POINTER(COptions)
    c.chamfer_version_string.restype = c_char_p
    c.chamfer_reason_string.argtypes, c.chamfer_reason_string.restype = [c_uint32], c_char_p
    c.chamfer_status_string.argtypes, c.chamfer_status_string.restype = [c_int32], c_char_p
    c.chamfer_options_init.argtypes = [options]
    c.chamfer_run.argtypes = [mesh, options, CProgress, c_void_p, out, error]
    c.chamfer_scene_run.argtypes = [POINTER(mesh), c_uint32, POINTER(CObject), c_uint32]
    c.chamfer_scene_run.argtypes += [options, CProgress, c_void_p, out, error]
    c.chamfer_split_by_angle.argtypes = [mesh, c_float, out, error]
    c.chamfer_result_mesh.argtypes = [c_void_p, mesh]
    c.chamfer_result_totals.argtypes = [c_void_p, POINTER(CTotals)]
    for name in ("verdicts", "vertex_sources", "triangle_sources"):
        getattr(c, f"chamfer_result_{name}").argtypes = [c_void_p, out, count]
    c.chamfer_result_destroy.argtypes, c.chamfer_result_destroy.restype = [c_void_p], None


def library_version() -> str:
    """The version of the native library, such as "1.2.3"."""
    return str(library().chamfer_version_string().decode())


def reason_name(number: int) -> str:
    """The name of a verdict's reason, such as "no_room"; "none" where it is at full width."""
    return str(library().chamfer_reason_string(int(number)).decode())
