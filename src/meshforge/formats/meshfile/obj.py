"""Read Wavefront OBJ: vertices, faces and groups, each with its statement, so that edits keep the text. Statements are
read many at once; those with comments, joined lines or several lengths are made plain first."""

import codecs
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.meshfile import surface
from meshforge.geometry import Floats, Ints

ObjGroup = tuple[str, str]
"""The object (`o`) and the group (`g`) that a face is in; an empty text where there is none."""
_STATEMENTS = frozenset((b"v", b"vn", b"vt", b"vp", b"f", b"fo", b"l", b"p", b"o", b"g", b"s", b"mtllib", b"usemtl"))
_MOST_REMEMBERED = 1 << 20  # bytes of a file that is remembered
_SHOWN = 60  # characters of a statement in a message

_UNUSUAL = (b"#", b"\\", b"_", b" /", b"\t/", b"\x0b/", b"\x0c/")
_BEHIND = re.compile(rb"/\S*")  # texture and normal numbers behind a vertex number
_QUICK = {word + blank: word for word in (b"v", b"f", b"vn", b"vt") for blank in (b" ", b"\t")}


@dataclass(frozen=True, eq=False, slots=True)
class ObjText:
    """An OBJ file taken apart.

    statements: the file, cut into statements (a line, or lines joined by backslashes), nothing left out.
    vertices: (n, 3); vertex_at: (n,) the statement of each. faces: (m, 3) triangles, polygons cut into fans;
    face_at: (m,) the statement of each triangle; face_group: (m,) into `groups`, in order of appearance.
    """

    statements: tuple[bytes, ...]
    vertices: Floats
    vertex_at: Ints
    faces: Ints
    face_at: Ints
    face_group: Ints
    groups: tuple[ObjGroup, ...]

    def soup(self, where: str) -> surface.Soup:
        """Return all triangles in file order. Raises AssetError: there is none, or a coordinate is not finite."""
        surface.check_surfaces([surface.RawSurface(None, self.vertices, self.faces)], where)
        named = tuple(group_names(self.groups))
        within = tuple(g if o and g and o == name != g else "" for (o, g), name in zip(self.groups, named, strict=True))
        mentions = ("group", self.face_group, within), ("material", *self.materials())
        return surface.Soup(self.vertices, self.faces, self.face_group, named, mentions)

    def materials(self) -> tuple[Ints, tuple[str, ...]]:
        """Return the material (m,) of each triangle, and the names of all; the first has none."""
        marks = [k for k, statement in enumerate(self.statements) if statement.lstrip()[:6] == b"usemtl"]
        names = [surface.text_of(self.statements[k].strip()[6:].strip()) for k in marks]
        return np.searchsorted(np.array(marks, dtype=np.int64), self.face_at), ("", *names)

    def surfaces(self, where: str) -> list[surface.RawSurface]:
        """Return a surface for each group that has faces; they share the vertices of the file. Raises AssetError."""
        names = group_names(self.groups)
        own = (self.faces[self.face_group == k] for k in range(len(names)))
        return surface.check_surfaces(
            [surface.RawSurface(name, self.vertices, faces) for name, faces in zip(names, own, strict=True)], where
        )


def statements_of(data: bytes) -> list[bytes]:
    """Return the statements of an OBJ file, line ends included, without a byte order mark."""
    lines = data.removeprefix(codecs.BOM_UTF8).splitlines(keepends=True)
    if b"\\\n" not in data and b"\\\r" not in data:
        return lines
    joined: list[bytes] = []
    open_line = False
    for line in lines:
        if open_line:
            joined[-1] += line
        else:
            joined.append(line)
        open_line = line.rstrip(b"\r\n").endswith(b"\\") and not joined[-1].lstrip().startswith(b"#")
    return joined


def group_names(groups: tuple[ObjGroup, ...]) -> list[str | None]:
    """Return the name of each group: its object where that holds one group only, else object and group."""
    objects = [o for o, _ in groups]
    names: list[str | None] = []
    for o, g in groups:
        if o and g:
            names.append(o if objects.count(o) == 1 else f"{o}/{g}")
        else:
            names.append(o or g or None)
    return names


def parse_obj(data: bytes, where: str) -> ObjText:
    """Return an OBJ file taken apart. Raises AssetError with file and line: a statement that cannot be read."""
    return _parse_remembered(data, where) if len(data) <= _MOST_REMEMBERED else _parse(data, where)


@lru_cache(maxsize=2)
def _parse_remembered(data: bytes, where: str) -> ObjText:
    """The file last read and the one last written: an edit takes each apart several times."""
    text = _parse(data, where)
    for array in (text.vertices, text.vertex_at, text.faces, text.face_at, text.face_group):
        array.setflags(write=False)
    return text


def _parse(data: bytes, where: str) -> ObjText:
    statements = statements_of(data)
    words = keywords(statements)
    _refuse_others(statements, words, where)
    vertex_at = np.array([k for k, word in enumerate(words) if word == b"v"], dtype=np.int64)
    vertices = _parse_vertices(statements, vertex_at, where)
    face_at, faces = _parse_faces(statements, words, vertex_at, where)
    groups, used = _parse_groups(statements, words, face_at)
    kept, first, face_group = np.unique(used, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.argsort(order)
    return ObjText(
        tuple(statements),
        vertices,
        vertex_at,
        faces,
        face_at,
        rank[face_group.reshape(-1)],
        tuple(groups[int(kept[k])] for k in order),
    )


def arguments(statement: bytes) -> list[bytes]:
    """Return the words after the keyword, without a comment at the end."""
    if b"\\" in statement:
        statement = re.sub(rb"\\\r?\n?", b" ", statement)
    return statement.split(b"#", 1)[0].split()[1:]


def _refuse_others(statements: list[bytes], words: list[bytes], where: str) -> None:
    first = next((k for k, word in enumerate(words) if word and word[:1] != b"#"), None)
    if first is None:
        raise AssetError("the file holds no statement", where=where)
    if _STATEMENTS.isdisjoint(words):
        raise _error_at(f"this is no OBJ file: it begins with {_quote(statements[first])}", statements, first, where)


def _parse_vertices(statements: list[bytes], at: Ints, where: str) -> Floats:
    rows = [statements[k] for k in at.tolist()]
    found = _plain_vertices(rows)
    if found is None:
        found = _plain_vertices([b"v " + b" ".join(arguments(row)[:3]) + b"\n" for row in rows])
    if found is not None:
        return found
    words = (arguments(row)[:3] for row in rows)
    k = next(int(k) for k, row in zip(at, words, strict=True) if len(row) < 3 or not all(map(surface.is_number, row)))
    problem = f"a vertex needs three numbers, here is {_quote(statements[k])}"
    raise _error_at(problem, statements, k, where, surface.remedy_for(arguments(statements[k])))


def _parse_faces(statements: list[bytes], words: list[bytes], vertex_at: Ints, where: str) -> tuple[Ints, Ints]:
    at = np.array([k for k, word in enumerate(words) if word in (b"f", b"fo")], dtype=np.int64)
    rows, ahead = [statements[k] for k in at.tolist()], np.searchsorted(vertex_at, at)
    found = _plain_faces(rows, ahead, len(vertex_at))
    if found is None:
        corners = ([word.partition(b"/")[0] or b"?" for word in arguments(row)] for row in rows)
        found = _plain_faces([b"f " + b" ".join(row) + b"\n" for row in corners], ahead, len(vertex_at))
    if found is not None:
        return at[found[0]], found[1]
    for k, before in zip(at.tolist(), ahead.tolist(), strict=True):
        _check_face(statements, k, before, len(vertex_at), where)
    raise AssertionError("one of the faces is odd")


def _check_face(statements: list[bytes], k: int, before: int, total: int, where: str) -> None:
    """Raise AssetError where a face has a corner that is no number, or names a vertex that is not there."""
    words = [word.partition(b"/")[0] for word in arguments(statements[k])]
    try:
        if any(b"_" in word for word in words):  # digit separators of Python, which no one else reads
            raise ValueError
        corners = list(map(int, words))
    except ValueError:
        problem = f"a face needs vertex numbers, here is {_quote(statements[k])}"
        raise _error_at(problem, statements, k, where) from None
    for corner in corners:
        if corner == 0 or not 0 <= (corner - 1 if corner > 0 else before + corner) < total:
            there = f"the file has {total}" if corner >= 0 else f"{before} lie ahead of it"
            raise _error_at(f"a face names vertex {corner}, {there}", statements, k, where)


def _parse_groups(statements: list[bytes], words: list[bytes], at: Ints) -> tuple[list[ObjGroup], Ints]:
    """All groups in order of appearance, and the group in force at each of some statements (n,)."""
    known: dict[ObjGroup, int] = {("", ""): 0}
    current: ObjGroup = ("", "")
    lines, in_force = [-1], [0]
    for k, word in enumerate(words):
        if word in (b"o", b"g"):
            current = (group_name_of(statements[k]), "") if word == b"o" else (current[0], group_name_of(statements[k]))
            lines.append(k)
            in_force.append(known.setdefault(current, len(known)))
    return list(known), np.array(in_force)[np.searchsorted(lines, at) - 1]


def group_name_of(statement: bytes) -> str:
    """Return the name that an `o` or `g` statement gives: all after the keyword, spaces within included."""
    return surface.text_of(statement.strip()[1:].strip())


def _quote(statement: bytes) -> str:
    text = surface.text_of(statement.strip())
    return repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}...")


def _error_at(problem: str, statements: list[bytes], index: int, where: str, remedy: str | None = None) -> AssetError:
    line = 1 + sum(s.count(b"\n") or s.count(b"\r") for s in statements[:index])
    return AssetError(problem, where=f"{where}:{line}", remedy=remedy)


def keywords(statements: Sequence[bytes]) -> list[bytes]:
    """Return the first word of each statement, none where it is empty."""
    return [_QUICK.get(s[:2]) or _QUICK.get(s[:3]) or keyword(s) for s in statements]


def keyword(statement: bytes) -> bytes:
    """Return the first word of a statement, none where it is empty."""
    words = statement.split(None, 1)
    return words[0] if words else b""


def _plain_vertices(rows: Sequence[bytes]) -> Floats | None:
    """The vertices (n, 3) of `v` statements; None where these are not plain, or not of the same length."""
    if not rows:
        return np.zeros((0, 3))
    text = b"".join(rows)
    if any(mark in text for mark in _UNUSUAL):
        return None
    words = text.split()
    width = len(words) // len(rows)
    if len(words) != width * len(rows) or (width < 4 or not _is_only_at_starts(words, b"v", width)):
        return None
    try:
        return np.column_stack([np.array(list(map(float, words[k::width]))) for k in (1, 2, 3)])
    except ValueError:
        return None


def _plain_faces(rows: Sequence[bytes], before: Ints, total: int) -> tuple[Ints, Ints] | None:
    """The statement (m,) of each triangle of `f` statements, and the triangles (m, 3), polygons cut into fans.

    before: (n,) the vertices ahead of each statement, from which negative numbers count; total: those of the file.
    None where the statements are not plain, or name a vertex that is not there.
    """
    text = b"".join(rows)
    if any(mark in text for mark in _UNUSUAL):
        return None
    words = (_BEHIND.sub(b"", text) if b"/" in text else text).split()
    width = len(words) // max(len(rows), 1)
    if rows and len(words) == width * len(rows) and _is_only_at_starts(words, b"f", width):
        del words[::width]
        counts = np.full(len(rows), width - 1)
    else:
        words = [word for word in words if word != b"f"]
        counts = np.array([len(row.split()) - 1 for row in rows], dtype=np.int64)
    try:
        corners = np.array(list(map(int, words)), dtype=np.int64)
    except (ValueError, OverflowError):
        return None
    if counts.sum() != len(corners):
        return None
    corners = np.where(corners > 0, corners - 1, np.where(corners < 0, corners + np.repeat(before, counts), -1))
    if corners.min(initial=0) < 0 or corners.max(initial=-1) >= total:
        return None
    return surface.cut_fans(corners, counts)


def _is_only_at_starts(words: list[bytes], word: bytes, width: int) -> bool:
    """Whether a word is every width-th one of others, and none besides."""
    return words[::width].count(word) == len(words) // width == words.count(word)
