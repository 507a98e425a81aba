"""MJCF as MuJoCo itself has them, to hold readings against; and what tests of MJCF do again and again."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np

from meshforge.formats.base import ReadOptions
from meshforge.formats.mjcf.format import MjcfFormat
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Floats, Pose, Sphere
from meshforge.symbolic import Asset, Geom, NonConvexPiece

KINDS = {
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_SPHERE: "sphere",
    mujoco.mjtGeom.mjGEOM_CAPSULE: "capsule",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_ELLIPSOID: "ellipsoid",
    mujoco.mjtGeom.mjGEOM_MESH: "polytope",
}
DIRECTIONS = np.array([[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1) if x or y or z], float)

TETRAHEDRON = "0 0 0 1 0 0 0 2 0 0 0 3"


def read(path: Path) -> Asset:
    return MjcfFormat().read(path, ReadOptions())


def put(folder: Path, files: dict[str, str | bytes], main: str = "main.xml") -> Path:
    """Write files below a folder; returns the path of the main one."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder / main


def model(inside: str, before: str = "") -> str:
    """A model with this in its world."""
    return f"<mujoco>{before}<worldbody>{inside}</worldbody></mujoco>"


def asset(folder: Path, inside: str, before: str = "") -> Asset:
    return read(put(folder, {"main.xml": model(inside, before)}))


def assert_as_in_mujoco(asset: Asset, path: Path) -> None:
    """The collision geoms are those that MuJoCo compiles from the same file, at the same places."""
    compiled = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(compiled)
    mujoco.mj_kinematics(compiled, data)
    colliding = np.flatnonzero((compiled.geom_contype != 0) | (compiled.geom_conaffinity != 0)).tolist()
    assert len(asset.geoms) + len(asset.non_convex) == len(colliding)
    hulls: Iterator[Geom | NonConvexPiece] = iter(asset.geoms)
    others: Iterator[Geom | NonConvexPiece] = iter(asset.non_convex)
    read = [next(hulls if mujoco.mjtGeom(int(compiled.geom_type[k])) in KINDS else others) for k in colliding]
    for piece, k in zip(read, colliding, strict=True):
        place = Pose(data.geom_xmat[k].reshape(3, 3), data.geom_xpos[k])
        kind = KINDS.get(mujoco.mjtGeom(int(compiled.geom_type[k])))
        own = compiled.geom(k).name
        assert f"/{piece.name}".endswith(f"/{own}") if own else piece.name.split("/")[-1].startswith("geom")
        assert piece.body == (compiled.body(int(compiled.geom_bodyid[k])).name or piece.body)
        if isinstance(piece, NonConvexPiece):
            assert kind is None
            continue
        assert piece.shape.kind == kind, piece.name
        _assert_same(piece, compiled, k, place)


def _assert_same(piece: Geom, compiled: mujoco.MjModel, k: int, place: Pose) -> None:
    size = compiled.geom_size[k]
    match piece.shape:
        case Box(pose, half):
            np.testing.assert_array_equal(half, size)
        case Ellipsoid(pose, radii):
            np.testing.assert_array_equal(radii, size)
        case Sphere(pose, radius):
            assert radius == size[0]
        case Capsule(pose, radius, half_length) | Cylinder(pose, radius, half_length):
            assert (radius, half_length) == (size[0], size[1])
        case hull:
            reach = np.array([hull.support(direction) @ direction for direction in DIRECTIONS])
            points = place.apply(mesh_vertices(compiled, int(compiled.geom_dataid[k])))
            np.testing.assert_allclose(reach, (points @ DIRECTIONS.T).max(axis=0), atol=2e-6 * float(np.ptp(points)))
            return
    # MuJoCo takes frames that differ by less than 1e-6 of their size for the same one
    np.testing.assert_allclose(pose.rotation, place.rotation, atol=1e-8)
    np.testing.assert_allclose(pose.translation, place.translation, atol=1e-8)


def mesh_vertices(compiled: mujoco.MjModel, mesh: int) -> Floats:
    first, count = compiled.mesh_vertadr[mesh], compiled.mesh_vertnum[mesh]
    vertices: Floats = compiled.mesh_vert[first : first + count].astype(np.float64)
    return vertices
