"""What MuJoCo says of a file as it is: whether it compiles it, and the shapes that it makes then."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.engines import EngineShape
from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf.compiler import collect_warnings, failure_types
from meshforge.geometry import Pose


@dataclass(frozen=True, slots=True)
class MujocoLoad:
    """What MuJoCo answers of a file as it is. version: of MuJoCo; refusal: why, None where it compiles the file;
    shapes: that collide, but for planes, height fields and signed distance fields."""

    version: str
    refusal: str | None
    warnings: tuple[str, ...] = ()
    shapes: tuple[EngineShape, ...] = ()


def try_in_mujoco(path: Path) -> MujocoLoad:
    """Compile an MJCF or a URDF with MuJoCo, with all files that it names.

    Its warnings are collected, and no log is written. Raises ImportError where MuJoCo is not installed.
    """
    version, refusal, shapes = str(mujoco.__version__), None, tuple[EngineShape, ...]()
    warnings: list[str] = []
    with collect_warnings(warnings):
        try:
            shapes = tuple(_read_shapes(mujoco.MjModel.from_xml_path(str(path))))
        except failure_types() as error:
            refusal = _join_lines(str(error)) or "it does not say why"
    return MujocoLoad(version, refusal, tuple(dict.fromkeys(map(_join_lines, warnings))), shapes)


def _join_lines(message: str) -> str:
    lines = [line.strip() for line in message.replace("XML Error: ", "").splitlines() if line.strip()]
    return "; ".join(line.removeprefix("Error: ") for line in lines)


def _read_shapes(model: mujoco.MjModel) -> Iterator[EngineShape]:
    """The shapes of geoms that collide, by contact bits or a `<pair>`, in the root frame at the reference pose."""
    from meshforge.formats.mjcf.model import read_primitive  # lazy: it needs MuJoCo as soon as it is imported

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    paired = {*model.pair_geom1.tolist(), *model.pair_geom2.tolist()}
    for k in range(model.ngeom):
        if not (model.geom_contype[k] or model.geom_conaffinity[k] or k in paired):
            continue
        pose = Pose(data.geom_xmat[k].reshape(3, 3), data.geom_xpos[k])
        margin = float(model.geom_margin[k])  # those of two geoms add up, from MuJoCo 4 on
        if model.geom_type[k] == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = int(model.geom_dataid[k])
            first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
            points = model.mesh_vert[first : first + count].astype(np.float64)
            if (start := int(model.mesh_graphadr[mesh])) >= 0:
                points = points[model.mesh_graph[start + 2 + model.mesh_graph[start] :][: model.mesh_graph[start]]]
            yield EngineShape.of(pose.apply(points), margin)
        elif (shape := read_primitive(model, k, pose)) is not None:
            yield EngineShape.of(shape, margin)
