"""Read Collada by pycollada: a surface for each geometry in each node, node transforms applied.

The tags `unit` and `up_axis` are not: PyBullet, MoveIt and yourdfpy ignore both, so descriptions scale the mesh
themselves. `RawSurface.unit` tells readers of formats whose engines obey it (Gazebo).
"""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np

from meshforge.common import AssetError, pluralize
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, stack_triangles
from meshforge.formats.xml import XmlText, blank_markup
from meshforge.geometry import Floats, Ints

_NOT_FINITE = re.compile(r"\b(nan|inf)", re.I)


def parse_dae(data: bytes, where: str) -> list[RawSurface]:
    """The surfaces of a Collada file. Raises AssetError: not such a file, or no scene in it."""
    import collada  # lazy: 0.1 s, only Collada needs it
    from collada.common import DaeBrokenRefError, DaeError, DaeUnsupportedError  # lazy: as collada

    data = blank_markup(XmlText.of(data).data)
    if b"<!ENTITY" in data or b"<!DOCTYPE" in data:
        raise AssetError("it declares XML entities, which are not read", where=where)
    try:
        with warnings.catch_warnings(), np.errstate(over="ignore", invalid="ignore"):
            warnings.simplefilter("ignore", PendingDeprecationWarning)  # pycollada counts on numpy.matrix
            document = collada.Collada(io.BytesIO(data), ignore=[DaeUnsupportedError, DaeBrokenRefError])
            unit = float(document.assetInfo.unitmeter or 1.0)
            nodes = document.scene.nodes if document.scene else []
            found = [s for node in nodes for s in _walk(node, np.eye(4), unit)]
            geometries = len(document.geometries)
    except RecursionError as error:
        raise AssetError("its nodes lie too deep in each other", where=where, remedy="Export it again.") from error
    except (DaeError, ValueError, TypeError, AttributeError, IndexError, KeyError, SyntaxError) as error:
        reason = " ".join(str(error).split())
        problem = f"this Collada file cannot be read: {reason}"
        raise AssetError(problem, where=where, remedy="Export it again.") from error
    if not found and geometries:
        problem = f"its scene shows no triangle of {pluralize(geometries, 'geometry', 'geometries')}"
        raise AssetError(problem, where=where)
    return check_surfaces(found, where)


def _walk(node: Any, world: Floats, unit: float) -> Iterator[RawSurface]:
    from collada.scene import GeometryNode, Node, NodeNode  # lazy: as collada

    if isinstance(node, NodeNode):
        node = node.node
    inside = world @ node.matrix
    for child in node.children:
        if isinstance(child, Node | NodeNode):
            yield from _walk(child, inside, unit)
        elif isinstance(child, GeometryNode):
            _refuse_numbers(child.geometry)
            for bound in child.objects("geometry", inside):
                yield from _read_surface(bound, node.name or node.id, unit)


def _refuse_numbers(geometry: Any) -> None:
    """Raise ValueError where a coordinate is not finite; pycollada would take it for zero."""
    for inputs in geometry.xmlnode.iterfind(".//{*}vertices/{*}input[@semantic='POSITION']"):
        identifier = inputs.get("source", "").lstrip("#")
        for source in geometry.xmlnode.iterfind(f".//{{*}}source[@id='{identifier}']/{{*}}float_array"):
            if _NOT_FINITE.search(source.text or ""):
                raise ValueError(f"a coordinate of geometry {geometry.id!r} is not a finite number")


def _read_surface(bound: Any, name: str | None, unit: float) -> Iterator[RawSurface]:
    """The surface of a geometry; its sets of triangles, one a material, are joined."""
    parts: list[tuple[Floats, Ints]] = []
    for part in bound.primitives():
        counts = getattr(part.original, "vcounts", None)
        if counts is not None and int(np.sum(counts)) != len(part.index):
            raise ValueError(f"its polygons have {int(np.sum(counts))} corners, listed are {len(part.index)}")
        triangles = part.triangleset() if hasattr(part, "triangleset") else part
        if not hasattr(triangles, "vertex_index") or np.ndim(triangles.vertex_index) != 2 or not len(triangles):
            continue
        if triangles.vertex_index.shape[1] == 3:
            faces = np.asarray(triangles.vertex_index, dtype=np.int64)
            parts.append((np.asarray(triangles.vertex, dtype=np.float64), faces))
    if parts:
        yield RawSurface(name, *stack_triangles(parts), unit)
