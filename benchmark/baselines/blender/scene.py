"""A mesh as a scene for Blender, and the objects that come back as a mesh of legal hulls, or why they are none."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError

from benchmark.baselines.blender.shapes import Body, Illegal
from meshforge.checks import check
from meshforge.common import first_validation_error
from meshforge.geometry import Shape
from meshforge.language import Template
from meshforge.symbolic import Hull, Label, SymbolicMesh

_MOST = 1000  # objects
_BODY = "body"


class _Object(BaseModel):
    """An object as it comes back; same: as it went in, but perhaps for what it says of itself."""

    model_config = ConfigDict(frozen=True)

    name: str
    label: str | None = None
    primitive: str | None = None
    same: bool = False
    vertices: tuple[tuple[float, float, float], ...] = ()
    faces: tuple[tuple[int, int, int], ...] = ()
    matrix: tuple[tuple[float, float, float, float], ...] = ()


def scene_of(mesh: SymbolicMesh, templates: Mapping[str, Template]) -> dict[str, Any]:
    """The scene, as of `objects.edit_scene`."""
    return {
        "hulls": [
            {"name": hull.name, "label": hull.label, "contacts": _contacts(mesh, place), **_mesh(hull.shape)}
            for place, hull in enumerate(mesh.hulls)
        ],
        "templates": {name: [_mesh(shape) for shape in one.shapes] for name, one in templates.items()},
    }


def mesh_of(objects: Iterable[Any], before: SymbolicMesh) -> tuple[SymbolicMesh, frozenset[str]]:
    """The mesh that objects are, and the hulls whose label a script said: others go by the name of a hull of before.

    Raises Illegal.
    """
    try:
        rows = [_Object.model_validate(one) for one in objects]
    except ValidationError as error:
        raise Illegal(f"an object cannot be read: {first_validation_error(error)}") from error
    if len(rows) > _MOST:
        raise Illegal(f"{len(rows)} objects, {_MOST} at most may be left")
    mesh = replace(before, hulls=tuple(_hulls(rows, before)))
    wrong = [found.message for found in check(mesh) if found.severity == "error"]
    if wrong:
        raise Illegal("; ".join(wrong))
    named = frozenset(r.name for r in rows if r.name not in before.index or before.hull_of(r.name).label != r.label)
    return mesh, named


def _contacts(mesh: SymbolicMesh, place: int) -> list[str]:
    return [mesh.hulls[other].name for other in sorted(mesh.neighbours(place))]


def _mesh(shape: Shape) -> dict[str, Any]:
    return {"vertices": shape.vertices.tolist(), "faces": shape.faces.tolist()}


def _hulls(rows: Iterable[_Object], before: SymbolicMesh) -> Iterator[Hull]:
    for row in rows:
        label = Label(row.label, 1.0, "edit") if row.label else None
        known = before.hull_of(row.name) if row.same and row.name in before.index else None
        if known and row.primitive is None:
            yield known if known.label == row.label else known.with_label(label)
        else:
            body = _body(row, known)
            yield Hull(row.name, before.hulls[0].body if before.hulls else _BODY, body.shape(row.primitive), label)


def _body(row: _Object, known: Hull | None) -> Body:
    if known:
        return Body(row.name, known.vertices, known.faces, np.eye(3), np.zeros(3))
    points = np.array(row.vertices, dtype=np.float64).reshape(-1, 3)
    faces = np.array(row.faces, dtype=np.int64).reshape(-1, 3)
    if len(row.matrix) != 4 or (len(faces) and not (faces.min() >= 0 and faces.max() < len(points))):
        raise Illegal(f"{row.name}: a mesh that cannot be")
    matrix = np.array(row.matrix)
    return Body(row.name, points, faces, matrix[:3, :3], matrix[:3, 3])
