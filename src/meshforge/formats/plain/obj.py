"""Wavefront OBJ: each connected convex piece of a group is a hull, or each group that is named so for Unreal."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from meshforge.asset import Asset, Feature, Geom, What
from meshforge.formats.meshfile import Soup
from meshforge.formats.meshfile.obj import parse_obj
from meshforge.formats.naming.marks import unreal_kind
from meshforge.formats.naming.unreal_shapes import unreal_shape
from meshforge.formats.plain.marked import HOW, marked_soup, next_names
from meshforge.formats.plain.obj_edit import edited_obj
from meshforge.formats.plain.obj_text import parts_text
from meshforge.formats.plain.parts import Part, PlainDocument
from meshforge.formats.plain.plain import Edit, PlainFormat
from meshforge.geometry import Piece, Shape

_MATERIAL = re.compile(rb"^[ \t]*usemtl[ \t]+([^\r\n]+)", re.M)
_COORDINATE = re.compile(rb"^[ \t]*vt[ \t]", re.M)
_COLOR = re.compile(rb"^[ \t]*v(?:[ \t]+[^\s#]+){6}", re.M)
_COMMENT = re.compile(rb"^[ \t]*#", re.M)
_OTHER = re.compile(rb"^[ \t]*([lp])[ \t]", re.M)
_KINDS = {b"l": "line", b"p": "point"}


class Obj(PlainFormat):
    """OBJ files."""

    name = "obj"
    title = "OBJ"
    holds = frozenset({What.NAMES, What.OPAQUE})
    could = frozenset({What.MATERIALS, What.TEXTURES, What.TEXTURE_COORDINATES, What.VERTEX_COLORS, What.COMMENTS})
    suffixes = (".obj",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        text = parse_obj(data, str(path))
        return marked_soup(text, text.soup(str(path)))

    def interpret_hulls(self, document: PlainDocument, found: Sequence[Piece]) -> tuple[dict[str, Shape], tuple[str, ...]]:
        shapes, _ = super().interpret_hulls(document, found)
        if not document.marked:
            return shapes, ()
        meant = {name: unreal_shape(name, hull) for name, hull in shapes.items()}
        notes = (HOW, *(note for _, note in meant.values() if note))
        return {name: shape for name, (shape, _) in meant.items()}, notes

    def name_hulls(self, document: PlainDocument, geoms: Sequence[Geom]) -> list[str]:
        return next_names(parse_obj(document.data, ""), geoms) if document.marked else super().name_hulls(document, geoms)

    def apply_edit(self, edit: Edit) -> bytes:
        return edited_obj(parse_obj(edit.document.data, str(edit.path)), edit)

    def format_parts(self, parts: Sequence[Part]) -> bytes:
        return parts_text([replace(part, name="_" * bool(unreal_kind(part.name)) + part.name) for part in parts])

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, PlainDocument):
            data = asset.document.data
            materials = dict.fromkeys(name.decode("utf-8", "replace").strip() for name in _MATERIAL.findall(data))
            yield Feature(What.MATERIALS, tuple(materials))
            yield Feature(What.TEXTURE_COORDINATES, unnamed=len(_COORDINATE.findall(data)))
            yield Feature(What.VERTEX_COLORS, unnamed=1 if _COLOR.search(data) else 0)
            others = _OTHER.findall(data)
            kinds = tuple(_KINDS[word] for word in dict.fromkeys(others))
            yield Feature(What.OTHERS, kinds, len(others) - len(kinds))
            yield Feature(What.COMMENTS, unnamed=len(_COMMENT.findall(data)))
