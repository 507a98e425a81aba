"""Every file that an MJCF refers to: those that are there, and the references that lead nowhere."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from meshforge.errors import MeshForgeError
from meshforge.files import is_file
from meshforge.formats.companions import companions
from meshforge.formats.mjcf.files.assets import Folders, referring
from meshforge.formats.mjcf.files.sources import Tree, gather


def referenced(tree: Tree) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The files but for the main one, with their companions, in order of mention; and references without a file."""
    files: dict[Path, None] = {}
    missing: dict[str, None] = {}
    _add(tree, files, missing)
    files.pop(tree.main.path, None)
    return tuple(files), tuple(missing)


def _add(tree: Tree, files: dict[Path, None], missing: dict[str, None]) -> None:
    folders = Folders.of(tree)
    files |= dict.fromkeys(source.path for source in tree.sources)
    for node, attribute in referring(tree):
        path = folders.find(tree, node, attribute)
        if not tree.has(path):
            missing[node.attributes[attribute]] = None
        elif node.tag == "model":
            if path not in files:
                _add_model(path, files, missing)
        else:
            files |= dict.fromkeys([path, *companions(path).values()])
    files |= dict.fromkeys(_settings(tree))


def _add_model(path: Path, files: dict[Path, None], missing: dict[str, None]) -> None:
    """A sub-model and what it refers to."""
    files[path] = None
    try:
        _add(gather(path), files, missing)
    except MeshForgeError:  # of another format than MJCF
        return


def _settings(tree: Tree) -> Iterator[Path]:
    """Files that settings of plugins name, beside the main file."""
    for node in tree.root.walk():
        value = node.attributes.get("value", "") if node.tag == "config" else ""
        if value and "\0" not in value:
            path = Path(os.path.normpath(tree.main.path.parent / value))
            if is_file(path):
                yield path
