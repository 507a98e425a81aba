"""The files that elements of an MJCF refer to, found where MuJoCo looks for them."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from meshforge.files import relative_name
from meshforge.formats.mjcf.files.sources import Node, Tree

_OF_TEXTURE = tuple(f"file{side}" for side in ("", "right", "left", "up", "down", "front", "back"))
_REFERRING = {"mesh": "mesh", "hfield": "mesh", "skin": "mesh", "flexcomp": "mesh", "model": "", "texture": "texture"}
"""The elements with a `file`, and the folder in which it is looked for."""


@dataclass(frozen=True, slots=True)
class Folders:
    """What the `<compiler>` says about where files are; of several, each counts in its turn."""

    main: Path
    mesh: str
    texture: str
    strip: bool

    @staticmethod
    def of(tree: Tree) -> Folders:
        mesh = texture = strip = ""
        for compiler in tree.root.each("compiler"):
            said = compiler.attributes
            mesh, texture = said.get("assetdir", mesh), said.get("assetdir", texture)
            mesh, texture = said.get("meshdir", mesh), said.get("texturedir", texture)
            strip = said.get("strippath", strip)
        return Folders(tree.main.path.parent, mesh, texture, strip == "true")

    def find(self, tree: Tree, node: Node, attribute: str = "file") -> Path:
        """Where the file of an attribute is, or would be."""
        beside = self.path_beside_include(tree, node, attribute)
        reference = str(beside or node.attributes[attribute].replace("\\", "/"))
        if self.strip:
            reference = Path(reference).name
        return self._join(self._folder(node), reference)

    def place(self, tree: Tree, node: Node, attribute: str = "file") -> str | None:
        """Where the file of an attribute goes beside a main file in another folder, None for an absolute place.

        As references say, not as the disk is: `../cup/a.stl` stays so, whatever the main file's folder is called.
        """
        if beside := self.path_beside_include(tree, node, attribute):
            return relative_name(beside, self.main)
        folder, reference = (text.replace("\\", "/") for text in (self._folder(node), node.attributes[attribute]))
        if Path(folder).is_absolute() or (Path(reference).is_absolute() and not self.strip):
            return None
        return posixpath.normpath(posixpath.join(folder, posixpath.basename(reference) if self.strip else reference))

    def path_beside_include(self, tree: Tree, node: Node, attribute: str) -> Path | None:
        """The path of a file beside the included file that refers to it, None where the usual place counts."""
        reference = node.attributes[attribute].replace("\\", "/")
        if not node.source or Path(reference).is_absolute() or tree.has(self._join(self._folder(node), reference)):
            return None
        return Path(os.path.normpath(tree.sources[node.source].path.parent / reference))

    def _folder(self, node: Node) -> str:
        return {"mesh": self.mesh, "texture": self.texture, "": ""}[_REFERRING.get(node.tag, "")]

    def _join(self, folder: str, reference: str) -> Path:
        return Path(os.path.normpath(self.main / folder / reference))


def referring(tree: Tree) -> Iterator[tuple[Node, str]]:
    """The elements that refer to a file, and by which attribute, in document order."""
    for node in tree.root.walk():
        if node.tag in _REFERRING:
            for attribute in _OF_TEXTURE if node.tag == "texture" else ("file",):
                if node.attributes.get(attribute):
                    yield node, attribute
