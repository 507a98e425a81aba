"""The mesh assets of an edit's hulls: an OBJ file each, beside the mesh it replaces, and its `<mesh>` element."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Iterator
from pathlib import Path

from meshforge.asset import Asset
from meshforge.files import relative_name
from meshforge.formats.hull_files import HullFiles
from meshforge.formats.mjcf.elements import tag
from meshforge.formats.mjcf.files.assets import Folders
from meshforge.formats.mjcf.files.sources import Node
from meshforge.formats.mjcf.writing.context import MAIN, Context
from meshforge.formats.xml import shown
from meshforge.geometry import Shape

_NEUTRAL = {"scale": "1 1 1", "maxhullvert": "-1", "inertia": "convex"}
"""What a default may set for all meshes, and what a made one says then."""
_LEAST_VOLUME = 1e-14  # [m^3] MuJoCo refuses the inertia of a solid below 1e-15, but takes that of a shell


class HullMeshes:
    """Collects the meshes of one output. files.made: their files by place; elements: their text."""

    def __init__(self, asset: Asset, context: Context, stem: str) -> None:
        self.context, self.tree = context, context.tree
        self.folders = Folders.of(self.tree)
        self.files = HullFiles(stem)
        self.elements: list[bytes] = []
        self.main = self.tree.main.path.parent
        self._meshes = dict(_named_meshes(self.tree.root))
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
        self.files.taken |= self._stems_in(place)
        file = posixpath.basename(self.files.add(name, place, shape.vertices, shape.faces))
        said = {"name": posixpath.splitext(file)[0], "file": f"{folder}{file}"}
        if Path(self.folders.mesh).is_absolute():  # a file of the output has no name from there
            self.files.made.popitem()
            said = {"name": said["name"], "vertex": shown(shape.vertices.ravel())}
        set_by_default = self.context.defaults_of(MAIN, "mesh")
        said |= {key: value for key, value in _NEUTRAL.items() if key in set_by_default}
        if shell or shape.volume < _LEAST_VOLUME:
            said["inertia"] = "shell"
        self.elements.append(tag("mesh", said))
        return said["name"]

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

    def _folder_inside(self, node: Node) -> str | None:
        """The folder of a mesh file as its reference has it, None where it lies outside of the main file's folder."""
        reference = node.attributes.get("file", "").replace("\\", "/")
        if not reference or Path(reference).is_absolute() or self.folders.path_beside_include(self.tree, node, "file"):
            return None
        if not self.folders.find(self.tree, node).is_relative_to(self.main):
            return None
        return "" if self.folders.strip else reference[: reference.rfind("/") + 1]

    def _place_of(self, folder: str) -> str:
        """Where a folder of references is, seen from the main file, with a final slash."""
        place = posixpath.normpath(posixpath.join(self.folders.mesh.replace("\\", "/"), folder))
        return "" if place == "." else f"{place}/"

    def _stems_in(self, place: str) -> set[str]:
        folder = Path(os.path.normpath(self.main / place))
        return {entry.stem.lower() for entry in folder.iterdir()} if folder.is_dir() else set()


def _named_meshes(root: Node) -> Iterator[tuple[str, Node]]:
    """The `<mesh>` assets by name; one without a name is called like its file."""
    for assets in root.each("asset"):
        for node in assets.each("mesh"):
            file = node.attributes.get("file", "").replace("\\", "/")
            yield node.attributes.get("name") or posixpath.splitext(posixpath.basename(file))[0], node
