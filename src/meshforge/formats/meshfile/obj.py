"""Reading Wavefront OBJ: vertices, faces and groups, each with its statement, so that edits keep the text."""

from __future__ import annotations

import codecs
import itertools
import re
from dataclasses import dataclass

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile.obj_rows import keywords, plain_faces, plain_vertices
from meshforge.formats.meshfile.surface import RawSurface, Soup, checked, is_number, remedy_for, text_of
from meshforge.geometry import Floats, Ints

Group = tuple[str, str]
"""The object (`o`) and the group (`g`) that a face is in; an empty text where there is none."""
_STATEMENTS = frozenset((b"v", b"vn", b"vt", b"vp", b"f", b"fo", b"l", b"p", b"o", b"g", b"s", b"mtllib", b"usemtl"))
_SHOWN = 60  # characters of a statement in a message


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
    groups: tuple[Group, ...]

    def soup(self, where: str) -> Soup:
        """All triangles in file order. Raises AssetError: there is none, or a coordinate is not finite."""
        checked([RawSurface(None, self.vertices, self.faces)], where)
        named = tuple(group_names(self.groups))
        within = tuple(g if o and g and o == name != g else "" for (o, g), name in zip(self.groups, named, strict=True))
        spoken = ("group", self.face_group, within), ("material", *self._materials())
        return Soup(self.vertices, self.faces, self.face_group, named, spoken)

    def _materials(self) -> tuple[Ints, tuple[str, ...]]:
        """The material (m,) of each triangle, and the names of all; the first has none."""
        marks = [k for k, statement in enumerate(self.statements) if statement.lstrip()[:6] == b"usemtl"]
        names = [text_of(self.statements[k].strip()[6:].strip()) for k in marks]
        return np.searchsorted(np.array(marks, dtype=np.int64), self.face_at), ("", *names)

    def surfaces(self, where: str) -> list[RawSurface]:
        """A surface for each group that has faces; they share the vertices of the file. Raises AssetError."""
        names = group_names(self.groups)
        parts = [RawSurface(names[k], self.vertices, self.faces[self.face_group == k]) for k in range(len(names))]
        return checked(parts, where)


def statements_of(data: bytes) -> list[bytes]:
    """The statements of an OBJ file, line ends included, without a byte order mark."""
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


def group_names(groups: tuple[Group, ...]) -> list[str | None]:
    """The name of each group: its object where that holds one group only, else object and group."""
    objects = [o for o, _ in groups]
    names: list[str | None] = []
    for o, g in groups:
        if o and g:
            names.append(o if objects.count(o) == 1 else f"{o}/{g}")
        else:
            names.append(o or g or None)
    return names


def parse_obj(data: bytes, where: str) -> ObjText:
    """An OBJ file taken apart. Raises AssetError with file and line: a statement that cannot be read."""
    statements = statements_of(data)
    words = keywords(statements)
    _refuse_others(statements, words, where)
    vertex_at = np.array([k for k, word in enumerate(words) if word == b"v"], dtype=np.int64)
    vertices = _vertices(statements, vertex_at, where)
    face_at, faces = _faces(statements, words, vertex_at, where)
    groups, used = _groups(statements, words, face_at)
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


def line_of(statements: tuple[bytes, ...] | list[bytes], index: int) -> int:
    """The line on which a statement starts, from 1."""
    return 1 + sum(s.count(b"\n") or s.count(b"\r") for s in statements[:index])


def arguments(statement: bytes) -> list[bytes]:
    """The words after the keyword, without a comment at the end."""
    if b"\\" in statement:
        statement = re.sub(rb"\\\r?\n?", b" ", statement)
    return statement.split(b"#", 1)[0].split()[1:]


def _refuse_others(statements: list[bytes], words: list[bytes], where: str) -> None:
    """Raise AssetError where no statement of a file is one of OBJ."""
    first = next((k for k, word in enumerate(words) if word and word[:1] != b"#"), None)
    if first is None:
        raise AssetError("the file holds no statement", where=where)
    if _STATEMENTS.isdisjoint(words):
        raise _error(f"this is no OBJ file: it begins with {_quoted(statements[first])}", statements, first, where)


def _vertices(statements: list[bytes], at: Ints, where: str) -> Floats:
    plain = plain_vertices([statements[k] for k in at.tolist()])
    if plain is not None:
        return plain
    rows = [arguments(statements[k])[:3] for k in at]
    try:
        if any(b"_" in word for row in rows for word in row):  # Python's own digit separators, which no one else reads
            raise ValueError
        return np.array([[float(x) for x in row] for row in rows], dtype=np.float64).reshape(len(rows), 3)
    except ValueError:
        k = next(int(k) for k, row in zip(at, rows, strict=True) if len(row) < 3 or not all(map(is_number, row)))
        problem = f"a vertex needs three numbers, here is {_quoted(statements[k])}"
        raise _error(problem, statements, k, where, remedy_for(arguments(statements[k]))) from None


def _faces(statements: list[bytes], words: list[bytes], vertex_at: Ints, where: str) -> tuple[Ints, Ints]:
    """The statement of each triangle, and the triangles (m, 3)."""
    rows = np.array([k for k, word in enumerate(words) if word in (b"f", b"fo")], dtype=np.int64)
    ahead = np.searchsorted(vertex_at, rows)
    plain = plain_faces([statements[k] for k in rows.tolist()], ahead, len(vertex_at))
    if plain is not None:
        return rows[plain[0]], plain[1]
    at: list[int] = []
    triangles: list[tuple[int, int, int]] = []
    for k, before in zip(rows.tolist(), ahead.tolist(), strict=True):
        try:
            if b"_" in statements[k]:
                raise ValueError
            corners = [int(w.partition(b"/")[0]) for w in arguments(statements[k])]
        except ValueError:
            problem = f"a face needs vertex numbers, here is {_quoted(statements[k])}"
            raise _error(problem, statements, k, where) from None
        indices = [c - 1 if c > 0 else before + c for c in corners]
        for corner, index in zip(corners, indices, strict=True):
            if corner == 0 or not 0 <= index < len(vertex_at):
                there = f"the file has {len(vertex_at)}" if corner >= 0 else f"{before} lie ahead of it"
                problem = f"a face names vertex {corner}, {there}"
                raise _error(problem, statements, k, where)
        for second, third in itertools.pairwise(indices[1:]):
            at.append(k)
            triangles.append((indices[0], second, third))
    return np.array(at, dtype=np.int64), np.array(triangles, dtype=np.int64).reshape(-1, 3)


def _groups(statements: list[bytes], words: list[bytes], at: Ints) -> tuple[list[Group], Ints]:
    """All groups in order of appearance, and the group in force at each of some statements (n,)."""
    known: dict[Group, int] = {("", ""): 0}
    current: Group = ("", "")
    lines, in_force = [-1], [0]
    for k, word in enumerate(words):
        if word in (b"o", b"g"):
            current = (name_in(statements[k]), "") if word == b"o" else (current[0], name_in(statements[k]))
            lines.append(k)
            in_force.append(known.setdefault(current, len(known)))
    return list(known), np.array(in_force)[np.searchsorted(lines, at) - 1]


def name_in(statement: bytes) -> str:
    """The name that an `o` or `g` statement gives: all after the keyword, spaces within included."""
    rest = statement.strip()[1:].strip()
    return text_of(rest)


def _quoted(statement: bytes) -> str:
    """A statement as messages show it, of a long one the beginning."""
    text = text_of(statement.strip())
    return repr(text if len(text) <= _SHOWN else f"{text[:_SHOWN]}...")


def _error(problem: str, statements: list[bytes], index: int, where: str, remedy: str | None = None) -> AssetError:
    return AssetError(problem, where=f"{where}:{line_of(statements, index)}", remedy=remedy)
