"""Whether MuJoCo finds in an edited file what it found before, but for what the edit says."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.mjcf.writing.places import Kept, Made
from meshforge.formats.mjcf.writing.same_made import INHERITED, equal, made_amiss

if TYPE_CHECKING:
    import mujoco

_OF_BODY = tuple(
    f"body_{name}"
    for name in (
        *("parentid", "rootid", "weldid", "mocapid", "jntnum", "jntadr", "dofnum", "dofadr"),
        *("pos", "quat", "gravcomp", "user", "plugin"),
    )
)
_OF_MASS = (
    *("body_mass", "body_inertia", "body_ipos", "body_iquat", "body_subtreemass", "body_invweight0"),
    *("dof_M0", "dof_invweight0", "dof_simplenum", "tendon_invweight0", "actuator_acc0"),
    *("dof_damping", "jnt_stiffness", "actuator_gainprm", "actuator_biasprm", "actuator_lengthrange"),
)
_OTHERS = (
    *("jnt_", "dof_", "site_", "cam_", "light_", "mat_", "eq_", "tendon_", "actuator_", "sensor_", "exclude_"),
    *("numeric_", "text_", "key_", "skin_", "flex_", "hfield_", "plugin"),
)
_APART = (
    *("sensor_objid", "sensor_refid", "site_dataid"),  # numbers of geoms and meshes, which shift
    *("cam_poscom0", "light_poscom0", "site_sameframe"),  # follow from masses, which are compared themselves
    "dof_length",  # how far geoms reach from a joint
    "flex_bvhadr",  # a place behind the bounding volumes of all geoms
)
_OF_GEOM = (
    *INHERITED,
    *(f"geom_{name}" for name in ("type", "size", "aabb", "rbound", "pos", "quat", "fluid", "plugin", "bodyid")),
)
_OF_MESH = ("mesh_pos", "mesh_quat", "mesh_scale", "mesh_vertnum", "mesh_facenum")


def difference(
    before: Reading, after: Reading, expected: Sequence[Kept | Made], masses: bool, is_whole: bool = True
) -> str | None:
    """The first thing that an edited file says otherwise than it should, None where all is right.

    expected: the geoms of the edited model; masses: whether masses are to be as before; is_whole: whether both are
    of all that the file says, so that meshes stay which no geom uses any more.
    """
    return next(_differences(before, after, expected, masses, is_whole), None)


def _differences(
    before: Reading, after: Reading, expected: Sequence[Kept | Made], masses: bool, is_whole: bool
) -> Iterator[str]:
    if after.model.ngeom != len(expected):
        yield f"{after.model.ngeom} geoms where {len(expected)} were expected"
        return
    yield from _fields(before.model, after.model, masses)
    yield from _meshes(before.model, after.model, is_whole)
    number = {entry.number: k for k, entry in enumerate(expected) if isinstance(entry, Kept)}
    yield from _kept(before, after, number)
    yield from _references(before.model, after.model, number)
    yield from made_amiss(before, after, {k: entry for k, entry in enumerate(expected) if isinstance(entry, Made)})


def _fields(one: mujoco.MjModel, other: mujoco.MjModel, masses: bool) -> Iterator[str]:
    """What belongs neither to geoms nor to meshes."""
    names = [n for n in dir(one) if n.startswith(_OTHERS) and not n.endswith("pathadr")]
    plain = [name for name in names if name not in _APART and name not in _OF_MASS]
    for name in [*_OF_BODY, *(_OF_MASS if masses else ()), *plain]:
        if not equal(one, other, name, slice(None), slice(None)):
            yield name


def _meshes(one: mujoco.MjModel, other: mujoco.MjModel, is_whole: bool) -> Iterator[str]:
    """The authored meshes, by name."""
    there = {other.mesh(k).name for k in range(other.nmesh)}
    for k in range(one.nmesh):
        name = one.mesh(k).name
        if name and name not in there:
            if is_whole:
                yield f"mesh {name!r}"
            continue
        m = other.mesh(name).id if name else k
        vertices, now = (
            slice(n.mesh_vertadr[i], n.mesh_vertadr[i] + n.mesh_vertnum[i]) for n, i in ((one, k), (other, m))
        )
        if not (all(equal(one, other, f, k, m) for f in _OF_MESH) and equal(one, other, "mesh_vert", vertices, now)):
            yield f"mesh {name!r}"


def _vertices(model: mujoco.MjModel, mesh: int) -> slice:
    start = int(model.mesh_vertadr[mesh])
    return slice(start, start + int(model.mesh_vertnum[mesh]))


def _kept(before: Reading, after: Reading, number: dict[int, int]) -> Iterator[str]:
    """The geoms that stay; number: what the number of each has become."""
    one, other = before.model, after.model
    for field in _OF_GEOM:
        if not equal(one, other, field, list(number), list(number.values())):
            yield field
    for a, b in number.items():
        if before.spec_geoms[a].name not in ("", after.spec_geoms[b].name):
            yield f"the name of geom {before.names[a]!r}"
        if _data_name(one, a) != _data_name(other, b):
            yield f"the mesh of geom {before.names[a]!r}"


def _references(one: mujoco.MjModel, other: mujoco.MjModel, number: dict[int, int]) -> Iterator[str]:
    """Numbers of geoms, where other elements refer to them."""
    import mujoco

    geom, wraps = mujoco.mjtObj.mjOBJ_GEOM, (mujoco.mjtWrap.mjWRAP_SPHERE, mujoco.mjtWrap.mjWRAP_CYLINDER)
    kinds = {
        "pair_geom1": np.ones(one.npair, bool),
        "pair_geom2": np.ones(one.npair, bool),
        "sensor_objid": one.sensor_objtype == geom,
        "sensor_refid": one.sensor_reftype == geom,
        "tuple_objid": one.tuple_objtype == geom,
        "wrap_objid": np.isin(one.wrap_type, wraps),
    }
    for field, refers in kinds.items():
        pairs = zip(getattr(one, field).tolist(), refers, strict=True)
        wanted = [number.get(k) if is_geom else k for k, is_geom in pairs]
        if wanted != getattr(other, field).tolist():
            yield field


def _data_name(model: mujoco.MjModel, geom: int) -> str:
    """The mesh of a geom, or that it has none."""
    import mujoco

    data = int(model.geom_dataid[geom])
    of_mesh = model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_HFIELD
    return "" if data < 0 else str(model.mesh(data).name if of_mesh else model.hfield(data).name)
