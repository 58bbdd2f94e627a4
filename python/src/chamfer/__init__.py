"""Softens all hard edges of triangle meshes automatically: numpy arrays in and out.

    import chamfer

    mesh = chamfer.split_by_angle(chamfer.Mesh(positions, None, [triangles]), degrees=30)
    result = chamfer.chamfer(mesh, width=0.5)
    result.mesh.positions, result.mesh.normals, result.mesh.triangles

A mesh has split vertices, as game engines draw them: a hard edge is where two vertices stand at one
place with two normals. Meshes without normals get them by `split_by_angle`. All arrays that come out
are copies of their own. Any number of threads may call at once.
"""

from ._errors import BadInput, Cancelled, ChamferError, NothingChamfered
from ._library import OUTCOMES, TRIANGLE_SOURCE, VERDICT, VERTEX_SOURCE, library_version, reason_name
from ._mesh import Mesh
from ._options import Options
from ._run import Result, Totals, chamfer, chamfer_scene, split_by_angle

__all__ = [
    "OUTCOMES",
    "TRIANGLE_SOURCE",
    "VERDICT",
    "VERTEX_SOURCE",
    "BadInput",
    "Cancelled",
    "ChamferError",
    "Mesh",
    "NothingChamfered",
    "Options",
    "Result",
    "Totals",
    "chamfer",
    "chamfer_scene",
    "library_version",
    "reason_name",
    "split_by_angle",
]


def __getattr__(name: str) -> str:
    # Asked for when it is: the library is loaded with the first call that needs it.
    if name == "__version__":
        return library_version()
    raise AttributeError(f"module 'chamfer' has no attribute {name!r}")
