"""MuJoCo: MJCF, URDF, and mesh files, of which each becomes one hull."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.loads.readers.base import Place, Reader, Seen, box, capsule, cylinder, ellipsoid, hull

_WHOLE = b'<mujoco><compiler strippath="false" fusestatic="false"/></mujoco></robot>'


def _shapes(path: Path) -> Iterator[Seen]:
    import mujoco

    model = _model(path)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for k in np.flatnonzero((model.geom_contype != 0) | (model.geom_conaffinity != 0)):
        size, place = model.geom_size[k], Place(data.geom_xmat[k].reshape(3, 3), data.geom_xpos[k])
        match mujoco.mjtGeom(int(model.geom_type[k])):
            case mujoco.mjtGeom.mjGEOM_BOX:
                yield box(size, place)
            case mujoco.mjtGeom.mjGEOM_SPHERE:
                yield ellipsoid(size[0], place, "sphere")
            case mujoco.mjtGeom.mjGEOM_ELLIPSOID:
                yield ellipsoid(size, place)
            case mujoco.mjtGeom.mjGEOM_CAPSULE:
                yield capsule(size[0], size[1], place)
            case mujoco.mjtGeom.mjGEOM_CYLINDER:
                yield cylinder(size[0], size[1], place)
            case mujoco.mjtGeom.mjGEOM_MESH:
                mesh = int(model.geom_dataid[k])
                first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
                yield hull(model.mesh_vert[first : first + count], place)


def _model(path: Path) -> Any:
    """The compiled model of a description, or of one with nothing but a mesh file in it."""
    import mujoco

    if path.suffix == ".xml":
        return mujoco.MjModel.from_xml_path(str(path))
    if path.suffix != ".urdf":
        mesh = f'<mesh name="m" file="{path.resolve()}" inertia="convex"/>'
        geom = '<geom type="mesh" mesh="m"/>'
        text = f"<mujoco><asset>{mesh}</asset><worldbody>{geom}</worldbody></mujoco>"
        return mujoco.MjModel.from_xml_string(text)
    with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".urdf") as copy:
        copy.write(path.read_bytes().replace(b"</robot>", _WHOLE))
        copy.flush()
        return mujoco.MjModel.from_xml_path(copy.name)


READER = Reader(
    "MuJoCo",
    "mujoco",
    "mujoco",
    {".xml": "shape", ".urdf": "shape", ".obj": "file", ".stl": "file"},
    _shapes,
    about="A URDF is given MuJoCo's own `strippath=false`, so that meshes are found in their folders.",
)
