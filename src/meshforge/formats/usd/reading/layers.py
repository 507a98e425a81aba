"""The layers that a file brings along, looked at one by one before a stage is made of them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from meshforge.errors import AssetError
from meshforge.formats.usd.reading.guard import REMEDY, TEXT, refuse_harmful

_MOST_PRIMS = 1_000_000
_MOST_LAYERS = 10_000


def refuse_harmful_layers(path: Path, data: bytes) -> None:
    """Raise AssetError where a file, or one that it refers to, would do harm, or make more prims than memory holds.

    To be used within `usd`.
    """
    layers: dict[str, Any] = {}
    waiting = [(path, data)]
    while waiting:
        file, content = waiting.pop()
        key = str(file.absolute())
        if key in layers:
            continue
        refuse_harmful(content, str(file))
        layers[key] = _opened(file)
        if not content.lstrip().startswith(TEXT):
            _refuse_broken(layers[key], str(file))
        if len(layers) > _MOST_LAYERS:
            raise AssetError(f"it refers to more than {_MOST_LAYERS:,} layers", where=str(path))
        waiting += _referred(layers[key], file)
    _Count(layers, str(path)).refuse_many(str(path.absolute()))


def _opened(file: Path) -> Any:
    from pxr import Sdf

    return Sdf.Layer.FindOrOpen(str(file))


def _refuse_broken(layer: Any, where: str) -> None:
    """Raise AssetError where a damaged binary layer lists things that it does not hold; asked for, they crash it."""
    broken: list[str] = []

    def look(path: Any) -> None:
        if not path.IsTargetPath() and not layer.GetObjectAtPath(path):
            broken.append(str(path))

    layer.Traverse("/", look)
    if broken:
        raise AssetError("it is damaged: it lists prims that it does not hold", where=where, remedy=REMEDY)


def _referred(layer: Any, file: Path) -> Iterator[tuple[Path, bytes]]:
    """The layers beside a file that it refers to and that are there."""
    for reference in sorted(filter(None, layer.GetCompositionAssetDependencies())):
        found = _place(file, reference)
        try:
            if found.exists() and not found.is_file():  # a pipe would be waited for, a device may never end
                raise AssetError(f"it refers to {reference}, which is a pipe, a folder or a device", where=str(file))
            if found.is_file():
                yield found, found.read_bytes()
        except (OSError, ValueError):
            continue


def _place(file: Path, reference: str) -> Path:
    return file.parent / reference.split(":SDF_FORMAT_ARGS:", 1)[0]


class _Count:
    """Counts the prims that a stage will have, from what refers to what, without making it."""

    def __init__(self, layers: dict[str, Any], where: str) -> None:
        self.layers, self.where = layers, where
        self.known: dict[tuple[str, str], int] = {}
        self.inside: set[tuple[str, str]] = set()

    def refuse_many(self, root: str) -> None:
        """Raise AssetError where there are more prims than are read."""
        count = self._count_prims(root, "/", 0)
        if count > _MOST_PRIMS:
            raise AssetError(
                f"it refers to itself or others so often that it has more than {_MOST_PRIMS:,} prims",
                where=self.where,
                remedy="Read a part of it.",
            )

    def _count_prims(self, layer: str, path: str, depth: int) -> int:
        """The prims at and below a place in a layer, arcs followed; what is in a circle counts once."""
        key = layer, path
        if key in self.known:
            return self.known[key]
        spec = self.layers[layer].GetPrimAtPath(path) if path != "/" else self.layers[layer].pseudoRoot
        if key in self.inside or spec is None or depth > 500:
            return 0
        self.inside.add(key)
        total = 1
        for target in self._composition_targets(layer, spec):
            total += self._count_prims(*target, depth + 1)
        for child in _children(spec):
            total += self._count_prims(layer, str(child.path), depth + 1)
        if path == "/":
            for sub in self.layers[layer].subLayerPaths:
                if other := self._key(layer, sub):
                    total += self._count_prims(other, "/", depth + 1)
        self.inside.discard(key)
        self.known[key] = min(total, _MOST_PRIMS + 1)
        return self.known[key]

    def _composition_targets(self, layer: str, spec: Any) -> Iterator[tuple[str, str]]:
        """What a prim is composed of besides its own opinions; instances are shared and count once."""
        if spec.path.IsAbsoluteRootPath():
            return
        for arcs in (spec.referenceList, spec.payloadList):
            for arc in arcs.GetAddedOrExplicitItems():
                other = self._key(layer, arc.assetPath) if arc.assetPath else layer
                if other:
                    yield other, str(arc.primPath) if arc.primPath else f"/{self.layers[other].defaultPrim}"
        for paths in (spec.inheritPathList, spec.specializesList):
            for path in paths.GetAddedOrExplicitItems():
                yield layer, str(path)

    def _key(self, layer: str, reference: str) -> str | None:
        found = str(_place(Path(layer), reference))
        return found if found in self.layers else None


def _children(spec: Any) -> Iterator[Any]:
    """The prims below one, those of all its variants too."""
    yield from spec.nameChildren
    if not spec.path.IsAbsoluteRootPath():
        for variants in spec.variantSets.values():
            for variant in variants.variants.values():
                yield from variant.primSpec.nameChildren
