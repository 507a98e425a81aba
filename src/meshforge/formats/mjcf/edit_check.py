"""Whether MuJoCo finds in an edited file what it found before, but for what the edit says."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf.geom_edits import GeomEdits
from meshforge.formats.mjcf.model import MjcfModel
from meshforge.geometry import Floats, Shape

_OF_BODY = tuple(
    f"body_{name}"
    for name in (
        *("parentid", "rootid", "weldid", "mocapid", "jntnum", "jntadr", "dofnum", "dofadr"),
        *("pos", "quat", "gravcomp", "user", "plugin"),
    )
)
_MASS_FIELDS = ("body_mass", "body_inertia", "body_ipos", "body_iquat")
_OF_MASS = (
    *(*_MASS_FIELDS, "body_subtreemass", "body_invweight0"),
    *("dof_M0", "dof_invweight0", "dof_simplenum", "tendon_invweight0", "actuator_acc0"),
    *("dof_damping", "jnt_stiffness", "actuator_gainprm", "actuator_biasprm", "actuator_lengthrange"),
)
_OTHERS = (
    *("jnt_", "dof_", "site_", "cam_", "light_", "mat_", "eq_", "tendon_", "actuator_", "sensor_", "exclude_"),
    *("numeric_", "text_", "key_", "skin_", "flex_", "hfield_", "plugin"),
)
_NOT_COMPARED = (
    *("sensor_objid", "sensor_refid", "site_dataid"),  # numbers of geoms and meshes, which shift; names are compared
    *("cam_poscom0", "light_poscom0", "site_sameframe"),  # follow from masses, which are compared themselves
    "dof_length",  # how far geoms reach from a joint
    "flex_bvhadr",  # a place behind the bounding volumes of all geoms
)

_INHERITED = tuple(
    f"geom_{name}"
    for name in (
        *("contype", "conaffinity", "condim", "priority", "group", "matid", "friction", "solmix", "solref", "solimp"),
        *("margin", "gap", "user", "rgba", "surfacevel", "adhesion", "castshadow"),
    )
)
"""What a new geom has from its parent."""

_OF_GEOM = (
    *_INHERITED,
    *(f"geom_{name}" for name in ("type", "size", "aabb", "rbound", "pos", "quat", "fluid", "plugin", "bodyid")),
)

_SINGLE = 3e-7  # relative: MuJoCo keeps vertices in single precision
_POSE = 1e-9  # relative: a pose through quaternions and frames


def find_differences(before: MjcfModel, after: MjcfModel, edit: GeomEdits, masses: bool) -> Iterator[str]:
    """Yield what an edited file says otherwise than it should; masses: whether they are to be as before.

    Elements refer to geoms by names, and the text of other elements is as it was: where names are right, so are these.
    """
    if after.model.ngeom != len(edit.geoms):
        yield f"{after.model.ngeom} geoms where {len(edit.geoms)} were expected"
        return
    names = [name for name in dir(before.model) if name.startswith(_OTHERS) and not name.endswith("pathadr")]
    plain = [name for name in names if name not in _NOT_COMPARED and name not in _OF_MASS]
    for name in [*_OF_BODY, *(_OF_MASS if masses else ()), *plain]:
        if not _is_equal(before.model, after.model, name, slice(None), slice(None)):
            yield name
    kept = {geom.number: k for k, geom in enumerate(edit.geoms) if geom.number is not None}
    for field in _OF_GEOM:
        if not _is_equal(before.model, after.model, field, list(kept), list(kept.values())):
            yield field
    for k, (geom, read) in enumerate(zip(edit.geoms, edit.read_names(), strict=True)):
        if (after.spec_geoms[k].name, after.names[k]) != (geom.attribute, read):
            yield f"the name of geom {geom.name!r}"
        if geom.number is not None and _data_name(before.model, geom.number) != _data_name(after.model, k):
            yield f"the mesh of geom {geom.name!r}"
    yield from _compare_new_geoms(before, after, edit)


def _data_name(model: mujoco.MjModel, geom: int) -> str:
    data = int(model.geom_dataid[geom])
    of_mesh = model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_HFIELD
    return "" if data < 0 else str(model.mesh(data).name if of_mesh else model.hfield(data).name)


def _compare_new_geoms(before: MjcfModel, after: MjcfModel, edit: GeomEdits) -> Iterator[str]:
    origins = {name: pose.translation for name, pose in zip(after.body_names, after.body_poses, strict=True)}
    for k, hull in enumerate(geom.hull for geom in edit.geoms):
        if hull is None:
            continue
        shape = after.read_piece(k).shape
        if after.body_of[k] != hull.body or not _is_same_shape(shape, hull.shape, origins[hull.body]):
            yield f"the geometry of hull {hull.name!r}"
        if hull.parent in before.names:
            parent = before.names.index(hull.parent)
            wrong = [field for field in _INHERITED if not _is_equal(before.model, after.model, field, parent, k)]
            yield from (f"{field} of hull {hull.name!r}" for field in wrong)


def _is_same_shape(found: Shape | None, wanted: Shape, origin: Floats) -> bool:
    if found is None or found.kind != wanted.kind:
        return False
    size = float(np.linalg.norm(wanted.aabb.size))
    away = float(np.linalg.norm(wanted.aabb.center - origin))
    if found.is_primitive:
        corners, others = (shape.tessellate().vertices for shape in (found, wanted))  # each about its own axes
        return bool(np.abs(corners - others).max() <= _POSE * (size + away))
    normals = np.concatenate([_face_normals(shape) for shape in (found, wanted)])
    reach, wanted_reach = ((shape.vertices @ normals.T).max(axis=0) for shape in (found, wanted))
    near = _SINGLE * (size + min(away, 1000.0 * size)) + _POSE * away
    return bool(np.abs(reach - wanted_reach).max() <= near)


def _face_normals(shape: Shape) -> Floats:
    a, b, c = (shape.vertices[shape.faces[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    return np.asarray(normals[lengths > 0] / lengths[lengths > 0][:, None])


def _is_equal(
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
    """Return the bodies of another mass, centre or inertia, by number."""
    differ = np.zeros(before.model.nbody, dtype=bool)
    for field in _MASS_FIELDS:
        one, other = (getattr(r.model, field).reshape(len(differ), -1) for r in (before, after))
        differ |= (one != other).any(axis=1)
    return [int(k) for k in np.flatnonzero(differ)]
