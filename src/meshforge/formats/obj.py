"""Wavefront OBJ: each connected convex piece of a group is a hull; names live in `o` lines."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.formats.meshfile import Soup
from meshforge.formats.meshfile.obj import parse_obj
from meshforge.formats.obj_edit import edited_obj
from meshforge.formats.obj_text import parts_text
from meshforge.formats.parts import Part
from meshforge.formats.plain import Edit, PlainFormat


class Obj(PlainFormat):
    """OBJ files."""

    name = "obj"
    suffixes = (".obj",)

    def soup(self, data: bytes, path: Path) -> Soup:
        return parse_obj(data, str(path)).soup(str(path))

    def edited(self, edit: Edit) -> bytes:
        return edited_obj(parse_obj(edit.document.data, str(edit.path)), edit)

    def made(self, parts: Sequence[Part]) -> bytes:
        return parts_text(parts)
