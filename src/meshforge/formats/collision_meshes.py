"""The collision meshes of a description: found, read once each, and cut into their pieces."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from meshforge.common import AssetError, MeshForgeError, file_digest
from meshforge.formats.mesh_reader import read_triangles, split_into_pieces
from meshforge.formats.meshfile.surface import RawSurface
from meshforge.formats.references import Resolver
from meshforge.geometry import Piece

_SHOWN = 120  # characters of a reference in a message

SurfaceSelector = Callable[[Sequence[RawSurface], tuple[str, ...]], Sequence[RawSurface]]
"""What a `MeshUse.part` stands for among the surfaces of a file."""


@dataclass(frozen=True, slots=True)
class MeshUse:
    """A collision element that refers to a mesh file; label: its name in messages; place: `file:line`.

    part: what of the file it uses, which the `select` of `CollisionMeshes` finds; empty for all of it.
    """

    label: str
    reference: str
    place: str
    resolver: Resolver
    part: tuple[str, ...] = ()

    @property
    def path(self) -> Path:
        """The file; only of one that `refuse_missing` let pass."""
        path = self.resolver.find(self.reference)
        assert path is not None
        return path


def refuse_missing(uses: Iterable[MeshUse]) -> None:
    """Raise AssetError where files are not there: the first, and how many more."""
    missing: list[MeshUse] = []
    for use in uses:
        if not use.reference:
            raise AssetError(f"collision {use.label!r} names no mesh file", where=use.place)
        if use.resolver.find(use.reference) is None:
            missing.append(use)
    if missing:
        first, others = missing[0], f" (and {len(missing) - 1} more like it)" if len(missing) > 1 else ""
        problem = f"the mesh {_shorten(first.reference)!r} of collision {first.label!r} is not there{others}"
        raise AssetError(problem, where=first.place, remedy=first.resolver.advice(first.reference))


class CollisionMeshes:
    """The mesh files of one asset; select: what elements use of them."""

    def __init__(self, select: SurfaceSelector = lambda surfaces, _: surfaces) -> None:
        self._select = select
        self._files: dict[Path, Sequence[RawSurface]] = {}
        self._surfaces: dict[tuple[Path, tuple[str, ...]], Sequence[RawSurface]] = {}
        self._pieces: dict[tuple[Path, tuple[str, ...]], list[Piece]] = {}

    def surfaces(self, use: MeshUse) -> Sequence[RawSurface]:
        """What an element uses of a file that is there.

        Raises AssetError naming the element and the mesh file: it cannot be read, or a number in it is not finite.
        """
        key = use.path, use.part
        if key not in self._surfaces:
            try:
                if use.path not in self._files:
                    self._files[use.path] = read_triangles(use.path)
                self._surfaces[key] = self._select(self._files[use.path], use.part)
            except MeshForgeError as error:
                raise AssetError(f"collision {use.label!r}: {error.message}", where=use.place) from error
        return self._surfaces[key]

    def pieces(self, use: MeshUse) -> list[Piece]:
        """The pieces of what an element uses, in the unit of the file. Raises AssetError as `surfaces` does."""
        key = use.path, use.part
        if key not in self._pieces:
            surfaces = self.surfaces(use)
            try:
                self._pieces[key] = split_into_pieces(surfaces, name=str(use.path))
            except MeshForgeError as error:
                raise AssetError(f"collision {use.label!r}: {error.message}", where=use.place) from error
        return self._pieces[key]

    def groups(self, use: MeshUse | None) -> list[str | None]:
        """The name of the group or node of each piece of a file that was cut; none for others."""
        if use is None or (use.path, use.part) not in self._pieces:
            return []
        names = [surface.name for surface in self._surfaces[use.path, use.part]]
        return [names[piece.group] for piece in self._pieces[use.path, use.part]]

    def digests(self) -> tuple[tuple[Path, str], ...]:
        """Digests of the files that hold several pieces, which an edit may have to part."""
        several = dict.fromkeys(path for (path, _), pieces in self._pieces.items() if len(pieces) > 1)
        return tuple((path, file_digest(path)) for path in several)


class SourceMeshes:
    """The mesh files of an asset when it is written; digests: of those that may have to be parted, as they were."""

    def __init__(self, digests: Iterable[tuple[Path, str]], where: str) -> None:
        self._digests, self._where = dict(digests), where
        self._surfaces: dict[Path, Sequence[RawSurface]] = {}

    def surfaces(self, reference: str, resolver: Resolver) -> Sequence[RawSurface]:
        """What is in a file. Raises AssetError where it has changed since the asset was read."""
        path = resolver.find(reference)
        if path is None or file_digest(path) != self._digests.get(path):
            raise change_error(f"the mesh {reference!r}", self._where)
        if path not in self._surfaces:
            self._surfaces[path] = read_triangles(path)
        return self._surfaces[path]


def change_error(what: str, where: str) -> AssetError:
    """The error about a file that is not what it was."""
    return AssetError(f"{what} has changed since the asset was read", where=where, remedy="Read the asset again.")


def refuse_changed_files(digests: Iterable[tuple[Path, str]], where: str, kind: str = "") -> None:
    """Raise AssetError where a file is not what it was when it had a digest; kind: what to call it, with a blank."""
    for path, digest in digests:
        if not path.is_file() or file_digest(path) != digest:
            raise change_error(f"{kind}{path.name}", where)


def _shorten(reference: str) -> str:
    return reference if len(reference) <= _SHOWN else f"{reference[:_SHOWN]}..."
