"""Which assets a folder holds: descriptions where there are any, else scenes, mesh files, or one asset of pieces."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from meshforge.errors import MeshForgeError
from meshforge.files import is_circle
from meshforge.formats import DESCRIPTION_SUFFIXES, MESH_SUFFIXES, is_asset, read

STATE = ".meshforge"
"""The folder in an output of `apply` or in a project that holds what MeshForge needs to know about it."""
SETTINGS = "meshforge.toml"
"""The file that makes a folder a project."""
OWN_FOLDERS = ("templates", "labels", "demonstrations", "corrections", "prepared", "edited")
"""The folders of a project that hold no assets of the user."""


def assets_in(folder: Path) -> list[Path]:
    """The assets in a folder, at any depth, sorted.

    A tree with descriptions (URDF, MJCF, SDF) has these as its assets, its mesh files being their parts.
    Otherwise every file is an asset, except that a folder of several mesh files of one hull each is one asset of
    pieces. Folders that MeshForge wrote are passed over.
    """
    files = sorted(_files(folder, folder))
    described = [path for path in files if path.suffix.lower() in DESCRIPTION_SUFFIXES]
    if described:
        return described
    scenes = [path for path in files if path.suffix.lower() not in MESH_SUFFIXES]
    by_folder: dict[Path, list[Path]] = {}
    for path in files:
        if path.suffix.lower() in MESH_SUFFIXES:
            by_folder.setdefault(path.parent, []).append(path)
    meshes = [asset for parent, own in by_folder.items() for asset in ([parent] if _are_pieces(own) else own)]
    return sorted([*scenes, *meshes])


def is_own(path: Path, root: Path) -> bool:
    """Whether MeshForge wrote it: below `root`, it lies in an output of `apply` or in a folder that a project keeps."""
    inside = path.relative_to(root).parts if path.is_relative_to(root) else ()
    above = [root.joinpath(*inside[:depth]) for depth in range(len(inside) + 1)]
    kept = (step in OWN_FOLDERS and (folder / SETTINGS).is_file() for folder, step in zip(above, inside, strict=False))
    return any(kept) or any(_is_written(folder, root) for folder in above)


def _files(folder: Path, root: Path) -> Iterator[Path]:
    for entry in folder.iterdir():
        if entry.name.startswith("."):
            continue
        if is_circle(entry):
            continue
        if entry.is_dir():
            own = (folder / SETTINGS).is_file() and entry.name in OWN_FOLDERS
            if not own and not _is_written(entry, root):
                yield from _files(entry, root)
        elif is_asset(entry):
            yield entry


def _is_written(folder: Path, root: Path) -> bool:
    """Whether a folder is an output or a project of its own; one that was named outright is neither."""
    return folder != root and ((folder / STATE).is_dir() or (folder / SETTINGS).is_file())


def _are_pieces(members: list[Path]) -> bool:
    """Whether mesh files of one folder are pieces of one asset: several, each a single hull; stops at the first not."""
    return len(members) > 1 and all(map(_is_one_hull, members))


def _is_one_hull(path: Path) -> bool:
    try:
        asset = read(path)
    except MeshForgeError:
        return False
    return len(asset.geoms) == 1 and not asset.opaque
