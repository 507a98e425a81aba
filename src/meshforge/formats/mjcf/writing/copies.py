"""The input files that a written MJCF refers to, by where they go so that MuJoCo finds them from there."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Iterator
from pathlib import Path

from meshforge.asset import Asset
from meshforge.errors import AssetError, MeshForgeError
from meshforge.files import relative_name
from meshforge.formats.companions import companions
from meshforge.formats.mjcf.document import MjcfDocument
from meshforge.formats.mjcf.files.assets import Folders, referring
from meshforge.formats.mjcf.files.sources import Tree, gather


def places(tree: Tree) -> list[str | None]:
    """Where each of the authored files goes, relative to the main one's folder; None for one at an absolute path.

    As the `<include>` says, not as the disk is: `../kettle/body.xml` stays so, whatever the main file's folder is
    called.
    """
    found: list[str | None] = [tree.main.path.name]
    main = tree.main.path.parent
    for source in tree.sources[1:]:
        said = posixpath.normpath(source.reference.replace("\\", "/"))
        from_main = Path(os.path.normpath(main / said)) == source.path
        found.append(None if source.place is None else said if from_main else source.place)
    return found


def copied(asset: Asset, tree: Tree) -> tuple[dict[str, Path], list[str]]:
    """The files besides the authored ones; and notes on those that stay where they are.

    Raises AssetError where two of them would become one.
    """
    found: dict[str, Path] = {}
    far: dict[Path, str] = {}
    for place, path, reference in _references(tree):
        if place is None:
            far[path] = reference
            far |= dict.fromkeys(companions(path).values(), "")
        elif found.setdefault(place, path) != path:
            raise AssetError(
                f"{found[place]} and {path} would both become {place!r}", where=str(path), remedy="Rename one of them."
            )
        else:
            for key, companion in companions(path).items():
                found.setdefault(posixpath.normpath(posixpath.join(posixpath.dirname(place), key)), companion)
    known = {*found.values(), *far, *(source.path for source in tree.sources)}
    for path in asset.files:  # those of sub-models and plugins
        if path not in known:
            found.setdefault(relative_name(path, tree.main.path.parent), path)
    absolute = dict.fromkeys(said for said in far.values() if said)
    return found, [f"{said!r} is an absolute reference: the file is used where it is, not copied" for said in absolute]


def top(document: MjcfDocument) -> Path:
    """The highest folder that references pass through, from the main file's folder."""
    tree = document.tree
    meshes = posixpath.normpath(posixpath.join(Folders.of(tree).mesh.replace("\\", "/"), "hull.obj"))
    named = [meshes, *places(tree), *(place for place, _, _ in _references(tree))]
    ups = max(_climb(place) for place in named if place)
    return [tree.main.path.parent, *tree.main.path.parent.parents][ups]


def _climb(place: str) -> int:
    """How many folders a place is above."""
    parts = place.split("/")
    return next((k for k, part in enumerate(parts) if part != ".."), len(parts))


def _references(tree: Tree) -> Iterator[tuple[str | None, Path, str]]:
    """Where each referenced file goes, None for one at an absolute path; where it is; how it is referred to."""
    folders = Folders.of(tree)
    for node, attribute in referring(tree):
        path = folders.find(tree, node, attribute)
        if tree.has(path):
            yield folders.place(tree, node, attribute), path, node.attributes[attribute]
            if node.tag == "model":
                yield from _far_in_model(path)


def _far_in_model(path: Path) -> Iterator[tuple[str | None, Path, str]]:
    """The absolute references in a sub-model."""
    try:
        yield from (said for said in _references(gather(path)) if said[0] is None)
    except MeshForgeError:  # of another format than MJCF
        return
