"""The `<geom>` and `<mesh>` elements of new hulls, written so that default classes and frames around them change
nothing."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, relative_name
from meshforge.formats import mesh_output, xml
from meshforge.formats.mjcf import references
from meshforge.formats.mjcf.compiler import compile_model
from meshforge.formats.mjcf.document import MjcfNode, MjcfTree
from meshforge.formats.mjcf.elements import MjcfShape, geom_attributes, mesh_geom_attributes, tag
from meshforge.formats.slots import Slot
from meshforge.geometry import Pose, Shape, rotation_of_quaternion
from meshforge.symbolic import Asset, Geom

_TURNS = ("quat", "axisangle", "xyaxes", "zaxis", "euler")
_NOT_INHERITED = (
    *("type", "size", "pos", *_TURNS, "fromto", "mesh", "hfield", "fitscale"),
    *("mass", "shellinertia"),
)
"""The attributes that make up the geometry and the mass of a geom; all others are inherited."""
_FAR = 1000.0  # sizes away from the origin of its body, a mesh would lose digits in MuJoCo's single precision

_NEUTRAL = {"scale": "1 1 1", "maxhullvert": "-1", "inertia": "convex"}
"""What a default may set for all meshes, and what a made one says then."""
_LEAST_VOLUME = 1e-14  # [m^3] MuJoCo refuses the inertia of a solid below 1e-15, but takes that of a shell

MAIN_CLASS = "main"
"""The class of elements that are given none; all others inherit from it."""
_BODIES = ("body", "worldbody")


class HullGeomMaker:
    """Makes elements for one document."""

    def __init__(self, context: ElementContext, meshes: HullMeshes) -> None:
        self.context, self.meshes = context, meshes

    def make_beside(self, geom: Geom, root_t_body: Pose, parent: MjcfNode, parent_volume: float) -> Slot:
        """The element of a hull that stands right after that of its parent, in the same frame."""
        name = self.context.class_of(parent)
        set_by_class = self.context.defaults_of(name)
        attributes = self._geometry_attributes(geom, root_t_body, parent, self.context.body_t_frame(parent))
        if "fromto" in set_by_class:
            return self._spell_out_class(geom, parent, attributes, parent_volume)
        attributes = self._complete_attributes(
            geom, attributes, {**set_by_class, **_own_attributes(parent)}, set_by_class, parent_volume
        )
        data = self.context.tree.sources[parent.source].text.data
        changed = [key for key in _NOT_INHERITED if attributes.get(key) != parent.attributes.get(key)]
        edits = tuple(xml.set_attribute(data, parent.element, key, attributes.get(key), last=True) for key in changed)
        return Slot(geom.body, (geom.name,), None, parent.element, edits, copy=True)

    def make_apart(
        self, geom: Geom, root_t_body: Pose, body: MjcfNode, parent: MjcfNode | None, parent_volume: float
    ) -> Slot:
        """The element of a hull at the end of its body, with what it inherits from a parent that stands elsewhere."""
        attributes = self._geometry_attributes(geom, root_t_body, parent, Pose.identity())
        if parent is None:
            set_by_class = self.context.defaults_of(self.context.class_inside(body))
            if "fromto" in set_by_class:
                raise _fromto_error(geom, self.context, body)
            attributes = self._complete_attributes(geom, attributes, set_by_class, set_by_class, 0.0)
            if set_by_class.get("contype") == "0" == set_by_class.get("conaffinity"):  # a class of visual geoms
                attributes |= {"contype": "1", "conaffinity": "1"}
            return Slot(geom.body, (geom.name,), text=tag("geom", attributes))
        return self._spell_out_class(geom, parent, attributes, parent_volume)

    def _geometry_attributes(
        self, geom: Geom, root_t_body: Pose, parent: MjcfNode | None, body_t_frame: Pose
    ) -> dict[str, str]:
        frame_t_body, body_t_root = body_t_frame.inverse(), root_t_body.inverse()
        shape = geom.shape
        if isinstance(shape, MjcfShape):
            return geom_attributes(replace(shape, pose=frame_t_body @ body_t_root @ shape.pose))
        shape = shape.move(body_t_root)
        own = _own_attributes(parent) if parent else {}
        attributes = {**(self.context.defaults_of(self.context.class_of(parent)) if parent else {}), **own}
        centre = _far_centre(shape)
        shape = shape.move(centre.inverse())
        mesh = self.meshes.add(geom.name, shape, attributes.get("mesh"), attributes.get("shellinertia") == "true")
        return mesh_geom_attributes(mesh, frame_t_body @ centre)

    def _complete_attributes(
        self,
        geom: Geom,
        attributes: Mapping[str, str],
        inherited: Mapping[str, str],
        set_by_class: Mapping[str, str],
        parent_volume: float,
    ) -> dict[str, str]:
        """The attributes by which a geom has its geometry whatever its class sets, and its parent's density."""
        found = dict(attributes)
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
            found["mass"] = xml.format_numbers([float(inherited["mass"]) * geom.shape.volume / parent_volume])
        if attributes["type"] != "mesh" and "shellinertia" in inherited:
            found["shellinertia"] = inherited["shellinertia"]
        if attributes["type"] == "mesh" and set_by_class.get("shellinertia") == "true":  # the mesh says so
            found["shellinertia"] = "false"
        return found

    def _spell_out_class(
        self, geom: Geom, parent: MjcfNode, attributes: Mapping[str, str], parent_volume: float
    ) -> Slot:
        main = self.context.defaults_of(MAIN_CLASS)
        if "fromto" in main:
            raise _fromto_error(geom, self.context, parent)
        inherited = {**self.context.defaults_of(self.context.class_of(parent)), **_own_attributes(parent)}
        complete = self._complete_attributes(geom, attributes, inherited, main, parent_volume)
        rest = {key: value for key, value in inherited.items() if key not in _NOT_INHERITED and value != main.get(key)}
        return Slot(geom.body, (geom.name,), text=tag("geom", {"class": MAIN_CLASS, **complete, **rest}))


def _own_attributes(node: MjcfNode) -> dict[str, str]:
    return {key: value for key, value in node.attributes.items() if key not in ("name", "class")}


def _far_centre(shape: Shape) -> Pose:
    """The frame in which a mesh is written: its body's, unless it lies many sizes away from it."""
    box = shape.aabb
    if np.abs(box.center).max() <= _FAR * float(box.size.min()):
        return Pose.identity()
    return Pose.of_translation(box.center)


def _fromto_error(geom: Geom, context: ElementContext, node: MjcfNode) -> AssetError:
    return AssetError(
        f"hull {geom.name!r} cannot be written: the default class of all geoms sets 'fromto', which nothing undoes",
        where=context.tree.where(node),
        remedy="Move 'fromto' from <default> to the geoms that use it.",
    )


class HullMeshes:
    """Collects the meshes of one output. files.made: their files by place; elements: their text."""

    def __init__(self, asset: Asset, context: ElementContext, stem: str) -> None:
        self.context, self.tree = context, context.tree
        self.folders = references.AssetFolders.of(self.tree)
        self.files = mesh_output.HullFiles(stem)
        self.elements: list[bytes] = []
        self.main = self.tree.main.path.parent
        self._meshes = dict(_meshes_by_name(self.tree.root))
        self._usual = self._find_first_folder()
        self.files.taken |= {path.stem.lower() for path in (self.tree.main.path, *asset.files)}
        self.files.taken |= {name.lower() for name in self._meshes}

    def add(self, name: str, shape: Shape, parent_mesh: str | None, shell: bool) -> str:
        """Make the mesh of a hull, given in its body's frame; its name.

        parent_mesh: the mesh whose file it joins; shell: whether its mass is that of its surface.
        """
        inside = self._folder_inside(self._meshes[parent_mesh]) if parent_mesh in self._meshes else None
        folder = self._usual if inside is None else inside
        place = self._place_of(folder)
        beside = Path(os.path.normpath(self.main / place))
        self.files.taken |= {entry.stem.lower() for entry in beside.iterdir()} if beside.is_dir() else set()
        file = posixpath.basename(self.files.add(name, place, shape.vertices, shape.faces))
        attributes = {"name": posixpath.splitext(file)[0], "file": f"{folder}{file}"}
        if Path(self.folders.mesh).is_absolute():  # a file of the output has no name from there
            self.files.made.popitem()
            attributes = {"name": attributes["name"], "vertex": xml.format_numbers(shape.vertices.ravel())}
        set_by_default = self.context.defaults_of(MAIN_CLASS, "mesh")
        attributes |= {key: value for key, value in _NEUTRAL.items() if key in set_by_default}
        if shell or shape.volume < _LEAST_VOLUME:
            attributes["inertia"] = "shell"
        self.elements.append(tag("mesh", attributes))
        return attributes["name"]

    def _find_first_folder(self) -> str:
        """The folder, as references have it, of the first mesh that lies with the main file, else the main file's."""
        for node in self._meshes.values():
            inside = self._folder_inside(node)
            if inside is not None:
                return inside
        mesh = self.folders.mesh
        if not mesh or self.folders.strip or Path(mesh).is_absolute():
            return ""
        up = relative_name(self.main, Path(os.path.normpath(self.main / mesh)))
        return "" if up == "." else f"{up}/"

    def _folder_inside(self, node: MjcfNode) -> str | None:
        """The folder of a mesh file as its reference has it, None where it lies outside of the main file's folder."""
        reference = node.attributes.get("file", "").replace("\\", "/")
        if not reference or Path(reference).is_absolute() or self.folders.path_beside_include(self.tree, node, "file"):
            return None
        if not self.folders.find(self.tree, node).is_relative_to(self.main):
            return None
        return "" if self.folders.strip else reference[: reference.rfind("/") + 1]

    def _place_of(self, folder: str) -> str:
        place = posixpath.normpath(posixpath.join(self.folders.mesh.replace("\\", "/"), folder))
        return "" if place == "." else f"{place}/"


def _meshes_by_name(root: MjcfNode) -> Iterator[tuple[str, MjcfNode]]:
    """The `<mesh>` assets by name; one without a name is called like its file."""
    for assets in root.each("asset"):
        for node in assets.each("mesh"):
            file = node.attributes.get("file", "").replace("\\", "/")
            yield node.attributes.get("name") or posixpath.splitext(posixpath.basename(file))[0], node


class ElementContext:
    """The surroundings of all elements of a tree."""

    def __init__(self, tree: MjcfTree) -> None:
        self.tree = tree
        self._parents = {id(child): node for node in tree.root.walk() for child in node.children}
        self._set: dict[tuple[str, str], dict[str, str]] = {}
        self._classes: dict[str, tuple[MjcfNode, ...]] = {MAIN_CLASS: ()}
        for top in tree.root.children:
            if top.tag == "default":
                self._classes[MAIN_CLASS] += (top,)
        for top in self._classes[MAIN_CLASS]:
            self._add_classes(top)

    def ancestors_of(self, node: MjcfNode) -> Iterator[MjcfNode]:
        """The elements around an element, the nearest first."""
        while id(node) in self._parents:
            node = self._parents[id(node)]
            yield node

    def class_of(self, node: MjcfNode) -> str:
        """The default class of a geom: its own, or that of the children of what is around it."""
        outer = next(self.ancestors_of(node), None)
        return node.attributes.get("class") or (self.class_inside(outer) if outer else MAIN_CLASS)

    def class_inside(self, node: MjcfNode) -> str:
        """The default class of what stands in an element without a class of its own."""
        classes = (n.attributes.get("childclass") for n in (node, *self.ancestors_of(node)))
        return next((name for name in classes if name), MAIN_CLASS)

    def defaults_of(self, name: str, kind: str = "geom") -> dict[str, str]:
        """The attributes that a default class sets for a kind of element, those it inherits included."""
        found: dict[str, str] = {}
        for default in (*self._classes[MAIN_CLASS], *(self._classes.get(name, ()) if name != MAIN_CLASS else ())):
            for element in default.children:
                if element.tag == kind:
                    found |= element.attributes
        return found

    def body_t_frame(self, node: MjcfNode) -> Pose:
        """The pose of the frames around a geom, one in another, in their body."""
        frames = []
        for outer in self.ancestors_of(node):
            if outer.tag in _BODIES:
                break
            frames.append(outer)
        return self._compile_frames([f for f in reversed(frames) if f.tag == "frame"])

    def _compile_frames(self, frames: list[MjcfNode]) -> Pose:
        """MuJoCo's own answer for frames in one another, from a model of nothing else."""
        attributes = [{k: v for k, v in f.attributes.items() if k not in ("name", "childclass")} for f in frames]
        if not any(attributes):
            return Pose.identity()
        units: dict[str, str] = {}
        for node in self.tree.root.children:
            if node.tag == "compiler":
                units |= {k: v for k, v in node.attributes.items() if k in ("angle", "eulerseq")}
        opened = b"".join(tag("frame", one, closed=False) for one in attributes)
        inside = tag("compiler", units), opened, b"</frame>" * len(attributes)
        main = Path("frames.xml")
        text = b"<mujoco>%s<worldbody>%s<geom size='1'/>%s</worldbody></mujoco>" % inside
        model = compile_model(main, {main: text})
        return Pose(rotation_of_quaternion(model.geom_quat[0]), model.geom_pos[0])

    def _add_classes(self, default: MjcfNode, chain: tuple[MjcfNode, ...] = ()) -> None:
        for child in default.children:
            if child.tag == "default":
                own = (*chain, child)
                self._classes.setdefault(child.attributes.get("class", ""), own)
                self._add_classes(child, own)
