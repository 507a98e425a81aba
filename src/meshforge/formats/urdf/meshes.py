"""The collision meshes of a URDF: found, read once each, and cut into their pieces."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from meshforge.errors import AssetError, MeshForgeError
from meshforge.formats.references import Resolver
from meshforge.formats.triangles import pieces_of, read_triangles
from meshforge.formats.urdf.document import digest_of
from meshforge.formats.xml import Element
from meshforge.geometry import Piece

_SHOWN = 120  # characters of a reference in a message


class Meshes:
    """The meshes of one file; where: its name in errors."""

    def __init__(self, resolver: Resolver, where: str) -> None:
        self.resolver, self.where = resolver, where
        self._pieces: dict[Path, list[Piece]] = {}
        self._groups: dict[Path, list[str | None]] = {}

    def refuse_missing(self, meshes: Iterable[tuple[str, Element]]) -> None:
        """Raise AssetError where files of labelled `<mesh>` elements are not there: the first, and how many more."""
        lost: list[tuple[str, Element, str]] = []
        for label, mesh in meshes:
            reference = mesh.attributes.get("filename", "").strip()
            if not reference:
                raise AssetError(f"collision {label!r} names no mesh file", where=f"{self.where}:{mesh.line}")
            if self.resolver.find(reference) is None:
                lost.append((label, mesh, reference))
        if lost:
            label, mesh, reference = lost[0]
            others = f" (and {len(lost) - 1} more like it)" if len(lost) > 1 else ""
            raise AssetError(
                f"the mesh {_short(reference)!r} of collision {label!r} is not there{others}",
                where=f"{self.where}:{mesh.line}",
                remedy=self.resolver.advice(reference),
            )

    def pieces(self, label: str, mesh: Element) -> list[Piece]:
        """The pieces of a `<mesh>` that is there, in the unit of its file.

        Raises AssetError naming `label` and the mesh file: it cannot be read, or a number in it is not finite.
        """
        path = self.resolver.find(mesh.attributes["filename"])
        assert path is not None  # `refuse_missing` saw it
        if path not in self._pieces:
            try:
                surfaces = read_triangles(path)
                self._pieces[path] = pieces_of(surfaces, name=str(path))
                self._groups[path] = [surface.name for surface in surfaces]
            except MeshForgeError as error:
                place = f"{self.where}:{mesh.line}"
                raise AssetError(f"collision {label!r}: {error.message}", where=place) from error
        return self._pieces[path]

    def groups(self, kind: Element | None) -> list[str | None]:
        """The name of the group or node of each piece of a `<mesh>` that was read; none for other shapes."""
        path = self.resolver.find(kind.attributes["filename"]) if kind and kind.tag == "mesh" else None
        return [self._groups[path][piece.group] for piece in self._pieces[path]] if path in self._pieces else []

    def digests(self) -> tuple[tuple[Path, str], ...]:
        """Digests of the files that hold several pieces, which an edit may have to part."""
        return tuple((path, digest_of(path)) for path, pieces in self._pieces.items() if len(pieces) > 1)


def _short(reference: str) -> str:
    return reference if len(reference) <= _SHOWN else f"{reference[:_SHOWN]}..."
