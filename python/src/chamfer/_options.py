"""The options, checked by name, type and range before the library sees them."""

from __future__ import annotations

import numbers
from typing import Any, Literal, Mapping, TypedDict, Union

from ._errors import meant

_WIDTH_UNITS = {"mesh": 0, "percent": 1}
_VERIFY = {"fast": 0, "full": 1, "seen": 2}
_SUBMESH_MODES, _SUBMESH_GIVEN = {"owner": 0, "own": 1}, 2
_MOST = 0xFFFFFFFF


class Options(TypedDict, total=False):
    """How to chamfer a mesh. What is not given has its default."""

    width: float  #: the distance between an old edge and the pulled one; 1
    width_unit: Literal["percent", "mesh"]  #: "percent" of the largest side of the mesh's box, or its units
    least_breadth: float  #: share (0 to 1) of each face's breadth that stays; 0.2
    #: "full": no part cuts through itself; "fast": that is not looked after; "seen": as full, and no
    #: light shows through that did not before
    verify: Literal["full", "fast", "seen"]
    #: where chamfers go: "owner", to the face beside them; "own", to a new submesh; or a submesh's number
    submesh: Union[Literal["owner", "own"], int]
    threads: int  #: 1; 0 for as many as there are cores; the result is the same


def fill(struct: Any, options: Mapping[str, Any]) -> None:
    """Writes options into the struct of the library."""
    for name, value in options.items():
        if name not in Options.__annotations__:
            raise TypeError(f"there is no option {name!r}: {meant(name, Options.__annotations__)}")
        if name == "submesh":
            struct.submesh_mode, struct.submesh = _submesh(value)
        elif name == "width":
            struct.width = number(name, value)
        elif name == "least_breadth":
            # To the library, nothing is the default; this little is nothing.
            struct.least_breadth = number(name, value) or 1e-9
        elif name == "threads":
            struct.threads = _count(name, value)
        else:
            setattr(struct, name, _choice(name, value, _WIDTH_UNITS if name == "width_unit" else _VERIFY))


def _submesh(value: Any) -> tuple[int, int]:
    if isinstance(value, str):
        return _choice("submesh", value, _SUBMESH_MODES), 0
    return _SUBMESH_GIVEN, _count("submesh", value)


def number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} is a number, not {value!r}")
    return float(value)


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
