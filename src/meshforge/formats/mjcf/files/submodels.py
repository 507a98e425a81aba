"""Models that an MJCF attaches parts of, each a file of its own that MuJoCo reads by itself."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from meshforge.errors import MeshForgeError
from meshforge.files import is_file
from meshforge.formats.mjcf.files.assets import Folders
from meshforge.formats.mjcf.files.sources import Tree, gather


def submodels(tree: Tree, lines: int) -> dict[Path, bytes]:
    """The texts of all sub-models, moved down below line `lines`, so that no line is one of the model's own text."""
    found: dict[Path, bytes] = {}
    waiting = [tree]
    while waiting:
        for path in attached(waiting.pop()):
            if path in found:
                continue
            try:
                inner = gather(path)
            except MeshForgeError:  # MuJoCo says what is wrong with it, or reads it in another way
                continue
            found[path] = b"\n" * lines + inner.main.text.data
            waiting.append(inner)
    return found


def attached(tree: Tree) -> Iterator[Path]:
    """The files of the `<model>` assets of a tree that are there."""
    folders = Folders.of(tree)
    for node in tree.root.walk():
        if node.tag == "model" and node.attributes.get("file"):
            path = folders.find(tree, node)
            if is_file(path):
                yield path
