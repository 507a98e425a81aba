"""A folder of mesh files as one asset: one body, the pieces of all files its hulls, named after the files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from meshforge.asset import Asset, Body, Document, Geom, Mentions, Opaque, What
from meshforge.errors import AssetError
from meshforge.formats.base import Format, Mass, Output, ReadOptions
from meshforge.formats.plain.folder_tree import Member, Tree
from meshforge.formats.plain.parts import all_parts, as_parts, member_names, natural, renaming
from meshforge.formats.plain.plain import AS_HULLS, BODY, PlainFormat
from meshforge.formats.segmented.places import is_segmented
from meshforge.geometry import Pose


@dataclass(frozen=True, eq=False, slots=True)
class FolderDocument(Document):
    """The files of a folder, in natural order."""

    members: tuple[Member, ...]


Kept = TypeVar("Kept", Geom, Opaque)


class Folder(Format):
    """Folders of plain mesh files; files below them and files of other kinds do not count."""

    name = "folder"
    suffixes = ()
    is_folder = True
    title = "a folder of mesh files"
    holds = frozenset({What.NAMES, What.OPAQUE})
    instead = AS_HULLS

    def __init__(self, members: Sequence[PlainFormat]) -> None:
        self.members = tuple(members)

    def read(self, path: Path, options: ReadOptions) -> Asset:
        files = self.mesh_files(path)
        if not files:
            raise AssetError("there is no mesh file in this folder", where=str(path))
        assets = [self.format_of(file).read(file, options) for file in files]
        members = [Member(file.name, asset, {}) for file, asset in zip(files, assets, strict=True)]
        names = member_names([m.file for m in members], [m.document for m in members])
        members = [replace(m, names=found) for m, found in zip(members, names, strict=True)]
        pairs = [(member.names, member.asset) for member in members]
        return Asset(
            path=path,
            format=self.name,
            bodies=(Body(BODY, Pose.identity()),),
            geoms=tuple(_renamed(g, names[g.name]) for names, asset in pairs for g in asset.geoms),
            document=FolderDocument(tuple(members)),
            opaque=tuple(_renamed(o, names[o.name]) for names, asset in pairs for o in asset.opaque),
            visuals=tuple(surface for asset in assets for surface in asset.visuals),
            files=tuple(dict.fromkeys(f for asset in assets for f in (asset.path, *asset.files))),
            notes=tuple(f"{asset.path.name}: {note}" for asset in assets for note in asset.notes),
        )

    def mesh_files(self, folder: Path) -> list[Path]:
        """The mesh files of a folder, in natural order."""
        files = [f for f in folder.iterdir() if f.is_file() and not f.name.startswith(".")]
        return sorted((f for f in files if self._knows(f)), key=lambda f: natural(f.name))

    def _knows(self, path: Path) -> bool:
        return not is_segmented(path) and any(path.suffix.lower() in member.suffixes for member in self.members)

    def format_of(self, path: Path) -> PlainFormat:
        """The format of a member. Raises StopIteration for a file of another kind."""
        return next(member for member in self.members if path.suffix.lower() in member.suffixes)

    def write(self, asset: Asset, name: str, mass: Mass = "keep") -> Output:
        document = asset.document
        if not isinstance(document, FolderDocument):
            raise self._creation_error(asset)
        own = {name for member in document.members for name in member.names.values()}
        kept = {g.name for g in asset.geoms if g.parent is None} & own | {o.name for o in asset.opaque}
        tree = Tree(self.format_of)
        if not kept and not asset.geoms:
            raise AssetError("the edit leaves nothing in this folder", where=str(asset.path))
        for member in document.members:
            tree.keep(member, kept)
        suffix = self._usual_suffix(document)
        parts, notes = as_parts(g for g in asset.geoms if g.name not in kept)
        for part in parts:
            tree.add(part, suffix)
        output = tree.to_output({g.name for g in asset.geoms})
        return replace(output, notes=(*notes, *renaming(output.names)))

    def _usual_suffix(self, document: FolderDocument) -> str:
        """The suffix of most files that can be written, as they write it."""
        counts = Counter(Path(m.file).suffix for m in document.members if self.format_of(Path(m.file)).writable)
        return counts.most_common(1)[0][0] if counts else ".obj"

    def create(self, asset: Asset, name: str) -> Output:
        tree = Tree(self.format_of)
        for part in all_parts(asset):
            tree.add(part, ".obj")
        return tree.to_output({g.name for g in asset.geoms})


def _renamed(piece: Kept, name: str) -> Kept:
    """A piece of a file with its name in the folder; a name that its file alone has is not forgotten."""
    told: Mentions = () if piece.name in name or piece.name.startswith("geom") else (("group", piece.name),)
    return replace(piece, name=name, mentions=(*told, *piece.mentions))
