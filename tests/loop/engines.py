"""What engines see of the edited files of a loop."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from meshforge.formats import load
from tests.mesh_engines import Bullet, bounds, mujoco_hull, objects
from tests.urdf_engines import bullet, mujoco_model


def assert_engines_see_hulls(path: Path) -> None:
    """Trimesh, MuJoCo and PyBullet see the hulls of an OBJ."""
    mesh = load(path)
    assert mesh.aabb is not None and len(objects(path)) == len(mesh.hulls)
    corners, seen = np.array([mesh.aabb.min, mesh.aabb.max]), mujoco_hull(path)
    np.testing.assert_allclose(bounds(path), corners, atol=1e-6)
    np.testing.assert_allclose([seen.min(axis=0), seen.max(axis=0)], corners, atol=1e-6)
    with Bullet(path) as engine:
        np.testing.assert_allclose(engine.bounds, corners, atol=0.021)  # PyBullet adds its margin


def assert_engines_keep_masses(before: Path, after: Path) -> None:
    """PyBullet and MuJoCo have a shape a hull of a URDF of one link, and the masses that it had."""
    hulls, one, other = len(load(after).hulls), bullet(before), bullet(after)
    assert [len(shapes) for shapes in other["shapes"]] == [hulls] and other["dynamics"] == one["dynamics"]
    was, model = mujoco_model(before), mujoco_model(after)
    assert model.ngeom == hulls
    np.testing.assert_array_equal(model.body_mass, was.body_mass)
    np.testing.assert_array_equal(model.body_inertia, was.body_inertia)
