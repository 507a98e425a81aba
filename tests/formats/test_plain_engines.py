"""Edited plain files as independent readers see them: trimesh, PyBullet, MuJoCo."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.geometry import convex_hull
from meshforge.symbolic import Geom
from tests.mesh_engines import Bullet, bounds, mujoco_hull, objects
from tests.mesh_files import obj, ply, stl_ascii, stl_binary
from tests.soups import box, together

ROW = [(0, 0, 0), (3, 0, 0), (6, 0, 0)]
DROPPED = 2  # the last, so that its vertices left behind would show in the bounds


def grouped() -> bytes:
    """An OBJ of three boxes in a row, with an object, normals and a material each."""
    text = ["mtllib a.mtl", "vn 0 0 1"]
    for k, low in enumerate(ROW):
        lines = obj(box(low)).decode().splitlines()
        faces = [" ".join(f"{int(c) + 8 * k}//1" for c in line.split()[1:]) for line in lines[8:]]
        text += [f"o leg_{k}", *lines[:8], f"usemtl oak_{k}", *(f"f {face}" for face in faces)]
    return "\n".join(text).encode()


SOURCES = {
    "a.obj": grouped(),
    "plain.obj": obj(together(*map(box, ROW))),
    "binary.stl": stl_binary(together(*map(box, ROW))),
    "text.stl": stl_ascii(together(*map(box, ROW))),
    "text.ply": ply(together(*map(box, ROW))),
    "binary.ply": ply(together(*map(box, ROW)), "binary_little_endian", extra=True),
}


def edited(folder: Path, name: str) -> Path:
    """The row of boxes without the last and with a made one at y = 4."""
    (folder / name).write_bytes(SOURCES[name])
    asset = read(folder / name)
    assert len(asset.geoms) == 3
    made = Geom(f"{asset.geoms[0].name}~1", "body", convex_hull(box((0, 4, 0))[0]), asset.geoms[0].name)
    return save(asset.with_geoms([*asset.geoms[:DROPPED], made]), folder / "out" / name).path


@pytest.mark.parametrize("name", SOURCES)
def test_trimesh_finds_nothing_left_of_a_deleted_hull(tmp_path: Path, name: str) -> None:
    assert bounds(edited(tmp_path, name)).tolist() == [[0, 0, 0], [4, 5, 1]]


def test_trimesh_finds_the_objects_by_their_names(tmp_path: Path) -> None:
    found = objects(edited(tmp_path, "a.obj"))
    assert sorted(found) == ["leg_0", "leg_0~1", "leg_1"]
    assert [round(float(mesh.volume), 6) for mesh in found.values()] == [1, 1, 1]


def test_bullet_collides_with_each_hull_and_not_between_them(tmp_path: Path) -> None:
    with Bullet(edited(tmp_path, "a.obj")) as world:
        inside = [[0.5, 0.5, 0.5], [3.5, 0.5, 0.5], [0.5, 4.5, 0.5]]
        outside = [[6.5, 0.5, 0.5], [2.0, 0.5, 0.5], [0.5, 2.5, 0.5]]
        assert [world.hits(np.array(p)) for p in inside + outside] == [True] * 3 + [False] * 3


@pytest.mark.parametrize("suffix", [".obj", ".stl"])
def test_mujoco_reads_every_file_of_a_folder_as_the_hull_it_is(tmp_path: Path, suffix: str) -> None:
    (tmp_path / "in").mkdir()
    for k, low in enumerate(ROW):
        data = obj(box(low)) if suffix == ".obj" else stl_binary(box(low))
        (tmp_path / "in" / f"hull{k}{suffix}").write_bytes(data)
    asset = read(tmp_path / "in")
    made = Geom("hull2~1", "body", convex_hull(np.random.default_rng(3).normal(size=(12, 3))), "hull2")
    save(asset.with_geoms([*asset.geoms[:DROPPED], made]), tmp_path / "out")
    back = read(tmp_path / "out")
    assert [g.name for g in back.geoms] == ["hull0", "hull1", "hull2~1"]
    for geom in back.geoms:
        points = mujoco_hull(tmp_path / "out" / f"{geom.name}{suffix}")
        box_of = [geom.shape.aabb.min, geom.shape.aabb.max]
        np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], box_of, atol=1e-5)
