"""What `Replace(capsule, native)` writes, as MuJoCo, yourdfpy, Drake and USD's own reader find it: the native primitive
in its place, turned as the rule's frame is.
"""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest
import yourdfpy

from meshforge.formats import SaveResult, read, save
from meshforge.geometry import (
    Aabb,
    Box,
    Capsule,
    Cylinder,
    Floats,
    Pose,
    Shape,
    Sphere,
    is_same_shape,
    rotation_of_quaternion,
)
from meshforge.language import Program, orient_mesh
from meshforge.symbolic import Geom, Label, SymbolicMesh
from tests.conversion_samples import foreign
from tests.laws.test_geometry_fits import outside
from tests.mjcf_engines import KINDS as MUJOCO_KINDS
from tests.sdf_engines import assert_same_primitives, drake
from tests.usd_stages import complaints, physics_shapes

KINDS = ("capsule", "cylinder", "sphere")
TURNED = Pose.from_rpy([1, 2, 3], [0.4, -1.1, 2.0])
STOOL = {
    "low": Aabb([-0.05, -0.04, 0], [0.05, 0.04, 0.3]),
    "high": Aabb([-0.03, -0.04, 0.3], [0.03, 0.06, 0.6]),
    "top": Aabb([-0.3, -0.3, 0.6], [0.3, 0.3, 0.65]),
    "side": Aabb([0.3, -0.1, 0.2], [0.4, 0.12, 0.4]),
}
LABELS = {"low": "leg", "high": "leg", "top": "top", "side": "side"}
PROGRAM = """labels leg, top, side
orient +Z: Is(leg) -> Is(top), +X: Is(leg) -> Is(side)
Is(leg) => Replace({kind}, native)
"""

Native = Capsule | Cylinder | Sphere


def edited(folder: Path, file: str, kind: str) -> tuple[SaveResult, Native]:
    """A slanted stool whose leg of two hulls is replaced, as it was written; and the primitive, which encloses the leg
    and lies along Z of the rule's frame.
    """
    blocks = {name: Box.of_bounds(bounds).move(TURNED) for name, bounds in STOOL.items()}
    shapes = {name: box.tessellate() if LABELS[name] == "leg" else box for name, box in blocks.items()}
    stool = foreign({"body": Pose.identity()}, [(f"body/{name}", "body", shape) for name, shape in shapes.items()])
    source = read(save(stool, folder / file).path)
    labels = {geom.name: Label(LABELS[geom.name.split("/")[-1]]) for geom in source.geoms}
    before = SymbolicMesh.of(source, labels)
    program = Program.parse(PROGRAM.format(kind=kind))
    after = program.run(before, {}).mesh
    (shape,) = (hull.shape for hull in after.hulls if hull.name not in before.index)
    assert isinstance(shape, Capsule | Cylinder | Sphere) and shape.kind == kind
    leg = np.concatenate([hull.vertices for hull in before.hulls if hull.label == "leg"])
    assert outside(leg, shape) <= 1e-9
    frame = orient_mesh(before, program.orient)[1].rotation.T
    assert np.abs(frame - np.eye(3)).max() > 0.1
    np.testing.assert_allclose(shape.pose.rotation, frame, atol=1e-9)
    return save(after, folder / "out" / file), shape


def assert_in_place(shape: Native, sizes: list[float], center: Floats, axis: Floats, slack: float = 1e-9) -> None:
    """What a reader found is the shape; sizes: the radius, and half the length of what has one."""
    wanted = [shape.radius] if isinstance(shape, Sphere) else [shape.radius, shape.half_length]
    np.testing.assert_allclose(sizes, wanted, rtol=0, atol=slack)
    np.testing.assert_allclose(center, shape.pose.translation, rtol=0, atol=slack)
    if not isinstance(shape, Sphere):
        np.testing.assert_allclose(axis, shape.pose.rotation[:, 2], rtol=0, atol=10 * slack)


def made_geom(saved: SaveResult) -> Geom:
    (made,) = (geom for geom in read(saved.path).geoms if "~" in geom.name)
    return made


def assert_is_hull_of(hull: Shape, shape: Native) -> None:
    """A polytope has the corners of the primitive's tessellation, in any order."""
    corners = shape.vertices
    gaps = np.linalg.norm(hull.vertices[:, None] - corners, axis=2)
    assert hull.kind == "polytope" and len(hull.vertices) == len(corners)
    assert max(gaps.min(axis=0).max(), gaps.min(axis=1).max()) <= 1e-6


@pytest.mark.parametrize("kind", KINDS)
def test_mujoco_finds_it_in_an_mjcf(kind: str, tmp_path: Path) -> None:
    saved, shape = edited(tmp_path, "stool.xml", kind)
    assert saved.notes == ()
    model = mujoco.MjModel.from_xml_path(str(saved.path))
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    (k,) = (k for k in range(model.ngeom) if MUJOCO_KINDS.get(mujoco.mjtGeom(int(model.geom_type[k]))) == kind)
    sizes = model.geom_size[k][: 1 if kind == "sphere" else 2].tolist()
    assert_in_place(shape, sizes, data.geom_xpos[k], data.geom_xmat[k].reshape(3, 3)[:, 2])


@pytest.mark.parametrize("kind", ["cylinder", "sphere"])
def test_yourdfpy_finds_it_in_a_urdf(kind: str, tmp_path: Path) -> None:
    saved, shape = edited(tmp_path, "stool.urdf", kind)
    assert saved.notes == ()
    (link,) = yourdfpy.URDF.load(str(saved.path), load_meshes=False).robot.links
    (found,) = (one for one in link.collisions if one.geometry.mesh is None and one.geometry.box is None)
    tube = found.geometry.cylinder
    sizes = [tube.radius, tube.length / 2] if tube else [found.geometry.sphere.radius]
    assert_in_place(shape, sizes, found.origin[:3, 3], found.origin[:3, 2])


@pytest.mark.parametrize("kind", KINDS)
def test_drake_finds_it_in_an_sdf(kind: str, tmp_path: Path) -> None:
    saved, shape = edited(tmp_path, "stool.sdf", kind)
    assert saved.notes == () and f"<{kind}>" in saved.path.read_text()
    assert is_same_shape(made_geom(saved).shape, shape, 1e-9)
    seen, _ = drake(saved.path, {saved.path.parent.name: saved.path.parent})
    assert_same_primitives(read(saved.path), seen)


@pytest.mark.parametrize("suffix", [".usda", ".usdc"])
@pytest.mark.parametrize("kind", KINDS)
def test_usd_finds_it_in_a_stage(kind: str, suffix: str, tmp_path: Path) -> None:
    saved, shape = edited(tmp_path, f"stool{suffix}", kind)
    assert complaints(saved.path) == []
    told = {type(one).__name__: one for one in physics_shapes(saved.path).values()}
    found = told[f"{kind.capitalize()}ShapeDesc"]
    sizes = [found.radius] if kind == "sphere" else [found.radius, found.halfHeight]
    turn = rotation_of_quaternion([found.localRot.real, *found.localRot.imaginary])
    axis = turn[:, 2 if kind == "sphere" else "XYZ".index(str(found.axis)[-1])]
    assert_in_place(shape, sizes, np.array(found.localPos), axis, slack=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_a_glb_keeps_it_as_a_shape_of_khr_physics(kind: str, tmp_path: Path) -> None:
    saved, shape = edited(tmp_path, "stool.glb", kind)
    assert not any("hull mesh" in note for note in saved.notes)
    assert f'"type":"{kind}"'.encode() in saved.path.read_bytes().replace(b" ", b"")
    found = made_geom(saved).shape
    assert isinstance(found, Capsule | Cylinder | Sphere) and found.kind == kind
    sizes = [found.radius] if isinstance(found, Sphere) else [found.radius, found.half_length]
    assert_in_place(shape, sizes, found.pose.translation, found.pose.rotation[:, 2])


@pytest.mark.parametrize("kind", KINDS)
def test_in_a_mesh_file_it_is_a_hull_and_noted(kind: str, tmp_path: Path) -> None:
    saved, shape = edited(tmp_path, "stool.obj", kind)
    assert f"1 {kind} written as hull meshes: mesh files have no primitives" in saved.notes
    assert_is_hull_of(made_geom(saved).shape, shape)
