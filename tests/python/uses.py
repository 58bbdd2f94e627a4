"""What a tool in Python relies on: streams, submeshes, progress, cancelling, errors."""

import warnings

import numpy as np

import chamfer

warnings.simplefilter("ignore", chamfer.NothingChamfered)

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
result = chamfer.chamfer(roof(), width=0.1, width_unit="mesh")
mesh = result.mesh
count = len(mesh.positions)
assert mesh.positions.dtype == np.float32 and mesh.positions.shape == (count, 3)
assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6)
assert mesh.uvs.keys() == {0, 3} and mesh.uvs[3].shape == (count, 4)
assert mesh.colors.shape == (count, 4) and mesh.tangents is None
assert [len(indices) for indices in mesh.submeshes] in ([4, 2], [2, 4])
assert np.isclose(np.abs(mesh.positions[:, 0]).min(), 0.1 / 2**0.5)

# Verdicts and provenance.
assert result.totals.hard_edges == result.totals.chamfered == 1
assert np.isclose(result.totals.width, 0.1)
[verdict] = result.verdicts
assert chamfer.OUTCOMES[verdict["outcome"]] == "full"
assert chamfer.reason_name(verdict["reason"]) == "none"
assert np.allclose(verdict["widths"], 0.1)
assert result.triangle_sources["kind"].tolist().count(1) == 2
surface = result.vertex_sources["surface"]
rebuilt = (positions[surface["vertices"]] * surface["weights"][..., None]).sum(axis=1)
assert np.allclose(rebuilt, mesh.positions, atol=1e-6)
assert np.allclose(result.carry(positions), mesh.positions, atol=1e-6)
assert np.allclose(result.carry(positions[:, 1]), mesh.positions[:, 1], atol=1e-6)
assert "8 vertices" in repr(roof()) and "hard_edges=1" in repr(result)
assert len(mesh.triangles) == 6 and chamfer.library_version() == chamfer.__version__
assert not hasattr(chamfer, "__path_of_nothing__")

# The result can go in again, and a new submesh can take the chamfers.
assert len(chamfer.chamfer(mesh, verify="fast").mesh.positions) >= count
own = chamfer.chamfer(roof(), submesh="own")
assert [len(indices) for indices in own.mesh.submeshes] == [2, 2, 2]

# Progress rises to 1 and can cancel; what a callback raises comes out of the call.
shares = []
chamfer.chamfer(roof(), progress=shares.append)
assert shares == sorted(shares) and shares[-1] == 1
raised(chamfer.Cancelled, lambda: chamfer.chamfer(roof(), progress=lambda done: True))
raised(ZeroDivisionError, lambda: chamfer.chamfer(roof(), progress=lambda done: 1 / 0))

# What rests on an edge holds it.
def held(result):
    reasons = [chamfer.reason_name(verdict["reason"]) for verdict in result.verdicts]
    return reasons.count("contact")


ridge = [[0, 1, 0, 0, 1, 4, 0]]
assert held(chamfer.chamfer(roof(held=ridge))) == 1 and held(chamfer.chamfer(roof(held=[]))) == 0
assert held(chamfer.chamfer(roof(held=ridge), verify="seen")) == 1
assert chamfer.chamfer(roof(held=ridge)).totals.skipped_by_reason == {"contact": 1}
assert "places" in str(raised(ValueError, lambda: chamfer.chamfer(roof(held=[[0, 1, 0]]))))

# In a scene it is the rim of another object: here a sheet that hangs from the ridge.
sheet = chamfer.Mesh([[0, 0, 0], [0, 0, 4], [0, -2, 4]], [[1, 0, 0]] * 3, [[[0, 1, 2]]])
up, beside = np.eye(4), np.eye(4)
up[1, 3], beside[0, 3] = 1, 9
for verify in ("full", "seen"):
    scene = chamfer.chamfer_scene([roof(), sheet], [(0, np.eye(4)), (1, up)], verify=verify)
    assert [held(result) for result in scene] == [1, 0]
    scene = chamfer.chamfer_scene([roof(), sheet], [(0, np.eye(4)), (1, beside)], verify=verify)
    assert [held(result) for result in scene] == [0, 0]
assert chamfer.chamfer_scene([], []) == []
shares = []
chamfer.chamfer_scene([roof(), sheet], [], progress=shares.append)
assert shares == sorted(shares) and shares[0] < 0.5 and shares[-1] == 1

# Errors say what is wrong and where.
error = raised(chamfer.ChamferError, lambda: chamfer.chamfer_scene([roof(), roof(normals=None)], []))
assert (error.status, error.mesh) == (200, 1) and "mesh 1" in str(error)
error = raised(chamfer.ChamferError, lambda: chamfer.chamfer_scene([roof()], [(1, np.eye(4))]))
assert (error.status, error.element, error.mesh) == (109, 0, None)
raised(ValueError, lambda: chamfer.chamfer_scene([roof()], [(0, np.eye(3))]))
broken = positions.astype(float)
broken[5, 1] = np.nan
error = raised(chamfer.ChamferError, lambda: chamfer.chamfer(roof(positions=broken)))
assert (error.status, error.element) == (203, 5) and "5" in str(error), error
error = raised(chamfer.ChamferError, lambda: chamfer.chamfer(roof(), width=-1))
assert error.status == 104 and error.element is None and str(error)
error = raised(ValueError, lambda: chamfer.chamfer(roof(normals=normals[:3])))
assert "normals" in str(error)

def says(kind, words, call):
    text = str(raised(kind, call))
    assert words in text, text


# A wrong name tells what was meant; and each argument has its kind and range.
says(TypeError, "'widht': did you mean 'width'?", lambda: chamfer.chamfer(roof(), widht=0.1))
says(TypeError, "'normal': did you mean 'normals'?", lambda: roof(normal=normals))
says(TypeError, "there is width, ", lambda: chamfer.chamfer(roof(), xyz=0.1))
says(ValueError, "'percents': did you mean 'percent'?", lambda: chamfer.chamfer(roof(), width_unit="percents"))
says(TypeError, "'held' is no option but a part of the mesh", lambda: chamfer.chamfer(roof(), held=[]))
says(TypeError, "progress is a function of the share done, not 3", lambda: chamfer.chamfer(roof(), progress=3))
says(ValueError, "values has 3 rows: give one for each vertex", lambda: result.carry([1, 2, 3]))
says(TypeError, "width is a number, not '1'", lambda: chamfer.chamfer(roof(), width="1"))
says(TypeError, "verify is one of", lambda: chamfer.chamfer(roof(), verify=True))
says(TypeError, "threads is a whole number", lambda: chamfer.chamfer(roof(), threads=1.5))
says(ValueError, "threads is -1", lambda: chamfer.chamfer(roof(), threads=-1))
says(ValueError, "submesh is -1", lambda: chamfer.chamfer(roof(), submesh=-1))
says(ValueError, "'owned': did you mean 'own", lambda: chamfer.chamfer(roof(), submesh="owned"))
says(TypeError, "degrees is a number", lambda: chamfer.split_by_angle(roof(), "30"))
error = raised(chamfer.BadInput, lambda: chamfer.chamfer(roof(), submesh=9))
assert isinstance(error, ValueError) and (error.status, error.element) == (106, 9)
nothing = chamfer.chamfer(roof(), least_breadth=0, width=90)
assert nothing.totals.mean_width > chamfer.chamfer(roof(), width=90).totals.mean_width

# So has each array.
faces = np.array(submeshes[0])


def refused(kind, words, **changes):
    says(kind, words, lambda: chamfer.chamfer(roof(**changes)))


refused(TypeError, "submeshes[1] has values of type float64", submeshes=[faces, faces.astype(float)])
refused(ValueError, "submeshes[0], triangle 1: there is no vertex -3 among 8", submeshes=[faces - [[0, 0, 0], [0, 5, 0]]])
refused(ValueError, "no vertex 4294967296 among 8", submeshes=[faces + 2**32])
refused(ValueError, "no vertex 8 among 8", submeshes=[[[0, 1, 8]]])
refused(ValueError, "Cut quads into triangles", submeshes=[[[0, 1, 2, 3]]])
refused(ValueError, "put that list into another", submeshes=submeshes[0])
refused(ValueError, "submeshes[0] has rows of different lengths", submeshes=[[[0, 1, 2], [0, 1, 2, 3]]])
refused(ValueError, "a channel -1: channels are 0 to 7", uvs={-1: uvs[0]})
refused(ValueError, "a channel 8", uvs={8: uvs[0]})
refused(ValueError, "a channel '0'", uvs={"0": uvs[0]})
refused(TypeError, "uvs is a dict", uvs=uvs[0])
refused(ValueError, "uvs[2] has the shape (8, 1): it is 8 vertices by 2 or 3 or 4", uvs={2: uvs[0][:, :1]})
refused(TypeError, "positions has values of type <U", positions=[["a", "b", "c"]] * 8)
refused(TypeError, "positions is an array", positions=None)
refused(ValueError, "colors has the shape (8, 3): it is 8 vertices by 4", colors=np.ones((8, 3)))
says(TypeError, "a chamfer.Mesh is wanted, not ndarray", lambda: chamfer.chamfer(positions))
says(ValueError, "objects[0] is of mesh -1", lambda: chamfer.chamfer_scene([roof()], [(-1, np.eye(4))]))
one = roof(submeshes=np.array(submeshes).reshape(-1, 3))
assert chamfer.chamfer(one).totals.hard_edges == 1 and len(one.submeshes) == 1

# A chord at the right angle of the ridge is longer than the offset, by the root of two.
def width(mesh=None, width=0.1, **options):
    [verdict] = chamfer.chamfer(mesh or roof(), width=width, width_unit="mesh", **options).verdicts
    return verdict["widths"].tolist() if verdict["outcome"] < 2 else chamfer.reason_name(verdict["reason"])


def near(found, *wanted):
    assert np.allclose(found, wanted, atol=1e-6), found


near(width(width_mode="offset"), 0.1, 0.1)
near(width(width_mode="chord"), 0.1 / 2**0.5, 0.1 / 2**0.5)
near(width(width_mode="depth"), 0.1 * 2**0.5, 0.1 * 2**0.5)
near(width(width_mode="radius"), 0.1, 0.1)
near(width(min_angle=89, max_angle=91, convexity="convex"), 0.1, 0.1)
assert width(min_angle=91) == width(max_angle=89) == width(max_angle=0) == "not_selected"
assert width(convexity="concave") == "not_selected"
assert chamfer.chamfer(roof(), hard_angle=89).totals.hard_edges == 1
blunt = [left + [0, 2, 0]] * 4 + [right + [0, 2, 0]] * 4
blunt /= np.linalg.norm(blunt, axis=1)[:, None]  # They differ by 30 degrees.
assert chamfer.chamfer(roof(normals=blunt), hard_angle=25).totals.hard_edges == 1
assert chamfer.chamfer(roof(normals=blunt), hard_angle=35).totals.hard_edges == 0

# Twice as large in the scene, so half as wide in the mesh; and the matrix is multiplied from the left.
ridge_x = lambda scale: np.abs(chamfer.chamfer(roof(), width=0.1, width_unit="mesh", scale=scale).mesh.positions[:, 0]).min()
assert np.isclose(ridge_x(np.eye(3) * 2), 0.05 / 2**0.5)
sheared, across = np.eye(3), np.eye(3)
sheared[2, 0], across[0, 2] = 1, 1  # x leans along the ridge: the ridge stays, and what is across it.
assert np.isclose(ridge_x(sheared), 0.1 / 2**0.5) and not np.isclose(ridge_x(across), 0.1 / 2**0.5)

# A roof has one edge: two triangles for each segment, and the verdict tells how many.
round_roof = chamfer.chamfer(roof(), width=0.1, width_unit="mesh", segments=3)
assert round_roof.verdicts["segments"].tolist() == [3]
assert (round_roof.triangle_sources["kind"] == 1).sum() == 6
def highest(profile):
    points = chamfer.chamfer(roof(), width=0.1, width_unit="mesh", segments=2, profile=profile).mesh.positions
    return points[:, 1].max()


# A point half way: on the old ridge, on the circle, on the chord.
near([highest(0.5), highest(0)], 1 - 0.1 * (2**0.5 - 1), 1 - 0.1 / 2**0.5)
assert 0.998 < highest(1) < 1

# One end of the ridge has room for half of the width alone: by how much the other one follows.
lean = positions.astype(float)
lean[[0, 1]] = [[-0.1, 0.9, 0], [-4, -3, 4]]
ends = [width(roof(positions=lean), width=0.4, evenness=evenness) for evenness in (0, 0.5, 1)]
[wide, halfway, even] = ends
assert wide[0] > 1.5 * wide[1] and halfway[0] < 1.3 * halfway[1], ends
near(even[:1], even[1])
says(ValueError, "segments is 0: give 1 to 32", lambda: chamfer.chamfer(roof(), segments=0))
says(ValueError, "segments is 33", lambda: chamfer.chamfer(roof(), segments=33))
says(ValueError, "the profile is", lambda: chamfer.chamfer(roof(), profile=1.5))

# Factors: of submeshes the smaller counts, of vertices the mean at each end.
near(width(roof(submesh_factors=[0.5, 2])), 0.05, 0.05)
assert width(roof(submesh_factors=[1, 0])) == "not_selected"
near(width(roof(vertex_factors=[1, 1, 0.5, 1, 1, 0.5, 1, 1])), 0.05, 0.1)  # vertices 2 and 3
near(width(roof(edges=[(5, 3, 0.5)])), 0.05, 0.05)
near(width(roof(edges=np.array([[3, 2], [0, 1]]))), 0.1, 0.1)
assert width(roof(edges=[(0, 1)])) == width(roof(edges=[])) == width(roof(edges=np.empty((0, 2)))) == "not_selected"
assert chamfer.chamfer(roof(edges=[])).mesh.edges is None
[flat_half, sharp] = chamfer.chamfer_scene([roof(submesh_factors=[0, 0]), roof()], [])
assert (flat_half.totals.chamfered, sharp.totals.chamfered) == (0, 1)

says(ValueError, "'cord': did you mean 'chord'?", lambda: width(width_mode="cord"))
says(ValueError, "convexity cannot be 'in'", lambda: width(convexity="in"))
says(TypeError, "convexity is one of both, convex, concave, not 1", lambda: width(convexity=1))
says(ValueError, "min_angle is -1: give degrees from 0 to 180", lambda: width(min_angle=-1))
says(ValueError, "max_angle is 181: give degrees from 0 to 180", lambda: width(max_angle=181))
says(ValueError, "max_angle is nan: give degrees", lambda: width(max_angle=float("nan")))
says(ValueError, "hard_angle is 0: give degrees above 0, up to 90", lambda: width(hard_angle=0))
says(ValueError, "hard_angle is 91: give degrees above 0, up to 90", lambda: width(hard_angle=91))
says(ValueError, "min_angle is 60, larger than max_angle, 30", lambda: width(max_angle=30, min_angle=60))
says(TypeError, "min_angle is a number, not '9'", lambda: width(min_angle="9"))
says(ValueError, "scale has the shape (4, 4): it is 3 by 3", lambda: width(scale=np.eye(4)))
says(ValueError, "scale is all zeros", lambda: width(scale=np.zeros((3, 3))))
says(ValueError, "scale flattens the mesh", lambda: width(scale=np.diag([1, 0, 1])))
says(ValueError, "give finite numbers", lambda: width(scale=np.diag([1, np.inf, 1])))
says(TypeError, "scale has values of type <U", lambda: width(scale=[["a"] * 3] * 3))
refused(ValueError, "submesh_factors has the shape (3,): it is one factor for each submesh, (2,)", submesh_factors=[1, 1, 1])
refused(ValueError, "submesh_factors[1] has the factor -0.5: give finite ones of at least 0", submesh_factors=[1, -0.5])
refused(ValueError, "vertex_factors has the shape (7,): it is one factor for each vertex, (8,)", vertex_factors=[1] * 7)
refused(ValueError, "vertex_factors[2] has the factor nan", vertex_factors=[1, 1, np.nan] + [1] * 5)
refused(TypeError, "vertex_factors has values of type bool", vertex_factors=[True] * 8)
refused(ValueError, "edges has the shape (1, 4): it is edges by 2, or by 3 with a factor each", edges=[[0, 1, 2, 3]])
refused(ValueError, "edges[1]: there is no vertex 8 among 8", edges=[[0, 1], [2, 8]])
refused(ValueError, "edges[0]: there is no vertex -1 among 8", edges=[[-1, 1]])
refused(ValueError, "edges[0]: there is no vertex 0.5 among 8", edges=[[0.5, 1, 1]])
refused(ValueError, "edges[0] has the factor inf", edges=[[0, 1, np.inf]])
says(TypeError, "'vertex_factor': did you mean 'vertex_factors'?", lambda: roof(vertex_factor=[1] * 8))

# Arrays of other types and layouts are copied, and never written.
given = np.asfortranarray(positions.astype(np.float64))
before = given.copy()
assert np.array_equal(chamfer.chamfer(roof(positions=given)).mesh.positions, chamfer.chamfer(roof()).mesh.positions)
assert np.array_equal(given, before)
result.verdicts["outcome"] = 0  # What came out is the caller's.

# A mesh without normals gets them first.
smooth = chamfer.split_by_angle(roof(normals=None), 180)
flat = chamfer.split_by_angle(roof(normals=normals[:3]), 30)  # They are ignored.
assert chamfer.chamfer(smooth).totals.hard_edges == 0
assert chamfer.chamfer(flat).totals.hard_edges == 1

# What comes back as it was does so with a word, unless that was asked for.
def warning_of(*meshes, **options):
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        chamfer.chamfer_scene(meshes, [], **options)
    assert all(warning.category is chamfer.NothingChamfered for warning in told)
    assert all(warning.filename == __file__ for warning in told)
    return " ".join(str(warning.message) for warning in told)


assert "no hard edges" in warning_of(smooth) and "no hard edges" in warning_of(smooth, sheet)
assert "none of the hard edges is chamfered: 2 contact" in warning_of(roof(held=ridge), roof(held=ridge))
assert warning_of(roof()) == warning_of(smooth, roof()) == warning_of(roof(), max_angle=9) == warning_of() == ""
assert warning_of(roof(submeshes=[])) == ""

# Nothing comes of nothing.
empty = chamfer.Mesh(np.empty((0, 3)), np.empty((0, 3)), [])
assert chamfer.chamfer(empty).mesh.submeshes == []

# What the library made is given back, and only a library of the same interface is taken.
library = chamfer._library.library()
destroy, freed = library.chamfer_result_destroy, []
library.chamfer_result_destroy = lambda made: (freed.append(made), destroy(made))
chamfer.chamfer(roof())
chamfer.chamfer_scene([roof(), sheet], [])
assert len(freed) == 3
chamfer._library.library.cache_clear()
chamfer._library.ABI_VERSION = 2
says(ImportError, "ABI version 1, this package needs 2", chamfer.library_version)
print("all as it should be")
