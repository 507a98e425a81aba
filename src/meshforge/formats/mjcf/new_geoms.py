"""The `<geom>` and `<mesh>` elements of new hulls, written so that default classes around them change nothing."""

import os
import posixpath
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, relative_name
from meshforge.formats import element_edits, mesh_output, xml
from meshforge.formats.mjcf import references
from meshforge.formats.mjcf.document import MjcfNode, MjcfTree
from meshforge.formats.mjcf.elements import MjcfShape, geom_attributes, mesh_geom_attributes
from meshforge.geometry import Pose, Shape
from meshforge.symbolic import Asset, Geom

_TURNS = ("quat", "axisangle", "xyaxes", "zaxis", "euler")
_NOT_INHERITED = (*("type", "size", "pos", *_TURNS, "fromto", "mesh", "hfield", "fitscale", "mass", "shellinertia"),)
"""The attributes that make up the geometry and the mass of a geom; all others are inherited."""
_LASTING = ("pos", *_TURNS, "fromto", "mesh", "hfield", "fitscale")
"""Those that a default class sets for good: a geom that has others is of another class."""
_FAR = 1000.0  # sizes away from the origin of its body, a mesh would lose digits in MuJoCo's single precision

_NEUTRAL = {"scale": "1 1 1", "maxhullvert": "-1", "inertia": "convex"}
"""What a default may set for all meshes, and what a made one says then."""
_LEAST_VOLUME = 1e-14  # [m^3] MuJoCo refuses the inertia of a solid below 1e-15, but takes that of a shell

_MAIN_CLASS = "main"  # of elements that are given none; all others inherit from it


class NewGeoms:
    """Makes the elements of new hulls for one document, and collects their meshes: `files.made`, and `elements`."""

    def __init__(self, asset: Asset, tree: MjcfTree, stem: str) -> None:
        self.tree, self.context = tree, ElementContext(tree)
        self.folders = references.AssetFolders(tree)
        self.files = mesh_output.HullFiles(stem)
        self.elements: list[bytes] = []
        self._main = tree.main.path.parent
        self._meshes = dict(_meshes_by_name(tree.root))
        self._usual_folder = self._find_usual_folder()
        self.files.taken |= {path.stem.lower() for path in (tree.main.path, *asset.files)}
        self.files.taken |= {name.lower() for name in self._meshes}

    def make_geom(
        self, geom: Geom, root_t_body: Pose, body: MjcfNode, parent: MjcfNode | None, volume: float, is_adjacent: bool
    ) -> element_edits.OutputElement:
        """Return the element of a hull, which inherits all but geometry, at the density of its parent.

        volume: what has the mass of the parent [m^3]; is_adjacent: whether it is to stand right after its parent, else
        at the end of its body. Raises AssetError where a default class of all geoms cannot be undone.
        """
        own = {k: v for k, v in parent.attributes.items() if k not in ("name", "class")} if parent else {}
        class_ = self.context.class_of(parent) if parent else self.context.class_inside(body)
        by_class = self.context.defaults_of(class_)
        inherited = {**by_class, **own}
        attributes = self._place_shape(geom, root_t_body, inherited if parent else {})
        is_lasting = any(key in by_class for key in _LASTING)
        if parent and is_adjacent and not is_lasting:
            attributes = _complete(geom, attributes, inherited, by_class, volume)
            data = self.tree.sources[parent.source].text.data
            changed = [key for key in _NOT_INHERITED if attributes.get(key) != parent.attributes.get(key)]
            edits = (xml.set_attribute(data, parent.element, key, attributes.get(key), last=True) for key in changed)
            return element_edits.OutputElement(geom.body, (geom.name,), None, parent.element, tuple(edits), copy=True)
        is_spelled_out = parent is not None or is_lasting
        set_by_class = self.context.defaults_of(_MAIN_CLASS) if is_spelled_out else by_class
        if lasting := next((key for key in _LASTING if key in set_by_class), None):
            why = f"the default class of all geoms sets {lasting!r}, which nothing undoes"
            problem = f"hull {geom.name!r} cannot be written: {why}"
            remedy = f"Move {lasting!r} from <default> to the geoms that use it."
            raise AssetError(problem, where=self.tree.where(parent or body), remedy=remedy)
        attributes = _complete(geom, attributes, inherited, set_by_class, volume)
        if is_spelled_out:
            rest = {k: v for k, v in inherited.items() if k not in _NOT_INHERITED and v != set_by_class.get(k)}
            attributes = {"class": _MAIN_CLASS, **attributes, **rest}
        if not parent and by_class.get("contype") == "0" == by_class.get("conaffinity"):  # a class of visual geoms
            attributes |= {"contype": "1", "conaffinity": "1"}
        return element_edits.OutputElement(geom.body, (geom.name,), text=xml.tag("geom", attributes))

    def _place_shape(self, geom: Geom, root_t_body: Pose, inherited: Mapping[str, str]) -> dict[str, str]:
        """Type, size and pose in a body; a mesh is written in the frame of its body, unless it lies far off."""
        if isinstance(geom.shape, MjcfShape):
            return geom_attributes(replace(geom.shape, pose=root_t_body.inverse() @ geom.shape.pose))
        shape = geom.shape.move(root_t_body.inverse())
        box = shape.aabb
        is_near = np.abs(box.center).max() <= _FAR * float(box.size.min())
        centre = Pose.identity() if is_near else Pose.of_translation(box.center)
        is_shell = inherited.get("shellinertia") == "true"
        mesh = self._add_mesh(geom.name, shape.move(centre.inverse()), inherited.get("mesh"), is_shell)
        return mesh_geom_attributes(mesh, centre)

    def _add_mesh(self, name: str, shape: Shape, parent_mesh: str | None, shell: bool) -> str:
        """Make the mesh of a hull beside the file of its parent's mesh; its name."""
        inside = self._folder_inside(self._meshes[parent_mesh]) if parent_mesh in self._meshes else None
        folder = self._usual_folder if inside is None else inside
        place = posixpath.normpath(posixpath.join(self.folders.mesh.replace("\\", "/"), folder))
        place = "" if place == "." else f"{place}/"
        beside = Path(os.path.normpath(self._main / place))
        self.files.taken |= {entry.stem.lower() for entry in beside.iterdir()} if beside.is_dir() else set()
        file = posixpath.basename(self.files.add(name, place, shape.vertices, shape.faces))
        attributes = {"name": posixpath.splitext(file)[0], "file": f"{folder}{file}"}
        if Path(self.folders.mesh).is_absolute():  # a file of the output has no name from there
            self.files.made.popitem()
            attributes = {"name": attributes["name"], "vertex": xml.format_numbers(shape.vertices.ravel())}
        by_default = self.context.defaults_of(_MAIN_CLASS, "mesh")
        attributes |= {key: value for key, value in _NEUTRAL.items() if key in by_default}
        if shell or shape.volume < _LEAST_VOLUME:
            attributes["inertia"] = "shell"
        self.elements.append(xml.tag("mesh", attributes))
        return attributes["name"]

    def _find_usual_folder(self) -> str:
        """The folder, as references have it, of the first mesh that lies with the main file, else the main file's."""
        inside = (self._folder_inside(node) for node in self._meshes.values())
        if (found := next((folder for folder in inside if folder is not None), None)) is not None:
            return found
        mesh = self.folders.mesh
        if not mesh or self.folders.strip or Path(mesh).is_absolute():
            return ""
        up = relative_name(self._main, Path(os.path.normpath(self._main / mesh)))
        return "" if up == "." else f"{up}/"

    def _folder_inside(self, node: MjcfNode) -> str | None:
        """The folder of a mesh file as its reference has it, None where it lies outside of the main file's folder."""
        reference = node.attributes.get("file", "").replace("\\", "/")
        if not reference or Path(reference).is_absolute() or self.folders.path_beside_include(node):
            return None
        if not self.folders.find(node).is_relative_to(self._main):
            return None
        return "" if self.folders.strip else reference[: reference.rfind("/") + 1]


def _complete(
    geom: Geom,
    attributes: Mapping[str, str],
    inherited: Mapping[str, str],
    set_by_class: Mapping[str, str],
    parent_volume: float,
) -> dict[str, str]:
    """The attributes by which a geom has its geometry whatever its class sets, and its parent's density."""
    found = dict(attributes)
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


def _meshes_by_name(root: MjcfNode) -> Iterator[tuple[str, MjcfNode]]:
    """The `<mesh>` assets by name; one without a name is called like its file."""
    for assets in root.each("asset"):
        for node in assets.each("mesh"):
            file = node.attributes.get("file", "").replace("\\", "/")
            yield node.attributes.get("name") or posixpath.splitext(posixpath.basename(file))[0], node


class ElementContext:
    """The default classes around the elements of a tree."""

    def __init__(self, tree: MjcfTree) -> None:
        self.tree = tree
        self._parents = {id(child): node for node in tree.root.walk() for child in node.children}
        self._classes = {_MAIN_CLASS: tuple(tree.root.each("default"))}
        for top in self._classes[_MAIN_CLASS]:
            self._add_classes(top, ())

    def _add_classes(self, default: MjcfNode, chain: tuple[MjcfNode, ...]) -> None:
        for child in default.each("default"):
            own = (*chain, child)
            self._classes.setdefault(child.attributes.get("class", ""), own)
            self._add_classes(child, own)

    def ancestors_of(self, node: MjcfNode) -> Iterator[MjcfNode]:
        """Yield the elements around an element, the nearest first."""
        while id(node) in self._parents:
            node = self._parents[id(node)]
            yield node

    def class_of(self, geom: MjcfNode) -> str:
        """Return the default class of a geom: its own, or that of the children of what is around it."""
        return geom.attributes.get("class") or self.class_inside(self._parents[id(geom)])

    def class_inside(self, node: MjcfNode) -> str:
        """Return the default class of what stands in an element without a class of its own."""
        classes = (n.attributes.get("childclass") for n in (node, *self.ancestors_of(node)))
        return next((name for name in classes if name), _MAIN_CLASS)

    def defaults_of(self, name: str, kind: str = "geom") -> dict[str, str]:
        """Return the attributes that a default class sets for a kind of element, those it inherits included."""
        found: dict[str, str] = {}
        for default in (*self._classes[_MAIN_CLASS], *(self._classes.get(name, ()) if name != _MAIN_CLASS else ())):
            for element in default.each(kind):
                found |= element.attributes
        return found
