"""What can go wrong, and what names were meant."""

from __future__ import annotations

import difflib
from typing import Iterable

NO_ELEMENT = 0xFFFFFFFF
CANCELLED = 1
# From 100 on the call is wrong, from 200 on the mesh, from 300 on there is too little of something.
FIRST_OF_INPUT, FIRST_OF_RESOURCE = 100, 300


class ChamferError(Exception):
    """What went wrong, in one sentence.

    `status` is the number in docs/abi.md; `element` the number of the vertex, place in the indices,
    submesh or whatever that page says, or None; `mesh` that of the mesh of a scene, or None.
    """

    def __init__(self, status: int, message: str, element: int = NO_ELEMENT, mesh: int = NO_ELEMENT):
        super().__init__(message)
        self.status = status
        self.element = None if element == NO_ELEMENT else element
        self.mesh = None if mesh == NO_ELEMENT else mesh


class BadInput(ChamferError, ValueError):
    """The library found the mesh or an option to be wrong."""


class Cancelled(ChamferError):
    """The progress callback asked to stop."""


class NothingChamfered(UserWarning):
    """A mesh came back as it was; the text says why."""


def error_of(status: int, message: str, element: int = NO_ELEMENT, mesh: int = NO_ELEMENT) -> ChamferError:
    """The exception for a status of the library."""
    if status == CANCELLED:
        return Cancelled(status, message, element, mesh)
    kind = BadInput if FIRST_OF_INPUT <= status < FIRST_OF_RESOURCE else ChamferError
    return kind(status, message, element, mesh)


def meant(name: object, known: Iterable[str]) -> str:
    """The end of a message about an unknown name: what was meant, or else all that there is."""
    known = list(known)
    near = difflib.get_close_matches(str(name).lower(), known, 1)
    return f"did you mean {near[0]!r}?" if near else f"there is {', '.join(known)}"
