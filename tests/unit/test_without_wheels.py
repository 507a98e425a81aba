"""What needs a library that has no wheel for some platform says so there."""

import sys
from pathlib import Path

import numpy as np
import pytest

from meshforge.checks import CheckOptions, examine_mesh
from meshforge.common import MeshForgeError
from meshforge.formats import load, read
from meshforge.geometry import Box, Pose
from meshforge.rendering.scene import build_scene, prepare_for_rays, to_render_mesh
from tests.unit.batch.families import write_table


def test_a_picture_without_embreex_is_an_error_that_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    scene = build_scene([to_render_mesh(Box(Pose.identity(), np.ones(3)))], np.zeros(3), 1.0)
    with pytest.raises(MeshForgeError, match="pictures need embreex, which is not installed"):
        prepare_for_rays(scene, None)


def test_without_mujoco_mjcf_and_physics_are_errors_naming_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "mujoco", None)
    path = tmp_path / "box.xml"
    path.write_text('<mujoco><worldbody><geom size="1 1 1" type="box"/></worldbody></mujoco>')
    with pytest.raises(MeshForgeError, match=r"box\.xml: an MJCF needs MuJoCo, which is not installed"):
        read(path)
    mesh = load(write_table(tmp_path / "table.obj"))
    with pytest.raises(MeshForgeError, match="the check of physics needs MuJoCo, which is not installed"):
        examine_mesh(mesh, CheckOptions(("physics",)))
    assert examine_mesh(mesh, CheckOptions(("mujoco",))).findings
