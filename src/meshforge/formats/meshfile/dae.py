"""Read Collada by pycollada: a surface for each geometry in each node, node transforms applied.

The tags `unit` and `up_axis` are not: PyBullet, MoveIt and yourdfpy ignore both, so descriptions scale the mesh
themselves. `RawSurface.unit` tells readers of formats whose engines obey it (Gazebo).
"""

import io
import re
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from meshforge.common import AssetError, pluralize
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, stack_triangles
from meshforge.formats.xml import XmlText, blank_markup
from meshforge.geometry import Floats

_NOT_FINITE = re.compile(r"\b(nan|inf)", re.I)


def parse_dae(data: bytes, where: str) -> list[RawSurface]:
    """Return the surfaces of a Collada file. Raises AssetError: not such a file, or no scene in it."""
    with _report_damage(where):
        document = _open_document(data, where)
        unit, roots = float(document.assetInfo.unitmeter or 1.0), document.scene.nodes if document.scene else []
        placed = (one for node in roots for one in _list_geometries(node, np.eye(4)))
        found = [surface for bound, name in placed for surface in _read_surface(bound, name, unit)]
    if not found and document.geometries:
        problem = f"its scene shows no triangle of {pluralize(len(document.geometries), 'geometry', 'geometries')}"
        raise AssetError(problem, where=where)
    return check_surfaces(found, where)


def _open_document(data: bytes, where: str) -> Any:
    import collada  # lazy: 0.1 s, only Collada needs it
    from collada.common import DaeBrokenRefError, DaeUnsupportedError  # lazy: as collada

    data = blank_markup(XmlText.of(data).data)
    if b"<!ENTITY" in data or b"<!DOCTYPE" in data:
        raise AssetError("it declares XML entities, which are not read", where=where)
    return collada.Collada(io.BytesIO(data), ignore=[DaeUnsupportedError, DaeBrokenRefError])


@contextmanager
def _report_damage(where: str) -> Iterator[None]:
    from collada.common import DaeError  # lazy: as collada

    try:
        with warnings.catch_warnings(), np.errstate(over="ignore", invalid="ignore"):
            warnings.simplefilter("ignore", PendingDeprecationWarning)  # pycollada counts on numpy.matrix
            yield
    except RecursionError as error:
        raise AssetError("its nodes lie too deep in each other", where=where, remedy="Export it again.") from error
    except (DaeError, ValueError, TypeError, AttributeError, IndexError, KeyError, SyntaxError) as error:
        reason = " ".join(str(error).split())
        problem = f"this Collada file cannot be read: {reason}"
        raise AssetError(problem, where=where, remedy="Export it again.") from error


def _list_geometries(node: Any, world: Floats) -> Iterator[tuple[Any, str | None]]:
    from collada.scene import GeometryNode, Node, NodeNode  # lazy: as collada

    if isinstance(node, NodeNode):
        node = node.node
    inside = world @ node.matrix
    for child in node.children:
        if isinstance(child, Node | NodeNode):
            yield from _list_geometries(child, inside)
        elif isinstance(child, GeometryNode):
            _refuse_numbers(child.geometry)
            for bound in child.objects("geometry", inside):
                yield bound, node.name or node.id


def _refuse_numbers(geometry: Any) -> None:
    """Raise ValueError where a coordinate is not finite; pycollada would take it for zero."""
    for inputs in geometry.xmlnode.iterfind(".//{*}vertices/{*}input[@semantic='POSITION']"):
        identifier = inputs.get("source", "").lstrip("#")
        for source in geometry.xmlnode.iterfind(f".//{{*}}source[@id='{identifier}']/{{*}}float_array"):
            if _NOT_FINITE.search(source.text or ""):
                raise ValueError(f"a coordinate of geometry {geometry.id!r} is not a finite number")


def _read_surface(bound: Any, name: str | None, unit: float) -> Iterator[RawSurface]:
    """The surface of a geometry; its sets of triangles, one a material, are joined."""
    parts = [
        (np.asarray(found.vertex, dtype=np.float64), np.asarray(found.vertex_index, dtype=np.int64))
        for found in _list_triangles(bound)
    ]
    if parts:
        yield RawSurface(name, *stack_triangles(parts), unit)


def _list_triangles(bound: Any) -> Iterator[Any]:
    """The triangles of each set of polygons of a geometry, one a material; none that has none."""
    for part in bound.primitives():
        counts = getattr(part.original, "vcounts", None)
        if counts is not None and int(np.sum(counts)) != len(part.index):
            raise ValueError(f"its polygons have {int(np.sum(counts))} corners, listed are {len(part.index)}")
        triangles = part.triangleset() if hasattr(part, "triangleset") else part
        if not hasattr(triangles, "vertex_index") or np.ndim(triangles.vertex_index) != 2 or not len(triangles):
            continue
        if triangles.vertex_index.shape[1] == 3:
            yield triangles
