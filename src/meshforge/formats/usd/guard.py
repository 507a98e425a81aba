"""What is looked at before the library opens a file: layers that would crash it, or cost more than they are worth."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from meshforge.common import AssetError, is_beyond_reach
from meshforge.formats.libraries import pxr
from meshforge.formats.usd.crate import CRATE_MARK, refuse_harmful_crate
from meshforge.formats.usd.crate_values import DEEPEST, NEEDLESS, REMEDY, bracket_depth

_MOST_PRIMS = 1_000_000
_MOST_LAYERS = 10_000

PACKAGE_MARK = b"PK\x03\x04"
TEXT_MARK = b"#usda"
_QUIET = re.compile(rb'"""(?:[^\\]|\\.)*?"""|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)*\'|@[^@\n]*@|#[^\n]*', re.S)
_PATH = re.compile(rb"<[^<>\n]*>")


def refuse_harmful(data: bytes, where: str) -> None:
    """Raise AssetError where the bytes of a layer or package plainly are damaged, or made to do harm."""
    if data.startswith(PACKAGE_MARK):
        for layer in read_package_layers(data, where):
            if layer.startswith(PACKAGE_MARK):
                raise AssetError("a package in a package is not read", where=where, remedy="Unpack it first.")
            refuse_harmful(layer, where)
    elif data.startswith(CRATE_MARK):
        refuse_harmful_crate(data, where)
    elif data.lstrip().startswith(TEXT_MARK):
        refuse_deep_text(data, where)
    else:
        raise AssetError("this is no USD file, neither text nor crate nor package", where=where, remedy=REMEDY)


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
        layers[key] = pxr.Sdf.Layer.FindOrOpen(str(file))
        if not content.lstrip().startswith(TEXT_MARK):
            _refuse_broken(layers[key], str(file))
        if len(layers) > _MOST_LAYERS:
            raise AssetError(f"it refers to more than {_MOST_LAYERS:,} layers", where=str(path))
        waiting += _read_references(layers[key], file)
    _PrimCounter(layers, str(path)).refuse_many(str(path.absolute()))


def _refuse_broken(layer: Any, where: str) -> None:
    """Raise AssetError where a damaged binary layer lists things that it does not hold; asked for, they crash it."""
    broken: list[str] = []

    def look(path: Any) -> None:
        if not path.IsTargetPath() and not layer.GetObjectAtPath(path):
            broken.append(str(path))

    layer.Traverse("/", look)
    if broken:
        raise AssetError("it is damaged: it lists prims that it does not hold", where=where, remedy=REMEDY)


def _read_references(layer: Any, file: Path) -> Iterator[tuple[Path, bytes]]:
    """The layers beside a file that it refers to and that are there."""
    for reference in sorted(filter(None, layer.GetCompositionAssetDependencies())):
        found = _resolve_reference(file, reference)
        if is_beyond_reach(found):
            raise AssetError(f"it refers to {reference}, which is not beside it", where=str(file))
        try:
            if found.exists() and not found.is_file():  # a pipe would be waited for, a device may never end
                raise AssetError(f"it refers to {reference}, which is a pipe, a folder or a device", where=str(file))
            if found.is_file():
                yield found, found.read_bytes()
        except (OSError, ValueError):
            continue


def _resolve_reference(file: Path, reference: str) -> Path:
    return file.parent / reference.split(":SDF_FORMAT_ARGS:", 1)[0]


class _PrimCounter:
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
        for child in _children_of(spec):
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
        found = str(_resolve_reference(Path(layer), reference))
        return found if found in self.layers else None


def _children_of(spec: Any) -> Iterator[Any]:
    """The prims below one, those of all its variants too."""
    yield from spec.nameChildren
    if not spec.path.IsAbsoluteRootPath():
        for variants in spec.variantSets.values():
            for variant in variants.variants.values():
                yield from variant.primSpec.nameChildren


def read_package_layers(data: bytes, where: str) -> list[bytes]:
    """The first file of a package and all its other layers.

    Raises AssetError where it is no archive, is compressed, or has places outside of itself.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            entries = archive.infolist()
            if not entries or sum(entry.file_size for entry in entries) > len(data):
                raise AssetError("its files do not fit into it", where=where, remedy=REMEDY)
            for entry in entries:
                if entry.compress_type != zipfile.ZIP_STORED or entry.flag_bits & 1:
                    problem = f"{entry.filename} in it is compressed or encrypted, which USDZ does not allow"
                    raise AssetError(problem, where=where, remedy="Pack it with usdzip.")
                parts = Path(entry.filename.replace("\\", "/")).parts
                if ".." in parts or entry.filename.startswith(("/", "\\")) or ":" in parts[:1]:
                    raise AssetError(f"{entry.filename} in it leads out of the package", where=where, remedy=REMEDY)
            others = (entry for entry in entries[1:] if entry.filename.lower().endswith((".usd", ".usda", ".usdc")))
            return [archive.read(entry) for entry in (entries[0], *others)]
    except (zipfile.BadZipFile, NotImplementedError, OSError, ValueError, RuntimeError, EOFError) as error:
        raise AssetError(f"its archive is damaged: {error}", where=where, remedy=REMEDY) from error


def refuse_deep_text(data: bytes, where: str) -> None:
    """Raise AssetError where brackets lie in brackets too often, in strings as well, or a path has too many steps."""
    quiet = _QUIET.findall(data)
    plain = _QUIET.sub(b"", data)
    is_deep = any(bracket_depth(part) > DEEPEST for part in (plain, *quiet))
    if is_deep or any(path.count(b"/") > DEEPEST for path in _PATH.findall(plain)):
        raise AssetError(f"it is nested more than {DEEPEST} deep", where=where, remedy=NEEDLESS)
