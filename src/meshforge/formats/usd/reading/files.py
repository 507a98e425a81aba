"""The files that a stage is made of: layers, packages, textures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from meshforge.files import is_file
from meshforge.formats.collision_meshes import digest_of
from meshforge.formats.usd.reading.stage import Scene


def files_of(path: Path) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The files beside the main one that are there, in order of mention, and the references that lead nowhere."""
    from pxr import UsdUtils

    layers, assets, unresolved = UsdUtils.ComputeAllDependencies(str(path))
    places = [*(layer.realPath for layer in layers), *assets]
    own = path.resolve()
    found = [file for file in map(_file, places) if file is not None and file.resolve() != own]
    return tuple(dict.fromkeys(found)), tuple(
        dict.fromkeys(text.removeprefix(f"{path.absolute().parent}/") for text in unresolved)
    )


def digests_of(scene: Scene) -> tuple[tuple[Path, str], ...]:
    """The digests of the layers that the stage uses besides its own file."""
    own = scene.path.resolve()
    layers = [_file(layer.realPath) for layer in scene.stage.GetUsedLayers()]
    others = dict.fromkeys(layer for layer in layers if layer is not None and layer.resolve() != own)
    return tuple((layer, digest_of(layer)) for layer in others)


def _file(place: Any) -> Path | None:
    """The file of a resolved place; of something within a package, the package."""
    text = str(place).split("[", 1)[0]
    path = Path(text)
    return path if text and is_file(path) else None
