"""Formats of plug-ins: what they give is checked, and whatever they raise names their package."""

from collections import Counter
from collections.abc import Iterable, Iterator
from inspect import isabstract
from pathlib import Path
from typing import Any

from meshforge.common import Plugin, PluginError, blame, join_names
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.geometry import describe_fault, find_fault
from meshforge.symbolic import Asset, Feature, Geom, NonConvexPiece


def guard_format(plugin: Plugin, kind: Any, taken: Iterable[str]) -> Format:
    """Return a plug-in's format, guarded; taken: names of other formats. Raises PluginError where it does not fit."""
    if problem := _find_misfit(plugin.name, kind, taken):
        raise plugin.error(f"does not fit: {problem}")
    with blame(plugin):
        return _guard(plugin, kind)()


def _find_misfit(suffix: str, kind: Any, taken: Iterable[str]) -> str | None:
    if not (isinstance(kind, type) and issubclass(kind, Format)):
        return "it is no subclass of meshforge.formats.Format"
    if isabstract(kind):
        return f"it lacks {join_names(sorted(kind.__abstractmethods__))}"
    lacking = [name for name in ("name", "title", "suffixes") if not hasattr(kind, name)]
    if lacking:
        return f"it lacks {join_names(lacking)}"
    if f".{suffix}" not in kind.suffixes or suffix != suffix.lower():
        return f"the entry point is named {suffix}, which is none of its suffixes ({', '.join(kind.suffixes)})"
    if kind.name in taken:
        return f"MeshForge has a format named {kind.name!r}"
    return "a plug-in's assets are files, not folders" if kind.is_folder else None


def _guard(plugin: Plugin, kind: type[Format]) -> type[Format]:
    class GuardedFormat(kind):  # type: ignore[valid-type, misc]  # the class is known only when it is loaded
        def read(self, path: Path, options: ReadOptions) -> Asset:
            with blame(plugin, str(path)):
                return _check_asset(plugin, self.name, super().read(path, options), path)

        def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
            with blame(plugin, str(asset.path)):
                return _check_output(plugin, super().write(asset, name, mass))

        def create(self, asset: Asset, name: str) -> Output:
            with blame(plugin, str(asset.path)):
                return _check_output(plugin, super().create(asset, name))

        def features(self, asset: Asset) -> Iterable[Feature]:
            with blame(plugin, str(asset.path)):
                return tuple(super().features(asset))

        def top(self, asset: Asset) -> Path:
            with blame(plugin, str(asset.path)):
                return Path(super().top(asset))

        def is_main(self, path: Path) -> bool:
            try:
                return bool(super().is_main(path))
            except Exception:  # it is an asset then, whose reading says what is wrong
                return True

        def matches_head(self, head: bytes) -> bool:
            try:
                return bool(super().matches_head(head))
            except Exception:  # as above
                return True

    return GuardedFormat


def _check_asset(plugin: Plugin, name: str, asset: Any, path: Path) -> Asset:
    """The asset that was read. Raises PluginError where it is none that MeshForge can work with."""
    if not isinstance(asset, Asset):
        raise plugin.error(f"read a {type(asset).__name__}, not an Asset", str(path))
    if problem := next(_find_faults(name, asset), None):
        raise plugin.error(problem, str(path))
    return asset


def _find_faults(name: str, asset: Asset) -> Iterator[str]:
    if asset.format != name:
        yield f"read an asset of the format {asset.format!r}, not {name!r}"
    pieces: list[Geom | NonConvexPiece] = [*asset.geoms, *asset.non_convex]
    counts = Counter(piece.name for piece in pieces)
    yield from (f"gave several hulls the name {one!r}" for one, count in counts.items() if count > 1)
    for piece in pieces:
        if piece.body not in asset.body_poses:
            yield f"put the hull {piece.name!r} into the body {piece.body!r}, which is not there"
    for geom in asset.geoms:
        if fault := find_fault(geom.shape):
            yield f"read the hull {geom.name!r}, which {describe_fault(fault)}"


def _check_output(plugin: Plugin, output: Any) -> Output:
    if isinstance(output, Output) and isinstance(output.main, bytes):
        return output
    raise PluginError(f"{plugin} wrote no Output of bytes", remedy=f"Update or uninstall {plugin.package}.")
