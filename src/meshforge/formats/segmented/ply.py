"""Segmented PLY files: a whole number each vertex or each face."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile.ply import PlyText, Rows, parse_ply
from meshforge.formats.segmented.classes import in_comments
from meshforge.formats.segmented.segmented import Segmented, checked, rank_of, whole_numbers
from meshforge.formats.triangles import contents


def read_ply(path: Path) -> Segmented:
    """The points or faces of a PLY file with their classes; those of faces count where both have some.

    Raises AssetError: damaged, or nothing in it is a class by its name.
    """
    where, data = str(path), contents(path)
    text = parse_ply(data, where)
    names = in_comments(data[: text.header.size].decode("utf-8", "replace").splitlines())
    own = [rows for kind in ("face", "vertex") for rows in text.rows if rows.element.name == kind]
    found = [(rows, key) for rows in own if (key := _property(rows))]
    if not found:
        raise _without_classes(text, where)
    rows, key = next((pair for pair in found if pair[0].element.rows), found[0])
    classes = whole_numbers(rows.values[key], where)
    if rows.element.name == "face":
        return checked(Segmented(classes[text.face_at], text.vertices, text.faces, names, of_faces=True), where)
    return checked(Segmented(classes, text.vertices, text.faces, names), where)


def _property(rows: Rows) -> str | None:
    """The property that is most plainly one of classes."""
    ranks = [(rank, p.name) for p in rows.element.properties if not p.count and (rank := rank_of(p.name)) is not None]
    return min(ranks)[1] if ranks else None


def _without_classes(text: PlyText, where: str) -> AssetError:
    known = [p.name for rows in text.rows for p in rows.element.properties if not p.count and p.name not in "xyz"]
    holds = f"it has {', '.join(np.unique(known))}" if known else "it has none but coordinates"
    remedy = "Export the class of each point or face as a number, called `label`; colours are not read."
    return AssetError(f"no property of this file is a class by its name: {holds}", where=where, remedy=remedy)
