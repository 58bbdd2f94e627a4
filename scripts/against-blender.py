"""Times this library against Blender's bevel: the same hard edges of the same cubes, in one run.

Run it by scripts/against-blender, which gets Blender as a Python module.
"""

import itertools
import statistics
import sys
import time

import bpy  # isort: skip: brings bmesh along
import bmesh
import numpy as np

import chamfer

ROUNDS = 5
WIDTH = 0.05

# Each face counter-clockwise seen from outside: four corners, of which each is a number of three bits.
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def cube_field(count):
    """Separate unit cubes: `#cubes by 8 by 3` corners."""
    corners = np.array([[bit >> k & 1 for k in range(3)] for bit in range(8)], np.float32)
    side = int(np.ceil(count ** (1 / 3)))
    places = itertools.islice(itertools.product(range(side), repeat=3), count)
    return np.array(list(places), np.float32)[:, None] * 2 + corners


def as_split(cubes):
    """As engines draw it: four vertices for each face, with its normal, and UVs with a seam at each edge."""
    faces = np.array(FACES)
    positions = cubes[:, faces].reshape(-1, 3)
    across = cubes[0, faces]
    normals = np.cross(across[:, 1] - across[:, 0], across[:, 3] - across[:, 0])
    normals = np.tile(np.repeat(normals, 4, 0), (len(cubes), 1)).astype(np.float32)
    square = np.array([[0, 0], [0, 1], [1, 1], [1, 0]], np.float32)
    atlas = np.concatenate([(square + [face, 0]) * [0.15, 0.9] + 0.01 for face in range(6)])
    uvs = np.tile(atlas, (len(cubes), 1)).astype(np.float32)
    first = np.arange(0, len(positions), 4)[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]], 1).reshape(-1, 3)
    return chamfer.Mesh(positions, normals, [triangles.astype(np.uint32)], uvs={0: uvs})


def as_welded(cubes):
    """As Blender wants it: eight vertices for each cube, the same triangles, and the edges to bevel."""
    mesh = bmesh.new()
    layer = mesh.loops.layers.uv.new()
    hard = []
    for cube in cubes:
        corners = [mesh.verts.new(corner) for corner in cube]
        for quad in FACES:
            a, b, c, d = (corners[k] for k in quad)
            for number, face in enumerate((mesh.faces.new((a, b, c)), mesh.faces.new((a, c, d)))):
                for place, loop in enumerate(face.loops):
                    loop[layer].uv = ((place + number) % 2, place % 2)
        pairs = itertools.combinations(range(8), 2)
        sides = [(one, other) for one, other in pairs if (one ^ other).bit_count() == 1]
        hard += [mesh.edges.get((corners[one], corners[other])) for one, other in sides]
    return mesh, hard


def blender_seconds(cubes):
    mesh, hard = as_welded(cubes)
    start = time.perf_counter()
    bmesh.ops.bevel(
        mesh, geom=hard, offset=WIDTH, offset_type="OFFSET", segments=1, profile=0.5, affect="EDGES",
        clamp_overlap=True,
    )
    seconds = time.perf_counter() - start
    count = sum(len(face.verts) - 2 for face in mesh.faces)
    mesh.free()
    return seconds, count


def chamfer_seconds(mesh, threads):
    start = time.perf_counter()
    result = chamfer.chamfer(mesh, width=WIDTH, width_unit="mesh", verify="fast", threads=threads)
    seconds = time.perf_counter() - start
    assert result.totals.chamfered == result.totals.hard_edges, "the field is not what it should be"
    return seconds, len(result.mesh.triangles)


def main(count):
    cubes = cube_field(count)
    split, sources = as_split(cubes), 12 * count
    bevel = [blender_seconds(cubes) for _ in range(ROUNDS)]
    ours = {threads: [chamfer_seconds(split, threads) for _ in range(ROUNDS)] for threads in (1, 2)}
    slow = statistics.median(seconds for seconds, _ in bevel)
    print(f"{sources:,} triangles of cubes, all {12 * count:,} hard edges, medians of {ROUNDS}")
    print(f"Blender {bpy.app.version_string}: {slow / sources * 1e6:.2f} us a triangle, {bevel[0][1]:,} come out")
    for threads, runs in ours.items():
        fast = statistics.median(seconds for seconds, _ in runs)
        print(
            f"Chamfer, threads {threads}: {fast / sources * 1e6:.2f} us a triangle,"
            f" {runs[0][1]:,} come out: {slow / fast:.1f} times as fast"
        )


main(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)
