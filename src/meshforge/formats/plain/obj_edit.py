"""Editing the text of an OBJ: of the statements that stay, only vertex numbers and group lines change."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile.obj import Group, ObjText, arguments, name_in
from meshforge.formats.meshfile.obj_rows import keywords
from meshforge.formats.plain.obj_text import line_end, named, parts_text
from meshforge.formats.plain.parts import SEEN
from meshforge.formats.plain.plain import Edit

_NUMBER = re.compile(rb"(\s)([+-]?\d+)")
_FACES = (b"f", b"fo")
_OTHERS = (b"l", b"p")
_FREE_FORM = (b"curv", b"curv2", b"surf", b"bzp", b"bsp", b"cdc", b"cdp")


def edited_obj(text: ObjText, edit: Edit) -> bytes:
    """The bytes of the edited file. Raises AssetError: free-form surfaces, which also use the vertices."""
    return _Editor(text, edit).to_bytes()


class _Editor:
    def __init__(self, text: ObjText, edit: Edit) -> None:
        self.text = text
        self.edit = edit
        self.words = keywords(text.statements)
        if any(word in _FREE_FORM for word in self.words):
            raise AssetError("files with free-form surfaces cannot be edited", where=str(edit.path))
        self.stays = dict(zip(text.face_at.tolist(), edit.stays.tolist(), strict=True))
        self.bare = {  # statements that name vertices and make no triangle, which stay
            k for k, word in enumerate(self.words) if word in _OTHERS or (word in _FACES and k not in self.stays)
        }
        self.wanted = self._target_groups()
        self.end = line_end(text.statements)
        self._number_vertices()

    def to_bytes(self) -> bytes:
        body = b"".join(self._lines())
        if body and not body.endswith((b"\n", b"\r")):
            body += self.end
        if self.edit.parts and body.rstrip(b"\r\n").endswith(b"\\"):  # what follows would be of the last statement
            body += self.end
        width = len(arguments(self.text.statements[self.text.vertex_at[0]]))
        colors = width - 3 if width in (6, 7) else 0
        words = (b"o", b"g") if self.edit.document.marked else (b"o",)
        return body + parts_text(self.edit.parts, int(self.kept.sum()), self.end, colors, words)

    def _target_groups(self) -> dict[int, Group]:
        """The group that each face statement which stays should be in."""
        document, text = self.edit.document, self.text
        touched = set(text.face_group[~self.edit.stays].tolist())
        wanted: dict[int, Group] = {}
        for at, group, owner in zip(text.face_at.tolist(), text.face_group.tolist(), document.owners, strict=True):
            if self.stays[at]:
                rename = (self.edit.explicit or group in touched) and owner != SEEN
                wanted[at] = (owner, "") if rename else text.groups[group]
        return wanted

    def _number_vertices(self) -> None:
        """Which vertices stay, all but those that only faces which go have used, and their new numbers."""
        text = self.text
        self.kept = np.ones(len(text.vertices), dtype=bool)
        self.kept[np.unique(text.faces[~self.edit.stays])] = False
        self.kept[np.unique(text.faces[self.edit.stays])] = True
        for k in self.bare:
            before = int(np.searchsorted(text.vertex_at, k))
            numbers = [int(w.partition(b"/")[0]) for w in arguments(text.statements[k])]
            self.kept[[n - 1 if n > 0 else before + n for n in numbers]] = True
        self.kept_before = np.concatenate([[0], np.cumsum(self.kept)])
        self.number = self.kept_before[1:] - 1
        self.gone_at = set(text.vertex_at[~self.kept].tolist())

    def _lines(self) -> Iterator[bytes]:
        force: Group = ("", "")
        idle = self._idle_group_lines()
        for k, statement in enumerate(self.text.statements):
            word = self.words[k]
            if word in (b"o", b"g"):
                if k not in idle:
                    force = (name_in(statement), "") if word == b"o" else (force[0], name_in(statement))
                    yield statement
            elif k in self.stays:
                if self.stays[k]:
                    yield from self._group_lines(force, self.wanted[k])
                    force = self.wanted[k]
                    yield self._renumber(k)
            elif k in self.bare:
                yield self._renumber(k)
            elif k not in self.gone_at:
                yield statement

    def _idle_group_lines(self) -> set[int]:
        """The group lines that no face needs any more: those below them have gone, or are named otherwise."""
        faces = {b"o": 0, b"g": 0}  # face statements between here and the next line of that kind
        needed = {b"o": 0, b"g": 0}  # those of them that stay as they are named
        authored = {at: self.text.groups[g] for at, g in zip(self.text.face_at, self.text.face_group, strict=True)}
        idle: set[int] = set()
        for k in reversed(range(len(self.words))):
            word = self.words[k]
            if k in self.stays:
                for kind in faces:
                    faces[kind] += 1
                    needed[kind] += self.stays[k] and self.wanted[k] == authored[k]
            elif word in faces:
                if faces[word] and not needed[word]:
                    idle.add(k)
                for kind in (b"g", b"o") if word == b"o" else (b"g",):
                    faces[kind] = needed[kind] = 0
        return idle

    def _group_lines(self, force: Group, wanted: Group) -> Iterator[bytes]:
        """What leads from the group in force to the wanted one."""
        if force[0] != wanted[0]:
            yield named(b"o", wanted[0]) + self.end
            force = (wanted[0], "")
        if force[1] != wanted[1]:
            yield named(b"g", wanted[1]) + self.end

    def _renumber(self, k: int) -> bytes:
        """A statement of an element with the new numbers of its vertices; relative numbers stay relative."""
        if not self.gone_at:
            return self.text.statements[k]
        statement, hash_mark, comment = self.text.statements[k].partition(b"#")
        before = int(np.searchsorted(self.text.vertex_at, k))
        now = int(self.kept_before[before])

        def renumber(match: re.Match[bytes]) -> bytes:
            old = int(match[2])
            if old < 0:
                return match[1] + str(int(self.number[before + old]) - now).encode()
            return match[1] + str(int(self.number[old - 1]) + 1).encode()

        return _NUMBER.sub(renumber, statement) + hash_mark + comment
