"""Meshes as numpy arrays, and as the library reads them."""

from __future__ import annotations

import numbers
from ctypes import POINTER, c_float, c_uint32
from typing import Any, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import meant
from ._library import EDGE_FACTOR, UV_CHANNELS, CMesh, sized

_FACTORS = ("submesh_factors", "vertex_factors", "edges")
STREAMS = ("positions", "normals", "submeshes", "tangents", "colors", "uvs", "held") + _FACTORS


class Mesh:
    """A triangle mesh with split vertices. What is None is absent.

    - `positions`: vertices by 3, in mesh units
    - `normals`: vertices by 3, of unit length; None only for `split_by_angle`
    - `submeshes`: a list of arrays of vertex indices, each triangles by 3; or one such array
    - `tangents`: vertices by 4: a unit vector and the handedness
    - `colors`: vertices by 4: red, green, blue, alpha
    - `uvs`: for each channel (0 to 7) that there is, vertices by 2 to 4
    - `held`: places by 7: from, to and radius of what rests on the mesh from outside
    - `submesh_factors`: for each submesh, how many times the width its chamfers get; 0 for none
    - `vertex_factors`: the same for each vertex: a mask
    - `edges`: the only ones that are chamfered: by 2, the vertices at their ends, or by 3, with a factor

    Results have no factors and nothing held.

    Anything that numpy takes for an array will do. It is checked when the mesh is chamfered.
    """

    positions: Any
    normals: Any
    submeshes: Any
    tangents: Any
    colors: Any
    uvs: Any
    held: Any
    submesh_factors: Any
    vertex_factors: Any
    edges: Any

    def __init__(
        self,
        positions: ArrayLike,
        normals: Optional[ArrayLike] = None,
        submeshes: Sequence[ArrayLike] | NDArray[Any] = (),
        *,
        tangents: Optional[ArrayLike] = None,
        colors: Optional[ArrayLike] = None,
        uvs: Optional[Mapping[int, ArrayLike]] = None,
        held: Optional[ArrayLike] = None,
        submesh_factors: Optional[ArrayLike] = None,
        vertex_factors: Optional[ArrayLike] = None,
        edges: Optional[ArrayLike] = None,
        **unknown: Any,
    ):
        for name in unknown:
            raise TypeError(f"a mesh has no {name!r}: {meant(name, STREAMS)}")
        self.positions, self.normals = positions, normals
        # An array of two dimensions is one submesh; of a list nobody can tell.
        self.submeshes = [submeshes] if isinstance(submeshes, np.ndarray) and submeshes.ndim == 2 else submeshes
        self.tangents, self.colors = tangents, colors
        self.uvs, self.held = {} if uvs is None else uvs, held
        self.submesh_factors, self.vertex_factors, self.edges = submesh_factors, vertex_factors, edges

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """The triangles of all submeshes, one submesh after the other: triangles by 3."""
        parts = [np.asarray(indices, np.uint32).reshape(-1, 3) for indices in self.submeshes]
        return np.concatenate(parts) if parts else np.empty((0, 3), np.uint32)

    def __repr__(self) -> str:
        counts = ", ".join(str(len(indices)) for indices in self.submeshes)
        return f"Mesh({len(self.positions)} vertices, triangles [{counts}], uvs {sorted(self.uvs)})"


class View:
    """A mesh as the library reads it. Holds the arrays that it points to."""

    def __init__(self, mesh: Mesh):
        if not isinstance(mesh, Mesh):
            raise TypeError(f"a chamfer.Mesh is wanted, not {type(mesh).__name__}")
        self._arrays: list[NDArray[Any]] = []
        self._vertices = _shape("positions", mesh.positions)[0]
        self.mesh = sized(CMesh)
        self.mesh.vertex_count = self._vertices
        for name, width in (("positions", 3), ("normals", 3), ("tangents", 4), ("colors", 4)):
            values = getattr(mesh, name)
            if values is not None:
                setattr(self.mesh, name, self._stream(name, values, (width,)))
        self._set_uvs(mesh.uvs)
        self._set_indices(mesh.submeshes)
        if mesh.held is not None and len(mesh.held):
            self.mesh.held_count = len(mesh.held)
            self.mesh.held = self._rows("held", mesh.held, len(mesh.held), (7,), "places")
        self._set_factors(mesh)

    def _set_uvs(self, uvs: Any) -> None:
        if not isinstance(uvs, Mapping):
            raise TypeError(f"uvs is a dict from channel to array, such as {{0: uv}}, not {type(uvs).__name__}")
        for channel, values in uvs.items():
            if not isinstance(channel, numbers.Integral) or not 0 <= int(channel) < UV_CHANNELS:
                raise ValueError(f"uvs has a channel {channel!r}: channels are 0 to {UV_CHANNELS - 1}")
            self.mesh.uvs[channel].values = self._stream(f"uvs[{channel}]", values, (2, 3, 4))
            self.mesh.uvs[channel].components = np.shape(values)[1]

    def _set_indices(self, submeshes: Any) -> None:
        checked = [_indices(number, part, self._vertices) for number, part in enumerate(submeshes)]
        counts = [part.size for part in checked]
        self.mesh.submesh_count = len(counts)
        self.mesh.index_count = sum(counts)
        self.mesh.submesh_index_counts = self._pointer(np.array(counts, np.uint32), c_uint32)
        joined = np.concatenate(checked, axis=None) if checked else np.empty(0)
        self.mesh.indices = self._pointer(joined.astype(np.uint32), c_uint32)

    def _set_factors(self, mesh: Mesh) -> None:
        counts = {"submesh": self.mesh.submesh_count, "vertex": self._vertices}
        for what, count in counts.items():
            name = f"{what}_factors"
            values = getattr(mesh, name)
            if values is not None:
                setattr(self.mesh, name, self._pointer(_factors(name, values, count, what), c_float))
        if mesh.edges is not None:
            listed = _edges(mesh.edges, self._vertices)
            self._arrays.append(listed)
            self.mesh.edge_factor_count, self.mesh.edge_factors = len(listed), listed.ctypes.data

    def _stream(self, name: str, values: Any, widths: tuple[int, ...]) -> Any:
        return self._rows(name, values, self._vertices, widths, "vertices")

    def _rows(self, name: str, values: Any, count: int, widths: tuple[int, ...], what: str) -> Any:
        """Checks a shape: the library has to trust the counts."""
        shape = _shape(name, values)
        if len(shape) != 2 or shape[0] != count or shape[1] not in widths:
            wanted = " or ".join(map(str, widths))
            raise ValueError(f"{name} has the shape {shape}: it is {count} {what} by {wanted}")
        kind = np.asarray(values).dtype
        if kind.kind not in "fiu":
            raise TypeError(f"{name} has values of type {kind}: they are numbers")
        with np.errstate(over="ignore"):  # The library tells where a value is too large.
            return self._pointer(np.asarray(values, np.float32), c_float)

    def _pointer(self, values: NDArray[Any], c_type: Any) -> Any:
        array = np.ascontiguousarray(values)
        self._arrays.append(array)
        return array.ctypes.data_as(POINTER(c_type))


def _shape(name: str, values: Any) -> tuple[int, ...]:
    try:
        shape: tuple[int, ...] = np.shape(values)
    except ValueError:
        raise ValueError(f"{name} has rows of different lengths") from None
    if not shape:
        raise TypeError(f"{name} is an array, not {values!r}")
    return shape


def _indices(number: int, part: Any, vertices: int) -> NDArray[Any]:
    """The triangles of one submesh, each index of which is that of a vertex."""
    name = f"submeshes[{number}]"
    shape = _shape(name, part)
    if 0 in shape:
        return np.empty((0, 3), np.uint32)
    if len(shape) != 2 or shape[1] != 3:
        raise ValueError(f"{name} has the shape {shape}: it is triangles by 3{_hint(shape)}")
    indices = np.asarray(part)
    if indices.dtype.kind not in "iu":
        raise TypeError(f"{name} has values of type {indices.dtype}: indices are whole numbers")
    wrong = np.argwhere((indices < 0) | (indices >= vertices))
    if len(wrong):
        triangle, corner = wrong[0]
        raise ValueError(
            f"{name}, triangle {triangle}: there is no vertex {indices[triangle, corner]} among {vertices}"
        )
    return indices


def _factors(name: str, values: Any, count: int, what: str) -> NDArray[Any]:
    """How many times the width: one for each of what there is."""
    shape = _shape(name, values)
    if shape != (count,):
        raise ValueError(f"{name} has the shape {shape}: it is one factor for each {what}, ({count},)")
    return _checked(name, np.asarray(values))


def _checked(name: str, factors: NDArray[Any]) -> NDArray[Any]:
    if factors.dtype.kind not in "fiu":
        raise TypeError(f"{name} has values of type {factors.dtype}: they are numbers")
    with np.errstate(over="ignore"):
        single = factors.astype(np.float32)
    wrong = np.flatnonzero(~(np.isfinite(single) & (single >= 0)))
    if len(wrong):
        raise ValueError(f"{name}[{wrong[0]}] has the factor {factors[wrong[0]]}: give finite ones of at least 0")
    return single


def _edges(values: Any, vertices: int) -> NDArray[Any]:
    """The listed edges, as the library reads them."""
    shape = _shape("edges", values)
    if shape == (0,):
        # Of a list of none, none is chamfered: to the library, there would be no list.
        return np.zeros(min(vertices, 1), EDGE_FACTOR)
    if len(shape) != 2 or shape[1] not in (2, 3):
        raise ValueError(f"edges has the shape {shape}: it is edges by 2, or by 3 with a factor each")
    rows = np.asarray(values)
    listed = np.zeros(max(len(rows), min(vertices, 1)), EDGE_FACTOR)
    listed["factor"][: len(rows)] = _checked("edges", rows[:, 2]) if shape[1] == 3 else 1
    ends = rows[:, :2]
    if ends.dtype.kind not in "fiu":
        raise TypeError(f"edges has values of type {ends.dtype}: they are numbers")
    wrong = np.argwhere(~((ends >= 0) & (ends < vertices) & (ends == np.floor(ends))))
    if len(wrong):
        edge, end = wrong[0]
        raise ValueError(f"edges[{edge}]: there is no vertex {ends[edge, end]} among {vertices}")
    listed["vertices"][: len(rows)] = ends
    return listed


def _hint(shape: tuple[int, ...]) -> str:
    if len(shape) == 1:
        return ". Reshape it with .reshape(-1, 3); where it is one triangle of a list, put that list into another"
    return ". Cut quads into triangles" if shape[1:] == (4,) else ""


def mesh_of(view: Any) -> Mesh:
    """A copy of what the library shows."""

    def stream(pointer: Any, *shape: int) -> Any:
        return np.ctypeslib.as_array(pointer, shape).copy() if pointer else None

    vertices = view.vertex_count
    counts = stream(view.submesh_index_counts, view.submesh_count)
    indices = stream(view.indices, view.index_count)
    if indices is None:
        indices = np.empty(0, np.uint32)
    parts = np.split(indices, np.cumsum(counts)[:-1]) if view.submesh_count else []
    positions = stream(view.positions, vertices, 3)
    return Mesh(
        np.empty((0, 3), np.float32) if positions is None else positions,
        stream(view.normals, vertices, 3),
        [part.reshape(-1, 3) for part in parts],
        tangents=stream(view.tangents, vertices, 4),
        colors=stream(view.colors, vertices, 4),
        uvs={n: stream(uv.values, vertices, uv.components) for n, uv in enumerate(view.uvs) if uv.components},
    )
