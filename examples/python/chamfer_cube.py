"""Chamfers a cube and tells what comes out."""

import numpy as np

import chamfer

# Each face has four vertices of its own, and so its own normals.
faces = []
for axis in range(3):
    for side in (-1, 1):
        for u, v in ((-1, -1), (1, -1), (-1, 1), (1, 1)):
            faces.append(np.roll([side, u * side, v], axis))
positions = np.array(faces, np.float32)
normals = np.zeros_like(positions)
normals[np.arange(24), np.arange(24) // 8] = positions[np.arange(24), np.arange(24) // 8]
triangles = np.concatenate([[[f, f + 1, f + 2], [f + 2, f + 1, f + 3]] for f in range(0, 24, 4)])

cube = chamfer.Mesh(positions, normals, [triangles])
result = chamfer.chamfer(cube, width=0.1, width_unit="mesh")

print(f"{len(result.mesh.positions)} vertices, {len(result.mesh.triangles)} triangles")
print(f"{result.totals.chamfered} of {result.totals.hard_edges} hard edges full")
