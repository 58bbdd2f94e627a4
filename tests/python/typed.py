"""What a type checker makes of calls: each error that is ignored here has to be one."""

from __future__ import annotations

import numpy as np

import chamfer


def uses(positions: list[list[float]], triangles: np.ndarray[tuple[int, int], np.dtype[np.int64]]) -> float:
    mesh = chamfer.Mesh(positions, None, [triangles], uvs={0: positions})
    result = chamfer.chamfer(mesh, width=0.5, width_unit="mesh", progress=lambda done: done > 0.5)
    chamfer.chamfer(mesh, widht=0.5)  # type: ignore[call-arg]
    chamfer.chamfer(mesh, verify="fully")  # type: ignore[arg-type]
    chamfer.chamfer(mesh, submesh=1, threads=0)
    chamfer.chamfer(mesh, width_mode="chord", convexity="convex", min_angle=5, scale=np.eye(3))
    chamfer.chamfer(mesh, width_mode="cord")  # type: ignore[arg-type]
    chamfer.chamfer(mesh, max_angle="90")  # type: ignore[arg-type]
    chamfer.Mesh(positions, None, [triangles], submesh_factors=[1], vertex_factors=[1], edges=[(0, 1, 0.5)])
    [again] = chamfer.chamfer_scene([result.mesh], [(0, np.eye(4))], verify="seen")
    return again.totals.mean_width
