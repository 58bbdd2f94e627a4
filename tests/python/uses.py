"""What a tool in Python relies on: streams, submeshes, progress, cancelling, errors."""

import sys

import numpy as np

import chamfer

library = chamfer.Library(sys.argv[1])

# A roof: two quads that meet at the ridge y = 1, each a submesh of its own.
positions = np.array(
    [[-1, 0, 0], [-1, 0, 4], [0, 1, 4], [0, 1, 0], [0, 1, 0], [0, 1, 4], [1, 0, 4], [1, 0, 0]]
)
left, right = np.array([-1, 1, 0]) / 2**0.5, np.array([1, 1, 0]) / 2**0.5
normals = np.array([left] * 4 + [right] * 4)
submeshes = [[[0, 1, 2], [0, 2, 3]], [[4, 5, 6], [4, 6, 7]]]
uvs = {0: positions[:, :2] / 4, 3: np.hstack([positions, positions[:, :1]])}
colors = np.full((8, 4), 0.5)


def roof(**changes):
    streams = {"positions": positions, "normals": normals, "submeshes": submeshes, "uvs": uvs}
    return chamfer.Mesh(**{**streams, "colors": colors, **changes})


def raised(kind, call):
    try:
        call()
    except kind as error:
        return error
    raise AssertionError(f"no {kind.__name__}")


# Every stream comes back, as long as the positions, and the submeshes stay apart.
result = library.chamfer(roof(), width=0.1, width_unit="mesh")
mesh = result.mesh
count = len(mesh.positions)
assert mesh.positions.dtype == np.float32 and mesh.positions.shape == (count, 3)
assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6)
assert mesh.uvs.keys() == {0, 3} and mesh.uvs[3].shape == (count, 4)
assert mesh.colors.shape == (count, 4) and mesh.tangents is None
assert [len(indices) for indices in mesh.submeshes] in ([4, 2], [2, 4])
assert np.isclose(np.abs(mesh.positions[:, 0]).min(), 0.1 / 2**0.5)

# Verdicts and provenance.
assert result.totals["hard_edges"] == result.totals["chamfered"] == 1
assert np.isclose(result.totals["width"], 0.1)
[verdict] = result.verdicts
assert chamfer.OUTCOMES[verdict["outcome"]] == "full"
assert library.reason(verdict["reason"]) == "none"
assert np.allclose(verdict["widths"], 0.1)
assert result.triangle_sources["kind"].tolist().count(1) == 2
surface = result.vertex_sources["surface"]
rebuilt = (positions[surface["vertices"]] * surface["weights"][..., None]).sum(axis=1)
assert np.allclose(rebuilt, mesh.positions, atol=1e-6)

# The result can go in again, and a new submesh can take the chamfers.
assert len(library.chamfer(mesh, verify="fast").mesh.positions) >= count
own = library.chamfer(roof(), submesh="own")
assert [len(indices) for indices in own.mesh.submeshes] == [2, 2, 2]

# Progress rises to 1 and can cancel; what a callback raises comes out of the call.
shares = []
library.chamfer(roof(), progress=shares.append)
assert shares == sorted(shares) and shares[-1] == 1
raised(chamfer.Cancelled, lambda: library.chamfer(roof(), progress=lambda done: True))
raised(TypeError, lambda: library.chamfer(roof(), widht=0.1))
raised(ZeroDivisionError, lambda: library.chamfer(roof(), progress=lambda done: 1 / 0))

# What rests on an edge holds it.
def held(result):
    reasons = [library.reason(verdict["reason"]) for verdict in result.verdicts]
    return reasons.count("contact")


ridge = [[0, 1, 0, 0, 1, 4, 0]]
assert held(library.chamfer(roof(held=ridge))) == 1 and held(library.chamfer(roof(held=[]))) == 0
assert held(library.chamfer(roof(held=ridge), verify="seen")) == 1
assert "places" in str(raised(ValueError, lambda: library.chamfer(roof(held=[[0, 1, 0]]))))

# In a scene it is the rim of another object: here a sheet that hangs from the ridge.
sheet = chamfer.Mesh([[0, 0, 0], [0, 0, 4], [0, -2, 4]], [[1, 0, 0]] * 3, [[[0, 1, 2]]])
up, beside = np.eye(4), np.eye(4)
up[1, 3], beside[0, 3] = 1, 9
for verify in ("full", "seen"):
    scene = library.chamfer_scene([roof(), sheet], [(0, np.eye(4)), (1, up)], verify=verify)
    assert [held(result) for result in scene] == [1, 0]
    scene = library.chamfer_scene([roof(), sheet], [(0, np.eye(4)), (1, beside)], verify=verify)
    assert [held(result) for result in scene] == [0, 0]
assert library.chamfer_scene([], []) == []
shares = []
library.chamfer_scene([roof(), sheet], [], progress=shares.append)
assert shares == sorted(shares) and shares[0] < 0.5 and shares[-1] == 1

# Errors say what is wrong and where.
error = raised(chamfer.ChamferError, lambda: library.chamfer_scene([roof(), roof(normals=None)], []))
assert (error.status, error.mesh) == (200, 1) and "mesh 1" in str(error)
error = raised(chamfer.ChamferError, lambda: library.chamfer_scene([roof()], [(1, np.eye(4))]))
assert (error.status, error.element, error.mesh) == (109, 0, None)
raised(ValueError, lambda: library.chamfer_scene([roof()], [(0, np.eye(3))]))
broken = positions.astype(float)
broken[5, 1] = np.nan
error = raised(chamfer.ChamferError, lambda: library.chamfer(roof(positions=broken)))
assert (error.status, error.element) == (203, 5) and "5" in str(error), error
error = raised(chamfer.ChamferError, lambda: library.chamfer(roof(), width=-1))
assert error.status == 104 and error.element is None and str(error)
error = raised(ValueError, lambda: library.chamfer(roof(normals=normals[:3])))
assert "normals" in str(error)

# A mesh without normals gets them first.
smooth = library.split_by_angle(roof(normals=None), 180)
flat = library.split_by_angle(roof(normals=None), 30)
assert library.chamfer(smooth).totals["hard_edges"] == 0
assert library.chamfer(flat).totals["hard_edges"] == 1

# Nothing comes of nothing.
empty = chamfer.Mesh(np.empty((0, 3)), np.empty((0, 3)), [])
assert library.chamfer(empty).mesh.submeshes == []
print("all as it should be")
