"""The `<geom>` elements of made hulls: copies of their parents' with another geometry, all else being inherited."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from meshforge.asset import Geom
from meshforge.errors import AssetError
from meshforge.formats.mjcf.elements import geom_attributes, mesh_geom_attributes, tag
from meshforge.formats.mjcf.files.sources import Node
from meshforge.formats.mjcf.writing.context import MAIN, Context
from meshforge.formats.mjcf.writing.hull_meshes import HullMeshes
from meshforge.formats.slots import Slot
from meshforge.formats.xml import attribute, shown
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Shape, Sphere

_TURNS = ("quat", "axisangle", "xyaxes", "zaxis", "euler")
_GEOMETRY = ("type", "size", "pos", *_TURNS, "fromto", "mesh", "hfield", "fitscale")
"""The attributes that make up the geometry of a geom; all others are inherited."""
_FAR = 1000.0  # sizes away from the origin of its body, a mesh would lose digits in MuJoCo's single precision


class Maker:
    """Makes elements for one document."""

    def __init__(self, context: Context, meshes: HullMeshes) -> None:
        self.context, self.meshes = context, meshes

    def make_beside(self, geom: Geom, root_t_body: Pose, parent: Node, parent_volume: float) -> Slot:
        """The element of a hull that stands right after that of its parent, in the same frame."""
        name = self.context.class_of(parent)
        set_by_class = self.context.defaults_of(name)
        said = self._geometry_attributes(geom, root_t_body, parent, self.context.body_t_frame(parent))
        if "fromto" in set_by_class:
            return self._spell_out_class(geom, parent, said, parent_volume)
        said = self._settle_attributes(geom, said, {**set_by_class, **_own(parent)}, set_by_class, parent_volume)
        data = self.context.tree.sources[parent.source].text.data
        changed = [key for key in (*_GEOMETRY, "mass", "shellinertia") if said.get(key) != parent.attributes.get(key)]
        edits = tuple(attribute(data, parent.element, key, said.get(key), last=True) for key in changed)
        return Slot(geom.body, (geom.name,), None, parent.element, edits, copy=True)

    def make_apart(self, geom: Geom, root_t_body: Pose, body: Node, parent: Node | None, parent_volume: float) -> Slot:
        """The element of a hull at the end of its body, with what it inherits from a parent that stands elsewhere."""
        said = self._geometry_attributes(geom, root_t_body, parent, Pose.identity())
        if parent is None:
            set_by_class = self.context.defaults_of(self.context.class_inside(body))
            if "fromto" in set_by_class:
                raise _not_undone(geom, self.context, body)
            said = self._settle_attributes(geom, said, set_by_class, set_by_class, 0.0)
            if set_by_class.get("contype") == "0" == set_by_class.get("conaffinity"):  # a class of visual geoms
                said |= {"contype": "1", "conaffinity": "1"}
            return Slot(geom.body, (geom.name,), text=tag("geom", said))
        return self._spell_out_class(geom, parent, said, parent_volume)

    def _geometry_attributes(self, geom: Geom, root_t_body: Pose, parent: Node | None, body_t_frame: Pose) -> dict[str, str]:
        """The geometry of a hull in the frame in which its element stands."""
        frame_t_body, body_t_root = body_t_frame.inverse(), root_t_body.inverse()
        shape = geom.shape
        if isinstance(shape, Box | Capsule | Cylinder | Ellipsoid | Sphere):
            return geom_attributes(replace(shape, pose=frame_t_body @ body_t_root @ shape.pose))
        shape = shape.move(body_t_root)
        own = _own(parent) if parent else {}
        said = {**(self.context.defaults_of(self.context.class_of(parent)) if parent else {}), **own}
        centre = _far_centre(shape)
        shape = shape.move(centre.inverse())
        mesh = self.meshes.add(geom.name, shape, said.get("mesh"), said.get("shellinertia") == "true")
        return mesh_geom_attributes(mesh, frame_t_body @ centre)

    def _settle_attributes(
        self,
        geom: Geom,
        said: Mapping[str, str],
        inherited: Mapping[str, str],
        set_by_class: Mapping[str, str],
        parent_volume: float,
    ) -> dict[str, str]:
        """The attributes by which a geom has its geometry whatever its class sets, and its parent's density."""
        found = dict(said)
        if "pos" in set_by_class:
            found.setdefault("pos", "0 0 0")
        if any(turn in set_by_class for turn in _TURNS):
            found.setdefault("quat", "1 0 0 0")
        for reference in ("mesh", "hfield"):
            if reference in set_by_class:
                found.setdefault(reference, "")
        if "size" in found:
            count = len(set_by_class.get("size", "").split())
            given = found["size"].split()
            found["size"] = " ".join(given + ["0"] * (count - len(given)))
        if "mass" in inherited and parent_volume > 0:
            found["mass"] = shown([float(inherited["mass"]) * geom.shape.volume / parent_volume])
        if said["type"] != "mesh" and "shellinertia" in inherited:
            found["shellinertia"] = inherited["shellinertia"]
        if said["type"] == "mesh" and set_by_class.get("shellinertia") == "true":  # the mesh says so
            found["shellinertia"] = "false"
        return found

    def _spell_out_class(self, geom: Geom, parent: Node, said: Mapping[str, str], parent_volume: float) -> Slot:
        """A hull's element that spells out what its parent has from its class."""
        main = self.context.defaults_of(MAIN)
        if "fromto" in main:
            raise _not_undone(geom, self.context, parent)
        inherited = {**self.context.defaults_of(self.context.class_of(parent)), **_own(parent)}
        settled = self._settle_attributes(geom, said, inherited, main, parent_volume)
        dropped = (*_GEOMETRY, "mass", "shellinertia")
        rest = {key: value for key, value in inherited.items() if key not in dropped and value != main.get(key)}
        return Slot(geom.body, (geom.name,), text=tag("geom", {"class": MAIN, **settled, **rest}))


def _own(node: Node) -> dict[str, str]:
    return {key: value for key, value in node.attributes.items() if key not in ("name", "class")}


def _far_centre(shape: Shape) -> Pose:
    """The frame in which a mesh is written: its body's, unless it lies many sizes away from it."""
    box = shape.aabb
    if np.abs(box.center).max() <= _FAR * float(box.size.min()):
        return Pose.identity()
    return Pose.of_translation(box.center)


def _not_undone(geom: Geom, context: Context, node: Node) -> AssetError:
    return AssetError(
        f"hull {geom.name!r} cannot be written: the default class of all geoms sets 'fromto', which nothing undoes",
        where=context.tree.where(node),
        remedy="Move 'fromto' from <default> to the geoms that use it.",
    )
