"""What the plain mesh formats have in common: a file is one body, its convex pieces are the hulls.

A writer hands over the new file and the owner that each triangle should have; reading it back shows if it does so.
"""

import itertools
from abc import abstractmethod
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from meshforge.common import AssetError, GeometryError
from meshforge.formats import collision_pieces, mesh_reader, references
from meshforge.formats.base import Format, Mass, Output, ReadOptions, note_renames
from meshforge.formats.meshfile.surface import Soup, parts_of_groups
from meshforge.formats.plain import parts as mesh_parts
from meshforge.geometry import Floats, Piece, Pose, distinct, split_pieces
from meshforge.symbolic import Asset, Body, Document, FeatureKind, Geom, Mentions, NonConvexPiece, Surface

BODY = "body"
"""The name of the one body of a plain mesh file."""


@dataclass(frozen=True, eq=False, slots=True)
class MeshFileEdit:
    """What is to become of a file: pieces that go, parts that come behind the others.

    explicit: every piece that stays is to be named in the file, as far as the format can, lest names change.
    """

    document: mesh_parts.PlainDocument
    path: Path
    gone: frozenset[str]
    parts: tuple[mesh_parts.MeshPart, ...]
    explicit: bool = False

    @property
    def stays(self) -> npt.NDArray[np.bool_]:
        """Whether each triangle (m,) stays."""
        return np.array([name not in self.gone for name in self.document.names], dtype=bool)[self.document.owner]

    @property
    def owners(self) -> list[str]:
        """The owner that each triangle of the edited file should have."""
        return list(itertools.compress(self.document.owners, self.stays)) + mesh_parts.owners_of(self.parts)


@dataclass(frozen=True, eq=False, slots=True)
class TargetTriangles:
    """The triangles that a written file should hold: the owner of each, and the corners (m, 3, 3).

    kept: how many of them, the first, stay as they were; the others are made.
    """

    owners: Sequence[str]
    corners: Floats
    kept: int = 0


class PlainFormat(Format):
    """A format of mesh files without structure."""

    holds: ClassVar[frozenset[FeatureKind]] = frozenset({FeatureKind.NON_CONVEX})
    instead: ClassVar[Mapping[FeatureKind, str]] = mesh_parts.AS_HULLS

    @abstractmethod
    def parse_soup(self, data: bytes, path: Path) -> Soup:
        """Return the triangles in the bytes of a file. Raises AssetError."""

    @abstractmethod
    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        """Return the bytes of the edited file, triangles that stay first and in order. Raises AssetError."""

    @abstractmethod
    def format_parts(self, parts: Sequence[mesh_parts.MeshPart]) -> bytes:
        """Return the bytes of a new file of these parts."""

    def read(self, path: Path, options: ReadOptions) -> Asset:
        document, found, soup = self.parse(mesh_reader.read_content(path), path)
        files = tuple(dict.fromkeys(references.find_companions(path).values()))
        return replace(build_asset(path, self.name, soup, found), document=document, files=files)

    def parse(self, data: bytes, path: Path) -> tuple[mesh_parts.PlainDocument, list[Piece], Soup]:
        """Return the document of a file's bytes, its pieces and triangles. Raises AssetError naming the path."""
        soup = self.parse_soup(data, path)
        try:
            found = split_pieces(soup.vertices, soup.faces, name=str(path), groups=soup.group)
        except GeometryError as error:
            raise AssetError(error.problem, where=str(path), remedy=error.remedy) from error
        owner = np.zeros(len(soup.faces), dtype=np.int64)
        for k, piece in enumerate(found):
            owner[piece.face_indices] = k
        names = tuple(mesh_parts.name_file_pieces(found, soup.names))
        return mesh_parts.PlainDocument(data, names, owner, len(np.unique(soup.group))), found, soup

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        document = asset.document
        if not isinstance(document, mesh_parts.PlainDocument):
            raise self._creation_error(asset)
        non_convex = {piece.name for piece in asset.non_convex}
        kept = {geom.name for geom in asset.geoms if geom.parent is None} & set(document.names)
        gone = frozenset(n for n in document.names if n not in kept and n not in non_convex)
        new = [geom for geom in asset.geoms if geom.name not in kept]
        beside = references.find_companions(asset.path)
        if not gone and not new:
            return Output(document.data, copies=beside)
        parts, notes = mesh_parts.to_parts(new)
        edit = MeshFileEdit(document, asset.path, gone, parts)
        data, names = self._edit_file(edit, {*kept, *(geom.name for geom in new)})
        return Output(data, copies=beside, notes=(*notes, *note_renames(names)), names=names)

    def create(self, asset: Asset, name: str) -> Output:
        parts = mesh_parts.collect_parts(asset)
        data = self.format_parts(parts)
        hulls = {geom.name for geom in asset.geoms}
        wanted = TargetTriangles(mesh_parts.owners_of(parts), mesh_parts.corners_of(parts))
        return Output(data, names=self._check_output(data, Path(name), wanted, hulls, asset.path))

    def _edit_file(self, edit: MeshFileEdit, hulls: Collection[str]) -> tuple[bytes, dict[str, str]]:
        """The edited file, and the names that read back otherwise; with explicit names where that repairs them."""
        if not edit.owners:
            raise AssetError("the edit leaves nothing in this file", where=str(edit.path))
        data = self.apply_edit(edit)
        soup = self.parse_soup(edit.document.data, edit.path)
        kept = soup.vertices[soup.faces[edit.stays]]
        wanted = TargetTriangles(edit.owners, np.concatenate([kept, mesh_parts.corners_of(edit.parts)]), len(kept))
        names = self._check_output(data, edit.path, wanted, hulls, edit.path)
        if names:
            data = self.apply_edit(replace(edit, explicit=True))
            names = self._check_output(data, edit.path, wanted, hulls, edit.path)
        return data, names

    def _check_output(
        self, data: bytes, path: Path, wanted: TargetTriangles, hulls: Collection[str], where: Path
    ) -> dict[str, str]:
        """The hulls that a written file reads back under another name, with that name.

        wanted: what it should hold; hulls: those of its owners that are hulls. Raises AssetError at `where`: hulls that
        the file cannot hold apart, or holds as something else or elsewhere.
        """
        document, found, soup = self.parse(data, path)
        if len(document.owner) != len(wanted.owners):
            raise AssetError("the written file would lose triangles", where=str(where))
        _refuse_moved(soup, wanted, str(where))
        convex = {name for name, piece in zip(document.names, found, strict=True) if piece.shape}
        back: dict[str, set[str]] = {}
        for name, piece in zip(wanted.owners, document.owners, strict=True):
            back.setdefault(name, set()).add(piece)
        shared = Counter(piece for pieces in back.values() for piece in pieces)
        for name in sorted(hulls, key=mesh_parts.natural_key):
            holders = back.get(name, set())
            if len(holders) != 1 or any(shared[piece] > 1 or piece not in convex for piece in holders):
                problem = f"the hull {name} cannot be told apart from others in this file"
                remedy = "Write an OBJ, which has groups, or a folder of files."
                raise AssetError(problem, where=str(where), remedy=remedy)
        read = {name: min(back[name]) for name in back if name in hulls}
        return {name: now for name, now in read.items() if now != name}


def _refuse_moved(soup: Soup, wanted: TargetTriangles, where: str) -> None:
    """Raise AssetError where a corner is not where it should be; those of made triangles may be single precision."""
    corners = soup.vertices[soup.faces]
    there = corners == wanted.corners
    there[wanted.kept :] |= corners[wanted.kept :] == wanted.corners[wanted.kept :].astype(np.float32)
    if not there.all():
        x, y, z = wanted.corners[~there.all(axis=2)][0]
        raise AssetError(f"the written file would have the vertex {x:.6g} {y:.6g} {z:.6g} elsewhere", where=where)


def build_asset(path: Path, kind: str, soup: Soup, found: Sequence[Piece]) -> Asset:
    """Return the asset of the pieces of triangles, without a document; kind: the name of its format."""
    names = mesh_parts.name_file_pieces(found, soup.names)
    named = [(name, piece, _mentions_of(soup, piece)) for name, piece in zip(names, found, strict=True)]
    own = [[name for name, piece, _ in named if piece.group == group] for group in range(len(soup.names))]
    elements = [collision_pieces.element_of(names) if names else "" for names in own]
    hulls, others = list[Geom](), list[NonConvexPiece]()
    for name, piece, texts in named:
        if piece.shape:
            hulls.append(Geom(name, BODY, piece.shape, mentions=texts, element=elements[piece.group], fill=piece.fill))
        else:
            surface, reason = _surface_of(soup, piece), piece.reason or ""
            others.append(NonConvexPiece(name, BODY, reason, surface, None, texts, elements[piece.group]))
    return Asset(path, kind, (Body(BODY, Pose.identity()),), tuple(hulls), Document(), tuple(others))


def _mentions_of(soup: Soup, piece: Piece) -> Mentions:
    return collision_pieces.drop_repeats(
        (kind, names[k]) for kind, owner, names in soup.mentions for k in distinct(owner[piece.face_indices]).tolist()
    )


def _surface_of(soup: Soup, piece: Piece) -> Surface:
    own = piece.face_indices
    return Surface(piece.vertices, piece.faces, parts=parts_of_groups(soup.group[own], soup.names))
