"""Chamfers meshes of trimesh."""

import trimesh

import chamfer


def chamfered(shape, degrees=30, **options):
    """A mesh of trimesh, chamfered where faces meet at more than so many degrees."""
    uv = getattr(shape.visual, "uv", None)
    mesh = chamfer.Mesh(shape.vertices, None, [shape.faces], uvs={} if uv is None else {0: uv})
    result = chamfer.chamfer(chamfer.split_by_angle(mesh, degrees), **options).mesh
    visual = None
    if uv is not None:
        visual = trimesh.visual.TextureVisuals(result.uvs[0], material=shape.visual.material)
    # Without process=False, trimesh joins the vertices again.
    return trimesh.Trimesh(
        result.positions, result.triangles, vertex_normals=result.normals, visual=visual, process=False
    )


if __name__ == "__main__":
    box = trimesh.creation.box((2, 2, 2))
    soft = chamfered(box, width=0.1, width_unit="mesh")
    print(f"{len(box.faces)} -> {len(soft.faces)} triangles, volume {box.volume:.2f} -> {soft.volume:.2f}")
    box.visual = trimesh.visual.TextureVisuals(box.vertices[:, :2])
    print(f"texture of {len(chamfered(box).visual.uv)} vertices")
