"""PLY: properties of every type are read, and hold what is written into them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import read
from meshforge.formats.meshfile.ply import parse_ply
from meshforge.formats.meshfile.ply_header import TYPES
from tests.soups import Soup, box, together

ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
PAIR = together(box(), box((3, 0, 0)))


def typed(soup: Soup, order: str, *, axis: str = "float", count: str = "uchar", index: str = "int") -> bytes:
    """A PLY whose coordinates, list lengths and vertex numbers are of these types."""
    head = f"ply\nformat {order} 1.0\nelement vertex {len(soup[0])}\n"
    head += "".join(f"property {axis} {name}\n" for name in "xyz")
    head += f"element face {len(soup[1])}\nproperty list {count} {index} vertex_indices\nend_header\n"
    if not ORDERS[order]:
        points = soup[0].astype(TYPES[axis]).tolist()
        rows = [" ".join(map(str, row)) for row in [*points, *([len(f), *f] for f in soup[1].tolist())]]
        return ("\n".join([head.rstrip(), *rows]) + "\n").encode()
    mark = ORDERS[order]
    faces = np.zeros(len(soup[1]), [("count", mark + TYPES[count]), ("corners", mark + TYPES[index], soup[1].shape[1])])
    faces["count"], faces["corners"] = soup[1].shape[1], soup[1]
    return head.encode() + soup[0].astype(mark + TYPES[axis]).tobytes() + faces.tobytes()


@pytest.mark.parametrize("index", TYPES)
@pytest.mark.parametrize("order", ORDERS)
def test_vertex_numbers_of_every_type_are_read(tmp_path: Path, order: str, index: str) -> None:
    path = tmp_path / "a.ply"
    path.write_bytes(typed(PAIR, order, index=index))
    assert [geom.shape.volume for geom in read(path).geoms] == pytest.approx([1, 1])
    assert np.array_equal(parse_ply(path.read_bytes(), "a.ply").faces, PAIR[1])


@pytest.mark.parametrize("count", TYPES)
@pytest.mark.parametrize("order", ORDERS)
def test_polygons_with_lengths_of_every_type_are_read(order: str, count: str) -> None:
    quad = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([[0, 1, 2, 3]])
    for index in TYPES:
        faces = parse_ply(typed(quad, order, count=count, index=index), "a.ply").faces
        assert faces.tolist() == [[0, 1, 2], [0, 2, 3]]


@pytest.mark.parametrize("axis", TYPES)
@pytest.mark.parametrize("order", ORDERS)
def test_coordinates_of_every_type_are_read(order: str, axis: str) -> None:
    assert np.array_equal(parse_ply(typed(PAIR, order, axis=axis), "a.ply").vertices, PAIR[0])
