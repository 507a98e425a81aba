"""Whether MuJoCo finds in an edited file what it found before, but for what the edit says."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf.collision_edit import NewGeom, OldGeom
from meshforge.formats.mjcf.model import MjcfModel
from meshforge.formats.mjcf.shapes import MjcfShapes
from meshforge.geometry import Floats, Shape

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
_NOT_COMPARED = (
    *("sensor_objid", "sensor_refid", "site_dataid"),  # numbers of geoms and meshes, which shift
    *("cam_poscom0", "light_poscom0", "site_sameframe"),  # follow from masses, which are compared themselves
    "dof_length",  # how far geoms reach from a joint
    "flex_bvhadr",  # a place behind the bounding volumes of all geoms
)

INHERITED = tuple(
    f"geom_{name}"
    for name in (
        *("contype", "conaffinity", "condim", "priority", "group", "matid", "friction", "solmix", "solref", "solimp"),
        *("margin", "gap", "user", "rgba", "surfacevel", "adhesion", "castshadow"),
    )
)
"""What a made geom has from its parent."""

_OF_GEOM = (
    *INHERITED,
    *(f"geom_{name}" for name in ("type", "size", "aabb", "rbound", "pos", "quat", "fluid", "plugin", "bodyid")),
)
_OF_MESH = ("mesh_pos", "mesh_quat", "mesh_scale", "mesh_vertnum", "mesh_facenum")

_SINGLE = 3e-7  # relative: MuJoCo keeps vertices in single precision
_POSE = 1e-9  # relative: a pose through quaternions and frames

MASS_FIELDS = ("body_mass", "body_inertia", "body_ipos", "body_iquat")


def find_differences(
    before: MjcfModel, after: MjcfModel, expected: Sequence[OldGeom | NewGeom], masses: bool
) -> Iterator[str]:
    """What an edited file says otherwise than it should.

    expected: the geoms of the edited model; masses: whether masses are to be as before.
    """
    if after.model.ngeom != len(expected):
        yield f"{after.model.ngeom} geoms where {len(expected)} were expected"
        return
    yield from _compare_fields(before.model, after.model, masses)
    yield from _compare_meshes(before.model, after.model, before.is_whole)
    number = {entry.number: k for k, entry in enumerate(expected) if isinstance(entry, OldGeom)}
    yield from _compare_kept(before, after, number)
    made = {k: entry for k, entry in enumerate(expected) if isinstance(entry, NewGeom)}
    renewed = {before.names.index(e.geom.name): k for k, e in made.items() if e.geom.name in before.names}
    yield from _compare_references(before.model, after.model, renewed | number)
    yield from _compare_new_geoms(before, after, made)


def _compare_fields(one: mujoco.MjModel, other: mujoco.MjModel, masses: bool) -> Iterator[str]:
    names = [n for n in dir(one) if n.startswith(_OTHERS) and not n.endswith("pathadr")]
    plain = [name for name in names if name not in _NOT_COMPARED and name not in _OF_MASS]
    for name in [*_OF_BODY, *(_OF_MASS if masses else ()), *plain]:
        if not is_equal(one, other, name, slice(None), slice(None)):
            yield name


def _compare_meshes(one: mujoco.MjModel, other: mujoco.MjModel, is_whole: bool) -> Iterator[str]:
    """The meshes that differ; is_whole: whether both models are, where meshes stay that no geom uses any more."""
    there = {other.mesh(k).name for k in range(other.nmesh)}
    for k in range(one.nmesh):
        name = one.mesh(k).name
        if name and name not in there:
            if is_whole:
                yield f"mesh {name!r}"
            continue
        m = other.mesh(name).id if name else k
        vertices = [slice(n.mesh_vertadr[i], n.mesh_vertadr[i] + n.mesh_vertnum[i]) for n, i in ((one, k), (other, m))]
        is_kept = all(is_equal(one, other, field, k, m) for field in _OF_MESH)
        if not (is_kept and is_equal(one, other, "mesh_vert", *vertices)):
            yield f"mesh {name!r}"


def _compare_kept(before: MjcfModel, after: MjcfModel, number: dict[int, int]) -> Iterator[str]:
    """The geoms that stay; number: what the number of each has become."""
    one, other = before.model, after.model
    for field in _OF_GEOM:
        if not is_equal(one, other, field, list(number), list(number.values())):
            yield field
    for a, b in number.items():
        if before.spec_geoms[a].name not in ("", after.spec_geoms[b].name):
            yield f"the name of geom {before.names[a]!r}"
        if _data_name(one, a) != _data_name(other, b):
            yield f"the mesh of geom {before.names[a]!r}"


def _compare_references(one: mujoco.MjModel, other: mujoco.MjModel, number: dict[int, int]) -> Iterator[str]:
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
    data = int(model.geom_dataid[geom])
    of_mesh = model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_HFIELD
    return "" if data < 0 else str(model.mesh(data).name if of_mesh else model.hfield(data).name)


def _compare_new_geoms(before: MjcfModel, after: MjcfModel, made: dict[int, NewGeom]) -> Iterator[str]:
    """What is not as it should be; made: the new geoms by their numbers after the edit."""
    shapes = MjcfShapes(after.model)
    origins = {name: pose.translation for name, pose in zip(after.body_names, after.body_poses, strict=True)}
    for k, entry in made.items():
        hull = entry.geom
        shape = shapes.part_of(k, after.geom_poses[k]).shape
        if after.body_of[k] != hull.body or not _is_same_shape(shape, hull.shape, origins[hull.body]):
            yield f"the geometry of hull {hull.name!r}"
        if hull.parent in before.names:
            parent = before.names.index(hull.parent)
            wrong = [field for field in INHERITED if not is_equal(before.model, after.model, field, parent, k)]
            yield from (f"{field} of hull {hull.name!r}" for field in wrong)


def _is_same_shape(found: Shape | None, wanted: Shape, origin: Floats) -> bool:
    if found is None or found.kind != wanted.kind:
        return False
    size = float(np.linalg.norm(wanted.aabb.size))
    away = float(np.linalg.norm(wanted.aabb.center - origin))
    if not found.is_primitive:
        return _reach_difference(found, wanted) <= _SINGLE * (size + min(away, 1000.0 * size)) + _POSE * away
    corners, others = (shape.tessellate().vertices for shape in (found, wanted))  # each about its own axes
    return bool(np.abs(corners - others).max() <= _POSE * (size + away))


def _reach_difference(one: Shape, other: Shape) -> float:
    """How far two polytopes reach differently, along the normals of their faces."""
    normals = np.concatenate([_face_normals(shape) for shape in (one, other)])
    reach, reach_of_other = ((shape.vertices @ normals.T).max(axis=0) for shape in (one, other))
    return float(np.abs(reach - reach_of_other).max())


def _face_normals(shape: Shape) -> Floats:
    a, b, c = (shape.vertices[shape.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    return np.asarray(normals[lengths > 0] / lengths[lengths > 0][:, None])


def is_equal(
    one: mujoco.MjModel,
    other: mujoco.MjModel,
    field: str,
    rows: int | slice | list[int],
    rows_of_other: int | slice | list[int],
) -> bool:
    """Whether rows of a field are the same in two models; a field that this MuJoCo has not is.

    Numbers of the user's that a geom does not have are zeros, as many as the geom with most of them has.
    """
    if not hasattr(one, field):
        return True
    a, b = np.asarray(getattr(one, field)[rows]), np.asarray(getattr(other, field)[rows_of_other])
    if field == "geom_user":
        both = min(a.shape[-1], b.shape[-1])
        if a[..., both:].any() or b[..., both:].any():
            return False
        a, b = a[..., :both], b[..., :both]
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def find_changed_masses(before: MjcfModel, after: MjcfModel) -> list[int]:
    """The bodies of another mass, centre or inertia, by number."""
    differ = np.zeros(before.model.nbody, dtype=bool)
    for field in MASS_FIELDS:
        one, other = (getattr(r.model, field).reshape(len(differ), -1) for r in (before, after))
        differ |= (one != other).any(axis=1)
    return [int(k) for k in np.flatnonzero(differ)]
