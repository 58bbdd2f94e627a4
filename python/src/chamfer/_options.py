"""The options, checked by name, type and range before the library sees them."""

from __future__ import annotations

import numbers
from typing import Any, Literal, Mapping, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import meant
from ._mesh import STREAMS

_WIDTH_UNITS = {"mesh": 0, "percent": 1}
_VERIFY = {"fast": 0, "full": 1, "seen": 2}
_SUBMESH_MODES, _SUBMESH_GIVEN = {"owner": 0, "own": 1}, 2
_WIDTH_MODES = {"offset": 0, "chord": 1, "depth": 2, "radius": 3}
_CONVEXITIES = {"both": 0, "convex": 1, "concave": 2}
_CHOICES = {
    "width_unit": _WIDTH_UNITS,
    "verify": _VERIFY,
    "width_mode": _WIDTH_MODES,
    "convexity": _CONVEXITIES,
}
#: The largest of each, in degrees.
_ANGLES = {"min_angle": 180.0, "max_angle": 180.0, "hard_angle": 90.0}
_MOST = 0xFFFFFFFF
# To the library, nothing is the default; this little is nothing.
_NOTHING = 1e-9


class Options(TypedDict, total=False):
    """How to chamfer a mesh. What is not given has its default."""

    width: float  #: the distance between an old edge and the pulled one; 0.5
    width_unit: Literal["percent", "mesh"]  #: "percent" of the largest side of the mesh's box, or its units
    least_breadth: float  #: share (0 to 1) of each face's breadth that stays; 0.2
    #: how far the widths of a chamfer are held to each other: 0 (each end has all that there is room
    #: for) to 1 (an edge has one width, on both sides); 0.5
    evenness: float
    #: "full": no part cuts through itself; "fast": that is not looked after; "seen": as full, and no
    #: light shows through that did not before
    verify: Literal["full", "fast", "seen"]
    #: where chamfers go: "owner", to the face beside them; "own", to a new submesh; or a submesh's number
    submesh: Union[Literal["owner", "own"], int]
    threads: int  #: 1; 0 for as many as there are cores; the result is the same
    #: what the width measures: "offset", from the old edge to the pulled one; "chord", across the chamfer;
    #: "depth", straight down from the old edge; "radius", of the circle that touches both faces
    width_mode: Literal["offset", "chord", "depth", "radius"]
    min_angle: float  #: degrees (0 to 180) by which the faces of an edge turn at least; 0, a flat surface
    max_angle: float  #: the same at most; 180, one folded back on itself
    #: "convex": only edges whose faces meet as those of a cube; "concave": as a wall and the floor
    convexity: Literal["both", "convex", "concave"]
    hard_angle: float  #: normals that differ by less are one: degrees up to 90, and above 0; 1
    #: 3 by 3, multiplied from the left: the space in which widths and angles are measured, such as
    #: a matrix from mesh to scene
    scale: ArrayLike
    segments: int  #: how many a chamfer has across, up to 32: 1 is flat, more are round; 1
    profile: float  #: how several segments are bent: 0 flat, 0.5 a circle, 1 the old edge; 0.5


def fill(struct: Any, options: Mapping[str, Any]) -> None:
    """Writes options into the struct of the library."""
    for name, value in options.items():
        if name in STREAMS:
            raise TypeError(f"{name!r} is no option but a part of the mesh: chamfer.Mesh(..., {name}=...)")
        if name not in Options.__annotations__:
            raise TypeError(f"there is no option {name!r}: {meant(name, Options.__annotations__)}")
        if name == "submesh":
            struct.submesh_mode, struct.submesh = _submesh(value)
        elif name == "width":
            struct.width = number(name, value)
        elif name == "segments":
            struct.segments = _segments(name, value)
        elif name == "profile":
            struct.profile = number(name, value) or _NOTHING
        elif name in ("least_breadth", "evenness"):
            setattr(struct, name, number(name, value) or _NOTHING)
        elif name == "scale":
            struct.scale[:] = _columns(name, value)
        elif name in _ANGLES:
            setattr(struct, name, _angle(name, value))
        elif name == "threads":
            struct.threads = _count(name, value)
        else:
            setattr(struct, name, _choice(name, value, _CHOICES[name]))
    if struct.min_angle > struct.max_angle:
        raise ValueError(
            f"min_angle is {struct.min_angle:g}, larger than max_angle, {struct.max_angle:g}: no edge could be chamfered"
        )


def _submesh(value: Any) -> tuple[int, int]:
    if isinstance(value, str):
        return _choice("submesh", value, _SUBMESH_MODES), 0
    return _SUBMESH_GIVEN, _count("submesh", value)


def number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is a number, not {value!r}")
    return float(value)


def _segments(name: str, value: Any) -> int:
    segments = _count(name, value)
    if segments == 0:  # To the library, that is the default.
        raise ValueError(f"{name} is 0: give 1 to 32")
    return segments


def _angle(name: str, value: Any) -> float:
    degrees, most = number(name, value), _ANGLES[name]
    if not 0 <= degrees <= most or (name == "hard_angle" and degrees == 0):
        least = "above 0, up to" if name == "hard_angle" else "from 0 to"
        raise ValueError(f"{name} is {degrees:g}: give degrees {least} {most:g}")
    return degrees or (0.0 if name == "min_angle" else _NOTHING)


def _columns(name: str, value: Any) -> list[float]:
    """A matrix as the library has it, column by column."""
    matrix = _numbers(name, value)
    if matrix.shape != (3, 3):
        raise ValueError(f"{name} has the shape {matrix.shape}: it is 3 by 3")
    with np.errstate(over="ignore"):
        columns = matrix.astype(np.float32).T.ravel()
    if not np.isfinite(columns).all():
        raise ValueError(f"{name} is {matrix.tolist()}: give finite numbers")
    if not columns.any():  # To the library, zeros are the default.
        raise ValueError(f"{name} is all zeros, which flattens the mesh: give a matrix that can be inverted")
    return [float(entry) for entry in columns]


def _numbers(name: str, value: Any) -> NDArray[Any]:
    """What numpy makes of it, where that is numbers."""
    try:
        array = np.asarray(value)
    except ValueError:
        raise ValueError(f"{name} has rows of different lengths") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has values of type {array.dtype}: they are numbers")
    return array


def _count(name: str, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{name} is a whole number, not {value!r}")
    if not 0 <= int(value) <= _MOST:
        raise ValueError(f"{name} is {value}: it is not negative, and below 2**32")
    return int(value)


def _choice(name: str, value: Any, choices: Mapping[str, int]) -> int:
    if not isinstance(value, str):
        raise TypeError(f"{name} is one of {', '.join(choices)}, not {value!r}")
    if value not in choices:
        raise ValueError(f"{name} cannot be {value!r}: {meant(value, choices)}")
    return choices[value]
