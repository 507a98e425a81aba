"""PLY: properties of every type are read, and hold what is written into them."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.formats import read, save
from meshforge.formats.meshfile.ply import TYPES, parse_ply
from meshforge.geometry import convex_hull
from meshforge.symbolic import Asset, Geom
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


@pytest.mark.parametrize("kind", TYPES)
@pytest.mark.parametrize("order", ORDERS)
def test_numbers_of_every_type_are_read(order: str, kind: str) -> None:
    assert np.array_equal(parse_ply(typed(PAIR, order, index=kind), "a.ply").faces, PAIR[1])
    assert np.array_equal(parse_ply(typed(PAIR, order, axis=kind), "a.ply").vertices, PAIR[0])
    quad = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]]), np.array([[0, 1, 2, 3]])
    for index in TYPES:
        faces = parse_ply(typed(quad, order, count=kind, index=index), "a.ply").faces
        assert faces.tolist() == [[0, 1, 2], [0, 2, 3]]


def with_a_hull(folder: Path, data: bytes, at: float) -> Asset:
    """The asset of a PLY, with a made hull whose lowest corner has y = `at`."""
    (folder / "a.ply").write_bytes(data)
    asset = read(folder / "a.ply")
    made = Geom("geom0#0~1", "body", convex_hull(box((0, at, 0))[0]), "geom0#0")
    return asset.with_geoms([*asset.geoms, made])


@pytest.mark.parametrize("axis", TYPES)
@pytest.mark.parametrize("order", ORDERS)
def test_a_made_hull_is_written_in_double_precision(tmp_path: Path, order: str, axis: str) -> None:
    saved = save(with_a_hull(tmp_path, typed(PAIR, order, axis=axis), 5.1), tmp_path / "b.ply")
    wanted = together(PAIR, box((0, 5.1, 0)))
    assert np.array_equal(
        np.unique(parse_ply(saved.path.read_bytes(), "b.ply").vertices, axis=0), np.unique(wanted[0], axis=0)
    )
