"""Names of pieces, shapes as triangles to write, and what a written file reads back as."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshforge.formats.base import note_shapes_as_hulls, nothing_collides_error
from meshforge.geometry import Box, Floats, Ints, Piece, Polytope
from meshforge.symbolic import PRIMITIVE_FEATURES, Asset, Document, FeatureKind, Geom, Surface, unique_names

AS_HULLS: Mapping[FeatureKind, str] = dict.fromkeys(PRIMITIVE_FEATURES.values(), "written as triangles")
"""How formats without native shapes hold them."""


@dataclass(frozen=True, eq=False, slots=True)
class PlainDocument(Document):
    """A mesh file as it was read: its bytes, the names of its pieces, and the piece (m,) of each triangle.

    groups: how many groups of the file have faces.
    """

    data: bytes
    names: tuple[str, ...]
    owner: Ints
    groups: int

    @property
    def owners(self) -> list[str]:
        """The name of the piece of each triangle."""
        return [self.names[k] for k in self.owner.tolist()]


@dataclass(frozen=True, eq=False, slots=True)
class MeshPart:
    """Triangles to be written under a name."""

    name: str
    surface: Surface


def owners_of(parts: Sequence[MeshPart]) -> list[str]:
    """Return the owner that each triangle of a file of these parts should have."""
    return [part.name for part in parts for _ in part.surface.faces]


def corners_of(parts: Sequence[MeshPart]) -> Floats:
    """Return the corners (m, 3, 3) of the triangles of parts."""
    corners = [part.surface.vertices[part.surface.faces] for part in parts]
    return np.concatenate([np.zeros((0, 3, 3)), *corners]) + 0.0


def name_file_pieces(pieces: Sequence[Piece], groups: Sequence[str | None]) -> list[str]:
    """Return a unique name for each piece: its group's, else `geomK`; with `#k` where the group has several pieces."""
    unnamed = {k: f"geom{n}" for n, k in enumerate(k for k, name in enumerate(groups) if not name)}
    several = Counter(piece.group for piece in pieces)
    seen: Counter[int] = Counter()
    names = []
    for piece in pieces:
        name = groups[piece.group] or unnamed[piece.group]
        names.append(f"{name}#{seen[piece.group]}" if several[piece.group] > 1 else name)
        seen[piece.group] += 1
    return unique_names(names)


def name_members(files: Sequence[str], documents: Sequence[PlainDocument]) -> list[dict[str, str]]:
    """Return for each file of a folder, the name in the folder of each of its pieces.

    That is the file's stem where it has one piece, else the stem and the number of the piece, or the stem and the
    piece's own name where the file has several groups.
    """
    stems = unique_names(Path(file).stem for file in files)
    found = []
    for stem, document in zip(stems, documents, strict=True):
        names = document.names
        if len(names) == 1:
            found.append([stem])
        elif document.groups > 1:
            found.append([f"{stem}/{name}" for name in names])
        else:
            found.append([f"{stem}#{k}" for k in range(len(names))])
    unique = iter(unique_names(name for names in found for name in names))
    return [{piece: next(unique) for piece in document.names} for document in documents]


def natural_key(name: str) -> tuple[tuple[bool, int, str], ...]:
    """Return a key that sorts names as people do: `2` before `10`."""
    words = re.findall(r"\d+|\D+", name)
    return (*((not word.isdigit(), int(word) if word.isdigit() else 0, word) for word in words),)


def to_parts(geoms: Iterable[Geom]) -> tuple[tuple[MeshPart, ...], tuple[str, ...]]:
    """Return geoms as triangles, and notes on those that lose by it."""
    parts, round_ones = [], []
    for geom in geoms:
        shape = geom.shape.tessellate()
        parts.append(MeshPart(geom.name, Surface(shape.vertices, shape.faces)))
        if not isinstance(geom.shape, Polytope | Box):
            round_ones.append(geom.shape.kind)
    return tuple(parts), tuple(note_shapes_as_hulls(round_ones, "mesh files have no primitives"))


def collect_parts(asset: Asset) -> tuple[MeshPart, ...]:
    """Return the hulls and the non-convex surfaces of an asset. Raises AssetError where there are none."""
    seen = tuple(MeshPart(piece.name, piece.surface) for piece in asset.non_convex if piece.surface)
    parts = to_parts(asset.geoms)[0] + seen
    if not parts:
        raise nothing_collides_error(asset)
    return parts
