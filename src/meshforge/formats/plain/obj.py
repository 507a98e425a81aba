"""Wavefront OBJ, and OBJ for Unreal: each connected convex piece of a group is a hull, or, where names mark
collision for Unreal, each group that is marked."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path, PurePosixPath
from typing import ClassVar

import numpy as np

from meshforge.formats.base import Output, ReadOptions, feature_of_others
from meshforge.formats.engine_names import bodies, conventions
from meshforge.formats.engine_names.name_problems import find_name_problems
from meshforge.formats.meshfile.obj import ObjText, parse_obj
from meshforge.formats.meshfile.surface import Soup
from meshforge.formats.plain.base import MeshFileEdit, PlainFormat
from meshforge.formats.plain.obj_text import edit_obj, format_obj
from meshforge.formats.plain.parts import VISUAL_ONLY, MeshPart, PlainDocument, TargetTriangles, corners_of
from meshforge.geometry import Piece, Shape
from meshforge.symbolic import Asset, Feature, FeatureKind, FileNote, Geom, Surface

_MATERIAL = re.compile(rb"^[ \t]*usemtl[ \t]+([^\r\n]+)", re.M)
_OTHERS = {
    "texture coordinate": re.compile(rb"^[ \t]*vt[ \t]", re.M),
    "vertex colour": re.compile(rb"^[ \t]*v(?:[ \t]+[^\s#]+){6}", re.M),
    "line": re.compile(rb"^[ \t]*l[ \t]", re.M),
    "point": re.compile(rb"^[ \t]*p[ \t]", re.M),
    "comment": re.compile(rb"^[ \t]*#", re.M),
}
_MARK = re.compile(rb"^[ \t]*[og][ \t]+U(?:CX|BX|SP|CP|XC|XB)", re.M | re.I)
_UNREAL = conventions.UnrealNames()
_SCALE = (
    "numbers are metres: Unreal's importers of OBJ take them for centimetres, so import it with a uniform scale of 100"
)

MARKED_NOTE = FileNote(
    "its collision is the groups that Unreal takes by their names, UCX_ and the like; the rest is only seen"
)


class ObjFormat(PlainFormat):
    """OBJ files."""

    name = "obj"
    title = "OBJ"
    holds = frozenset({FeatureKind.NAMES, FeatureKind.NON_CONVEX})
    suffixes = (".obj",)

    def parse_soup(self, data: bytes, path: Path) -> Soup:
        text = parse_obj(data, str(path))
        return regroup_by_marks(text, text.soup(str(path)))

    def interpret_hulls(
        self, document: PlainDocument, found: Sequence[Piece]
    ) -> tuple[dict[str, Shape], tuple[str, ...]]:
        shapes, _ = super().interpret_hulls(document, found)
        if not document.marked:
            return shapes, ()
        meanings = {name: conventions.interpret_unreal_shape(name, hull) for name, hull in shapes.items()}
        notes = (MARKED_NOTE, *(note for _, note in meanings.values() if note))
        return {name: shape for name, (shape, _) in meanings.items()}, notes

    def read(self, path: Path, options: ReadOptions) -> Asset:
        asset = super().read(path, options)
        if not isinstance(asset.document, PlainDocument) or not _MARK.search(asset.document.data):
            return asset
        groups = [[name for name in group if name] for group in parse_obj(asset.document.data, "").groups]
        marks = ("unreal", *(geom.name for geom in asset.geoms[:1])) if asset.document.marked else ()
        found = find_name_problems(groups, (), *marks)
        return replace(asset, name_problems=tuple(one for one in found if one.engine == "unreal" or one.is_hull))

    def name_hulls(self, document: PlainDocument, geoms: Sequence[Geom]) -> list[str]:
        if not document.marked:
            return super().name_hulls(document, geoms)
        return next_hull_names(parse_obj(document.data, ""), geoms)

    def apply_edit(self, edit: MeshFileEdit) -> bytes:
        return edit_obj(parse_obj(edit.document.data, str(edit.path)), edit)

    def format_parts(self, parts: Sequence[MeshPart]) -> bytes:
        return format_obj(
            [replace(part, name="_" * bool(conventions.unreal_kind(part.name)) + part.name) for part in parts]
        )

    def features(self, asset: Asset) -> Iterator[Feature]:
        if isinstance(asset.document, PlainDocument):
            data = asset.document.data
            others = [f"material {name.decode('utf-8', 'replace').strip()}" for name in {*_MATERIAL.findall(data)}]
            others = [*sorted(others), *(kind for kind, found in _OTHERS.items() for _ in found.findall(data))]
            yield feature_of_others(others)


class ObjForUnreal(ObjFormat):
    """OBJ files whose collision Unreal knows by name."""

    title = "OBJ for Unreal"
    engines = ("unreal",)
    up = "z"  # Interchange's translator of OBJ turns nothing, and Unreal is z-up
    holds = _UNREAL.holds - {FeatureKind.COLORS}
    instead: ClassVar[Mapping[FeatureKind, str]] = {
        **conventions.fallbacks_of(_UNREAL),
        FeatureKind.BODIES: "written as groups",
    }

    def can_write_back(self, asset: Asset) -> bool:
        return isinstance(asset.document, PlainDocument) and asset.document.marked and super().can_write_back(asset)

    def create(self, asset: Asset, name: str) -> Output:
        found = bodies.name_bodies(asset, _UNREAL, PurePosixPath(name).stem)
        seen = [MeshPart(family.name, surface) for family in found.each for surface in family.surfaces]
        made = {
            geom.name: MeshPart(_UNREAL.hull(family.name, geom, k, own), Surface(hull.vertices, hull.faces))
            for family in found.each
            for k, (geom, own) in enumerate(family.pieces)
            if isinstance(geom, Geom) and (hull := geom.shape.tessellate())
        }
        parts, hulls = [*seen, *made.values()], {part.name for part in made.values()}
        whose = [part.name if part.name in hulls else VISUAL_ONLY for part in parts for _ in part.surface.faces]
        data = format_obj(parts, words=(b"o", b"g"))
        read = self._check_output(data, Path(name), TargetTriangles(whose, corners_of(parts)), hulls, asset.path)
        named = {old: read.get(part.name, part.name) for old, part in made.items()}
        names = {old: now for old, now in named.items() if now != old}
        return Output(data, names=names, lost=found.lost, notes=(_SCALE, *found.notes))


def regroup_by_marks(text: ObjText, soup: Soup) -> Soup:
    """Return the triangles of a file with a group for each hull, and -1 for what is only seen; as they are without
    marks."""
    marks = [next((name for name in group if conventions.unreal_kind(name)), None) for group in text.groups]
    names = list(dict.fromkeys(name for name in marks if name is not None))
    if not names:
        return soup
    hull_of = np.array([names.index(name) if name is not None else -1 for name in marks], dtype=np.int64)
    return Soup(soup.vertices, soup.faces, hull_of[soup.group], tuple(names), soup.mentions, marked=True)


def next_hull_names(text: ObjText, geoms: Sequence[Geom]) -> list[str]:
    """Return the names of made hulls in a file with marks, each after the mesh that its parent stands for."""
    names = [name for group in text.groups for name in group if name]
    rendered = [name for name in names if not conventions.unreal_kind(name)]
    numbers: dict[str, Iterator[int]] = {}
    made: list[str] = []
    for geom in geoms:
        base = conventions.visible_mesh_of(geom.parent, rendered) if geom.parent else next(iter(rendered), "hull")
        if base not in numbers:
            numbers[base] = conventions.number_hulls(base, names)
        made.append(_UNREAL.hull(base, geom, next(numbers[base]), ""))
    return made
