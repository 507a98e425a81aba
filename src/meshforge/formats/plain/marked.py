"""An OBJ whose names mark collision for Unreal: which groups are hulls, and which are only seen."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshforge.asset import Geom
from meshforge.errors import GeometryError
from meshforge.formats.meshfile import Soup
from meshforge.formats.meshfile.obj import Group, ObjText
from meshforge.formats.naming.marks import render_name, unreal_kind
from meshforge.formats.naming.unreal import next_name
from meshforge.geometry import Ints, Piece, convex_hull

HOW = "its collision is the groups that Unreal takes by their names, UCX_ and the like; the rest is only seen"


def marking(groups: Sequence[Group]) -> list[str | None]:
    """For each group, the name by which Unreal takes it for a hull: its object's, or its own; None for others."""
    return [next((name for name in group if unreal_kind(name)), None) for group in groups]


def marked_soup(text: ObjText, soup: Soup) -> Soup:
    """The triangles of a file with a group for each hull, and -1 for what is only seen; as they are without marks."""
    marks = marking(text.groups)
    names = list(dict.fromkeys(name for name in marks if name is not None))
    if not names:
        return soup
    hull_of = np.array([names.index(name) if name is not None else -1 for name in marks], dtype=np.int64)
    return Soup(soup.vertices, soup.faces, hull_of[soup.group], tuple(names), soup.mentions, marked=True)


def marked_pieces(soup: Soup) -> list[Piece]:
    """The hulls of a file with marks: each the convex hull of its group, whatever that looks like, as Unreal has it."""
    return [_piece(soup, np.flatnonzero(soup.group == k), k) for k in range(len(soup.names))]


def next_names(text: ObjText, geoms: Sequence[Geom]) -> list[str]:
    """The names of made hulls in a file with marks, each after the mesh that its parent stands for."""
    names = [name for group in text.groups for name in group if name]
    rendered = [name for name in names if not unreal_kind(name)]
    made: list[str] = []
    for geom in geoms:
        base = render_name(geom.parent, rendered) if geom.parent else next(iter(rendered), "hull")
        made.append(next_name(geom, base, [*names, *made]))
    return made


def _piece(soup: Soup, own: Ints, group: int) -> Piece:
    used, numbers = np.unique(soup.faces[own], return_inverse=True)
    vertices, faces = soup.vertices[used], numbers.reshape(-1, 3)
    try:
        return Piece(convex_hull(vertices), None, vertices, faces, own, group)
    except GeometryError as error:
        return Piece(None, error.problem, vertices, faces, own, group)
