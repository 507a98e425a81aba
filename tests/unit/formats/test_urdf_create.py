"""Making a URDF from an asset of another format."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.asset import Asset, Body, Document, Geom, Opaque, Surface
from meshforge.formats.base import Output
from meshforge.formats.reporting import report
from meshforge.formats.urdf import UrdfFormat
from meshforge.geometry import Aabb, Box, Capsule, Cylinder, Pose, Shape, Sphere
from tests.urdf_engines import assert_mujoco_agrees, bullet, mujoco_model, yourdf
from tests.urdf_sample import put, read

TURNED = Pose.from_rpy([1, 2, 3], [0.4, -1.1, 2.0])
BLOCK = Box.filling(Aabb((0, 0, 0), (1, 2, 3)))


def foreign(bodies: dict[str, Pose], geoms: list[tuple[str, str, Shape]], *opaque: Opaque) -> Asset:
    made = tuple(Geom(name, body, shape) for name, body, shape in geoms)
    return Asset(Path("x.foo"), "foo", tuple(Body(n, p) for n, p in bodies.items()), made, Document(), opaque)


def created(asset: Asset, tmp_path: Path) -> tuple[Asset, Path, Output]:
    output = UrdfFormat().create(asset, "new.urdf")
    path = put(output, tmp_path / "new.urdf")
    return read(path), path, output


def told(asset: Asset, output: Output) -> tuple[str, ...]:
    return report(asset, None, UrdfFormat(), output).sentences


CART = foreign(
    {"frame": Pose.identity(), "wheel <1>": TURNED, "lid": Pose.of_translation([0, 0, 1])},
    [
        ("frame/geom0", "frame", BLOCK),
        ("wheel <1>/tyre", "wheel <1>", Cylinder(TURNED, 0.3, 0.1)),
        ("wheel <1>/hub#2", "wheel <1>", Sphere(TURNED, 0.2)),
        ("lid/knob", "lid", BLOCK.tessellated()),
        ("lid/rod", "lid", Capsule(TURNED, 0.1, 0.4)),
    ],
)


def test_bodies_hulls_and_names_come_back(tmp_path: Path) -> None:
    again, _, output = created(CART, tmp_path)
    assert [b.name for b in again.bodies] == [b.name for b in CART.bodies]
    assert [g.name for g in again.geoms] == [g.name for g in CART.geoms]
    for name, pose in CART.body_poses.items():
        np.testing.assert_allclose(again.body_poses[name].rotation, pose.rotation, atol=1e-12)
        np.testing.assert_allclose(again.body_poses[name].translation, pose.translation, atol=1e-12)
    for old, new in zip(CART.geoms, again.geoms, strict=True):
        shape = old.shape.tessellated() if old.shape.kind == "capsule" else old.shape
        assert new.shape.kind == shape.kind
        np.testing.assert_allclose(new.shape.aabb.min, shape.aabb.min, atol=1e-12)
        np.testing.assert_allclose(new.shape.aabb.max, shape.aabb.max, atol=1e-12)
    assert told(CART, output) == (
        "3 links without a mass (frame, wheel <1>, lid): PyBullet takes 1 kg, MuJoCo computes it from the hulls",
        "1 capsule (lid/rod) is written as triangles: URDF has no capsules",
    )


def test_all_engines_load_it(tmp_path: Path) -> None:
    again, path, _ = created(CART, tmp_path)
    assert len(bullet(path)["shapes"]) == 3
    assert mujoco_model(path).ngeom == 5
    assert assert_mujoco_agrees(path, again) == 2  # the block is called geom0 without a name attribute
    assert len(yourdf(path).robot.links) == 3


def test_a_plain_mesh_becomes_one_link(tmp_path: Path) -> None:
    plain = foreign({"body": Pose.identity()}, [("part 1", "body", BLOCK), ("part#2", "body", BLOCK.tessellated())])
    again, path, output = created(plain, tmp_path)
    assert [b.name for b in again.bodies] == ["body"]
    assert [g.name for g in again.geoms] == ["body/part 1", "body/part#2"]
    assert output.names == {"part 1": "body/part 1", "part#2": "body/part#2"}
    assert (tmp_path / "new--part_2.obj").is_file()
    assert b"<joint" not in path.read_bytes()


def test_bodies_that_are_all_elsewhere_get_a_root_of_their_own(tmp_path: Path) -> None:
    moved = foreign({"base": TURNED}, [("base/a", "base", BLOCK)])
    again, _, _ = created(moved, tmp_path)
    assert [b.name for b in again.bodies] == ["base_2", "base"]
    np.testing.assert_allclose(again.geoms[0].shape.aabb.max, BLOCK.aabb.max, atol=1e-12)


@pytest.mark.parametrize("flat", [True, False])
def test_opaque_pieces_are_meshes_as_they_are_unless_they_are_flat(flat: bool, tmp_path: Path) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0 if flat else 1]], dtype=float)
    surface = Surface(points, np.array([[0, 2, 1], [0, 1, 3]]))
    opaque = [Opaque("lid/open", "lid", "open", surface), Opaque("lid/floor", "lid", "a plane has no end")]
    again, _, output = created(foreign({"lid": Pose.identity()}, [("lid/a", "lid", BLOCK)], *opaque), tmp_path)
    assert [o.name for o in again.opaque] == ([] if flat else ["lid/open"])
    said = told(foreign({"lid": Pose.identity()}, [("lid/a", "lid", BLOCK)], *opaque), output)
    assert "1 piece without a surface (lid/floor) is left out: a plane has no end" in said
    assert [n for n in said if "lid/open" in n] == [
        "1 opaque piece (lid/open) is left out: engines refuse a mesh that is flat"
        if flat
        else "of opaque pieces (lid/open) engines take the convex hull"
    ]
