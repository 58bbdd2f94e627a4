"""Chamfer for Python: meshes as numpy arrays, through the C interface of include/chamfer.h.

    library = chamfer.Library("target/release/libchamfer.so")
    result = library.chamfer(mesh, width=0.5)

Needs numpy, and nothing else: copy this file beside your tool. Arrays go in and come out as they
are in the header; the result's arrays are copies, so nothing has to be freed.
"""

import ctypes
import os
import sys
from ctypes import POINTER, byref, c_char, c_float, c_int32, c_uint32, c_void_p, sizeof
from dataclasses import dataclass, field

import numpy as np

ABI_VERSION = 1
UV_CHANNELS = 8
CANCELLED = 1
NO_ELEMENT = 0xFFFFFFFF

WIDTH_UNITS = {"mesh": 0, "percent": 1}
VERIFY = {"fast": 0, "full": 1, "seen": 2}
SUBMESH_MODES, SUBMESH_GIVEN = {"owner": 0, "own": 1}, 2
OUTCOMES = ("full", "narrowed", "skipped")


class ChamferError(Exception):
    """What went wrong, in one sentence; `status`, `element` and `mesh` are those of docs/abi.md."""

    def __init__(self, status, element, message, mesh=NO_ELEMENT):
        super().__init__(message)
        self.status = status
        self.element = None if element == NO_ELEMENT else element
        self.mesh = None if mesh == NO_ELEMENT else mesh


class Cancelled(ChamferError):
    """The progress callback asked to stop."""


@dataclass
class Mesh:
    """A triangle mesh with split vertices. Streams that are None are absent."""

    positions: np.ndarray  # vertices by 3, float32, in mesh units
    normals: np.ndarray  # vertices by 3, float32, unit length; None only for split_by_angle
    submeshes: list  # of arrays of vertex indices, triangles by 3, uint32
    tangents: np.ndarray = None  # vertices by 4: a unit vector and the handedness
    colors: np.ndarray = None  # vertices by 4: red, green, blue, alpha
    uvs: dict = field(default_factory=dict)  # channel (0 to 7): vertices by 2 to 4
    held: np.ndarray = None  # places by 7: from, to and radius of what rests on the mesh


@dataclass
class Options:
    """How to chamfer a mesh."""

    width: float = 1.0  # the distance between an old edge and the pulled one
    width_unit: str = "percent"  # of the largest side of the mesh's box, or "mesh" units
    least_breadth: float = 0.2  # share (0 to 1) of each face's breadth that stays
    verify: str = "full"  # or "fast": then a part may cut through itself; "seen": no light shows
    submesh: object = "owner"  # of the face beside a chamfer; "own": a new one; or a number
    threads: int = 1  # 0 for as many as there are cores; the result is the same

    def fill(self, options):
        """Writes them into the struct of the library."""
        options.width, options.threads = self.width, self.threads
        # To the library, nothing is the default; this little is nothing.
        options.least_breadth = self.least_breadth or 1e-9
        options.width_unit = WIDTH_UNITS[self.width_unit]
        options.verify = VERIFY[self.verify]
        if self.submesh in SUBMESH_MODES:
            options.submesh_mode = SUBMESH_MODES[self.submesh]
        else:
            options.submesh_mode, options.submesh = SUBMESH_GIVEN, self.submesh


@dataclass
class Result:
    """A chamfered mesh, where its elements came from, and what became of each hard edge."""

    mesh: Mesh
    totals: dict
    verdicts: np.ndarray  # one for each hard edge: see VERDICT
    vertex_sources: np.ndarray  # one for each vertex: see VERTEX_SOURCE
    triangle_sources: np.ndarray  # one for each triangle: see TRIANGLE_SOURCE


class _Options(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("width", c_float),
        ("width_unit", c_uint32),
        ("verify", c_uint32),
        ("submesh_mode", c_uint32),
        ("submesh", c_uint32),
        ("threads", c_uint32),
        ("least_breadth", c_float),
    ]


class _Uv(ctypes.Structure):
    _fields_ = [("components", c_uint32), ("values", POINTER(c_float))]


class _Mesh(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("vertex_count", c_uint32),
        ("positions", POINTER(c_float)),
        ("normals", POINTER(c_float)),
        ("tangents", POINTER(c_float)),
        ("colors", POINTER(c_float)),
        ("uvs", _Uv * UV_CHANNELS),
        ("submesh_count", c_uint32),
        ("index_count", c_uint32),
        ("submesh_index_counts", POINTER(c_uint32)),
        ("indices", POINTER(c_uint32)),
        ("held_count", c_uint32),
        ("held", POINTER(c_float)),
    ]


class _Object(ctypes.Structure):
    _fields_ = [("mesh", c_uint32), ("transform", c_float * 16)]


class _Error(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("status", c_int32),
        ("element", c_uint32),
        ("message", c_char * 256),
        ("mesh", c_uint32),
    ]


class _Totals(ctypes.Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("hard_edges", c_uint32),
        ("chamfered", c_uint32),
        ("narrowed", c_uint32),
        ("skipped", c_uint32),
        ("width", c_float),
        ("mean_width", c_float),
        ("skipped_by_reason", c_uint32 * 16),
    ]


VERDICT = np.dtype(
    [("vertices", "u4", 2), ("outcome", "u4"), ("reason", "u4"), ("widths", "f4", 2)]
)
BLEND = np.dtype([("vertices", "u4", 3), ("weights", "f4", 3)])
VERTEX_SOURCE = np.dtype(
    [("surface", BLEND), ("chart", BLEND), ("owner", BLEND), ("owner_channels", "u4")]
)
TRIANGLE_SOURCE = np.dtype([("kind", "u4"), ("index", "u4")])

_Progress = ctypes.CFUNCTYPE(c_int32, c_void_p, c_float)


class Library:
    """The library, loaded once. Any number of threads may use it."""

    def __init__(self, path=None):
        """Loads a file: `path`, or what CHAMFER_LIBRARY names, or the one beside this module."""
        path = os.fspath(path or _default_path())
        # Windows finds a file by its whole path only; a bare name is the system's to find.
        self._c = ctypes.CDLL(os.path.abspath(path) if os.path.exists(path) else path)
        self._declare()
        found = self._c.chamfer_abi_version()
        if found != ABI_VERSION:
            raise ImportError(f"the library has ABI version {found}, this module {ABI_VERSION}")

    def chamfer(self, mesh, progress=None, **options):
        """Chamfers all hard edges of a mesh.

        The options are those of `Options`. `progress` is called with the share done, 0 to 1; when
        it returns True, or raises, the call ends: with Cancelled, or with that exception.
        """
        view = _View(mesh)
        [result] = self._run(self._c.chamfer_run, byref(view.mesh), progress, options)
        return result

    def chamfer_scene(self, meshes, objects, progress=None, **options):
        """Chamfers meshes that stand together, so that none loses what another rests on.

        `objects` are pairs: the number of a mesh, and a matrix of 4 by 4 from mesh to scene that
        is multiplied from the left. One mesh may be in several. All else is as for `chamfer`; with
        verify="seen", it is the scene through which no light shows. Returns a result for each mesh.
        """
        views = [_View(mesh) for mesh in meshes]
        pointers = (POINTER(_Mesh) * len(views))(*(ctypes.pointer(view.mesh) for view in views))
        placed = (_Object * len(objects))(*(_object_of(*one) for one in objects))

        def run(_, options, callback, user, out, error):
            counted = (pointers, len(views), placed, len(placed))
            return self._c.chamfer_scene_run(*counted, options, callback, user, out, error)

        return self._run(run, None, progress, options, len(views))

    def split_by_angle(self, mesh, degrees):
        """The mesh with normals by smoothing angle, its vertices split where they differ."""
        view = _View(mesh)
        [result] = self._results(
            lambda out, error: self._c.chamfer_split_by_angle(
                byref(view.mesh), degrees, out, error
            )
        )
        return result.mesh

    def reason(self, number):
        """The name of a verdict's reason."""
        return self._c.chamfer_reason_string(number).decode()

    def _declare(self):
        c, out, count = self._c, POINTER(c_void_p), POINTER(c_uint32)
        mesh, error, options = POINTER(_Mesh), POINTER(_Error), POINTER(_Options)
        c.chamfer_abi_version.restype = c_uint32
        c.chamfer_reason_string.argtypes = [c_uint32]
        c.chamfer_reason_string.restype = ctypes.c_char_p
        c.chamfer_status_string.argtypes = [c_int32]
        c.chamfer_status_string.restype = ctypes.c_char_p
        c.chamfer_options_init.argtypes = [options]
        c.chamfer_run.argtypes = [mesh, options, _Progress, c_void_p, out, error]
        c.chamfer_scene_run.argtypes = [POINTER(mesh), c_uint32, POINTER(_Object), c_uint32]
        c.chamfer_scene_run.argtypes += [options, _Progress, c_void_p, out, error]
        c.chamfer_split_by_angle.argtypes = [mesh, c_float, out, error]
        c.chamfer_result_mesh.argtypes = [c_void_p, mesh]
        c.chamfer_result_totals.argtypes = [c_void_p, POINTER(_Totals)]
        for name in ("verdicts", "vertex_sources", "triangle_sources"):
            getattr(c, f"chamfer_result_{name}").argtypes = [c_void_p, out, count]
        c.chamfer_result_destroy.argtypes = [c_void_p]
        c.chamfer_result_destroy.restype = None

    def _check(self, status):
        if status != 0:
            raise ChamferError(status, NO_ELEMENT, self._c.chamfer_status_string(status).decode())

    def _raise_for(self, status, error):
        if status != 0:
            kind = Cancelled if status == CANCELLED else ChamferError
            raise kind(status, error.element, error.message.decode(), error.mesh)

    def _run(self, function, source, progress, wishes, count=1):
        options = _sized(_Options)
        self._check(self._c.chamfer_options_init(byref(options)))
        Options(**wishes).fill(options)
        callback, raised = _callback(progress)
        try:
            return self._results(
                lambda out, error: function(source, byref(options), callback, None, out, error),
                count,
            )
        except Cancelled:
            if raised:
                raise raised[0]
            raise

    def _results(self, call, count=1):
        """Calls what makes results, copies all that they hold, and frees them."""
        results, error = (c_void_p * count)(), _sized(_Error)
        self._raise_for(call(results, byref(error)), error)
        try:
            return [self._copy(result) for result in results]
        finally:
            for result in results:
                self._c.chamfer_result_destroy(result)

    def _copy(self, result):
        mesh, totals = _sized(_Mesh), _sized(_Totals)
        self._check(self._c.chamfer_result_mesh(result, byref(mesh)))
        self._check(self._c.chamfer_result_totals(result, byref(totals)))
        return Result(
            _mesh_of(mesh),
            _totals_of(totals),
            self._records(result, "verdicts", VERDICT),
            self._records(result, "vertex_sources", VERTEX_SOURCE),
            self._records(result, "triangle_sources", TRIANGLE_SOURCE),
        )

    def _records(self, result, name, dtype):
        start, count = c_void_p(), c_uint32()
        view = getattr(self._c, f"chamfer_result_{name}")
        self._check(view(result, byref(start), byref(count)))
        if not count.value:
            return np.empty(0, dtype)
        return np.frombuffer(ctypes.string_at(start, count.value * dtype.itemsize), dtype)


class _View:
    """A mesh as the library reads it. Holds the arrays that it points to."""

    def __init__(self, mesh):
        self.arrays = []
        counts = [np.size(indices) for indices in mesh.submeshes]
        indices = [np.asarray(indices).reshape(-1) for indices in mesh.submeshes]
        vertices = len(mesh.positions)
        self.mesh = _sized(_Mesh)
        self.mesh.vertex_count = vertices
        self.mesh.positions = self._floats("positions", mesh.positions, vertices, (3,))
        self.mesh.normals = self._floats("normals", mesh.normals, vertices, (3,))
        self.mesh.tangents = self._floats("tangents", mesh.tangents, vertices, (4,))
        self.mesh.colors = self._floats("colors", mesh.colors, vertices, (4,))
        for channel, values in mesh.uvs.items():
            uv = self.mesh.uvs[channel]
            uv.values = self._floats(f"uvs[{channel}]", values, vertices, (2, 3, 4))
            uv.components = np.shape(values)[1]
        self.mesh.submesh_count = len(counts)
        self.mesh.index_count = sum(counts)
        self.mesh.submesh_index_counts = self._pointer(counts, np.uint32, c_uint32)
        self.mesh.indices = self._pointer(
            np.concatenate(indices) if indices else [], np.uint32, c_uint32
        )
        if mesh.held is not None and len(mesh.held):
            self.mesh.held_count = len(mesh.held)
            self.mesh.held = self._rows("held", mesh.held, len(mesh.held), (7,), "places")

    def _floats(self, name, values, vertices, widths):
        if values is None:
            return None
        return self._rows(name, values, vertices, widths, "vertices")

    def _rows(self, name, values, count, widths, what):
        """Checks a shape: the library has to trust the counts."""
        shape = np.shape(values)
        if len(shape) != 2 or shape[0] != count or shape[1] not in widths:
            wanted = " or ".join(map(str, widths))
            raise ValueError(f"{name}: {shape} is not {count} {what} by {wanted}")
        return self._pointer(values, np.float32, c_float)

    def _pointer(self, values, dtype, c_type):
        array = np.ascontiguousarray(values, dtype)
        self.arrays.append(array)
        return array.ctypes.data_as(POINTER(c_type))


def _sized(kind):
    return kind(struct_size=sizeof(kind))


def _object_of(mesh, matrix):
    columns = np.asarray(matrix, np.float32).T
    if columns.shape != (4, 4):
        raise ValueError(f"an object's matrix is 4 by 4, not {columns.shape}")
    return _Object(mesh, (c_float * 16)(*columns.flat))


def _callback(progress):
    """The C callback, and a list that holds what the Python one raised."""
    raised = []

    def step(_user, done):
        try:
            return 1 if progress(done) else 0
        except BaseException as error:  # An exception must not cross the C border.
            raised.append(error)
            return 1

    return (_Progress(step) if progress else _Progress()), raised


def _mesh_of(mesh):
    def stream(pointer, *shape):
        return np.ctypeslib.as_array(pointer, shape).copy() if pointer else None

    vertices = mesh.vertex_count
    counts = stream(mesh.submesh_index_counts, mesh.submesh_count)
    indices = stream(mesh.indices, mesh.index_count)
    ends = np.cumsum(counts)[:-1] if mesh.submesh_count else []
    return Mesh(
        stream(mesh.positions, vertices, 3),
        stream(mesh.normals, vertices, 3),
        [part.reshape(-1, 3) for part in np.split(indices, ends)] if mesh.index_count else [],
        stream(mesh.tangents, vertices, 4),
        stream(mesh.colors, vertices, 4),
        {
            channel: stream(uv.values, vertices, uv.components)
            for channel, uv in enumerate(mesh.uvs)
            if uv.components
        },
    )


def _totals_of(totals):
    names = [name for name, *_ in _Totals._fields_[1:]]
    values = {name: getattr(totals, name) for name in names}
    return {**values, "skipped_by_reason": list(totals.skipped_by_reason)}


def _default_path():
    names = {"win32": "chamfer.dll", "darwin": "libchamfer.dylib"}
    beside = os.path.join(os.path.dirname(__file__), names.get(sys.platform, "libchamfer.so"))
    return os.environ.get("CHAMFER_LIBRARY", beside)
