"""A folder of mesh files as one asset, read and written: one body, the pieces of its files its hulls, named so."""

import re
from collections import Counter
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from meshforge.common import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions, note_renames
from meshforge.formats.kinematic_tree import claim_name
from meshforge.formats.plain.base import BODY, PlainFormat
from meshforge.formats.plain.obj import ObjFormat
from meshforge.formats.plain.parts import (
    AS_HULLS,
    MeshPart,
    PlainDocument,
    collect_parts,
    name_members,
    natural_key,
    to_parts,
)
from meshforge.formats.plain.ply import PlyFormat
from meshforge.formats.plain.stl import StlFormat, WrlFormat
from meshforge.formats.references import find_companions
from meshforge.formats.segmentation import is_segmentation
from meshforge.geometry import Pose
from meshforge.symbolic import Asset, Body, Document, FeatureKind, Geom, Mentions, NonConvexPiece

GeomOrPiece = TypeVar("GeomOrPiece", Geom, NonConvexPiece)

_LONGEST = 120  # letters of a made file name, well below the 255 bytes of file systems


@dataclass(frozen=True, eq=False, slots=True)
class FolderDocument(Document):
    """The files of a folder, in natural order."""

    members: "tuple[FolderMember, ...]"


class FolderFormat(Format):
    """Folders of plain mesh files; files below them and files of other kinds do not count."""

    name = "folder"
    suffixes = ()
    is_folder = True
    title = "a folder of mesh files"
    holds = frozenset({FeatureKind.NAMES, FeatureKind.NON_CONVEX})
    instead = AS_HULLS

    members: tuple[PlainFormat, ...] = (ObjFormat(), StlFormat(), PlyFormat(), WrlFormat())

    def read(self, path: Path, options: ReadOptions) -> Asset:
        files = self.mesh_files(path)
        if not files:
            raise AssetError("there is no mesh file in this folder", where=str(path))
        assets = [self.format_of(file).read(file, options) for file in files]
        members = [FolderMember(file.name, asset, {}) for file, asset in zip(files, assets, strict=True)]
        names = name_members([m.file for m in members], [m.document for m in members])
        members = [replace(m, names=found) for m, found in zip(members, names, strict=True)]
        pairs = [(member.names, member.asset) for member in members]
        return Asset(
            path=path,
            format=self.name,
            bodies=(Body(BODY, Pose.identity()),),
            geoms=tuple(_rename(g, names[g.name]) for names, asset in pairs for g in asset.geoms),
            document=FolderDocument(tuple(members)),
            non_convex=tuple(_rename(o, names[o.name]) for names, asset in pairs for o in asset.non_convex),
            files=tuple(dict.fromkeys(f for asset in assets for f in (asset.path, *asset.files))),
            notes=tuple(f"{asset.path.name}: {note}" for asset in assets for note in asset.notes),
        )

    def mesh_files(self, folder: Path) -> list[Path]:
        """Return the mesh files of a folder, in natural order."""
        files = [f for f in folder.iterdir() if f.is_file() and not f.name.startswith(".")]
        known = tuple(suffix for member in self.members for suffix in member.suffixes)
        found = (f for f in files if f.suffix.lower() in known and not is_segmentation(f))
        return sorted(found, key=lambda f: natural_key(f.name))

    def format_of(self, path: Path) -> PlainFormat:
        """Return the format of a member. Raises StopIteration for a file of another kind."""
        return next(member for member in self.members if path.suffix.lower() in member.suffixes)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        document = asset.document
        if not isinstance(document, FolderDocument):
            raise self._creation_error(asset)
        own = {name for member in document.members for name in member.names.values()}
        kept = {g.name for g in asset.geoms if g.parent is None} & own | {o.name for o in asset.non_convex}
        tree = FolderWriter(self.format_of)
        if not kept and not asset.geoms:
            raise AssetError("the edit leaves nothing in this folder", where=str(asset.path))
        for member in document.members:
            tree.keep(member, kept)
        counts = Counter(Path(m.file).suffix for m in document.members if self.format_of(Path(m.file)).writable)
        suffix = counts.most_common(1)[0][0] if counts else ".obj"
        parts, notes = to_parts(g for g in asset.geoms if g.name not in kept)
        for part in parts:
            tree.add(part, suffix)
        output = tree.to_output({g.name for g in asset.geoms})
        return replace(output, notes=(*notes, *note_renames(output.names)))

    def create(self, asset: Asset, name: str) -> Output:
        tree = FolderWriter(self.format_of)
        for part in collect_parts(asset):
            tree.add(part, ".obj")
        return tree.to_output({g.name for g in asset.geoms})


def _rename(piece: GeomOrPiece, name: str) -> GeomOrPiece:
    """A piece of a file with its name in the folder; a name that its file alone has is not forgotten."""
    own: Mentions = () if piece.name in name or piece.name.startswith("geom") else (("group", piece.name),)
    element = name.rpartition("#")[0] if piece.element else ""
    return replace(piece, name=name, mentions=(*own, *piece.mentions), element=element)


@dataclass(frozen=True, eq=False, slots=True)
class FolderMember:
    """A file of the folder: its own asset, and the name in the folder's asset of each of its pieces."""

    file: str
    asset: Asset
    names: dict[str, str]

    @property
    def document(self) -> PlainDocument:
        assert isinstance(self.asset.document, PlainDocument)
        return self.asset.document


class FolderWriter:
    """Collects the files, and which hull each of their pieces is."""

    def __init__(self, format_of: Callable[[Path], PlainFormat]) -> None:
        self.format_of = format_of
        self.made: dict[str, bytes] = {}
        self.copies: dict[str, Path] = {}
        self.beside: dict[str, Path] = {}
        self.documents: dict[str, PlainDocument] = {}
        self.hulls: dict[str, dict[str, str]] = {}  # by file, then by the name of a piece in it

    def keep(self, member: FolderMember, kept: Collection[str]) -> None:
        """Take over a file, with those of its pieces that are kept."""
        stay = [piece for piece, name in member.names.items() if name in kept]
        if len(stay) == len(member.names):
            self.copies[member.file] = member.asset.path
            self.documents[member.file] = member.document
            self.hulls[member.file] = member.names
        elif stay and member.document.groups == 1 and not member.asset.non_convex:
            for piece in stay:  # a file each, since a piece alone would be called after the file
                self._edit_member(member, [piece], self._find_free_name(member.names[piece], Path(member.file).suffix))
        elif stay:
            self._edit_member(member, stay, member.file)
        if stay:
            self.beside |= find_companions(member.asset.path)

    def add(self, part: MeshPart, suffix: str) -> None:
        """Make the file of a new hull."""
        file = self._find_free_name(part.name, suffix)
        self._put_file(file, self.format_of(Path(file)).format_parts([part]))
        self.hulls[file] = dict.fromkeys(self.documents[file].names, part.name)

    def to_output(self, hulls: Collection[str]) -> Output:
        """Return all files, and which of the hulls will read back under another name."""
        files = sorted(self.documents, key=natural_key)
        back = name_members(files, [self.documents[file] for file in files])
        names = {
            wanted: found[piece]
            for file, found in zip(files, back, strict=True)
            for piece, wanted in self.hulls[file].items()
            if wanted in hulls and found[piece] != wanted
        }
        copies = {**self.beside, **self.copies}
        return Output(b"", self.made, copies, names=names)

    def _edit_member(self, member: FolderMember, stay: list[str], file: str) -> None:
        geoms = [geom for geom in member.asset.geoms if geom.name in stay]
        written = self.format_of(Path(file)).write(member.asset.with_geoms(geoms), file)
        self._put_file(file, written.main)
        now = {piece: written.names.get(piece, piece) for piece in stay}
        self.hulls[file] = {now[piece]: member.names[piece] for piece in stay}

    def _put_file(self, file: str, data: bytes) -> None:
        self.made[file] = data
        self.documents[file] = self.format_of(Path(file)).parse(data, Path(file))[0]

    def _find_free_name(self, name: str, suffix: str) -> str:
        safe = re.sub(r"[^\w.#~@ +-]+", "_", name)[:_LONGEST].strip(". ") or "hull"
        taken = {file.lower() for file in self.documents}
        return claim_name(safe, taken, lambda stem: stem + suffix, str.lower)
