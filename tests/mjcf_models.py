"""Two compiled MJCF, one edited from the other: all that MuJoCo compiles is the same but for the edited geoms."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
from mujoco.introspect import structs

from meshforge.formats.base import Mass, Output
from meshforge.formats.mjcf.format import MjcfFormat
from meshforge.geometry import Floats, Shape
from meshforge.symbolic import Asset, Geom
from tests.mjcf_engines import DIRECTIONS, KINDS, mesh_vertices
from tests.urdf_sample import put as put_output

Rows = list[int]

# what follows from the set of geoms, or counts geoms, meshes, names and bounding volumes
_OF_GEOMS = (
    *("body_geomnum", "body_geomadr", "body_bvhadr", "body_bvhnum", "body_contype", "body_conaffinity", "body_margin"),
    *("flex_bvhadr", "site_dataid", "dof_length", "geom_dataid", "geom_sameframe"),
    *("sensor_objid", "sensor_refid", "tuple_objid", "wrap_objid", "pair_geom1", "pair_geom2"),  # compared by name
)
_COUNTS = ("ngeom", "nmesh", "nbvh", "nbvhstatic", "nnames", "nnames_map", "npaths", "noct")
_OF_MASS = (
    *("body_mass", "body_inertia", "body_ipos", "body_iquat", "body_subtreemass", "body_invweight0"),
    *("body_sameframe", "body_simple", "dof_M0", "dof_invweight0", "dof_simplenum", "tendon_invweight0"),
    *("actuator_acc0", "site_sameframe", "cam_poscom0", "light_poscom0", "cam_pos0", "light_pos0"),
)
_INHERITED = (
    *("contype", "conaffinity", "condim", "priority", "group", "matid", "friction", "solmix", "solref", "solimp"),
    *("margin", "gap", "user", "rgba", "adhesion", "surfacevel", "castshadow"),
)


def write(asset: Asset, folder: Path, mass: Mass = "keep") -> tuple[Path, Output]:
    """An asset on disk, its main file called as it was."""
    output = MjcfFormat().write(asset, asset.path.name, mass)
    return put_output(output, folder / asset.path.name), output


def compiled(path: Path) -> mujoco.MjModel:
    """What MuJoCo makes of a file; its warnings go nowhere, else it leaves a log in the current folder."""
    config = mujoco.MjLogConfig.get()
    before = config.logto_console, config.logto_file
    config.logto_console = config.logto_file = False
    config.set()
    try:
        return mujoco.MjModel.from_xml_path(str(path))
    finally:
        config.logto_console, config.logto_file = before
        config.set()


def hull_names(model: mujoco.MjModel) -> list[str]:
    """What MeshForge calls each geom of a model in which no body has copies."""
    names = []
    for k in range(model.ngeom):
        body = int(model.geom_bodyid[k])
        on = model.body(body).name or f"body{body}"
        own = model.geom(k).name.removeprefix(f"{on}/") or f"geom{k - int(model.body_geomadr[body])}"
        names.append(f"{on}/{own}")
    return names


@dataclass(frozen=True)
class Pair:
    """A model before and after an edit."""

    before: mujoco.MjModel
    after: mujoco.MjModel

    def assert_same(self, *, removed: Collection[str] = (), made: Iterable[Geom] = (), masses: bool = True) -> None:
        """All that MuJoCo compiled is the same bit for bit, but for some removed and some made hulls."""
        made = list(made)
        old, new = hull_names(self.before), hull_names(self.after)
        kept = [name for name in old if name not in removed]
        assert [name for name in new if name not in {geom.name for geom in made}] == kept
        rows = [old.index(name) for name in kept], [new.index(name) for name in kept]
        self._assert_fields(rows, masses)
        self._assert_data(rows)
        self._assert_references()
        for geom in made:
            self._assert_made(geom, new.index(geom.name))
            if geom.parent is not None:
                self._assert_inherited(old.index(geom.parent), new.index(geom.name))

    def _assert_fields(self, rows: tuple[Rows, Rows], masses: bool) -> None:
        left_out = {*_OF_GEOMS, *(() if masses else _OF_MASS)}
        for field in structs.STRUCTS["mjModel"].fields:
            extent = getattr(field, "array_extent", ())
            skipped = field.name in left_out or "pathadr" in field.name or field.name.startswith(("name_", "mesh_"))
            if not extent or skipped or (extent[0] in _COUNTS and extent[0] != "ngeom"):
                continue
            one, other = getattr(self.before, field.name), getattr(self.after, field.name)
            if extent[0] == "ngeom":
                one, other = one[rows[0]], other[rows[1]]
            np.testing.assert_array_equal(one, other, err_msg=field.name)
        for kind in (mujoco.mjtObj.mjOBJ_BODY, mujoco.mjtObj.mjOBJ_JOINT, mujoco.mjtObj.mjOBJ_SENSOR):
            assert [_name(self.before, kind, k) for k in range(9)] == [_name(self.after, kind, k) for k in range(9)]

    def _assert_data(self, rows: tuple[Rows, Rows]) -> None:
        """Geoms have the meshes that they had, and these the vertices."""
        for a, b in zip(*rows, strict=True):
            one, other = int(self.before.geom_dataid[a]), int(self.after.geom_dataid[b])
            assert (one < 0) == (other < 0)
            if one >= 0 and self.before.geom_type[a] == mujoco.mjtGeom.mjGEOM_MESH:
                assert self.before.mesh(one).name == self.after.mesh(other).name
                np.testing.assert_array_equal(mesh_vertices(self.before, one), mesh_vertices(self.after, other))

    def _assert_references(self) -> None:
        """Pairs, sensors, tuples and tendons refer to the geoms that they referred to."""
        assert _references(self.before) == _references(self.after)

    def _assert_made(self, hull: Geom, k: int) -> None:
        data = mujoco.MjData(self.after)
        mujoco.mj_kinematics(self.after, data)
        assert KINDS[mujoco.mjtGeom(int(self.after.geom_type[k]))] == hull.shape.kind
        reach = np.array([hull.shape.support(d / np.linalg.norm(d)) @ d for d in DIRECTIONS])
        size = float(hull.shape.aabb.size.max())
        far = size + float(np.abs(hull.shape.aabb.center - data.xpos[self.after.geom_bodyid[k]]).max())
        # MuJoCo keeps vertices in single precision, and takes frames that differ by less than 1e-6 for the same one
        near = (2e-6 if hull.shape.kind == "polytope" else 1e-6) * far
        np.testing.assert_allclose(_reach(self.after, data, k), reach, atol=near, rtol=0)

    def _assert_inherited(self, parent: int, k: int) -> None:
        for name in _INHERITED:
            one, other = (getattr(m, f"geom_{name}")[n] for m, n in ((self.before, parent), (self.after, k)))
            np.testing.assert_array_equal(one, other, err_msg=name)


def _name(model: mujoco.MjModel, kind: mujoco.mjtObj, k: int) -> str | None:
    name: str | None = mujoco.mj_id2name(model, kind, k)
    return name


def _references(model: mujoco.MjModel) -> dict[str, list[object]]:
    geom = int(mujoco.mjtObj.mjOBJ_GEOM)
    typed = {"sensor_obj": "sensor_objtype", "sensor_ref": "sensor_reftype", "tuple_obj": "tuple_objtype"}
    found: dict[str, list[object]] = {
        name: [model.geom(k).name for k in getattr(model, f"{name}")] for name in ("pair_geom1", "pair_geom2")
    }
    for name, kind in typed.items():
        ids, kinds = getattr(model, f"{name}id").tolist(), getattr(model, kind).tolist()
        found[name] = [model.geom(k).name if t == geom else (t, k) for k, t in zip(ids, kinds, strict=True)]
    wraps = zip(model.wrap_objid.tolist(), model.wrap_type.tolist(), strict=True)
    round_ = (int(mujoco.mjtWrap.mjWRAP_SPHERE), int(mujoco.mjtWrap.mjWRAP_CYLINDER))
    found["wrap"] = [model.geom(k).name if t in round_ else (t, k) for k, t in wraps]
    return found


def _reach(model: mujoco.MjModel, data: mujoco.MjData, k: int) -> Floats:
    """How far a geom reaches along `DIRECTIONS`."""
    rotation, centre = data.geom_xmat[k].reshape(3, 3), data.geom_xpos[k]
    size, kind = model.geom_size[k], KINDS[mujoco.mjtGeom(int(model.geom_type[k]))]
    found: Floats
    if kind == "polytope":
        points = mesh_vertices(model, int(model.geom_dataid[k])) @ rotation.T + centre
        found = (points @ DIRECTIONS.T).max(axis=0)
        return found
    local = DIRECTIONS @ rotation
    length = np.linalg.norm(local, axis=1)
    match kind:
        case "box":
            out = np.abs(local) @ size
        case "ellipsoid":
            out = np.linalg.norm(local * size, axis=1)
        case "sphere":
            out = size[0] * length
        case "capsule":
            out = size[0] * length + size[1] * np.abs(local[:, 2])
        case _:
            out = size[0] * np.linalg.norm(local[:, :2], axis=1) + size[1] * np.abs(local[:, 2])
    found = out + DIRECTIONS @ centre
    return found


def replaced(asset: Asset, gone: Collection[str], *made: Geom) -> Asset:
    """The asset without some hulls, and with some made ones after the others."""
    assert set(gone) <= {geom.name for geom in asset.geoms}
    return asset.with_geoms([*(geom for geom in asset.geoms if geom.name not in gone), *made])


def hull(asset: Asset, parent: str, shape: Shape, number: int = 1) -> Geom:
    """A made hull in the place of a hull, from which it inherits."""
    body = next(geom.body for geom in asset.geoms if geom.name == parent)
    return Geom(f"{parent}~{number}", body, shape, parent)
