"""Pictures where embreex has no wheel."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from meshforge.common import MeshForgeError
from meshforge.geometry import Box, Pose
from meshforge.rendering.scene import build_scene, prepare_for_rays, to_render_mesh


def test_a_picture_without_embreex_is_an_error_that_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    scene = build_scene([to_render_mesh(Box(Pose.identity(), np.ones(3)))], np.zeros(3), 1.0)
    with pytest.raises(MeshForgeError, match="pictures need embreex, which is not installed"):
        prepare_for_rays(scene, None)
