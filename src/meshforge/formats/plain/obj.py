"""Wavefront OBJ: each connected convex piece of a group is a hull; edits change vertex numbers and group lines only."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.base import ReadOptions, feature_of_others
from meshforge.formats.engine_names import unreal_kind
from meshforge.formats.meshfile.obj import ObjGroup, ObjText, arguments, group_name_of, keywords, parse_obj
from meshforge.formats.meshfile.surface import Soup
from meshforge.formats.plain.base import MeshFileEdit, PlainFormat
from meshforge.formats.plain.parts import MeshPart, PlainDocument
from meshforge.geometry import Floats, Ints
from meshforge.symbolic import Asset, Feature, FeatureKind, FileNote

_MATERIAL = re.compile(rb"^[ \t]*usemtl[ \t]+([^\r\n]+)", re.M)
_OTHERS = {
    "texture coordinate": re.compile(rb"^[ \t]*vt[ \t]", re.M),
    "vertex colour": re.compile(rb"^[ \t]*v(?:[ \t]+[^\s#]+){6}", re.M),
    "line": re.compile(rb"^[ \t]*l[ \t]", re.M),
    "point": re.compile(rb"^[ \t]*p[ \t]", re.M),
    "comment": re.compile(rb"^[ \t]*#", re.M),
}
_MARKS = FileNote(
    "its groups with names for Unreal (UCX_ and the like) are read as all others: such names count in glTF"
)
_NUMBER = re.compile(rb"(\s)([+-]?\d+)")
_FACES = (b"f", b"fo")
_STROKES = (b"l", b"p")
_FREE_FORM = (b"curv", b"curv2", b"surf", b"bzp", b"bsp", b"cdc", b"cdp")


class ObjFormat(PlainFormat):
    """OBJ files."""

    name = "obj"
    title = "OBJ"
    holds = frozenset({FeatureKind.NAMES, FeatureKind.NON_CONVEX})
    suffixes = (".obj",)

    def read(self, path: Path, options: ReadOptions) -> Asset:
        asset = super().read(path, options)
        assert isinstance(asset.document, PlainDocument)
        names = (name for group in parse_obj(asset.document.data, str(path)).groups for name in group)
        return replace(asset, notes=(_MARKS,)) if any(map(unreal_kind, names)) else asset

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        return parse_obj(data, str(path)).soup(str(path))

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        """Return the edited file. Raises AssetError: free-form surfaces, which also use the vertices."""
        return _ObjEditor(parse_obj(edit.document.data, str(edit.path)), edit).to_bytes()

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        return format_obj(parts)

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, PlainDocument):
            data = asset.document.data
            others = [f"material {name.decode('utf-8', 'replace').strip()}" for name in {*_MATERIAL.findall(data)}]
            others = [*sorted(others), *(kind for kind, found in _OTHERS.items() for _ in found.findall(data))]
            yield feature_of_others(others)


class _ObjEditor:
    def __init__(self, text: ObjText, edit: MeshFileEdit) -> None:
        self.text = text
        self.edit = edit
        self.words = keywords(text.statements)
        if any(word in _FREE_FORM for word in self.words):
            raise AssetError("files with free-form surfaces cannot be edited", where=str(edit.path))
        self.stays = dict(zip(text.face_at.tolist(), edit.stays.tolist(), strict=True))
        self.bare = {  # statements that name vertices and make no triangle, which stay
            k for k, word in enumerate(self.words) if word in _STROKES or (word in _FACES and k not in self.stays)
        }
        self.wanted = self._target_groups()
        first = text.statements[0] if text.statements else b"\n"
        self.end = first[len(first.rstrip(b"\r\n")) :] or b"\n"
        self._number_vertices()

    def to_bytes(self) -> bytes:
        body = b"".join(self._lines())
        if body and not body.endswith((b"\n", b"\r")):
            body += self.end
        if self.edit.parts and body.rstrip(b"\r\n").endswith(b"\\"):  # what follows would be of the last statement
            body += self.end
        width = len(arguments(self.text.statements[self.text.vertex_at[0]]))
        colors = width - 3 if width in (6, 7) else 0
        return body + format_obj(self.edit.parts, int(self.kept.sum()), self.end, colors)

    def _target_groups(self) -> dict[int, ObjGroup]:
        document, text = self.edit.document, self.text
        touched = set(text.face_group[~self.edit.stays].tolist())
        wanted: dict[int, ObjGroup] = {}
        for at, group, owner in zip(text.face_at.tolist(), text.face_group.tolist(), document.owners, strict=True):
            if self.stays[at]:
                wanted[at] = (owner, "") if self.edit.explicit or group in touched else text.groups[group]
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
        force: ObjGroup = ("", "")
        idle = self._idle_group_lines()
        for k, statement in enumerate(self.text.statements):
            word = self.words[k]
            if word in (b"o", b"g"):
                if k not in idle:
                    force = (group_name_of(statement), "") if word == b"o" else (force[0], group_name_of(statement))
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

    def _group_lines(self, force: ObjGroup, wanted: ObjGroup) -> Iterator[bytes]:
        if force[0] != wanted[0]:
            yield _format_group_line(b"o", wanted[0]) + self.end
            force = (wanted[0], "")
        if force[1] != wanted[1]:
            yield _format_group_line(b"g", wanted[1]) + self.end

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


def format_obj(parts: Sequence[MeshPart], start: int = 0, end: bytes = b"\n", colors: int = 0) -> bytes:
    """Return parts as text, an object each.

    start: the vertices ahead of them in the file; end: the line end; colors: values behind the coordinates of each
    vertex, where the file has colours there (some readers want them for all).
    """
    text: list[bytes] = []
    for part in parts:
        vertices, faces = part.surface.vertices, part.surface.faces
        text += [_format_group_line(b"o", part.name), end]
        text.append(format_obj_rows(vertices, faces + start, end, " 1.0" * colors))
        start += len(vertices)
    return b"".join(text)


def format_obj_rows(vertices: Floats, faces: Ints, end: bytes = b"\n", tail: str = "") -> bytes:
    """Return the statements of vertices (n, 3) in full precision and of triangles (m, 3), whose numbers count from 0.

    end: the line end; tail: what follows the coordinates of each vertex.
    """
    last = end.decode()
    corners = f"v %r %r %r{tail}{last}" * len(vertices) % tuple((vertices + 0.0).ravel().tolist())
    return (corners + f"f %d %d %d{last}" * len(faces) % tuple((faces + 1).ravel().tolist())).encode()


def _format_group_line(word: bytes, name: str) -> bytes:
    """An `o` or `g` statement without its line end; a line break in the name becomes a blank, a last backslash goes."""
    clean = re.sub(r"[\r\n]+", " ", name).rstrip("\\")
    return word + b" " + clean.encode("utf-8", "surrogateescape")
