"""The calls of the library, and what comes out of them."""

from __future__ import annotations

import ctypes
import warnings
from ctypes import POINTER, byref, c_float, c_uint32, c_void_p
from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Callable, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _library
from ._errors import NothingChamfered, error_of
from ._library import CError, CMesh, CObject, COptions, CProgress, CTotals, library, reason_name, sized
from ._mesh import Mesh, View, mesh_of
from ._options import Options, fill, number

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: Told the share done, 0 to 1. The call ends when it returns something true, or raises.
Progress = Callable[[float], object]


@dataclass(frozen=True)
class Totals:
    """How many hard edges became what."""

    hard_edges: int
    chamfered: int  #: at full width
    narrowed: int
    skipped: int
    width: float  #: that was asked for, in mesh units
    mean_width: float  #: of the hard edges by length, as a share (0 to 1) of the one asked for
    skipped_by_reason: dict[str, int]


@dataclass(frozen=True, repr=False)
class Result:
    """A chamfered mesh, where its elements came from, and what became of each hard edge."""

    mesh: Mesh
    totals: Totals
    verdicts: NDArray[Any]  #: one for each hard edge: see VERDICT
    vertex_sources: NDArray[Any]  #: one for each vertex: see VERTEX_SOURCE
    triangle_sources: NDArray[Any]  #: one for each triangle: see TRIANGLE_SOURCE

    def carry(self, values: ArrayLike) -> NDArray[Any]:
        """Values of the source's vertices (vertices, or by anything), blended for those of the result."""
        given, surface = np.atleast_1d(values), self.vertex_sources["surface"]
        weights = surface["weights"].reshape(surface["weights"].shape + (1,) * (given.ndim - 1))
        if surface.size and surface["vertices"].max() >= len(given):
            raise ValueError(f"values has {len(given)} rows: give one for each vertex of the source")
        blended: NDArray[Any] = (given[surface["vertices"]] * weights).sum(axis=1)
        return blended

    def __repr__(self) -> str:
        return f"Result({self.mesh!r}, {self.totals!r})"


def chamfer(mesh: Mesh, *, progress: Optional[Progress] = None, **options: Unpack[Options]) -> Result:
    """Chamfers all hard edges of a mesh, by the options that `Options` lists.

    `progress` is called with the share done, 0 to 1; when it returns something true, or raises, the
    call ends: with `Cancelled`, or with that exception.

    Raises TypeError and ValueError for what is wrong with the mesh or an option, and ChamferError for
    the rest; what the library finds wrong with a mesh is a BadInput, which is both. Warns with
    NothingChamfered where all stays as it was.
    """
    view = View(mesh)
    [result] = _run(library().chamfer_run, (byref(view.mesh),), progress, options)
    return result


def chamfer_scene(
    meshes: Sequence[Mesh],
    objects: Sequence[tuple[int, ArrayLike]],
    *,
    progress: Optional[Progress] = None,
    **options: Unpack[Options],
) -> list[Result]:
    """Chamfers meshes that stand together, so that none loses what another rests on.

    `objects` are pairs: the number of a mesh, and a matrix of 4 by 4 from mesh to scene that is
    multiplied from the left. One mesh may be in several. All else is as for `chamfer`; with
    verify="seen", it is the scene through which no light shows. Returns a result for each mesh.
    """
    views = [View(mesh) for mesh in meshes]
    pointers = (POINTER(CMesh) * len(views))(*(ctypes.pointer(view.mesh) for view in views))
    placed = (CObject * len(objects))(*(_object_of(number, *pair) for number, pair in enumerate(objects)))
    source = (pointers, len(views), placed, len(placed))
    return _run(library().chamfer_scene_run, source, progress, options, len(views))


def split_by_angle(mesh: Mesh, degrees: float) -> Mesh:
    """The mesh with normals by smoothing angle, its vertices split where they differ.

    Faces joined by edges of at most that many degrees (0 to 180) shade as one surface. The normals
    that the mesh has are ignored.
    """
    view = View(Mesh(**{**vars(mesh), "normals": None}) if isinstance(mesh, Mesh) else mesh)
    split = library().chamfer_split_by_angle
    angle = number("degrees", degrees)
    [result] = _results(lambda out, error: split(byref(view.mesh), angle, out, error), 1)
    return result.mesh


def _run(
    function: Any,
    source: tuple[Any, ...],
    progress: Optional[Progress],
    options: Mapping[str, Any],
    count: int = 1,
) -> list[Result]:
    struct = sized(COptions)
    _require(library().chamfer_options_init(byref(struct)))
    fill(struct, options)
    raised: list[BaseException] = []
    callback = _callback(progress, raised)
    try:
        results = _results(lambda out, error: function(*source, byref(struct), callback, None, out, error), count)
    except Exception:
        if raised:
            raise raised[0] from None
        raise
    why = _why_untouched(results)
    if why:  # It points at the line that called chamfer or chamfer_scene.
        warnings.warn(why, NothingChamfered, stacklevel=3)
    return results


def _why_untouched(results: Sequence[Result]) -> Optional[str]:
    """Why nothing was chamfered, where that was not asked for."""
    totals = [result.totals for result in results]
    if any(total.chamfered + total.narrowed for total in totals):
        return None
    reasons = Counter[str]()
    for total in totals:
        reasons.update(total.skipped_by_reason)
    if reasons:
        listed = ", ".join(f"{count} {reason}" for reason, count in reasons.items())
        return None if "not_selected" in reasons else f"none of the hard edges is chamfered: {listed}"
    if not any(len(result.mesh.triangles) for result in results):
        return None
    return (
        "there are no hard edges: wherever faces meet, their normals are the same. Where the faces are not to "
        "look smooth, let chamfer.split_by_angle(mesh, 30) make the normals anew"
    )


def _callback(progress: Optional[Progress], raised: list[BaseException]) -> Any:
    if progress is None:
        return CProgress()
    if not callable(progress):
        raise TypeError(f"progress is a function of the share done, not {progress!r}")

    def step(_user: Any, done: float) -> int:
        try:
            return 1 if progress(done) else 0
        except BaseException as error:  # It must not cross the C border.
            raised.append(error)
            return 1

    return CProgress(step)


def _object_of(number: int, mesh: int, matrix: ArrayLike) -> Any:
    columns = np.asarray(matrix, np.float32).T
    if columns.shape != (4, 4):
        raise ValueError(f"objects[{number}] has a matrix of {columns.shape}: it is 4 by 4")
    if mesh < 0:
        raise ValueError(f"objects[{number}] is of mesh {mesh}: meshes count from 0")
    return CObject(mesh, (c_float * 16)(*columns.ravel().tolist()))


def _results(call: Callable[[Any, Any], int], count: int) -> list[Result]:
    """Calls what makes results, copies all that they hold, and frees them."""
    results, error = (c_void_p * count)(), sized(CError)
    status = call(results, byref(error))
    if status:
        raise error_of(status, error.message.decode(), error.element, error.mesh)
    try:
        return [_copy(result) for result in results]
    finally:
        for result in results:
            library().chamfer_result_destroy(result)


def _copy(result: Any) -> Result:
    mesh, totals = sized(CMesh), sized(CTotals)
    _require(library().chamfer_result_mesh(result, byref(mesh)))
    _require(library().chamfer_result_totals(result, byref(totals)))
    return Result(
        mesh_of(mesh),
        _totals_of(totals),
        _records(result, "verdicts", _library.VERDICT),
        _records(result, "vertex_sources", _library.VERTEX_SOURCE),
        _records(result, "triangle_sources", _library.TRIANGLE_SOURCE),
    )


def _totals_of(totals: Any) -> Totals:
    counts = {reason_name(n): count for n, count in enumerate(totals.skipped_by_reason) if count}
    names = ("hard_edges", "chamfered", "narrowed", "skipped", "width", "mean_width")
    return Totals(**{name: getattr(totals, name) for name in names}, skipped_by_reason=counts)


def _records(result: Any, name: str, dtype: np.dtype[Any]) -> NDArray[Any]:
    start, count = c_void_p(), c_uint32()
    view = getattr(library(), f"chamfer_result_{name}")
    _require(view(result, byref(start), byref(count)))
    if not count.value or not start.value:
        return np.empty(0, dtype)
    return np.frombuffer(bytearray(ctypes.string_at(start.value, count.value * dtype.itemsize)), dtype)


def _require(status: int) -> None:
    if status:
        raise error_of(status, library().chamfer_status_string(status).decode())
