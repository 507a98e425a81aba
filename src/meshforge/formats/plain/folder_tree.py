"""The files of a folder that is written: those that stay as they are, those that lose pieces, and new ones."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection
from dataclasses import dataclass
from pathlib import Path

from meshforge.asset import Asset
from meshforge.formats.base import Output
from meshforge.formats.companions import companions
from meshforge.formats.plain.parts import Part, PlainDocument, member_names, natural
from meshforge.formats.plain.plain import PlainFormat

_LONGEST = 120  # letters of a made file name, well below the 255 bytes of file systems


@dataclass(frozen=True, eq=False, slots=True)
class Member:
    """A file of the folder: its own asset, and the name in the folder's asset of each of its pieces."""

    file: str
    asset: Asset
    names: dict[str, str]

    @property
    def document(self) -> PlainDocument:
        assert isinstance(self.asset.document, PlainDocument)
        return self.asset.document


class Tree:
    """Collects the files, and which hull each of their pieces is."""

    def __init__(self, format_of: Callable[[Path], PlainFormat]) -> None:
        self.format_of = format_of
        self.made: dict[str, bytes] = {}
        self.copies: dict[str, Path] = {}
        self.beside: dict[str, Path] = {}
        self.documents: dict[str, PlainDocument] = {}
        self.hulls: dict[str, dict[str, str]] = {}  # by file, then by the name of a piece in it

    def keep(self, member: Member, kept: Collection[str]) -> None:
        """Take over a file, with those of its pieces that are kept."""
        stay = [piece for piece, name in member.names.items() if name in kept]
        if len(stay) == len(member.names):
            self.copies[member.file] = member.asset.path
            self.documents[member.file] = member.document
            self.hulls[member.file] = member.names
        elif stay and member.document.groups == 1 and not member.asset.opaque:
            for piece in stay:  # a file each, since a piece alone would be called after the file
                self._edit_member(member, [piece], self._find_free_name(member.names[piece], Path(member.file).suffix))
        elif stay or member.asset.visuals:  # a file of something seen is not lost with its hulls: its writer refuses
            self._edit_member(member, stay, member.file)
        if stay:
            self.beside |= companions(member.asset.path)

    def add(self, part: Part, suffix: str) -> None:
        """Make the file of a new hull."""
        file = self._find_free_name(part.name, suffix)
        self._put_file(file, self.format_of(Path(file)).format_parts([part]))
        self.hulls[file] = dict.fromkeys(self.documents[file].names, part.name)

    def to_output(self, hulls: Collection[str]) -> Output:
        """All files, and which of the hulls will read back under another name."""
        files = sorted(self.documents, key=natural)
        back = member_names(files, [self.documents[file] for file in files])
        names = {
            wanted: found[piece]
            for file, found in zip(files, back, strict=True)
            for piece, wanted in self.hulls[file].items()
            if wanted in hulls and found[piece] != wanted
        }
        copies = {**self.beside, **self.copies}
        return Output(b"", self.made, copies, names=names)

    def _edit_member(self, member: Member, stay: list[str], file: str) -> None:
        geoms = [geom for geom in member.asset.geoms if geom.name in stay]
        written = self.format_of(Path(file)).write(member.asset.with_geoms(geoms), file)
        self._put_file(file, written.main)
        now = {piece: written.names.get(piece, piece) for piece in stay}
        self.hulls[file] = {now[piece]: member.names[piece] for piece in stay}

    def _put_file(self, file: str, data: bytes) -> None:
        self.made[file] = data
        self.documents[file] = self.format_of(Path(file)).parse_document(data, Path(file))[0]

    def _find_free_name(self, name: str, suffix: str) -> str:
        """A file name for a hull that no other file has, in any case of letters."""
        safe = re.sub(r"[^\w.#~@ +-]+", "_", name)[:_LONGEST].strip(". ") or "hull"
        taken = {file.lower() for file in self.documents}
        stem, number = safe, 2
        while f"{stem}{suffix}".lower() in taken:
            stem, number = f"{safe}_{number}", number + 1
        return f"{stem}{suffix}"
